//! External tasks: actors register them, the learner trains them, other tasks are refused by name.

use std::{fs, path::Path};

use crate::{bus::batch, support::*};
use treadmill_bus::{Bus, Role, actor::register_task};
use treadmill_config::ConfigSource;
use treadmill_learner::checkpoint::load_file;
use treadmill_proto::{
    EndCause, Episode, Fragment, Outcome, PolicyBundle, Receipt, Task, TaskReceipt, TaskRegistration,
};

fn task() -> Task {
    Task {
        name: "test/Count-v0".into(),
        observation_size: 3,
        action_size: 2,
        action_low: vec![-3.0, 0.0],
        action_high: vec![1.0, 2.0],
        control_step_s: 0.5,
        observation_mirror: vec![],
        action_mirror: vec![],
    }
}

fn learner(folder: &Path, run: &Path, more: &[&str]) -> Running {
    let mut args = [&["learner", "--listen", "tcp/127.0.0.1:0"], more].concat();
    if !more.contains(&"--resume") {
        // One update for each fragment.
        args.extend(["--preset", "smoke", "--set", "learner.mode=sync", "--run-dir", run.to_str().unwrap()]);
    }
    start(folder, &args)
}

async fn register(bus: &Bus, actor: &str, task: &Task) -> TaskReceipt {
    let registration = TaskRegistration { run: "run".into(), actor: actor.into(), task: task.clone() };
    until_answered(|| register_task(bus, &registration, TIMEOUT)).await
}

/// Returns a whole batch with its episodes.
fn fragment(bundle: &PolicyBundle, sequence: u64) -> Fragment {
    let episode = Episode {
        return_sum: 1.0,
        length: 1,
        distance_m: 0.0,
        velocity_mean_mps: 0.0,
        cause: EndCause::Terminated,
        ground_kind: None,
        ground_level: None,
        command_factor: None,
        failed_step: None,
    };
    let batch = batch(bundle, "count-1", sequence);
    Fragment { episodes: vec![episode; batch.rewards.len()], ..batch }
}

