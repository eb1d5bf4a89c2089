//! Checkpoints of format 3 are read.
//!
//! `golden/format-3.bundle` was written by the last version with that format:
//!
//! ```sh
//! treadmill train --preset smoke --deterministic --seed 7 --envs 2 --steps 640 --set ppo.batch=64 --set ppo.minibatch=32 \
//!     --set rollout.fragment_steps=8 --set 'policy.hidden=[2]' --set env.max_episode_steps=5
//! ```
//!
//! The expected values are those that this version wrote to its metrics, its accounts and its exported policy.

use treadmill_learner::{
    checkpoint::{self, TrainingState, encoding},
    intake::FragmentCounts,
};

const GOLDEN: &[u8] = include_bytes!("golden/format-3.bundle");

fn golden() -> TrainingState {
    checkpoint::decode("golden", GOLDEN).unwrap()
}

#[test]
fn format_3_decodes_to_the_same_values() {
    assert_eq!(GOLDEN[8], 3, "the golden file is of another format");
    let state = golden();
    state.check().unwrap();

    assert_eq!(state.run, "run");
    assert_eq!(state.model_xml.len(), 6896);
    let config = state.config().unwrap();
    assert_eq!((config.run.seed, config.run.deterministic, config.ppo.batch), (7, true, 64));
    assert_eq!((state.shape.observation, state.shape.action, &state.shape.hidden[..]), (45, 17, &[2][..]));
    let counters = state.counters;
    assert_eq!((counters.env_steps, counters.updates, counters.gradient_steps), (640, 10, 40));
    assert_eq!((counters.undone_updates, counters.restarts, counters.resumes), (0, 0, 0));
    assert!(counters.wall_s > 0.1 && counters.wall_s < 0.3, "{}", counters.wall_s);
    assert_eq!(state.fragment_counts, FragmentCounts { accepted: 40, ..FragmentCounts::default() });
    assert_eq!(state.lineage.newest().number, 10);
    let process = state.ledger.processes().next().unwrap();
    assert_eq!((&process.actor[..], process.incarnation), ("actor-0", 3_439_449_834_035_316_046));
    assert_eq!((process.through, process.newest, process.account.env_steps), (40, 40, 640));

    let means = state.episodes.means().unwrap();
    assert_eq!((means.return_mean, means.length_mean), (24.588_672_680_854_8, 5.0));
    assert_eq!((means.distance_mean_m, means.fall_fraction), (-0.005_906_643_350_459_650_5, 0.0));
    assert_eq!((state.episodes.finished, state.episodes.faults), (128, 0));
    assert_eq!((state.best_return, state.best_is_evaluated), (Some(24.588_672_680_854_8), false));

    // Sums over the exported tensors, and their first numbers.
    let sum = |numbers: &[f32]| numbers.iter().map(|number| f64::from(*number)).sum::<f64>();
    let squares: f64 = state.ppo.parameters().iter().map(|number| f64::from(*number).powi(2)).sum();
    assert!((sum(state.ppo.parameters()) - -9.967_506_070_213_858).abs() < 1e-9);
    assert!((squares - 13.352_255_335_171_14).abs() < 1e-9);
    assert_eq!(state.ppo.parameters()[0], 0.160_846_59);
    assert!((sum(&state.ppo.parameters()[state.shape.log_std()]) - -8.568_487_852_811_813).abs() < 1e-9);
    assert_eq!((state.ppo.learning_rate(), state.ppo.gradient_steps()), (1e-3, 40));
    assert_eq!(state.ppo.observation_moments().count, 640.0);
    assert_eq!(state.ppo.observation_moments().mean[..2], [1.391_954_989_545_047_4, 0.999_697_638_582_438_3]);
    let actor = state.actor_state.as_ref().unwrap();
    assert_eq!((&actor.actor[..], actor.envs()), ("actor-0", 2));

    // Numbers that format 3 lacks: at least what was learnt from was simulated.
    assert_eq!((counters.env_steps_simulated, counters.env_steps_undone, state.physics_version), (640, 0, 0));
}

#[test]
fn a_state_of_format_3_is_saved_in_the_format_of_now() {
    let state = golden();
    let encoded = encoding::encode(&state).unwrap();
    assert_eq!(u32::from(encoded[8]), encoding::FORMAT);
    assert_eq!(checkpoint::decode("now", &encoded).unwrap(), state);
}

#[test]
fn an_older_physics_begins_new_episodes_and_a_newer_one_is_refused() {
    let mut state = golden();
    state.adopt_physics(1).unwrap();
    assert!(state.actor_state.is_some() && state.physics_version == 1, "before there were versions, there was one");
    state.adopt_physics(2).unwrap();
    assert!(state.actor_state.is_none() && state.physics_version == 2);
    assert_eq!(state.bundle(&state.config().unwrap(), 0).unwrap().physics_version, 2);
    let why = state.adopt_physics(1).unwrap_err();
    assert!(why.contains("simulates physics 1") && why.contains("has physics 2"), "{why}");
    assert_eq!(state.physics_version, 2);
}
