//! The joint-space mass matrix: assembled by composite rigid bodies, factored along the tree.
//!
//! Formulas: Featherstone 2008, tables 6.2 (composite rigid bodies) and 6.3, 6.5 (LᵀDL factorisation, which keeps the
//! zeros of branches that do not move each other).

use super::posture::Posture;
use super::spatial::Inertia;
use super::tree::{NO_DOF, ROOT_DOFS, Tree};

/// A symmetric matrix over the degrees of freedom with the zeros of a tree; lower triangle, row by row.
#[derive(Clone, Debug)]
pub(crate) struct MassMatrix {
    dofs: usize,
    entries: Vec<f64>,
    composites: Vec<Inertia>,
}

impl MassMatrix {
    pub(crate) fn new(tree: &Tree) -> Self {
        let dofs = tree.dofs();
        Self { dofs, entries: vec![0.0; dofs * dofs], composites: vec![Inertia::default(); tree.nodes.len()] }
    }

    /// Assembles the matrix of the bodies alone, without rotors, for a posture that has been weighed.
    pub(crate) fn assemble(&mut self, tree: &Tree, posture: &Posture) {
        self.composites.copy_from_slice(&posture.inertias);
        for (index, node) in tree.nodes.iter().enumerate().skip(1).rev() {
            let composite = self.composites[index];
            self.composites[node.parent] += composite;
            for hinge in node.hinges.clone() {
                self.fill_row(tree, posture, ROOT_DOFS + hinge, &composite);
            }
        }
        let whole = self.composites[0];
        for dof in 0..ROOT_DOFS {
            self.fill_row(tree, posture, dof, &whole);
        }
    }

    fn fill_row(&mut self, tree: &Tree, posture: &Posture, dof: usize, composite: &Inertia) {
        let force = composite.times(&posture.axes[dof]);
        let mut other = dof as u32;
        while other != NO_DOF {
            self.entries[dof * self.dofs + other as usize] = posture.axes[other as usize].dot(&force);
            other = tree.dof_parents[other as usize];
        }
    }

    /// Adds to the diagonal, one number per degree of freedom.
    pub(crate) fn add_diagonal(&mut self, extra: &[f64]) {
        for (dof, extra) in extra.iter().enumerate() {
            self.entries[dof * self.dofs + dof] += extra;
        }
    }

    /// Factors in place; from then on [`Self::solve`] works and the entries are those of the factors.
    pub(crate) fn factor(&mut self, tree: &Tree) {
        let n = self.dofs;
        for k in (0..n).rev() {
            let pivot = 1.0 / self.entries[k * n + k];
            let mut i = tree.dof_parents[k];
            while i != NO_DOF {
                let row = i as usize;
                let factor = self.entries[k * n + row] * pivot;
                let mut j = i;
                while j != NO_DOF {
                    self.entries[row * n + j as usize] -= factor * self.entries[k * n + j as usize];
                    j = tree.dof_parents[j as usize];
                }
                self.entries[k * n + row] = factor;
                i = tree.dof_parents[row];
            }
            self.entries[k * n + k] = pivot;
        }
    }

    /// Replaces a right-hand side by the solution; the matrix must have been factored.
    pub(crate) fn solve(&self, tree: &Tree, x: &mut [f64]) {
        let n = self.dofs;
        for i in (0..n).rev() {
            let value = x[i];
            let mut j = tree.dof_parents[i];
            while j != NO_DOF {
                x[j as usize] -= self.entries[i * n + j as usize] * value;
                j = tree.dof_parents[j as usize];
            }
        }
        for i in 0..n {
            let mut value = x[i] * self.entries[i * n + i];
            let mut j = tree.dof_parents[i];
            while j != NO_DOF {
                value -= self.entries[i * n + j as usize] * x[j as usize];
                j = tree.dof_parents[j as usize];
            }
            x[i] = value;
        }
    }
}
