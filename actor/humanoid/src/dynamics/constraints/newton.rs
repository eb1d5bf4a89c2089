//! Solution by Newton's method, as MuJoCo's `solver="Newton"`.
//!
//! The acceleration a minimises ½ (a − a₀)ᵀ M (a − a₀) + Σ s(J a), where a₀ is the acceleration without constraints and the
//! force of a constraint is −s′: a convex function with a piecewise linear gradient. Each iteration solves with the Hessian
//! M + Σ s″ JᵀJ, then searches along the solution. Few iterations do, however stiff and redundant the contacts are.

use super::Problem;
use super::contacts::{EDGES, Weights};
use super::coordinates::of_terms;
use super::hessian::Hessian;
use crate::articulation::{MassMatrix, Structure};
use crate::collision::PairNode;
use crate::lanes::{Lanes, Mask, Simd};

/// Upper bound of the iterations.
const ITERATIONS_MAX: usize = 50;
/// An acceleration is a solution if the next step would change it by less than this share of what the constraints
/// change, in the norm of the kinetic energy, squared.
const SETTLED: f64 = 1e-10;
/// The same, absolute (kg·m²/s⁴).
const SETTLED_MIN: f64 = 1e-8;
/// In single precision some solutions come no closer than this multiple of the tolerances: from there on, an iteration that
/// improves the acceleration by less than [`PROGRESS`] is the last one.
const ROUNDED: f64 = 1e4;
/// Share of what the step before would have changed, squared.
const PROGRESS: f64 = 0.25;
/// Upper bound of the steps of a search along a line.
const SEARCH_MAX: usize = 10;
/// A search ends when the slope is at most this share of the first one.
const SEARCH_SETTLED: f64 = 0.1;

/// Workspace of the solver.
#[derive(Clone, Debug)]
pub(super) struct Newton<S: Simd> {
    coordinates: Vec<CoordinateState<S>>,
    connections: Vec<ConnectionState<S>>,
    contacts: Vec<ContactState<S>>,
    /// Mass matrix, not factored.
    masses: MassMatrix<S>,
    hessian: Hessian<S>,
    acceleration: Vec<Lanes<S>>,
    /// M (a − a₀).
    inertial: Vec<Lanes<S>>,
    free: Vec<Lanes<S>>,
    gradient: Vec<[Lanes<S>; 1]>,
    step: Vec<Lanes<S>>,
    inertial_step: Vec<Lanes<S>>,
    whitened_gradient: Vec<[Lanes<S>; 1]>,
    /// What the next step changes at most, squared, in the norm of the kinetic energy (kg·m²/s⁴).
    missing: Lanes<S>,
    /// Rows of a contact times their weights.
    weighted: Vec<[Lanes<S>; 3]>,
}

#[derive(Clone, Copy, Debug)]
struct CoordinateState<S: Simd> {
    /// Forces per acceleration of limit and friction loss.
    stiffness: [Lanes<S>; 2],
    acceleration: Lanes<S>,
    /// Its change by a whole step.
    change: Lanes<S>,
    /// Decrease of the force per acceleration.
    decrease: Lanes<S>,
}

#[derive(Clone, Copy, Debug)]
struct ConnectionState<S: Simd> {
    stiffness: Lanes<S>,
    accelerations: [Lanes<S>; 3],
    changes: [Lanes<S>; 3],
}

#[derive(Clone, Copy, Debug)]
struct ContactState<S: Simd> {
    stiffness: Lanes<S>,
    accelerations: [Lanes<S>; 3],
    changes: [Lanes<S>; 3],
    /// Decrease of the edges' forces per acceleration.
    decreases: [Lanes<S>; EDGES],
}

impl<S: Simd> Newton<S> {
    pub(super) fn new(simd: S, structure: &Structure) -> Self {
        let zero = Lanes::zero(simd);
        let vector = vec![zero; structure.dofs()];
        Self {
            coordinates: Vec::with_capacity(structure.coordinates.len()),
            connections: Vec::with_capacity(structure.connections.len()),
            contacts: Vec::with_capacity(16),
            masses: MassMatrix::new(simd, structure),
            hessian: Hessian::new(simd, structure),
            acceleration: vector.clone(),
            inertial: vector.clone(),
            free: vector.clone(),
            gradient: vec![[zero]; structure.dofs()],
            step: vector.clone(),
            inertial_step: vector,
            whitened_gradient: vec![[zero]; structure.dofs()],
            missing: zero,
            weighted: Vec::with_capacity(structure.dofs()),
        }
    }

