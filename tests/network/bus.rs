//! Other clients of the bus: receipts for their fragments, and subscriptions.

use crate::{attacks::sample, support::*};
use serde_json::Value;
use treadmill_bus::{Bus, observer::observe};
use treadmill_proto::{Fragment, Outcome, PolicyBundle, fragment::TERMINATED};

/// Returns a whole batch of the preset `smoke`: 512 episodes of one step.
pub fn batch(bundle: &PolicyBundle, actor: &str, sequence: u64) -> Fragment {
    let (steps, envs) = (64, 8);
    let rows = (steps * envs) as usize;
    let wavy = |count: usize| (0..count).map(|index| (index as f32 * 0.7).sin()).collect::<Vec<f32>>();
    let observations = wavy(rows * bundle.observation_size as usize);
    let actions = wavy(rows * bundle.action_size as usize);
    Fragment {
        steps,
        envs,
        log_probs: sample::log_probs(bundle, &observations, &actions),
        observations,
        actions,
        rewards: vec![1.0; rows],
        flags: vec![TERMINATED; rows],
        last_observations: vec![],
        ..sample::fragment(bundle, actor, sequence)
    }
}

/// Run that trains until the end of the test, and a client of its bus.
struct Fixture {
    training: Running,
    bus: Bus,
    _folder: tempfile::TempDir,
    run: std::path::PathBuf,
}

fn start() -> Fixture {
    let (folder, run) = folders();
    let training = start_endless(folder.path(), &run, "train", &[]);
    let bus = join(&run);
    Fixture { training, bus, _folder: folder, run }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_refused_fragment_gets_a_receipt_with_the_reason_and_training_continues() {
    let fixture = start();
    let send = |fragment: Vec<u8>| deliver(&fixture.bus, "stranger", fragment);
    let bundle = policy(&fixture.bus).await;
    let good = sample::fragment(&bundle, "stranger", 1);

    let receipt = send(Fragment { run: "other".into(), ..good.clone() }.encode().unwrap()).await;
    assert_eq!(receipt.outcome, Outcome::Malformed);
    assert!(receipt.reason.contains("`run` is `other`; expected `run`"), "{}", receipt.reason);

    let wide = Fragment {
        observation_size: 46,
        observations: vec![0.0; 46],
        last_observations: vec![0.0; 46],
        ..good.clone()
    };
    let receipt = send(wide.encode().unwrap()).await;
    assert!(receipt.reason.contains("`observation_size` is 46; expected 45"), "{}", receipt.reason);

    let mut torn = good.encode().unwrap();
    torn.truncate(torn.len() / 2);
    assert_eq!(send(torn).await.outcome, Outcome::Malformed);

    let vanished = treadmill_proto::PolicyVersion::new(99, 1);
    let receipt = send(Fragment { version: vanished, ..good.clone() }.encode().unwrap()).await;
    assert_eq!(receipt.outcome, Outcome::Vanished);

    // A valid fragment is accepted once.
    let fresh = policy(&fixture.bus).await;
    let valid = sample::fragment(&fresh, "stranger", 2).encode().unwrap();
    let first = send(valid.clone()).await;
    assert!(matches!(first.outcome, Outcome::Accepted | Outcome::TooOld), "{first:?}");
    assert_eq!(send(valid).await.outcome, Outcome::Duplicate);

    await_that("the count of malformed fragments", || {
        last_value(&fixture.run, "bus/fragments_malformed").filter(|count| *count == 3.0)
    });
    let steps = metrics(&fixture.run).last().unwrap().1;
    await_steps(&fixture.run, steps + 2048);
    stop(fixture.training);
}

#[tokio::test(flavor = "multi_thread")]
async fn clients_can_subscribe_to_every_scalar_and_episode() {
    let fixture = start();
    let metrics_feed = observe(&fixture.bus, "treadmill/*/metrics/**", 4096).unwrap();
    let one = observe(&fixture.bus, "treadmill/run/metrics/rollout/ep_rew_mean", 16).unwrap();
    let episodes = observe(&fixture.bus, "treadmill/run/episodes/*", 4096).unwrap();

    let message = metrics_feed.next(TIMEOUT).expect("a metric");
    let metric: Value = serde_json::from_slice(&message.payload).unwrap();
    assert_eq!(message.key, format!("treadmill/run/metrics/{}", metric["tag"].as_str().unwrap()));
    assert_eq!(metric["run"], "run");
    assert!(metric["step"].is_u64() && metric["value"].is_number() && metric["time_unix_s"].is_f64(), "{metric}");

    let reward: Value = serde_json::from_slice(&one.next(TIMEOUT).expect("the reward").payload).unwrap();
    assert_eq!(reward["tag"], "rollout/ep_rew_mean");

    let episode: Value = serde_json::from_slice(&episodes.next(TIMEOUT).expect("an episode").payload).unwrap();
    for field in ["return", "length", "distance_m", "velocity_mean_mps"] {
        assert!(episode[field].is_number(), "{field} in {episode}");
    }
    assert_eq!(episode["cause"], "fell");
}
