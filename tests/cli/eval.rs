//! `eval`: policies, baselines, and unusable checkpoints.

use std::fs;

use crate::support::*;
use treadmill_config::PpoConfig;
use treadmill_learner::checkpoint::{encoding, load_file};
use treadmill_policy::NetworkShape;
use treadmill_ppo::PpoState;
use treadmill_runtime::seeds;

#[test]
fn the_first_and_every_nth_step_are_printed() {
    let (folder, _) = folders();
    let output = done(folder.path(), &["eval", "--agent", "random", "--episodes", "2", "--print-every", "5"]);
    let text = stdout(&output);
    let steps: Vec<&str> = text.lines().filter(|line| line.starts_with("episode   1")).collect();
    assert!(
        steps[0].contains("step    1") && steps[1].contains("step    5") && steps[2].contains("step   10"),
        "{text}"
    );
    assert!(steps[0].contains("reward") && steps[0].contains("total"));
    assert!(text.contains("distance") && !text.contains("limit overshoot"), "{text}");
    let default = stdout(&self::run(folder.path(), &["eval", "--agent", "random", "--episodes", "1"]));
    assert_eq!(
        default.lines().filter(|line| line.starts_with("episode   1")).count(),
        1,
        "random actions fall before step 100"
    );
}

#[test]
fn every_agent_reports_all_fields_and_repeats_with_its_seed() {
    let (folder, run) = folders();
    trained(folder.path(), &run);
    let run_name = run.to_str().unwrap();
    for agent in ["policy", "random", "preferred-action"] {
        let play = |seed: &str| {
            let which: &[&str] = if agent == "policy" { &[run_name] } else { &["--agent", agent] };
            let args = [&["eval", "--episodes", "3", "--seed", seed, "--json"], which].concat();
            let output = self::run(folder.path(), &args);
            assert_eq!(stdout(&output).lines().count(), 1, "{}", stderr(&output));
            last_json(&output)
        };
        let result = play("1");
        assert_eq!((&result["agent"], &result["episodes"]), (&agent.into(), &3.into()));
        for field in [
            "return_mean",
            "return_std",
            "length_mean",
            "distance_mean_m",
            "velocity_mean_mps",
            "limit_overshoot_p999_rad",
        ] {
            assert!(result[field].is_f64(), "{field} in {result}");
        }
        assert!(result["falls"].is_u64());
        assert!(result["length_mean"].as_f64().unwrap() > 5.0);
        assert_eq!(result, play("1"));
        assert_ne!(result["return_mean"], play("2")["return_mean"]);
    }
}

#[test]
fn the_checkpoint_that_plays_is_named() {
    let (folder, run) = folders();
    trained(folder.path(), &run);
    let path = run.to_str().unwrap();
    let play = |more: &[&str]| self::run(folder.path(), &[&["eval", path, "--episodes", "1"], more].concat());
    assert!(stdout(&play(&[])).contains("policy of checkpoint latest, 2,048 steps"));
    fs::copy(run.join("checkpoints/latest.bundle"), run.join("checkpoints/best.bundle")).unwrap();
    assert!(stdout(&play(&[])).contains("policy of checkpoint best, 2,048 steps"));
    let exported = self::run(folder.path(), &["export", path, "--safetensors", "a.safetensors", "--json"]);
    for printed in [last_json(&play(&["--json"])), last_json(&exported)] {
        assert_eq!((&printed["checkpoint"], &printed["checkpoint_env_steps"]), (&"best".into(), &2048.into()));
    }
    assert!(stdout(&play(&["--verbose"])).contains("limit overshoot"));
    // A bundle can be played without its run.
    let bundle = run.join("checkpoints/latest.bundle");
    let played = self::run(folder.path(), &["eval", bundle.to_str().unwrap(), "--episodes", "1", "--json"]);
    assert_eq!(last_json(&played)["episodes"], 1);
}

#[test]
fn arguments_without_effect_are_refused() {
    let (folder, run) = folders();
    trained(folder.path(), &run);
    let path = run.to_str().unwrap();
    let eval = |args: &[&str]| self::run(folder.path(), &[&["eval"], args].concat());
    assert_refused(&eval(&[path, "--agent", "random"]), 2, &["leave RUN out"]);
    assert_refused(&eval(&["--agent", "random", "--checkpoint", "best"]), 2, &["leave --checkpoint out"]);
    done(folder.path(), &["export", path, "--safetensors", "a.safetensors"]);
    assert_refused(&eval(&["a.safetensors", "--checkpoint", "best"]), 2, &["a.safetensors", "leave --checkpoint out"]);
    done(folder.path(), &["export", path, "--onnx", "a.onnx"]);
    assert_refused(&eval(&["a.onnx"]), 2, &["a.onnx", "ONNX", "--safetensors"]);
    assert_refused(&eval(&[path, "--json", "--verbose"]), 2, &["--json", "--verbose"]);
}

