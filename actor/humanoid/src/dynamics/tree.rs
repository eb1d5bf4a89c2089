//! Kinematic tree: bodies with inertia, and degrees of freedom with their paths to the root.

use nalgebra::{Matrix3, Vector3};

use crate::model::Model;

/// Degrees of freedom of the floating root: three translations (world axes), three rotations (root's axes).
pub(crate) const ROOT_DOFS: usize = 6;
/// Numbers of the position vector that belong to the root: position and quaternion.
pub(crate) const ROOT_POSITIONS: usize = 7;

/// Floating tree of rigid bodies, joined by hinges.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    /// Bodies, parents first; the first is the root.
    pub(crate) nodes: Vec<Node>,
    /// One per hinge, in position order.
    pub(crate) hinges: Vec<HingeNode>,
    /// Last degree of freedom that moves each body.
    innermost_dofs: Vec<u32>,
    /// Concatenated paths of all degrees of freedom.
    paths: Vec<u32>,
    /// Start of each degree of freedom's path in `paths`, and the end of the last one.
    path_starts: Vec<usize>,
    /// Acceleration of gravity (m/s²).
    pub(crate) gravity_mps2: Vector3<f64>,
}

/// Rigid body.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    /// Index of the parent; the root is its own parent.
    pub(crate) parent: usize,
    /// Orientation in the parent with all hinges at zero.
    pub(crate) rotation: Matrix3<f64>,
    /// Point on all hinges' axes, in the parent's frame (m).
    pub(crate) parent_anchor_m: Vector3<f64>,
    /// Point on all hinges' axes, in this body's frame (m).
    pub(crate) anchor_m: Vector3<f64>,
    /// Hinges that join it to its parent, parent's side first.
    pub(crate) hinges: std::ops::Range<usize>,
    pub(crate) mass_kg: f64,
    /// Centre of mass in this body's frame (m).
    pub(crate) centre_m: Vector3<f64>,
    /// Inertia about the centre, in this body's axes (kg·m²).
    pub(crate) inertia_kgm2: Matrix3<f64>,
}

/// Hinge.
#[derive(Clone, Debug)]
pub(crate) struct HingeNode {
    /// Unit vector in the frame of its body.
    pub(crate) axis: Vector3<f64>,
    pub(crate) armature_kgm2: f64,
    pub(crate) damping_nmsprad: f64,
    pub(crate) stiffness_nmprad: f64,
    pub(crate) rest_rad: f64,
    pub(crate) min_rad: f64,
    pub(crate) max_rad: f64,
}

impl Tree {
    pub(crate) fn new(model: &Model) -> Self {
        let nodes: Vec<Node> = model
            .bodies
            .iter()
            .map(|body| Node {
                parent: body.parent.unwrap_or(0),
                rotation: body.pose.rotation.to_rotation_matrix().into_inner(),
                parent_anchor_m: (body.pose * body.anchor_m).coords,
                anchor_m: body.anchor_m.coords,
                hinges: body.hinges.clone(),
                mass_kg: body.mass_kg,
                centre_m: body.centre_of_mass_m.coords,
                inertia_kgm2: body.inertia_kgm2,
            })
            .collect();
        let hinges = model
            .hinges
            .iter()
            .map(|hinge| HingeNode {
                axis: hinge.axis.into_inner(),
                armature_kgm2: hinge.armature_kgm2,
                damping_nmsprad: hinge.damping_nmsprad,
                stiffness_nmprad: hinge.stiffness_nmprad,
                rest_rad: hinge.rest_rad,
                min_rad: hinge.min_rad,
                max_rad: hinge.max_rad,
            })
            .collect();
        let (paths, path_starts, innermost_dofs) = build_paths(&nodes, model.hinges.len());
        Self { nodes, hinges, innermost_dofs, paths, path_starts, gravity_mps2: model.gravity_mps2 }
    }

    /// Copies masses, friction, rotor inertias and gravity of a model with the same structure; allocates nothing.
    pub(crate) fn apply_variation(&mut self, model: &Model) {
        for (node, body) in self.nodes.iter_mut().zip(&model.bodies) {
            node.mass_kg = body.mass_kg;
            node.inertia_kgm2 = body.inertia_kgm2;
        }
        for (node, hinge) in self.hinges.iter_mut().zip(&model.hinges) {
            node.damping_nmsprad = hinge.damping_nmsprad;
            node.armature_kgm2 = hinge.armature_kgm2;
        }
        self.gravity_mps2 = model.gravity_mps2;
    }

    /// Returns the degrees of freedom that move a body, root first.
    pub(crate) fn path_of_body(&self, body: usize) -> &[u32] {
        self.path(self.innermost_dofs[body] as usize)
    }

    /// Returns the degrees of freedom from the root to this one, inclusive.
    #[inline]
    pub(crate) fn path(&self, dof: usize) -> &[u32] {
        &self.paths[self.row(dof)]
    }

    /// Returns the range of [`Self::path`] in the concatenated paths.
    #[inline]
    pub(crate) fn row(&self, dof: usize) -> std::ops::Range<usize> {
        self.path_starts[dof]..self.path_starts[dof + 1]
    }

    /// Returns the sum of all paths' lengths.
    pub(crate) fn path_entries(&self) -> usize {
        self.paths.len()
    }

    /// Returns the length of the velocity vector.
    pub(crate) fn dofs(&self) -> usize {
        self.path_starts.len() - 1
    }

    /// Returns the mass of all bodies (kg).
    pub(crate) fn mass_kg(&self) -> f64 {
        self.nodes.iter().map(|node| node.mass_kg).sum()
    }
}

/// Returns the paths of all degrees of freedom, the start of each, and the innermost degree of freedom of each body.
fn build_paths(nodes: &[Node], hinges: usize) -> (Vec<u32>, Vec<usize>, Vec<u32>) {
    let root: Vec<u32> = (0..ROOT_DOFS as u32).collect();
    let mut paths: Vec<Vec<u32>> = (0..ROOT_DOFS).map(|dof| root[..=dof].to_vec()).collect();
    paths.resize(ROOT_DOFS + hinges, Vec::new());
    let mut innermost = vec![ROOT_DOFS as u32 - 1; nodes.len()];
    for (index, node) in nodes.iter().enumerate().skip(1) {
        let mut above = innermost[node.parent];
        for hinge in node.hinges.clone() {
            let dof = ROOT_DOFS + hinge;
            paths[dof] = paths[above as usize].clone();
            paths[dof].push(dof as u32);
            above = dof as u32;
        }
        innermost[index] = above;
    }
    let mut starts = vec![0];
    for path in &paths {
        starts.push(starts[starts.len() - 1] + path.len());
    }
    (paths.concat(), starts, innermost)
}
