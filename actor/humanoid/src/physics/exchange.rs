//! Body states that Rapier receives before a physics step.
//!
//! The origin of Rapier's world is always the point of the floor below the root, so that single precision suffices at any
//! distance from the start.

use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use rapier3d::math::Pose;

use super::convert::{to_rotation, to_vector};
use super::world::RapierWorld;
use crate::dynamics::{Flight, Motion, Posture, Tree};

/// Sets the bodies to the poses at the start of the flight and its final velocities; `velocities` is workspace.
pub(super) fn send(
    world: &mut RapierWorld,
    tree: &Tree,
    start: &Posture,
    root_height_m: f64,
    flight: &Flight,
    velocities: &mut [Motion],
) {
    let root = Vector3::new(0.0, 0.0, root_height_m);
    flight.middle.velocities(tree, &flight.velocity, velocities);
    for (index, (handle, velocity)) in world.bodies.iter().zip(&*velocities).enumerate() {
        let body = &mut world.rapier.bodies[*handle];
        body.set_position(pose(start, index, &root), false);
        body.set_linvel(to_vector(&velocity.at(&flight.middle.centres_m[index])), false);
        body.set_angvel(to_vector(&velocity.angular), false);
    }
}

/// Returns the pose of a body when the root is at `root_m`.
pub(super) fn pose(posture: &Posture, body: usize, root_m: &Vector3<f64>) -> Pose {
    let rotation = Rotation3::from_matrix_unchecked(posture.rotations[body]);
    let rotation = to_rotation(&UnitQuaternion::from_rotation_matrix(&rotation));
    Pose::from_parts(to_vector(&(root_m + posture.origins_m[body])), rotation)
}
