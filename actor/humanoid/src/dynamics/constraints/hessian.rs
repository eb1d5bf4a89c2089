//! Sparse symmetric matrix: mass matrix plus what constraints add.
//!
//! Without constraints between branches of the kinematic tree, it has the tree's zeros, and the factorisation from the
//! leaves to the root keeps them (Featherstone 2008, table 6.3). What couples branches fills in as much as it must.

use std::ops::Range;

use crate::articulation::{MassMatrix, Structure};
use crate::lanes::{Lanes, Simd, add_products};

/// Set of degrees of freedom.
type Dofs = u128;

/// Most degrees of freedom; larger models are solved by sweeps.
pub(super) const DOFS_MAX: usize = Dofs::BITS as usize;

/// Symmetric matrix, by rows up to the diagonal.
#[derive(Clone, Debug)]
pub(super) struct Hessian<S: Simd> {
    /// Row k begins at k (k + 1) ÷ 2; only the columns in `columns` have a meaning.
    entries: Vec<Lanes<S>>,
    /// Columns of each row that may not be 0, without the diagonal, also after [`Self::factor`].
    columns: Vec<Dofs>,
    /// The same as ranges, one row after the other, and where each row's begin.
    ranges: Vec<Range<usize>>,
    range_starts: Vec<usize>,
}

/// Removes and returns the first member.
#[inline(always)]
fn next(dofs: &mut Dofs) -> Option<usize> {
    let first = dofs.trailing_zeros();
    *dofs &= dofs.wrapping_sub(1);
    (first < Dofs::BITS).then_some(first as usize)
}

/// Returns the start of a row.
#[inline(always)]
fn start(row: usize) -> usize {
    row * (row + 1) / 2
}

impl<S: Simd> Hessian<S> {
    /// Creates one for any structure with as many degrees of freedom.
    pub(super) fn new(simd: S, structure: &Structure) -> Self {
        let dofs = structure.dofs();
        Self {
            entries: vec![Lanes::zero(simd); start(dofs)],
            columns: vec![0; dofs],
            ranges: Vec::with_capacity(start(dofs)),
            range_starts: vec![0; dofs + 1],
        }
    }

