//! Motions: their files, and runs that imitate them.

use std::{fs, path::Path};

use rten_tensor::{NdTensor, prelude::*};

use crate::support::*;

/// Steps and networks of a training that only has to work.
const SMALL: [&str; 10] =
    ["train", "--preset", "smoke", "--task", "motion", "--model", "robot.toml", "--actors", "1", "--steps=512"];
const TIME: [&str; 4] = ["--set", "env.control_step_s=0.02", "--set", "env.substeps=5"];

/// Writes the robot, and a motion.
fn prepare(folder: &Path) {
    motion::write_imitated_robot(folder);
    motion::write_motion(folder, "squat.csv", 0.6);
}

#[test]
fn a_file_is_described_filmed_and_written_in_another_form() {
    let (folder, _) = folders();
    let folder = folder.path();
    prepare(folder);
    let motion = ["motion", "squat.csv", "--model", "robot.toml"];
    assert_refused(&run(folder, &motion), 2, &["squat.csv", "its rate is not in the file", "--fps 30"]);
    let files = ["--fps", "50", "--save", "squat.npz", "--film", "squat.gif"];
    let text = stdout(&done(folder, &[&motion[..], &files].concat()));
    for part in
        ["CSV with quaternions x, y, z, w", "101 at 50 per second: 2.00 s", "29: ", "wrote squat.npz", "squat.gif"]
    {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(fs::metadata(folder.join("squat.gif")).unwrap().len() > 10_000);
    let described = |file: &str, more: &[&str]| {
        last_json(&done(folder, &[&["motion", file, "--model", "robot.toml", "--json"], more].concat()))
    };
    let (csv, npz) = (described("squat.csv", &["--fps", "50"]), described("squat.npz", &[]));
    assert_eq!((&csv["frames"], &npz["frames"]), (&101.into(), &101.into()));
    assert_eq!(npz["format"], "npz of mjlab");
    assert!(npz["order"].as_str().unwrap().starts_with("depth first, as in MuJoCo; bodies agree"), "{npz}");
    let lowest = |of: &serde_json::Value| numbers(&of["lowest_m"]);
    assert!(lowest(&csv).iter().zip(lowest(&npz)).all(|(one, other)| (one - other).abs() < 1e-4), "{csv} {npz}");
    assert_refused(
        &run(folder, &["motion", "squat.npz", "--model", "robot.toml", "--film", "no/f.gif"]),
        2,
        &["--film no/f.gif"],
    );
}

#[test]
fn a_robot_imitates_a_motion_and_keeps_it() {
    let (folder, run) = folders();
    let folder = folder.path();
    prepare(folder);
    motion::write_motion(folder, "deep.csv", 0.9);
    let to = ["--run-dir", run.to_str().unwrap()];
    let given = ["--motion", "squat.csv", "--fps", "50"];
    let small = [&SMALL[..], &TIME, &to].concat();
    assert_refused(&self::run(folder, &small), 2, &["the motion task needs a motion", "--motion FILE"]);
    let walk = ["train", "--preset", "smoke", "--motion", "squat.csv", "--fps", "50"];
    assert_refused(&self::run(folder, &walk), 2, &["--motion has no effect on the task", "--task motion"]);
    let text = stdout(&done(folder, &[&small[..], &given].concat()));
    assert!(text.contains("imitates `squat`, 2.0 s"), "{text}");

    let resume = ["train", "--resume", run.to_str().unwrap(), "--steps", "1024"];
    let other = self::run(folder, &[&resume[..], &["--motion", "deep.csv", "--fps", "50"]].concat());
    assert_refused(&other, 2, &["a resumed run keeps its motions"]);
    done(folder, &[&resume[..], &given].concat());

    let played = last_json(&done(folder, &["eval", "run", "--episodes", "3", "--json"]));
    let share = played["done_share"].as_f64().unwrap();
    assert!(share > 0.0 && share <= 1.0 && played["finished"].as_u64().unwrap() <= 3, "{played}");
    for key in ["anchor_error_m", "body_error_m", "body_error_rad", "hinge_error_rad"] {
        assert!((0.0..1.0).contains(&played[key].as_f64().unwrap()), "{key}: {played}");
    }
    let text = stdout(&done(folder, &["eval", "run", "--episodes", "1", "--film", "f.gif", "--seconds", "0.2"]));
    assert!(text.contains("bodies cm") && text.contains("of the motion in the mean"), "{text}");
    // On another motion.
    let deep = ["eval", "run", "--episodes", "1", "--motion", "deep.csv", "--motion-fps", "50", "--json"];
    assert_ne!(last_json(&done(folder, &deep))["body_error_m"], played["body_error_m"]);

    done(folder, &["export", "run", "--onnx", "squat.onnx"]);
    assert_refused(
        &self::run(folder, &["export", "run", "--deploy", "d.yaml"]),
        2,
        &["--deploy", "trained for `treadmill/motion`"],
    );
    check_tables(folder);
}

/// Checks that the tables of the exported model are those of the motion, one control step ahead.
fn check_tables(folder: &Path) {
    let model = rten::Model::load_file(folder.join("squat.onnx")).unwrap();
    let rows: Vec<Vec<f32>> = fs::read_to_string(folder.join("squat.csv"))
        .unwrap()
        .lines()
        .map(|line| line.split(',').map(|number| number.parse().unwrap()).collect())
        .collect();
    let [observation, time_step, actions, angles] =
        ["obs", "time_step", "actions", "joint_pos"].map(|name| model.node_id(name).unwrap());
    let play = |row: f32, command: &[f32]| {
        // The motion's angles and rates, the anchor's errors, velocities, 29 × (angle, rate, action).
        let mut seen = vec![0.0; 58 + 3 + 6 + 3 + 3 + 3 * 29];
        seen[..29].copy_from_slice(command);
        let seen = NdTensor::from_data([1, seen.len()], seen);
        let inputs = vec![(observation, seen.into()), (time_step, NdTensor::from_data([1, 1], vec![row]).into())];
        let found = model.run(inputs, &[actions, angles], None).unwrap();
        let [action, angles] = <[rten::Value; 2]>::try_from(found).ok().unwrap();
        [action, angles].map(|value| NdTensor::<f32, 2>::try_from(value).unwrap().to_vec())
    };
    for row in [0, 30, 99, 500] {
        let expected = &rows[(row + 1).min(100)][7..];
        let [_, found] = play(row as f32, &[0.0; 29]);
        assert!(
            found.iter().zip(expected).all(|(one, other)| (one - other).abs() < 1e-5),
            "{row}: {found:?} {expected:?}"
        );
    }
    assert!(play(0.0, &[f32::NAN; 29])[0].iter().all(|action| action.is_nan()));
}
