//! `bench`: every documented field is present and measured. No test asserts a speed.

use crate::support::*;
use serde_json::Value;

fn bench(args: &[&str]) -> Value {
    let (folder, _) = folders();
    let mut all = vec!["bench"];
    all.extend(args);
    all.push("--json");
    let output = done(folder.path(), &all);
    last_json(&output)
}

#[test]
fn env_measures_steps_with_and_without_observation() {
    let first = bench(&["env", "--steps", "1280"]);
    assert!(first["env_steps_per_s"].as_f64().unwrap() > 0.0);
    assert!(first["physics_only_steps_per_s"].as_f64().unwrap() > 0.0);
    assert_eq!((&first["observation"], &first["threads"]), (&45.into(), &1.into()));
    assert_eq!(first["observation_kind"], "compact");
    assert_eq!(first["control_step_s"], 0.015);
    assert!(!first["cpu"].as_str().unwrap().is_empty());
    assert_eq!(first["checksum"], bench(&["env", "--steps", "1280"])["checksum"], "the same work each time");
    let spread = bench(&["env", "--steps", "1280", "--threads", "2"]);
    assert_eq!((&spread["threads"], &spread["checksum"]), (&2.into(), &first["checksum"]));
    assert_eq!(spread["workload"], first["workload"], "as many resets");
    let finer = bench(&["env", "--steps", "1280", "--set", "env.substeps=5"]);
    assert_ne!(finer["checksum"], first["checksum"], "configuration keys take effect");
    let slower = bench(&["env", "--steps", "1280", "--set", "env.control_step_s=0.02"]);
    assert_eq!(slower["control_step_s"], 0.02);
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
    let larger = bench(&["update", "--updates", "1", "--minibatch", "64", "--network", "348-512-256"]);
    assert_eq!(larger["network"], "348-512-256 actor and critic");
}

#[test]
fn policy_measures_calls_and_does_the_same_work_each_time() {
    let one = bench(&["policy", "--calls", "20"]);
    assert!(one["call_us"].as_f64().unwrap() > 0.0 && one["rows_per_s"].as_f64().unwrap() > 0.0);
    assert_eq!((&one["rows"], &one["threads"]), (&64.into(), &1.into()));
    assert_eq!(one["network"], "45-256-128 actor");
    assert!(!one["cpu"].as_str().unwrap().is_empty());
    assert_eq!(one["checksum"], bench(&["policy", "--calls", "10"])["checksum"]);
    let larger = bench(&["policy", "--calls", "10", "--rows", "3", "--network", "348-512-256"]);
    assert_eq!((&larger["rows"], &larger["network"]), (&3.into(), &"348-512-256 actor".into()));
    assert_ne!(one["checksum"], larger["checksum"]);
}

#[test]
fn unknown_keys_and_sizes_out_of_range_are_refused() {
    let (folder, _) = folders();
    for (args, parts) in [
        (["env", "--set", "env.substep=4"], ["env.substep", "env.substeps"]),
        (["update", "--minibatch", "0"], ["--minibatch", "0"]),
        // It would fill the memory.
        (["update", "--minibatch", "4000000000"], ["--minibatch", "4000000000"]),
        (["update", "--network", "45-0"], ["45-0", "45-256-128"]),
        (["policy", "--network", "45-0"], ["45-0", "45-256-128"]),
    ] {
        assert_refused(&self::run(folder.path(), &[&["bench"], &args[..]].concat()), 2, &parts);
    }
}

#[test]
fn train_measures_the_whole_system() {
    let result = bench(&["train", "--steps", "8192", "--actors", "1"]);
    assert!(result["env_steps_per_s"].as_f64().unwrap() > 0.0);
    assert_eq!(result["actors"], 1);
    assert!(!result["cpu"].as_str().unwrap().is_empty());
}
