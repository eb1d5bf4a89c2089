//! Environments and episodes that several tests play.

use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use treadmill_humanoid::{
    EnvConfig, EnvObservation, Environment, EnvironmentConfig, HUMANOID_XML, Model, Physics, RandomisationConfig,
};

/// Settings with contact forces in the observation and all randomisation.
pub fn randomised() -> EnvironmentConfig {
    EnvironmentConfig {
        env: EnvConfig {
            observation: EnvObservation::GymnasiumV5,
            terminate_when_unhealthy: false,
            max_episode_steps: 400,
            ..EnvConfig::default()
        },
        randomisation: RandomisationConfig {
            mass_scale: [0.8, 1.2],
            floor_friction_scale: [0.5, 1.5],
            motor_scale: [0.8, 1.2],
            kp_scale: [1.0, 1.0],
            kd_scale: [1.0, 1.0],
            com_offset_m: 0.0,
            damping_scale: [0.8, 1.2],
            armature_scale: [0.8, 1.2],
            gravity_scale: [0.9, 1.1],
            sensor_noise_position: 0.01,
            sensor_noise_velocity: 0.05,
            encoder_bias_rad: 0.0,
            control_noise: 0.05,
            action_delay_steps: [0, 3],
            push_interval_s: [0.1, 0.5],
            push_mps: [0.1, 0.5],
        },
        ..EnvironmentConfig::default()
    }
}

pub fn environment(config: &EnvironmentConfig) -> Environment {
    Environment::new(config, HUMANOID_XML).expect("valid")
}

/// Physics of a text with the default settings.
pub fn physics(xml: &str) -> Physics {
    Physics::new(Model::from_mjcf(xml).expect("valid"), &EnvConfig::default()).expect("valid")
}

/// Plays steps `from..to` of an episode and returns the bits of all their results.
pub fn play(environment: &mut Environment, from: u32, to: u32) -> Vec<u64> {
    let mut observation = vec![0.0; environment.observation_size()];
    let mut bits = Vec::new();
    for step in from..to {
        let action: [f32; 17] = std::array::from_fn(|motor| 0.4 * ((step * 31 + motor as u32 * 17) as f32).sin());
        let result = environment.step(&action, &mut observation);
        assert!(!result.fault);
        bits.extend(observation.iter().map(|number| u64::from(number.to_bits())));
        bits.push(u64::from(result.reward.to_bits()) << 2 | u64::from(result.truncated) << 1);
        let physics = environment.physics();
        bits.extend(physics.position().iter().chain(physics.velocity()).map(|number| number.to_bits()));
    }
    bits
}

pub fn reset(environment: &mut Environment, seed: u64) -> Vec<f32> {
    let mut observation = vec![0.0; environment.observation_size()];
    environment.reset(seed, &mut observation);
    observation
}

/// Bits of all observations and rewards of an episode of random actions, which continues after falls.
pub fn episode_bits(environment: &mut Environment, seed: u64, steps: u32) -> Vec<u32> {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut observation = reset(environment, seed);
    let mut bits: Vec<u32> = observation.iter().map(|number| number.to_bits()).collect();
    for _ in 0..steps {
        let action: [f32; 17] = std::array::from_fn(|_| random.random_range(-0.4..0.4));
        let step = environment.step(&action, &mut observation);
        bits.extend(observation.iter().map(|number| number.to_bits()));
        bits.push(step.reward.to_bits());
    }
    bits
}

/// Makes the root's velocity NaN, so that the next step faults.
pub fn poison(physics: &mut Physics) {
    let (position, mut velocity) = (physics.position().to_vec(), physics.velocity().to_vec());
    velocity[0] = f64::NAN;
    physics.set_state(&position, &velocity);
}
