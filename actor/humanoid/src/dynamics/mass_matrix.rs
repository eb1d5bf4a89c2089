//! The joint-space mass matrix: assembled by composite rigid bodies, factored along the tree.
//!
//! Formulas: Featherstone 2008, tables 6.2 (composite rigid bodies) and 6.3, 6.5 (LᵀDL factorisation, which keeps the
//! zeros of branches that do not move each other).

use super::posture::Posture;
use super::spatial::Inertia;
use super::tree::{ROOT_DOFS, Tree};

/// A symmetric matrix over the degrees of freedom with the zeros of a tree.
///
/// Row k holds what couples k to its path, from the first degree of freedom down to k itself. The path of a degree of
/// freedom on it is the beginning of that path, so rows are aligned: inner loops run over slices without indices.
#[derive(Clone, Debug)]
pub(crate) struct MassMatrix {
    entries: Vec<f64>,
    composites: Vec<Inertia>,
}

impl MassMatrix {
    pub(crate) fn new(tree: &Tree) -> Self {
        Self { entries: vec![0.0; tree.path_entries()], composites: vec![Inertia::default(); tree.nodes.len()] }
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
        let row = &mut self.entries[tree.row(dof)];
        // The first three degrees of freedom are translations along the world's axes: they feel the force itself.
        for (entry, part) in row.iter_mut().zip(force.force.iter()) {
            *entry = *part;
        }
        for (entry, other) in row.iter_mut().zip(tree.path(dof)).skip(3) {
            *entry = posture.axes[*other as usize].dot(&force);
        }
    }

    /// Adds to the diagonal, one number per degree of freedom.
    pub(crate) fn add_diagonal(&mut self, tree: &Tree, extra: &[f64]) {
        for (dof, extra) in extra.iter().enumerate() {
            self.entries[tree.row(dof).end - 1] += extra;
        }
    }

    /// Factors in place; from then on [`Self::solve`] works and the entries are those of the factors, with the inverse
    /// of D on the diagonal.
    pub(crate) fn factor(&mut self, tree: &Tree) {
        for k in (0..tree.dofs()).rev() {
            let place = tree.row(k);
            // Rows of the path of k lie before it.
            let (before, from) = self.entries.split_at_mut(place.start);
            let Some((own, row)) = from[..place.len()].split_last_mut() else { continue };
            let pivot = 1.0 / *own;
            *own = pivot;
            let (root, hinges) = row.split_at_mut(row.len().min(ROOT_DOFS));
            let path = tree.path(k);
            for position in (0..hinges.len()).rev() {
                let factor = hinges[position] * pivot;
                let target = &mut before[tree.row(path[ROOT_DOFS + position] as usize)];
                for (entry, coupled) in target.iter_mut().zip(root.iter().chain(&hinges[..=position])) {
                    *entry -= factor * coupled;
                }
                hinges[position] = factor;
            }
            // The root's degrees of freedom are on every path, and their rows are the first ones.
            eliminate(before, root, pivot);
        }
    }

    /// Replaces a right-hand side by the solution; the matrix must have been factored.
    pub(crate) fn solve(&self, tree: &Tree, x: &mut [f64]) {
        for i in (0..tree.dofs()).rev() {
            let value = x[i];
            if value == 0.0 {
                continue;
            }
            let row = &self.entries[tree.row(i)];
            let (root, hinges) = row[..row.len() - 1].split_at((row.len() - 1).min(ROOT_DOFS));
            for (x, entry) in x.iter_mut().zip(root) {
                *x -= entry * value;
            }
            for (entry, j) in hinges.iter().zip(tree.path(i).iter().skip(ROOT_DOFS)) {
                x[*j as usize] -= entry * value;
            }
        }
        for i in 0..tree.dofs() {
            let row = &self.entries[tree.row(i)];
            let Some((pivot, row)) = row.split_last() else { continue };
            let (root, hinges) = row.split_at(row.len().min(ROOT_DOFS));
            let mut known = 0.0;
            for (entry, x) in root.iter().zip(&*x) {
                known += entry * x;
            }
            for (entry, j) in hinges.iter().zip(tree.path(i).iter().skip(ROOT_DOFS)) {
                known += entry * x[*j as usize];
            }
            x[i] = x[i] * pivot - known;
        }
    }
}

/// Takes a row out of the rows of the root's degrees of freedom and divides it by its pivot.
fn eliminate(rows: &mut [f64], row: &mut [f64], pivot: f64) {
    for position in (0..row.len()).rev() {
        let factor = row[position] * pivot;
        let start = position * (position + 1) / 2;
        for (entry, coupled) in rows[start..=start + position].iter_mut().zip(&row[..=position]) {
            *entry -= factor * coupled;
        }
        row[position] = factor;
    }
}
