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
