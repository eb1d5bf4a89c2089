//! Limits, friction losses, servos' torque limits and contacts, solved together by projected Gauss-Seidel sweeps.
//!
//! Rows are whitened (see [`super::mass_matrix`]): a sweep works on accelerations in which every force acts by one row.
//! The problem is MuJoCo's: soft one-sided constraints on accelerations, whose solution is unique.

mod contacts;
mod coordinates;
mod rows;
mod softness;

use pulp::Simd;

use self::contacts::{ContactConstraint, ContactRows, EDGES};
use self::coordinates::{CoordinateConstraint, CoordinateForces};
use self::rows::{Rows, Sweep};
use super::forces::Forces;
use super::mass_matrix::MassMatrix;
use super::posture::Posture;
use super::structure::Structure;
use crate::collision::{Collisions, ContactKey, PairNode};
use crate::lanes::{Lanes, Vec3};

/// Upper bound of the sweeps over all constraints.
const SWEEPS_MAX: usize = 100;
/// The sweeps end when one changes no acceleration by more than this share of the largest acceleration that a force of the
/// constraints causes, or by more than [`SETTLED_MIN`].
const SETTLED: f64 = 1e-4;
/// Change of an acceleration (m/s² or rad/s²) that is always small enough.
const SETTLED_MIN: f64 = 1e-3;

/// Forces of a contact's edges in the step before.
type WarmContact<S> = (ContactKey, [Lanes<S>; EDGES]);

/// Constraints of one step, and workspace of the solver.
#[derive(Clone, Debug)]
pub(crate) struct Constraints<S: Simd> {
    coordinates: Vec<CoordinateConstraint<S>>,
    contacts: Vec<ContactConstraint<S>>,
    rows: Rows<S>,
    contact_rows: ContactRows<S>,
    /// Forces of the step before: first guesses.
    warm_coordinates: Vec<CoordinateForces<S>>,
    warm_contacts: Vec<WarmContact<S>>,
    start_velocity: Vec<Lanes<S>>,
    /// Whitened accelerations: first without constraints, then with them.
    pub(crate) whitened: Vec<Lanes<S>>,
    /// Factor on all friction coefficients.
    pub(crate) friction_scale: Lanes<S>,
    /// Largest change of an acceleration by the last sweep.
    pub(crate) residual: Lanes<S>,
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
            contacts: Vec::with_capacity(16),
            rows: Rows::new(simd, structure),
            contact_rows: ContactRows::new(simd, structure),
            warm_coordinates: vec![[zero; 3]; structure.coordinates.len()],
            warm_contacts: Vec::with_capacity(16),
            start_velocity: vec![zero; structure.dofs()],
            whitened: vec![zero; structure.dofs()],
            friction_scale: zero,
            residual: zero,
        }
    }

    /// Forgets the forces of the step before.
    pub(crate) fn forget(&mut self) {
        let zero = self.residual.constant(0.0);
        self.warm_coordinates.fill([zero; 3]);
        self.warm_contacts.clear();
        self.residual = zero;
    }

    /// Changes [`Self::whitened`] by all constraints. `middle` is the position in the middle of the step, where `posture` and
    /// `matrix` are; `velocity` is that of its start.
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
        step_s: f64,
    ) {
        self.rows.numbers.clear();
        coordinates::prepare(
            &mut self.coordinates,
            &mut self.rows,
            structure,
            matrix,
            &forces.hinges,
            middle,
            velocity,
            &self.warm_coordinates,
            step_s,
        );
        self.contact_rows.numbers.clear();
        self.contacts.clear();
        if !collisions.contacts.is_empty() {
            self.start_velocity.copy_from_slice(velocity);
            matrix.whiten(structure, &mut self.start_velocity);
            for contact in &collisions.contacts {
                let warm = self.warm_of(contact.key);
                let constraint = ContactConstraint::new(
                    &mut self.contact_rows,
                    structure,
                    posture,
                    matrix,
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
        self.sweep_until_settled(structure, pairs);
        let zero = self.residual.constant(0.0);
        self.warm_coordinates.fill([zero; 3]);
        for known in &self.coordinates {
            self.warm_coordinates[known.coordinate] = [known.limit_nm, known.loss_nm, known.servo_nm];
        }
        self.warm_contacts.clear();
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
        [self.residual.constant(0.0); EDGES]
    }

    #[inline(always)]
    fn sweep_until_settled(&mut self, structure: &Structure, pairs: &[PairNode]) {
        if self.coordinates.is_empty() && self.contacts.is_empty() {
            return;
        }
        let Self { coordinates, contacts, rows, contact_rows, whitened, .. } = self;
        for coordinate in &*coordinates {
            coordinate.apply(rows, structure, whitened);
        }
        for contact in &*contacts {
            contact.apply(contact_rows, &pairs[contact.key.0 as usize], whitened);
        }
        let zero = self.residual.constant(0.0);
        let all = zero.less_than(zero.constant(1.0));
        let mut sweep = Sweep { running: all, largest: zero, scale: zero };
        let mut residual = zero;
        for _ in 0..SWEEPS_MAX {
            sweep.largest = zero;
            for coordinate in &mut *coordinates {
                coordinate.update(rows, structure, whitened, &mut sweep);
            }
            for contact in &mut *contacts {
                contact.update(contact_rows, &pairs[contact.key.0 as usize], whitened, &mut sweep);
            }
            residual = sweep.running.select(sweep.largest, residual);
            let settled = (sweep.scale * SETTLED).max(zero.constant(SETTLED_MIN));
            sweep.running = sweep.running.and(settled.less_than(sweep.largest));
            if !sweep.running.any() {
                break;
            }
        }
        self.residual = self.residual.max(residual);
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

    /// Returns what the limit of a hinge's motors adds to their torque (N·m).
    #[inline(always)]
    pub(crate) fn servo_nm(&self, hinge: usize) -> Lanes<S> {
        self.warm_coordinates[hinge][2]
    }
}
