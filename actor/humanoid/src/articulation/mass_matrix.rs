//! Joint-space mass matrix: assembled from composite rigid bodies, factored along the tree.
//!
//! Formulas: Featherstone 2008, tables 6.2 (composite rigid bodies) and 6.3, 6.5 (LᵀDL factorisation, which keeps the
//! zeros of independent branches).
//!
//! *Whitened* velocities are u = D^½ L v; the kinetic energy is |u|²/2. An impulse along a direction with Jacobian J changes
//! u by the whitened row D^−½ L^−ᵀ Jᵀ. The product of that row with u is the rate along the direction. So one row
//! serves both purposes and needs only half of a solution. The same holds for accelerations and forces.

use super::posture::Posture;
use super::structure::{ROOT_DOFS, Structure};
use crate::lanes::{Inertia, Lanes, Simd, add_products};

/// Symmetric matrix over the degrees of freedom with the zeros of a tree.
///
/// Row k holds the entries of k and its path, from the root to k. The path of each of these degrees of freedom is a
/// prefix of k's path, so inner loops run over aligned slices.
#[derive(Clone, Debug)]
pub(crate) struct MassMatrix<S: Simd> {
    entries: Vec<Lanes<S>>,
    /// D^−½, after [`Self::factor`].
    pivot_roots: Vec<Lanes<S>>,
    composites: Vec<Inertia<S>>,
}

impl<S: Simd> MassMatrix<S> {
    pub(crate) fn new(simd: S, structure: &Structure) -> Self {
        Self {
            entries: vec![Lanes::zero(simd); structure.path_entries()],
            pivot_roots: vec![Lanes::zero(simd); structure.dofs()],
            composites: vec![Inertia::zero(simd); structure.nodes.len()],
        }
    }

    /// Assembles the matrix of the bodies for a posture with inertia; adds `diagonal`, one number per degree of freedom.
    #[inline(always)]
    pub(crate) fn assemble(&mut self, structure: &Structure, posture: &Posture<S>, diagonal: &[Lanes<S>]) {
        self.composites.copy_from_slice(&posture.inertias);
        for (index, node) in structure.nodes.iter().enumerate().skip(1).rev() {
            let composite = self.composites[index];
            self.composites[node.parent] += composite;
            for hinge in node.hinges.clone() {
                self.fill_row(structure, posture, ROOT_DOFS + hinge, &composite);
            }
        }
        let whole = self.composites[0];
        for dof in 0..ROOT_DOFS {
            self.fill_row(structure, posture, dof, &whole);
        }
        for (dof, extra) in diagonal.iter().enumerate() {
            self.entries[structure.row(dof).end - 1] += *extra;
        }
    }

    #[inline(always)]
    fn fill_row(&mut self, structure: &Structure, posture: &Posture<S>, dof: usize, composite: &Inertia<S>) {
        let force = composite.times(&posture.axes[dof]);
        let row = &mut self.entries[structure.row(dof)];
        // The first three degrees of freedom are translations along the world's axes: their entries are the force itself.
        for (entry, part) in row.iter_mut().zip([force.force.x, force.force.y, force.force.z]) {
            *entry = part;
        }
        for (entry, other) in row.iter_mut().zip(structure.path(dof)).skip(3) {
            *entry = posture.axes[*other as usize].dot(&force);
        }
    }

    /// Takes over the entries of another matrix of the same structure.
    #[inline(always)]
    pub(crate) fn copy_entries(&mut self, other: &Self) {
        self.entries.copy_from_slice(&other.entries);
    }

    /// Returns the entries of a degree of freedom and its path.
    #[inline(always)]
    pub(crate) fn row(&self, structure: &Structure, dof: usize) -> &[Lanes<S>] {
        &self.entries[structure.row(dof)]
    }

    /// Writes the product with a vector; requires that the matrix is not factored.
    #[inline(always)]
    pub(crate) fn times(&self, structure: &Structure, vector: &[Lanes<S>], product: &mut [Lanes<S>]) {
        for i in 0..structure.dofs() {
            let row = &self.entries[structure.row(i)];
            let mut sum = row[row.len() - 1] * vector[i];
            for (entry, j) in row[..row.len() - 1].iter().zip(structure.path(i)) {
                let other = *j as usize;
                sum = entry.mul_add(vector[other], sum);
                product[other] = entry.mul_add(vector[i], product[other]);
            }
            // Only degrees of freedom further down add to it.
            product[i] = sum;
        }
    }

    /// Factors in place: the entries become those of L, with the inverse of D on the diagonal.
    #[inline(always)]
    pub(crate) fn factor(&mut self, structure: &Structure) {
        for k in (0..structure.dofs()).rev() {
            let range = structure.row(k);
            // The rows of k's path precede row k.
            let (before, from) = self.entries.split_at_mut(range.start);
            let Some((own, row)) = from[..range.len()].split_last_mut() else { continue };
            let pivot = own.constant(1.0) / *own;
            *own = pivot;
            self.pivot_roots[k] = pivot.sqrt();
            let path = structure.path(k);
            for position in (0..row.len()).rev() {
                let factor = -(row[position] * pivot);
                let target = &mut before[structure.row(path[position] as usize)];
                for (entry, coupled) in target.iter_mut().zip(&row[..=position]) {
                    *entry = factor.mul_add(*coupled, *entry);
                }
                row[position] = -factor;
            }
        }
    }

    /// Replaces velocities by whitened ones; requires [`Self::factor`].
    #[inline(always)]
    pub(crate) fn whiten(&self, structure: &Structure, velocity: &mut [Lanes<S>]) {
        for i in (0..structure.dofs()).rev() {
            velocity[i] = (velocity[i] + self.off_diagonal_product(structure, i, velocity)) / self.pivot_roots[i];
        }
    }

    /// Replaces whitened velocities by velocities.
    #[inline(always)]
    pub(crate) fn unwhiten(&self, structure: &Structure, velocity: &mut [Lanes<S>]) {
        for i in 0..structure.dofs() {
            velocity[i] = velocity[i] * self.pivot_roots[i] - self.off_diagonal_product(structure, i, velocity);
        }
    }

    /// Replaces forces, or Jacobians of directions, by their whitened rows; only the given degrees of freedom are not 0.
    /// These must include the path of each.
    #[inline(always)]
    pub(crate) fn whiten_rows<const ROWS: usize>(
        &self,
        structure: &Structure,
        dofs: impl DoubleEndedIterator<Item = usize> + Clone,
        rows: &mut [[Lanes<S>; ROWS]],
    ) {
        for i in dofs.clone().rev() {
            let mut values = rows[i];
            for value in &mut values {
                *value = -*value;
            }
            let range = structure.row(i);
            let entries = &self.entries[range.start..range.end - 1];
            for (entry, j) in entries.iter().zip(structure.path(i)) {
                let row = &mut rows[*j as usize];
                for (number, value) in row.iter_mut().zip(values) {
                    *number = entry.mul_add(value, *number);
                }
            }
        }
        for i in dofs {
            let root = self.pivot_roots[i];
            for number in &mut rows[i] {
                *number = *number * root;
            }
        }
    }

    /// Returns the product of row i of L, without its diagonal, and a vector.
    #[inline(always)]
    fn off_diagonal_product(&self, structure: &Structure, i: usize, x: &[Lanes<S>]) -> Lanes<S> {
        let range = structure.row(i);
        let entries = &self.entries[range.start..range.end - 1];
        let mut sums = [x[0].constant(0.0); 2];
        let path = structure.path(i);
        add_products(&mut sums, entries, |index| x[path[index] as usize]);
        sums[0] + sums[1]
    }
}