    /// Notes the mass matrix before it is factored.
    #[inline(always)]
    pub(super) fn note_masses(&mut self, matrix: &MassMatrix<S>) {
        self.masses.copy_entries(matrix);
    }

    /// Changes whitened accelerations and the forces by all constraints, beginning with the acceleration `start`, in
    /// the worlds that have constraints.
    #[inline(always)]
    pub(super) fn solve(&mut self, mut problem: Problem<'_, S>, start: &[Lanes<S>], whitened: &mut [Lanes<S>]) {
        let structure = problem.structure;
        self.begin(&problem, start, whitened);
        let tendons = (0..self.coordinates.len()).map(|index| problem.coordinate(index));
        let tendons = tendons.filter(|coordinate| coordinate.terms.len() > 1).map(|coordinate| &coordinate.dofs[..]);
        let contacts = problem.contacts.chunk_by(|one, other| one.key.0 == other.key.0);
        let contacts = contacts.map(|points| &problem.pairs[points[0].key.0 as usize].coupled_dofs[..]);
        let connections = structure.connections.iter().map(|connection| &connection.dofs[..]);
        self.hessian.plan(structure, tendons.chain(connections).chain(contacts));
        let constrained = problem.constrained(whitened[0]);
        let mut running = constrained;
        for iteration in 0..=ITERATIONS_MAX {
            self.respond(&mut problem);
            running = running.and(self.is_unsettled(&problem));
            if iteration == ITERATIONS_MAX || !running.any() {
                break;
            }
            self.assemble(&problem);
            self.hessian.factor();
            for (step, [gradient]) in self.step.iter_mut().zip(&self.gradient) {
                *step = -*gradient;
            }
            self.hessian.solve(&mut self.step);
            for step in &mut self.step {
                *step = running.keep(*step);
            }
            self.masses.times(structure, &self.step, &mut self.inertial_step);
            self.note_changes(&problem);
            let share = self.search(&problem, running);
            self.advance(share);
        }
        problem.matrix.whiten(structure, &mut self.acceleration);
        for (number, solution) in whitened.iter_mut().zip(&self.acceleration) {
            // Without constraints nothing changes, not even by rounding: neighbours that have some make no difference.
            *number = constrained.select(*solution, *number);
        }
    }

    /// Computes the constraints' accelerations at the start.
    #[inline(always)]
    fn begin(&mut self, problem: &Problem<'_, S>, start: &[Lanes<S>], whitened: &[Lanes<S>]) {
        let one = whitened[0].constant(1.0);
        let zero = whitened[0].constant(0.0);
        self.missing = zero.constant(1e30);
        self.free.copy_from_slice(whitened);
        problem.matrix.unwhiten(problem.structure, &mut self.free);
        self.acceleration.copy_from_slice(start);
        for ((difference, start), free) in self.step.iter_mut().zip(start).zip(&self.free) {
            *difference = *start - *free;
        }
        self.masses.times(problem.structure, &self.step, &mut self.inertial);
        self.coordinates.clear();
        for (index, constraint) in problem.coordinates.iter().enumerate() {
            self.coordinates.push(CoordinateState {
                stiffness: [one / constraint.limit.softness, one / constraint.loss.softness],
                acceleration: of_terms(problem.coordinate(index), start),
                change: zero,
                decrease: zero,
            });
        }
        self.connections.clear();
        for (connection, node) in problem.connections.iter().zip(&problem.structure.connections) {
            self.connections.push(ConnectionState {
                stiffness: one / connection.softness,
                accelerations: problem.rows.products(connection.start, &node.dofs, start),
                changes: [zero; 3],
            });
        }
        self.contacts.clear();
        for (index, contact) in problem.contacts.iter().enumerate() {
            self.contacts.push(ContactState {
                stiffness: one / contact.softness,
                accelerations: problem.rows.products(contact.start, problem.dofs(index), start),
                changes: [zero; 3],
                decreases: [zero; EDGES],
            });
        }
    }

