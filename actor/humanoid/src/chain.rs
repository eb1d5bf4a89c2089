//! Frames of a chain of up to three hinges with perpendicular neighbours.
//!
//! Everything here is expressed in the *chain frame*: the triad of [`crate::model::Body::hinge_frame`] carried
//! back to the parent's side. In it hinge 1 turns about x, hinge 2 about y as turned by hinge 1, hinge 3 about z as
//! turned by both. *Turns* are those three angles (rad); a chain with fewer hinges has zeros at the end.

use nalgebra::{Point3, UnitQuaternion, Vector3};

use crate::model::Body;

/// Below this cosine of the second turn, axes 1 and 3 are taken as no closer to parallel than this.
///
/// The true factor 1/cos would let constraints grow without bound near the singular posture.
const COSINE_MIN: f64 = 0.2;

/// Rotation about x (rad).
pub(crate) fn turn_x(angle_rad: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::x_axis(), angle_rad)
}

/// Rotation about y (rad).
pub(crate) fn turn_y(angle_rad: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::y_axis(), angle_rad)
}

/// Rotation about z (rad).
pub(crate) fn turn_z(angle_rad: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle_rad)
}

/// Cosine by which axes 1 and 3 of a three-hinge chain miss being perpendicular; 1 for shorter chains.
pub(crate) fn slant(hinges: usize, turns: &[f64; 3]) -> f64 {
    if hinges == 3 { turns[1].cos().abs().max(COSINE_MIN) } else { 1.0 }
}

/// Orientation of a body's chain frame in its parent's frame.
pub(crate) fn base(body: &Body) -> UnitQuaternion<f64> {
    body.pose.rotation * body.hinge_frame
}

/// Where the hinges of a body sit in its parent's frame (m).
pub(crate) fn parent_anchor(body: &Body) -> Point3<f64> {
    body.pose * body.anchor_m
}
