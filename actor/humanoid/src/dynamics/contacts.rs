//! Contact impulses in joint coordinates, refined from a first guess by projected Gauss-Seidel sweeps.
//!
//! Contacts are soft (see [`super::softness`]). Friction makes sliding decay with the same time constant, within a circular
//! cone.

use nalgebra::Vector3;

use super::limits::Limits;
use super::mass_matrix::MassMatrix;
use super::posture::Posture;
use super::rows::{add_scaled, dot, stride};
use super::softness::{IMPEDANCE, damped_rate, sliding_rate};
use super::spatial::{Force, Motion};
use super::tree::{ROOT_DOFS, Tree};

/// Sweeps over all contacts and limits.
const SWEEPS: usize = 12;
/// Upper bound of the contacts per step; a humanoid lying on the floor has about twenty.
const CONTACTS_MAX: usize = 64;
/// Response to an impulse (1/kg) below which a direction counts as immovable.
const RESPONSE_MIN: f64 = 1e-9;
/// Directions of a contact: the normal and two tangents.
const DIRECTIONS: usize = 3;

/// Point at which two bodies, or a body and the floor, touch or are about to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactPoint {
    /// The bodies; `None` is the floor.
    pub(crate) bodies: [Option<usize>; 2],
    /// Their links, in the same order; for reports only.
    pub(crate) links: [Option<usize>; 2],
    /// Position relative to O (m).
    pub(crate) position_m: Vector3<f64>,
    /// Unit vector from the first body to the second.
    pub(crate) normal: Vector3<f64>,
    /// Distance between the surfaces (m); negative where they overlap.
    pub(crate) gap_m: f64,
    pub(crate) friction: f64,
    /// Impulse on the second body (N·s): first a guess, then the solution.
    pub(crate) impulse_ns: Vector3<f64>,
}

/// Contacts of one step, and workspace of the solver.
#[derive(Clone, Debug)]
pub(crate) struct Contacts {
    pub(crate) points: Vec<ContactPoint>,
    constraints: Vec<Constraint>,
    /// `[contact][direction][stride]`: whitened rows, see [`super::mass_matrix`].
    rows: Vec<f64>,
    /// Velocity at the end of the step, whitened.
    whitened: Vec<f64>,
    velocities: [Vec<Motion>; 2],
}

#[derive(Clone, Copy, Debug, Default)]
struct Constraint {
    directions: [Vector3<f64>; DIRECTIONS],
    impulses: [f64; DIRECTIONS],
    targets: [f64; DIRECTIONS],
    /// Response of each direction to its own impulse, plus its softness.
    softened: [f64; DIRECTIONS],
    softness: [f64; DIRECTIONS],
}

impl Contacts {
    pub(crate) fn new(tree: &Tree) -> Self {
        let (stride, still) = (stride(tree.dofs()), vec![Motion::default(); tree.nodes.len()]);
        Self {
            points: Vec::with_capacity(CONTACTS_MAX),
            constraints: Vec::with_capacity(CONTACTS_MAX),
            rows: vec![0.0; CONTACTS_MAX * DIRECTIONS * stride],
            whitened: vec![0.0; stride],
            velocities: [still.clone(), still],
        }
    }

    /// Adds a point; discards it when there are already [`CONTACTS_MAX`].
    pub(crate) fn push(&mut self, point: ContactPoint) {
        if self.points.len() < CONTACTS_MAX {
            self.points.push(point);
        }
    }

    /// Applies contacts and limits to the velocity at the end of a step; returns whether any contact was within reach.
    ///
    /// `before` is the velocity at the start of the step, `after` that at the end of the flight.
    #[expect(clippy::too_many_arguments, reason = "the state of a step has many parts")]
    pub(crate) fn solve(
        &mut self,
        tree: &Tree,
        posture: &Posture,
        matrix: &MassMatrix,
        limits: &mut Limits,
        position: &[f64],
        before: &[f64],
        after: &mut [f64],
        step_s: f64,
    ) -> bool {
        let [at_start, at_end] = &mut self.velocities;
        posture.velocities(tree, before, at_start);
        posture.velocities(tree, after, at_end);
        self.select(step_s);
        if self.points.is_empty() {
            return false;
        }
        self.constraints.clear();
        for index in 0..self.points.len() {
            self.prepare(tree, posture, matrix, index, step_s);
        }
        let dofs = tree.dofs();
        self.whitened[..dofs].copy_from_slice(after);
        matrix.whiten(tree, &mut self.whitened);
        for (constraint, rows) in self.constraints.iter().zip(self.rows.chunks_exact(DIRECTIONS * self.whitened.len()))
        {
            for (impulse, row) in constraint.impulses.iter().zip(rows.chunks_exact(self.whitened.len())) {
                add_scaled(&mut self.whitened, row, *impulse);
            }
        }
        after.copy_from_slice(&self.whitened[..dofs]);
        matrix.unwhiten(tree, after);
        limits.prepare(tree, matrix, position, before, after, step_s);
        for _ in 0..SWEEPS {
            self.sweep();
            limits.sweep(&mut self.whitened);
        }
        matrix.unwhiten(tree, &mut self.whitened);
        after.copy_from_slice(&self.whitened[..dofs]);
        for (point, constraint) in self.points.iter_mut().zip(&self.constraints) {
            point.impulse_ns =
                constraint.directions.iter().zip(constraint.impulses).map(|(d, impulse)| d * impulse).sum();
        }
        true
    }

    /// Returns the floor's total impulse, with the moment about a point (m, relative to O).
    pub(crate) fn floor_impulse(&self, about_m: &Vector3<f64>) -> Force {
        let mut sum = Force::default();
        for point in &self.points {
            let impulse = Force::at(&(point.position_m - about_m), point.impulse_ns, Vector3::zeros());
            match point.bodies {
                [None, Some(_)] => sum += impulse,
                [Some(_), None] => sum -= impulse,
                _ => {}
            }
        }
        sum
    }

