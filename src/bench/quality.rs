//! How well joints and limits hold under the largest torques there are, in random directions.

use rand::RngExt;
use serde_json::json;
use treadmill_runtime::{machine, seeds};
use treadmill_humanoid::{EnvironmentConfig, task};

use super::{
    quantiles::Quantiles,
    worlds::{WORLDS, World, Worlds},
};

/// A body that flails on the floor is put on its feet again after so many control steps: 15 s.
const FLAILING_STEPS: u32 = 1000;

/// What one world has counted.
struct Record {
    random: seeds::Stream,
    controls: Vec<f32>,
    steps: u32,
    separation_m: Quantiles,
    overshoot_rad: Quantiles,
}

/// Lets all worlds flail and tells what their joints did; memory does not grow with the steps.
pub fn measure(
    config: &EnvironmentConfig,
    model_xml: &str,
    threads: usize,
    rounds: u64,
) -> anyhow::Result<serde_json::Value> {
    let mut worlds = Worlds::new(config, model_xml, threads, |index| Record {
        random: seeds::stream(1, "bench-quality", &[index as u64]),
        controls: Vec::new(),
        steps: 0,
        separation_m: Quantiles::default(),
        overshoot_rad: Quantiles::default(),
    })?;
    for _ in 0..rounds {
        worlds.each(|world, record| {
            let failed = record.step(world);
            // Half of the worlds stand up as soon as they fell; the others are thrown about on the floor.
            let fell = !task::is_healthy(config, world.environment.physics().torso_height_m());
            if failed || (fell && world.index.is_multiple_of(2)) || record.steps >= FLAILING_STEPS {
                record.steps = 0;
                world.reset();
            }
        });
    }
    let (mut separation_m, mut overshoot_rad) = (Quantiles::default(), Quantiles::default());
    let (mut faults, mut resets) = (0, 0);
    for (world, record) in worlds.iter() {
        separation_m.merge(&record.separation_m);
        overshoot_rad.merge(&record.overshoot_rad);
        faults += world.faults;
        resets += world.resets;
    }
    let steps = rounds * WORLDS as u64;
    let told = |quantiles: &Quantiles| [0.5, 0.99, 0.999].map(|share| quantiles.quantile(share));
    let (separations, overshoots) = (told(&separation_m), told(&overshoot_rad));
    let numbers: Vec<u8> = [separations, overshoots]
        .iter()
        .flatten()
        .chain(&[separation_m.largest(), overshoot_rad.largest()])
        .flat_map(|number| number.to_le_bytes())
        .collect();
    Ok(json!({
        "steps": steps,
        "joint_separation_p50_m": separations[0],
        "joint_separation_p99_m": separations[1],
        "joint_separation_p999_m": separations[2],
        "joint_separation_max_m": separation_m.largest(),
        "limit_overshoot_p50_rad": overshoots[0],
        "limit_overshoot_p99_rad": overshoots[1],
        "limit_overshoot_p999_rad": overshoots[2],
        "limit_overshoot_max_rad": overshoot_rad.largest(),
        "faults": faults,
        "control_step_s": treadmill_humanoid::CONTROL_STEP_S,
        "threads": threads,
        "cpu": machine::cpu_name(),
        "workload": format!(
            "{WORLDS} humanoids, every motor at plus or minus its limit by chance, anew in each step, {resets} resets"
        ),
        "checksum": format!("{:016x}", seeds::checksum(&[&numbers, &u64::to_le_bytes(faults)])),
    }))
}

impl Record {
    /// One step with every motor at one end of its range; whether physics failed.
    fn step(&mut self, world: &mut World) -> bool {
        self.controls.resize(world.environment.action_size(), 0.0);
        for (control, [low, high]) in self.controls.iter_mut().zip(world.environment.action_ranges()) {
            *control = if self.random.random() { *high } else { *low };
        }
        self.steps += 1;
        if world.environment.physics_mut().step_only(&self.controls).is_err() {
            world.faults += 1;
            return true;
        }
        let quality = world.environment.joint_quality();
        self.separation_m.add(quality.separation_m);
        self.overshoot_rad.add(quality.limit_overshoot_rad);
        false
    }
}
