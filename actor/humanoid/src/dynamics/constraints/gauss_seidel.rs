//! Solution by projected Gauss-Seidel sweeps, as MuJoCo's `solver="PGS"`.
//!
//! Rows are whitened (see [`crate::dynamics::mass_matrix`]): a sweep works on accelerations in which every force acts
//! by one row.

use super::Problem;
use super::connections::ConnectionConstraint;
use super::contacts::{ContactConstraint, ContactRows, EDGES};
use super::coordinates::CoordinateConstraint;
use super::rows::Rows;
use crate::articulation::Structure;
use crate::collision::PairNode;
use crate::lanes::{Lanes, Mask, Simd};

/// Upper bound of the sweeps over all constraints.
const SWEEPS_MAX: usize = 100;
/// The sweeps end when one changes no acceleration by more than this share of the largest acceleration that a force of the
/// constraints causes, or by more than [`SETTLED_MIN`].
const SETTLED: f64 = 1e-4;
/// Change of an acceleration (m/s² or rad/s²) that is always small enough.
const SETTLED_MIN: f64 = 1e-3;
/// Passes over the edges of one contact, or the axes of one connection, for each sweep over all constraints.
const EDGE_PASSES: usize = 3;

/// Workspace of the solver.
#[derive(Clone, Debug)]
pub(super) struct GaussSeidel<S: Simd> {
    rows: Rows<S>,
    coordinates: Vec<CoordinateResponse<S>>,
    connections: Vec<ConnectionResponse<S>>,
    contacts: Vec<ContactResponse<S>>,
}

/// Response of a coordinate to its forces.
#[derive(Clone, Copy, Debug)]
struct CoordinateResponse<S: Simd> {
    /// First of its numbers in [`Rows`].
    start: usize,
    /// Acceleration per torque.
    response: Lanes<S>,
    limit_divisor: Lanes<S>,
    loss_divisor: Lanes<S>,
    servo_divisor: Lanes<S>,
}

/// Response of a connection to its forces.
#[derive(Clone, Copy, Debug)]
struct ConnectionResponse<S: Simd> {
    /// Accelerations along the three axes per force along each.
    columns: [[Lanes<S>; 3]; 3],
    divisors: [Lanes<S>; 3],
}

/// Response of a contact to its forces.
#[derive(Clone, Copy, Debug)]
struct ContactResponse<S: Simd> {
    /// Accelerations along the three directions per force of each edge.
    columns: [[Lanes<S>; 3]; EDGES],
    divisors: [Lanes<S>; EDGES],
}

/// Progress of one sweep over all constraints.
#[derive(Clone, Copy, Debug)]
struct Sweep<S: Simd> {
    /// Worlds that are not settled yet. The others do not change any more, so that a world's result does not depend on how
    /// long its neighbours take.
    running: Mask<S>,
    /// Largest change of an acceleration.
    largest: Lanes<S>,
    /// Largest acceleration that the force of a constraint gives to it.
    scale: Lanes<S>,
}

impl<S: Simd> Sweep<S> {
    /// Notes a change of an acceleration.
    #[inline(always)]
    fn note_change(&mut self, change: Lanes<S>) {
        self.largest = self.largest.max(change.abs());
    }

    /// Notes the acceleration that the force of a constraint gives to it.
    #[inline(always)]
    fn note_effect(&mut self, acceleration: Lanes<S>) {
        self.scale = self.scale.max(acceleration.abs());
    }
}

impl<S: Simd> GaussSeidel<S> {
    pub(super) fn new(simd: S, structure: &Structure) -> Self {
        Self {
            rows: Rows::new(simd, structure),
            coordinates: Vec::with_capacity(structure.coordinates.len()),
            connections: Vec::with_capacity(structure.connections.len()),
            contacts: Vec::with_capacity(16),
        }
    }

    /// Changes whitened accelerations and the forces by all constraints.
    #[inline(always)]
    pub(super) fn solve(&mut self, problem: Problem<'_, S>, whitened: &mut [Lanes<S>]) {
        self.prepare(&problem);
        let Problem { structure, pairs, coordinates, connections, contacts, rows: contact_rows, .. } = problem;
        let rows = &self.rows;
        for (constraint, response) in coordinates.iter().zip(&self.coordinates) {
            let path = &structure.coordinates[constraint.coordinate].dofs;
            rows.add(response.start, path, constraint.torque(), whitened);
        }
        for (connection, node) in connections.iter().zip(&structure.connections) {
            contact_rows.add(connection.start, &node.dofs, &connection.forces_n, whitened);
        }
        for contact in &*contacts {
            contact_rows.add(contact.start, &pairs[contact.key.0 as usize].dofs, &contact.force(), whitened);
        }
        let zero = whitened[0].constant(0.0);
        let all = zero.less_than(zero.constant(1.0));
        let mut sweep = Sweep { running: all, largest: zero, scale: zero };
        for _ in 0..SWEEPS_MAX {
            sweep.largest = zero;
            for (constraint, response) in coordinates.iter_mut().zip(&self.coordinates) {
                response.update(constraint, rows, structure, whitened, &mut sweep);
            }
            for ((connection, response), node) in
                connections.iter_mut().zip(&self.connections).zip(&structure.connections)
            {
                response.update(connection, contact_rows, &node.dofs, whitened, &mut sweep);
            }
            for (contact, response) in contacts.iter_mut().zip(&self.contacts) {
                response.update(contact, contact_rows, &pairs[contact.key.0 as usize], whitened, &mut sweep);
            }
            let settled = (sweep.scale * SETTLED).max(zero.constant(SETTLED_MIN));
            sweep.running = sweep.running.and(settled.less_than(sweep.largest));
            if !sweep.running.any() {
                break;
            }
        }
    }

