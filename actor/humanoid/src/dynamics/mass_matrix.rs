//! Joint-space mass matrix: assembled from composite rigid bodies, factored along the tree.
//!
//! Formulas: Featherstone 2008, tables 6.2 (composite rigid bodies) and 6.3, 6.5 (LᵀDL factorisation, which keeps the
//! zeros of independent branches).
//!
//! *Whitened* velocities are u = D^½ L v; the kinetic energy is |u|²/2. An impulse along a direction with Jacobian J changes
//! u by the whitened row D^−½ L^−ᵀ Jᵀ. The product of that row with u is the rate along the direction. So one row serves both
//! purposes and needs only half of a solution.

use super::posture::Posture;
use super::spatial::Inertia;
use super::tree::{ROOT_DOFS, Tree};

/// Symmetric matrix over the degrees of freedom with the zeros of a tree.
///
/// Row k holds the entries of k and its path, from the root to k. The path of each of these degrees of freedom is a prefix of
/// k's path, so inner loops run over aligned slices without indices.
#[derive(Clone, Debug)]
pub(crate) struct MassMatrix {
    entries: Vec<f64>,
    /// D^−½, after [`Self::factor`].
    pivot_roots: Vec<f64>,
    composites: Vec<Inertia>,
}

impl MassMatrix {
    pub(crate) fn new(tree: &Tree) -> Self {
        Self {
            entries: vec![0.0; tree.path_entries()],
            pivot_roots: vec![0.0; tree.dofs()],
            composites: vec![Inertia::default(); tree.nodes.len()],
        }
    }

    /// Assembles the matrix of the bodies, without rotors, for a posture with inertia.
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
        // The first three degrees of freedom are translations along the world's axes: their entries are the force itself.
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

    /// Factors in place: the entries become those of L, with the inverse of D on the diagonal.
    pub(crate) fn factor(&mut self, tree: &Tree) {
        for k in (0..tree.dofs()).rev() {
            let range = tree.row(k);
            // The rows of k's path precede row k.
            let (before, from) = self.entries.split_at_mut(range.start);
            let Some((own, row)) = from[..range.len()].split_last_mut() else { continue };
            let pivot = 1.0 / *own;
            *own = pivot;
            self.pivot_roots[k] = pivot.sqrt();
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
            // The root's degrees of freedom are on every path, and their rows come first.
            eliminate_root(before, root, pivot);
        }
    }

    /// Replaces a right-hand side by the solution; requires [`Self::factor`].
    pub(crate) fn solve(&self, tree: &Tree, x: &mut [f64]) {
        self.solve_lower_transposed(tree, x);
        self.solve_lower(tree, x, |dof, value| {
            let pivot = self.pivot_roots[dof];
            value * pivot * pivot
        });
    }

    /// Replaces velocities by whitened ones; requires [`Self::factor`].
    pub(super) fn whiten(&self, tree: &Tree, velocity: &mut [f64]) {
        for i in (0..tree.dofs()).rev() {
            velocity[i] = (velocity[i] + self.off_diagonal_product(tree, i, velocity)) / self.pivot_roots[i];
        }
    }

    /// Inverts [`Self::whiten`].
    pub(super) fn unwhiten(&self, tree: &Tree, velocity: &mut [f64]) {
        self.solve_lower(tree, velocity, |dof, value| value * self.pivot_roots[dof]);
    }

    /// Replaces the Jacobian of a direction by its whitened row; requires [`Self::factor`].
    pub(super) fn whiten_row(&self, tree: &Tree, row: &mut [f64]) {
        self.solve_lower_transposed(tree, row);
        for (entry, root) in row.iter_mut().zip(&self.pivot_roots) {
            *entry *= root;
        }
    }

    /// Multiplies by the inverse of Lᵀ.
    fn solve_lower_transposed(&self, tree: &Tree, x: &mut [f64]) {
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
    }

    /// Scales each entry and multiplies by the inverse of L.
    fn solve_lower(&self, tree: &Tree, x: &mut [f64], scaled: impl Fn(usize, f64) -> f64) {
        for i in 0..tree.dofs() {
            x[i] = scaled(i, x[i]) - self.off_diagonal_product(tree, i, x);
        }
    }

    /// Returns the product of row i of L, without its diagonal, and a vector.
    #[inline]
    fn off_diagonal_product(&self, tree: &Tree, i: usize, x: &[f64]) -> f64 {
        let row = &self.entries[tree.row(i)];
        let (root, hinges) = row[..row.len() - 1].split_at((row.len() - 1).min(ROOT_DOFS));
        let mut sum = 0.0;
        for (entry, x) in root.iter().zip(x) {
            sum += entry * x;
        }
        for (entry, j) in hinges.iter().zip(tree.path(i).iter().skip(ROOT_DOFS)) {
            sum += entry * x[*j as usize];
        }
        sum
    }
}

/// Eliminates a row from the rows of the root's degrees of freedom, and divides it by its pivot.
fn eliminate_root(rows: &mut [f64], row: &mut [f64], pivot: f64) {
    for position in (0..row.len()).rev() {
        let factor = row[position] * pivot;
        let start = position * (position + 1) / 2;
        for (entry, coupled) in rows[start..=start + position].iter_mut().zip(&row[..=position]) {
            *entry -= factor * coupled;
        }
        row[position] = factor;
    }
}
