//! `bench env`: steps per second with random actions and resets, with task and observation and of physics alone.

use std::{thread, time::Instant};

use clap::Args;
use rand::RngExt;
use serde_json::{Value, json};
use treadmill_actor::environments::{Environments, SeedSource, StepResults};
use treadmill_config::Config;
use treadmill_humanoid::{Environment, EnvironmentConfig, Physics, TaskRegistry, task, worlds_per_pass};
use treadmill_proto::EndCause;
use treadmill_runtime::{machine, seeds};

use super::rounded;
use crate::launch::{
    model::{self, ModelArgs},
    output::say_result,
};

/// Number of humanoids, as many as an actor has: one alone would stay in the cache.
const WORLDS: usize = 64;
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
pub fn run(args: &EnvArgs, tasks: &TaskRegistry) -> anyhow::Result<()> {
    let config = args.config()?;
    let file = args.model.model.as_deref();
    let text = model::completed(&config, file, &args.model.file, "")?;
    let text = model::with_given_motions(&config, &text, &args.model.motion)?;
    // Reports errors of the model file.
    model::environment(tasks, &config, &text, file)?;
    let environment = config.environment();
    let threads = WORLDS.div_ceil(worlds_per_thread(machine::threads(args.threads.into())));
    let rounds = args.steps.div_ceil(WORLDS as u64).max(1);
    let has_other_task = model::has_other_task(&config.env);
    let workload = Workload::new(tasks, &environment, &text, threads, rounds)?;
    let mut result = workload.with_task(config.env.observation.name())?;
    if !has_other_task {
        // A body of another task has no height below which it is reset.
        result["physics_only_steps_per_s"] = workload.physics_only()?.into();
    }
    say_result(&result, args.json);
    Ok(())
}

/// Random actions of [`WORLDS`] humanoids.
struct Workload<'a> {
    tasks: &'a TaskRegistry,
    config: &'a EnvironmentConfig,
    model_xml: &'a str,
    threads: usize,
    rounds: u64,
    action_size: usize,
    actions: Vec<f32>,
}

impl<'a> Workload<'a> {
    fn new(
        tasks: &'a TaskRegistry,
        config: &'a EnvironmentConfig,
        model_xml: &'a str,
        threads: usize,
        rounds: u64,
    ) -> anyhow::Result<Self> {
        let action_size = Environment::with_tasks(config, model_xml, tasks)?.action_size();
        let mut random = seeds::stream(1, "bench-actions", &[]);
        let actions = (0..ACTIONS * action_size).map(|_| random.random_range(-1.0..1.0)).collect();
        Ok(Self { tasks, config, model_xml, threads, rounds, action_size, actions })
    }

    /// Returns the actions of all worlds in a round.
    fn actions_of(&self, round: u64) -> &[f32] {
        let first = round as usize * WORLDS % ACTIONS;
        &self.actions[first * self.action_size..][..WORLDS * self.action_size]
    }

    fn steps(&self) -> u64 {
        self.rounds * WORLDS as u64
    }

