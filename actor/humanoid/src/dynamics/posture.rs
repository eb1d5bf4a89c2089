//! Forward kinematics: poses and velocities of all bodies for one position and velocity vector.
//!
//! Points are relative to O, the root's origin, so that they stay precise far from the world's origin.

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

use super::spatial::{Inertia, Motion};
use super::tree::{ROOT_DOFS, ROOT_POSITIONS, Tree};

/// Poses, joint axes and inertias of a tree at one position.
#[derive(Clone, Debug)]
pub(crate) struct Posture {
    /// Orientation of each body in the world.
    pub(crate) rotations: Vec<Matrix3<f64>>,
    /// Origin of each body (m, relative to O).
    pub(crate) origins_m: Vec<Vector3<f64>>,
    /// Centre of mass of each body (m, relative to O).
    pub(crate) centres_m: Vec<Vector3<f64>>,
    /// Motion of each degree of freedom at unit rate.
    pub(crate) axes: Vec<Motion>,
    /// Inertia of each body; filled by [`Self::update_inertia`].
    pub(crate) inertias: Vec<Inertia>,
}

impl Posture {
    pub(crate) fn new(tree: &Tree) -> Self {
        let bodies = tree.nodes.len();
        Self {
            rotations: vec![Matrix3::identity(); bodies],
            origins_m: vec![Vector3::zeros(); bodies],
            centres_m: vec![Vector3::zeros(); bodies],
            axes: vec![Motion::default(); tree.dofs()],
            inertias: vec![Inertia::default(); bodies],
        }
    }

    /// Computes poses and axes at a position vector. The root's quaternion need not be normalised.
    pub(crate) fn update_kinematics(&mut self, tree: &Tree, position: &[f64]) {
        let root = root_rotation(position).to_rotation_matrix().into_inner();
        self.rotations[0] = root;
        self.origins_m[0] = Vector3::zeros();
        self.centres_m[0] = root * tree.nodes[0].centre_m;
        for axis in 0..3 {
            self.axes[axis] = Motion::new(Vector3::zeros(), Vector3::ith(axis, 1.0));
            self.axes[3 + axis] = Motion::new(root.column(axis).into(), Vector3::zeros());
        }
        for (index, node) in tree.nodes.iter().enumerate().skip(1) {
            let parent = self.rotations[node.parent];
            let anchor = self.origins_m[node.parent] + parent * node.parent_anchor_m;
            let mut rotation = parent * node.rotation;
            for hinge in node.hinges.clone() {
                let local = &tree.hinges[hinge].axis;
                let axis = rotation * local;
                self.axes[ROOT_DOFS + hinge] = Motion::new(axis, anchor.cross(&axis));
                rotation *= axis_rotation(local, position[ROOT_POSITIONS + hinge]);
            }
            let origin = anchor - rotation * node.anchor_m;
            self.centres_m[index] = origin + rotation * node.centre_m;
            self.origins_m[index] = origin;
            self.rotations[index] = rotation;
        }
    }

    /// Computes the inertias at the present poses.
    pub(crate) fn update_inertia(&mut self, tree: &Tree) {
        for (index, node) in tree.nodes.iter().enumerate() {
            let rotation = &self.rotations[index];
            let about_centre = rotation * node.inertia_kgm2 * rotation.transpose();
            self.inertias[index] = Inertia::new(node.mass_kg, &self.centres_m[index], &about_centre);
        }
    }

    /// Writes each body's velocity for a velocity vector into `out`.
    pub(crate) fn velocities(&self, tree: &Tree, velocity: &[f64], out: &mut [Motion]) {
        out[0] = self.sum_of_axes(0..ROOT_DOFS, velocity);
        for (index, node) in tree.nodes.iter().enumerate().skip(1) {
            let dofs = ROOT_DOFS + node.hinges.start..ROOT_DOFS + node.hinges.end;
            out[index] = out[node.parent];
            out[index] += self.sum_of_axes(dofs, velocity);
        }
    }

    fn sum_of_axes(&self, dofs: std::ops::Range<usize>, velocity: &[f64]) -> Motion {
        let mut sum = Motion::default();
        for dof in dofs {
            sum += self.axes[dof] * velocity[dof];
        }
        sum
    }
}

/// Returns the root's normalised orientation in a position vector.
pub(crate) fn root_rotation(position: &[f64]) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Quaternion::new(position[3], position[4], position[5], position[6]))
}

/// Integrates the position vector `from` over `time_s` at a constant velocity vector; writes the result to `to`.
pub(crate) fn integrate(from: &[f64], velocity: &[f64], time_s: f64, to: &mut [f64]) {
    for axis in 0..3 {
        to[axis] = from[axis] + time_s * velocity[axis];
    }
    let rotation_vector = Vector3::new(velocity[3], velocity[4], velocity[5]) * time_s;
    let rotation = root_rotation(from) * UnitQuaternion::from_scaled_axis(rotation_vector);
    // Errors of repeated products would accumulate in the norm.
    let quaternion = rotation.quaternion() / rotation.quaternion().norm();
    to[3..ROOT_POSITIONS].copy_from_slice(&[quaternion.w, quaternion.i, quaternion.j, quaternion.k]);
    for (hinge, angle) in to[ROOT_POSITIONS..].iter_mut().enumerate() {
        *angle = from[ROOT_POSITIONS + hinge] + time_s * velocity[ROOT_DOFS + hinge];
    }
}

/// Returns the rotation about a unit axis (Rodrigues' formula).
fn axis_rotation(axis: &Vector3<f64>, angle_rad: f64) -> Matrix3<f64> {
    let (sin, cos) = angle_rad.sin_cos();
    let rest = 1.0 - cos;
    let (x, y, z) = (axis.x, axis.y, axis.z);
    Matrix3::new(
        cos + x * x * rest,
        x * y * rest - z * sin,
        x * z * rest + y * sin,
        y * x * rest + z * sin,
        cos + y * y * rest,
        y * z * rest - x * sin,
        z * x * rest - y * sin,
        z * y * rest + x * sin,
        cos + z * z * rest,
    )
}
