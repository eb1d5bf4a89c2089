//! Sweeps: several seeds or settings, each trial a run of its own.

use std::{fs, path::Path, process::Command};

use crate::support::*;

/// Flags of small deterministic trials.
const SMALL: [&str; 5] = ["--preset", "smoke", "--deterministic", "--set", "learner.checkpoint_every_updates=2"];

/// Writes a search file.
fn search(folder: &Path, text: &str) {
    fs::write(folder.join("search.toml"), text).unwrap();
}

/// Returns a column of `sweep.csv`.
fn column(folder: &Path, name: &str) -> Vec<String> {
    csv_rows(&folder.join("S/sweep.csv")).into_iter().map(|row| row[name].clone()).collect()
}

#[test]
fn seeds_are_runs_that_are_compared() {
    let (folder, _) = folders();
    let args = ["sweep", "--seeds", "3", "--seed", "5", "--preset", "smoke", "--steps", "2048", "--run-dir", "S"];
    let output = done(folder.path(), &[&args[..], &["--tag", "three", "--json"]].concat());
    let (text, result) = (stdout(&output), last_json(&output));
    assert_eq!(
        (column(folder.path(), "seed"), column(folder.path(), "exit")),
        (["5", "6", "7"].map(String::from).to_vec(), ["0"; 3].map(String::from).to_vec())
    );
    assert_eq!(
        (&result["trials"], &result["failed"], &result["goal"]),
        (&3.into(), &0.into(), &"highest rollout/distance_mean_m".into())
    );
    let goals: Vec<f64> = column(folder.path(), "goal").iter().map(|cell| cell.parse().unwrap()).collect();
    let mean = goals.iter().sum::<f64>() / 3.0;
    assert!((result["settings"][0]["mean"].as_f64().unwrap() - mean).abs() < 1e-12, "{result}");
    for (number, seed) in [(1, 5), (3, 7)] {
        assert!(text.contains(&format!("trial-{number} of 3: seed {seed}: ")), "{text}");
        let config = fs::read_to_string(folder.path().join(format!("S/trial-{number}/config.toml"))).unwrap();
        assert!(config.contains("tags = [\"three\"]"), "{config}");
    }
    assert!(fs::metadata(folder.path().join("S/sweep.png")).unwrap().len() > 1000);
    assert!(stdout(&done(folder.path(), &["runs", "S"])).contains("trial-2"));
    assert_usage(folder.path(), &args, &["already holds a sweep", "`treadmill sweep --resume S`"]);
    assert_usage(folder.path(), &["sweep", "--resume", "S", "--steps", "9"], &["--parallel"]);
    assert_usage(folder.path(), &["sweep", "--resume", "S", "--trials", "9"], &["--trials", "Optuna"]);
    assert_usage(folder.path(), &["sweep", "--resume", "none"], &["no sweep at `none`"]);
    // All trials have ended.
    assert!(stdout(&done(folder.path(), &["sweep", "--resume", "S"])).contains("Best: S/trial-"));
}

#[test]
fn the_trials_of_a_sweep_share_a_pool() {
    let (folder, _) = folders();
    let at = folder.path();
    let [router] = &free_endpoints("tcp");
    let _router = start(at, &["router", "--listen", router]);
    let actor = ["actor", "--pool", "--envs", "8", "--connect", router];
    let _actors = [start(at, &actor), start(at, &actor)];
    let args = ["sweep", "--seeds", "3", "--preset", "smoke", "--steps", "4096", "--run-dir", "S", "--parallel", "2"];
    let text = stdout(&done(at, &[&args[..], &["--connect", router]].concat()));
    assert_eq!(column(at, "exit"), ["0"; 3], "{text}");
    let log = fs::read_to_string(at.join("S/trial-3.log")).unwrap();
    let name = log.split('`').nth(1).unwrap();
    assert!(name.starts_with("s-") && name.ends_with("-trial-3"), "{log}");
    let refused = ["sweep", "--seeds", "2", "--preset", "smoke", "--connect", router];
    assert_usage(at, &[&refused[..], &["--actors", "2"]].concat(), &["--connect", "--actors"]);
    assert_usage(at, &["sweep", "--seeds", "2", "--connect", "tcp/10.0.0.9:7447"], &["--insecure"]);
    assert_usage(at, &[&refused[..], &["--set", "run.share=0"]].concat(), &["`run.share` is 0", "--connect"]);
}

