//! Contact impulses in joint coordinates: from a first solution to what the body as a whole answers with.
//!
//! Contacts are as soft as [`super::softness`] says; friction lets sliding decay at the same pace, within a circular cone.
//! The impulses are found by projected Gauss-Seidel sweeps.

use nalgebra::Vector3;

use super::limits::Limits;
use super::mass_matrix::MassMatrix;
use super::posture::Posture;
use super::softness::{IMPEDANCE, settle, slide};
use super::spatial::Force;
use super::tree::{NO_DOF, ROOT_DOFS, Tree};

/// Sweeps over all contacts and limits.
const SWEEPS: usize = 12;
/// Contacts considered at once; a humanoid lying on the floor has about twenty.
const CONTACTS_MAX: usize = 64;
/// A direction that answers less than this to an impulse (1/kg) is one in which nothing can move.
const RESPONSE_MIN: f64 = 1e-9;
/// Directions of a contact: normal, and two across.
const DIRECTIONS: usize = 3;

/// One point at which two bodies, or a body and the floor, touch or are about to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactPoint {
    /// The bodies; `None` is the floor.
    pub(crate) bodies: [Option<usize>; 2],
    /// The links that touch, in the same order: what the contact is told under. They do not matter to the motion.
    pub(crate) links: [Option<usize>; 2],
    /// Where (m, relative to O).
    pub(crate) place_m: Vector3<f64>,
    /// Unit vector from the first body to the second.
    pub(crate) normal: Vector3<f64>,
    /// Distance between the surfaces (m); negative where they overlap.
    pub(crate) gap_m: f64,
    pub(crate) friction: f64,
    /// Impulse on the second body (N·s): a guess before, the solution afterwards.
    pub(crate) impulse_ns: Vector3<f64>,
}

/// The contacts of one step, and workspace to solve them.
#[derive(Clone, Debug)]
pub(crate) struct Contacts {
    pub(crate) points: Vec<ContactPoint>,
    solved: Vec<Solved>,
    /// `[contact][direction][dofs]`: rate of separation per rate of each degree of freedom.
    jacobians: Vec<f64>,
    /// The same size: velocity change of the whole body per unit of impulse.
    responses: Vec<f64>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Solved {
    directions: [Vector3<f64>; DIRECTIONS],
    impulses: [f64; DIRECTIONS],
    targets: [f64; DIRECTIONS],
    /// Own response of each direction, with the contact's softness.
    softened: [f64; DIRECTIONS],
    softness: [f64; DIRECTIONS],
}

impl Contacts {
    pub(crate) fn new(tree: &Tree) -> Self {
        let numbers = CONTACTS_MAX * DIRECTIONS * tree.dofs();
        Self {
            points: Vec::with_capacity(CONTACTS_MAX),
            solved: Vec::with_capacity(CONTACTS_MAX),
            jacobians: vec![0.0; numbers],
            responses: vec![0.0; numbers],
        }
    }

    /// Adds a point to this step's; beyond a bound that no posture of a body with a few parts reaches, it is left out.
    pub(crate) fn push(&mut self, point: ContactPoint) {
        if self.points.len() < CONTACTS_MAX {
            self.points.push(point);
        }
    }

    /// Changes the velocity at the end of a step so that contacts and limits act on it.
    ///
    /// `before` is the velocity at its start, `after` that of the flight. Returns whether anything was in reach.
    #[expect(clippy::too_many_arguments, reason = "the state of a step is of many parts")]
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
        self.select(tree, posture, before, after, step_s);
        if self.points.is_empty() {
            return false;
        }
        let dofs = tree.dofs();
        self.solved.clear();
        for index in 0..self.points.len() {
            self.prepare(tree, matrix, index, before, step_s);
        }
        for (solved, responses) in self.solved.iter().zip(self.responses.chunks_exact(DIRECTIONS * dofs)) {
            for (impulse, response) in solved.impulses.iter().zip(responses.chunks_exact(dofs)) {
                add(after, response, *impulse);
            }
        }
        limits.prepare(tree, matrix, position, before, after, step_s);
        for _ in 0..SWEEPS {
            self.sweep(dofs, after);
            limits.sweep(dofs, after);
        }
        for (point, solved) in self.points.iter_mut().zip(&self.solved) {
            point.impulse_ns = solved.directions.iter().zip(solved.impulses).map(|(d, impulse)| d * impulse).sum();
        }
        true
    }

    /// Momentum that the floor gave, with the moment about a place (m, relative to O).
    pub(crate) fn momentum(&self, about_m: &Vector3<f64>) -> Force {
        let mut sum = Force::default();
        for point in &self.points {
            let given = Force::at(&(point.place_m - about_m), point.impulse_ns, Vector3::zeros());
            match point.bodies {
                [None, Some(_)] => sum += given,
                [Some(_), None] => sum -= given,
                _ => {}
            }
        }
        sum
    }

