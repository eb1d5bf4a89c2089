//! A robot and a motion that it imitates.

use std::{fmt::Write, fs, path::Path};

use treadmill_rl::humanoid::Model;

use super::ROBOT_XML;

const CARD: &str =
    "model = 'robot.xml'\nfeet = ['left_foot', 'right_foot']\n[[hinges]]\nnames = '*'\neffort_nm = 60.0\n";

/// Writes the robot as `robot.xml`, and its card as `robot.toml`.
pub fn write_imitated_robot(folder: &Path) {
    fs::write(folder.join("robot.xml"), ROBOT_XML).unwrap();
    fs::write(folder.join("robot.toml"), CARD).unwrap();
}

/// Writes a motion of two seconds, at 50 lines per second: the robot bends its knees by `depth_rad` and stands up again.
pub fn write_motion(folder: &Path, name: &str, depth_rad: f64) {
    let model = Model::from_mjcf(ROBOT_XML).unwrap();
    let mut text = String::new();
    for step in 0..=100 {
        let bent = depth_rad * (0.5 - 0.5 * (f64::from(step) / 100.0 * std::f64::consts::TAU).cos());
        let angle = |name: &str| match name {
            _ if name.contains("knee") => bent,
            _ if name.contains("hip_pitch") => -bent / 2.0,
            _ => 0.0,
        };
        let height_m = model.nominal_position()[2] - 0.3 * (1.0 - (bent / 2.0).cos());
        write!(text, "0,0,{height_m},0,0,0,1").unwrap();
        model.hinges.iter().for_each(|hinge| write!(text, ",{}", angle(&hinge.name)).unwrap());
        text.push('\n');
    }
    fs::write(folder.join(name), text).unwrap();
}
