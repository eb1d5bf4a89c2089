//! What all worlds of a model share: bodies, hinges, and degrees of freedom with their paths to the root.

use std::collections::BTreeSet;
use std::ops::Range;

use nalgebra::{Matrix3, Point3, Vector3};

use crate::model::{Hinge, Model, Softness, Solver};

/// Degrees of freedom of the floating root: three translations (world axes), three rotations (root's axes).
pub(crate) const ROOT_DOFS: usize = 6;
/// Numbers of the position vector that belong to the root: position and quaternion.
pub(crate) const ROOT_POSITIONS: usize = 7;

/// Floating tree of rigid bodies, joined by hinges.
#[derive(Clone, Debug)]
pub(crate) struct Structure {
    /// Bodies, parents first; the first is the root.
    pub(crate) nodes: Vec<Node>,
    /// One per hinge, in position order.
    pub(crate) hinges: Vec<HingeNode>,
    /// Viscous friction (N·s/m and N·m·s/rad) and additional inertia (kg and kg·m²) of the root.
    pub(crate) root_damping: f64,
    pub(crate) root_armature: f64,
    /// Hinges, then tendons, then the root, as far as they may have limits or dry friction, then couplings of hinges.
    pub(crate) coordinates: Vec<Coordinate>,
    /// Points that stay together.
    pub(crate) connections: Vec<ConnectionNode>,
    /// Method that solves for the forces of constraints.
    pub(crate) solver: Solver,
    /// Body of each link.
    pub(crate) link_bodies: Vec<usize>,
    /// Mean acceleration of each link per force on it, see [`super::responses`] (1/kg).
    pub(crate) link_responses: Vec<f64>,
    /// Acceleration of each hinge per torque, see [`super::responses`] (1/(kg·m²)).
    pub(crate) hinge_responses: Vec<f64>,
    /// Last degree of freedom that moves each body.
    innermost_dofs: Vec<u32>,
    /// Concatenated paths of all degrees of freedom.
    paths: Vec<u32>,
    /// Start of each degree of freedom's path in `paths`, and the end of the last one.
    path_starts: Vec<usize>,
}

/// Rigid body.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    /// Index of the parent; the root is its own parent.
    pub(crate) parent: usize,
    /// Orientation in the parent with all hinges at zero; `None` where it is the parent's.
    pub(crate) rotation: Option<Matrix3<f64>>,
    /// Point on the first hinge's axis, in the parent's frame (m).
    pub(crate) parent_anchor_m: Vector3<f64>,
    /// Point on the last hinge's axis, in this body's frame (m).
    pub(crate) anchor_m: Vector3<f64>,
    /// Hinges that join it to its parent, parent's side first.
    pub(crate) hinges: Range<usize>,
    /// Centre of mass in this body's frame (m).
    pub(crate) centre_m: Vector3<f64>,
    /// Share of its weight that is held up.
    pub(crate) gravity_compensation: f64,
}

/// Hinge.
#[derive(Clone, Debug)]
pub(crate) struct HingeNode {
    pub(crate) axis: Axis,
    /// From the point on the axis of the body's hinge before to that on this axis, in the body's frame (m); `None` if
    /// both are one point, or this is the body's first hinge.
    pub(crate) offset_m: Option<Vector3<f64>>,
    pub(crate) stiffness_nmprad: f64,
    /// Of the square and the cube of the deflection.
    pub(crate) stiffness_powers: [f64; 2],
    pub(crate) rest_rad: f64,
    /// Whether viscous friction has other powers than the first.
    pub(crate) has_damping_powers: bool,
}

/// Sum of degrees of freedom with weights that may have limits and dry friction: a hinge, a tendon, or a degree of
/// freedom of the root.
#[derive(Clone, Debug)]
pub(crate) struct Coordinate {
    /// Degrees of freedom with weights.
    pub(crate) terms: Vec<(usize, f64)>,
    /// The paths of all terms, in ascending order.
    pub(crate) dofs: Vec<u32>,
    /// Hinge whose servo may reach the limit of its torque.
    pub(crate) hinge: Option<usize>,
    /// Whether it must equal `min`.
    pub(crate) is_fixed: bool,
    /// Range (rad); infinite without limits.
    pub(crate) min: f64,
    pub(crate) max: f64,
    pub(crate) limit_margin: f64,
    pub(crate) limit_softness: Softness,
    /// Greatest force of dry friction (N·m).
    pub(crate) friction_loss: f64,
    pub(crate) friction_softness: Softness,
    /// Acceleration per force, see [`super::responses`].
    pub(crate) response: f64,
}

/// Point of a body that stays at a point of another.
#[derive(Clone, Debug)]
pub(crate) struct ConnectionNode {
    pub(crate) bodies: [usize; 2],
    /// Points in the bodies' frames (m).
    pub(crate) points_m: [Vector3<f64>; 2],
    /// Degrees of freedom that move either body, in ascending order.
    pub(crate) dofs: Vec<u32>,
    pub(crate) softness: Softness,
    /// Acceleration per force, see [`super::responses`] (1/kg).
    pub(crate) response: f64,
}

