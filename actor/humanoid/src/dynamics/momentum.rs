//! Linear and angular momentum of the whole body, which nothing but gravity changes in flight.
//!
//! The time stepping keeps it only nearly. What it lost is given back through the root: exact conservation costs less
//! than the finer steps that would come as close.

use nalgebra::{Matrix3, Vector3};

use super::posture::Posture;
use super::spatial::{Force, Inertia, Motion};

/// Momentum of the whole body with the inertia that carries it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Momentum {
    /// Moment of momentum about the centre of mass (N·m·s) and linear momentum (N·s).
    pub(crate) about_centre: Force,
    /// Centre of mass (m, relative to O).
    pub(crate) centre_m: Vector3<f64>,
    inertia: Inertia,
}

impl Momentum {
    /// Of a posture that has been weighed, moving with the given body velocities.
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

    /// What gravity and the floor make of it; `given` has its moment about the centre of mass. Only the momentum is that
    /// of later.
    pub(crate) fn later(&self, gravity_mps2: &Vector3<f64>, time_s: f64, given: &Force) -> Self {
        let mut later = *self;
        later.about_centre += *given;
        later.about_centre.force += gravity_mps2 * (self.inertia.mass_kg * time_s);
        later
    }

    /// Velocity of the centre of mass (m/s).
    pub(crate) fn velocity_mps(&self) -> Vector3<f64> {
        self.about_centre.force / self.inertia.mass_kg
    }

    /// Changes the root's part of a velocity vector so that this momentum becomes `wanted` (moment about the centre).
    pub(crate) fn restore(&self, posture: &Posture, wanted: &Force, velocity: &mut [f64]) {
        let missing_moment = wanted.moment - self.about_centre.moment;
        let missing = wanted.force - self.about_centre.force;
        let about_centre = self.about_centre_inertia();
        let Some(inverse) = about_centre.try_inverse() else { return };
        let turning = inverse * missing_moment;
        let linear = missing / self.inertia.mass_kg - turning.cross(&self.centre_m);
        let local = posture.rotations[0].transpose() * turning;
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
