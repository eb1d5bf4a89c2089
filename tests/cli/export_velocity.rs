//! `export` of a policy of the velocity task: its ONNX model and deploy.yaml have what a robot's controller needs.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use crate::support::*;
use serde_json::{Value, json};

/// Waist and wrists are held; all else has the gains of the file, apart from the knees.
const CARD: &str = "
model = 'robot.xml'
feet = ['left_foot', 'right_foot']
height_m = 0.81
[[hinges]]
names = '*'
effort_nm = 60.0
[[hinges]]
names = '*_knee'
kp = 150.0
kd = 4.5
effort_nm = 120.0
armature_kgm2 = 0.025
default_rad = 0.25
[[hinges]]
names = 'waist_*'
held = true
[[hinges]]
names = '*_wrist_*'
held = true
";
/// Hinges of the policy, by their numbers in the file: legs, shoulders and elbows.
const IDS: [usize; 20] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 15, 16, 17, 18, 22, 23, 24, 25];
const KNEE: usize = 3;
const OF_POLICY: usize = 2 * (3 + 3 + 3 + 3 * IDS.len() + 2);

/// Keys of the policy.
const KEYS: [&str; 6] = [
    "velocity.history=2",
    "velocity.gait_period_s=0.7",
    "velocity.gait_rests=true",
    "velocity.lin_vel_x_mps=[-0.4,0.9]",
    "randomisation.push_mps=[0.1,0.5]",
    "policy.hidden=[32,16]",
];

/// Returns an entry of an ONNX file's metadata: a message with the key as field 1 and the value as field 2.
fn metadata(model: &[u8], key: &str) -> String {
    let start = [&[0x0a, key.len() as u8], key.as_bytes(), &[0x12]].concat();
    let at = model.windows(start.len()).position(|window| window == start);
    let mut rest = &model[at.unwrap_or_else(|| panic!("no entry `{key}`")) + start.len()..];
    let mut length = 0;
    for shift in (0..).step_by(7) {
        length |= usize::from(rest[0] & 0x7f) << shift;
        let is_last = rest[0] & 0x80 == 0;
        rest = &rest[1..];
        if is_last {
            break;
        }
    }
    String::from_utf8(rest[..length].to_vec()).unwrap()
}

/// Returns the list in the one line of a text that begins with `key`.
fn in_line<'a>(text: &'a str, key: &str) -> Vec<&'a str> {
    let mut lines = text.lines().filter_map(|line| line.trim_start().strip_prefix(key)?.strip_prefix(": ["));
    let list = lines.next().unwrap_or_else(|| panic!("no list `{key}` in {text}"));
    list.strip_suffix(']').unwrap().split(", ").collect()
}

#[test]
fn a_velocity_policy_leaves_with_all_that_a_controller_needs() {
    let (folder, run) = folders();
    trained_robot(folder.path(), &run, CARD, &KEYS);
    let export = |onnx: &str, deploy: &str| -> (Vec<u8>, String) {
        let (onnx, deploy) = (folder.path().join(onnx), folder.path().join(deploy));
        let files = ["--onnx", onnx.to_str().unwrap(), "--deploy", deploy.to_str().unwrap()];
        let output = done(folder.path(), &[&["export", run.to_str().unwrap(), "--json"], &files[..]].concat());
        let written = last_json(&output)["files"].as_array().unwrap().clone();
        assert_eq!(written[1]["bytes"], fs::metadata(&deploy).unwrap().len());
        (fs::read(&onnx).unwrap(), fs::read_to_string(&deploy).unwrap())
    };
    let (model, yaml) = export("policy.onnx", "deploy.yaml");
    assert!(export("other.onnx", "other.yaml") == (model.clone(), yaml.clone()), "equal policies give equal bytes");
    check_metadata(&model);
    check_deploy(&yaml);
    check_python(folder.path(), &run);
}

