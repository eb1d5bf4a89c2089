//! Limits, friction losses, servos' torque limits, equalities and contacts, solved together.
//!
//! The problem is MuJoCo's: soft constraints on accelerations, most of them one-sided, whose solution is unique.
//!
//! - `coordinates`, `connections`, `contacts`, `softness`: the problem.
//! - `newton` with `hessian`, `gauss_seidel` with `rows`: its solution, by the model's choice.

mod connections;
mod contacts;
mod coordinates;
mod gauss_seidel;
mod hessian;
mod newton;
mod rows;
mod softness;

use self::connections::ConnectionConstraint;
use self::contacts::{ContactConstraint, ContactRows, EDGES};
use self::coordinates::{CoordinateConstraint, CoordinateForces};
use self::gauss_seidel::GaussSeidel;
use self::hessian::DOFS_MAX;
use self::newton::Newton;
use super::forces::Forces;
use crate::articulation::{Coordinate, MassMatrix, Posture, Structure};
use crate::collision::{Collisions, ContactKey, PairNode};
use crate::lanes::{Lanes, Mask, Simd, Vec3};
use crate::model::Solver;

/// Forces of a contact's edges in the step before.
type WarmContact<S> = (ContactKey, [Lanes<S>; EDGES]);

/// Constraints of one step, and workspace of the solver.
#[derive(Clone, Debug)]
pub(crate) struct Constraints<S: Simd> {
    coordinates: Vec<CoordinateConstraint<S>>,
    /// One per connection of the structure.
    connections: Vec<ConnectionConstraint<S>>,
    contacts: Vec<ContactConstraint<S>>,
    /// Rows of connections, then of contacts.
    contact_rows: ContactRows<S>,
    method: Method<S>,
    /// Forces of the step before: first guesses of sweeps.
    warm_coordinates: Vec<CoordinateForces<S>>,
    warm_connections: Vec<[Lanes<S>; 3]>,
    warm_contacts: Vec<WarmContact<S>>,
    start_velocity: Vec<Lanes<S>>,
    /// Whitened accelerations: first without constraints, then with them.
    pub(crate) whitened: Vec<Lanes<S>>,
    /// Factor on all friction coefficients.
    pub(crate) friction_scale: Lanes<S>,
}

/// Workspace of the chosen method.
#[derive(Clone, Debug)]
enum Method<S: Simd> {
    Newton(Box<Newton<S>>),
    GaussSeidel(GaussSeidel<S>),
}

/// Constraints of a step.
struct Problem<'a, S: Simd> {
    structure: &'a Structure,
    pairs: &'a [PairNode],
    /// Mass matrix, factored.
    matrix: &'a MassMatrix<S>,
    coordinates: &'a mut [CoordinateConstraint<S>],
    connections: &'a mut [ConnectionConstraint<S>],
    contacts: &'a mut [ContactConstraint<S>],
    /// Rows of connections and contacts, whitened for sweeps only.
    rows: &'a ContactRows<S>,
}

impl<S: Simd> Problem<'_, S> {
    #[inline(always)]
    fn coordinate(&self, index: usize) -> &Coordinate {
        &self.structure.coordinates[self.coordinates[index].coordinate]
    }

    #[inline(always)]
    fn dofs(&self, contact: usize) -> &[u32] {
        &self.pairs[self.contacts[contact].key.0 as usize].dofs
    }

    /// Returns the worlds that have a constraint; `number` is any.
    #[inline(always)]
    fn constrained(&self, number: Lanes<S>) -> Mask<S> {
        let mut worlds = number.less_than(number);
        if !self.connections.is_empty() {
            worlds = number.constant(0.0).less_than(number.constant(1.0));
        }
        for constraint in &*self.coordinates {
            worlds = worlds.or(constraint.is_active);
        }
        for contact in &*self.contacts {
            worlds = worlds.or(contact.is_active);
        }
        worlds
    }
}

/// Force of one contact point in several worlds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Load<S: Simd> {
    /// Index into the pairs that can touch.
    pub(crate) pair: usize,
    /// Position relative to O (m).
    pub(crate) point_m: Vec3<S>,
    /// Force on the pair's first body (N); 0 in worlds where the point does not touch.
    pub(crate) force_n: Vec3<S>,
}

impl<S: Simd> Constraints<S> {
    pub(crate) fn new(simd: S, structure: &Structure) -> Self {
        let zero = Lanes::zero(simd);
        Self {
            coordinates: Vec::with_capacity(structure.coordinates.len()),
            connections: Vec::with_capacity(structure.connections.len()),
            contacts: Vec::with_capacity(16),
            contact_rows: ContactRows::new(simd, structure),
            method: match structure.solver {
                Solver::Newton if structure.dofs() <= DOFS_MAX => {
                    Method::Newton(Box::new(Newton::new(simd, structure)))
                }
                _ => Method::GaussSeidel(GaussSeidel::new(simd, structure)),
            },
            warm_coordinates: vec![[zero; 3]; structure.coordinates.len()],
            warm_connections: vec![[zero; 3]; structure.connections.len()],
            warm_contacts: Vec::with_capacity(16),
            start_velocity: vec![zero; structure.dofs()],
            whitened: vec![zero; structure.dofs()],
            friction_scale: zero,
        }
    }

