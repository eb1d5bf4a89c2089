//! The articulated body as the dynamics see it: nodes with inertia, degrees of freedom with parents.

use nalgebra::{Matrix3, UnitQuaternion, Vector3};

use crate::model::Model;

/// Degrees of freedom of the floating root: three translations (world axes), three rotations (root's axes).
pub(crate) const ROOT_DOFS: usize = 6;
/// Numbers of the position vector that belong to the root: place and quaternion.
pub(crate) const ROOT_POSITIONS: usize = 7;

/// A floating tree of rigid bodies, joined by hinges.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    /// Bodies, parents first; the first is the root.
    pub(crate) nodes: Vec<Node>,
    /// One per hinge, in position order.
    pub(crate) hinges: Vec<HingeNode>,
    /// For each body the degree of freedom nearest to it.
    innermost_dofs: Vec<u32>,
    /// For each degree of freedom the next one towards the root; [`NO_DOF`] for the first.
    pub(crate) dof_parents: Vec<u32>,
    /// Acceleration of gravity (m/s²).
    pub(crate) gravity_mps2: Vector3<f64>,
}

/// Stands for the missing parent of the first degree of freedom.
pub(crate) const NO_DOF: u32 = u32::MAX;

/// One rigid body.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    /// Index of the parent; the root is its own.
    pub(crate) parent: usize,
    /// Orientation in the parent with all hinges at zero.
    pub(crate) rotation: Matrix3<f64>,
    /// Where the hinges sit, in the parent's frame (m).
    pub(crate) parent_anchor_m: Vector3<f64>,
    /// Where the hinges sit, in this body's frame (m).
    pub(crate) anchor_m: Vector3<f64>,
    /// First hinge and one past the last.
    pub(crate) hinges: std::ops::Range<usize>,
    pub(crate) mass_kg: f64,
    /// In this body's frame (m).
    pub(crate) centre_m: Vector3<f64>,
    /// About the centre, in this body's axes (kg·m²).
    pub(crate) inertia_kgm2: Matrix3<f64>,
}

/// One hinge.
#[derive(Clone, Debug)]
pub(crate) struct HingeNode {
    /// In the frame of its body (unit vector).
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
                rotation: matrix(&body.pose.rotation),
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
        let (dof_parents, innermost_dofs) = connect(&nodes, model.hinges.len());
        Self { nodes, hinges, innermost_dofs, dof_parents, gravity_mps2: model.gravity_mps2 }
    }

    /// Takes over masses, friction, rotors and gravity of a model of the same build; allocates nothing.
    pub(crate) fn vary(&mut self, model: &Model) {
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

    /// The degree of freedom nearest to a body: with those towards the root, all that move it.
    pub(crate) fn innermost_dof(&self, body: usize) -> u32 {
        self.innermost_dofs[body]
    }

    /// Length of the velocity vector.
    pub(crate) fn dofs(&self) -> usize {
        self.dof_parents.len()
    }

    /// Mass of all bodies (kg).
    pub(crate) fn mass_kg(&self) -> f64 {
        self.nodes.iter().map(|node| node.mass_kg).sum()
    }
}

fn connect(nodes: &[Node], hinges: usize) -> (Vec<u32>, Vec<u32>) {
    let mut parents = vec![NO_DOF; ROOT_DOFS + hinges];
    for (dof, parent) in parents.iter_mut().enumerate().take(ROOT_DOFS).skip(1) {
        *parent = dof as u32 - 1;
    }
    let mut last = vec![ROOT_DOFS as u32 - 1; nodes.len()];
    for (index, node) in nodes.iter().enumerate().skip(1) {
        let mut above = last[node.parent];
        for hinge in node.hinges.clone() {
            let dof = ROOT_DOFS + hinge;
            parents[dof] = above;
            above = dof as u32;
        }
        last[index] = above;
    }
    (parents, last)
}

pub(crate) fn matrix(rotation: &UnitQuaternion<f64>) -> Matrix3<f64> {
    rotation.to_rotation_matrix().into_inner()
}
