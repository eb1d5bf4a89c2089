//! Saved episode states: an episode resumes bit for bit, and states that do not fit are refused.

use treadmill_humanoid::{EnvConfig, Environment, EnvironmentConfig, EpisodeState, StateError};

use crate::support::{environment, play, poison, randomised, reset};

fn plain() -> EnvironmentConfig {
    EnvironmentConfig::from(EnvConfig { terminate_when_unhealthy: false, ..EnvConfig::default() })
}

/// Returns everything that can be read without a step.
fn visible_state(environment: &mut Environment) -> String {
    let mut observation = vec![0.0; environment.observation_size()];
    environment.observe(&mut observation).expect("the right length");
    let physics = environment.physics();
    let wrenches: Vec<_> = (0..physics.model().links.len()).map(|link| physics.contact_wrench(link)).collect();
    format!(
        "{observation:?} {:?} {:?} {wrenches:?} {:?} {:?}",
        environment.info(),
        environment.episode_state(),
        physics.body_motions().collect::<Vec<_>>(),
        physics.joint_torques_nm(),
    )
}

#[test]
fn an_episode_resumes_from_its_state_bit_for_bit() {
    for config in [plain(), randomised()] {
        let mut original = environment(&config);
        let mut busy = environment(&config);
        reset(&mut busy, 99);
        play(&mut busy, 0, 70);
        // Just after a reset, at the first contacts, during the fall, and with many contacts on the floor.
        for at in [0, 2, 60, 150] {
            let mut last = reset(&mut original, 5);
            play(&mut original, 0, at);
            assert!(at < 150 || original.physics().squared_contact_wrenches() > 0.0, "there are no contacts at {at}");
            let state = original.episode_state().expect("the environment was reset");
            let wanted = play(&mut original, at, at + 250);

            let mut fresh = environment(&config);
            for other in [&mut fresh, &mut busy] {
                other.resume_episode(&state, &mut last).expect("of the same build");
                assert_eq!(last, state.observation);
                assert_eq!(Some(&state), other.episode_state().as_ref(), "a restored state can be saved again");
                assert_eq!(wanted, play(other, at, at + 250), "from {at}");
            }
            // The next episode does not depend on it.
            assert_eq!(reset(&mut original, 6), reset(&mut fresh, 6));
            assert_eq!(play(&mut original, 0, 60), play(&mut fresh, 0, 60));
        }
    }
}

#[test]
fn there_is_no_state_before_the_first_reset_nor_after_a_fault() {
    let mut environment = environment(&plain());
    assert_eq!(environment.episode_state(), None);
    let mut observation = reset(&mut environment, 1);
    let state = environment.episode_state().expect("the environment was reset");
    poison(environment.physics_mut());
    assert!(environment.step(&[0.0; 17], &mut observation).fault);
    assert_eq!(environment.episode_state(), None);
    environment.resume_episode(&state, &mut observation).expect("of the same build");
    assert_eq!(environment.episode_state(), Some(state));
}

#[test]
fn states_that_do_not_fit_are_refused_by_name_and_change_nothing() {
    let mut environment = environment(&randomised());
    reset(&mut environment, 2);
    play(&mut environment, 0, 20);
    let sound = environment.episode_state().expect("the environment was reset");
    play(&mut environment, 20, 25);
    let untouched = visible_state(&mut environment);
    type Change = fn(&mut EpisodeState);
    let changes: [(&str, Change); 7] = [
        ("position vector has the wrong length: 1 ", |s| s.position.truncate(1)),
        ("velocity vector has the wrong length: 24", |s| s.velocity.push(0.0)),
        ("observation vector has the wrong length", |s| s.observation.clear()),
        ("past actions vector has the wrong length", |s| s.past_actions.truncate(1)),
        ("the rate of hinge", |s| s.velocity[9] = f64::NAN),
        ("quaternion", |s| s.position[3..7].fill(0.0)),
        ("past actions[0]", |s| s.past_actions[0] = f32::INFINITY),
    ];
    let mut observation = vec![7.0; environment.observation_size()];
    for (part, change) in changes {
        let mut state = sound.clone();
        change(&mut state);
        let refusal: StateError = environment.resume_episode(&state, &mut observation).expect_err(part);
        assert!(refusal.to_string().contains(part), "{refusal}");
        assert_eq!(untouched, visible_state(&mut environment));
    }
    assert!(observation.iter().all(|entry| *entry == 7.0));
}
