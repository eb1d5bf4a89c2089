//! Episodes: resets, rewards, faults, time limits.

use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use treadmill_humanoid::{EnvConfig, EnvironmentConfig, StepOutcome};

use crate::support::{environment, poison, reset};

/// Length of the compact observation.
const SIZE: usize = 45;

#[test]
fn sizes_are_those_of_the_humanoid() {
    let environment = environment(&EnvironmentConfig::default());
    assert_eq!(environment.observation_size(), SIZE);
    assert_eq!(environment.action_size(), 17);
    assert_eq!(environment.action_ranges(), [[-0.4, 0.4]; 17]);
    assert_eq!(environment.control_step_s(), 0.015);
}

#[test]
fn resets_use_the_whole_range_of_the_noise() {
    let mut environment = environment(&EnvironmentConfig::default());
    let mut observation = [0.0; SIZE];
    let mut largest = [0.0f32; SIZE];
    for seed in 0..300 {
        environment.reset(seed, &mut observation);
        let mut nominal = [0.0; SIZE];
        nominal[..2].copy_from_slice(&[1.4, 1.0]);
        for (index, largest) in largest.iter_mut().enumerate() {
            *largest = largest.max((observation[index] - nominal[index]).abs());
        }
        let norm: f32 = observation[1..5].iter().map(|part| part * part).sum();
        assert!((norm - 1.0).abs() < 1e-6);
    }
    for (index, &largest) in largest.iter().enumerate() {
        assert!(largest < 0.010_2, "entry {index} is off by {largest}");
        // w of the quaternion is 1 again after normalisation.
        assert!(index == 1 || largest > 0.009, "entry {index} never moves further than {largest}");
    }
}

#[test]
fn the_control_cost_uses_the_action_as_given() {
    let mut environment = environment(&EnvironmentConfig::default());
    let mut observation = reset(&mut environment, 0);
    environment.step(&[0.8; 17], &mut observation);
    // 0.1 × 17 × 0.8².
    assert!((environment.info().unwrap().reward_ctrl + 1.088).abs() < 1e-6);
    // The motion is that of the clamped action, as in MuJoCo.
    let position = environment.physics().position().to_vec();
    environment.reset(0, &mut observation);
    environment.step(&[0.4; 17], &mut observation);
    assert!((environment.info().unwrap().reward_ctrl + 0.272).abs() < 1e-6);
    assert_eq!(environment.physics().position(), position);
}

#[test]
fn a_fall_terminates_and_a_time_limit_truncates() {
    let mut falling = environment(&EnvironmentConfig::default());
    let mut observation = reset(&mut falling, 0);
    let mut steps = 0;
    let last: StepOutcome = loop {
        let step = falling.step(&[0.0; 17], &mut observation);
        steps += 1;
        if step.terminated || steps == 200 {
            break step;
        }
        assert!(falling.info().unwrap().reward_survive == 5.0 && !step.truncated);
    };
    assert!(last.terminated && !last.truncated && !last.fault);
    assert!(falling.physics().torso_height_m() <= 1.0);
    assert_eq!(falling.info().unwrap().reward_survive, 0.0);
    assert!((5..150).contains(&steps), "fell after {steps} steps");

    let mut short = environment(&EnvironmentConfig::from(EnvConfig { max_episode_steps: 3, ..EnvConfig::default() }));
    for _ in 0..2 {
        short.reset(0, &mut observation);
        let ends: Vec<bool> = (0..3).map(|_| short.step(&[0.0; 17], &mut observation).truncated).collect();
        assert_eq!(ends, [false, false, true]);
    }
}

#[test]
fn a_fault_repeats_the_last_finite_observation() {
    let mut environment = environment(&EnvironmentConfig::default());
    let mut observation = reset(&mut environment, 5);
    environment.step(&[0.1; 17], &mut observation);
    let last = observation.clone();
    poison(environment.physics_mut());
    for _ in 0..2 {
        observation.fill(9.0);
        let step = environment.step(&[0.1; 17], &mut observation);
        assert!(step.fault && step.terminated && !step.truncated);
        assert_eq!(step.reward, 0.0);
        assert_eq!(observation, last);
        assert!(environment.info().unwrap().x_position_m.is_finite());
    }
    environment.reset(6, &mut observation);
    let step = environment.step(&[0.1; 17], &mut observation);
    assert!(!step.fault && !step.terminated);
    assert!(observation.iter().all(|number| number.is_finite()));
}

#[test]
#[should_panic(expected = "action has the wrong length")]
fn an_action_of_the_wrong_length_panics() {
    environment(&EnvironmentConfig::default()).step(&[0.0; 16], &mut [0.0; SIZE]);
}

#[test]
#[should_panic(expected = "observation buffer has the wrong length")]
fn an_observation_of_the_wrong_length_panics() {
    environment(&EnvironmentConfig::default()).reset(0, &mut [0.0; 44]);
}

/// Sorts the samples and returns their quantile.
fn quantile(samples: &mut [f64], fraction: f64) -> f64 {
    samples.sort_by(f64::total_cmp);
    samples[((samples.len() - 1) as f64 * fraction) as usize]
}

#[test]
fn joints_hold_under_maximal_random_torques() {
    let mut environment = environment(&EnvironmentConfig::from(EnvConfig {
        terminate_when_unhealthy: false,
        max_episode_steps: 1_000_000,
        ..EnvConfig::default()
    }));
    let mut random = Xoshiro256PlusPlus::seed_from_u64(11);
    let mut observation = reset(&mut environment, 11);
    let mut overshoots = Vec::new();
    for count in 0..12_000u64 {
        let action: [f32; 17] = std::array::from_fn(|_| if random.random() { 0.4 } else { -0.4 });
        let step = environment.step(&action, &mut observation);
        assert!(!step.fault && observation.iter().all(|number| number.is_finite()));
        overshoots.push(environment.physics().limit_overshoot_rad());
        // In the second half it restarts after each fall; in the first half it flails on the floor.
        if count > 6000 && environment.physics().torso_height_m() < 1.0 {
            environment.reset(count, &mut observation);
        }
    }
    let overshoot_rad = quantile(&mut overshoots, 0.999);
    // Limits are as soft as MuJoCo's, whose fourth-order integrator gives 0.32 rad here, and 0.42 rad at most.
    assert!(overshoot_rad < 0.45, "hinges leave their range by {overshoot_rad} rad");
}
