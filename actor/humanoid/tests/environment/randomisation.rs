//! Randomised episodes: the ranges of drawn quantities, and their effects on motion, actions and observations.

use treadmill_humanoid::{EnvConfig, Environment, EnvironmentConfig, HUMANOID_XML, RandomisationConfig};

use crate::support::{self, episode_bits, poison, randomised};

const SIZE: usize = 45;

fn environment(randomisation: RandomisationConfig) -> Environment {
    support::environment(&EnvironmentConfig { randomisation, ..EnvironmentConfig::default() })
}

/// Environment without gravity, start noise, contacts or end, in which only randomisation acts.
fn floating(randomisation: RandomisationConfig) -> Environment {
    let config = EnvironmentConfig {
        env: EnvConfig {
            reset_noise_scale: 0.0,
            terminate_when_unhealthy: false,
            max_episode_steps: 1_000_000,
            ..EnvConfig::default()
        },
        randomisation,
        ..EnvironmentConfig::default()
    };
    let xml = HUMANOID_XML.replace("<option ", "<option gravity=\"0 0 0\" ");
    Environment::new(&config, &xml).expect("valid")
}

fn everything() -> RandomisationConfig {
    RandomisationConfig { kp_scale: [0.9, 1.1], kd_scale: [0.9, 1.1], com_offset_m: 0.02, ..randomised().randomisation }
}

fn first_observation(randomisation: RandomisationConfig, seed: u64) -> [f32; SIZE] {
    let mut observation = [0.0; SIZE];
    environment(randomisation).reset(seed, &mut observation);
    observation
}

fn standard_deviation(samples: &[f64]) -> f64 {
    let mean = samples.iter().sum::<f64>() / samples.len() as f64;
    (samples.iter().map(|sample| (sample - mean).powi(2)).sum::<f64>() / samples.len() as f64).sqrt()
}

#[test]
fn an_episode_depends_on_its_seed_only() {
    let mut all = [RandomisationConfig::default(), everything()].map(|randomisation| {
        let fresh = episode_bits(&mut environment(randomisation.clone()), 7, 200);
        let mut used = environment(randomisation);
        for (seed, steps) in [(1, 300), (2, 1), (3, 57)] {
            episode_bits(&mut used, seed, steps);
        }
        poison(used.physics_mut());
        episode_bits(&mut used, 4, 2);
        assert_eq!(fresh, episode_bits(&mut used, 7, 200));
        assert_ne!(fresh, episode_bits(&mut used, 8, 200));
        fresh
    });
    all.sort();
    assert_ne!(all[0], all[1]);
}

#[test]
fn randomisation_without_effect_leaves_every_bit_unchanged() {
    let plain = episode_bits(&mut environment(RandomisationConfig::default()), 7, 100);
    let never = RandomisationConfig {
        push_interval_s: [1000.0, 1000.0],
        push_mps: [1.0, 1.0],
        ..RandomisationConfig::default()
    };
    assert!(never.is_on());
    assert_eq!(plain, episode_bits(&mut environment(never), 7, 100));
}

#[test]
fn a_drawn_quantity_does_not_depend_on_other_randomisation() {
    let noise = || RandomisationConfig { sensor_noise_position: 0.01, ..RandomisationConfig::default() };
    let plain = first_observation(noise(), 3);
    let beside = RandomisationConfig { sensor_noise_velocity: 0.0, ..everything() };
    assert_eq!(plain, first_observation(beside, 3));
    let drawn = |randomisation: RandomisationConfig| {
        let mut environment = environment(randomisation);
        environment.reset(3, &mut [0.0; SIZE]);
        environment.physics().model().bodies.iter().map(|body| body.mass_kg).collect::<Vec<f64>>()
    };
    let masses = RandomisationConfig { mass_scale: [0.8, 1.2], ..RandomisationConfig::default() };
    assert_eq!(drawn(masses), drawn(everything()));
}

