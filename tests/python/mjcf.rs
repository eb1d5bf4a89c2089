//! Generated model files, as Treadmill and MuJoCo understand them.

use crate::support::*;

/// Files with a feature each, and random robots; `experiments/fidelity/mjcf_diff.py` compares as many as one likes.
#[test]
fn a_sample_of_models_is_to_mujoco_what_it_is_here() {
    let Some(mut python) = python_with("mujoco, numpy") else { return };
    python.current_dir(env!("CARGO_MANIFEST_DIR")).args(["-W", "ignore", "-m", "experiments.fidelity.mjcf_diff"]);
    python.arg(env!("CARGO_BIN_EXE_treadmill"));
    let output = python.args(["--features", "--random", "100", "--sample", "40"]).output().unwrap();
    let printed = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{printed}{}", stderr(&output));
    assert!(printed.contains("40 of 40 cases are as wanted"), "{printed}");
}
