//! Vectors of environments, and the fragments, poses and saved states that an actor takes from them.

mod environments;
mod poses;
mod rollout;
mod state;

use treadmill_actor::{
    acting_policy::ActingPolicy,
    environments::{Environments, SeedSource},
    identity::ActorIdentity,
};
use treadmill_humanoid::{EnvConfig, EnvironmentConfig, HUMANOID_XML, RandomisationConfig, TaskRegistry};
use treadmill_policy::{NetworkShape, Networks, to_safetensors};
use treadmill_proto::{PolicyBundle, PolicyVersion};
use treadmill_runtime::seeds;

fn identity(actor: &str) -> ActorIdentity {
    ActorIdentity { run: "walk".into(), actor: actor.into(), incarnation: 6, config_hash: 5 }
}

/// Returns humanoids of an actor that has this name and was started this often before.
fn environments(count: usize, config: &EnvironmentConfig, actor: &str, start: u64) -> Environments {
    let seeds = SeedSource { run_seed: 1, actor: actor.into(), start };
    Environments::new(count, &TaskRegistry::default(), config, HUMANOID_XML, seeds).unwrap()
}

/// Returns a configuration whose episodes last this long.
fn limited(max_episode_steps: u32) -> EnvironmentConfig {
    EnvConfig { max_episode_steps, ..EnvConfig::default() }.into()
}

/// Returns a configuration with every kind of randomisation, whose episodes end in every way within a few steps.
fn randomised(motor_scale: [f64; 2]) -> EnvironmentConfig {
    EnvironmentConfig {
        env: EnvConfig { max_episode_steps: 25, ..EnvConfig::default() },
        randomisation: RandomisationConfig {
            mass_scale: [0.8, 1.2],
            motor_scale,
            sensor_noise_position: 0.01,
            control_noise: 0.1,
            action_delay_steps: [0, 2],
            push_interval_s: [0.1, 0.2],
            push_mps: [0.1, 2.0],
            ..RandomisationConfig::default()
        },
        ..EnvironmentConfig::default()
    }
}

fn policy(observation: usize) -> ActingPolicy {
    let shape = NetworkShape { observation, action: 17, hidden: vec![8], privileged: 0 };
    let parameters = Networks::from(shape.clone()).initial_parameters(-0.5, &mut seeds::stream(1, "test", &[]));
    let weights = to_safetensors(&shape, &parameters);
    ActingPolicy::new(&PolicyBundle {
        run: "walk".into(),
        version: PolicyVersion::new(3, 4),
        observation_size: observation as u32,
        action_size: 17,
        hidden: vec![8],
        checksum: seeds::checksum(&[&weights]),
        weights: weights.into(),
        observation_mean: vec![0.0; observation],
        observation_inverse_std: vec![1.0; observation],
        observation_clip: 10.0,
        config_hash: 5,
        ..PolicyBundle::default()
    })
    .unwrap()
}