    /// Keeps the points that are reached within the step, and writes their Jacobians.
    fn select(&mut self, tree: &Tree, posture: &Posture, before: &[f64], after: &[f64], step_s: f64) {
        let dofs = tree.dofs();
        let mut kept = 0;
        for index in 0..self.points.len() {
            let point = self.points[index];
            let row = &mut self.jacobians[kept * DIRECTIONS * dofs..][..DIRECTIONS * dofs];
            for (direction, row) in directions(&point.normal).iter().zip(row.chunks_exact_mut(dofs)) {
                write_jacobian(tree, posture, &point, direction, row);
            }
            let closing = step_s * (dot(&row[..dofs], before) + dot(&row[..dofs], after)) / 2.0;
            if point.gap_m.min(point.gap_m + closing) < 0.0 || point.impulse_ns != Vector3::zeros() {
                self.points[kept] = point;
                kept += 1;
            }
        }
        self.points.truncate(kept);
    }

    fn prepare(&mut self, tree: &Tree, matrix: &MassMatrix, index: usize, before: &[f64], step_s: f64) {
        let dofs = tree.dofs();
        let point = &self.points[index];
        let span = index * DIRECTIONS * dofs..(index + 1) * DIRECTIONS * dofs;
        let (jacobian, response) = (&self.jacobians[span.clone()], &mut self.responses[span]);
        let mut solved = Solved { directions: directions(&point.normal), ..Solved::default() };
        for (direction, (row, response)) in jacobian.chunks_exact(dofs).zip(response.chunks_exact_mut(dofs)).enumerate()
        {
            response.copy_from_slice(row);
            matrix.solve(tree, response);
            let own = dot(row, response);
            if own <= RESPONSE_MIN {
                // No joint moves the bodies against each other in this direction.
                solved.softened[direction] = f64::INFINITY;
                continue;
            }
            solved.softness[direction] = own * (1.0 - IMPEDANCE) / IMPEDANCE;
            solved.softened[direction] = own + solved.softness[direction];
            solved.impulses[direction] = solved.directions[direction].dot(&point.impulse_ns);
            let rate = dot(row, before);
            solved.targets[direction] =
                if direction == 0 { approach(rate, point.gap_m, step_s) } else { slide(rate, step_s) };
        }
        self.solved.push(solved);
    }

    fn sweep(&mut self, dofs: usize, velocity: &mut [f64]) {
        let rows = self.jacobians.chunks_exact(DIRECTIONS * dofs).zip(self.responses.chunks_exact(DIRECTIONS * dofs));
        for (((jacobian, responses), solved), point) in rows.zip(&mut self.solved).zip(&self.points) {
            let wanted = |solved: &Solved, direction: usize, velocity: &[f64]| {
                let rate = dot(&jacobian[direction * dofs..][..dofs], velocity);
                let missing =
                    solved.targets[direction] - rate - solved.softness[direction] * solved.impulses[direction];
                solved.impulses[direction] + missing / solved.softened[direction]
            };
            let normal = wanted(solved, 0, velocity).max(0.0);
            add(velocity, &responses[..dofs], normal - solved.impulses[0]);
            solved.impulses[0] = normal;
            let mut across = [wanted(solved, 1, velocity), wanted(solved, 2, velocity)];
            let (size, most) = (across[0].hypot(across[1]), point.friction * normal);
            if size > most {
                across = across.map(|part| if size > 0.0 { part * most / size } else { 0.0 });
            }
            for (direction, impulse) in [1, 2].into_iter().zip(across) {
                let response = &responses[direction * dofs..][..dofs];
                add(velocity, response, impulse - solved.impulses[direction]);
                solved.impulses[direction] = impulse;
            }
        }
    }
}

/// Rate of separation (m/s) that a contact aims at.
fn approach(rate_mps: f64, gap_m: f64, step_s: f64) -> f64 {
    if gap_m <= 0.0 {
        return settle(rate_mps, gap_m, step_s);
    }
    // Only the part of the step after the surfaces have met counts.
    let end_m = gap_m + step_s * rate_mps;
    let active_s = if end_m < 0.0 { step_s * end_m / (end_m - gap_m) } else { 0.0 };
    settle(rate_mps, 0.0, active_s)
}

/// The normal and two unit vectors across it.
fn directions(normal: &Vector3<f64>) -> [Vector3<f64>; DIRECTIONS] {
    let along = if normal.z.abs() < 0.7 { Vector3::z() } else { Vector3::x() };
    let first = (along - normal * normal.dot(&along)).normalize();
    [*normal, first, normal.cross(&first)]
}

fn write_jacobian(tree: &Tree, posture: &Posture, point: &ContactPoint, direction: &Vector3<f64>, row: &mut [f64]) {
    row.fill(0.0);
    for (body, sign) in point.bodies.iter().zip([-1.0, 1.0]) {
        let Some(body) = body else { continue };
        let mut dof = tree.innermost_dof(*body);
        while dof != NO_DOF {
            row[dof as usize] += sign * posture.axes[dof as usize].at(&point.place_m).dot(direction);
            dof = tree.dof_parents[dof as usize];
        }
    }
    if point.bodies.iter().all(Option::is_some) {
        // Contacts within the body do not move it as a whole; rounding must not either.
        row[..ROOT_DOFS].fill(0.0);
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn add(to: &mut [f64], what: &[f64], factor: f64) {
    for (to, what) in to.iter_mut().zip(what) {
        *to += what * factor;
    }
}