#[test]
fn a_grid_goes_on_after_a_trial_that_fails() {
    let (folder, _) = folders();
    search(folder.path(), "strategy = 'grid'\n[keys]\nrollout.envs = { choices = [65536, 8] }\n");
    let args = ["sweep", "search.toml", "--preset", "smoke", "--steps", "2048", "--run-dir", "S", "--parallel", "2"];
    let text = stdout(&done(folder.path(), &args));
    assert_eq!(column(folder.path(), "exit"), ["2", "0"]);
    assert_eq!(column(folder.path(), "state"), ["failed", "complete"]);
    assert_eq!(column(folder.path(), "rollout.envs"), ["65536", "8"]);
    for part in ["failed with exit code 2: ", "a fragment holds at most", "Best: S/trial-2"] {
        assert!(text.contains(part), "`{part}` is missing in {text}");
    }
    search(folder.path(), "strategy = 'grid'\n[keys]\nrollout.envs = { choices = [65536] }\n");
    let output = run(folder.path(), &[&args[..7], &["F"]].concat());
    assert_refused(&output, 1, &["all 1 trials failed", "F/trial-1.log"]);
}

#[test]
fn a_search_is_checked_before_anything_starts() {
    let (folder, _) = folders();
    let args = ["sweep", "search.toml", "--preset", "smoke", "--run-dir", "S"];
    search(
        folder.path(),
        "goal = 'far'\n[keys]\nppo.gama = { uniform = [0.9, 1] }\nppo.epochs = { integers = [0, 3] }\n",
    );
    assert_usage(
        folder.path(),
        &args,
        &[
            "`search.toml` has 3 wrong entries",
            "did you mean `ppo.gamma`?",
            "`ppo.epochs` is 0; allowed: 1 to 100",
            "`goal` is \"far\"",
        ],
    );
    // Keys that are allowed each, but not together.
    search(folder.path(), "strategy = 'grid'\n[keys]\nppo.minibatch = { choices = [256, 1024] }\n");
    assert_usage(folder.path(), &args, &["1 settings of the search are not allowed", "0 to ppo.batch, which is 512"]);
    search(folder.path(), "[keys]\nrollout.envs = { integers = [8, 64] }\n");
    assert_usage(
        folder.path(),
        &[&args[..], &["--envs", "7"]].concat(),
        &["`rollout.envs` is set by another flag too"],
    );
    assert_usage(folder.path(), &["sweep", "--trials", "3"], &["FILE"]);
    let storage = ["--storage", "sqlite:///study.db"];
    assert_usage(folder.path(), &[&args[..], &storage].concat(), &["--storage", "Optuna"]);
    search(folder.path(), "pruner = 'median'\n[keys]\nrollout.envs = { integers = [8, 64] }\n");
    let output = treadmill(folder.path()).args(args).env("TREADMILL_PYTHON", "false").output().unwrap();
    assert_refused(&output, 2, &["`treadmill_sweep` does not start", "pip install \"./python[sweep]\""]);
    let output = treadmill(folder.path()).args(args).env("TREADMILL_PYTHON", "no-python").output().unwrap();
    assert_refused(&output, 2, &["`no-python` cannot be started", "TREADMILL_PYTHON"]);
    assert!(!folder.path().join("S").exists());
}

