//! `bench`: every promised field is there and is a measurement. Speed itself is never asserted.

mod support;

use serde_json::Value;
use support::*;

fn bench(args: &[&str]) -> Value {
    let (folder, _) = folders();
    let mut all = vec!["bench"];
    all.extend(args);
    all.push("--json");
    let output = self::run(folder.path(), &all);
    assert!(output.status.success(), "{}", stderr(&output));
    last_json(&output)
}

#[test]
fn env_measures_steps_with_and_without_observation() {
    let first = bench(&["env", "--steps", "1280"]);
    assert!(first["env_steps_per_s"].as_f64().unwrap() > 0.0);
    assert!(first["physics_only_steps_per_s"].as_f64().unwrap() > 0.0);
    assert_eq!((&first["observation"], &first["threads"]), (&45.into(), &1.into()));
    assert_eq!(first["control_step_s"], 0.015);
    assert!(!first["cpu"].as_str().unwrap().is_empty());
    assert_eq!(first["checksum"], bench(&["env", "--steps", "1280"])["checksum"], "the same work each time");
}

#[test]
fn update_measures_samples_and_does_the_same_work_on_any_number_of_threads() {
    let one = bench(&["update", "--updates", "1", "--minibatch", "256"]);
    assert!(one["samples_per_s"].as_f64().unwrap() > 0.0);
    assert_eq!(one["minibatch"], 256);
    assert!(one["network"].as_str().unwrap().contains("45-256-128"));
    assert!(!one["cpu"].as_str().unwrap().is_empty());
    let two = bench(&["update", "--updates", "1", "--minibatch", "256", "--threads", "2"]);
    assert_eq!((&one["threads"], &two["threads"]), (&1.into(), &2.into()));
    assert_eq!(one["checksum"], two["checksum"]);
}

#[test]
fn train_measures_the_whole_system() {
    let result = bench(&["train", "--steps", "8192", "--actors", "1"]);
    assert!(result["env_steps_per_s"].as_f64().unwrap() > 0.0);
    assert_eq!(result["actors"], 1);
    assert!(!result["cpu"].as_str().unwrap().is_empty());
}
