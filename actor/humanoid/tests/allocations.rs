//! Steps and resets of the environment allocate no more than the physics engine alone.
//!
//! The count covers all threads, so this test has a process of its own.

mod counting;

use treadmill_humanoid::{
    EnvConfig, EnvObservation, EnvTask, Environment, EnvironmentConfig, HUMANOID_XML, RandomisationConfig, Variation,
};

use crate::counting::counted;

const STEPS: u64 = 300;
const SEED: u64 = 3;

fn action(step: u64) -> [f32; 17] {
    std::array::from_fn(|motor| 0.4 * ((step * 31 + motor as u64 * 17) as f32).sin())
}

/// Allocations of physics alone in a reset, with a variation if the episode is randomised, and in [`STEPS`] steps.
fn physics_alone(randomisation: RandomisationConfig) -> [u64; 2] {
    let is_varied = randomisation.is_on();
    let mut environment = environment(RandomisationConfig::default());
    let mut observation = vec![0.0; environment.observation_size()];
    let position = environment.physics().model().nominal_position();
    let physics = environment.physics_mut();
    let variation = Variation::none(physics.model());
    physics.step_only(&[0.0; 17]).expect("finite");
    let reset = counted(|| {
        if is_varied {
            physics.set_variation(&variation);
        }
        physics.set_state(&position, &[0.0; 23]);
    });
    // Step from the same state as the whole environment.
    environment.reset(SEED, &mut observation);
    let physics = environment.physics_mut();
    let steps = counted(|| {
        for step in 0..STEPS {
            let controls = step.checked_sub(randomisation.action_delay_steps[0].into()).map_or([0.0; 17], action);
            physics.step_only(&controls).expect("finite");
        }
    });
    [reset, steps]
}

fn environment(randomisation: RandomisationConfig) -> Environment {
    let config = EnvironmentConfig {
        env: EnvConfig {
            terminate_when_unhealthy: false,
            // The most expensive observation.
            observation: EnvObservation::GymnasiumV4,
            ..EnvConfig::default()
        },
        randomisation,
        ..EnvironmentConfig::default()
    };
    Environment::new(&config, HUMANOID_XML).expect("valid")
}

/// Allocations of the whole environment in a reset and in [`STEPS`] steps.
fn whole_environment(randomisation: RandomisationConfig) -> [u64; 2] {
    let mut environment = environment(randomisation);
    let mut observation = vec![0.0; environment.observation_size()];
    environment.step(&[0.0; 17], &mut observation);
    let reset = counted(|| environment.reset(SEED, &mut observation));
    let steps = counted(|| {
        for step in 0..STEPS {
            let step = environment.step(&action(step), &mut observation);
            assert!(!step.fault && environment.info().unwrap().entries(EnvTask::HumanoidV5).count() == 11);
        }
    });
    [reset, steps]
}

#[test]
fn the_environment_allocates_no_more_than_its_physics() {
    // These settings leave the motion unchanged but for a known delay, so that physics does the same work.
    let disturbed = RandomisationConfig {
        sensor_noise_position: 0.01,
        sensor_noise_velocity: 0.01,
        action_delay_steps: [2, 2],
        push_mps: [0.0, 0.5],
        push_interval_s: [1000.0, 1000.0],
        ..RandomisationConfig::default()
    };
    assert!(counted(|| drop(environment(disturbed.clone()))) > 0, "allocations are counted");
    for randomisation in [RandomisationConfig::default(), disturbed] {
        let [alone, found] = [physics_alone(randomisation.clone()), whole_environment(randomisation)];
        // Buffers of each thread grow with the contacts that it has met.
        let more = found.iter().zip(alone).map(|(found, alone)| found.saturating_sub(alone)).max();
        assert!(
            more < Some(STEPS / 20) && alone[1] < STEPS / 20,
            "{found:?} allocations in a reset and in {STEPS} steps, {alone:?} of them in physics alone"
        );
    }
}
