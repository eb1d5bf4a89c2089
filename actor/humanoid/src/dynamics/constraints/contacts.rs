//! Contacts with friction as MuJoCo's pyramids.
//!
//! The force of a contact with friction is a sum of non-negative forces along the four edges n ± μ t₁, n ± μ t₂ of a pyramid.
//! Each edge is a soft one-sided constraint.

use pulp::Simd;

use super::rows::Sweep;
use super::softness::soft_row;
use crate::collision::{Contact, ContactKey, PairNode};
use crate::dynamics::mass_matrix::MassMatrix;
use crate::dynamics::posture::Posture;
use crate::dynamics::structure::{ROOT_DOFS, Structure};
use crate::lanes::{Lanes, Mask, Vec3};

/// Edges of a friction pyramid.
pub(super) const EDGES: usize = 4;
/// Passes over the edges of one contact for each sweep over all constraints.
const EDGE_PASSES: usize = 3;

/// Contact of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct ContactConstraint<S: Simd> {
    /// Index into the pairs that can touch, and of the point within the pair.
    pub(super) key: ContactKey,
    /// First of its numbers, `[dof][direction]`.
    start: usize,
    /// Normal and tangents.
    pub(super) frame: [Vec3<S>; 3],
    pub(super) point_m: Vec3<S>,
    edges: usize,
    friction: Lanes<S>,
    /// Accelerations along the three directions per force of each edge.
    columns: [[Lanes<S>; 3]; EDGES],
    /// Worlds in which it touches.
    is_active: Mask<S>,
    targets: [Lanes<S>; EDGES],
    softness: Lanes<S>,
    divisors: [Lanes<S>; EDGES],
    pub(super) forces_n: [Lanes<S>; EDGES],
}

/// Numbers of all contacts' rows: `[contact][dof of its pair][direction]`, and workspace.
#[derive(Clone, Debug)]
pub(super) struct ContactRows<S: Simd> {
    pub(super) numbers: Vec<[Lanes<S>; 3]>,
    scratch: Vec<[Lanes<S>; 3]>,
}

impl<S: Simd> ContactRows<S> {
    pub(super) fn new(simd: S, structure: &Structure) -> Self {
        let zero = Lanes::zero(simd);
        Self { numbers: Vec::with_capacity(16 * structure.dofs()), scratch: vec![[zero; 3]; structure.dofs()] }
    }

    /// Adds the rows of a contact: rates of separation and sliding per rate of each degree of freedom.
    #[inline(always)]
    fn push(
        &mut self,
        structure: &Structure,
        posture: &Posture<S>,
        matrix: &MassMatrix<S>,
        pair: &PairNode,
        point_m: &Vec3<S>,
        frame: &[Vec3<S>; 3],
    ) {
        let zero = point_m.x.constant(0.0);
        for dof in &pair.dofs {
            self.scratch[*dof as usize] = [zero; 3];
        }
        for (body, sign) in pair.bodies.into_iter().zip([1.0, -1.0]) {
            let Some(body) = body else { continue };
            // Contacts between two bodies do not move the robot as a whole.
            let skipped = if pair.bodies[1].is_some() { ROOT_DOFS } else { 0 };
            for dof in structure.path_of_body(body).iter().skip(skipped) {
                let moved = posture.axes[*dof as usize].at(point_m);
                let row = &mut self.scratch[*dof as usize];
                for (number, direction) in row.iter_mut().zip(frame) {
                    *number += moved.dot(direction) * sign;
                }
            }
        }
        matrix.whiten_rows(structure, pair.dofs.iter().map(|dof| *dof as usize), &mut self.scratch);
        for dof in &pair.dofs {
            self.numbers.push(self.scratch[*dof as usize]);
        }
    }

    /// Returns the products of a contact's rows and a whitened vector.
    #[inline(always)]
    fn products(&self, start: usize, dofs: &[u32], whitened: &[Lanes<S>]) -> [Lanes<S>; 3] {
        let mut sums = [whitened[0].constant(0.0); 3];
        for (row, dof) in self.numbers[start..start + dofs.len()].iter().zip(dofs) {
            let entry = whitened[*dof as usize];
            for (sum, number) in sums.iter_mut().zip(row) {
                *sum = number.mul_add(entry, *sum);
            }
        }
        sums
    }

    /// Adds forces along a contact's directions to whitened accelerations.
    #[inline(always)]
    fn add(&self, start: usize, dofs: &[u32], forces: &[Lanes<S>; 3], whitened: &mut [Lanes<S>]) {
        for (row, dof) in self.numbers[start..start + dofs.len()].iter().zip(dofs) {
            let entry = &mut whitened[*dof as usize];
            for (number, force) in row.iter().zip(forces) {
                *entry = number.mul_add(*force, *entry);
            }
        }
    }
}

