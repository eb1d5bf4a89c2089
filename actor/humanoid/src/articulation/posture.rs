//! Forward kinematics: poses and velocities of all bodies for one position and velocity vector.
//!
//! Points are relative to O, the root's origin, so that they stay precise far from the world's origin.

use nalgebra::Vector3;

use super::structure::{Axis, ROOT_DOFS, ROOT_POSITIONS, Structure};
use crate::lanes::{Inertia, Lanes, Mat3, Motion, Simd, Vec3};

/// Mass and inertia (xx, yy, zz, xy, xz, yz, in the body's axes) of one body in several worlds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyMasses<S: Simd> {
    pub(crate) mass_kg: Lanes<S>,
    pub(crate) inertia_kgm2: [Lanes<S>; 6],
}

/// Poses, joint axes and inertias of a tree at one position.
#[derive(Clone, Debug)]
pub(crate) struct Posture<S: Simd> {
    /// Orientation of each body in the world.
    pub(crate) rotations: Vec<Mat3<S>>,
    /// Origin of each body (m, relative to O).
    pub(crate) origins_m: Vec<Vec3<S>>,
    /// Centre of mass of each body (m, relative to O).
    pub(crate) centres_m: Vec<Vec3<S>>,
    /// Centre of mass of the root in its frame (m).
    pub(crate) root_centre_m: Vec3<S>,
    /// Motion of each degree of freedom at unit rate.
    pub(crate) axes: Vec<Motion<S>>,
    /// Inertia of each body; filled by [`Self::update_inertia`].
    pub(crate) inertias: Vec<Inertia<S>>,
}

impl<S: Simd> Posture<S> {
    pub(crate) fn new(simd: S, structure: &Structure) -> Self {
        let bodies = structure.nodes.len();
        let mut axes = vec![Motion::zero(simd); structure.dofs()];
        for (axis, unit) in axes.iter_mut().zip([Vector3::x(), Vector3::y(), Vector3::z()]) {
            axis.linear = Vec3::splat(simd, &unit);
        }
        Self {
            rotations: vec![Mat3::identity(simd); bodies],
            origins_m: vec![Vec3::zero(simd); bodies],
            centres_m: vec![Vec3::zero(simd); bodies],
            root_centre_m: Vec3::splat(simd, &structure.nodes[0].centre_m),
            axes,
            inertias: vec![Inertia::zero(simd); bodies],
        }
    }

    /// Computes poses and axes at a position vector with a normalised quaternion.
    #[inline(always)]
    pub(crate) fn update_kinematics(&mut self, structure: &Structure, position: &[Lanes<S>]) {
        let root = rotation_of(&position[3..ROOT_POSITIONS]);
        self.rotations[0] = root;
        self.centres_m[0] = root.times(&self.root_centre_m);
        for (axis, column) in self.axes[3..ROOT_DOFS].iter_mut().zip(root.columns) {
            axis.angular = column;
        }
        for (index, node) in structure.nodes.iter().enumerate().skip(1) {
            let parent = self.rotations[node.parent];
            let mut anchor = self.origins_m[node.parent] + parent.times_constant(&node.parent_anchor_m);
            let mut rotation = match &node.rotation {
                Some(matrix) => parent.times_constant_matrix(matrix),
                None => parent,
            };
            for hinge in node.hinges.clone() {
                if let Some(offset) = &structure.hinges[hinge].offset_m {
                    anchor += rotation.times_constant(offset);
                }
                let axis = rotate(&mut rotation, &structure.hinges[hinge].axis, position[ROOT_POSITIONS + hinge]);
                self.axes[ROOT_DOFS + hinge] = Motion { angular: axis, linear: anchor.cross(&axis) };
            }
            let origin = anchor - rotation.times_constant(&node.anchor_m);
            self.centres_m[index] = origin + rotation.times_constant(&node.centre_m);
            self.origins_m[index] = origin;
            self.rotations[index] = rotation;
        }
    }

    /// Computes the inertias at the present poses.
    #[inline(always)]
    pub(crate) fn update_inertia(&mut self, masses: &[BodyMasses<S>]) {
        for (index, body) in masses.iter().enumerate() {
            self.inertias[index] =
                Inertia::new(body.mass_kg, &self.centres_m[index], &self.rotations[index], &body.inertia_kgm2);
        }
    }

    /// Writes each body's velocity for a velocity vector into `out`.
    #[inline(always)]
    pub(crate) fn velocities(&self, structure: &Structure, velocity: &[Lanes<S>], out: &mut [Motion<S>]) {
        out[0] = self.root_velocity(velocity);
        for (index, node) in structure.nodes.iter().enumerate().skip(1) {
            let mut sum = out[node.parent];
            for hinge in node.hinges.clone() {
                sum = sum.plus(&self.axes[ROOT_DOFS + hinge], velocity[ROOT_DOFS + hinge]);
            }
            out[index] = sum;
        }
    }

    /// Returns the velocity of the root for a velocity vector.
    #[inline(always)]
    pub(crate) fn root_velocity(&self, velocity: &[Lanes<S>]) -> Motion<S> {
        Motion {
            angular: self.rotations[0].times(&Vec3::new(velocity[3], velocity[4], velocity[5])),
            linear: Vec3::new(velocity[0], velocity[1], velocity[2]),
        }
    }
}