fn check_metadata(model: &[u8]) {
    let listed = |key: &str| -> Vec<String> { metadata(model, key).split(',').map(str::to_owned).collect() };
    assert_eq!(listed("joint_names").len(), IDS.len());
    assert_eq!(listed("joint_names")[KNEE..5], ["left_knee", "left_ankle_pitch"]);
    assert_eq!((&listed("joint_stiffness")[KNEE][..], &listed("joint_damping")[KNEE][..]), ("150", "4.5"));
    assert_eq!((&listed("default_joint_pos")[KNEE][..], &listed("action_scale")[KNEE][..]), ("0.25", "0.2"));
    // A quarter of 60 N·m ÷ 40 N·m/rad.
    assert_eq!(listed("action_scale")[15], "0.375");
    let terms = ["base_ang_vel", "projected_gravity", "command", "joint_pos", "joint_vel", "actions", "phase"];
    assert_eq!(listed("observation_names"), terms);
    assert_eq!(listed("observation_terms_scale"), ["1"; 7]);
    assert_eq!(listed("observation_terms_history_length"), ["whole frames"; 7]);
    assert_eq!((&metadata(model, "history")[..], &metadata(model, "control_step_s")[..]), ("2", "0.02"));
    assert_eq!(metadata(model, "treadmill.observation"), "velocity");

    let contract: Value = serde_json::from_str(&metadata(model, "treadmill.contract")).unwrap();
    for (key, expected) in [
        ("format", json!(1)),
        ("control_step_s", json!(0.02)),
        ("substeps", json!(5)),
        ("action_limit", json!(4.0)),
        ("base_body", json!("pelvis")),
        ("feet_bodies", json!(["left_foot", "right_foot"])),
        ("default_base_height_m", json!(0.81)),
        ("gait_period_s", json!(0.7)),
        ("gait_rests_below", json!(0.1)),
        ("push_mps", json!([0.1, 0.5])),
        ("push_interval_s", json!([2.0, 5.0])),
    ] {
        assert_eq!(contract[key], expected, "{key}");
    }
    assert_eq!(contract["history"]["frames"], 2);
    assert_eq!(contract["commands"]["lin_vel_x_mps"], json!([-0.4, 0.9]));
    assert_eq!(contract["fall"]["tilt_rad"], 1.0);
    assert!((contract["fall"]["height_m"].as_f64().unwrap() - 0.6 * 0.81).abs() < 1e-12);
    let of_knee = ["joint_effort", "joint_armature"].map(|key| numbers(&contract[key])[KNEE]);
    assert_eq!(of_knee, [120.0, 0.025]);
    let term = &contract["observation"][3];
    assert_eq!((&term["name"], &term["size"], &term["unit"]), (&json!("joint_pos_rel"), &json!(20), &json!("rad")));
    let held = &contract["held_joints"];
    assert_eq!(held["joint_names"].as_array().unwrap()[..2], ["waist_yaw", "waist_roll"]);
    assert_eq!((numbers(&held["joint_stiffness"])[0], numbers(&held["joint_damping"]).len()), (100.0, 9));
}

fn check_deploy(yaml: &str) {
    let ids: Vec<usize> = in_line(yaml, "joint_ids_map").iter().map(|id| id.parse().unwrap()).collect();
    assert_eq!(ids, IDS);
    // Gains are in the order of the file, with the waist; the rest is in that of the action.
    let (stiffness, offset) = (in_line(yaml, "stiffness"), in_line(yaml, "offset"));
    assert_eq!((stiffness.len(), stiffness[KNEE], stiffness[12], stiffness[15]), (29, "150.0", "100.0", "40.0"));
    assert_eq!((in_line(yaml, "damping")[12], offset.len(), offset[KNEE]), ("3.0", 20, "0.25"));
    assert_eq!(in_line(yaml, "default_joint_pos"), offset);
    assert_eq!(in_line(yaml, "scale")[15], "0.375");
    assert_eq!(in_line(yaml, "lin_vel_x"), ["-0.4", "0.9"]);
    assert!(
        yaml.contains("step_dt: 0.02\n")
            && yaml.contains("    params: {period: 0.7, command_threshold: 0.1, command_threshold_delay: 1.0}\n"),
        "{yaml}"
    );
    assert!(yaml.contains("[-0.55, 1.05]"), "targets of the knees: {yaml}");
    assert!(yaml.contains("    history_length: 2\n") && yaml.ends_with("  use_gym_history: true\n"), "{yaml}");
}

/// Plays the model in onnxruntime on a trace, and the robot in MuJoCo.
fn check_python(folder: &Path, run: &Path) {
    let trace = folder.join("trace.jsonl");
    let args = ["eval", run.to_str().unwrap(), "--episodes", "3", "--trace", trace.to_str().unwrap()];
    done(folder, &args);
    let lines = json_lines(&trace);
    // What the critic alone sees is no input.
    let seen = |line: &Value| json!({"observation": numbers(&line["observation"])[..OF_POLICY]}).to_string() + "\n";
    fs::write(&trace, lines.iter().map(seen).collect::<String>()).unwrap();

    let python = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("python");
    let Some(mut command) = python_with("mujoco, numpy, onnx, onnxruntime") else { return };
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python/run_onnx.py");
    let output = command.arg(script).args(["policy.onnx", "trace.jsonl"]).current_dir(folder).output().unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let text = stdout(&output);
    assert_eq!(text.lines().count(), lines.len());
    for (found, line) in text.lines().zip(&lines) {
        let found = numbers(&serde_json::from_str(found).unwrap());
        for (found, share) in found.iter().zip(numbers(&line["action"])) {
            assert!((found - 4.0 * share.clamp(-1.0, 1.0)).abs() < 1e-4, "{found} is not four times {share}");
        }
    }

    let mut play: Command = python_with("mujoco, numpy, onnx, onnxruntime").unwrap();
    play.env("PYTHONPATH", python).current_dir(folder).args(["-m", "treadmill_transfer", "policy.onnx"]);
    let output = play.args(["--model", "robot.xml", "--episodes", "2", "--seconds", "1", "--json"]).output().unwrap();
    let result = last_json(&output);
    assert_eq!(result["episodes"], 2);
    assert!(result["length_mean"].as_f64().unwrap() > 5.0, "{result}");
}

#[test]
fn policies_of_other_tasks_have_no_deploy_yaml() {
    let (folder, run) = folders();
    trained(folder.path(), &run);
    let output = self::run(folder.path(), &["export", run.to_str().unwrap(), "--deploy", "deploy.yaml"]);
    assert_refused(&output, 2, &["--deploy", "velocity task", "treadmill/humanoid-v5"]);
    assert!(!folder.path().join("deploy.yaml").exists());
}
