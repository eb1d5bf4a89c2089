//! Whitened rows of constraints, and products with them.

use crate::articulation::{Coordinate, MassMatrix, Structure};
use crate::lanes::{Lanes, Simd, add_products};

/// Numbers of all rows of a step; a row has one number per degree of freedom that can move its constraint.
#[derive(Clone, Debug)]
pub(super) struct Rows<S: Simd> {
    pub(super) numbers: Vec<Lanes<S>>,
    scratch: Vec<[Lanes<S>; 1]>,
}

impl<S: Simd> Rows<S> {
    pub(super) fn new(simd: S, structure: &Structure) -> Self {
        Self {
            numbers: Vec::with_capacity(structure.path_entries()),
            scratch: vec![[Lanes::zero(simd)]; structure.dofs()],
        }
    }

    /// Adds the row of a coordinate.
    #[inline(always)]
    pub(super) fn push(&mut self, structure: &Structure, matrix: &MassMatrix<S>, coordinate: &Coordinate) {
        let zero = self.scratch[0][0].constant(0.0);
        for dof in &coordinate.dofs {
            self.scratch[*dof as usize] = [zero];
        }
        for (dof, weight) in &coordinate.terms {
            self.scratch[*dof] = [self.scratch[*dof][0] + *weight];
        }
        matrix.whiten_rows(structure, coordinate.dofs.iter().map(|dof| *dof as usize), &mut self.scratch);
        for dof in &coordinate.dofs {
            self.numbers.push(self.scratch[*dof as usize][0]);
        }
    }

    /// Returns the product of a row and whitened accelerations.
    #[inline(always)]
    pub(super) fn product(&self, start: usize, dofs: &[u32], whitened: &[Lanes<S>]) -> Lanes<S> {
        let row = &self.numbers[start..start + dofs.len()];
        let mut sums = [whitened[0].constant(0.0); 2];
        add_products(&mut sums, row, |index| whitened[dofs[index] as usize]);
        sums[0] + sums[1]
    }

    /// Adds `force` times a row to whitened accelerations.
    #[inline(always)]
    pub(super) fn add(&self, start: usize, dofs: &[u32], force: Lanes<S>, whitened: &mut [Lanes<S>]) {
        for (number, dof) in self.numbers[start..start + dofs.len()].iter().zip(dofs) {
            let entry = &mut whitened[*dof as usize];
            *entry = number.mul_add(force, *entry);
        }
    }
}
