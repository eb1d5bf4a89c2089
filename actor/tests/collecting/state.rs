//! Saved state of an actor: a process that restores it collects, bit for bit, the next fragments of the original.

use treadmill_actor::{environments::SeedSource, rollout::Collector};
use treadmill_humanoid::{EnvConfig, EnvObservation, EnvironmentConfig};
use treadmill_proto::{Fragment, Precision, fragment::TRUNCATED};

use crate::{environments, identity, policy, randomised};

/// Returns the collector of an actor process; each `start` draws other random numbers.
fn collector(
    precision: Precision,
    envs: usize,
    config: &EnvironmentConfig,
    name: &str,
    start: u64,
    threads: usize,
) -> Collector {
    let noise = SeedSource { run_seed: 1, actor: name.into(), start }.noise();
    let environments = environments(envs, config, name, start).with_precision(precision);
    let mut collector = Collector::new(environments, noise, identity(name)).with_threads(threads).unwrap();
    collector.attach_state();
    collector
}

/// Checks a fragment and removes the numbers that depend on the process.
fn comparable(fragment: Fragment) -> Fragment {
    fragment.check().unwrap();
    Fragment { sequence: 1, settled_through: 0, env_steps: 0, ..fragment }
}

#[test]
fn a_successor_continues_from_the_bytes_of_any_fragment() {
    let randomised = || EnvironmentConfig {
        env: EnvConfig { observation: EnvObservation::GymnasiumV5, ..randomised([0.8, 1.2]).env.clone() },
        ..randomised([0.8, 1.2])
    };
    let cases = [
        (EnvironmentConfig::default(), 45, Precision::F32),
        (randomised(), 348, Precision::F32),
        (randomised(), 348, Precision::F16),
    ];
    for (config, width, precision) in cases {
        let policy = policy(width);
        let mut original = collector(precision, 4, &config, "a", 2, 1);
        let fragments: Vec<Fragment> = (0..8).map(|_| original.collect(&policy, 16, 0).unwrap()).collect();
        assert!(fragments.iter().filter(|fragment| !fragment.episodes.is_empty()).count() > 2, "episodes end");
        let truncated = fragments.iter().flat_map(|fragment| &fragment.flags).any(|flags| flags & TRUNCATED != 0);
        assert_eq!(truncated, width == 348);
        for (at, threads) in [(0, 1), (3, 2), (5, 1)] {
            let bytes = fragments[at].encode_as(precision).unwrap();
            let state = Fragment::decode(bytes).unwrap().actor_state.unwrap();
            let mut successor = collector(precision, 4, &config, "a", 99, threads);
            successor.restore_state(&state).unwrap();
            for fragment in &fragments[at + 1..] {
                assert!(
                    comparable(successor.collect(&policy, 16, 0).unwrap()) == comparable(fragment.clone()),
                    "from {at}"
                );
            }
        }
    }
}

#[test]
fn after_an_unfit_state_all_begins_as_without_it() {
    let (config, policy) = (EnvironmentConfig::default(), policy(45));
    let collector = |envs, name, start| collector(Precision::F32, envs, &config, name, start, 1);
    let state = collector(3, "a", 2).collect(&policy, 16, 0).unwrap().actor_state.unwrap();
    let wanted = |envs, name| collector(envs, name, 7).collect(&policy, 16, 0).unwrap();
    let mut upside_down = state.clone();
    // The quaternion of the last environment, so that the others are restored before it fails.
    let at = upside_down.positions.len() / 3 * 2 + 3;
    upside_down.positions[at..at + 4].fill(0.0);
    let mut narrow = state.clone();
    narrow.velocities.truncate(3 * 22);
    for (state, envs, name, part) in [
        (&state, 4, "a", "the state has 3 environments, this actor has 4"),
        (&state, 3, "b", "the state is of actor `a`, this actor is `b`"),
        (&upside_down, 3, "a", "quaternion"),
        (&narrow, 3, "a", "velocity vector has the wrong length: 22 instead of 23"),
    ] {
        let mut collector = collector(envs, name, 7);
        let error = collector.restore_state(state).unwrap_err();
        assert!(error.contains(part), "{error}");
        assert!(collector.collect(&policy, 16, 0).unwrap() == wanted(envs, name), "{part}");
    }
}