async fn send(bus: &Bus, fragment: &Fragment) -> Receipt {
    deliver(bus, &fragment.actor, fragment.encode().unwrap()).await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_task_needs_a_valid_name_and_may_be_as_large_as_the_networks_allow() {
    let (folder, run) = folders();
    let training = learner(folder.path(), &run, &["--task", "external", "--steps", "1024"]);
    training.wait_for("python -m treadmill_actor");
    let bus = join(&run);

    let invalid = Task { name: "no\nname".into(), ..task() };
    let unchecked = TaskRegistration { run: "run".into(), actor: "count-1".into(), task: invalid };
    assert!(unchecked.encode().is_err(), "it cannot be sent");
    let huge = register(&bus, "count-1", &Task { observation_size: 4096, ..task() }).await;
    assert!(huge.accepted, "4096 observations fit the networks of `smoke`: {}", huge.reason);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_task_that_does_not_fit_the_first_policy_is_refused_and_the_learner_waits_on() {
    let (folder, run) = folders();
    let humanoid = folder.path().join("humanoid");
    trained(folder.path(), &humanoid);
    let more = ["--task", "external", "--steps", "1024", "--init-from", humanoid.to_str().unwrap()];
    let training = learner(folder.path(), &run, &more);
    let bus = join(&run);
    let refused = register(&bus, "count-1", &task()).await;
    assert!(!refused.accepted && refused.reason.contains("45 observations"), "{}", refused.reason);
    let (low, high) = (vec![-1.0; 17], vec![1.0; 17]);
    let fitting = Task { observation_size: 45, action_size: 17, action_low: low, action_high: high, ..task() };
    let accepted = register(&bus, "count-1", &fitting).await;
    assert!(accepted.accepted, "{}", accepted.reason);
    training.wait_for("begins    with the policy of");
}

#[tokio::test(flavor = "multi_thread")]
async fn the_first_registration_defines_the_task_and_others_must_match_it() {
    let (folder, run) = folders();
    let training = learner(folder.path(), &run, &["--task", "test/Count-v0", "--steps", "1024"]);
    let bus = join(&run);
    let other = Task { name: "test/Other-v0".into(), ..task() };
    let refused = register(&bus, "other-1", &other).await;
    assert!(!refused.accepted && refused.task.is_none(), "the run waits for the task that was named");
    assert!(refused.reason.contains("this run trains `test/Count-v0`"), "{}", refused.reason);
    assert!(register(&bus, "count-1", &task()).await.accepted);
    training.wait_for("`test/Count-v0` (3 observations, 2 actions)");
    let refused = register(&bus, "other-1", &Task { observation_size: 5, ..other }).await;
    assert_eq!(
        refused.reason,
        "this run trains `test/Count-v0` (3 observations, 2 actions); you registered `test/Other-v0` (5 observations, 2 \
         actions)"
    );
    let refused = register(&bus, "count-2", &Task { action_high: vec![1.0, 3.0], ..task() }).await;
    assert!(refused.reason.contains("task.action_high"), "{}", refused.reason);
    assert!(register(&bus, "count-2", &task()).await.accepted);

    let bundle = policy(&bus).await;
    assert_eq!((bundle.observation_size, bundle.action_size, &bundle.model_xml[..]), (3, 2, ""));
    let mut config = ConfigSource::default();
    config.text(&bundle.config_toml, "the bundle").unwrap();
    assert_eq!(config.build().unwrap().task.known(), Some(task()));

    // An actor that simulates the humanoid is refused by name.
    let endpoint = endpoint(&run);
    let ours = self::run(folder.path(), &["actor", "--connect", &endpoint, "--run", "run", "--envs", "1"]);
    assert_refused(&ours, 1, &["`test/Count-v0`", "treadmill_actor", "--run run"]);
    let evaluator = self::run(folder.path(), &["evaluator", "--connect", &endpoint, "--run", "run"]);
    assert_refused(&evaluator, 1, &["`test/Count-v0`"]);

    // Training to the end, and saving.
    let wrong = Fragment { config_hash: bundle.config_hash ^ 1, ..fragment(&bundle, 1) };
    assert_eq!(send(&bus, &wrong).await.outcome, Outcome::Malformed);
    assert_eq!(send(&bus, &fragment(&bundle, 1)).await.outcome, Outcome::Accepted);
    let bundle = policy(&bus).await;
    assert_eq!(bundle.version.number, 1);
    assert_eq!(send(&bus, &fragment(&bundle, 2)).await.outcome, Outcome::Accepted);
    let (status, lines) = training.wait();
    assert!(status.success(), "{lines:#?}");
    assert!(lines.iter().any(|line| line.contains("treadmill export")), "{lines:#?}");
    assert_eq!(last_value(&run, "rollout/ep_rew_mean"), Some(1.0));
    assert!(run.join("checkpoints/best.bundle").is_file(), "the best by return in training");
    assert!(!run.join("model.xml").exists());
    assert!(fs::read_to_string(run.join("config.toml")).unwrap().contains("name = \"test/Count-v0\""));

    // Commands that play the humanoid refuse; `export` works.
    let path = run.to_str().unwrap();
    assert_refused(&self::run(folder.path(), &["eval", path]), 2, &["`test/Count-v0`", "treadmill export"]);
    assert_refused(&self::run(folder.path(), &["train", "--resume", path]), 2, &["external", "treadmill learner"]);
    let file = folder.path().join("policy.safetensors");
    let exported = self::run(folder.path(), &["export", path, "--safetensors", file.to_str().unwrap()]);
    assert!(exported.status.success(), "{}", stderr(&exported));
    let played = self::run(folder.path(), &["eval", file.to_str().unwrap()]);
    assert_refused(&played, 2, &["`test/Count-v0`"]);

    // A resumed run needs no registration.
    fs::remove_file(run.join("endpoint.txt")).unwrap();
    let training = learner(folder.path(), &run, &["--resume", path, "--steps", "1536"]);
    let bus = join(&run);
    let again = policy(&bus).await;
    assert_eq!((again.config_hash, again.version.number), (bundle.config_hash, 2));
    assert!(!register(&bus, "other-1", &Task { name: "test/Other-v0".into(), ..task() }).await.accepted);
    assert_eq!(send(&bus, &fragment(&again, 3)).await.outcome, Outcome::Accepted);
    assert!(training.wait().0.success());
}

#[tokio::test(flavor = "multi_thread")]
async fn a_registered_mirror_image_makes_the_networks_equivariant() {
    let (folder, run) = folders();
    let training = learner(folder.path(), &run, &["--task", "external", "--set", "ppo.symmetry=equivariant"]);
    let bus = join(&run);
    let refused = register(&bus, "count-1", &task()).await;
    assert!(!refused.accepted && refused.reason.contains("`ppo.symmetry`"), "{}", refused.reason);
    assert!(refused.reason.contains("no mirror image"), "{}", refused.reason);
    let (observation_mirror, action_mirror) = (vec![1, -2, 3], vec![2, 1]);
    let (action_low, action_high) = (vec![-1.0; 2], vec![1.0; 2]);
    let mirrored = Task { observation_mirror, action_mirror, action_low, action_high, ..task() };
    assert!(register(&bus, "count-1", &mirrored).await.accepted);
    training.wait_for("`test/Count-v0`");
    let bundle = policy(&bus).await;
    assert_eq!((bundle.observation_mirror, bundle.action_mirror), (vec![1, -2, 3], vec![2, 1]));
    let refused = register(&bus, "count-2", &Task { observation_mirror: vec![-1, 2, 3], ..mirrored }).await;
    assert!(
        refused.reason.contains("task.observation_mirror [1, -2, 3], you registered [-1, 2, 3]"),
        "{}",
        refused.reason
    );
}

#[tokio::test(flavor = "multi_thread")]
async fn a_humanoid_run_refuses_other_tasks_by_name() {
    let (folder, run) = folders();
    let _training = learner(folder.path(), &run, &[]);
    let bus = join(&run);
    let refused = register(&bus, "gym-1", &Task { observation_size: 45, ..task() }).await;
    assert!(!refused.accepted);
    assert_eq!(
        refused.reason,
        "this run trains `treadmill/humanoid-v5` (45 observations, 17 actions); you registered `test/Count-v0` (45 \
         observations, 2 actions)"
    );
}

#[tokio::test(flavor = "multi_thread")]
async fn with_certificates_actors_can_register_tasks_and_observers_cannot() {
    let (folder, run) = folders();
    assert!(self::run(folder.path(), &["certs", "certs"]).status.success());
    let with_tls = ["--listen", "tls/127.0.0.1:0", "--tls", "certs", "--task", "external"];
    let training = start_endless(folder.path(), &run, "learner", &with_tls);
    let join = |role| join_as(role, folder.path(), &run);
    let stranger = TaskRegistration {
        run: "run".into(),
        actor: "watcher".into(),
        task: Task { name: "test/Other-v0".into(), ..task() },
    };
    let timeout = std::time::Duration::from_secs(1);
    assert_eq!(register_task(&join(Role::Observer), &stranger, timeout).await.unwrap(), None);
    assert!(
        register(&join(Role::Actor), "count-1", &task()).await.accepted,
        "the registration of the observer did not arrive"
    );
    training.wait_for("`test/Count-v0`");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_few_absurd_returns_do_not_decide_which_policy_is_the_best() {
    let (folder, run) = folders();
    let _training = learner(folder.path(), &run, &["--task", "external"]);
    let bus = join(&run);
    assert!(register(&bus, "count-1", &task()).await.accepted);
    let checkpoint = |name: &str| load_file(&run.join("checkpoints").join(name)).unwrap();
    // The last 100 of 512 episodes count: first 20 of them return ten thousand, then all of them 2, then all of them 1.
    for (sequence, returned, absurd) in [(1, 1.0, 20), (2, 2.0, 0), (3, 1.0, 0)] {
        let mut fragment = fragment(&policy(&bus).await, sequence);
        fragment.rewards.fill(returned);
        let rows = fragment.rewards.len();
        fragment.rewards[rows - absurd..].fill(1e4);
        for (episode, reward) in fragment.episodes.iter_mut().zip(&fragment.rewards) {
            episode.return_sum = f64::from(*reward);
        }
        assert_eq!(send(&bus, &fragment).await.outcome, Outcome::Accepted);
        let best = if sequence == 1 { 1.0 } else { 2.0 };
        assert_eq!(checkpoint("latest.bundle").best_return, Some(best), "after {sequence} updates");
        assert_eq!(checkpoint("best.bundle").counters.updates, sequence.min(2));
    }
}

#[test]
fn flags_that_contradict_an_external_task_are_refused_before_anything_is_written() {
    let (folder, run) = folders();
    let path = run.to_str().unwrap();
    let with = |command: &str, more: &[&str]| {
        let args = [&[command, "--preset", "smoke", "--run-dir", path, "--listen", "tcp/127.0.0.1:0"], more].concat();
        let output = self::run(folder.path(), &args);
        assert!(!run.exists(), "{args:?}");
        output
    };
    assert_refused(&with("train", &["--task", "external"]), 2, &["`treadmill learner`"]);
    assert_refused(&with("learner", &["--task", "gymnasium/a b"]), 2, &["`task.name`", "\"gymnasium/a b\"", "128"]);
    assert_refused(&with("learner", &["--task", "external", "--model", "my.xml"]), 2, &["my.xml", "external"]);
    let huge = ["--task", "mine/a", "--set", "task.observation_size=4096", "--set", "task.action_size=1"];
    let ranges = ["--set", "task.action_low=[-1]", "--set", "task.action_high=[1]", "--set", "policy.hidden=[4096]"];
    assert_refused(&with("learner", &[&huge[..], &ranges[..]].concat()), 2, &["parameters", "policy.hidden"]);
    assert_refused(&self::run(folder.path(), &["bench", "env", "--set", "env.task=external"]), 2, &["env.task"]);
    assert_refused(
        &self::run(folder.path(), &["eval", "--agent", "random", "--set", "env.task=external"]),
        2,
        &["env.task"],
    );
}

#[test]
fn a_learner_that_waits_for_a_task_can_be_stopped() {
    let (folder, run) = folders();
    let training = learner(folder.path(), &run, &["--task", "external"]);
    training.wait_for("first actor registers");
    endpoint(&run);
    training.signal(libc::SIGINT);
    let (status, lines) = training.wait();
    assert!(status.success() && lines.iter().any(|line| line.contains("before any actor registered")), "{lines:#?}");
}
