//! Event files, read by TensorBoard itself.

use std::{fs, path::Path, process::Command};

use crate::support::*;
use serde_json::Value;

/// Returns what TensorBoard reads in a run folder.
fn read(python: &Command, run: &Path) -> Value {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/python/read_events.py");
    let output = Command::new(python.get_program()).arg(script).arg(run).output().expect("Python starts");
    assert!(output.status.success(), "{}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn steps(points: &Value) -> Vec<u64> {
    points.as_array().unwrap_or(&Vec::new()).iter().map(|point| point[0].as_u64().unwrap()).collect()
}

#[test]
fn tensorboard_reads_the_same_scalars_as_metrics_jsonl() {
    let Some(python) = python_with("tensorboard") else { return };
    let (folder, run) = folders();
    let run_name = run.to_str().unwrap();
    let every = ["--set", "learner.checkpoint_every_updates=1", "--set", "learner.keep_checkpoints=100"];
    let train = ["train", "--preset", "smoke", "--steps", "2048", "--run-dir", run_name];
    done(folder.path(), &[&train[..], &every].concat());
    // It goes on from an earlier checkpoint, so that steps are written twice.
    done(folder.path(), &["train", "--resume", run_name, "--checkpoint", "2", "--steps", "4096"]);

    let points = &read(&python, &run)["points"];
    let mut compared = 0;
    for (tag, step, value) in metrics(&run) {
        let points = points[&tag].as_array().unwrap_or_else(|| panic!("TensorBoard has no {tag}"));
        let found = points.iter().find(|point| point[0] == step).unwrap_or_else(|| panic!("no {tag} at {step}"));
        // TensorBoard's numbers have 32 bits.
        let error = (found[1].as_f64().unwrap() - value).abs();
        assert!(error <= 1e-6 * value.abs(), "{tag} at {step}: {} instead of {value}", found[1]);
        compared += 1;
    }
    assert!(compared > 8 * 30, "eight updates of some thirty tags each, {compared} compared");
    let written: Vec<u64> =
        metrics(&run).into_iter().filter(|(tag, ..)| tag == "train/std").map(|(_, step, _)| step).collect();
    assert_eq!(steps(&points["train/std"]), written, "no step comes twice");
}

/// Asserts that the table of the configuration has every key of the saved one, changed keys in bold.
fn assert_configuration(text: &str, run: &Path) {
    assert!(text.contains("| ppo.gamma | **0.97** | 0.99 |"), "{text}");
    let config: toml::Table = fs::read_to_string(run.join("config.toml")).unwrap().parse().unwrap();
    let mut compared = 0;
    for (section, keys) in &config {
        for (key, value) in keys.as_table().unwrap() {
            let plain = format!("| {section}.{key} | {value} |");
            let bold = format!("| {section}.{key} | **{value}** |");
            assert!(text.contains(&plain) || text.contains(&bold), "{section}.{key}={value} in {text}");
            compared += 1;
        }
    }
    assert!(compared > 60 && text.lines().count() == compared + 2, "{compared} keys");
}

#[test]
fn tensorboard_shows_configuration_histograms_and_hyperparameters() {
    let Some(python) = python_with("tensorboard") else { return };
    let (folder, run) = folders();
    let run_name = run.to_str().unwrap();
    let train = ["train", "--preset", "smoke", "--steps", "6144", "--run-dir", run_name, "--set", "ppo.gamma=0.97"];
    let labels = ["--actors", "1", "--tag", "short", "--description", "what a run logs"];
    done(folder.path(), &[&train[..], &labels].concat());
    let first = read(&python, &run);

    assert_configuration(first["points"]["config"][0][1].as_str().unwrap(), &run);
    assert!(first["points"]["command"][0][1].as_str().unwrap().contains("train --preset smoke --steps 6144"));
    assert!(first["points"]["versions"][0][1].as_str().unwrap().contains(env!("CARGO_PKG_VERSION")));
    assert_eq!(first["points"]["description"][0][1], "`short`\n\nwhat a run logs");

    // Twelve updates of 512 steps: the first and the eleventh have histograms, and each counts the whole batch.
    let count = |tag: &str, index: usize| -> f64 {
        let rows = first["histograms"][tag][index][1].as_array().unwrap_or_else(|| panic!("no histogram {tag}"));
        assert!(rows.iter().all(|row| row[0].as_f64() <= row[1].as_f64()), "{tag}");
        rows.iter().map(|row| row[2].as_f64().unwrap()).sum()
    };
    let histograms = first["histograms"].as_object().unwrap();
    let of_joints = histograms.keys().filter(|tag| tag.starts_with("actions/") && *tag != "actions/all");
    assert_eq!(of_joints.clone().count(), 17, "{:?}", histograms.keys());
    assert!(histograms.contains_key("actions/right_knee"), "{:?}", histograms.keys());
    for tag in histograms.keys() {
        assert_eq!(steps(&first["histograms"][tag]), [512, 11 * 512], "{tag}");
    }
    for index in [0, 1] {
        assert_eq!((count("actions/all", index), count("bus/policy_lag", index)), (17.0 * 512.0, 512.0));
        of_joints.clone().for_each(|tag| assert_eq!(count(tag, index), 512.0, "{tag}"));
    }
    let lags = &first["histograms"]["bus/policy_lag"][0][1];
    assert_eq!(*lags, serde_json::json!([[-0.5, 0.5, 512.0]]), "no fragment lags in lock-step");
    let charts = &first["charts"]["Results"];
    assert_eq!(charts["falls [share]"], serde_json::json!(["^rollout/fall_fraction$", "^eval/fall_fraction$"]));
    assert!(charts["distance [m]"].is_array() && first["charts"]["Learning"].is_object(), "{charts}");
    let documented = page("reference/metrics");
    for tag in ["actions/all", "actions/{name}", "bus/policy_lag", "config", "command", "versions", "description"] {
        assert!(documented.contains(&format!("`{tag}`")), "docs/reference/metrics.md does not explain {tag}");
    }

    // One row of the HPARAMS tab.
    let sessions = |read: &Value| read["hparams"]["sessions"].as_array().unwrap().clone();
    let [session] = &sessions(&first)[..] else { panic!("one row: {}", first["hparams"]) };
    assert_eq!(session["status"], serde_json::json!(["STATUS_SUCCESS"]));
    let hparams = &session["hparams"];
    assert_eq!((&hparams["ppo.gamma"], &hparams["learner.mode"]), (&0.97.into(), &"sync".into()));
    assert_eq!(hparams.as_object().unwrap().len(), first["hparams"]["columns"].as_array().unwrap().len());
    assert_eq!(session["metrics"]["time/total_timesteps"], 6144.0);
    let best = last_value(&run, "rollout/distance_best_m").unwrap();
    assert!((session["metrics"]["rollout/distance_best_m"].as_f64().unwrap() - best).abs() < 1e-6);

    // A resumed run still has one row, and its text shows each configuration from its first step.
    done(folder.path(), &["train", "--resume", run_name, "--steps", "8192"]);
    let second = read(&python, &run);
    assert_eq!(steps(&second["points"]["config"]), [0, 6144]);
    assert!(second["points"]["command"][1][1].as_str().unwrap().contains("--resume"));
    assert_eq!(steps(&second["histograms"]["actions/all"]), [512, 11 * 512]);
    let [session] = &sessions(&second)[..] else { panic!("one row: {}", second["hparams"]) };
    assert_eq!((&session["status"], &session["hparams"]), (&serde_json::json!(["STATUS_SUCCESS"]), hparams));
    assert_eq!(session["metrics"]["time/total_timesteps"], 8192.0);

    // Several runs of one log directory have a row each.
    let other = folder.path().join("other");
    let train = ["train", "--preset", "smoke", "--steps", "512", "--run-dir", other.to_str().unwrap()];
    done(folder.path(), &train);
    assert_eq!(sessions(&read(&python, &run)).len(), 2);
}

#[test]
fn a_failed_run_has_the_status_failure() {
    let Some(python) = python_with("tensorboard") else { return };
    let (folder, run) = folders();
    let training = Running::start(endless(folder.path(), &run, "train"));
    await_steps(&run, 512);
    // From now on, saving fails.
    fs::rename(run.join("checkpoints"), run.join("elsewhere")).unwrap();
    assert_eq!(training.wait().0.code(), Some(1));
    let events = read(&python, &run);
    let sessions = events["hparams"]["sessions"].as_array().unwrap();
    assert_eq!(sessions.len(), 1);
    assert_eq!(sessions[0]["status"], serde_json::json!(["STATUS_FAILURE"]));
}

#[test]
fn a_film_of_the_newest_policy_is_shown() {
    let Some(python) = python_with("tensorboard") else { return };
    let (folder, run) = folders();
    let training = start_endless(folder.path(), &run, "train", &["--set", "eval.every_steps=1024", "--no-page"]);
    let is_filmed = || {
        let files = fs::read_dir(&run).ok()?.filter_map(Result::ok).map(|entry| entry.path());
        let mut events = files.filter(|path| path.to_string_lossy().contains("tfevents"));
        let has_film =
            |path: std::path::PathBuf| fs::read(path).is_ok_and(|bytes| bytes.windows(6).any(|at| at == b"GIF89a"));
        events.any(has_film).then_some(())
    };
    await_that("a film among the events", is_filmed);
    stop(training);
    let events = read(&python, &run);
    let [film, ..] = &events["pictures"]["film"].as_array().unwrap()[..] else { panic!("no film: {events}") };
    assert_eq!((&film[1], &film[2], &film[3]), (&320.into(), &240.into(), &"GIF89a".into()));
    assert!(film[0].as_u64().unwrap() > 0, "the policy has learnt: {film}");
}
