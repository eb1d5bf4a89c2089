//! Linear and angular momentum of the whole humanoid, which only gravity changes in flight.
//!
//! Time stepping conserves momentum only approximately. A correction of the root's velocity restores it exactly, which costs
//! less than finer steps.

use nalgebra::{Matrix3, Vector3};

use super::posture::Posture;
use super::spatial::{Force, Inertia, Motion};

/// Momentum and inertia of the whole humanoid.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Momentum {
    /// Moment of momentum about the centre of mass (N·m·s) and linear momentum (N·s).
    pub(crate) about_centre: Force,
    /// Centre of mass (m, relative to O).
    pub(crate) centre_m: Vector3<f64>,
    inertia: Inertia,
}

impl Momentum {
    /// Sums over the bodies of a posture with inertia, moving at the given velocities.
    pub(crate) fn of(posture: &Posture, velocities: &[Motion]) -> Self {
        let (mut inertia, mut sum) = (Inertia::default(), Force::default());
        for (part, velocity) in posture.inertias.iter().zip(velocities) {
            inertia += *part;
            sum += part.times(velocity);
        }
        let centre_m = inertia.first_moment / inertia.mass_kg;
        let about_centre = Force { moment: sum.moment - centre_m.cross(&sum.force), force: sum.force };
        Self { about_centre, centre_m, inertia }
    }

    /// Returns a copy whose momentum includes `time_s` of gravity and an impulse (moment about the centre of mass).
    pub(crate) fn expected_after(&self, gravity_mps2: &Vector3<f64>, time_s: f64, impulse: &Force) -> Self {
        let mut expected = *self;
        expected.about_centre += *impulse;
        expected.about_centre.force += gravity_mps2 * (self.inertia.mass_kg * time_s);
        expected
    }

    /// Returns the velocity of the centre of mass (m/s).
    pub(crate) fn velocity_mps(&self) -> Vector3<f64> {
        self.about_centre.force / self.inertia.mass_kg
    }

    /// Corrects the root's part of a velocity vector so that this momentum becomes `wanted` (moment about the centre).
    pub(crate) fn restore(&self, posture: &Posture, wanted: &Force, velocity: &mut [f64]) {
        let missing_moment = wanted.moment - self.about_centre.moment;
        let missing = wanted.force - self.about_centre.force;
        let about_centre = self.about_centre_inertia();
        let Some(inverse) = about_centre.try_inverse() else { return };
        let angular = inverse * missing_moment;
        let linear = missing / self.inertia.mass_kg - angular.cross(&self.centre_m);
        let local = posture.rotations[0].transpose() * angular;
        for axis in 0..3 {
            velocity[axis] += linear[axis];
            velocity[3 + axis] += local[axis];
        }
    }

    fn about_centre_inertia(&self) -> Matrix3<f64> {
        let c = self.centre_m;
        let shift = Matrix3::identity() * c.norm_squared() - c * c.transpose();
        self.inertia.about_origin - shift * self.inertia.mass_kg
    }
}
