//! `--device cuda` with a driver of the tests, which runs the kernels on the processor; see `learner/gpu/tests/stand_in`.

use std::{path::Path, process::Output};

use crate::support::*;

#[path = "../../learner/gpu/tests/stand_in/mod.rs"]
mod stand_in;

/// Runs a command with the driver in `folder`, which reads these variables.
fn with_driver(folder: &Path, args: &[&str], variables: &[(&str, &str)]) -> Output {
    let mut command = treadmill(folder);
    command.args(args).env("LD_LIBRARY_PATH", folder).envs(variables.iter().copied());
    command.output().expect("the program starts")
}

/// Arguments of a short run that trains on a GPU.
fn train<'a>(run: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    let args = ["train", "--preset", "smoke", "--run-dir", run, "--no-progress", "--device", "cuda", "--actors", "1"];
    [&args, more].concat()
}

#[test]
fn a_run_on_a_gpu_learns_fails_with_it_and_goes_on_without() {
    let (folder, run_folder) = folders();
    let (folder, path) = (folder.path(), run_folder.to_str().unwrap());
    stand_in::build(folder);
    // Nine graphs run in an update: two minibatches and the divergence in each of three passes, and the driver fails in the
    // fourth update.
    let output = with_driver(folder, &train(path, &["--set", "ppo.epochs=3"]), &[("STAND_IN_LAUNCHES", "30")]);
    assert_refused(&output, 1, &["the GPU failed", "unspecified launch failure", "--resume", "--device cpu"]);
    assert_eq!(latest(&run_folder).counters.updates, 3);
    let loss = last_value(&run_folder, "train/value_loss").expect("a loss");
    assert!(loss.is_finite() && loss > 0.0, "{loss}");
    let steps = latest(&run_folder).counters.env_steps;
    let more = (steps + 1000).to_string();
    done(folder, &["train", "--resume", path, "--device", "cpu", "--no-progress", "--steps", &more]);
    assert!(latest(&run_folder).counters.env_steps >= steps + 1000);
    let more = (steps + 2000).to_string();
    let output = with_driver(folder, &["train", "--resume", path, "--device", "cuda", "--steps", &more], &[]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(latest(&run_folder).counters.env_steps >= steps + 2000);
}

#[test]
fn a_batch_that_does_not_fit_is_refused_with_one_that_does() {
    let (folder, run_folder) = folders();
    let (folder, path) = (folder.path(), run_folder.to_str().unwrap());
    stand_in::build(folder);
    let small = [("STAND_IN_BYTES", "10000000")];
    let output = with_driver(folder, &train(path, &[]), &small);
    assert_refused(&output, 1, &["10 MB of usable memory", "ppo.batch_max = 131072", "--set ppo.batch_max="]);
    let text = stderr(&output);
    let (_, rest) = text.split_once("--set ").unwrap();
    let (key, _) = rest.split_once(" fits").unwrap();
    let other = run_folder.with_extension("other");
    let output = with_driver(folder, &train(other.to_str().unwrap(), &["--set", key, "--steps", "1024"]), &small);
    assert!(output.status.success(), "{}", stderr(&output));
    let none = with_driver(folder, &train(path, &[]), &[("STAND_IN_BYTES", "1000")]);
    assert_refused(&none, 1, &["no batch fits", "--device cpu"]);
}

#[test]
fn the_check_names_gpu_and_driver_and_what_is_wrong_with_them() {
    let (folder, run_folder) = folders();
    let (folder, path) = (folder.path(), run_folder.to_str().unwrap());
    stand_in::build(folder);
    let gpu = |variables: &[(&str, &str)]| {
        let output = with_driver(folder, &["check", "--json"], variables);
        let report = last_json(&output);
        let findings = report["findings"].as_array().unwrap().clone();
        findings.into_iter().find(|finding| finding["name"] == "gpu").expect("a finding")
    };
    let found = gpu(&[]);
    let seen = found["seen"].as_str().unwrap();
    for part in ["Stand-in", "CUDA 12.4", "8000 of 8000 MB", "a gradient step on 512 rows takes", "on the processor"] {
        assert!(seen.contains(part), "{part}: {seen}");
    }
    assert_eq!(found["verdict"], "ok");
    let wrong = gpu(&[("STAND_IN_WRONG", "1")]);
    assert_eq!(wrong["verdict"], "problem");
    assert!(wrong["seen"].as_str().unwrap().contains("away from the processor's"), "{wrong}");
    let absent: [(&str, &str, &[&str]); 2] = [
        ("STAND_IN_GPUS", "0", &["no CUDA-capable device is detected", "nvidia-smi"]),
        ("STAND_IN_VERSION", "11080", &["CUDA 11.8", "12.0", "525"]),
    ];
    for (variable, value, parts) in absent {
        let found = gpu(&[(variable, value)]);
        assert_eq!(found["verdict"], "note");
        let output = with_driver(folder, &train(path, &[]), &[(variable, value)]);
        assert_refused(&output, 2, &[parts, &["--device cpu"]].concat());
        for part in parts {
            assert!(found["seen"].as_str().unwrap().contains(part), "{part}: {found}");
        }
    }
    assert!(!run_folder.exists(), "refused before anything is written");
}