/// Axis of a hinge in the frame of its body.
#[derive(Clone, Debug)]
pub(crate) enum Axis {
    /// Along a coordinate axis (0, 1, 2), with its sign. Such rotations change two columns only.
    Aligned(usize, f64),
    /// Any unit vector.
    General(Vector3<f64>),
}

impl Axis {
    fn new(vector: &Vector3<f64>) -> Self {
        match (0..3).find(|index| vector[*index].abs() == 1.0) {
            Some(index) => Self::Aligned(index, vector[index]),
            None => Self::General(*vector),
        }
    }
}

/// Returns [`HingeNode::offset_m`].
fn offset_from_hinge_before(model: &Model, hinge: usize) -> Option<Vector3<f64>> {
    if model.bodies.iter().any(|body| body.hinges.start == hinge) {
        return None;
    }
    let offset = model.hinges[hinge].anchor_m - model.hinges[hinge.checked_sub(1)?].anchor_m;
    (offset != Vector3::zeros()).then_some(offset)
}

impl Structure {
    /// Returns bodies and paths, without what [`super::responses`] adds.
    pub(crate) fn without_responses(model: &Model) -> Self {
        let nodes: Vec<Node> = model
            .bodies
            .iter()
            .map(|body| {
                let rotation = body.pose.rotation.to_rotation_matrix().into_inner();
                let hinges = &model.hinges[body.hinges.clone()];
                let anchor = |hinge: Option<&Hinge>| hinge.map_or(Point3::origin(), |hinge| hinge.anchor_m);
                Node {
                    parent: body.parent.unwrap_or(0),
                    rotation: (rotation != Matrix3::identity()).then_some(rotation),
                    parent_anchor_m: (body.pose * anchor(hinges.first())).coords,
                    anchor_m: anchor(hinges.last()).coords,
                    hinges: body.hinges.clone(),
                    centre_m: body.centre_of_mass_m.coords,
                    gravity_compensation: body.gravity_compensation,
                }
            })
            .collect();
        let hinges = model
            .hinges
            .iter()
            .enumerate()
            .map(|(index, hinge)| HingeNode {
                axis: Axis::new(&hinge.axis),
                offset_m: offset_from_hinge_before(model, index),
                stiffness_nmprad: hinge.stiffness_nmprad,
                stiffness_powers: hinge.stiffness_powers,
                rest_rad: hinge.rest_rad,
                has_damping_powers: hinge.damping_powers != [0.0; 2],
            })
            .collect();
        let (paths, path_starts, innermost_dofs) = build_paths(&nodes, model.hinges.len());
        let link_bodies = model.links.iter().map(|link| link.body).collect();
        Self {
            nodes,
            hinges,
            root_damping: model.root.damping,
            root_armature: model.root.armature,
            coordinates: Vec::new(),
            connections: Vec::new(),
            solver: model.solver,
            link_bodies,
            link_responses: Vec::new(),
            hinge_responses: Vec::new(),
            innermost_dofs,
            paths,
            path_starts,
        }
    }

    /// Returns the degrees of freedom that move a body, root first.
    #[inline(always)]
    pub(crate) fn path_of_body(&self, body: usize) -> &[u32] {
        self.path(self.innermost_dofs[body] as usize)
    }

    /// Returns how many degrees of freedom move both bodies.
    #[inline(always)]
    pub(crate) fn common_dofs(&self, first: usize, second: usize) -> usize {
        let pairs = self.path_of_body(first).iter().zip(self.path_of_body(second));
        let mut common = 0;
        for (one, other) in pairs {
            if one != other {
                break;
            }
            common += 1;
        }
        common
    }

    /// Returns the degrees of freedom that move any of these bodies, in ascending order.
    pub(crate) fn dofs_of_bodies(&self, bodies: impl Iterator<Item = usize>) -> Vec<u32> {
        ascending(bodies.flat_map(|body| self.path_of_body(body)))
    }

    /// Returns the degrees of freedom from the root to this one, inclusive.
    #[inline(always)]
    pub(crate) fn path(&self, dof: usize) -> &[u32] {
        &self.paths[self.row(dof)]
    }

    /// Returns the range of [`Self::path`] in the concatenated paths.
    #[inline(always)]
    pub(crate) fn row(&self, dof: usize) -> Range<usize> {
        self.path_starts[dof]..self.path_starts[dof + 1]
    }

    /// Returns the sum of all paths' lengths.
    pub(crate) fn path_entries(&self) -> usize {
        self.paths.len()
    }

    /// Returns the length of the velocity vector.
    #[inline(always)]
    pub(crate) fn dofs(&self) -> usize {
        self.path_starts.len() - 1
    }

    /// Returns the length of the position vector.
    pub(crate) fn positions(&self) -> usize {
        ROOT_POSITIONS + self.hinges.len()
    }
}

/// Returns each of these degrees of freedom once, in ascending order.
pub(super) fn ascending<'a>(dofs: impl Iterator<Item = &'a u32>) -> Vec<u32> {
    dofs.copied().collect::<BTreeSet<_>>().into_iter().collect()
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
