//! From rigid bodies that a contact solver has disturbed back to joint coordinates.
//!
//! The solver treats bodies as separate and joints as constraints, which it meets only nearly. Of all joint-space
//! changes this takes the one nearest to the bodies' in the sense of kinetic energy:
//! δ = M⁻¹ Σ Jᵢᵀ Mᵢ Δᵢ. That is also the one with the same momentum along every joint coordinate, so what contacts
//! gave is kept exactly, and what joint constraints gave, which does no work on the joints, drops out. M holds rotors and
//! implicit friction too: the solver knows nothing of them, so here is where they resist.

use nalgebra::Vector3;

use super::flight::Flight;
use super::posture::Posture;
use super::spatial::Force;
use super::tree::{ROOT_DOFS, Tree};

/// What happened to one body beyond its flight: change of velocity or small displacement.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Disturbance {
    /// Of the centre of mass (m/s or m).
    pub(crate) linear: Vector3<f64>,
    /// rad/s or rad.
    pub(crate) angular: Vector3<f64>,
}

/// Workspace of projections.
#[derive(Clone, Debug)]
pub(crate) struct Projection {
    loads: Vec<Force>,
}

impl Projection {
    /// Momentum that velocity changes of the bodies add, with the moment about `centre_m`.
    pub(crate) fn momentum(tree: &Tree, posture: &Posture, bodies: &[Disturbance], centre_m: &Vector3<f64>) -> Force {
        let mut sum = Force::default();
        for (index, (node, body)) in tree.nodes.iter().zip(bodies).enumerate() {
            let arm = posture.centres_m[index] - centre_m;
            sum += Force::at(&arm, body.linear * node.mass_kg, posture.spin(index, node, &body.angular));
        }
        sum
    }

    pub(crate) fn new(tree: &Tree) -> Self {
        Self { loads: vec![Force::default(); tree.nodes.len()] }
    }

    /// Writes the change of velocity (or position) coordinates nearest to the bodies' disturbances.
    pub(crate) fn project(&mut self, tree: &Tree, flight: &Flight, bodies: &[Disturbance], change: &mut [f64]) {
        let posture = &flight.middle;
        for (index, (node, body)) in tree.nodes.iter().zip(bodies).enumerate() {
            let spin = posture.spin(index, node, &body.angular);
            self.loads[index] = Force::at(&posture.centres_m[index], body.linear * node.mass_kg, spin);
        }
        for (index, node) in tree.nodes.iter().enumerate().skip(1).rev() {
            let load = self.loads[index];
            for hinge in node.hinges.clone() {
                change[ROOT_DOFS + hinge] = posture.axes[ROOT_DOFS + hinge].dot(&load);
            }
            self.loads[node.parent] += load;
        }
        for (change, axis) in change.iter_mut().zip(&posture.axes).take(ROOT_DOFS) {
            *change = axis.dot(&self.loads[0]);
        }
        flight.matrix.solve(tree, change);
    }
}
