//! Servos that do not hold a robot that stands.

use nalgebra::Vector3;

use crate::model::{HingeControl, Model};
use crate::physics::Physics;

/// Cosine of the tilt, 6°, from which a robot is falling over: then its ankles give way, however stiff they are.
const FALLING_COSINE: f64 = 0.995;
/// Angle by which a hinge may give way while the robot stands, and by which one that is stiff enough does (rad).
const SAG_MAX_RAD: f64 = 0.25;
const SAG_WANTED_RAD: f64 = 0.1;
/// Share of a servo's torque that counts as all of it.
const FULL_TORQUE: f64 = 0.99;

/// How far the hinges of a robot with a card give way while it stands.
pub(super) struct Sag {
    /// Greatest difference of each hinge from the default pose (rad).
    most_rad: Vec<f64>,
    /// Control steps, of those in which the robot stands, in which each servo gives all of its torque.
    saturated: Vec<u32>,
    steps: u32,
}

impl Sag {
    pub fn new(model: &Model) -> Self {
        let hinges = model.hinges.len();
        Self { most_rad: vec![0.0; hinges], saturated: vec![0; hinges], steps: 0 }
    }

    /// Counts a control step, unless the robot is falling over: then its hinges say little about its servos.
    pub fn observe(&mut self, model: &Model, physics: &Physics) {
        let Some(robot) = &model.robot else { return };
        let up = physics.body_motion(0).pose.rotation * Vector3::z();
        if up.z < FALLING_COSINE {
            return;
        }
        self.steps += 1;
        for (hinge, most_rad) in self.most_rad.iter_mut().enumerate() {
            let off_rad = (physics.joint_angles()[hinge] - robot.default_position[7 + hinge]).abs();
            *most_rad = most_rad.max(off_rad);
        }
        for motor in &model.motors {
            let is_full =
                physics.joint_torques_nm()[motor.hinge].abs() > FULL_TORQUE * robot.hinges[motor.hinge].effort_nm;
            self.saturated[motor.hinge] += u32::from(is_full);
        }
    }

    /// Returns what is wrong with the servos, with gains that would hold the robot.
    pub fn warnings(&self, model: &Model) -> Vec<String> {
        let Some(robot) = &model.robot else { return Vec::new() };
        let of_hinge = |(hinge, control): (usize, &HingeControl)| {
            let (name, most_rad) = (&model.hinges[hinge].name, self.most_rad[hinge]);
            let needed_nm = control.kp * most_rad;
            if self.steps > 0 && 2 * self.saturated[hinge] > self.steps {
                let effort = format!("its effort of {:.3} N·m", control.effort_nm);
                return Some(format!(
                    "the servo of `{name}` gives all of {effort} in the default pose; raise `effort_nm`"
                ));
            }
            (most_rad > SAG_MAX_RAD && control.kp > 0.0).then(|| {
                format!(
                    "hinge `{name}` sags by {most_rad:.2} rad in the default pose, where its servo has {:.3} N·m/rad; a `kp` of \
                     about {:.3} would hold it",
                    control.kp,
                    needed_nm / SAG_WANTED_RAD
                )
            })
        };
        robot.hinges.iter().enumerate().filter_map(of_hinge).collect()
    }
}
