//! The player of exported policies in MuJoCo, which needs neither Zenoh nor Gymnasium.

use std::path::PathBuf;

use crate::support::*;

#[test]
fn the_player_of_exported_policies_passes_its_own_tests() {
    let Some(mut python) = python_with("mujoco, numpy, onnx, onnxruntime") else { return };
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("python");
    python.env("PYTHONPATH", &folder).current_dir(folder.join("tests"));
    let output = python.args(["-m", "unittest", "test_transfer", "test_transfer_robot"]).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(stderr(&output).contains("OK") && !stderr(&output).contains("Ran 0 tests"), "{}", stderr(&output));
}

#[test]
fn a_walking_policy_plays_in_mujoco_by_its_contract() {
    let Some(mut python) = python_with("mujoco, numpy, onnxruntime") else { return };
    let (folder, run) = folders();
    let folder = folder.path();
    let tasks = ["--set", "env.observation=gymnasium-v5", "--set", "env.task=humanoid-v5"];
    let train = ["train", "--preset", "smoke", "--steps", "512", "--actors", "1", "--run-dir", run.to_str().unwrap()];
    done(folder, &[&train[..], &tasks].concat());
    done(folder, &["export", "run", "--onnx", "walk.onnx"]);
    done(folder, &["eval", "run", "--episodes", "2", "--trace", "trace.jsonl"]);
    python.env("PYTHONPATH", PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("python")).current_dir(folder);
    let play = |more: &[&str]| {
        let model = run.join("model.xml");
        let fixed = ["-m", "treadmill_transfer", "walk.onnx", "--model", model.to_str().unwrap()];
        let mut command = std::process::Command::new(python.get_program());
        command.envs(python.get_envs().filter_map(|(name, value)| Some((name, value?)))).current_dir(folder);
        command.args(fixed).args(more).output().unwrap()
    };
    let played = last_json(&play(&["--episodes", "2", "--json"]));
    assert_eq!(played["episodes"], 2);
    assert!(played["length_mean"].as_f64().unwrap() > 5.0, "{played}");
    let compared = play(&["--trace", "trace.jsonl", "--json"]);
    let result = last_json(&compared);
    assert!(compared.status.success() && result["steps"].as_u64().unwrap() > 10, "{result}");
    assert!(result["largest"]["action"].as_f64().unwrap() < 1e-4, "{result}");
    assert_refused(&play(&["--commands", "c.csv"]), 2, &["--commands", "leave it out"]);
    std::fs::write(
        run.join("model.xml"),
        include_str!("../../actor/humanoid/assets/humanoid.xml").replace("torso", "trunk"),
    )
    .unwrap();
    assert_refused(&play(&[]), 2, &["has the bodies", "trunk", "expects torso"]);
}

#[test]
fn a_policy_that_imitates_a_motion_plays_in_mujoco_by_its_contract() {
    let Some(mut python) = python_with("mujoco, numpy, onnxruntime") else { return };
    let (folder, run) = folders();
    let folder = folder.path();
    motion::write_imitated_robot(folder);
    motion::write_motion(folder, "squat.csv", 0.6);
    let train =
        ["train", "--preset", "smoke", "--task", "motion", "--steps", "512", "--actors", "1", "--model", "robot.toml"];
    let time = ["env.control_step_s=0.02", "env.substeps=5", "motion.future_steps=2"];
    let motion = ["--motion", "squat.csv", "--fps", "50", "--run-dir", run.to_str().unwrap()];
    done(folder, &[&train[..], &set(&time), &motion].concat());
    done(folder, &["export", "run", "--onnx", "squat.onnx"]);
    done(folder, &["eval", "run", "--episodes", "2", "--trace", "trace.jsonl"]);
    let folder_of_package = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("python");
    python.env("PYTHONPATH", folder_of_package).current_dir(folder);
    python.args(["-m", "treadmill_transfer", "squat.onnx", "--model", "robot.xml", "--json"]);
    let play = |more: &[&str]| {
        let mut command = std::process::Command::new(python.get_program());
        command.envs(python.get_envs().filter_map(|(name, value)| Some((name, value?)))).current_dir(folder);
        command.args(python.get_args()).args(more).output().unwrap()
    };
    // The same observations and actions in the same states.
    let compared = play(&["--trace", "trace.jsonl"]);
    let result = last_json(&compared);
    assert!(compared.status.success() && result["steps"].as_u64().unwrap() > 10, "{result} {}", stderr(&compared));
    let played = last_json(&play(&["--episodes", "2", "--no-pushes"]));
    assert_eq!(played["episodes"], 2);
    assert!((0.0..=1.0).contains(&played["done_share"].as_f64().unwrap()), "{played}");
    assert_refused(&play(&["--commands", "c.csv"]), 2, &["--commands", "leave it out"]);
}
