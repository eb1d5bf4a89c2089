//! Searches by Optuna.

use std::{fs, path::Path, process::Command};

use crate::support::*;

/// Keys whose learning rate is the goal itself, so that the order of the trials is known.
const RATES: &str =
    "goal = 'highest train/learning_rate'\n[keys]\nppo.learning_rate = { log_uniform = [1e-5, 1e-3] }\n";
/// Steps of a trial that trains for more than a second, in which it is looked at several times.
const LONG: [&str; 6] = ["--preset", "smoke", "--steps", "60000", "--set", "ppo.target_kl=0"];

/// Returns the command of the binary under test, which finds the module of this repository.
fn sweep(folder: &Path, args: &[&str]) -> Command {
    let mut command = treadmill(folder);
    command.arg("sweep").args(args).env("PYTHONPATH", Path::new(env!("CARGO_MANIFEST_DIR")).join("python"));
    command
}

/// Returns a column of `sweep.csv`.
fn column(folder: &Path, name: &str) -> Vec<String> {
    csv_rows(&folder.join("S/sweep.csv")).into_iter().map(|row| row[name].clone()).collect()
}

#[test]
fn the_study_of_optuna_passes_its_tests() {
    let Some(mut python) = python_with("optuna") else { return };
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("python");
    python.args(["-m", "unittest", "test_sweep"]).current_dir(root.join("tests")).env("PYTHONPATH", &root);
    let output = python.output().unwrap();
    let errors = stderr(&output);
    assert!(output.status.success() && errors.contains("\nOK\n"), "{errors}");
}

#[test]
fn a_search_by_optuna_ends_with_tables_a_picture_and_importances() {
    let Some(mut python) = python_with("optuna") else { return };
    let (folder, _) = folders();
    let goal = "highest rollout/ep_rew_mean";
    let keys = "[keys]\nppo.gamma = { uniform = [0.9, 0.99] }\nppo.epochs = { choices = [1, 2] }\n";
    let text = format!("strategy = 'tpe'\npruner = 'median'\ntrials = 2\nseeds = 2\ngoal = '{goal}'\n{keys}");
    fs::write(folder.path().join("search.toml"), text).unwrap();
    let args = "-m treadmill_sweep search.toml --preset smoke --steps 2048 --run-dir S --json --treadmill";
    python.args(args.split(' ')).arg(env!("CARGO_BIN_EXE_treadmill")).current_dir(folder.path());
    let output = python.env("PYTHONPATH", Path::new(env!("CARGO_MANIFEST_DIR")).join("python")).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let (text, result) = (stdout(&output), last_json(&output));
    for part in ["trial-4 of 4: seed 2, ", "Importance of each key", "Best: S/trial-"] {
        assert!(text.contains(part), "`{part}` is missing in {text}");
    }
    assert_eq!((&result["trials"], &result["failed"], &result["goal"]), (&4.into(), &0.into(), &goal.into()));
    let shares = ["ppo.gamma", "ppo.epochs"].map(|key| result["importance"][key].as_f64().unwrap());
    assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-9, "{result}");
    let picture = fs::read(folder.path().join("S/sweep.png")).unwrap();
    assert!(picture.starts_with(b"\x89PNG") && picture.len() > 1000);
    let more = |trials: &str| sweep(folder.path(), &["--resume", "S", "--trials", trials]).output().unwrap();
    assert_refused(&more("1"), 2, &["has begun 2"]);
    assert!(stdout(&more("3")).contains("trial-6 of 6: seed 2, "));
    assert_eq!(column(folder.path(), "setting"), ["1", "1", "2", "2", "3", "3"]);
    assert_eq!(column(folder.path(), "state"), ["complete"; 6]);
}

#[test]
fn hopeless_trials_are_pruned() {
    let Some(_) = python_with("optuna") else { return };
    let (folder, _) = folders();
    let text = format!("strategy = 'random'\npruner = 'median'\ntrials = 8\n{RATES}");
    fs::write(folder.path().join("search.toml"), text).unwrap();
    let args = [&["search.toml", "--run-dir", "S", "--parallel", "1", "--json"][..], &LONG].concat();
    let output = sweep(folder.path(), &args).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let (text, states) = (stdout(&output), column(folder.path(), "state"));
    let steps: Vec<u64> = column(folder.path(), "env_steps").iter().map(|cell| cell.parse().unwrap()).collect();
    let mut complete: Vec<f64> = Vec::new();
    for (index, rate) in column(folder.path(), "ppo.learning_rate").iter().enumerate() {
        let rate: f64 = rate.parse().unwrap();
        complete.sort_by(f64::total_cmp);
        // Optuna's median pruner waits for five results.
        let median = complete
            .len()
            .checked_sub(5)
            .map(|_| f64::midpoint(complete[(complete.len() - 1) / 2], complete[complete.len() / 2]));
        let is_pruned = median.is_some_and(|median| rate < median);
        assert_eq!(states[index], if is_pruned { "pruned" } else { "complete" }, "trial {index}: {text}");
        assert_eq!(steps[index] < 60_000, is_pruned, "trial {index}: {steps:?}");
        complete.extend((!is_pruned).then_some(rate));
    }
    let pruned = states.iter().filter(|state| *state == "pruned").count();
    let result = last_json(&output);
    assert!(pruned > 0 && result["pruned"] == pruned && result["complete"] == 8 - pruned, "{text}");
    assert_eq!(text.matches(" steps in ").count() - text.matches(", pruned\n").count(), 8 - pruned, "{text}");
}