    /// Computes the forces at the present acceleration, and the gradient.
    #[inline(always)]
    fn respond(&mut self, problem: &mut Problem<'_, S>) {
        for (gradient, inertial) in self.gradient.iter_mut().zip(&self.inertial) {
            *gradient = [*inertial];
        }
        for (constraint, state) in problem.coordinates.iter_mut().zip(&mut self.coordinates) {
            let (forces, decrease) = constraint.respond(state.stiffness, state.acceleration);
            [constraint.limit_nm, constraint.loss_nm, constraint.servo_nm] = forces;
            state.decrease = decrease;
            let torque = constraint.torque();
            for (dof, weight) in &problem.structure.coordinates[constraint.coordinate].terms {
                self.gradient[*dof][0] -= torque * *weight;
            }
        }
        for ((connection, state), node) in
            problem.connections.iter_mut().zip(&self.connections).zip(&problem.structure.connections)
        {
            connection.forces_n = connection.respond(state.stiffness, &state.accelerations);
            for (row, dof) in problem.rows.numbers[connection.start..].iter().zip(&node.dofs) {
                let gradient = &mut self.gradient[*dof as usize][0];
                for (number, force) in row.iter().zip(connection.forces_n) {
                    *gradient = number.mul_sub_from(force, *gradient);
                }
            }
        }
        for (contact, state) in problem.contacts.iter_mut().zip(&mut self.contacts) {
            for edge in 0..contact.edges {
                (contact.forces_n[edge], state.decreases[edge]) =
                    contact.respond(edge, state.stiffness, &state.accelerations);
            }
            let force = contact.force();
            let dofs = &problem.pairs[contact.key.0 as usize].dofs;
            for (row, dof) in problem.rows.numbers[contact.start..].iter().zip(dofs) {
                let gradient = &mut self.gradient[*dof as usize][0];
                for (number, part) in row.iter().zip(force) {
                    *gradient = number.mul_sub_from(part, *gradient);
                }
            }
        }
    }

    /// Computes the Hessian.
    #[inline(always)]
    fn assemble(&mut self, problem: &Problem<'_, S>) {
        let structure = problem.structure;
        self.hessian.begin(structure, &self.masses);
        for (index, state) in self.coordinates.iter().enumerate() {
            let terms = &problem.coordinate(index).terms;
            for (index, (dof, weight)) in terms.iter().enumerate() {
                for (other, factor) in &terms[..=index] {
                    self.hessian.add(*dof, *other, state.decrease * (*weight * *factor));
                }
            }
        }
        for ((connection, state), node) in problem.connections.iter().zip(&self.connections).zip(&structure.connections)
        {
            let rows = &problem.rows.numbers[connection.start..connection.start + node.dofs.len()];
            self.weighted.clear();
            for row in rows {
                self.weighted.push([row[0] * state.stiffness, row[1] * state.stiffness, row[2] * state.stiffness]);
            }
            self.hessian.add_product(&node.dofs, &self.weighted, rows);
        }
        for index in 0..self.contacts.len() {
            let contact = &problem.contacts[index];
            let weights = Weights::new(self.contacts[index].decreases, contact.friction);
            if !weights.normal.constant(0.0).less_than(weights.normal).any() {
                continue;
            }
            let pair = &problem.pairs[contact.key.0 as usize];
            let rows = &problem.rows.numbers[contact.start..contact.start + pair.dofs.len()];
            self.add_contact(pair, rows, &weights);
        }
    }

    /// Adds Jᵀ W J of a contact to the Hessian.
    #[inline(always)]
    fn add_contact(&mut self, pair: &PairNode, rows: &[[Lanes<S>; 3]], weights: &Weights<S>) {
        let dofs = &pair.coupled_dofs;
        let rows = &rows[rows.len() - dofs.len()..];
        self.weighted.clear();
        for row in rows {
            self.weighted.push(weights.times(row));
        }
        self.hessian.add_product(dofs, &self.weighted, rows);
    }

    /// Returns where the present acceleration is no solution, and a better one can be found.
    #[inline(always)]
    fn is_unsettled(&mut self, problem: &Problem<'_, S>) -> Mask<S> {
        let structure = problem.structure;
        // gᵀ M⁻¹ g is never less than what the next step changes, squared.
        self.whitened_gradient.copy_from_slice(&self.gradient);
        problem.matrix.whiten_rows(structure, 0..structure.dofs(), &mut self.whitened_gradient);
        let zero = self.gradient[0][0].constant(0.0);
        let (mut missing, mut changed) = (zero, zero);
        for ([number], ((acceleration, free), inertial)) in
            self.whitened_gradient.iter().zip(self.acceleration.iter().zip(&self.free).zip(&self.inertial))
        {
            missing = number.mul_add(*number, missing);
            changed = (*acceleration - *free).mul_add(*inertial, changed);
        }
        let settled = (changed * SETTLED).max(zero.constant(SETTLED_MIN));
        let improves = missing.less_than(self.missing * PROGRESS).or((settled * ROUNDED).less_than(missing));
        self.missing = missing;
        settled.less_than(missing).and(improves)
    }