    /// Computes the responses.
    #[inline(always)]
    fn prepare(&mut self, problem: &Problem<'_, S>) {
        self.rows.numbers.clear();
        self.coordinates.clear();
        for (index, constraint) in problem.coordinates.iter().enumerate() {
            let start = self.rows.numbers.len();
            self.rows.push(problem.structure, problem.matrix, problem.coordinate(index));
            self.coordinates.push(CoordinateResponse::new(constraint, start, &self.rows));
        }
        self.connections.clear();
        for (connection, node) in problem.connections.iter().zip(&problem.structure.connections) {
            let rows = &problem.rows.numbers[connection.start..connection.start + node.dofs.len()];
            self.connections.push(ConnectionResponse::new(connection, rows));
        }
        self.contacts.clear();
        for (index, contact) in problem.contacts.iter().enumerate() {
            let rows = &problem.rows.numbers[contact.start..contact.start + problem.dofs(index).len()];
            self.contacts.push(ContactResponse::new(contact, rows));
        }
    }
}

impl<S: Simd> CoordinateResponse<S> {
    #[inline(always)]
    fn new(constraint: &CoordinateConstraint<S>, start: usize, rows: &Rows<S>) -> Self {
        let (zero, one) = (constraint.loss_nm.constant(0.0), constraint.loss_nm.constant(1.0));
        let mut response = zero;
        for number in &rows.numbers[start..] {
            response = number.mul_add(*number, response);
        }
        Self {
            start,
            response,
            limit_divisor: one / (response + constraint.limit.softness),
            loss_divisor: one / (response + constraint.loss.softness),
            servo_divisor: one / constraint.implicit_kgm2.mul_add(response, one),
        }
    }

    /// Solves for the torques of a coordinate while all other constraints stay as they are.
    #[inline(always)]
    fn update(
        &self,
        constraint: &mut CoordinateConstraint<S>,
        rows: &Rows<S>,
        structure: &Structure,
        whitened: &mut [Lanes<S>],
        sweep: &mut Sweep<S>,
    ) {
        let path = &structure.coordinates[constraint.coordinate].dofs;
        let before = constraint.torque();
        let mut acceleration = rows.product(self.start, path, whitened);
        let zero = acceleration.constant(0.0);
        if constraint.is_servo {
            let within = |torque: Lanes<S>| torque.min(constraint.max_nm).max(constraint.min_nm);
            // A servo that was taken for unsaturated: what keeps it within its limits at the present acceleration.
            // Taking its stiffness into account would be faster alone, but may diverge together with a contact.
            let free_nm = constraint.explicit_nm - constraint.implicit_kgm2 * acceleration;
            let of_free = within(free_nm) - free_nm;
            // A saturated one is a bounded soft constraint, whose torque changes the acceleration.
            let without = acceleration - self.response * constraint.servo_nm;
            let missing = constraint.explicit_nm - constraint.base_nm - constraint.implicit_kgm2 * without;
            let of_saturated = within(missing.mul_add(self.servo_divisor, constraint.base_nm)) - constraint.base_nm;
            let wanted = constraint.is_base_stiff.select(of_free, of_saturated);
            let change = sweep.running.keep(wanted - constraint.servo_nm);
            constraint.servo_nm += change;
            acceleration = self.response.mul_add(change, acceleration);
        }
        if constraint.loss_max_nm > 0.0 {
            let missing = constraint.loss.target - acceleration - constraint.loss.softness * constraint.loss_nm;
            let most = zero.constant(constraint.loss_max_nm);
            let wanted = missing.mul_add(self.loss_divisor, constraint.loss_nm).min(most).max(-most);
            let change = sweep.running.keep(wanted - constraint.loss_nm);
            constraint.loss_nm += change;
            acceleration = self.response.mul_add(change, acceleration);
        }
        let missing = constraint.limit.target
            - acceleration * constraint.limit_sign
            - constraint.limit.softness * constraint.limit_nm;
        let wanted = missing.mul_add(self.limit_divisor, constraint.limit_nm);
        let wanted = if constraint.is_fixed { wanted } else { wanted.max(zero) };
        constraint.limit_nm += sweep.running.and(constraint.is_beyond).keep(wanted - constraint.limit_nm);
        let change = constraint.torque() - before;
        sweep.note_change(change * self.response);
        sweep.note_effect(constraint.torque() * self.response);
        rows.add(self.start, path, sweep.running.keep(change), whitened);
    }
}