#[test]
fn neither_a_kill_nor_ctrl_c_changes_the_results() {
    let (folder, _) = folders();
    let folder = folder.path();
    search(folder, "trials = 3\n[keys]\nppo.learning_rate = { log_uniform = [1e-4, 1e-3] }\n");
    let args = [&["sweep", "search.toml", "--parallel", "2", "--steps", "40960"][..], &SMALL].concat();
    done(folder, &[&args[..], &["--run-dir", "whole"]].concat());
    let trial = |number: u32| folder.join(format!("S/trial-{number}"));
    let trials = |sweep: &Running| children(sweep.pid(), "train");
    let mut sweep = start(folder, &[&args[..], &["--run-dir", "S"]].concat());
    await_steps(&trial(1), 2048);
    assert_usage(folder, &["sweep", "--resume", "S"], &["in use by another sweep"]);
    let orphans = trials(&sweep);
    assert_eq!(orphans.len(), 2);
    sweep.signal(libc::SIGKILL);
    sweep.wait();
    await_that("the end of the trials", || orphans.iter().all(|pid| !is_running(*pid)).then_some(()));

    sweep = start(folder, &["sweep", "--resume", "S"]);
    await_steps(&trial(1), last_step(&trial(1)) + 1024);
    sweep.signal(libc::SIGINT);
    let (status, lines) = sweep.wait();
    assert!(status.success() && lines.iter().any(|line| line.contains("treadmill sweep --resume S")), "{lines:#?}");
    assert_eq!(fs::read_to_string(folder.join("S/sweep.json")).unwrap().matches("\"exit\": null").count(), 3);

    sweep = start(folder, &["sweep", "--resume", "S"]);
    await_steps(&trial(1), last_step(&trial(1)) + 1024);
    send_signal(trials(&sweep)[0], libc::SIGKILL);
    let (status, lines) = sweep.wait();
    assert!(status.success() && lines.iter().any(|line| line.contains("goes on from its checkpoint")), "{lines:#?}");
    for number in 1..=3 {
        let [found, wanted] = ["S", "whole"].map(|sweep| latest(&folder.join(format!("{sweep}/trial-{number}"))));
        assert!(found.ppo == wanted.ppo && found.episodes == wanted.episodes, "trial {number} has another result");
    }
    assert_eq!(column(folder, "exit"), ["0"; 3]);
}

#[test]
fn the_best_of_a_population_descends_by_a_schedule_that_gives_it_anew() {
    let (folder, _) = folders();
    let folder = folder.path();
    search(
        folder,
        // With a fixed learning rate, that of the keys, processors that round otherwise agree on the best.
        "strategy = 'population'\ntrials = 4\ninterval_steps = '3k'\ngoal = 'highest train/learning_rate'\n[keys]\n\
         ppo.learning_rate = { log_uniform = [1e-5, 1e-3] }\nppo.epochs = { integers = [1, 4] }\n",
    );
    let fixed = ["--set", "ppo.target_kl=0", "--seed", "1"];
    let args = [&["sweep", "search.toml", "--steps", "9000", "--run-dir", "S"][..], &fixed, &SMALL].concat();
    done(folder, &args);
    let lineage = csv_rows(&folder.join("S/lineage.csv"));
    let steps: Vec<&str> = lineage.iter().map(|row| row["env_steps"].as_str()).collect();
    assert_eq!(steps, ["0", "0", "0", "0", "3072", "6144"], "one fork after each interval but the last");
    assert!(lineage[4]["parent"] != "5" && lineage[5]["seed"] == "6", "{lineage:#?}");
    assert!(
        fs::read_dir(folder.join("S")).unwrap().flatten().all(|entry| !entry.path().join("checkpoints").exists()
            || entry.file_name().to_string_lossy().starts_with("trial-"))
    );
    let schedule = stdout(&done(folder, &["sweep", "--schedule", "S"]));
    let best = schedule.split("S/trial-").nth(1).unwrap().split(',').next().unwrap().to_string();
    let commands: Vec<&str> = schedule.lines().filter(|line| line.starts_with("treadmill train")).collect();
    assert!(commands.len() > 1, "the best one is a fork: {schedule}");
    for command in &commands {
        let (status, lines) = start_printed(folder, command).wait();
        assert!(status.success(), "{command}: {lines:#?}");
    }
    let (found, wanted) = (
        latest(&folder.join(format!("runs/line-{}", commands.len()))),
        latest(&folder.join(format!("S/trial-{best}"))),
    );
    assert!(found.ppo == wanted.ppo, "another policy");
}

#[test]
fn no_trial_begins_on_a_full_disk() {
    let (folder, _) = folders();
    fs::create_dir(folder.path().join("small")).unwrap();
    if !works("unshare", &["-rm", "true"]) {
        return skip("`unshare -rm` is not allowed here");
    }
    let sweep = format!("{} sweep --preset smoke --run-dir small/S", env!("CARGO_BIN_EXE_treadmill"));
    let mut command = Command::new("unshare");
    command.current_dir(folder.path()).args(["-rm", "sh", "-c"]);
    command.arg(format!("mount -t tmpfs -o size=16m none small && exec {sweep}"));
    let output = command.output().unwrap();
    assert_refused(&output, 1, &["is full, so no further trial begins", "`treadmill sweep --resume small/S`"]);
}
