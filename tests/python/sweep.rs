//! Search by Optuna.

use std::path::Path;

use crate::support::*;

#[test]
fn the_search_by_optuna_passes_its_tests() {
    let Some(mut python) = python_with("optuna") else { return };
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("python");
    python.args(["-m", "unittest", "test_sweep"]).current_dir(root.join("tests")).env("PYTHONPATH", &root);
    let output = python.env("TREADMILL", env!("CARGO_BIN_EXE_treadmill")).output().unwrap();
    let errors = stderr(&output);
    assert!(output.status.success() && errors.contains("\nOK\n"), "{errors}");
}
