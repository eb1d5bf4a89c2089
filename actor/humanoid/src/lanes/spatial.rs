//! Spatial vectors and inertias, in world axes and about one common point O.
//!
//! A motion is (angular velocity, velocity of the body's point at O). A force is (moment about O, force).
//! Formulas: R. Featherstone, *Rigid Body Dynamics Algorithms*, 2008, chapter 2.

use std::ops::{AddAssign, SubAssign};

use super::{Lanes, Mat3, Simd, Vec3};

/// Motion vector: angular part (rad/s or rad/s²) and linear part at O (m/s or m/s²).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion<S: Simd> {
    pub(crate) angular: Vec3<S>,
    pub(crate) linear: Vec3<S>,
}

/// Force vector: moment about O (N·m) and force (N), or their time integrals.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Force<S: Simd> {
    pub(crate) moment: Vec3<S>,
    pub(crate) force: Vec3<S>,
}

/// Inertia of a body about O.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inertia<S: Simd> {
    pub(crate) mass_kg: Lanes<S>,
    /// Mass × position of the centre of mass (kg·m).
    pub(crate) first_moment: Vec3<S>,
    /// Moment of inertia about O: xx, yy, zz, xy, xz, yz (kg·m²).
    pub(crate) about_origin: [Lanes<S>; 6],
}

impl<S: Simd> Motion<S> {
    #[inline(always)]
    pub(crate) fn zero(simd: S) -> Self {
        Self { angular: Vec3::zero(simd), linear: Vec3::zero(simd) }
    }

    /// Returns the rate of change of a motion vector that moves with this velocity.
    #[inline(always)]
    pub(crate) fn cross(&self, other: &Self) -> Self {
        Self {
            angular: self.angular.cross(&other.angular),
            linear: self.angular.cross(&other.linear) + self.linear.cross(&other.angular),
        }
    }

    /// Returns the rate of change of a force vector that moves with this velocity.
    #[inline(always)]
    pub(crate) fn cross_force(&self, force: &Force<S>) -> Force<S> {
        Force {
            moment: self.angular.cross(&force.moment) + self.linear.cross(&force.force),
            force: self.angular.cross(&force.force),
        }
    }

    /// Returns the power of a force, or its component along a joint axis.
    #[inline(always)]
    pub(crate) fn dot(&self, force: &Force<S>) -> Lanes<S> {
        self.angular.dot(&force.moment) + self.linear.dot(&force.force)
    }

    /// Returns the velocity of the body's point at `point_m` (relative to O).
    #[inline(always)]
    pub(crate) fn at(&self, point_m: &Vec3<S>) -> Vec3<S> {
        self.linear + self.angular.cross(point_m)
    }

    /// Returns `self + axis * rate`.
    #[inline(always)]
    pub(crate) fn plus(&self, axis: &Self, rate: Lanes<S>) -> Self {
        Self { angular: axis.angular.mul_add(rate, &self.angular), linear: axis.linear.mul_add(rate, &self.linear) }
    }
}

impl<S: Simd> Force<S> {
    #[inline(always)]
    pub(crate) fn zero(simd: S) -> Self {
        Self { moment: Vec3::zero(simd), force: Vec3::zero(simd) }
    }
}

impl<S: Simd> Inertia<S> {
    #[inline(always)]
    pub(crate) fn zero(simd: S) -> Self {
        Self { mass_kg: Lanes::zero(simd), first_moment: Vec3::zero(simd), about_origin: [Lanes::zero(simd); 6] }
    }

    /// Combines mass, centre (m, relative to O), orientation, and inertia about the centre in the body's axes: xx, yy,
    /// zz, xy, xz, yz (kg·m²).
    #[inline(always)]
    pub(crate) fn new(mass_kg: Lanes<S>, centre_m: &Vec3<S>, rotation: &Mat3<S>, own: &[Lanes<S>; 6]) -> Self {
        let first_moment = *centre_m * mass_kg;
        let (c, m) = (centre_m, &first_moment);
        let [ixx, iyy, izz, ixy, ixz, iyz] = *own;
        // Columns of rotation × own.
        let half = [
            rotation.times(&Vec3::new(ixx, ixy, ixz)),
            rotation.times(&Vec3::new(ixy, iyy, iyz)),
            rotation.times(&Vec3::new(ixz, iyz, izz)),
        ];
        let [a, b, d] = &rotation.columns;
        let [h, k, l] = &half;
        // Rows of half, and of the rotation: entry (i, j) of half × rotationᵀ is the product of rows i and j.
        let rows = [Vec3::new(h.x, k.x, l.x), Vec3::new(h.y, k.y, l.y), Vec3::new(h.z, k.z, l.z)];
        let turned = [Vec3::new(a.x, b.x, d.x), Vec3::new(a.y, b.y, d.y), Vec3::new(a.z, b.z, d.z)];
        let (xx, yy, zz) = (c.x * m.x, c.y * m.y, c.z * m.z);
        Self {
            mass_kg,
            first_moment,
            about_origin: [
                rows[0].dot(&turned[0]) + (yy + zz),
                rows[1].dot(&turned[1]) + (xx + zz),
                rows[2].dot(&turned[2]) + (xx + yy),
                rows[0].dot(&turned[1]) - c.x * m.y,
                rows[0].dot(&turned[2]) - c.x * m.z,
                rows[1].dot(&turned[2]) - c.y * m.z,
            ],
        }
    }

    /// Returns the momentum of a velocity, or the force of an acceleration.
    #[inline(always)]
    pub(crate) fn times(&self, motion: &Motion<S>) -> Force<S> {
        let [xx, yy, zz, xy, xz, yz] = self.about_origin;
        let w = &motion.angular;
        let turned = Vec3::new(
            xx.mul_add(w.x, xy.mul_add(w.y, xz * w.z)),
            xy.mul_add(w.x, yy.mul_add(w.y, yz * w.z)),
            xz.mul_add(w.x, yz.mul_add(w.y, zz * w.z)),
        );
        Force {
            moment: turned + self.first_moment.cross(&motion.linear),
            force: motion.linear * self.mass_kg - self.first_moment.cross(w),
        }
    }
}

fieldwise!(AddAssign, add_assign, Motion, angular linear);
fieldwise!(AddAssign, add_assign, Force, moment force);
fieldwise!(SubAssign, sub_assign, Force, moment force);

impl<S: Simd> AddAssign for Inertia<S> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        self.mass_kg += other.mass_kg;
        self.first_moment += other.first_moment;
        for (own, other) in self.about_origin.iter_mut().zip(other.about_origin) {
            *own += other;
        }
    }
}
