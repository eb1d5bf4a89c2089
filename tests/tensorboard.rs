//! The event files, read back by TensorBoard's own reader.

mod support;

use serde_json::Value;
use support::*;

#[test]
fn tensorboard_reads_the_same_scalars_as_metrics_jsonl() {
    let Some(mut python) = python_with("tensorboard") else { return };
    let (folder, run) = folders();
    let run_name = run.to_str().unwrap();
    let train = ["train", "--preset", "smoke", "--steps", "2048", "--run-dir", run_name];
    assert!(self::run(folder.path(), &train).status.success());
    assert!(self::run(folder.path(), &["train", "--resume", run_name, "--steps", "4096"]).status.success());

    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/python/read_events.py");
    let output = python.arg(script).arg(&run).output().expect("Python starts");
    assert!(output.status.success(), "{}", stderr(&output));
    let read: Value = serde_json::from_slice(&output.stdout).unwrap();
    let mut compared = 0;
    for (tag, step, value) in metrics(&run) {
        let points = read[&tag].as_array().unwrap_or_else(|| panic!("TensorBoard has no {tag}"));
        let found = points.iter().find(|point| point[0] == step).unwrap_or_else(|| panic!("no {tag} at {step}"));
        // TensorBoard's numbers have 32 bits.
        let error = (found[1].as_f64().unwrap() - value).abs();
        assert!(error <= 1e-6 * value.abs(), "{tag} at {step}: {} instead of {value}", found[1]);
        compared += 1;
    }
    assert!(compared > 8 * 30, "eight updates of some thirty tags each, {compared} compared");
    assert!(read["config"][0][1].as_str().unwrap().contains("[ppo]"));
}
