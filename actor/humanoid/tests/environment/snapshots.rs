//! Snapshots: a restored episode continues bit for bit, and snapshots of other models or settings are refused.

use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use treadmill_humanoid::{
    EnvConfig, Environment, EnvironmentConfig, HUMANOID_XML, Model, Physics, RandomisationConfig, SnapshotError,
};

use crate::support::{environment, play, randomised, reset};

#[test]
fn an_episode_continues_from_a_snapshot_bit_for_bit() {
    for config in
        [EnvironmentConfig::from(EnvConfig { terminate_when_unhealthy: false, ..EnvConfig::default() }), randomised()]
    {
        let mut original = environment(&config);
        let mut other = environment(&config);
        reset(&mut other, 99);
        play(&mut other, 0, 70);
        // Just after a reset, at the first contacts, during the fall, and with many contacts on the floor.
        for at in [0, 2, 60, 150] {
            reset(&mut original, 5);
            play(&mut original, 0, at);
            if at == 150 {
                assert!(original.physics().squared_contact_wrenches() > 0.0, "there are no contacts at {at}");
            }
            let snapshot = original.snapshot();
            let wanted = play(&mut original, at, at + 250);

            original.restore(&snapshot).expect("its own");
            assert_eq!(wanted, play(&mut original, at, at + 250), "in the same environment, from {at}");
            for seed in 0..3 {
                reset(&mut original, seed);
                play(&mut original, 0, 30);
            }
            original.restore(&snapshot).expect("its own");
            assert_eq!(wanted, play(&mut original, at, at + 250), "after resets, from {at}");
            other.restore(&snapshot).expect("of the same build");
            assert_eq!(wanted, play(&mut other, at, at + 250), "in another environment, from {at}");
        }
    }
}

#[test]
fn a_snapshot_changes_nothing_and_holds_the_last_results() {
    let mut plain = environment(&randomised());
    let mut watched = environment(&randomised());
    reset(&mut plain, 8);
    reset(&mut watched, 8);
    let wanted = play(&mut plain, 0, 60);
    let mut found = Vec::new();
    for step in 0..60 {
        let _ = watched.snapshot();
        found.extend(play(&mut watched, step, step + 1));
    }
    assert_eq!(wanted, found);

    let expected = format!("{:?} {:?}", watched.info(), watched.joint_quality());
    let (mut seen, mut seen_again) = (vec![0.0; watched.observation_size()], vec![0.0; watched.observation_size()]);
    watched.observe(&mut seen).expect("the right length");
    let snapshot = watched.snapshot();
    reset(&mut watched, 9);
    watched.restore(&snapshot).expect("its own");
    watched.observe(&mut seen_again).expect("the right length");
    assert_eq!(seen, seen_again);
    assert_eq!(expected, format!("{:?} {:?}", watched.info(), watched.joint_quality()));
    // A fault repeats the observation of the previous step, also after a restore.
    let mut last = vec![0.0; seen.len()];
    watched.step(&[0.1; 17], &mut last);
    let snapshot = watched.snapshot();
    reset(&mut watched, 10);
    watched.restore(&snapshot).expect("its own");
    watched.physics_mut().poison();
    let mut after = vec![0.0; seen.len()];
    assert!(watched.step(&[0.1; 17], &mut after).fault);
    assert_eq!(last, after);
}

#[test]
fn the_episode_after_a_restored_one_is_unchanged() {
    let config = randomised();
    let mut original = environment(&config);
    reset(&mut original, 1);
    play(&mut original, 0, 80);
    let snapshot = original.snapshot();
    // `set_state` keeps the episode's randomised body.
    let from_nominal = |environment: &mut Environment| {
        let position = environment.physics().model().nominal_position();
        environment.physics_mut().set_state(&position, &[0.0; 23]);
        play(environment, 0, 100)
    };
    let varied = from_nominal(&mut original);
    let first = reset(&mut original, 2);
    let wanted = play(&mut original, 0, 80);

    let mut other = environment(&config);
    other.restore(&snapshot).expect("of the same build");
    assert_eq!(first, reset(&mut other, 2));
    assert_eq!(wanted, play(&mut other, 0, 80));
    for environment in [&mut original, &mut other] {
        environment.restore(&snapshot).expect("of the same build");
        assert_eq!(varied, from_nominal(environment));
    }
}

