//! Search by Optuna.

use std::{fs, path::Path};

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

#[test]
fn a_search_by_optuna_ends_with_a_table_and_a_picture() {
    let Some(mut python) = python_with("optuna") else { return };
    let (folder, _) = folders();
    let goal = "highest rollout/ep_rew_mean";
    let text = format!("trials = 2\ngoal = \"{goal}\"\n[keys]\nppo.gamma = {{ uniform = [0.9, 0.99] }}\n");
    fs::write(folder.path().join("search.toml"), text).unwrap();
    let args = "-m treadmill_sweep search.toml --preset smoke --steps 2048 --run-dir S --json --treadmill";
    python.args(args.split(' ')).arg(env!("CARGO_BIN_EXE_treadmill")).current_dir(folder.path());
    let output = python.env("PYTHONPATH", Path::new(env!("CARGO_MANIFEST_DIR")).join("python")).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let result = last_json(&output);
    assert_eq!((&result["complete"], &result["goal"]), (&2.into(), &goal.into()), "{result}");
    let picture = fs::read(folder.path().join("S/sweep.png")).unwrap();
    assert!(picture.starts_with(b"\x89PNG") && picture.len() > 1000);
}