#[test]
fn a_closed_pipe_ends_the_episodes() {
    let (folder, _) = folders();
    let mut command = treadmill(folder.path());
    command.args(["eval", "--agent", "random", "--episodes", "100000", "--print-every", "1"]);
    let mut playing = command.stdout(std::process::Stdio::piped()).spawn().unwrap();
    drop(playing.stdout.take());
    let status = await_that("the end of the evaluation", || playing.try_wait().unwrap());
    assert!(status.success());
}

#[test]
fn episodes_are_randomised_only_on_request() {
    let (folder, run) = folders();
    let run_name = run.to_str().unwrap();
    let train = ["train", "--preset", "smoke", "--steps", "1024", "--run-dir", run_name];
    let pushes = ["--set", "randomisation.push_mps=[2, 3]", "--set", "randomisation.push_interval_s=[0.1, 0.2]"];
    done(folder.path(), &[&train[..], &pushes[..]].concat());
    let play = |more: &[&str]| {
        let output = done(folder.path(), &[&["eval", run_name, "--episodes", "2", "--json"], more].concat());
        last_json(&output)
    };
    let (plain, pushed) = (play(&[]), play(&["--randomised"]));
    assert_ne!(plain["return_mean"], pushed["return_mean"]);
    assert_eq!(pushed, play(&["--randomised"]), "the same seed gives the same pushes");
    assert_eq!(pushed, play(&pushes), "the same ranges give the same episodes");
    assert_eq!(plain, play(&["--set", "randomisation.push_mps=[0, 0]"]));
    assert_eq!(play(&["--set", "env.max_episode_steps=3"])["length_mean"], 3.0);

    let refused = |args: &[&str], parts: &[&str]| assert_usage(folder.path(), args, parts);
    refused(&["eval", "--agent", "random", "--randomised"], &["--randomised", "randomised nothing", "--set"]);
    refused(&["eval", run_name, "--set", "ppo.gamma=0.5"], &["ppo.gamma=0.5", "[env], [velocity]"]);
    refused(&["eval", run_name, "--set", "randomisation.push_mps=[3, 2]"], &["push_mps", "[smallest, largest]"]);
}

#[test]
fn unusable_checkpoints_are_refused_by_name_and_reason() {
    let (folder, run) = folders();
    trained(folder.path(), &run);
    let run_name = run.to_str().unwrap();
    let latest = run.join("checkpoints/latest.bundle");
    let valid = fs::read(&latest).unwrap();
    // Where enough episodes have ended, there is another sound checkpoint.
    drop(fs::remove_file(run.join("checkpoints/best.bundle")));
    let eval = || self::run(folder.path(), &["eval", run_name, "--checkpoint", "latest"]);
    let resume = || self::run(folder.path(), &["train", "--resume", run_name, "--steps", "2048"]);

    fs::write(&latest, &valid[..valid.len() / 2]).unwrap();
    assert_refused(&eval(), 1, &["latest.bundle", "truncated"]);
    assert_refused(&resume(), 1, &["latest.bundle", "truncated"]);

    let mut other = {
        fs::write(&latest, &valid).unwrap();
        load_file(&latest).unwrap()
    };
    let shape = NetworkShape { hidden: vec![16, 16], ..other.shape().clone() };
    let parameters = vec![0.0; other.ppo.parameters().len()];
    other.ppo = PpoState::new(shape.into(), parameters, seeds::stream(1, "shuffle", &[]), &PpoConfig::default());
    fs::write(&latest, encoding::encode(&other).unwrap()).unwrap();
    assert_refused(&eval(), 1, &["latest.bundle", "does not fit its network", "parameters"]);
    assert_refused(&resume(), 1, &["latest.bundle", "does not fit its network"]);

    fs::remove_file(&latest).unwrap();
    assert_refused(&eval(), 1, &["no checkpoint", "latest.bundle"]);
    let numbered = self::run(folder.path(), &["eval", run_name, "--checkpoint", "99"]);
    assert_refused(&numbered, 1, &["no checkpoint", "00000099.bundle"]);
    assert_refused(
        &self::run(folder.path(), &["eval", run_name, "--checkpoint", "newest"]),
        2,
        &["newest", "best, latest"],
    );
}