#[test]
fn each_episode_draws_a_new_body_from_the_whole_ranges() {
    let mut environment = environment(everything());
    let nominal = environment.physics().model().clone();
    let mut reached = [[f64::INFINITY, f64::NEG_INFINITY]; 6];
    for seed in 0..200 {
        environment.reset(seed, &mut [0.0; SIZE]);
        let model = environment.physics().model();
        let mut note = |quantity: usize, factor: f64| {
            let [low, high] = &mut reached[quantity];
            (*low, *high) = (low.min(factor), high.max(factor));
        };
        for (body, nominal) in model.bodies.iter().zip(&nominal.bodies) {
            note(0, body.mass_kg / nominal.mass_kg);
            assert!(
                (body.inertia_kgm2.trace() / nominal.inertia_kgm2.trace() * nominal.mass_kg / body.mass_kg - 1.0).abs()
                    < 1e-9
            );
        }
        note(1, model.ground.friction / nominal.ground.friction);
        for (motor, nominal) in model.motors.iter().zip(&nominal.motors) {
            note(2, motor.gear_nm / nominal.gear_nm);
        }
        for (hinge, nominal) in model.hinges.iter().zip(&nominal.hinges) {
            note(3, hinge.damping_nmsprad / nominal.damping_nmsprad);
            note(4, hinge.armature_kgm2 / nominal.armature_kgm2);
        }
        note(5, model.gravity_mps2.z / nominal.gravity_mps2.z);
    }
    let all = everything();
    let ranges = [
        all.mass_scale,
        all.floor_friction_scale,
        all.motor_scale,
        all.damping_scale,
        all.armature_scale,
        all.gravity_scale,
    ];
    for (quantity, ([low, high], [min, max])) in reached.into_iter().zip(ranges).enumerate() {
        let margin = 0.03 * (max - min);
        let rounding = 1e-9;
        assert!((min - rounding..min + margin).contains(&low), "quantity {quantity} goes down to {low}");
        assert!((max - margin..max + rounding).contains(&high), "quantity {quantity} goes up to {high}");
    }
}

