//! One core, 64 worlds in turn, random actions, resets included.

use std::time::Instant;

use clap::Args;
use rand::RngExt;
use serde_json::json;
use treadmill_actor::settings;
use treadmill_common::{config::EnvConfig, machine, seeds};
use treadmill_humanoid::{Environment, HUMANOID_XML, task};

use super::{rounded, tell};

/// Worlds that are stepped in turn, as an actor has them: one alone would stay in the cache.
const WORLDS: usize = 64;

/// Flags of `bench env`.
#[derive(Args)]
pub struct EnvArgs {
    /// Environment steps to measure over.
    #[arg(long, default_value_t = 100_000)]
    steps: u64,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

/// Measures and tells.
pub fn run(args: &EnvArgs) -> anyhow::Result<()> {
    let config = settings::environment(&EnvConfig::default());
    let mut worlds = (0..WORLDS).map(|_| Environment::new(&config, HUMANOID_XML)).collect::<Result<Vec<_>, _>>()?;
    let rounds = args.steps.div_ceil(WORLDS as u64).max(1);
    let mut random = seeds::stream(1, "bench-actions", &[]);
    let (size, limit) = (worlds[0].action_size(), worlds[0].action_limit());
    let actions: Vec<f32> = (0..size * 4096).map(|_| random.random_range(-limit..limit)).collect();
    let action = |index: usize| &actions[index % 4096 * size..][..size];

    let mut observation = vec![0.0; worlds[0].observation_size()];
    worlds.iter_mut().enumerate().for_each(|(index, world)| world.reset(index as u64, &mut observation));
    let (mut sum, mut resets, mut index) = (0.0f64, 0u64, 0);
    let begun = Instant::now();
    for _ in 0..rounds {
        for world in &mut worlds {
            let step = world.step(action(index), &mut observation);
            sum += f64::from(step.reward);
            index += 1;
            if step.terminated || step.truncated {
                resets += 1;
                world.reset(WORLDS as u64 + resets, &mut observation);
            }
        }
    }
    let steps = rounds * WORLDS as u64;
    let env_steps_per_s = steps as f64 / begun.elapsed().as_secs_f64();

    // The same bodies under the same actions, without observation and reward; a body on the ground costs more than one that
    // stands, so those that fell stand up again here too.
    worlds.iter_mut().enumerate().for_each(|(index, world)| world.reset(index as u64, &mut observation));
    let begun = Instant::now();
    let mut faults = 0u64;
    for _ in 0..rounds {
        for world in &mut worlds {
            let failed = world.physics_mut().step_only(action(index)).is_err();
            faults += u64::from(failed);
            index += 1;
            if failed || !task::is_healthy(&config, world.physics().torso_height_m()) {
                resets += 1;
                world.reset(WORLDS as u64 + resets, &mut observation);
            }
        }
    }
    let physics_only_steps_per_s = steps as f64 / begun.elapsed().as_secs_f64();

    let result = json!({
        "env_steps_per_s": rounded(env_steps_per_s),
        "physics_only_steps_per_s": rounded(physics_only_steps_per_s),
        "observation": observation.len(),
        "control_step_s": worlds[0].control_step_s(),
        "threads": 1,
        "cpu": machine::cpu_name(),
        "workload": format!("{WORLDS} humanoids in turn, uniformly random actions, {steps} steps each way, {resets} resets"),
        "faults": faults,
        "checksum": format!("{:016x}", seeds::checksum(&[&sum.to_le_bytes()])),
    });
    tell(&result, args.json);
    Ok(())
}
