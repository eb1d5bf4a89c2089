//! Between generalised coordinates and the motion of the bodies, both ways.
//!
//! Position vector: root x, y, z (m), root quaternion w, x, y, z, one angle per hinge (rad).
//! Velocity vector: root velocity in the world frame (m/s), root angular velocity in the root's frame (rad/s),
//! one rate per hinge (rad/s).

use nalgebra::{Isometry3, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};

use crate::chain;
use crate::model::{Body, Model};

/// Motion of one rigid body in the world frame.
#[derive(Clone, Copy, Debug)]
pub struct BodyMotion {
    /// Pose of the body's frame (m).
    pub pose: Isometry3<f64>,
    /// Velocity of the centre of mass (m/s).
    pub linear_mps: Vector3<f64>,
    /// Angular velocity (rad/s).
    pub angular_radps: Vector3<f64>,
}

impl BodyMotion {
    pub(crate) const fn still(pose: Isometry3<f64>) -> Self {
        Self { pose, linear_mps: Vector3::new(0.0, 0.0, 0.0), angular_radps: Vector3::new(0.0, 0.0, 0.0) }
    }

    /// Velocity (m/s) of the point of the body that is at `point` (world, m).
    fn velocity_at(&self, body: &Body, point: &Point3<f64>) -> Vector3<f64> {
        self.linear_mps + self.angular_radps.cross(&(point - self.pose * body.centre_of_mass_m))
    }
}

/// Angles and rates of the hinge chain between a body and its parent, in chain-frame terms.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ChainMotion {
    /// See [`chain`].
    pub(crate) turns_rad: [f64; 3],
    /// Time derivatives of the turns.
    pub(crate) rates_radps: [f64; 3],
}

/// Orientation of a body's chain frame in its parent's frame.
pub(crate) fn chain_base(body: &Body) -> UnitQuaternion<f64> {
    body.pose.rotation * body.hinge_frame
}

/// Where the hinges of a body sit in its parent's frame (m).
pub(crate) fn parent_anchor(body: &Body) -> Point3<f64> {
    body.pose * body.anchor_m
}

/// Places all bodies according to a position and a velocity vector.
pub(crate) fn place(model: &Model, position: &[f64], velocity: &[f64], motions: &mut [BodyMotion]) {
    for (index, body) in model.bodies.iter().enumerate() {
        motions[index] = match body.parent {
            None => place_root(body, position, velocity),
            Some(parent) => {
                let mut moved = ChainMotion::default();
                for (slot, hinge) in body.hinges.clone().enumerate() {
                    let sign = model.hinges[hinge].frame_sign;
                    moved.turns_rad[slot] = sign * position[7 + hinge];
                    moved.rates_radps[slot] = sign * velocity[6 + hinge];
                }
                place_child(body, &model.bodies[parent], &motions[parent], &moved)
            }
        };
    }
}

fn place_root(body: &Body, position: &[f64], velocity: &[f64]) -> BodyMotion {
    let rotation = UnitQuaternion::new_normalize(Quaternion::new(position[3], position[4], position[5], position[6]));
    let pose = Isometry3::from_parts(Translation3::new(position[0], position[1], position[2]), rotation);
    let angular_radps = rotation * Vector3::from_column_slice(&velocity[3..6]);
    let arm = rotation * body.centre_of_mass_m.coords;
    let linear_mps = Vector3::from_column_slice(&velocity[..3]) + angular_radps.cross(&arm);
    BodyMotion { pose, linear_mps, angular_radps }
}

fn place_child(body: &Body, parent: &Body, parent_motion: &BodyMotion, moved: &ChainMotion) -> BodyMotion {
    let base = parent_motion.pose.rotation * chain_base(body);
    let rotation = base * chain::compose(&moved.turns_rad) * body.hinge_frame.inverse();
    let anchor = parent_motion.pose * parent_anchor(body);
    let pose = Isometry3::from_parts(Translation3::from(anchor - rotation * body.anchor_m.coords), rotation);

    let turning: Vector3<f64> =
        chain::axes(&moved.turns_rad).iter().zip(moved.rates_radps).map(|(axis, rate)| axis * rate).sum();
    let angular_radps = parent_motion.angular_radps + base * turning;
    let arm = pose * body.centre_of_mass_m - anchor;
    let linear_mps = parent_motion.velocity_at(parent, &anchor) + angular_radps.cross(&arm);
    BodyMotion { pose, linear_mps, angular_radps }
}

/// Reads the position and velocity vectors, and the motion of every chain, off the bodies.
///
/// The quaternion keeps the sign that integration gives it: making w positive would be a jump in the observation
/// whenever the body rolls over.
pub(crate) fn read(
    model: &Model,
    motions: &[BodyMotion],
    chains: &mut [ChainMotion],
    position: &mut [f64],
    velocity: &mut [f64],
) {
    for (index, body) in model.bodies.iter().enumerate() {
        let motion = &motions[index];
        let Some(parent) = body.parent else {
            let origin = Point3::from(motion.pose.translation.vector);
            let quaternion = motion.pose.rotation.quaternion();
            position[..3].copy_from_slice(origin.coords.as_slice());
            position[3..7].copy_from_slice(&[quaternion.w, quaternion.i, quaternion.j, quaternion.k]);
            velocity[..3].copy_from_slice(motion.velocity_at(body, &origin).as_slice());
            let turning = motion.pose.rotation.inverse() * motion.angular_radps;
            velocity[3..6].copy_from_slice(turning.as_slice());
            continue;
        };
        let base = motions[parent].pose.rotation * chain_base(body);
        let relative = base.inverse() * motion.pose.rotation * body.hinge_frame;
        let turning = base.inverse() * (motion.angular_radps - motions[parent].angular_radps);
        let count = body.hinges.len();
        let mut turns_rad = chain::decompose(count, &relative);
        let duals = chain::dual_axes(count, &turns_rad);
        let mut rates_radps = [0.0; 3];
        for (slot, hinge) in body.hinges.clone().enumerate() {
            let sign = model.hinges[hinge].frame_sign;
            rates_radps[slot] = duals[slot].dot(&turning);
            let angle = chain::unwrap_near(sign * turns_rad[slot], model.hinges[hinge].centre_rad());
            turns_rad[slot] = sign * angle;
            position[7 + hinge] = angle;
            velocity[6 + hinge] = sign * rates_radps[slot];
        }
        chains[index] = ChainMotion { turns_rad, rates_radps };
    }
}