impl<S: Simd> ContactConstraint<S> {
    /// Adds the rows of a contact and returns its constraint; `start` holds whitened velocities.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "the state of a step has many parts")]
    pub(super) fn new(
        rows: &mut ContactRows<S>,
        structure: &Structure,
        posture: &Posture<S>,
        matrix: &MassMatrix<S>,
        pair: &PairNode,
        contact: &Contact<S>,
        friction_scale: Lanes<S>,
        start_velocity: &[Lanes<S>],
        warm: &[Lanes<S>; EDGES],
        step_s: f64,
    ) -> Self {
        let frame = frame(&contact.normal);
        let start = rows.numbers.len();
        rows.push(structure, posture, matrix, pair, &contact.point_m, &frame);
        let zero = contact.gap_m.constant(0.0);
        let one = contact.gap_m.constant(1.0);
        let edges = if pair.friction > 0.0 { EDGES } else { 1 };
        let friction = friction_scale * pair.friction;
        let violation = contact.gap_m - pair.margin_m;
        let active = violation.less_than(zero);
        // MuJoCo's approximate response of an edge, and its softness for pyramids ("diagApprox", "makeImpedance").
        let square = friction * friction;
        let response =
            if edges == 1 { zero.constant(pair.response) } else { (square + 1.0) * square * (2.0 * pair.response) };
        let mut own = [[zero; 3]; 3];
        for row in &rows.numbers[start..] {
            for (line, number) in own.iter_mut().zip(row) {
                for (sum, other) in line.iter_mut().zip(row) {
                    *sum = number.mul_add(*other, *sum);
                }
            }
        }
        let rates = rows.products(start, &pair.dofs, start_velocity);
        let mut constraint = Self {
            key: contact.key,
            start,
            frame,
            point_m: contact.point_m,
            edges,
            friction,
            columns: [[zero; 3]; EDGES],
            is_active: active,
            targets: [zero; EDGES],
            softness: zero,
            divisors: [zero; EDGES],
            forces_n: *warm,
        };
        for force in &mut constraint.forces_n {
            *force = active.keep(*force);
        }
        for edge in 0..edges {
            let (tangent, slope) = constraint.slope(edge);
            let mut column = [zero; 3];
            for (number, line) in column.iter_mut().zip(&own) {
                *number = slope.mul_add(line[tangent], line[0]);
            }
            let rate = slope.mul_add(rates[tangent], rates[0]);
            let row = soft_row(&pair.softness, violation, rate, response, step_s);
            constraint.columns[edge] = column;
            constraint.targets[edge] = row.target;
            constraint.softness = row.softness;
            constraint.divisors[edge] = one / (slope.mul_add(column[tangent], column[0]) + row.softness);
        }
        constraint
    }

    /// Returns the tangent of an edge and its slope.
    #[inline(always)]
    fn slope(&self, edge: usize) -> (usize, Lanes<S>) {
        let friction = if self.edges == 1 { self.friction.constant(0.0) } else { self.friction };
        (1 + edge / 2, if edge.is_multiple_of(2) { friction } else { -friction })
    }

    /// Returns the force along the normal and the tangents.
    #[inline(always)]
    pub(super) fn force(&self) -> [Lanes<S>; 3] {
        let [a, b, c, d] = self.forces_n;
        [(a + b) + (c + d), (a - b) * self.friction, (c - d) * self.friction]
    }

    /// Adds the effect of the first guess to whitened accelerations.
    #[inline(always)]
    pub(super) fn apply(&self, rows: &ContactRows<S>, pair: &PairNode, whitened: &mut [Lanes<S>]) {
        rows.add(self.start, &pair.dofs, &self.force(), whitened);
    }

    /// Solves for the forces of the edges while all other constraints stay as they are.
    #[inline(always)]
    pub(super) fn update(
        &mut self,
        rows: &ContactRows<S>,
        pair: &PairNode,
        whitened: &mut [Lanes<S>],
        sweep: &mut Sweep<S>,
    ) {
        let before = self.force();
        let mut accelerations = rows.products(self.start, &pair.dofs, whitened);
        let first = accelerations;
        let zero = self.friction.constant(0.0);
        let changing = sweep.running.and(self.is_active);
        for _ in 0..EDGE_PASSES {
            for edge in 0..self.edges {
                let (tangent, slope) = self.slope(edge);
                let along = slope.mul_add(accelerations[tangent], accelerations[0]);
                let missing = self.targets[edge] - along - self.softness * self.forces_n[edge];
                let wanted = missing.mul_add(self.divisors[edge], self.forces_n[edge]).max(zero);
                let change = changing.keep(wanted - self.forces_n[edge]);
                self.forces_n[edge] += change;
                for (acceleration, response) in accelerations.iter_mut().zip(self.columns[edge]) {
                    *acceleration = response.mul_add(change, *acceleration);
                }
            }
            if self.edges == 1 {
                break;
            }
        }
        for (after, before) in accelerations.into_iter().zip(first) {
            sweep.note_change(changing.keep(after - before));
        }
        sweep.note_effect(self.columns[0][0] * self.force()[0]);
        let mut change = self.force();
        for (after, before) in change.iter_mut().zip(before) {
            *after = changing.keep(*after - before);
        }
        rows.add(self.start, &pair.dofs, &change, whitened);
    }
}

/// Returns the normal and two tangents, those of MuJoCo's `mju_makeFrame`.
#[inline(always)]
fn frame<S: Simd>(normal: &Vec3<S>) -> [Vec3<S>; 3] {
    let (zero, one) = (normal.x.constant(0.0), normal.x.constant(1.0));
    let flat = normal.y.abs().less_than(one.constant(0.5));
    let along = Vec3::new(zero, flat.select(one, zero), flat.select(zero, one));
    let across = along - *normal * normal.dot(&along);
    let first = across * (one / across.dot(&across).sqrt());
    [*normal, first, normal.cross(&first)]
}
