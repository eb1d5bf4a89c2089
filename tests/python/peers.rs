//! Readers of other projects read what is exported.

use std::{fs, path::Path, process::Command};

use crate::support::*;

const CARD: &str =
    "model = 'robot.xml'\nfeet = ['left_foot', 'right_foot']\n[[hinges]]\nnames = '*'\neffort_nm = 60.0\n";

/// Prints what gaitkeeper understood of an ONNX file and of `deploy.yaml`.
const READ: &str = r#"
import json, sys
from gaitkeeper.readers.mjlab_export import read_mjlab_export
onnx, yaml = sys.argv[1:]
contract, findings = read_mjlab_export(onnx, yaml)
print(json.dumps({
    "terms": [[term["id"], term["dim"]] for term in contract.get("policy_io.observation_groups.policy.terms")],
    "conflicts": [finding.message for finding in findings if finding.kind == "conflicting"],
    "kp": contract.get("control.actuators.kp"),
    "scale": contract.get("control.actions.joint_pos.scale"),
    "dt": contract.get("timing.policy_dt"),
    "limit": contract.get("policy_io.commands.base_velocity")["limit"],
}))
"#;

#[test]
#[allow(clippy::print_stderr, reason = "reports a skipped test")]
fn gaitkeeper_reads_the_onnx_file_and_deploy_yaml() {
    let Some(mut python) = python_with("onnxruntime") else { return };
    let peers = Path::new(env!("CARGO_TARGET_TMPDIR")).join("gaitkeeper");
    let mut pip = Command::new(python.get_program());
    pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--upgrade", "--no-deps", "--target"]);
    if !pip.arg(&peers).args(["gaitkeeper==0.5.4", "PyYAML==6.0.3"]).status().is_ok_and(|status| status.success()) {
        eprintln!("SKIPPED: gaitkeeper cannot be installed; is there a network?");
        return;
    }
    let (folder, run) = folders();
    trained_robot(folder.path(), &run, CARD, &["velocity.lin_vel_x_mps=[-0.25, 0.75]"]);
    let path = run.to_str().expect("a path of text");
    done(folder.path(), &["export", path, "--onnx", "policy.onnx", "--deploy", "deploy.yaml"]);
    fs::write(folder.path().join("read.py"), READ).expect("a script");
    let read =
        python.current_dir(folder.path()).args(["read.py", "policy.onnx", "deploy.yaml"]).env("PYTHONPATH", &peers);
    let read = read.output().expect("Python starts");
    assert!(read.status.success(), "{}", stderr(&read));
    let found = last_json(&read);
    let terms = [
        ("base_ang_vel", 3),
        ("projected_gravity", 3),
        ("velocity_commands", 3),
        ("joint_pos_rel", 29),
        ("joint_vel_rel", 29),
        ("last_action", 29),
        ("gait_phase", 2),
    ];
    assert_eq!(found["terms"], serde_json::json!(terms));
    assert_eq!(found["conflicts"], serde_json::json!([]));
    // The servos of the model file: knees of 150 N·m/rad, and a quarter of 60 N·m ÷ 150.
    assert_eq!((&found["kp"]["left_knee"], &found["scale"]["left_knee"]), (&150.0.into(), &0.1.into()), "{found}");
    assert_eq!((&found["dt"], &found["limit"]["vx"]), (&0.02.into(), &serde_json::json!([-0.25, 0.75])));
}