    /// Computes what a whole step would change.
    #[inline(always)]
    fn note_changes(&mut self, problem: &Problem<'_, S>) {
        for (index, state) in self.coordinates.iter_mut().enumerate() {
            state.change = of_terms(problem.coordinate(index), &self.step);
        }
        for ((state, connection), node) in
            self.connections.iter_mut().zip(&*problem.connections).zip(&problem.structure.connections)
        {
            state.changes = problem.rows.products(connection.start, &node.dofs, &self.step);
        }
        for (index, state) in self.contacts.iter_mut().enumerate() {
            state.changes = problem.rows.products(problem.contacts[index].start, problem.dofs(index), &self.step);
        }
    }

    /// Returns the share of the step that leads to the least value.
    #[inline(always)]
    fn search(&self, problem: &Problem<'_, S>, running: Mask<S>) -> Lanes<S> {
        let zero = self.step[0].constant(0.0);
        let (mut first, mut free_slope, mut free_curvature) = (zero, zero, zero);
        for (index, step) in self.step.iter().enumerate() {
            first = step.mul_add(self.gradient[index][0], first);
            free_slope = step.mul_add(self.inertial[index], free_slope);
            free_curvature = step.mul_add(self.inertial_step[index], free_curvature);
        }
        let enough = first.abs() * SEARCH_SETTLED;
        let (mut low, mut high) = (zero, zero.constant(1e30));
        let mut share = zero.constant(1.0);
        let mut searching = running;
        for _ in 0..SEARCH_MAX {
            let (mut slope, mut curvature) = (free_curvature.mul_add(share, free_slope), free_curvature);
            for (constraint, state) in problem.coordinates.iter().zip(&self.coordinates) {
                let acceleration = state.change.mul_add(share, state.acceleration);
                let ([limit_nm, loss_nm, servo_nm], decrease) = constraint.respond(state.stiffness, acceleration);
                let torque = limit_nm * constraint.limit_sign + loss_nm + servo_nm;
                slope = torque.mul_sub_from(state.change, slope);
                curvature = (decrease * state.change).mul_add(state.change, curvature);
            }
            for (connection, state) in problem.connections.iter().zip(&self.connections) {
                let accelerations = moved(&state.accelerations, &state.changes, share);
                let forces = connection.respond(state.stiffness, &accelerations);
                for (force, change) in forces.into_iter().zip(state.changes) {
                    slope = force.mul_sub_from(change, slope);
                    curvature = (state.stiffness * change).mul_add(change, curvature);
                }
            }
            for (contact, state) in problem.contacts.iter().zip(&self.contacts) {
                let accelerations = moved(&state.accelerations, &state.changes, share);
                for edge in 0..contact.edges {
                    let (force, decrease) = contact.respond(edge, state.stiffness, &accelerations);
                    let (tangent, along) = contact.slope(edge);
                    let change = along.mul_add(state.changes[tangent], state.changes[0]);
                    slope = force.mul_sub_from(change, slope);
                    curvature = (decrease * change).mul_add(change, curvature);
                }
            }
            searching = searching.and(enough.less_than(slope.abs()));
            if !searching.any() {
                break;
            }
            let rises = zero.less_than(slope);
            low = rises.select(low, share);
            high = rises.select(share, high);
            let next = share - slope / curvature;
            let is_between = low.less_than(next).and(next.less_than(high));
            share = searching.select(is_between.select(next, (low + high) * 0.5), share);
        }
        share
    }

    /// Takes a share of the step.
    #[inline(always)]
    fn advance(&mut self, share: Lanes<S>) {
        for (index, step) in self.step.iter().enumerate() {
            self.acceleration[index] = step.mul_add(share, self.acceleration[index]);
            self.inertial[index] = self.inertial_step[index].mul_add(share, self.inertial[index]);
        }
        for state in &mut self.coordinates {
            state.acceleration = state.change.mul_add(share, state.acceleration);
        }
        for state in &mut self.connections {
            state.accelerations = moved(&state.accelerations, &state.changes, share);
        }
        for state in &mut self.contacts {
            state.accelerations = moved(&state.accelerations, &state.changes, share);
        }
    }
}

/// Returns accelerations after a share of their change.
#[inline(always)]
fn moved<S: Simd>(accelerations: &[Lanes<S>; 3], changes: &[Lanes<S>; 3], share: Lanes<S>) -> [Lanes<S>; 3] {
    let mut moved = *accelerations;
    for (acceleration, change) in moved.iter_mut().zip(changes) {
        *acceleration = change.mul_add(share, *acceleration);
    }
    moved
}
