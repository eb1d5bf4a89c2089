//! `bench env --quality`: errors of joint limits and of the constraint solve under the largest torques in random directions.

use rand::RngExt;
use serde_json::json;
use treadmill_humanoid::EnvironmentConfig;
use treadmill_runtime::{machine, seeds};

use super::{
    bench_worlds::{BenchWorld, BenchWorlds, WORLDS, fell},
    quantiles::Quantiles,
};

/// Time after which a humanoid on the floor is reset (s).
const RESET_AFTER_S: f64 = 15.0;

/// Measurements of one world.
struct WorldQuality {
    random: seeds::Stream,
    controls: Vec<f32>,
    steps: u32,
    overshoot_rad: Quantiles,
    residual: Quantiles,
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
        residual: Quantiles::default(),
    })?;
    let reset_after_steps = (RESET_AFTER_S / config.control_step_s).round() as u32;
    worlds.step(
        rounds,
        |_, world, record| record.begin(world),
        |world, record, failed| {
            if !failed {
                let quality = world.environment.joint_quality();
                record.overshoot_rad.add(quality.limit_overshoot_rad);
                record.residual.add(quality.residual);
            }
            // Half of the worlds are reset after a fall; the others stay on the floor for a while.
            if failed || (fell(config, world) && world.index.is_multiple_of(2)) || record.steps >= reset_after_steps {
                record.steps = 0;
                world.reset();
            }
        },
    );
    let (mut overshoot_rad, mut residual) = (Quantiles::default(), Quantiles::default());
    let (mut faults, mut resets) = (0, 0);
    for (world, record) in worlds.iter() {
        overshoot_rad.merge(&record.overshoot_rad);
        residual.merge(&record.residual);
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
        "residual_p50": residual.quantile(0.5),
        "residual_p99": residual.quantile(0.99),
        "residual_max": residual.largest(),
        "faults": faults,
        "control_step_s": config.control_step_s,
        "threads": threads,
        "cpu": machine::cpu_name(),
        "workload": format!(
            "{WORLDS} humanoids, every motor at a random end of its range in each step, {resets} resets"
        ),
        "checksum": format!("{:016x}", seeds::checksum(&[&numbers, &u64::to_le_bytes(faults)])),
    }))
}

impl WorldQuality {
    /// Sets every motor to one end of its range.
    fn begin(&mut self, world: &mut BenchWorld) {
        self.controls.resize(world.environment.action_size(), 0.0);
        for (control, [low, high]) in self.controls.iter_mut().zip(world.environment.action_ranges()) {
            *control = if self.random.random() { *high } else { *low };
        }
        self.steps += 1;
        // A failure shows after the step.
        let _ = world.environment.physics_mut().set_controls(&self.controls);
    }
}
