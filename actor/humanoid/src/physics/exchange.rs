//! What goes to Rapier before a physics step.
//!
//! Rapier's world travels with the robot: its origin is always the point of the floor below the root, so that single
//! precision is as good after a kilometre as at the start.

use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use rapier3d::math::Pose;

use super::convert::{to_rotation, to_vector};
use super::world::World;
use crate::dynamics::{Flight, Posture};

/// Puts the bodies at the start of the flight, with the velocities that lead straight to its end.
pub(super) fn send(world: &mut World, position: &[f64], start: &Posture, flight: &Flight, step_s: f64) {
    let start_root = Vector3::new(0.0, 0.0, position[2]);
    let end_root = Vector3::new(flight.position[0] - position[0], flight.position[1] - position[1], flight.position[2]);
    for (index, handle) in world.bodies.iter().enumerate() {
        let (start_rotation, end_rotation) = (quaternion(start, index), quaternion(&flight.end, index));
        let way = end_root + flight.end.centres_m[index] - start_root - start.centres_m[index];
        let turn = (end_rotation * start_rotation.inverse()).scaled_axis();
        let body = &mut world.rapier.bodies[*handle];
        let place = to_vector(&(start_root + start.origins_m[index]));
        body.set_position(Pose::from_parts(place, to_rotation(&start_rotation)), false);
        body.set_linvel(to_vector(&(way / step_s)), false);
        body.set_angvel(to_vector(&(turn / step_s)), false);
    }
}

/// Pose of a body of which the root is at `root_m`.
pub(super) fn pose(posture: &Posture, body: usize, root_m: &Vector3<f64>) -> Pose {
    Pose::from_parts(to_vector(&(root_m + posture.origins_m[body])), to_rotation(&quaternion(posture, body)))
}

fn quaternion(posture: &Posture, body: usize) -> UnitQuaternion<f64> {
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(posture.rotations[body]))
}
