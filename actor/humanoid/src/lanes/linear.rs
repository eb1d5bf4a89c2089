//! Vectors and matrices in three dimensions.

use std::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

use super::{Lanes, Simd};
use nalgebra::{Matrix3, Vector3};

#[derive(Clone, Copy, Debug)]
pub(crate) struct Vec3<S: Simd> {
    pub(crate) x: Lanes<S>,
    pub(crate) y: Lanes<S>,
    pub(crate) z: Lanes<S>,
}

/// Matrix by columns.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mat3<S: Simd> {
    pub(crate) columns: [Vec3<S>; 3],
}

impl<S: Simd> Vec3<S> {
    #[inline(always)]
    pub(crate) fn new(x: Lanes<S>, y: Lanes<S>, z: Lanes<S>) -> Self {
        Self { x, y, z }
    }

    #[inline(always)]
    pub(crate) fn splat(simd: S, vector: &Vector3<f64>) -> Self {
        Self::new(Lanes::splat(simd, vector.x), Lanes::splat(simd, vector.y), Lanes::splat(simd, vector.z))
    }

    #[inline(always)]
    pub(crate) fn zero(simd: S) -> Self {
        let zero = Lanes::zero(simd);
        Self::new(zero, zero, zero)
    }

    #[inline(always)]
    pub(crate) fn dot(&self, other: &Self) -> Lanes<S> {
        self.x.mul_add(other.x, self.y.mul_add(other.y, self.z * other.z))
    }

    #[inline(always)]
    pub(crate) fn cross(&self, other: &Self) -> Self {
        Self::new(
            self.y.mul_add(other.z, -(self.z * other.y)),
            self.z.mul_add(other.x, -(self.x * other.z)),
            self.x.mul_add(other.y, -(self.y * other.x)),
        )
    }

    /// Returns `self * factor + term`.
    #[inline(always)]
    pub(crate) fn mul_add(&self, factor: Lanes<S>, term: &Self) -> Self {
        Self::new(self.x.mul_add(factor, term.x), self.y.mul_add(factor, term.y), self.z.mul_add(factor, term.z))
    }

    #[inline(always)]
    pub(crate) fn lane(&self, lane: usize) -> Vector3<f64> {
        Vector3::new(self.x.lane(lane), self.y.lane(lane), self.z.lane(lane))
    }

    #[inline(always)]
    pub(crate) fn set_lane(&mut self, lane: usize, vector: &Vector3<f64>) {
        self.x.set_lane(lane, vector.x);
        self.y.set_lane(lane, vector.y);
        self.z.set_lane(lane, vector.z);
    }
}

impl<S: Simd> Mat3<S> {
    #[inline(always)]
    pub(crate) fn identity(simd: S) -> Self {
        Self { columns: [Vector3::x(), Vector3::y(), Vector3::z()].map(|column| Vec3::splat(simd, &column)) }
    }

    /// Returns the product with a vector.
    #[inline(always)]
    pub(crate) fn times(&self, vector: &Vec3<S>) -> Vec3<S> {
        let [a, b, c] = &self.columns;
        a.mul_add(vector.x, &b.mul_add(vector.y, &(*c * vector.z)))
    }

    /// Returns the product with a vector that is the same in every lane.
    #[inline(always)]
    pub(crate) fn times_constant(&self, vector: &Vector3<f64>) -> Vec3<S> {
        let one = self.columns[0].x;
        self.times(&Vec3::new(one.constant(vector.x), one.constant(vector.y), one.constant(vector.z)))
    }

    /// Returns the product of the transpose with a vector.
    #[inline(always)]
    pub(crate) fn transpose_times(&self, vector: &Vec3<S>) -> Vec3<S> {
        let [a, b, c] = &self.columns;
        Vec3::new(a.dot(vector), b.dot(vector), c.dot(vector))
    }

    /// Returns the product with a matrix that is the same in every lane.
    #[inline(always)]
    pub(crate) fn times_constant_matrix(&self, matrix: &Matrix3<f64>) -> Self {
        let [a, b, c] = [matrix.column(0).into(), matrix.column(1).into(), matrix.column(2).into()];
        Self { columns: [self.times_constant(&a), self.times_constant(&b), self.times_constant(&c)] }
    }

    #[inline(always)]
    pub(crate) fn lane(&self, lane: usize) -> Matrix3<f64> {
        Matrix3::from_columns(&self.columns.map(|column| column.lane(lane)))
    }
}

impl<S: Simd> Add for Vec3<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<S: Simd> Sub for Vec3<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<S: Simd> Neg for Vec3<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl<S: Simd> Mul<Lanes<S>> for Vec3<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: Lanes<S>) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

fieldwise!(AddAssign, add_assign, Vec3, x y z);
fieldwise!(SubAssign, sub_assign, Vec3, x y z);