    /// Plans for a mass matrix and products over these sets of degrees of freedom, each in ascending order.
    pub(super) fn plan<'a>(&mut self, structure: &Structure, products: impl Iterator<Item = &'a [u32]>) {
        for (row, columns) in self.columns.iter_mut().enumerate() {
            *columns = structure.path(row).iter().fold(0, |all, dof| all | 1 << dof) & !(1 << row);
        }
        for dofs in products {
            dofs.iter().fold(0, |before: Dofs, dof| {
                self.columns[*dof as usize] |= before;
                before | 1 << dof
            });
        }
        for row in (0..self.columns.len()).rev() {
            let (columns, mut rest) = (self.columns[row], self.columns[row]);
            while let Some(column) = next(&mut rest) {
                // The columns before this one, which is one of them.
                self.columns[column] |= columns & !(Dofs::MAX << column);
            }
        }
        self.ranges.clear();
        for (row, columns) in self.columns.iter().enumerate() {
            let mut rest = *columns;
            while rest != 0 {
                let first = rest.trailing_zeros();
                let end = first + (!(rest >> first)).trailing_zeros();
                self.ranges.push(first as usize..end as usize);
                rest &= Dofs::MAX.checked_shl(end).unwrap_or(0);
            }
            self.range_starts[row + 1] = self.ranges.len();
        }
    }

    /// Becomes the mass matrix, which is not factored; requires [`Self::plan`].
    #[inline(always)]
    pub(super) fn begin(&mut self, structure: &Structure, masses: &MassMatrix<S>) {
        for dof in 0..structure.dofs() {
            let row = &mut self.entries[start(dof)..=start(dof) + dof];
            let zero = row[dof].constant(0.0);
            for range in &self.ranges[self.range_starts[dof]..self.range_starts[dof + 1]] {
                row[range.clone()].fill(zero);
            }
            for (other, entry) in structure.path(dof).iter().zip(masses.row(structure, dof)) {
                row[*other as usize] = *entry;
            }
        }
    }

    /// Adds to an entry and the one across the diagonal.
    #[inline(always)]
    pub(super) fn add(&mut self, dof: usize, other: usize, extra: Lanes<S>) {
        self.entries[start(dof.max(other)) + dof.min(other)] += extra;
    }

    /// Adds leftᵀ · right, a symmetric matrix over these degrees of freedom, which ascend.
    #[inline(always)]
    pub(super) fn add_product(&mut self, dofs: &[u32], left: &[[Lanes<S>; 3]], right: &[[Lanes<S>; 3]]) {
        for (index, (dof, own)) in dofs.iter().zip(left).enumerate() {
            let row = *dof as usize;
            let entries = &mut self.entries[start(row)..=start(row) + row];
            for (other, numbers) in dofs[..=index].iter().zip(right) {
                let entry = &mut entries[*other as usize];
                for (one, two) in own.iter().zip(numbers) {
                    *entry = one.mul_add(*two, *entry);
                }
            }
        }
    }

    /// Factors in place, as LᵀDL with the inverse of D on the diagonal.
    #[inline(always)]
    pub(super) fn factor(&mut self) {
        for k in (0..self.columns.len()).rev() {
            let ranges = &self.ranges[self.range_starts[k]..self.range_starts[k + 1]];
            let (before, row) = self.entries.split_at_mut(start(k));
            let pivot = row[k].constant(1.0) / row[k];
            row[k] = pivot;
            for j in ranges.iter().flat_map(Range::clone) {
                let target = &mut before[start(j)..=start(j) + j];
                let factor = -(row[j] * pivot);
                for range in ranges.iter().take_while(|range| range.start <= j) {
                    let range = range.start..range.end.min(j + 1);
                    for (entry, number) in target[range.clone()].iter_mut().zip(&row[range]) {
                        *entry = factor.mul_add(*number, *entry);
                    }
                }
            }
            for range in ranges {
                for number in &mut row[range.clone()] {
                    *number = *number * pivot;
                }
            }
        }
    }

    /// Replaces a vector by the solution for it; requires [`Self::factor`].
    #[inline(always)]
    pub(super) fn solve(&self, vector: &mut [Lanes<S>]) {
        for k in (0..self.columns.len()).rev() {
            let (row, negative) = (&self.entries[start(k)..], -vector[k]);
            for range in &self.ranges[self.range_starts[k]..self.range_starts[k + 1]] {
                for (number, entry) in vector[range.clone()].iter_mut().zip(&row[range.clone()]) {
                    *number = entry.mul_add(negative, *number);
                }
            }
        }
        for k in 0..self.columns.len() {
            let row = &self.entries[start(k)..];
            let mut sums = [vector[k] * row[k], vector[k].constant(0.0)];
            for range in &self.ranges[self.range_starts[k]..self.range_starts[k + 1]] {
                // By column, not by position: a column that only a neighbour's contacts fill must not change the rounding.
                sums.rotate_left(range.start % 2);
                let numbers = &vector[range.clone()];
                add_products(&mut sums, &row[range.clone()], |index| -numbers[index]);
                sums.rotate_left(range.start % 2);
            }
            vector[k] = sums[0] + sums[1];
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::lanes::Scalar;
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::articulation::{Posture, ROOT_DOFS};
    use crate::mjcf::HUMANOID_XML;
    use crate::model::Model;

    /// Adds left · rightᵀ of these degrees of freedom to a dense matrix, for a product that is symmetric.
    fn add_dense(dense: &mut DMatrix<f64>, dofs: &[u32], numbers: &[f64], weight: f64) {
        for (one, first) in dofs.iter().zip(numbers) {
            for (other, second) in dofs.iter().zip(numbers) {
                dense[(*one as usize, *other as usize)] += weight * first * second;
            }
        }
    }

    /// Returns the built-in humanoid's structure, and its mass matrix in the nominal position.
    fn humanoid() -> (Structure, MassMatrix<Scalar>) {
        let model = Model::from_mjcf(HUMANOID_XML).unwrap();
        let structure = Structure::new(&model);
        let position: Vec<_> =
            model.nominal_position().into_iter().map(|number| Lanes::splat(Scalar, number)).collect();
        let mut posture = Posture::new(Scalar, &structure);
        posture.update_kinematics(&structure, &position);
        let mut masses = MassMatrix::new(Scalar, &structure);
        masses.assemble(&structure, &posture, &vec![Lanes::splat(Scalar, 2.0); structure.dofs()]);
        (structure, masses)
    }

    #[test]
    fn what_only_neighbours_fill_changes_no_bit() {
        let (structure, masses) = humanoid();
        let dofs = structure.dofs();
        let lanes = |number: f64| Lanes::splat(Scalar, number);
        let solution = |fill: Option<(u32, u32)>| {
            let mut hessian = Hessian::new(Scalar, &structure);
            let filled = fill.map(|(row, column)| [column, row]);
            hessian.plan(&structure, [&[8, 12, 20][..]].into_iter().chain(filled.iter().map(|dofs| &dofs[..])));
            hessian.begin(&structure, &masses);
            hessian.add_product(&[8, 12, 20], &[[lanes(0.3); 3]; 3], &[[lanes(0.7); 3]; 3]);
            let mut vector: Vec<_> = (0..dofs).map(|dof| lanes((dof as f64).cos())).collect();
            hessian.factor();
            hessian.solve(&mut vector);
            vector.iter().map(|number| number.lane(0)).collect::<Vec<_>>()
        };
        let wanted = solution(None);
        for row in 0..dofs as u32 {
            for column in 0..row {
                assert_eq!(solution(Some((row, column))), wanted, "row {row}, column {column}");
            }
        }
    }

    #[test]
    fn solutions_are_those_of_the_dense_matrix() {
        let (structure, masses) = humanoid();
        let lanes = |number: f64| Lanes::splat(Scalar, number);
        let dofs = structure.dofs();
        let mut dense = DMatrix::zeros(dofs, dofs);
        let mut hessian = Hessian::new(Scalar, &structure);
        for dof in 0..dofs {
            for (other, entry) in structure.path(dof).iter().zip(masses.row(&structure, dof)) {
                dense[(dof, *other as usize)] = entry.lane(0);
                dense[(*other as usize, dof)] = entry.lane(0);
            }
        }
        let last = dofs as u32 - 1;
        let couplings: [&[u32]; 4] = [&[], structure.path(dofs - 1), &[8, 12, last], &[ROOT_DOFS as u32, 11, 17]];
        for used in 1..=couplings.len() {
            hessian.plan(&structure, couplings[..used].iter().copied().chain([&[9, 20][..]]));
            hessian.begin(&structure, &masses);
            let mut wanted = dense.clone();
            for coupled in &couplings[..used] {
                let numbers: Vec<f64> = coupled.iter().map(|dof| (f64::from(*dof) * 1.7).sin()).collect();
                // Rows of which the second is twice, and the third three times the first.
                let left: Vec<_> =
                    numbers.iter().map(|number| [1.0, 2.0, 3.0].map(|row| lanes(row * number))).collect();
                let right: Vec<_> = left.iter().map(|row| row.map(|number| number * 10.0)).collect();
                hessian.add_product(coupled, &left, &right);
                add_dense(&mut wanted, coupled, &numbers, 140.0);
            }
            hessian.add(20, 9, lanes(0.1));
            wanted[(20, 9)] += 0.1;
            wanted[(9, 20)] += 0.1;
            let force = DVector::from_fn(dofs, |dof, _| (dof as f64).cos());
            let mut solution: Vec<_> = force.iter().map(|number| lanes(*number)).collect();
            hessian.factor();
            hessian.solve(&mut solution);
            let expected = wanted.cholesky().unwrap().solve(&force);
            for (found, expected) in solution.iter().zip(expected.iter()) {
                assert!((found.lane(0) - expected).abs() < 4e-6, "{used}: {found:?} instead of {expected}");
            }
        }
    }
}
