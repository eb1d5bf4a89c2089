//! Spatial vectors and inertias, in world axes and about one common point O.
//!
//! A motion is (angular velocity, velocity of the body's point at O). A force is (moment about O, force).
//! Formulas: R. Featherstone, *Rigid Body Dynamics Algorithms*, 2008, chapter 2.

use std::ops::{AddAssign, Mul, SubAssign};

use nalgebra::{Matrix3, Vector3};

/// Motion vector: angular part (rad/s or rad/s²) and linear part at O (m/s or m/s²).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Motion {
    pub(crate) angular: Vector3<f64>,
    pub(crate) linear: Vector3<f64>,
}

/// Force vector: moment about O (N·m) and force (N), or their time integrals.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Force {
    pub(crate) moment: Vector3<f64>,
    pub(crate) force: Vector3<f64>,
}

/// Inertia of a body about O.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Inertia {
    pub(crate) mass_kg: f64,
    /// Mass × position of the centre of mass (kg·m).
    pub(crate) first_moment: Vector3<f64>,
    /// Moment of inertia about O (kg·m²).
    pub(crate) about_origin: Matrix3<f64>,
}

impl Motion {
    pub(crate) fn new(angular: Vector3<f64>, linear: Vector3<f64>) -> Self {
        Self { angular, linear }
    }

    /// Returns the rate of change of a motion vector that moves with this velocity.
    #[inline]
    pub(crate) fn cross(&self, other: &Self) -> Self {
        Self {
            angular: self.angular.cross(&other.angular),
            linear: self.angular.cross(&other.linear) + self.linear.cross(&other.angular),
        }
    }

    /// Returns the rate of change of a force vector that moves with this velocity.
    #[inline]
    pub(crate) fn cross_force(&self, force: &Force) -> Force {
        Force {
            moment: self.angular.cross(&force.moment) + self.linear.cross(&force.force),
            force: self.angular.cross(&force.force),
        }
    }

    /// Returns the power of a force, or its component along a joint axis.
    #[inline]
    pub(crate) fn dot(&self, force: &Force) -> f64 {
        self.angular.dot(&force.moment) + self.linear.dot(&force.force)
    }

    /// Returns the velocity of the body's point at `point_m` (relative to O).
    #[inline]
    pub(crate) fn at(&self, point_m: &Vector3<f64>) -> Vector3<f64> {
        self.linear + self.angular.cross(point_m)
    }
}

impl Force {
    /// Returns the force vector of a force (N) at a point (relative to O) together with a moment (N·m).
    #[inline]
    pub(crate) fn at(point_m: &Vector3<f64>, force: Vector3<f64>, moment: Vector3<f64>) -> Self {
        Self { moment: moment + point_m.cross(&force), force }
    }
}

impl Inertia {
    /// Combines mass, centre (m, relative to O) and inertia about the centre (kg·m², world axes).
    #[inline]
    pub(crate) fn new(mass_kg: f64, centre_m: &Vector3<f64>, about_centre: &Matrix3<f64>) -> Self {
        let first_moment = centre_m * mass_kg;
        let (c, m) = (centre_m, &first_moment);
        let (xx, yy, zz) = (c.x * m.x, c.y * m.y, c.z * m.z);
        let (xy, xz, yz) = (c.x * m.y, c.x * m.z, c.y * m.z);
        let about_origin = about_centre + Matrix3::new(yy + zz, -xy, -xz, -xy, xx + zz, -yz, -xz, -yz, xx + yy);
        Self { mass_kg, first_moment, about_origin }
    }

    /// Returns the momentum of a velocity, or the force of an acceleration.
    #[inline]
    pub(crate) fn times(&self, motion: &Motion) -> Force {
        Force {
            moment: self.about_origin * motion.angular + self.first_moment.cross(&motion.linear),
            force: motion.linear * self.mass_kg - self.first_moment.cross(&motion.angular),
        }
    }
}

impl AddAssign for Motion {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        self.angular += other.angular;
        self.linear += other.linear;
    }
}

impl Mul<f64> for Motion {
    type Output = Self;
    #[inline]
    fn mul(self, factor: f64) -> Self {
        Self { angular: self.angular * factor, linear: self.linear * factor }
    }
}

impl AddAssign for Force {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        self.moment += other.moment;
        self.force += other.force;
    }
}

impl SubAssign for Force {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        self.moment -= other.moment;
        self.force -= other.force;
    }
}

impl AddAssign for Inertia {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        self.mass_kg += other.mass_kg;
        self.first_moment += other.first_moment;
        self.about_origin += other.about_origin;
    }
}
