//! Motion of the rigid bodies, computed from joint coordinates.

use nalgebra::{Isometry3, Rotation3, Translation3, UnitQuaternion, Vector3};

use crate::dynamics::{Motion, Posture, Tree};

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
    pub(crate) fn at_rest() -> Self {
        Self { pose: Isometry3::identity(), linear_mps: Vector3::zeros(), angular_radps: Vector3::zeros() }
    }
}

/// Writes the motion of all bodies for a posture with the root at `root_m` and a velocity vector.
pub(super) fn write_motions(
    tree: &Tree,
    posture: &Posture,
    root_m: &Vector3<f64>,
    velocity: &[f64],
    velocities: &mut [Motion],
    motions: &mut [BodyMotion],
) {
    posture.velocities(tree, velocity, velocities);
    for (index, motion) in motions.iter_mut().enumerate() {
        let rotation = Rotation3::from_matrix_unchecked(posture.rotations[index]);
        *motion = BodyMotion {
            pose: Isometry3::from_parts(
                Translation3::from(root_m + posture.origins_m[index]),
                UnitQuaternion::from_rotation_matrix(&rotation),
            ),
            linear_mps: velocities[index].at(&posture.centres_m[index]),
            angular_radps: velocities[index].angular,
        };
    }
}