    /// Keeps the points at which the surfaces meet within the step, or that have a guess other than zero.
    fn select(&mut self, step_s: f64) {
        let [at_start, at_end] = &self.velocities;
        self.points.retain(|point| {
            let closing_mps = point.normal.dot(&(separation(point, at_start) + separation(point, at_end))) / 2.0;
            point.gap_m.min(point.gap_m + step_s * closing_mps) < 0.0 || point.impulse_ns != Vector3::zeros()
        });
    }

    fn prepare(&mut self, tree: &Tree, posture: &Posture, matrix: &MassMatrix, index: usize, step_s: f64) {
        let stride = self.whitened.len();
        let point = &self.points[index];
        let rows = &mut self.rows[index * DIRECTIONS * stride..][..DIRECTIONS * stride];
        let mut constraint = Constraint { directions: directions(&point.normal), ..Constraint::default() };
        write_jacobians(tree, posture, point, &constraint.directions, rows);
        let rate_mps = separation(point, &self.velocities[0]);
        for (direction, row) in rows.chunks_exact_mut(stride).enumerate() {
            matrix.whiten_row(tree, row);
            let own = dot(row, row);
            if own <= RESPONSE_MIN {
                // No joint moves the bodies relative to each other in this direction.
                row.fill(0.0);
                constraint.softened[direction] = f64::INFINITY;
                continue;
            }
            constraint.softness[direction] = own * (1.0 - IMPEDANCE) / IMPEDANCE;
            constraint.softened[direction] = own + constraint.softness[direction];
            constraint.impulses[direction] = constraint.directions[direction].dot(&point.impulse_ns);
            let rate = constraint.directions[direction].dot(&rate_mps);
            constraint.targets[direction] =
                if direction == 0 { target_rate(rate, point.gap_m, step_s) } else { sliding_rate(rate, step_s) };
        }
        self.constraints.push(constraint);
    }

    fn sweep(&mut self) {
        let stride = self.whitened.len();
        let velocity = &mut self.whitened[..];
        for ((rows, constraint), point) in
            self.rows.chunks_exact(DIRECTIONS * stride).zip(&mut self.constraints).zip(&self.points)
        {
            let row = |direction: usize| &rows[direction * stride..][..stride];
            let updated = |constraint: &Constraint, direction: usize, velocity: &[f64]| {
                let missing = constraint.targets[direction]
                    - dot(row(direction), velocity)
                    - constraint.softness[direction] * constraint.impulses[direction];
                constraint.impulses[direction] + missing / constraint.softened[direction]
            };
            let normal = updated(constraint, 0, velocity).max(0.0);
            add_scaled(velocity, row(0), normal - constraint.impulses[0]);
            constraint.impulses[0] = normal;
            let mut tangential = [updated(constraint, 1, velocity), updated(constraint, 2, velocity)];
            let size = (tangential[0] * tangential[0] + tangential[1] * tangential[1]).sqrt();
            let size_max = point.friction * normal;
            if size > size_max {
                tangential = tangential.map(|part| if size > 0.0 { part * size_max / size } else { 0.0 });
            }
            for (direction, impulse) in [1, 2].into_iter().zip(tangential) {
                add_scaled(velocity, row(direction), impulse - constraint.impulses[direction]);
                constraint.impulses[direction] = impulse;
            }
        }
    }
}

/// Returns the velocity of the second body's point relative to the first one's (m/s).
fn separation(point: &ContactPoint, velocities: &[Motion]) -> Vector3<f64> {
    let [first, second] =
        point.bodies.map(|body| body.map_or(Vector3::zeros(), |body| velocities[body].at(&point.position_m)));
    second - first
}

/// Returns a contact's target rate of separation (m/s).
fn target_rate(rate_mps: f64, gap_m: f64, step_s: f64) -> f64 {
    if gap_m <= 0.0 {
        return damped_rate(rate_mps, gap_m, step_s);
    }
    // The contact acts only after the surfaces have met.
    let end_m = gap_m + step_s * rate_mps;
    let active_s = if end_m < 0.0 { step_s * end_m / (end_m - gap_m) } else { 0.0 };
    damped_rate(rate_mps, 0.0, active_s)
}

/// Returns the normal and two unit vectors perpendicular to it.
fn directions(normal: &Vector3<f64>) -> [Vector3<f64>; DIRECTIONS] {
    let along = if normal.z.abs() < 0.7 { Vector3::z() } else { Vector3::x() };
    let first = (along - normal * normal.dot(&along)).normalize();
    [*normal, first, normal.cross(&first)]
}

/// Writes one row per direction: the rate of separation per rate of each degree of freedom.
fn write_jacobians(
    tree: &Tree,
    posture: &Posture,
    point: &ContactPoint,
    directions: &[Vector3<f64>; DIRECTIONS],
    rows: &mut [f64],
) {
    rows.fill(0.0);
    let stride = rows.len() / DIRECTIONS;
    for (body, sign) in point.bodies.iter().zip([-1.0, 1.0]) {
        let Some(body) = body else { continue };
        for dof in tree.path_of_body(*body) {
            let moved = posture.axes[*dof as usize].at(&point.position_m) * sign;
            for (row, direction) in directions.iter().enumerate() {
                rows[row * stride + *dof as usize] += moved.dot(direction);
            }
        }
    }
    if point.bodies.iter().all(Option::is_some) {
        // Contacts between two bodies do not move the humanoid as a whole; neither must rounding.
        for row in rows.chunks_exact_mut(stride) {
            row[..ROOT_DOFS].fill(0.0);
        }
    }
}