#[test]
fn physics_alone_continues_from_a_snapshot_and_keeps_its_fault() {
    let build =
        || Physics::new(Model::from_mjcf(HUMANOID_XML).expect("valid"), &EnvironmentConfig::default()).expect("valid");
    let run = |physics: &mut Physics, seed: u64| {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        for _ in 0..120 {
            let controls: [f32; 17] = std::array::from_fn(|_| random.random_range(-0.4..0.4));
            physics.step_only(&controls).expect("finite");
        }
        [physics.position(), physics.velocity(), physics.joint_torques_nm()].concat()
    };
    let mut physics = build();
    run(&mut physics, 1);
    let snapshot = physics.snapshot();
    let state = [physics.position(), physics.velocity(), physics.joint_torques_nm()].concat();
    let wanted = run(&mut physics, 2);
    let mut fresh = build();
    fresh.restore(&snapshot).expect("of the same build");
    assert_eq!(state, [fresh.position(), fresh.velocity(), fresh.joint_torques_nm()].concat());
    assert_eq!(fresh.joint_quality(), {
        physics.restore(&snapshot).expect("its own");
        physics.joint_quality()
    });
    assert_eq!(wanted, run(&mut fresh, 2));

    physics.poison();
    assert!(physics.step_only(&[0.0; 17]).is_err());
    let faulty = physics.snapshot();
    fresh.restore(&faulty).expect("of the same build");
    assert!(fresh.step_only(&[0.0; 17]).is_err(), "a fault lasts until the next start");
    fresh.restore(&snapshot).expect("of the same build");
    assert_eq!(wanted, run(&mut fresh, 2));
}

#[test]
fn snapshots_of_other_models_and_settings_are_refused_by_name() {
    let config = EnvironmentConfig::default();
    let mut original = environment(&config);
    reset(&mut original, 3);
    play(&mut original, 0, 10);
    let snapshot = original.snapshot();

    let mut finer =
        environment(&EnvironmentConfig { env: EnvConfig { substeps: 3, ..config.env.clone() }, ..config.clone() });
    let untouched = reset(&mut finer, 4);
    let refusal = finer.restore(&snapshot).expect_err("other substeps");
    let wanted = SnapshotError::Setting { setting: "env.substeps".into(), taken: "4".into(), found: "3".into() };
    assert_eq!(refusal, wanted);
    assert!(refusal.to_string().contains("`env.substeps` = 4, but here it is 3"), "{refusal}");
    let mut seen = vec![0.0; finer.observation_size()];
    finer.observe(&mut seen).expect("the right length");
    assert_eq!(seen, untouched, "a refusal must change nothing");

    let randomisation = RandomisationConfig { push_mps: [0.0, 1.0], ..RandomisationConfig::default() };
    let result = environment(&EnvironmentConfig { randomisation, ..config.clone() }).restore(&snapshot);
    assert!(result.expect_err("other pushes").to_string().contains("`randomisation.push_mps`"));

    for (from, to, part) in [
        ("gear=\"300\"", "gear=\"301\"", "motor `right_hip_y`"),
        ("range=\"-45 45\"", "range=\"-45 46\"", "hinge `abdomen_z`"),
        ("size=\"0.049\"", "size=\"0.048\"", "link `right_shin`"),
        ("<option ", "<option gravity=\"0 0 -9.8\" ", "gravity"),
        ("friction=\"1 0.1 0.1\"", "friction=\"0.9 0.1 0.1\"", "ground"),
        (
            "</worldbody>",
            "</worldbody><contact><exclude body1=\"torso\" body2=\"left_shin\"/></contact>",
            "collision rules",
        ),
    ] {
        let xml = HUMANOID_XML.replace(from, to);
        assert_ne!(xml, HUMANOID_XML);
        let refusal = Environment::new(&config, &xml).expect("valid").restore(&snapshot).expect_err(part).to_string();
        assert!(refusal.contains(part), "{refusal}");
    }

    let model = Model::from_mjcf(HUMANOID_XML).expect("valid");
    let plain = Physics::new(model.clone(), &config).expect("valid").snapshot();
    type Change = fn(&mut EnvironmentConfig);
    let changes: [(&str, Change); 3] = [
        ("env.substeps", |c| c.env.substeps = 3),
        ("env.control_step_s", |c| c.env.control_step_s = 0.02),
        ("env.self_collision", |c| c.env.self_collision = false),
    ];
    for (name, change) in changes {
        let mut changed = config.clone();
        change(&mut changed);
        let refusal = Physics::new(model.clone(), &changed).expect("valid").restore(&plain).expect_err(name);
        assert!(refusal.to_string().contains(name), "{refusal}");
    }
    // Physics ignores settings that motion does not depend on.
    let other_task = EnvironmentConfig { env: EnvConfig { healthy_reward: 1.0, ..config.env.clone() }, ..config };
    assert!(Physics::new(model, &other_task).expect("valid").restore(&plain).is_ok());
}