/// Returns the products of three rows with each other.
#[inline(always)]
fn products<S: Simd>(rows: &[[Lanes<S>; 3]], zero: Lanes<S>) -> [[Lanes<S>; 3]; 3] {
    let mut own = [[zero; 3]; 3];
    for row in rows {
        for (line, number) in own.iter_mut().zip(row) {
            for (sum, other) in line.iter_mut().zip(row) {
                *sum = number.mul_add(*other, *sum);
            }
        }
    }
    own
}

impl<S: Simd> ConnectionResponse<S> {
    #[inline(always)]
    fn new(connection: &ConnectionConstraint<S>, rows: &[[Lanes<S>; 3]]) -> Self {
        let (zero, one) = (connection.softness.constant(0.0), connection.softness.constant(1.0));
        let columns = products(rows, zero);
        let mut divisors = [zero; 3];
        for (axis, divisor) in divisors.iter_mut().enumerate() {
            *divisor = one / (columns[axis][axis] + connection.softness);
        }
        Self { columns, divisors }
    }

    /// Solves for the forces of a connection, one axis after the other, while all other constraints stay as they are.
    #[inline(always)]
    fn update(
        &self,
        connection: &mut ConnectionConstraint<S>,
        rows: &ContactRows<S>,
        dofs: &[u32],
        whitened: &mut [Lanes<S>],
        sweep: &mut Sweep<S>,
    ) {
        let before = connection.forces_n;
        let mut accelerations = rows.products(connection.start, dofs, whitened);
        let first = accelerations;
        for _ in 0..EDGE_PASSES {
            for axis in 0..3 {
                let force = connection.forces_n[axis];
                let missing = connection.targets[axis] - accelerations[axis] - connection.softness * force;
                let change = sweep.running.keep(missing * self.divisors[axis]);
                connection.forces_n[axis] += change;
                for (acceleration, response) in accelerations.iter_mut().zip(self.columns[axis]) {
                    *acceleration = response.mul_add(change, *acceleration);
                }
            }
        }
        let mut change = connection.forces_n;
        for (after, before) in change.iter_mut().zip(before) {
            *after -= before;
        }
        for axis in 0..3 {
            sweep.note_change(accelerations[axis] - first[axis]);
            sweep.note_effect(self.columns[axis][axis] * connection.forces_n[axis]);
        }
        rows.add(connection.start, dofs, &change, whitened);
    }
}

impl<S: Simd> ContactResponse<S> {
    #[inline(always)]
    fn new(contact: &ContactConstraint<S>, rows: &[[Lanes<S>; 3]]) -> Self {
        let (zero, one) = (contact.softness.constant(0.0), contact.softness.constant(1.0));
        let own = products(rows, zero);
        let mut response = Self { columns: [[zero; 3]; EDGES], divisors: [zero; EDGES] };
        for edge in 0..contact.edges {
            let (tangent, slope) = contact.slope(edge);
            let mut column = [zero; 3];
            for (number, line) in column.iter_mut().zip(&own) {
                *number = slope.mul_add(line[tangent], line[0]);
            }
            response.columns[edge] = column;
            response.divisors[edge] = one / (slope.mul_add(column[tangent], column[0]) + contact.softness);
        }
        response
    }

    /// Solves for the forces of the edges of a contact while all other constraints stay as they are.
    #[inline(always)]
    fn update(
        &self,
        contact: &mut ContactConstraint<S>,
        rows: &ContactRows<S>,
        pair: &PairNode,
        whitened: &mut [Lanes<S>],
        sweep: &mut Sweep<S>,
    ) {
        let before = contact.force();
        let mut accelerations = rows.products(contact.start, &pair.dofs, whitened);
        let first = accelerations;
        let zero = contact.softness.constant(0.0);
        let changing = sweep.running.and(contact.is_active);
        for _ in 0..EDGE_PASSES {
            for edge in 0..contact.edges {
                let (tangent, slope) = contact.slope(edge);
                let along = slope.mul_add(accelerations[tangent], accelerations[0]);
                let missing = contact.targets[edge] - along - contact.softness * contact.forces_n[edge];
                let wanted = missing.mul_add(self.divisors[edge], contact.forces_n[edge]).max(zero);
                let change = changing.keep(wanted - contact.forces_n[edge]);
                contact.forces_n[edge] += change;
                for (acceleration, response) in accelerations.iter_mut().zip(self.columns[edge]) {
                    *acceleration = response.mul_add(change, *acceleration);
                }
            }
            if contact.edges == 1 {
                break;
            }
        }
        for (after, before) in accelerations.into_iter().zip(first) {
            sweep.note_change(changing.keep(after - before));
        }
        sweep.note_effect(self.columns[0][0] * contact.force()[0]);
        let mut change = contact.force();
        for (after, before) in change.iter_mut().zip(before) {
            *after = changing.keep(*after - before);
        }
        rows.add(contact.start, &pair.dofs, &change, whitened);
    }
}
