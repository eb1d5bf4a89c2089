//! Runs that begin with another run's policy, and runs that branch off.

use std::{fs, path::Path};

use crate::support::*;
use treadmill_learner::checkpoint::{TrainingState, load_file};

/// Starts a learner without actors, and returns its first state and the beginning of its output.
fn first_state(folder: &Path, name: &str, args: &[&str]) -> (TrainingState, Vec<String>) {
    let mut command = treadmill(folder);
    command.args(["learner", "--listen", "tcp/127.0.0.1:0", "--run-dir", name]).args(args);
    let learner = Running::start(command);
    // It saves its first state before it listens.
    learner.wait_for("resume    treadmill");
    let state = await_that("the first state", || load_file(&folder.join(name).join("checkpoints/latest.bundle")).ok());
    learner.signal(libc::SIGTERM);
    let (_, lines) = learner.wait();
    (state, lines)
}

/// Asserts that the parameters are equal but for the rounding between dense and equivariant networks.
#[track_caller]
fn assert_near(found: &[f32], expected: &[f32]) {
    let apart = found.iter().zip(expected).map(|(found, expected)| (found - expected).abs()).fold(0.0, f32::max);
    assert!(found.len() == expected.len() && apart < 1e-6, "{apart}");
}

#[test]
fn a_run_begins_with_weights_and_statistics_of_another_one_and_new_counters() {
    let (folder, run_folder) = folders();
    let folder = folder.path();
    trained(folder, &run_folder);
    let theirs = latest(&run_folder);
    let smoke = ["--preset", "smoke"];
    let from = [&smoke[..], &["--init-from", "run", "--checkpoint", "latest", "--seed", "5"]].concat();
    let (ours, _) = first_state(folder, "warm", &from);
    let (our_policy, their_policy) = (ours.ppo.trained_policy(), theirs.ppo.trained_policy());
    assert_near(&our_policy.parameters, &their_policy.parameters);
    assert_eq!(our_policy.value_moments, their_policy.value_moments);
    assert_eq!(ours.ppo.gradient_steps(), 0);
    assert_eq!(ours.ppo.learning_rate(), 1e-5, "it begins with small steps");
    assert_eq!((ours.counters.env_steps, ours.counters.updates, &ours.run[..]), (0, 0, "warm"));
    let (ours, theirs_moments) = (our_policy.observation_moments, their_policy.observation_moments);
    assert_eq!((ours.count, ours.mean), (theirs_moments.count, theirs_moments.mean));
    for (ours, theirs) in ours.m2.iter().zip(&theirs_moments.m2) {
        assert!((ours - theirs).abs() <= 1e-9 * theirs.abs(), "{ours} {theirs}");
    }

    // So does a file of `export`.
    done(folder, &["export", "run", "--checkpoint", "latest", "--safetensors", "policy.safetensors"]);
    let from = [&smoke[..], &["--init-from", "policy.safetensors"]].concat();
    let (ours, _) = first_state(folder, "exported", &from);
    let ours = ours.ppo.trained_policy();
    assert_near(&ours.parameters, &their_policy.parameters);
    let (ours, theirs) = (ours.value_moments.unwrap(), their_policy.value_moments.unwrap());
    assert_eq!((ours.count, ours.mean), (theirs.count, theirs.mean));
    assert!((ours.m2[0] / theirs.m2[0] - 1.0).abs() < 1e-12);

    let train = |args: &[&str]| run(folder, &[&["train", "--preset", "smoke", "--run-dir", "other"], args].concat());
    let parts = ["--init-from run", "policy.hidden"];
    assert_refused(&train(&["--init-from", "run", "--set", "policy.hidden=[8]"]), 2, &parts);
    assert_refused(&train(&["--init-from", "rum"]), 2, &["no run at `rum`", "did you mean `run`?"]);
    assert_refused(&train(&["--init-from", "run", "--resume", "run"]), 2, &["cannot be used with"]);
    assert_refused(&train(&["--checkpoint", "best"]), 2, &["--resume", "--init-from", "--fork"]);
    assert!(!folder.join("other").exists(), "a refused start leaves no folder");
}

#[test]
fn a_policy_meets_its_own_body_whatever_the_order_of_its_file() {
    let (folder, run_folder) = folders();
    let folder = folder.path();
    trained(folder, &run_folder);
    // The built-in humanoid with its legs in the other order.
    let text = fs::read_to_string(run_folder.join("model.xml")).unwrap();
    let body = |name: &str| {
        let start = text.find(&format!("<body name=\"{name}\"")).unwrap();
        let (mut depth, mut end) = (0, start);
        for (at, _) in text[start..].match_indices('<') {
            let rest = &text[start + at..];
            depth += i32::from(rest.starts_with("<body")) - i32::from(rest.starts_with("</body>"));
            if depth == 0 {
                end = start + at + "</body>".len();
                break;
            }
        }
        start..end
    };
    let (right, left) = (body("right_thigh"), body("left_thigh"));
    let (one, two) = if right.start < left.start { (right, left) } else { (left, right) };
    let parts = [&text[..one.start], &text[two.clone()], &text[one.end..two.start], &text[one], &text[two.end..]];
    fs::write(folder.join("swapped.xml"), parts.concat()).unwrap();
    let eval = |more: &[&str]| {
        let args = [&["eval", "run", "--checkpoint", "latest", "--episodes", "2", "--json"], more].concat();
        last_json(&done(folder, &args))
    };
    assert_eq!(eval(&["--model", "swapped.xml"]), eval(&[]));
    let smoke = ["--preset", "smoke", "--init-from", "run", "--checkpoint", "latest", "--model", "swapped.xml"];
    let (ours, _) = first_state(folder, "swapped", &smoke);
    assert_near(&ours.ppo.trained_policy().parameters, &latest(&run_folder).ppo.trained_policy().parameters);
    let order = |text: &str| ["right_thigh", "left_thigh"].map(|name| text.find(&format!("<body name=\"{name}\"")));
    let is_right_first = |text: &str| order(text)[0] < order(text)[1];
    assert_eq!(is_right_first(&ours.model_xml), is_right_first(&text));

    fs::write(folder.join("renamed.xml"), text.replace("right_knee", "other_knee")).unwrap();
    let parts = ["renamed.xml", "trained with another body", "`other_knee`", "`right_knee`"];
    assert_refused(&run(folder, &["eval", "run", "--model", "renamed.xml", "--episodes", "1"]), 2, &parts);
    let train = ["train", "--preset", "smoke", "--init-from", "run", "--model", "renamed.xml", "--run-dir", "never"];
    assert_refused(&run(folder, &train), 2, &parts);
    assert!(!folder.join("never").exists());
}

