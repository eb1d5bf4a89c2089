//! Generated model files, as Treadmill and MuJoCo understand them.

use crate::support::*;

/// Files with a feature each, and random robots; `experiments/fidelity/mjcf_diff.py` compares as many as one likes.
#[test]
fn models_are_to_mujoco_what_they_are_here() {
    let Some(mut python) = python_with("mujoco, numpy") else { return };
    python.current_dir(env!("CARGO_MANIFEST_DIR")).args(["-W", "ignore", "-m", "experiments.fidelity.mjcf_diff"]);
    python.arg(env!("CARGO_BIN_EXE_treadmill"));
    let output = python.args(["--features", "--random", "40"]).output().unwrap();
    let printed = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{printed}{}", stderr(&output));
    let equal = printed.lines().filter(|line| line.starts_with("ok") && line.contains(": equal")).count();
    // All but the features that MuJoCo or both refuse, and a few random robots.
    assert!(equal > 110, "{equal} files move as in MuJoCo: {printed}");
}
