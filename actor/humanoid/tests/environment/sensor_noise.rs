//! Sensor noise reaches every entry of an observation that depends on a noisy quantity.

use treadmill_humanoid::{
    EnvConfig,
    EnvObservation::{Compact, GymnasiumV4, GymnasiumV5},
    Environment, EnvironmentConfig, HUMANOID_XML, RandomisationConfig,
};

use crate::support::reset;

const NOISE: [f64; 2] = [0.02, 0.3];

/// Built-in model with servos instead of motors, so that torques depend on the hinges' angles and rates.
fn with_servos() -> String {
    let servos =
        HUMANOID_XML.replace("<motor ctrl", "<position kp=\"20\" kv=\"1\" ctrl").replace("<motor ", "<position ");
    [25, 100, 200, 300].iter().fold(servos, |xml, gear| xml.replace(&format!(" gear=\"{gear}\""), ""))
}

fn environment(
    observation: treadmill_humanoid::EnvObservation,
    xml: &str,
    [position, velocity]: [f64; 2],
) -> Environment {
    let config = EnvironmentConfig {
        env: EnvConfig { observation, terminate_when_unhealthy: false, ..EnvConfig::default() },
        randomisation: RandomisationConfig {
            sensor_noise_position: position,
            sensor_noise_velocity: velocity,
            ..RandomisationConfig::default()
        },
        ..EnvironmentConfig::default()
    };
    Environment::new(&config, xml).expect("valid")
}

/// Plays until feet and trunk have touched the floor. Returns the last observation, and the exact one of the same state.
fn observed(environment: &mut Environment) -> [Vec<f32>; 2] {
    let mut seen = reset(environment, 3);
    let mut exact = seen.clone();
    for step in 0..40u32 {
        let action: Vec<f32> =
            (0..environment.action_size()).map(|motor| 0.3 * ((step * 29 + motor as u32 * 13) as f32).sin()).collect();
        assert!(!environment.step(&action, &mut seen).fault);
    }
    assert!(environment.physics().squared_contact_wrenches() > 0.0, "no contact");
    environment.observe(&mut exact).expect("the right length");
    [seen, exact]
}

fn block(environment: &Environment, name: &str) -> Option<std::ops::Range<usize>> {
    environment.terms().iter().find(|block| block.name == name).map(|block| block.range.clone())
}

#[test]
fn every_entry_that_depends_on_a_noisy_quantity_is_noisy() {
    let servos = with_servos();
    for (xml, has_servos) in [(HUMANOID_XML, false), (&servos, true)] {
        for kind in [Compact, GymnasiumV5, GymnasiumV4] {
            let mut environment = environment(kind, xml, NOISE);
            let [seen, exact] = observed(&mut environment);
            let mut exempt: Vec<usize> = Vec::new();
            // Masses are known.
            exempt.extend(block(&environment, "cinert").into_iter().flat_map(|range| range.skip(9).step_by(10)));
            // Torques of plain motors depend on the action alone.
            if !has_servos {
                exempt.extend(block(&environment, "qfrc_actuator").into_iter().flatten());
            }
            let mut compared = 0;
            for (index, (seen, exact)) in seen.iter().zip(&exact).enumerate() {
                // The world's and the root's numbers of Humanoid-v4, and links without contact, are zeros.
                if exempt.contains(&index) || *exact == 0.0 {
                    assert_eq!(seen, exact, "{kind:?}: entry {index} has no noise");
                    continue;
                }
                assert_ne!(seen, exact, "{kind:?}: entry {index} shows the exact state");
                compared += 1;
            }
            let torques = if has_servos { 17 } else { 0 };
            assert!(
                compared >= if kind == Compact { 45 } else { 45 + 13 * 15 + torques + 6 },
                "{kind:?}: only {compared}"
            );
        }
    }
}

#[test]
fn derived_entries_are_those_of_the_noisy_state() {
    for kind in [GymnasiumV5, GymnasiumV4] {
        let mut noisy = environment(kind, HUMANOID_XML, NOISE);
        let [seen, _] = observed(&mut noisy);
        let mut shown = environment(kind, HUMANOID_XML, [0.0; 2]);
        let [x_m, y_m] = [noisy.physics().position()[0], noisy.physics().position()[1]];
        let numbers = seen[..45].iter().map(|number| f64::from(*number));
        let position: Vec<f64> = [x_m, y_m].into_iter().chain(numbers.clone().take(22)).collect();
        shown.physics_mut().set_state(&position, &numbers.skip(22).collect::<Vec<_>>());
        let mut wanted = vec![0.0; shown.observation_size()];
        shown.observe(&mut wanted).expect("the right length");
        for name in ["qpos", "qvel", "cinert", "cvel"] {
            for index in block(&noisy, name).expect("a block") {
                let (seen, wanted) = (seen[index], wanted[index]);
                assert!((seen - wanted).abs() < 2e-5 * (1.0 + wanted.abs()), "{name} {index}: {seen}, not {wanted}");
            }
        }
    }
}

#[test]
fn contact_forces_keep_their_size_and_turn_with_their_link() {
    let mut environment = environment(GymnasiumV5, HUMANOID_XML, NOISE);
    let [seen, exact] = observed(&mut environment);
    let rows = |numbers: &[f32], range: std::ops::Range<usize>| numbers[range].as_chunks::<6>().0.to_vec();
    let range = block(&environment, "cfrc_ext").expect("a block");
    let size = |row: &[f32; 6]| row[3..].iter().map(|part| part * part).sum::<f32>().sqrt();
    for (seen, exact) in rows(&seen, range.clone()).iter().zip(rows(&exact, range)) {
        assert!((size(seen) - size(&exact)).abs() < 1e-4 * (1.0 + size(&exact)), "{seen:?} {exact:?}");
    }
}

#[test]
fn either_noise_alone_reaches_the_derived_entries() {
    for (noise, blocks) in [([0.02, 0.0], &["cinert", "cvel", "cfrc_ext"][..]), ([0.0, 0.3], &["cvel"][..])] {
        let mut environment = environment(GymnasiumV5, HUMANOID_XML, noise);
        let [seen, exact] = observed(&mut environment);
        for name in blocks {
            let range = block(&environment, name).expect("a block");
            let noisiest = seen[range.clone()].iter().zip(&exact[range]).map(|(seen, exact)| (seen - exact).abs());
            assert!(noisiest.fold(0.0, f32::max) > 1e-3, "{noise:?}: {name}");
        }
    }
}

#[test]
fn without_noise_every_bit_is_exact() {
    for kind in [Compact, GymnasiumV5, GymnasiumV4] {
        // Other randomisation is on.
        let config = EnvironmentConfig {
            env: EnvConfig { observation: kind, terminate_when_unhealthy: false, ..EnvConfig::default() },
            randomisation: RandomisationConfig { mass_scale: [0.8, 1.2], ..RandomisationConfig::default() },
            ..EnvironmentConfig::default()
        };
        for mut environment in
            [environment(kind, HUMANOID_XML, [0.0; 2]), Environment::new(&config, HUMANOID_XML).expect("valid")]
        {
            let [seen, exact] = observed(&mut environment);
            assert!(seen.iter().zip(&exact).all(|(seen, exact)| seen.to_bits() == exact.to_bits()), "{kind:?}");
        }
    }
}
