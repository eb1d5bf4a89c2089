//! Sparse symmetric matrix: mass matrix plus what constraints add.
//!
//! Without constraints between branches of the kinematic tree, it has the tree's zeros, and the factorisation from the
//! leaves to the root keeps them (Featherstone 2008, table 6.3). What couples branches fills in as much as it must.

use crate::articulation::{MassMatrix, Structure};
use crate::lanes::{Lanes, Simd};

/// Set of degrees of freedom.
type Dofs = u128;

/// Most degrees of freedom; larger models are solved by sweeps.
pub(super) const DOFS_MAX: usize = Dofs::BITS as usize;

/// Symmetric matrix, by rows up to the diagonal.
#[derive(Clone, Debug)]
pub(super) struct Hessian<S: Simd> {
    /// Row k begins at k (k + 1) ÷ 2; only the columns in `columns` have a meaning.
    entries: Vec<Lanes<S>>,
    /// Columns of each row that are not 0, without the diagonal.
    columns: Vec<Dofs>,
    /// The columns of each row as a list, from the row's start on, after [`Self::factor`].
    lists: Vec<u32>,
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
        Self { entries: vec![Lanes::zero(simd); start(dofs)], columns: vec![0; dofs], lists: vec![0; start(dofs)] }
    }

    /// Becomes the mass matrix, which is not factored.
    #[inline(always)]
    pub(super) fn begin(&mut self, structure: &Structure, masses: &MassMatrix<S>) {
        for dof in 0..structure.dofs() {
            let row = &mut self.entries[start(dof)..];
            let mut columns: Dofs = 0;
            for (other, entry) in structure.path(dof).iter().zip(masses.row(structure, dof)) {
                row[*other as usize] = *entry;
                columns |= 1 << *other;
            }
            self.columns[dof] = columns & !(1 << dof);
        }
    }

    /// Adds to an entry and the one across the diagonal.
    #[inline(always)]
    pub(super) fn add(&mut self, dof: usize, other: usize, extra: Lanes<S>) {
        let (row, column) = (dof.max(other), dof.min(other));
        if row != column {
            self.extend(row, 1 << column);
        }
        self.entries[start(row) + column] += extra;
    }

    /// Adds leftᵀ · right, a symmetric matrix over these degrees of freedom, which ascend.
    #[inline(always)]
    pub(super) fn add_product(&mut self, dofs: &[u32], left: &[[Lanes<S>; 3]], right: &[[Lanes<S>; 3]]) {
        let mut before: Dofs = 0;
        for (index, dof) in dofs.iter().enumerate() {
            let row = *dof as usize;
            self.extend(row, before);
            before |= 1 << row;
            let entries = &mut self.entries[start(row)..];
            for (other, numbers) in dofs[..=index].iter().zip(right) {
                let entry = &mut entries[*other as usize];
                for (one, two) in left[index].iter().zip(numbers) {
                    *entry = one.mul_add(*two, *entry);
                }
            }
        }
    }

    /// Lets a row have these columns too.
    #[inline(always)]
    fn extend(&mut self, row: usize, columns: Dofs) {
        let mut added = columns & !self.columns[row];
        self.columns[row] |= added;
        while let Some(column) = next(&mut added) {
            let entry = &mut self.entries[start(row) + column];
            *entry = entry.constant(0.0);
        }
    }

    /// Factors in place, as LᵀDL with the inverse of D on the diagonal.
    #[inline(always)]
    pub(super) fn factor(&mut self) {
        for k in (0..self.columns.len()).rev() {
            let count = self.write_list(k);
            for position in 0..count {
                let j = self.lists[start(k) + position] as usize;
                // The columns before j, which is one of them.
                let before_j = self.columns[k] & !(Dofs::MAX << j);
                self.extend(j, before_j);
            }
            let (before, row) = self.entries.split_at_mut(start(k));
            let list = &self.lists[start(k)..start(k) + count];
            let pivot = row[k].constant(1.0) / row[k];
            row[k] = pivot;
            for (position, j) in list.iter().enumerate() {
                let target = &mut before[start(*j as usize)..];
                let factor = -(row[*j as usize] * pivot);
                for i in &list[..=position] {
                    let entry = &mut target[*i as usize];
                    *entry = factor.mul_add(row[*i as usize], *entry);
                }
            }
            for j in list {
                row[*j as usize] = row[*j as usize] * pivot;
            }
        }
    }

    /// Writes the list of a row's columns. Returns its length.
    #[inline(always)]
    fn write_list(&mut self, row: usize) -> usize {
        let mut columns = self.columns[row];
        let mut count = 0;
        while let Some(column) = next(&mut columns) {
            self.lists[start(row) + count] = column as u32;
            count += 1;
        }
        count
    }

    /// Returns the columns of a row; requires [`Self::factor`].
    #[inline(always)]
    fn list(&self, row: usize) -> &[u32] {
        &self.lists[start(row)..start(row) + self.columns[row].count_ones() as usize]
    }

    /// Replaces a vector by the solution for it; requires [`Self::factor`].
    #[inline(always)]
    pub(super) fn solve(&self, vector: &mut [Lanes<S>]) {
        for k in (0..self.columns.len()).rev() {
            let (row, negative) = (&self.entries[start(k)..], -vector[k]);
            for j in self.list(k) {
                let number = &mut vector[*j as usize];
                *number = row[*j as usize].mul_add(negative, *number);
            }
        }
        for k in 0..self.columns.len() {
            let row = &self.entries[start(k)..];
            let mut sums = [vector[k] * row[k], vector[k].constant(0.0)];
            for j in self.list(k) {
                let column = *j as usize;
                // By column, not by position: a column that only a neighbour's contacts fill must not change the rounding.
                sums[column % 2] = row[column].mul_sub_from(vector[column], sums[column % 2]);
            }
            vector[k] = sums[0] + sums[1];
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};
    use pulp::Scalar;

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
        let solution = |fill: Option<(usize, usize)>| {
            let mut hessian = Hessian::new(Scalar, &structure);
            hessian.begin(&structure, &masses);
            hessian.add_product(&[8, 12, 20], &[[lanes(0.3); 3]; 3], &[[lanes(0.7); 3]; 3]);
            if let Some((row, column)) = fill {
                hessian.add(row, column, lanes(0.0));
            }
            let mut vector: Vec<_> = (0..dofs).map(|dof| lanes((dof as f64).cos())).collect();
            hessian.factor();
            hessian.solve(&mut vector);
            vector.iter().map(|number| number.lane(0)).collect::<Vec<_>>()
        };
        let wanted = solution(None);
        for row in 0..dofs {
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