/// Turns a rotation about an axis of its own frame; returns that axis in the world.
#[inline(always)]
fn rotate<S: Simd>(rotation: &mut Mat3<S>, axis: &Axis, angle_rad: Lanes<S>) -> Vec3<S> {
    match axis {
        Axis::Aligned(index, sign) => {
            let (sin, cos) = angle_rad.sin_cos();
            let sin = sin * *sign;
            let (first, second) = ((index + 1) % 3, (index + 2) % 3);
            let (one, other) = (rotation.columns[first], rotation.columns[second]);
            rotation.columns[first] = one.mul_add(cos, &(other * sin));
            rotation.columns[second] = other.mul_add(cos, &-(one * sin));
            rotation.columns[*index] * sin.constant(*sign)
        }
        Axis::General(vector) => {
            // Rodrigues' formula, applied to each column of the product.
            let along = rotation.times_constant(vector);
            let (sin, cos) = angle_rad.sin_cos();
            let rest = cos.constant(1.0) - cos;
            let [a, b, c] = rotation.columns;
            let (x, y, z) = (vector.x, vector.y, vector.z);
            // sin × (axis × unit vector), for each column.
            let across = [
                (b * (sin * z)) - (c * (sin * y)),
                (c * (sin * x)) - (a * (sin * z)),
                (a * (sin * y)) - (b * (sin * x)),
            ];
            rotation.columns = [
                along.mul_add(rest * x, &a.mul_add(cos, &across[0])),
                along.mul_add(rest * y, &b.mul_add(cos, &across[1])),
                along.mul_add(rest * z, &c.mul_add(cos, &across[2])),
            ];
            along
        }
    }
}

/// Returns the rotation of a unit quaternion w, x, y, z.
#[inline(always)]
fn rotation_of<S: Simd>(quaternion: &[Lanes<S>]) -> Mat3<S> {
    let (w, x, y, z) = (quaternion[0], quaternion[1], quaternion[2], quaternion[3]);
    let (x2, y2, z2) = (x + x, y + y, z + z);
    let (xx, yy, zz) = (x * x2, y * y2, z * z2);
    let (xy, xz, yz) = (x * y2, x * z2, y * z2);
    let (wx, wy, wz) = (w * x2, w * y2, w * z2);
    let one = w.constant(1.0);
    Mat3 {
        columns: [
            Vec3::new(one - (yy + zz), xy + wz, xz - wy),
            Vec3::new(xy - wz, one - (xx + zz), yz + wx),
            Vec3::new(xz + wy, yz - wx, one - (xx + yy)),
        ],
    }
}

/// Integrates the position vector `from` over `time_s` at a constant velocity vector; writes the result to `to`.
#[inline(always)]
pub(crate) fn integrate<S: Simd>(from: &[Lanes<S>], velocity: &[Lanes<S>], time_s: f64, to: &mut [Lanes<S>]) {
    let time = from[0].constant(time_s);
    for axis in 0..3 {
        to[axis] = velocity[axis].mul_add(time, from[axis]);
    }
    let half = from[0].constant(time_s / 2.0);
    let turn = Vec3::new(velocity[3] * half, velocity[4] * half, velocity[5] * half);
    let (sinc, cos) = turn.dot(&turn).sinc_cos_of_root();
    let turn = turn * sinc;
    let product = quaternion_product(&from[3..ROOT_POSITIONS], &[cos, turn.x, turn.y, turn.z]);
    // Errors of repeated products would accumulate in the norm.
    let [pw, px, py, pz] = product;
    let norm = (pw * pw + px * px + (py * py + pz * pz)).sqrt();
    for (to, part) in to[3..ROOT_POSITIONS].iter_mut().zip(product) {
        *to = part / norm;
    }
    for hinge in ROOT_POSITIONS..from.len() {
        to[hinge] = velocity[hinge - ROOT_POSITIONS + ROOT_DOFS].mul_add(time, from[hinge]);
    }
}

/// Turns a motion since `start` into the position vector where it ends; the root's place stays relative to that of `start`.
#[inline(always)]
pub(crate) fn compose<S: Simd>(start: &[Lanes<S>], moved: &mut [Lanes<S>]) {
    let rotation = quaternion_product(&start[3..ROOT_POSITIONS], &moved[3..ROOT_POSITIONS]);
    moved[3..ROOT_POSITIONS].copy_from_slice(&rotation);
    for (angle, start) in moved.iter_mut().zip(start).skip(ROOT_POSITIONS) {
        *angle += *start;
    }
}

/// Returns the product of two quaternions w, x, y, z.
#[inline(always)]
fn quaternion_product<S: Simd>(one: &[Lanes<S>], other: &[Lanes<S>]) -> [Lanes<S>; 4] {
    let ([w, x, y, z], [a, b, c, d]) = ([one[0], one[1], one[2], one[3]], [other[0], other[1], other[2], other[3]]);
    [
        w * a - x * b - y * c - z * d,
        w * b + x * a + y * d - z * c,
        w * c - x * d + y * a + z * b,
        w * d + x * c - y * b + z * a,
    ]
}