    fn with_task(&self, observation_kind: &str) -> anyhow::Result<Value> {
        let seeds = SeedSource { run_seed: 1, actor: "bench".to_string(), start: 0 };
        let environments = Environments::new(WORLDS, self.tasks, self.config, self.model_xml, seeds)?;
        let (size, observation_size) = (self.action_size, environments.observation_size());
        // Like an actor, each thread steps a share of the environments.
        let mut shares: Vec<_> = environments.split(self.threads).into_iter().map(|share| (share, 0, 0, 0)).collect();
        let begun = Instant::now();
        thread::scope(|scope| {
            for (share, sum, resets, faults) in &mut shares {
                scope.spawn(move || {
                    let mut stepped = StepResults::default();
                    for round in 0..self.rounds {
                        let actions = &self.actions_of(round)[share.first_number() * size..][..share.len() * size];
                        share.step(actions, &mut stepped);
                        // Whole numbers add up to the same in any order.
                        *sum += stepped.rewards.iter().map(|reward| u64::from(reward.to_bits())).sum::<u64>();
                        *resets += stepped.episodes.len() as u64;
                        let faulty = stepped.episodes.iter().filter(|episode| episode.cause == EndCause::NonFinite);
                        *faults += faulty.count() as u64;
                    }
                });
            }
        });
        let steps = self.steps();
        let env_steps_per_s = steps as f64 / begun.elapsed().as_secs_f64();
        let sum: u64 = shares.iter().map(|(_, sum, ..)| sum).sum();
        let resets: u64 = shares.iter().map(|(_, _, resets, _)| resets).sum();
        let faults: u64 = shares.iter().map(|(.., faults)| faults).sum();
        let entries = shares.iter().flat_map(|(share, ..)| share.observations());
        let observations: Vec<u8> = entries.flat_map(|entry| entry.to_le_bytes()).collect();
        Ok(json!({
            "env_steps_per_s": rounded(env_steps_per_s),
            "observation": observation_size,
            "observation_kind": observation_kind,
            "control_step_s": self.config.env.control_step_s,
            "threads": shares.len(),
            "cpu": machine::cpu_name(),
            "workload": format!("{WORLDS} humanoids, uniformly random actions, {steps} steps, {resets} resets"),
            "faults": faults,
            "checksum": format!("{:016x}", seeds::checksum(&[&sum.to_le_bytes(), &observations])),
        }))
    }

    /// Returns the steps per second of the same actions without observation and reward. Bodies that fell are reset here too,
    /// because contact with the ground costs time.
    fn physics_only(&self) -> anyhow::Result<f64> {
        let world = |index| -> anyhow::Result<World> {
            let environment = Environment::with_tasks(self.config, self.model_xml, self.tasks)?;
            let (observation, controls) = (vec![0.0; environment.observation_size()], vec![0.0; self.action_size]);
            let mut world = World { index, environment, resets: 0, observation, controls };
            world.reset();
            Ok(world)
        };
        let mut worlds = (0..WORLDS).map(world).collect::<anyhow::Result<Vec<_>>>()?;
        let begun = Instant::now();
        thread::scope(|scope| {
            for share in worlds.chunks_mut(worlds_per_thread(self.threads)) {
                scope.spawn(|| self.step_physics(share));
            }
        });
        Ok(rounded(self.steps() as f64 / begun.elapsed().as_secs_f64()))
    }

    /// Steps the physics of a thread's worlds in whole passes.
    fn step_physics(&self, share: &mut [World]) {
        let (size, env) = (self.action_size, &self.config.env);
        for round in 0..self.rounds {
            for pass in share.chunks_mut(worlds_per_pass()) {
                for World { index, environment, controls, .. } in &mut *pass {
                    environment.action_from_shares(&self.actions_of(round)[*index * size..][..size], controls);
                    // A failure shows after the step.
                    let _ = environment.physics_mut().set_controls(controls);
                }
                Physics::step_together(&mut pass.iter_mut().map(|world| world.environment.physics_mut()));
                for world in pass {
                    let physics = world.environment.physics_mut();
                    let failed = physics.check_step().is_err();
                    let fell = env.terminate_when_unhealthy && !task::is_healthy(env, physics.torso_height_m());
                    if failed || fell {
                        world.reset();
                    }
                }
            }
        }
    }
}

/// Humanoid whose physics is stepped without a task.
struct World {
    index: usize,
    environment: Environment,
    resets: u64,
    observation: Vec<f32>,
    controls: Vec<f32>,
}

impl World {
    /// Resets the humanoid, with a seed of this world.
    fn reset(&mut self) {
        let seed = seeds::derive(1, "bench-reset", &[self.index as u64, self.resets]);
        self.resets += 1;
        self.environment.reset(seed, &mut self.observation);
    }
}

/// Returns how many worlds each of this many threads steps.
fn worlds_per_thread(threads: usize) -> usize {
    WORLDS.div_ceil(threads).next_multiple_of(worlds_per_pass())
}
