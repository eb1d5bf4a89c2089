//! Evaluation during training, and the best checkpoint chosen by it.

use std::path::Path;

use crate::support::*;
use treadmill_bus::actor::{Assignment, ask_for_evaluation};
use treadmill_learner::checkpoint::load_file;

/// Starts a run whose policies are evaluated often.
fn evaluated(folder: &Path, run: &Path, every_steps: u32, episodes: u32) -> Running {
    let mut command = endless(folder, run, "train");
    command.args(["--set", &format!("eval.every_steps={every_steps}"), "--set", &format!("eval.episodes={episodes}")]);
    Running::start(command)
}

#[test]
fn policies_are_evaluated_during_training() {
    let (folder, run) = folders();
    let training = evaluated(folder.path(), &run, 2048, 3);
    let values = |tag: &str| -> Vec<(u64, f64)> {
        metrics(&run).into_iter().filter(|(name, ..)| name == tag).map(|(_, step, value)| (step, value)).collect()
    };
    await_that("three evaluations", || (values("eval/mean_reward").len() >= 3).then_some(()));
    training.signal(libc::SIGINT);
    assert!(training.wait().0.success());

    // Every evaluation logs all its figures, of a policy older than the step at which it is logged.
    let returns = values("eval/mean_reward");
    for tag in ["eval/std_reward", "eval/mean_ep_length", "eval/distance_mean_m", "eval/velocity_mean_mps"] {
        assert_eq!(values(tag).len(), returns.len(), "{tag}");
    }
    for ((_, length), (_, fallen)) in values("eval/mean_ep_length").iter().zip(values("eval/fall_fraction")) {
        assert!((1.0..1000.0).contains(length) && fallen == 1.0, "an untrained humanoid falls: {length} {fallen}");
    }
    let evaluated = values("eval/total_timesteps");
    for (logged_at, steps) in &evaluated {
        assert!(*steps >= 2048.0 && *steps <= *logged_at as f64, "{steps} {logged_at}");
    }

    // The best checkpoint holds the policy with the best evaluation.
    let best = returns.iter().map(|(_, value)| *value).fold(f64::MIN, f64::max);
    let latest = latest(&run);
    assert!(latest.best_is_evaluated);
    assert!((latest.best_return.unwrap() - best).abs() < 1e-9);
    let at = returns.iter().position(|(_, value)| *value == best).unwrap();
    let kept = load_file(&run.join("checkpoints/best.bundle")).unwrap();
    assert_eq!(kept.counters.env_steps as f64, evaluated[at].1);
    assert_eq!(
        (kept.best_is_evaluated, kept.best_return),
        (true, latest.best_return),
        "a run that goes on from it knows"
    );
}

#[test]
fn evaluations_longer_than_many_intervals_have_results() {
    let (folder, run) = folders();
    // Each update is due, and one evaluation lasts for dozens of them.
    let training = evaluated(folder.path(), &run, 512, 200);
    let results = || metrics(&run).iter().filter(|(tag, ..)| tag == "eval/mean_reward").count();
    await_that("two evaluations", || (results() >= 2).then_some(()));
    training.signal(libc::SIGINT);
    assert!(training.wait().0.success());
}

#[test]
fn a_run_that_goes_back_keeps_its_best_policy() {
    let (folder, run) = folders();
    let name = run.to_str().unwrap();
    let args = ["train", "--no-progress", "--preset", "smoke", "--steps", "20480", "--run-dir", name];
    let often = ["--set", "eval.every_steps=1024", "--set", "eval.episodes=1"];
    done(folder.path(), &[&args[..], &often].concat());
    // A policy better than any that follows.
    let best_file = run.join("checkpoints/best.bundle");
    let mut best = load_file(&best_file).unwrap();
    (best.best_return, best.best_is_evaluated) = (Some(1e6), true);
    let best = treadmill_learner::checkpoint::encoding::encode(&best).unwrap();
    std::fs::write(&best_file, &best).unwrap();
    // The last batch may be larger than needed.
    let reached = metrics(&run).last().expect("a run with updates").1;
    let mut resumed = treadmill(folder.path());
    resumed.args(["train", "--no-progress", "--resume", name, "--steps", ENDLESS]);
    let resumed = Running::start(resumed);
    await_that("an evaluation of the resumed run", || {
        metrics(&run).iter().any(|(tag, step, _)| tag == "eval/mean_reward" && *step > reached).then_some(())
    });
    resumed.signal(libc::SIGINT);
    let (status, lines) = resumed.wait();
    assert!(status.success(), "{status} {lines:#?}");
    assert!(std::fs::read(&best_file).unwrap() == best, "the best policy was replaced");
}

#[test]
fn forged_reports_are_ignored() {
    let (folder, run) = folders();
    let mut command = endless(folder.path(), &run, "train");
    command.args(["--set", "eval.every_steps=500000000"]);
    let training = Running::start(command);
    await_steps(&run, 1024);
    let bus = join(&run);
    tokio::runtime::Runtime::new().unwrap().block_on(async {
        let report = treadmill_proto::EvaluationReport {
            run: run.file_name().unwrap().to_str().unwrap().into(),
            evaluator: "liar".into(),
            version: treadmill_proto::PolicyVersion::new(1, 1),
            episodes: 10,
            return_mean: 1e9,
            return_std: 0.0,
            length_mean: 1000.0,
            distance_mean_m: 100.0,
            velocity_mean_mps: 10.0,
            falls: 0,
            velocity_error_mps: None,
            yaw_rate_error_radps: None,
            anchor_error_m: None,
            body_error_m: None,
            body_error_rad: None,
            hinge_error_rad: None,
            done_share: None,
        };
        let timeout = std::time::Duration::from_secs(10);
        let answer = ask_for_evaluation(&bus, &report.run, "liar", Some(&report), timeout).await;
        assert!(matches!(answer, Ok(Assignment::Nothing)), "{answer:?}");
        let answer = ask_for_evaluation(&bus, &report.run, "other-liar", Some(&report), timeout).await;
        assert!(matches!(answer, Ok(Assignment::NoAnswer)), "a report under another name gets no reply: {answer:?}");
    });
    await_steps(&run, 8192);
    training.signal(libc::SIGINT);
    assert!(training.wait().0.success());
    let latest = latest(&run);
    assert!(!latest.best_is_evaluated && latest.best_return.is_none_or(|best| best < 1e8));
    assert!(metrics(&run).iter().all(|(tag, ..)| !tag.starts_with("eval/")));
}
