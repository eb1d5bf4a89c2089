//! What a robot card says of a model.

use super::BaseAxis;

/// What a card says of a model, resolved.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// Axis of the base's frame in the file that points forward, where x is now, see [`super::Model::turn_base`].
    pub forward: BaseAxis,
    /// Links that carry the robot, as indices of [`super::Model::links`].
    pub feet: Vec<usize>,
    /// Pairs of links that do not touch each other, as indices of [`super::Model::links`].
    pub excluded: Vec<[usize; 2]>,
    /// Names of a left and a right hinge, see [`crate::card::RobotCard::symmetry`].
    pub symmetry: Vec<[String; 2]>,
    /// Hinges in the order of the robot's motors, see [`crate::card::RobotCard::motors`].
    pub motors: Vec<String>,
    /// Position vector of the default pose.
    pub default_position: Vec<f64>,
    /// One per hinge, in the order of [`super::Model::hinges`].
    pub hinges: Vec<HingeControl>,
}

/// Servo of one hinge.
#[derive(Clone, Debug, PartialEq)]
pub struct HingeControl {
    /// Stiffness (N·m/rad).
    pub kp: f64,
    /// Damping (N·m·s/rad).
    pub kd: f64,
    /// Greatest torque (N·m).
    pub effort_nm: f64,
    /// Offset of the target per unit of an action (rad).
    pub action_scale_rad: f64,
    /// Whether the hinge keeps its default angle.
    pub is_held: bool,
}

impl Robot {
    /// Returns the number of a hinge's motor in the robot's own software; `None` if the card does not say.
    #[must_use]
    pub fn motor_number(&self, hinge: &str) -> Option<usize> {
        self.motors.iter().position(|name| name == hinge)
    }
}

/// Returns the name on the other side for a name that matches one of a pair of patterns, each with at most one `*`.
pub(crate) fn counterpart(name: &str, [left, right]: &[String; 2]) -> Option<String> {
    let swap = |from: &str, to: &str| match (from.split_once('*'), to.split_once('*')) {
        (Some((before, after)), Some((start, end))) => {
            let shared = name.strip_prefix(before)?.strip_suffix(after)?;
            Some(format!("{start}{shared}{end}"))
        }
        _ => (from == name).then(|| to.to_owned()),
    };
    swap(left, right).or_else(|| swap(right, left))
}