#[test]
fn a_delayed_action_acts_later_but_its_cost_counts_at_once() {
    for delay in 0..=RandomisationConfig::DELAY_MAX_STEPS {
        let mut delayed =
            environment(RandomisationConfig { action_delay_steps: [delay, delay], ..RandomisationConfig::default() });
        let mut plain = environment(RandomisationConfig::default());
        let (mut seen, mut expected) = ([0.0; SIZE], [0.0; SIZE]);
        for seed in [5, 6] {
            delayed.reset(seed, &mut seen);
            plain.reset(seed, &mut expected);
            let action = |step: u32| [0.02 * (step % 20) as f32; 17];
            for step in 0..12 {
                delayed.step(&action(step + 1), &mut seen);
                let info = delayed.info().unwrap();
                let arrived = (step + 1).checked_sub(delay).map_or([0.0; 17], action);
                plain.step(&arrived, &mut expected);
                assert_eq!(seen, expected, "delay {delay}, step {step}");
                let charge = -0.1 * 17.0 * f64::from(action(step + 1)[0]).powi(2);
                assert!((info.reward_ctrl - charge).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn delays_are_drawn_from_the_whole_range() {
    let mut environment =
        floating(RandomisationConfig { action_delay_steps: [1, 3], ..RandomisationConfig::default() });
    let mut count = [0; 5];
    for seed in 0..60 {
        environment.reset(seed, &mut [0.0; SIZE]);
        let arrives = (0..5).position(|_| {
            environment.step(&[0.4; 17], &mut [0.0; SIZE]);
            environment.physics().joint_torques_nm().iter().any(|torque| *torque != 0.0)
        });
        count[arrives.expect("an action arrives within 5 steps")] += 1;
    }
    assert!(count[0] == 0 && count[4] == 0 && count[1..4].iter().all(|&times| times > 8), "{count:?}");
}

#[test]
fn a_bad_action_is_a_fault_despite_a_delay_and_repeats_the_last_noisy_observation() {
    let mut environment = environment(RandomisationConfig { action_delay_steps: [3, 3], ..everything() });
    let mut observation = [0.0; SIZE];
    environment.reset(1, &mut observation);
    for bad in [f32::INFINITY, f32::NEG_INFINITY, f32::NAN] {
        environment.step(&[0.1; 17], &mut observation);
        let last = observation;
        let mut action = [0.0; 17];
        action[4] = bad;
        let step = environment.step(&action, &mut observation);
        assert!(step.fault && step.terminated && observation == last, "{bad}");
        assert!(environment.step(&[0.0; 17], &mut observation).fault, "a fault lasts until the reset");
        environment.reset(2, &mut observation);
        assert!(!environment.step(&[0.0; 17], &mut observation).fault);
    }
}

#[test]
fn sensor_noise_has_its_width_and_affects_observations_only() {
    let noise = RandomisationConfig {
        sensor_noise_position: 0.02,
        sensor_noise_velocity: 0.3,
        ..RandomisationConfig::default()
    };
    let (mut noisy, mut plain) = (floating(noise), floating(RandomisationConfig::default()));
    let (mut seen, mut truth) = ([0.0; SIZE], [0.0; SIZE]);
    let mut samples = vec![Vec::new(); SIZE];
    for seed in 0..300 {
        noisy.reset(seed, &mut seen);
        plain.reset(seed, &mut truth);
        for _ in 0..5 {
            for (samples, (seen, truth)) in samples.iter_mut().zip(seen.iter().zip(&truth)) {
                samples.push(f64::from(seen - truth));
            }
            let norm: f32 = seen[1..5].iter().map(|part| part * part).sum();
            assert!((norm - 1.0).abs() < 1e-5, "a quaternion of norm {norm}");
            let (step, same) = (noisy.step(&[0.1; 17], &mut seen), plain.step(&[0.1; 17], &mut truth));
            assert_eq!((step.reward, noisy.info()), (same.reward, plain.info()), "the simulation is the same");
        }
    }
    for (index, samples) in samples.iter().enumerate() {
        let expected = match index {
            // w of an upright torso hardly changes; x, y, z change by half the angle.
            1 => continue,
            2..5 => 0.01,
            0 | 5..22 => 0.02,
            _ => 0.3,
        };
        let found = standard_deviation(samples);
        assert!((found / expected - 1.0).abs() < 0.1, "entry {index}: {found} instead of {expected}");
    }
}

#[test]
fn every_observation_kind_has_the_same_noise_on_positions_and_velocities() {
    use treadmill_humanoid::EnvObservation::{Compact, GymnasiumV4, GymnasiumV5};
    let noise = RandomisationConfig {
        sensor_noise_position: 0.02,
        sensor_noise_velocity: 0.3,
        ..RandomisationConfig::default()
    };
    let seen = |observation, exclude_current_positions_from_observation, randomisation| {
        let env = EnvConfig { observation, exclude_current_positions_from_observation, ..EnvConfig::default() };
        let config = EnvironmentConfig { env, randomisation, ..EnvironmentConfig::default() };
        support::reset(&mut support::environment(&config), 3)
    };
    let expected = seen(Compact, true, noise.clone());
    for kind in [Compact, GymnasiumV5, GymnasiumV4] {
        for (skipped, excluded) in [(0, true), (2, false)] {
            let (noisy, plain) =
                (seen(kind, excluded, noise.clone()), seen(kind, excluded, RandomisationConfig::default()));
            assert_eq!(noisy[..skipped], plain[..skipped], "x and y have no noise");
            assert_eq!(noisy[skipped..skipped + SIZE], expected[..], "{kind:?}: the same noise on the same numbers");
        }
    }
}

#[test]
fn control_noise_has_its_width_at_the_motors_and_no_cost() {
    let mut environment = floating(RandomisationConfig { control_noise: 0.1, ..RandomisationConfig::default() });
    environment.reset(1, &mut [0.0; SIZE]);
    let motors = environment.physics().model().motors.clone();
    let mut samples = vec![Vec::new(); motors.len()];
    for _ in 0..1500 {
        environment.step(&[0.0; 17], &mut [0.0; SIZE]);
        assert_eq!(environment.info().unwrap().reward_ctrl, 0.0);
        for (samples, motor) in samples.iter_mut().zip(&motors) {
            samples.push(environment.physics().joint_torques_nm()[motor.hinge] / motor.gear_nm);
        }
    }
    for samples in samples {
        // A tenth of the limit of 0.4.
        assert!((standard_deviation(&samples) / 0.04 - 1.0).abs() < 0.08);
    }
}

#[test]
fn pushes_come_at_their_interval_with_their_speed_in_any_direction() {
    let pushes =
        RandomisationConfig { push_interval_s: [0.3, 0.3], push_mps: [0.8, 0.8], ..RandomisationConfig::default() };
    let mut environment = floating(pushes);
    let mut directions = Vec::new();
    for seed in 0..20 {
        environment.reset(seed, &mut [0.0; SIZE]);
        let mut before = environment.physics().centre_of_mass_velocity();
        for step in 0..70 {
            environment.step(&[0.0; 17], &mut [0.0; SIZE]);
            let after = environment.physics().centre_of_mass_velocity();
            let change = after - before;
            before = after;
            // 0.3 s are 20 steps: pushed before the 21st, the 41st and the 61st.
            if step > 0 && step % 20 == 0 {
                assert!((change.norm() - 0.8).abs() < 1e-3 && change.z.abs() < 1e-3, "{change} at step {step}");
                directions.push(change.y.atan2(change.x));
            } else {
                assert!(change.norm() < 1e-3, "{change} at step {step}");
            }
        }
    }
    assert_eq!(directions.len(), 60);
    for quadrant in 0..4 {
        let from = f64::from(quadrant - 2) * std::f64::consts::FRAC_PI_2;
        let there = directions.iter().filter(|angle| (from..from + std::f64::consts::FRAC_PI_2).contains(*angle));
        assert!(there.count() > 4, "no pushes towards quadrant {quadrant}");
    }
}

#[test]
fn invalid_ranges_are_refused() {
    let config = EnvironmentConfig {
        randomisation: RandomisationConfig { damping_scale: [2.0, 1.0], ..RandomisationConfig::default() },
        ..EnvironmentConfig::default()
    };
    let error = Environment::new(&config, HUMANOID_XML).err().expect("refused").to_string();
    assert!(error.contains("`randomisation.damping_scale` is [2.0, 1.0]"), "{error}");
}