    /// Forgets the forces of the step before.
    #[inline(always)]
    pub(crate) fn forget(&mut self) {
        self.warm_coordinates.fill([self.friction_scale.constant(0.0); 3]);
        self.warm_connections.fill([self.friction_scale.constant(0.0); 3]);
        self.warm_contacts.clear();
    }

    /// Notes the mass matrix of a step before it is factored.
    #[inline(always)]
    pub(crate) fn note_masses(&mut self, matrix: &MassMatrix<S>) {
        if let Method::Newton(newton) = &mut self.method {
            newton.note_masses(matrix);
        }
    }

    /// Changes [`Self::whitened`] by all constraints. `middle` is the position in the middle of the step, where
    /// `posture` and `matrix` are; `velocity` is that of its start; `acceleration` is a guess.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "the state of a step has many parts")]
    pub(crate) fn solve(
        &mut self,
        structure: &Structure,
        pairs: &[PairNode],
        posture: &Posture<S>,
        matrix: &MassMatrix<S>,
        forces: &Forces<S>,
        collisions: &Collisions<S>,
        middle: &[Lanes<S>],
        velocity: &[Lanes<S>],
        acceleration: &[Lanes<S>],
        step_s: f64,
    ) {
        let warm = &self.warm_coordinates;
        coordinates::prepare(&mut self.coordinates, structure, &forces.hinges, middle, velocity, warm, step_s);
        self.contact_rows.numbers.clear();
        self.connections.clear();
        self.contacts.clear();
        let whitening = match self.method {
            Method::Newton(_) => None,
            Method::GaussSeidel(_) => Some(matrix),
        };
        if !(collisions.contacts.is_empty() && structure.connections.is_empty()) {
            self.start_velocity.copy_from_slice(velocity);
            if whitening.is_some() {
                matrix.whiten(structure, &mut self.start_velocity);
            }
            for (node, warm) in structure.connections.iter().zip(&self.warm_connections) {
                self.connections.push(ConnectionConstraint::new(
                    &mut self.contact_rows,
                    structure,
                    posture,
                    whitening,
                    node,
                    &self.start_velocity,
                    warm,
                    step_s,
                ));
            }
            for contact in &collisions.contacts {
                let warm = self.warm_of(contact.key);
                let constraint = ContactConstraint::new(
                    &mut self.contact_rows,
                    structure,
                    posture,
                    whitening,
                    &pairs[contact.key.0 as usize],
                    contact,
                    self.friction_scale,
                    &self.start_velocity,
                    &warm,
                    step_s,
                );
                self.contacts.push(constraint);
            }
        }
        if !(self.coordinates.is_empty() && self.connections.is_empty() && self.contacts.is_empty()) {
            let Self { coordinates, connections, contacts, contact_rows: rows, method, whitened, .. } = self;
            let problem = Problem { structure, pairs, matrix, coordinates, connections, contacts, rows };
            match method {
                Method::Newton(newton) => newton.solve(problem, acceleration, whitened),
                Method::GaussSeidel(sweeps) => sweeps.solve(problem, whitened),
            }
        }
        self.forget();
        for known in &self.coordinates {
            self.warm_coordinates[known.coordinate] = [known.limit_nm, known.loss_nm, known.servo_nm];
        }
        for (known, connection) in self.warm_connections.iter_mut().zip(&self.connections) {
            *known = connection.forces_n;
        }
        for contact in &self.contacts {
            self.warm_contacts.push((contact.key, contact.forces_n));
        }
    }

    /// Returns the forces of a contact in the step before.
    #[inline(always)]
    fn warm_of(&self, key: ContactKey) -> [Lanes<S>; EDGES] {
        for (known, forces) in &self.warm_contacts {
            if *known == key {
                return *forces;
            }
        }
        [self.friction_scale.constant(0.0); EDGES]
    }

    /// Writes the forces of all contact points of the last solve.
    #[inline(always)]
    pub(crate) fn write_loads(&self, loads: &mut Vec<Load<S>>) {
        loads.clear();
        for contact in &self.contacts {
            let [normal, first, second] = contact.force();
            let [n, t, b] = &contact.frame;
            let force_n = *n * normal + *t * first + *b * second;
            loads.push(Load { pair: contact.key.0 as usize, point_m: contact.point_m, force_n });
        }
    }

    /// Adds to a moment those of all connections in the last solve, times `duration`.
    #[inline(always)]
    pub(crate) fn add_moments(&self, moment: &mut Vec3<S>, duration: Lanes<S>) {
        for connection in &self.connections {
            *moment += connection.moment_nm() * duration;
        }
    }

    /// Returns what the limit of a hinge's motors adds to their torque (N·m).
    #[inline(always)]
    pub(crate) fn servo_nm(&self, hinge: usize) -> Lanes<S> {
        self.warm_coordinates[hinge][2]
    }
}
