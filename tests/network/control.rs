//! `status` and `control`: a run is queried, paused, changed and stopped from outside.

use std::path::Path;

use crate::support::*;
use serde_json::Value;
use treadmill_learner::checkpoint::load_file;

fn control(folder: &Path, args: &[&str]) -> std::process::Output {
    run(folder, &[&["control"], args].concat())
}

/// Sends a command that succeeds, and returns its output.
fn done(folder: &Path, args: &[&str]) -> String {
    let output = control(folder, args);
    assert!(output.status.success(), "{args:?}: {}", stderr(&output));
    stdout(&output)
}

fn status(folder: &Path) -> Value {
    last_json(&run(folder, &["status", "run", "--json"]))
}

/// Waits until fragments of both actors have been accepted, and returns the status that says so.
fn await_both_actors(folder: &Path) -> Value {
    await_that("two actors with accepted fragments", || {
        let status = status(folder);
        let actors = status["actors"].as_array().unwrap();
        let is_working = |actor: &Value| actor["state"] == "alive" && actor["accepted"].as_u64() > Some(0);
        (actors.len() == 2 && actors.iter().all(is_working)).then_some(status.clone())
    })
}

#[test]
fn a_command_reaches_the_run_whose_folder_was_given() {
    let (folder, first) = folders();
    let (folder, second) = (folder.path(), folder.path().join("second"));
    let _first = start_endless(folder, &first, "learner", &["--listen", "tcp/127.0.0.1:0"]);
    // On one bus with the first.
    let joined = ["--listen", "tcp/127.0.0.1:0", "--connect", &endpoint(&first)];
    let _second = start_endless(folder, &second, "learner", &joined);
    let phase = |run: &str| last_json(&crate::support::run(folder, &["status", run, "--json"]))["phase"].clone();
    await_that("both runs at one endpoint", || {
        let both = crate::support::run(folder, &["status", "--connect", &endpoint(&second), "--json"]);
        (stdout(&both).lines().count() == 2).then_some(())
    });
    assert!(done(folder, &["pause", "second"]).starts_with("paused"));
    assert_eq!((phase("second"), phase("run")), ("paused".into(), "training".into()));
    // A folder whose endpoint is that of another machine's learner.
    std::fs::copy(first.join("endpoint.txt"), second.join("endpoint.txt")).unwrap();
    std::fs::write(second.join("lock.json"), r#"{"pid": 1, "host": "elsewhere"}"#).unwrap();
    assert_refused(&control(folder, &["stop", "second"]), 1, &["process 1 on host elsewhere", "only other learners"]);
    assert_eq!(phase("run"), "training");
}

#[test]
fn a_run_can_be_paused_saved_changed_and_stopped() {
    let (folder, run) = folders();
    let folder = folder.path();
    let training = start_endless(folder, &run, "train", &[]);
    await_steps(&run, 1024);
    // A run begins to learn before its second actor delivers.
    await_both_actors(folder);

    assert!(done(folder, &["pause", "run"]).starts_with("paused after update"));
    assert!(done(folder, &["pause", "run"]).contains("paused already"));
    let paused = status(folder);
    assert_eq!(paused["phase"], "paused");
    let text = stdout(&crate::support::run(folder, &["status", "run"]));
    assert!(text.contains("run `run` is paused") && text.contains("actor-0"), "{text}");

    // While paused, other commands work and nothing is learnt.
    let kept = done(folder, &["checkpoint", "run"]);
    let updates = paused["updates"].as_u64().unwrap();
    let path = run.join(format!("checkpoints/{updates:08}.bundle"));
    assert!(kept.contains(path.file_name().unwrap().to_str().unwrap()), "{kept}");
    assert_eq!(load_file(&path).unwrap().counters.updates, updates);
    let changed = done(folder, &["set", "ppo.learning_rate", "1e-4", "run"]);
    assert!(changed.contains("ppo.learning_rate is 0.0001, was 0.0003"), "{changed}");
    let saved = load_file(&run.join("checkpoints/latest.bundle")).unwrap();
    assert_eq!(
        (saved.config().unwrap().ppo.learning_rate, saved.ppo.learning_rate()),
        (1e-4, 1e-4),
        "also if it stops now"
    );
    assert_refused(&control(folder, &["set", "rollout.envs", "3", "run"]), 2, &["`rollout.envs`", "ppo"]);
    assert_refused(&control(folder, &["set", "ppo.clip_range", "-1", "run"]), 2, &["`ppo.clip_range`", "-1"]);
    assert_refused(&control(folder, &["set", "ppo.clip", "1", "run"]), 2, &["`ppo.clip`"]);
    assert_eq!(status(folder)["updates"], paused["updates"]);

    assert!(done(folder, &["resume", "run"]).starts_with("resumed after update"));
    let steps = paused["env_steps"].as_u64().unwrap();
    await_steps(&run, steps + 2048);
    assert_eq!(await_both_actors(folder)["phase"], "training");

    assert!(done(folder, &["stop", "run"]).starts_with("stopping"));
    let (ended, _) = training.wait();
    assert!(ended.success());
    let state = load_file(&run.join("checkpoints/latest.bundle")).unwrap();
    assert_eq!(state.config().unwrap().ppo.learning_rate, 1e-4);
    let text = stdout(&crate::support::run(folder, &["status", "run"]));
    assert!(text.contains("run `run` is stopped: no process trains it") && text.contains("--resume run"), "{text}");
    assert_eq!(status(folder)["phase"], "stopped");
    assert_refused(
        &control(folder, &["pause", "run"]),
        1,
        &["no process trains `run` now", "treadmill train --resume run"],
    );
}

#[test]
fn a_change_leaves_the_goal_of_this_start() {
    let (folder, run) = folders();
    let folder = folder.path();
    let training = start_endless(folder, &run, "train", &["--set", "eval.every_steps=600000000"]);
    await_steps(&run, 512);
    done(folder, &["stop", "run"]);
    assert!(training.wait().0.success());
    // A goal before the first evaluation, so that this start evaluates nothing.
    let training = start(folder, &["train", "--resume", "run", "--steps", "500000000"]);
    await_that("a learner that answers", || {
        let asked = crate::support::run(folder, &["status", "run", "--json"]);
        (asked.status.success() && last_json(&asked)["phase"] == "training").then_some(())
    });
    done(folder, &["set", "ppo.target_kl", "0.5", "run"]);
    assert_eq!(status(folder)["env_steps_wanted"], 500_000_000);
    done(folder, &["stop", "run"]);
    assert!(training.wait().0.success());
    let config = load_file(&run.join("checkpoints/latest.bundle")).unwrap().config().unwrap();
    assert_eq!((config.run.steps, config.ppo.target_kl), (1_000_000_000, 0.5));
}

#[test]
fn an_observer_can_query_status_and_only_the_operator_can_send_commands() {
    let (folder, run) = folders();
    let folder = folder.path();
    assert!(crate::support::run(folder, &["certs", "certs"]).status.success());
    let training = start_endless(folder, &run, "train", &["--listen", "tls/127.0.0.1:0", "--tls", "certs"]);
    await_steps(&run, 512);
    // An observer's certificate under an operator's file names.
    let theirs = folder.join("theirs");
    std::fs::create_dir(&theirs).unwrap();
    for (from, to) in [("ca.crt", "ca.crt"), ("observer.crt", "operator.crt"), ("observer.key", "operator.key")] {
        std::fs::copy(folder.join("certs").join(from), theirs.join(to)).unwrap();
    }
    let asked = crate::support::run(folder, &["status", "run", "--tls", "theirs", "--json"]);
    assert_eq!(last_json(&asked)["run"], "run");
    let args = ["pause", "run", "--run", "run", "--tls", "theirs"];
    assert_refused(
        &control(folder, &args),
        1,
        &["operator.crt belongs to `treadmill-observer`", "treadmill check --connect tls/"],
    );
    assert_eq!(status_over(folder, "certs")["phase"], "training");
    assert!(done(folder, &["pause", "run", "--tls", "certs"]).starts_with("paused"));
    assert_eq!(status_over(folder, "certs")["phase"], "paused");
    assert!(done(folder, &["stop", "run", "--tls", "certs"]).starts_with("stopping"));
    assert!(training.wait().0.success());
}

fn status_over(folder: &Path, certs: &str) -> Value {
    last_json(&run(folder, &["status", "run", "--tls", certs, "--json"]))
}
