//! `bench env`: steps per second with random actions and resets, with task and observation and of physics alone.

use std::{thread, time::Instant};

use clap::Args;
use rand::RngExt;
use serde_json::json;
use treadmill_actor::{
    environments::{Environments, SeedSource, StepResults},
    settings,
};
use treadmill_config::Config;
use treadmill_humanoid::{EnvironmentConfig, task};
use treadmill_runtime::{machine, seeds};

use super::{
    bench_worlds::{self, BenchWorlds, WORLDS},
    print_result, quality, rounded,
};
use crate::launch::model::{self, ModelArgs};

/// Number of random actions, which repeat; a multiple of [`WORLDS`].
const ACTIONS: usize = 64 * WORLDS;

/// Flags of `bench env`.
#[derive(Args)]
pub struct EnvArgs {
    /// Environment steps to measure.
    #[arg(long, default_value_t = 100_000)]
    pub steps: u64,
    /// Threads that step the worlds; 0 means one per core.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(0..=256))]
    threads: u16,
    /// Kind of observation, short for --set env.observation=KIND.
    #[arg(long, value_name = "KIND")]
    observation: Option<String>,
    #[command(flatten)]
    model: ModelArgs,
    /// Measure errors of joint limits under the largest torques in random directions, instead of speed.
    #[arg(long)]
    quality: bool,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

impl EnvArgs {
    fn config(&self) -> anyhow::Result<Config> {
        let mut given = self.model.clone();
        given.set.extend(self.observation.iter().map(|kind| format!("env.observation={kind}")));
        given.config(&Config::default())
    }
}

/// Runs the measurement and prints its result.
pub fn run(args: &EnvArgs) -> anyhow::Result<()> {
    let config = args.config()?;
    let file = args.model.model.as_deref();
    let text = model::completed(&config, file)?;
    // Reports errors of the model file.
    model::environment(&config, &text, file)?;
    let environment = settings::training(&config);
    let threads = bench_worlds::threads(args.threads.into());
    let rounds = args.steps.div_ceil(WORLDS as u64).max(1);
    let result = if args.quality {
        quality::measure(&environment, &text, threads, rounds)?
    } else {
        measure(&environment, &text, config.env.observation.name(), threads, rounds)?
    };
    print_result(&result, args.json);
    Ok(())
}

fn measure(
    config: &EnvironmentConfig,
    model_xml: &str,
    observation_kind: &str,
    threads: usize,
    rounds: u64,
) -> anyhow::Result<serde_json::Value> {
    let seeds = SeedSource { run_seed: 1, actor: "bench".to_string(), start: 0 };
    let environments = Environments::new(WORLDS, config, model_xml, seeds)?;
    let mut random = seeds::stream(1, "bench-actions", &[]);
    let (size, observation_size) = (environments.action_size(), environments.observation_size());
    let actions: Vec<f32> = (0..ACTIONS * size).map(|_| random.random_range(-1.0..1.0)).collect();
    let actions_of = |round: u64| {
        let first = round as usize * WORLDS % ACTIONS;
        &actions[first * size..][..WORLDS * size]
    };

    // Like an actor, each thread steps a share of the environments.
    let mut shares: Vec<_> = environments.split(threads).into_iter().map(|share| (share, 0u64, 0u64)).collect();
    let begun = Instant::now();
    thread::scope(|scope| {
        for (share, sum, resets) in &mut shares {
            scope.spawn(move || {
                let mut stepped = StepResults::default();
                for round in 0..rounds {
                    share.step(&actions_of(round)[share.first_number() * size..][..share.len() * size], &mut stepped);
                    // Whole numbers add up to the same in any order.
                    *sum += stepped.rewards.iter().map(|reward| u64::from(reward.to_bits())).sum::<u64>();
                    *resets += stepped.episodes.len() as u64;
                }
            });
        }
    });
    let steps = rounds * WORLDS as u64;
    let env_steps_per_s = steps as f64 / begun.elapsed().as_secs_f64();
    let sum: u64 = shares.iter().map(|(_, sum, _)| sum).sum();
    let resets: u64 = shares.iter().map(|(.., resets)| resets).sum();
    let entries = shares.iter().flat_map(|(share, ..)| share.observations());
    let observations: Vec<u8> = entries.flat_map(|entry| entry.to_le_bytes()).collect();

    // The same actions without observation and reward. Bodies that fell are reset here too, because contact with the ground
    // costs time.
    let mut worlds = BenchWorlds::new(config, model_xml, threads, |_| vec![0.0f32; size])?;
    let begun = Instant::now();
    worlds.step(
        rounds,
        |round, world, controls| {
            let action = &actions_of(round)[world.index * size..][..size];
            world.environment.action_from_shares(action, controls);
            // A failure shows after the step.
            let _ = world.environment.physics_mut().set_controls(controls);
        },
        |world, _, failed| {
            if failed || !task::is_healthy(config, world.environment.physics().torso_height_m()) {
                world.reset();
            }
        },
    );
    let physics_only_steps_per_s = steps as f64 / begun.elapsed().as_secs_f64();
    let faults: u64 = worlds.iter().map(|(world, _)| world.faults).sum();
    // Each world was reset once before the first step.
    let resets = resets + worlds.iter().map(|(world, _)| world.resets - 1).sum::<u64>();

    Ok(json!({
        "env_steps_per_s": rounded(env_steps_per_s),
        "physics_only_steps_per_s": rounded(physics_only_steps_per_s),
        "observation": observation_size,
        "observation_kind": observation_kind,
        "control_step_s": config.control_step_s,
        "threads": threads,
        "cpu": machine::cpu_name(),
        "workload": format!("{WORLDS} humanoids, uniformly random actions, {steps} steps each way, {resets} resets"),
        "faults": faults,
        "checksum": format!("{:016x}", seeds::checksum(&[&sum.to_le_bytes(), &observations])),
    }))
}
