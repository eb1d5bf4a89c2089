//! Stepping many environments, resets included, allocates no more than the physics engine alone.
//!
//! This test runs alone in its process, because it counts the allocations of the whole process.

#[path = "../humanoid/tests/counting/mod.rs"]
mod counting;

use treadmill_actor::environments::{Environments, SeedSource, StepResults};
use treadmill_humanoid::{EnvConfig, Environment, EnvironmentConfig, HUMANOID_XML, TaskRegistry};
use treadmill_runtime::seeds;

use crate::counting::counted;

const ENVS: usize = 4;
const EPISODE_STEPS: u32 = 10;
const WARM_UP_STEPS: u64 = 20;
const STEPS: u64 = 200;

/// Returns a configuration whose episodes end by time alone, so that bare physics can be reset in the same steps.
fn config() -> EnvironmentConfig {
    EnvironmentConfig::from(EnvConfig {
        terminate_when_unhealthy: false,
        max_episode_steps: EPISODE_STEPS,
        ..EnvConfig::default()
    })
}

/// Returns an action in units of the action range.
fn action(env: usize, step: u64) -> [f32; 17] {
    std::array::from_fn(|motor| ((env * 31 + motor * 7) as f32 + step as f32).sin())
}

fn bare_physics() -> u64 {
    let mut bodies: Vec<Environment> =
        (0..ENVS).map(|_| Environment::new(&config(), HUMANOID_XML).expect("valid")).collect();
    let limit = bodies[0].action_ranges()[0][1];
    let mut observation = vec![0.0; bodies[0].observation_size()];
    let mut reset = |body: &mut Environment, env: usize, episode: u64| {
        body.reset(seeds::derive(5, "reset/a", &[0, env as u64, episode]), &mut observation);
    };
    bodies.iter_mut().enumerate().for_each(|(env, body)| reset(body, env, 0));
    let mut play = |steps: std::ops::Range<u64>| {
        for step in steps {
            for (env, body) in bodies.iter_mut().enumerate() {
                body.physics_mut().step_only(&action(env, step).map(|part| part * limit)).expect("finite");
                if (step + 1).is_multiple_of(EPISODE_STEPS.into()) {
                    reset(body, env, (step + 1) / u64::from(EPISODE_STEPS));
                }
            }
        }
    };
    play(0..WARM_UP_STEPS);
    counted(|| play(WARM_UP_STEPS..WARM_UP_STEPS + STEPS))
}

fn environments() -> u64 {
    let seeds = SeedSource { run_seed: 5, actor: "a".into(), start: 0 };
    let mut environments =
        Environments::new(ENVS, &TaskRegistry::default(), &config(), HUMANOID_XML, seeds).expect("valid");
    let (mut results, mut actions) = (StepResults::default(), [0.0; 17 * ENVS]);
    let mut play = |steps: std::ops::Range<u64>| {
        for step in steps {
            for (env, part) in actions.chunks_exact_mut(17).enumerate() {
                part.copy_from_slice(&action(env, step));
            }
            environments.step(&actions, &mut results);
        }
    };
    play(0..WARM_UP_STEPS);
    counted(|| play(WARM_UP_STEPS..WARM_UP_STEPS + STEPS))
}

#[test]
fn environments_allocate_no_more_than_their_physics() {
    let physics = bare_physics();
    // Buffers grow with the contacts that their environments have met.
    let all = environments();
    assert!(
        all <= physics + STEPS / 20,
        "{all} allocations in {STEPS} steps of {ENVS} environments, {physics} of bare physics"
    );
}
