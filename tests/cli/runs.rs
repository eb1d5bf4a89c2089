//! `runs`: comparison of runs.

use std::fs;

use crate::support::*;
use serde_json::Value;

#[test]
fn runs_are_compared_by_results_and_configuration() {
    let (folder, _) = folders();
    let train = |name: &str, more: &[&str]| {
        let dir = format!("runs/{name}");
        let args = ["train", "--preset", "smoke", "--steps", "1024", "--actors", "1", "--run-dir", &dir];
        done(folder.path(), &[&args[..], more].concat());
    };
    train("plain", &[]);
    train("other", &["--seed", "7", "--set", "ppo.learning_rate=0.001"]);
    let table = run(folder.path(), &["runs", "--keys"]);
    let text = stdout(&table);
    assert!(table.status.success(), "{}", stderr(&table));
    for part in [
        "env steps",
        "plain",
        "other",
        "1,024",
        "ppo.learning_rate = 0.001",
        "run.seed = 7",
        "run.seed = 1",
        "finished",
    ] {
        assert!(text.contains(part), "`{part}` is missing in: {text}");
    }
    assert!(!text.contains("ppo.gamma"), "common keys are omitted: {text}");
    assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
    assert!(!stdout(&run(folder.path(), &["runs"])).contains("run.seed = 7"));

    let output = run(folder.path(), &["runs", "--json", "runs/other", "runs/plain"]);
    let lines: Vec<Value> = stdout(&output).lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines.len(), 2);
    let distance = |record: &Value| {
        record["best_eval_distance_m"].as_f64().or(record["training_distance_m"].as_f64()).unwrap_or(f64::NEG_INFINITY)
    };
    assert!(distance(&lines[0]) >= distance(&lines[1]), "sorted by distance, farthest first: {lines:?}");
    let other = lines.iter().find(|record| record["run"] == "other").unwrap();
    assert_eq!((&other["env_steps"], &other["config_differences"]["run.seed"]), (&1024.into(), &"7".into()));
    assert!(other["wall_s"].as_f64().unwrap() > 0.0);

    fs::write(folder.path().join("runs/plain/config.toml"), "[").unwrap();
    let output = run(folder.path(), &["runs"]);
    assert!(output.status.success() && stdout(&output).contains("other"), "{}", stderr(&output));
    assert!(stderr(&output).contains("left out: `runs/plain/config.toml`"), "{}", stderr(&output));
}

#[test]
fn missing_runs_and_invalid_configurations_are_reported() {
    let (folder, _) = folders();
    assert_refused(&run(folder.path(), &["runs"]), 1, &["`runs`"]);
    fs::create_dir(folder.path().join("runs")).unwrap();
    assert_usage(folder.path(), &["runs"], &["no run in `runs`"]);
    fs::create_dir(folder.path().join("runs/bad")).unwrap();
    fs::write(folder.path().join("runs/bad/config.toml"), "[").unwrap();
    assert_refused(&run(folder.path(), &["runs"]), 1, &["runs/bad/config.toml", "not a configuration"]);
}
