//! The player of exported policies in MuJoCo, which needs neither Zenoh nor Gymnasium.

use std::path::PathBuf;

use crate::support::*;

#[test]
fn the_player_of_exported_policies_passes_its_own_tests() {
    let Some(mut python) = python_with("mujoco, numpy, onnx, onnxruntime") else { return };
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("python");
    python.env("PYTHONPATH", &folder).current_dir(folder.join("tests"));
    let output = python.args(["-m", "unittest", "test_transfer"]).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(stderr(&output).contains("OK") && !stderr(&output).contains("Ran 0 tests"), "{}", stderr(&output));
}
