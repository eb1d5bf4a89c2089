//! Inertia and velocity of one link about any point.

use nalgebra::{Isometry3, Matrix3, Point3, Vector3, Vector6};

use crate::model::{Body, Link};
use crate::physics::BodyMotion;

/// Spatial inertia about one point, in world axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SpatialInertia {
    /// Inertia about the point (kg·m²).
    inertia_kgm2: Matrix3<f64>,
    /// Mass × offset of the centre of mass from the point (kg·m).
    moment_kgm: Vector3<f64>,
    /// Mass (kg).
    mass_kg: f64,
}

impl SpatialInertia {
    /// Computes the inertia of a link about `point` (m, world frame); `pose` is that of its body.
    pub(super) fn of_link(link: &Link, pose: &Isometry3<f64>, point: &Point3<f64>) -> Self {
        let rotation = pose.rotation.to_rotation_matrix();
        let own = rotation.matrix() * link.inertia_kgm2 * rotation.matrix().transpose();
        let offset = pose * link.centre_of_mass_m - point;
        // Parallel axis theorem.
        let moved = (Matrix3::identity() * offset.norm_squared() - offset * offset.transpose()) * link.mass_kg;
        Self { inertia_kgm2: own + moved, moment_kgm: offset * link.mass_kg, mass_kg: link.mass_kg }
    }

    /// Returns xx, yy, zz, xy, xz, yz of the inertia, then mass × offset, then mass: MuJoCo's order in `cinert`.
    pub(super) fn numbers(&self) -> [f64; 10] {
        let (i, m) = (&self.inertia_kgm2, &self.moment_kgm);
        [i[(0, 0)], i[(1, 1)], i[(2, 2)], i[(0, 1)], i[(0, 2)], i[(1, 2)], m.x, m.y, m.z, self.mass_kg]
    }
}

/// Returns the angular velocity (rad/s), then the velocity (m/s) of the body's point at `point`; world frame.
pub(super) fn velocity_about(point: &Point3<f64>, body: &Body, motion: &BodyMotion) -> Vector6<f64> {
    let arm = point - motion.pose * body.centre_of_mass_m;
    let linear = motion.linear_mps + motion.angular_radps.cross(&arm);
    let angular = &motion.angular_radps;
    Vector6::new(angular.x, angular.y, angular.z, linear.x, linear.y, linear.z)
}

#[cfg(test)]
mod tests {
    use nalgebra::{Translation3, UnitQuaternion};

    use super::*;
    use crate::{HUMANOID_XML, Model};

    fn link(mass_kg: f64, inertia_kgm2: Matrix3<f64>) -> Link {
        Link {
            name: "rod".into(),
            body: 0,
            pose: Isometry3::identity(),
            shapes: 0..0,
            mass_kg,
            centre_of_mass_m: Point3::new(1.0, 0.0, 0.0),
            inertia_kgm2,
        }
    }

    #[test]
    fn inertia_of_a_rotated_and_shifted_link_matches_the_one_by_hand() {
        // Centre at (1, 0, 0) in a frame rotated by 90° about z and shifted to (0, 0, 3): (0, 1, 3) in the world.
        let pose = Isometry3::from_parts(
            Translation3::new(0.0, 0.0, 3.0),
            UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2),
        );
        let link = link(2.0, Matrix3::from_diagonal(&Vector3::new(0.1, 0.2, 0.3)));
        let found = SpatialInertia::of_link(&link, &pose, &Point3::new(-1.0, -1.0, 1.0)).numbers();
        // The offset is (1, 2, 2); the rotation swaps the first two principal axes; then 2 kg × (|d|² 1 − d dᵀ).
        let expected =
            [0.2 + 2.0 * 8.0, 0.1 + 2.0 * 5.0, 0.3 + 2.0 * 5.0, -2.0 * 2.0, -2.0 * 2.0, -2.0 * 4.0, 2.0, 4.0, 4.0, 2.0];
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{found} instead of {expected}");
        }
    }

    #[test]
    fn velocity_at_a_point_outside_the_body_matches_the_one_by_hand() {
        let model = Model::from_mjcf(HUMANOID_XML).expect("valid");
        let body = Body { centre_of_mass_m: Point3::new(0.0, 0.0, 1.0), ..model.bodies[0].clone() };
        let motion = BodyMotion {
            pose: Isometry3::identity(),
            linear_mps: Vector3::new(1.0, 0.0, 0.0),
            angular_radps: Vector3::new(0.0, 3.0, 0.0),
        };
        // 2 m below the centre of mass: 3 rad/s about y moves that point by −6 m/s along x.
        let found = velocity_about(&Point3::new(0.0, 0.0, -1.0), &body, &motion);
        assert!((found - Vector6::new(0.0, 3.0, 0.0, 1.0 - 6.0, 0.0, 0.0)).norm() < 1e-12);
    }
}
