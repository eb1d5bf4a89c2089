//! Motion of the rigid bodies.

use nalgebra::{Isometry3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

use crate::dynamics::{BodyState, World};

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

/// Motion of the frame of one link in the world frame.
#[derive(Clone, Copy, Debug)]
pub struct LinkMotion {
    /// Pose of the link's frame (m).
    pub pose: Isometry3<f64>,
    /// Velocity of its origin (m/s).
    pub linear_mps: Vector3<f64>,
    /// Angular velocity (rad/s).
    pub angular_radps: Vector3<f64>,
}

impl World {
    fn root_m(&self) -> Vector3<f64> {
        Vector3::from_column_slice(&self.position[..3])
    }

    /// Returns pose and velocity of a body.
    pub(crate) fn body_motion(&self, body: usize) -> BodyMotion {
        let body = &self.bodies[body];
        let rotation = Rotation3::from_matrix_unchecked(body.rotation);
        BodyMotion {
            pose: Isometry3::from_parts(
                Translation3::from(self.root_m() + body.origin_m),
                UnitQuaternion::from_rotation_matrix(&rotation),
            ),
            linear_mps: body.linear_mps,
            angular_radps: body.angular_radps,
        }
    }

    /// Returns the centre of mass of the whole humanoid (m, world frame).
    pub(crate) fn centre_of_mass(&self) -> Point3<f64> {
        Point3::from(self.root_m() + self.mean_over_mass(|body| body.centre_m))
    }

    /// Returns the mean of a quantity of the bodies, weighted by their masses.
    pub(super) fn mean_over_mass(&self, quantity: impl Fn(&BodyState) -> Vector3<f64>) -> Vector3<f64> {
        let masses = &self.parameters.masses_kg;
        let sum: Vector3<f64> = self.bodies.iter().zip(masses).map(|(body, mass)| quantity(body) * *mass).sum();
        sum / masses.iter().sum::<f64>()
    }
}