#[test]
fn a_fork_goes_on_in_a_folder_of_its_own_with_other_keys() {
    let (folder, run_folder) = folders();
    let folder = folder.path();
    trained(folder, &run_folder);
    let theirs = latest(&run_folder);
    let (steps, updates) = (theirs.counters.env_steps, theirs.counters.updates);
    let args = ["--fork", "run", "--set", "ppo.epochs=3", "--set", "ppo.learning_rate=7e-5", "--steps", ENDLESS];
    let (ours, _) = first_state(folder, "branch", &args);
    assert_eq!((ours.counters.env_steps, ours.counters.updates, &ours.run[..]), (steps, updates, "branch"));
    assert_eq!(ours.ppo.parameters(), theirs.ppo.parameters());
    assert_eq!((ours.ppo.gradient_steps(), ours.ppo.learning_rate()), (theirs.ppo.gradient_steps(), 7e-5));
    let config = ours.config().unwrap();
    assert_eq!((config.ppo.epochs, config.ppo.batch), (3, theirs.config().unwrap().ppo.batch));
    assert_eq!(latest(&run_folder), theirs, "the forked run is unchanged");

    let args = ["train", "--fork", "run", "--run-dir", "on", "--no-progress", "--steps"];
    let further = (steps + 1024).to_string();
    let trained = done(folder, &[&args[..], &[&further]].concat());
    assert!(stdout(&trained).contains("branching off at"), "{}", stdout(&trained));
    let ours = latest(&folder.join("on"));
    assert!(ours.counters.env_steps >= steps + 1024 && ours.counters.updates > updates);
    assert!(metrics(&folder.join("on")).iter().all(|(_, step, _)| *step > steps), "its curves begin at the fork");

    let refused = |args: &[&str], parts: &[&str]| {
        assert_refused(&run(folder, &[&["train", "--fork", "run"], args].concat()), 2, parts)
    };
    refused(&["--steps", "10"], &["is at", "go on with `--steps"]);
    refused(&["--steps", ENDLESS, "--set", "policy.hidden=[8]"], &["policy.hidden"]);
    refused(&["--steps", ENDLESS, "--set", "env.observation=gymnasium-v5"], &["env.observation"]);
    refused(&["--preset", "walk"], &["--preset"]);
    assert!(!folder.join("runs").exists(), "a refused start leaves no folder");
}

#[test]
fn a_service_begins_from_a_policy_once_and_then_goes_on() {
    let (folder, run_folder) = folders();
    let folder = folder.path();
    trained(folder, &run_folder);
    // Only the other run has a best policy.
    fs::copy(run_folder.join("checkpoints/latest.bundle"), run_folder.join("checkpoints/best.bundle")).unwrap();
    let service =
        ["--preset", "smoke", "--resume-or-start", "--init-from", "run", "--checkpoint", "best", "--tag", "a"];
    let train = |steps: &str| {
        let args = ["train", "--run-dir", "service", "--no-progress", "--steps", steps];
        done(folder, &[&args[..], &service].concat());
        latest(&folder.join("service")).counters
    };
    let (first, second) = (train("1024"), train("3072"));
    assert!(first.updates > 0 && second.updates > first.updates, "it goes on from its newest checkpoint");
    assert_eq!((first.resumes, second.resumes), (0, 1));
    // A finished run keeps its labels.
    let relabelled = run(folder, &["train", "--resume", "service", "--tag", "b"]);
    assert_refused(&relabelled, 2, &["this one is finished", "add --steps"]);
}

#[test]
fn tags_and_description_are_shown_and_may_change() {
    let (folder, run_folder) = folders();
    let folder = folder.path();
    let args = ["train", "--preset", "smoke", "--steps", "512", "--run-dir", "run", "--no-progress", "--tag", "slow"];
    done(folder, &[&args[..], &["--tag", "v2", "--description", "fewer \"steps\""]].concat());
    let listed = stdout(&run(folder, &["runs", "run"]));
    assert!(listed.lines().any(|line| line == "    [slow] [v2] fewer \"steps\""), "{listed}");
    let record = last_json(&run(folder, &["runs", "run", "--json"]));
    assert_eq!((&record["tags"][1], &record["description"]), (&"v2".into(), &"fewer \"steps\"".into()));

    let resumed =
        run(folder, &["train", "--resume", "run", "--steps", "4096", "--no-progress", "--description", "new"]);
    assert!(resumed.status.success(), "{}", stderr(&resumed));
    let config = fs::read_to_string(run_folder.join("config.toml")).unwrap();
    assert!(config.contains("description = \"new\"") && config.contains("\"slow\""), "{config}");
    let two_words = run(folder, &["train", "--preset", "smoke", "--tag", "two words"]);
    assert_refused(&two_words, 2, &["run.tags", "1 to 32 characters"]);
}