#[test]
fn a_study_is_kept_in_the_database_that_was_named() {
    let Some(mut python) = python_with("cmaes") else { return };
    let (folder, _) = folders();
    let folder = folder.path();
    let second = "ppo.gamma = { uniform = [0.9, 0.99] }\n";
    fs::write(folder.join("search.toml"), format!("strategy = 'cmaes'\ntrials = 2\n{RATES}{second}")).unwrap();
    let begin =
        ["search.toml", "--storage", "sqlite:///all.db", "--preset", "smoke", "--steps", "512", "--run-dir", "S"];
    let output = sweep(folder, &begin).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    // A relative path counts from where the sweep began.
    fs::create_dir(folder.join("elsewhere")).unwrap();
    let output = sweep(&folder.join("elsewhere"), &["--resume", "../S", "--trials", "3"]).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let read = "import json, optuna; s = optuna.load_study(study_name='S', storage='sqlite:///all.db')\n\
                print(json.dumps([t.value for t in s.trials]))";
    let found = python.args(["-c", read]).current_dir(folder).output().unwrap();
    let goals: Vec<f64> = column(folder, "goal").iter().map(|goal| goal.parse().unwrap()).collect();
    assert_eq!((goals.len(), last_json(&found)), (3, goals.into()), "{}", stderr(&found));
    assert!(!folder.join("S/study.db").exists() && !folder.join("elsewhere/all.db").exists());
}

#[test]
fn a_search_whose_python_dies_says_how_to_go_on() {
    let Some(_) = python_with("optuna") else { return };
    let (folder, _) = folders();
    let folder = folder.path();
    fs::write(folder.join("search.toml"), format!("strategy = 'tpe'\ntrials = 2\n{RATES}")).unwrap();
    let begin = [&["search.toml", "--run-dir", "S", "--parallel", "1"][..], &LONG].concat();
    let orphaned = Running::start(sweep(folder, &begin));
    await_steps(&folder.join("S/trial-1"), 2048);
    let trials = children(orphaned.pid(), "train");
    for python in children(orphaned.pid(), "treadmill_sweep") {
        send_signal(python, libc::SIGKILL);
    }
    let (status, lines) = orphaned.wait();
    assert_eq!(status.code(), Some(1), "{lines:#?}");
    assert!(
        lines.iter().any(|line| line.contains("the study failed; go on with `treadmill sweep --resume`")),
        "{lines:#?}"
    );
    await_that("the end of its trials", || trials.iter().all(|pid| !is_running(*pid)).then_some(()));
    let output = sweep(folder, &["--resume", "S"]).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(column(folder, "state"), ["complete"; 2]);
}

#[test]
fn a_killed_search_goes_on_with_the_trials_that_had_begun() {
    let Some(mut python) = python_with("optuna") else { return };
    let (folder, _) = folders();
    let folder = folder.path();
    fs::write(folder.join("search.toml"), format!("strategy = 'tpe'\ntrials = 3\n{RATES}")).unwrap();
    let trial = folder.join("S/trial-1");
    let keys = || {
        let plan: serde_json::Value = serde_json::from_slice(&fs::read(folder.join("S/sweep.json")).unwrap()).unwrap();
        plan["trials"].as_array().unwrap().iter().map(|trial| trial["keys"].clone()).collect::<Vec<_>>()
    };
    let begin = [&["search.toml", "--run-dir", "S", "--parallel", "2"][..], &LONG].concat();
    let killed = Running::start(sweep(folder, &begin));
    await_steps(&trial, 2048);
    await_steps(&folder.join("S/trial-2"), 2048);
    let processes = [children(killed.pid(), "train"), children(killed.pid(), "treadmill_sweep")].concat();
    assert_eq!(processes.len(), 3, "two trials and the study");
    let begun = keys();
    killed.signal(libc::SIGKILL);
    killed.wait();
    await_that("the end of its processes", || processes.iter().all(|pid| !is_running(*pid)).then_some(()));

    let stopped = Running::start(sweep(folder, &["--resume", "S"]));
    await_steps(&trial, last_step(&trial) + 1024);
    stopped.signal(libc::SIGINT);
    let (status, lines) = stopped.wait();
    assert!(status.success() && lines.iter().any(|line| line.contains("treadmill sweep --resume S")), "{lines:#?}");
    assert_eq!(keys(), begun);

    let output = sweep(folder, &["--resume", "S"]).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!((&keys()[..2], column(folder, "state")), (&begun[..], ["complete"; 3].map(String::from).to_vec()));
    let read = "import json, optuna; s = optuna.load_study(study_name='S', storage='sqlite:///S/study.db')\n\
                print(json.dumps([[t.state.name, t.value, len(t.intermediate_values)] for t in s.trials]))";
    let found = python.args(["-c", read]).current_dir(folder).output().unwrap();
    let goals = column(folder, "goal").into_iter().map(|goal| goal.parse::<f64>().unwrap());
    let wanted: Vec<_> = goals.map(|goal| serde_json::json!(["COMPLETE", goal, 49])).collect();
    assert_eq!(last_json(&found), serde_json::Value::from(wanted), "{}", stderr(&found));
}
