//! `train` as users see it: runs to the end, stops on request, resumes.

use std::fs;

use crate::support::*;

const SMOKE: [&str; 4] = ["train", "--preset", "smoke", "--json"];

fn smoke(folder: &std::path::Path, run: &std::path::Path, more: &[&str]) -> std::process::Output {
    let mut args = SMOKE.to_vec();
    args.extend(["--run-dir", run.to_str().unwrap()]);
    args.extend(more);
    self::run(folder, &args)
}

/// Asserts that the banner has the lines of its sample in README.md.
fn assert_lines_of_readme(output: &str) {
    let readme = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/README.md")).unwrap();
    let sample = readme.split("```text\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    let (before, _) = output.split_once("  resume    ").unwrap();
    let label = |line: &str| line.chars().take("  learns    ".len()).collect::<String>();
    let labels = |banner: &str| banner.lines().skip(1).map(label).collect::<Vec<_>>();
    assert_eq!(labels(sample), labels(&format!("{before}  resume    ")));
}

#[test]
fn a_run_prints_its_banner_and_leaves_all_files() {
    let (folder, run) = folders();
    let output = smoke(folder.path(), &run, &[]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(!stdout(&output).contains('\u{1b}'), "no escape codes without a terminal");
    let summary = last_json(&output);
    for field in ["wall_s", "env_steps_per_s", "return_mean", "length_mean", "distance_mean_m", "velocity_mean_mps"] {
        assert!(summary[field].is_f64(), "{field} in {summary}");
    }
    assert_eq!((&summary["run"], &summary["restarts"]), (&"run".into(), &0.into()));
    // An actor that is late, or joins in the middle of a round, leaves a batch with more than 512 steps.
    let (env_steps, updates) = (summary["env_steps"].as_u64().unwrap(), summary["updates"].as_u64().unwrap());
    assert!(
        (8192..8192 + 1024).contains(&env_steps) && (8..=16).contains(&updates),
        "{env_steps} in {updates} updates"
    );
    let text = stdout(&output);
    for part in [
        "to go forward and not to fall, in 8,192 env steps (at most 16 updates); the remaining time appears once the \
         speed is known",
        "watch     treadmill status --watch ",
        "film      treadmill eval ",
        "resume    treadmill train --resume ",
        "\nafter ",
        "reached: return ",
        "see how far it walks: treadmill eval ",
    ] {
        assert!(text.contains(part), "`{part}` is missing in: {text}");
    }
    assert_lines_of_readme(&text);

    for file in [
        "config.toml",
        "command.txt",
        "versions.json",
        "model.xml",
        "endpoint.txt",
        "checkpoints/latest.bundle",
        "checkpoints/best.bundle",
    ] {
        assert!(run.join(file).is_file(), "{file}");
    }
    assert!(fs::read_to_string(run.join("command.txt")).unwrap().contains("train --preset smoke"));
    assert!(fs::read(run.join("learning_curve.png")).unwrap().starts_with(b"\x89PNG"));
    let events = fs::read_dir(&run).unwrap().flatten();
    // One for the metrics and one for the final status.
    assert_eq!(
        events.filter(|entry| entry.file_name().to_string_lossy().starts_with("events.out.tfevents.")).count(),
        2
    );
    let metrics = metrics(&run);
    for tag in [
        "rollout/ep_rew_mean",
        "time/fps",
        "train/approx_kl",
        "train/explained_variance",
        "bus/policy_lag_mean",
        "rewards/forward",
        "actors/alive",
    ] {
        assert!(metrics.iter().any(|(name, ..)| name == tag), "{tag}");
    }
    let logged = metrics.iter().filter(|(name, ..)| name == "train/learning_rate").count();
    assert_eq!(logged as u64, updates, "one line for each update");
    let documented = page("reference/metrics");
    for term in metrics.iter().filter_map(|(tag, ..)| tag.strip_prefix("rewards/")) {
        assert!(documented.contains(&format!("`{term}`")), "docs/reference/metrics.md does not name {term}");
    }
    assert_eq!(last_value(&run, "bus/policy_lag_max"), Some(0.0), "actors work in lock-step with the learner");
}

#[test]
fn the_learning_curve_appears_during_the_run() {
    let (folder, run_folder) = folders();
    let mut command = endless(folder.path(), &run_folder, "train");
    command.env("LC_ALL", "C.UTF-8");
    let running = Running::start(command);
    let line = running.wait_for("steps/s");
    for part in ["return ", "length ", "distance ", "used "] {
        assert!(line.contains(part), "`{part}` is missing in: {line}");
    }
    assert!(line.chars().count() <= 160, "{line}");
    let png = run_folder.join("learning_curve.png");
    await_that("a picture of the learning curve", || fs::read(&png).ok().filter(|png| png.starts_with(b"\x89PNG")));
    assert!(is_running(running.pid()), "the run is not over");
    running.signal(libc::SIGTERM);
    let (status, lines) = running.wait();
    assert!(status.success());
    let line = lines.iter().find(|line| line.starts_with("after ")).expect("the curves");
    for part in ["return ", " → ", "distance ", "▁"] {
        assert!(line.contains(part), "`{part}` is missing in: {line}");
    }
}

#[test]
fn a_waiting_learner_reports_the_reason_and_progress_can_be_turned_off() {
    let (folder, run_folder) = folders();
    let path = run_folder.to_str().unwrap();
    let mut command = treadmill(folder.path());
    command.args(["learner", "--preset", "smoke", "--listen", "tcp/127.0.0.1:0", "--run-dir", path]);
    let learner = Running::start(command);
    let line = learner.wait_for("s: no actor is connected");
    assert!(
        line.contains("waiting for experience for ")
            && line.contains("start one: treadmill actor --connect tcp/127.0.0.1:"),
        "{line}"
    );
    learner.signal(libc::SIGTERM);
    assert!(learner.wait().0.success());
    let (quiet_folder, quiet) = folders();
    let output = smoke(quiet_folder.path(), &quiet, &["--no-progress"]);
    assert!(output.status.success() && !stdout(&output).contains("\nafter "), "{}", stdout(&output));
}

#[test]
fn training_works_with_the_full_observations_of_gymnasium() {
    for (preset, size, task) in [("walk-v5obs", 348, "humanoid-v5"), ("walk-v4obs", 376, "humanoid-v4")] {
        let (folder, run) = folders();
        let small = ["ppo.batch=512", "ppo.minibatch=256", "ppo.epochs=2", "policy.hidden=[16]", "rollout.envs=8"];
        let mut args = vec!["train", "--preset", preset, "--steps", "3072", "--run-dir", run.to_str().unwrap()];
        args.extend(["--actors", "1", "--set", "rollout.fragment_steps=64"]);
        small.iter().for_each(|pair| args.extend(["--set", pair]));
        let output = self::run(folder.path(), &args);
        assert!(output.status.success(), "{preset}: {}", stderr(&output));
        let state = latest(&run);
        assert_eq!(state.shape().observation, size);
        assert!(state.config_toml.contains(&format!("task = \"{task}\"")));
        assert_eq!(state.counters.updates, 6);
        assert!(state.ppo.parameters().iter().all(|parameter| parameter.is_finite()));
        for tag in ["train/value_loss", "train/approx_kl", "rollout/ep_rew_mean"] {
            assert!(last_value(&run, tag).unwrap().is_finite(), "{preset} {tag}");
        }
        assert_eq!(last_value(&run, "train/undone_updates"), Some(0.0), "{preset}");
        // Masses and the world's rows are constant; their variance is zero, and the normaliser handles that.
        let variances = state.ppo.trained_policy().observation_moments.variance();
        assert!(variances.iter().filter(|variance| **variance < 1e-12).count() >= 13, "{preset}");
        assert!(variances.iter().all(|variance| variance.is_finite()));
        // The best policy may be an earlier one.
        let newest = ["--checkpoint", "latest", "--episodes", "1", "--json"];
        let output = self::run(folder.path(), &[&["eval", run.to_str().unwrap()], &newest[..]].concat());
        let mut played = last_json(&output);
        assert_eq!(played["episodes"], 1, "{}", stderr(&output));
        assert_eq!(
            (played["checkpoint"].take(), played["checkpoint_env_steps"].take()),
            ("latest".into(), 3072.into())
        );
        // The exported policy holds open ranges and the kind of observation.
        let exported = folder.path().join("policy.safetensors");
        let args =
            ["export", run.to_str().unwrap(), "--checkpoint", "latest", "--safetensors", exported.to_str().unwrap()];
        done(folder.path(), &args);
        let again = self::run(folder.path(), &["eval", exported.to_str().unwrap(), "--episodes", "1", "--json"]);
        assert_eq!(last_json(&again), played, "{}", stderr(&again));
    }
}

#[test]
fn equivariant_networks_are_the_default_and_continue_after_a_resume() {
    let (folder, run) = folders();
    let output = smoke(folder.path(), &run, &["--actors", "1"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let args = ["train", "--resume", run.to_str().unwrap(), "--steps", "12288", "--json"];
    let resumed = done(folder.path(), &args);
    assert_eq!(last_json(&resumed)["updates"], 24);
    let (dense_folder, dense) = folders();
    let odd = ["--actors", "1", "--set", "policy.hidden=[32, 31]"];
    assert!(smoke(dense_folder.path(), &dense, &odd).status.success());
    let networks = |run: &std::path::Path| latest(run).ppo.networks().clone();
    assert!(networks(&run).mirror().is_some() && networks(&dense).mirror().is_none());
}

#[test]
fn the_same_seed_gives_the_same_weights_bit_for_bit() {
    let weights = |seed: &str, more: &[&str]| {
        let (folder, run) = folders();
        let args = [&["--deterministic", "--seed", seed, "--steps", "2048"], more].concat();
        let output = smoke(folder.path(), &run, &args);
        assert!(output.status.success(), "{}", stderr(&output));
        latest(&run).ppo.parameters().to_vec()
    };
    let first = weights("7", &[]);
    assert_eq!(first, weights("7", &[]));
    assert_eq!(first, weights("7", &["--set", "rollout.threads=2"]), "threads change no result");
    assert_ne!(first, weights("8", &[]));
    let randomised = ["--set", "randomisation.mass_scale=[0.8, 1.2]", "--set", "randomisation.control_noise=0.1"];
    let other = weights("7", &randomised);
    assert_ne!(first, other);
    assert_eq!(other, weights("7", &randomised));
}

#[test]
fn the_first_ctrl_c_saves_and_prints_the_resume_command() {
    let (folder, run) = folders();
    let training = Running::start(endless(folder.path(), &run, "train"));
    await_steps(&run, 1024);
    let actors = children(training.pid(), "actor");
    assert_eq!(actors.len(), 2);
    training.signal(libc::SIGINT);
    let resume = training.wait_for("resume with:");
    let (status, _) = training.wait();
    assert!(status.success(), "{status}");
    assert!(resume.contains(&format!("treadmill train --resume {}", run.display())));
    await_that("the end of the actors", || actors.iter().all(|pid| !is_running(*pid)).then_some(()));
    let saved = latest(&run).counters.env_steps;
    assert_eq!(last_value(&run, "time/total_timesteps"), Some(saved as f64));
    let steps = (saved + 512).to_string();
    let output = self::run(folder.path(), &["train", "--resume", run.to_str().unwrap(), "--steps", &steps, "--json"]);
    // Actors join one after the other, so the first batch may hold one fragment more.
    let trained = last_json(&output)["env_steps"].as_u64().expect("a number") - saved;
    assert!([512, 768].contains(&trained), "{trained} steps");
}

#[test]
fn the_second_ctrl_c_ends_the_process_at_once() {
    let (folder, run) = folders();
    let mut command = endless(folder.path(), &run, "train");
    command.args(["--set", "ppo.epochs=100", "--set", "ppo.batch=65536", "--set", "ppo.minibatch=16"]);
    let training = Running::start(command);
    // The first update is long: a hundred epochs of four thousand gradient steps. Ctrl-C arrives during it.
    await_that("a busy training thread", || {
        let threads = fs::read_dir(format!("/proc/{}/task", training.pid())).ok()?;
        let busy = threads.flatten().any(|thread| {
            let name = fs::read_to_string(thread.path().join("comm")).unwrap_or_default();
            let stat = fs::read_to_string(thread.path().join("stat")).unwrap_or_default();
            let ticks = stat
                .rsplit(')')
                .next()
                .and_then(|rest| rest.split_whitespace().nth(11))
                .and_then(|t| t.parse::<u64>().ok());
            name.starts_with("training") && ticks.is_some_and(|ticks| ticks > 20)
        });
        busy.then_some(())
    });
    training.signal(libc::SIGINT);
    training.wait_for("press Ctrl-C again");
    training.signal(libc::SIGINT);
    let (status, _) = training.wait();
    assert_eq!(status.code(), Some(130));
}

#[test]
fn a_learner_without_actors_of_its_own_begins_in_async() {
    let (folder, run) = folders();
    for (more, mode) in [(&[][..], "async"), (&["--set", "learner.mode=sync"], "sync")] {
        let mut command = treadmill(folder.path());
        command.args(["learner", "--preset", "smoke", "--listen", "tcp/127.0.0.1:0"]).args(more);
        command.args(["--run-dir", run.join(mode).to_str().unwrap()]);
        let _learner = Running::start(command);
        endpoint(&run.join(mode));
        let config = fs::read_to_string(run.join(mode).join("config.toml")).unwrap();
        assert!(config.contains(&format!("\nmode = \"{mode}\"\n")), "{config}");
    }
}

#[test]
fn fragments_that_are_too_large_to_send_are_refused_before_anything_is_written() {
    let (folder, run) = folders();
    let flags = ["--envs", "5000", "--actors", "1", "--set", "rollout.fragment_steps=32"];
    let parts = ["fragments of 5000 environments with 32 steps", "at most 3684 environments", "use --actors 2"];
    assert_refused(&smoke(folder.path(), &run, &flags), 2, &parts);
    assert!(!run.exists());
}

#[test]
fn runs_get_the_first_free_name_and_are_not_overwritten() {
    let (folder, _) = folders();
    for name in ["smoke-1", "smoke-2"] {
        let output = self::run(folder.path(), &["train", "--preset", "smoke", "--steps", "512", "--json"]);
        assert_eq!(last_json(&output)["run"], name);
        assert!(folder.path().join("runs").join(name).join("metrics.jsonl").is_file());
    }
    let again = smoke(folder.path(), &folder.path().join("runs/smoke-1"), &[]);
    assert_refused(&again, 2, &["already holds a run", "--resume"]);
}
