//! Terms of the reward, and when an episode ends, as in mjlab's tracking task (mjlab 1.6.0, `tasks/tracking/mdp`), which
//! follows BeyondMimic (Liao et al. 2025, arXiv:2508.08241).

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use super::reference::Reference;
use crate::config::{MotionConfig, MotionRewards};
use crate::physics::{LinkMotion, Physics};
use crate::task::beyond_soft_limits_rad;

/// Force with which the robot touches itself, from which that counts (N).
const SELF_CONTACT_N: f64 = 10.0;

/// Differences between a robot and its motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MotionErrors {
    /// Distance between the anchors (m).
    pub anchor_m: f64,
    /// Angle between them (rad).
    pub anchor_rad: f64,
    /// Mean distance of the compared links from those of the motion (m), moved so that the anchors lie above each other.
    pub body_m: f64,
    /// Mean angle between them (rad).
    pub body_rad: f64,
    /// Root mean square of the differences of the hinges (rad).
    pub hinge_rad: f64,
}

/// A control step of the robot and of the motion.
pub(super) struct MotionStep<'a> {
    pub config: &'a MotionConfig,
    pub physics: &'a Physics,
    pub reference: &'a Reference,
    /// Control step of the motion.
    pub step: usize,
    /// Actions of the step and of the one before, in units of the action.
    pub actions: [&'a [f64]; 2],
}

impl MotionStep<'_> {
    /// Returns the anchors of the robot and of the motion.
    fn anchors(&self) -> [LinkMotion; 2] {
        [self.physics.link_motion(self.reference.compared.anchor), self.reference.anchor(self.step)]
    }

    /// Returns what moves the motion so that its anchor lies above or below that of the robot, with the same heading.
    fn to_robot(&self) -> Isometry3<f64> {
        let [robot, motion] = self.anchors().map(|anchor| anchor.pose);
        let turn = about_vertical(&(robot.rotation * motion.rotation.inverse()));
        let (to, from) = (robot.translation.vector, motion.translation.vector);
        Translation3::new(to.x, to.y, from.z) * turn * Translation3::from(-from)
    }

    /// Returns each compared link of the robot, and that of the moved motion.
    fn pairs(&self) -> impl Iterator<Item = [Isometry3<f64>; 2]> {
        let to_robot = self.to_robot();
        let robot = self.reference.compared.links.iter().map(|link| self.physics.link_pose(*link));
        robot.zip(self.reference.links(self.step)).map(move |(robot, motion)| [robot, to_robot * motion.pose])
    }

    /// Returns the mean over the compared links of a squared difference of velocities.
    fn mean_of(&self, difference: impl Fn(&LinkMotion, &LinkMotion) -> Vector3<f64>) -> f64 {
        let links = &self.reference.compared.links;
        let pairs = links.iter().map(|link| self.physics.link_motion(*link)).zip(self.reference.links(self.step));
        pairs.map(|(robot, motion)| difference(&robot, &motion).norm_squared()).sum::<f64>() / links.len() as f64
    }

    fn mean_of_pairs(&self, error: impl Fn(&[Isometry3<f64>; 2]) -> f64) -> f64 {
        self.pairs().map(|pair| error(&pair)).sum::<f64>() / self.reference.compared.links.len() as f64
    }

    /// Returns whether the robot has left the motion: anchor height, anchor tilt, height of a limb's end.
    pub fn has_failed(&self) -> bool {
        let [robot, motion] = self.anchors().map(|anchor| anchor.pose);
        let below = |pose: &Isometry3<f64>| pose.rotation.inverse_transform_vector(&-Vector3::z()).z;
        let height_m = (robot.translation.z - motion.translation.z).abs();
        let pairs: Vec<_> = self.pairs().collect();
        let end_m = |end: &usize| (pairs[*end][0].translation.z - pairs[*end][1].translation.z).abs();
        height_m > self.config.anchor_height_max_m
            || (below(&robot) - below(&motion)).abs() > self.config.anchor_tilt_max
            || self.reference.compared.ends.iter().any(|end| end_m(end) > self.config.end_effector_height_max_m)
    }

    /// Returns the differences.
    pub fn errors(&self) -> MotionErrors {
        let [robot, motion] = self.anchors().map(|anchor| anchor.pose);
        let wanted = &self.reference.positions[self.step][7..];
        let angles = self.physics.joint_angles().iter().zip(wanted);
        let squares: f64 = angles.map(|(angle, wanted)| (angle - wanted).powi(2)).sum();
        MotionErrors {
            anchor_m: distance_m(&[robot, motion]),
            anchor_rad: angle_rad(&[robot, motion]),
            body_m: self.mean_of_pairs(distance_m),
            body_rad: self.mean_of_pairs(angle_rad),
            hinge_rad: (squares / wanted.len().max(1) as f64).sqrt(),
        }
    }
}

impl MotionRewards for MotionStep<'_> {
    fn global_root_pos(&self) -> f64 {
        let error = distance_m(&self.anchors().map(|anchor| anchor.pose)).powi(2);
        falling(error, self.config.global_root_pos_std_m)
    }

    fn global_root_ori(&self) -> f64 {
        let error = angle_rad(&self.anchors().map(|anchor| anchor.pose)).powi(2);
        falling(error, self.config.global_root_ori_std_rad)
    }

    fn body_pos(&self) -> f64 {
        falling(self.mean_of_pairs(|pair| distance_m(pair).powi(2)), self.config.body_pos_std_m)
    }

    fn body_ori(&self) -> f64 {
        falling(self.mean_of_pairs(|pair| angle_rad(pair).powi(2)), self.config.body_ori_std_rad)
    }

    fn body_lin_vel(&self) -> f64 {
        let error = self.mean_of(|robot, motion| robot.linear_mps - motion.linear_mps);
        falling(error, self.config.body_lin_vel_std_mps)
    }

    fn body_ang_vel(&self) -> f64 {
        let error = self.mean_of(|robot, motion| robot.angular_radps - motion.angular_radps);
        falling(error, self.config.body_ang_vel_std_radps)
    }

    fn action_rate(&self) -> f64 {
        let [now, before] = self.actions;
        now.iter().zip(before).map(|(now, before)| (now - before).powi(2)).sum()
    }

    fn joint_limit(&self) -> f64 {
        beyond_soft_limits_rad(self.physics.model(), self.physics.joint_angles())
    }

    fn self_collisions(&self) -> f64 {
        let is_hard = |force: &Vector3<f64>| force.norm() > SELF_CONTACT_N;
        let mut contacts = self.physics.contact_points();
        f64::from(u8::from(
            contacts.any(|contact| contact.links.iter().all(Option::is_some) && is_hard(&contact.force_n)),
        ))
    }
}

/// Returns exp(-error/width²).
fn falling(error: f64, width: f64) -> f64 {
    (-error / width.powi(2)).exp()
}

fn distance_m([one, other]: &[Isometry3<f64>; 2]) -> f64 {
    (one.translation.vector - other.translation.vector).norm()
}

fn angle_rad([one, other]: &[Isometry3<f64>; 2]) -> f64 {
    one.rotation.angle_to(&other.rotation)
}

/// Returns the part of a rotation about the vertical: of yaw, pitch and roll in this order, the yaw.
fn about_vertical(rotation: &UnitQuaternion<f64>) -> UnitQuaternion<f64> {
    let forward = rotation * Vector3::x();
    UnitQuaternion::from_axis_angle(&Vector3::z_axis(), forward.y.atan2(forward.x))
}
