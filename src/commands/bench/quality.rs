//! `bench env --quality`: errors of joint limits under the largest torques in random directions.

use rand::RngExt;
use serde_json::json;
use treadmill_humanoid::{EnvironmentConfig, task};
use treadmill_runtime::{machine, seeds};

use super::{
    bench_worlds::{BenchWorld, BenchWorlds, WORLDS},
    quantiles::Quantiles,
};

/// Control steps (15 s) after which a humanoid on the floor is reset.
const RESET_AFTER_STEPS: u32 = 1000;

/// Measurements of one world.
struct WorldQuality {
    random: seeds::Stream,
    controls: Vec<f32>,
    steps: u32,
    overshoot_rad: Quantiles,
}

/// Steps all worlds and returns quantiles of their joint errors; memory does not grow with the steps.
pub fn measure(
    config: &EnvironmentConfig,
    model_xml: &str,
    threads: usize,
    rounds: u64,
) -> anyhow::Result<serde_json::Value> {
    let mut worlds = BenchWorlds::new(config, model_xml, threads, |index| WorldQuality {
        random: seeds::stream(1, "bench-quality", &[index as u64]),
        controls: Vec::new(),
        steps: 0,
        overshoot_rad: Quantiles::default(),
    })?;
    for _ in 0..rounds {
        worlds.each(|world, record| {
            let failed = record.step(world);
            // Half of the worlds are reset after a fall; the others stay on the floor for a while.
            let fell = !task::is_healthy(config, world.environment.physics().torso_height_m());
            if failed || (fell && world.index.is_multiple_of(2)) || record.steps >= RESET_AFTER_STEPS {
                record.steps = 0;
                world.reset();
            }
        });
    }
    let mut overshoot_rad = Quantiles::default();
    let (mut faults, mut resets) = (0, 0);
    for (world, record) in worlds.iter() {
        overshoot_rad.merge(&record.overshoot_rad);
        faults += world.faults;
        resets += world.resets;
    }
    let steps = rounds * WORLDS as u64;
    let overshoots = [0.5, 0.99, 0.999].map(|share| overshoot_rad.quantile(share));
    let numbers: Vec<u8> =
        overshoots.iter().chain(&[overshoot_rad.largest()]).flat_map(|number| number.to_le_bytes()).collect();
    Ok(json!({
        "steps": steps,
        "limit_overshoot_p50_rad": overshoots[0],
        "limit_overshoot_p99_rad": overshoots[1],
        "limit_overshoot_p999_rad": overshoots[2],
        "limit_overshoot_max_rad": overshoot_rad.largest(),
        "faults": faults,
        "control_step_s": treadmill_humanoid::CONTROL_STEP_S,
        "threads": threads,
        "cpu": machine::cpu_name(),
        "workload": format!(
            "{WORLDS} humanoids, every motor at a random end of its range in each step, {resets} resets"
        ),
        "checksum": format!("{:016x}", seeds::checksum(&[&numbers, &u64::to_le_bytes(faults)])),
    }))
}

impl WorldQuality {
    /// Makes one step with every motor at one end of its range; returns whether physics failed.
    fn step(&mut self, world: &mut BenchWorld) -> bool {
        self.controls.resize(world.environment.action_size(), 0.0);
        for (control, [low, high]) in self.controls.iter_mut().zip(world.environment.action_ranges()) {
            *control = if self.random.random() { *high } else { *low };
        }
        self.steps += 1;
        if world.environment.physics_mut().step_only(&self.controls).is_err() {
            world.faults += 1;
            return true;
        }
        self.overshoot_rad.add(world.environment.joint_quality().limit_overshoot_rad);
        false
    }
}
