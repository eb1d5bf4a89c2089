//! Contact impulses in joint coordinates: from a first solution to what the body as a whole answers with.
//!
//! Contacts are as soft as [`super::softness`] says; friction lets sliding decay at the same pace, within a circular cone.
//! The impulses are found by projected Gauss-Seidel sweeps.

use nalgebra::Vector3;

use super::limits::Limits;
use super::mass_matrix::MassMatrix;
use super::posture::Posture;
use super::rows::{add, dot, stride};
use super::softness::{IMPEDANCE, settle, slide};
use super::spatial::{Force, Motion};
use super::tree::{ROOT_DOFS, Tree};

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
    /// `[contact][direction][stride]`: whitened rows, see [`super::mass_matrix`].
    rows: Vec<f64>,
    /// Velocity at the end of the step, whitened.
    whitened: Vec<f64>,
    velocities: [Vec<Motion>; 2],
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
        let (stride, still) = (stride(tree.dofs()), vec![Motion::default(); tree.nodes.len()]);
        Self {
            points: Vec::with_capacity(CONTACTS_MAX),
            solved: Vec::with_capacity(CONTACTS_MAX),
            rows: vec![0.0; CONTACTS_MAX * DIRECTIONS * stride],
            whitened: vec![0.0; stride],
            velocities: [still.clone(), still],
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
        let [at_start, at_end] = &mut self.velocities;
        posture.velocities(tree, before, at_start);
        posture.velocities(tree, after, at_end);
        self.select(step_s);
        if self.points.is_empty() {
            return false;
        }
        self.solved.clear();
        for index in 0..self.points.len() {
            self.prepare(tree, posture, matrix, index, step_s);
        }
        let dofs = tree.dofs();
        self.whitened[..dofs].copy_from_slice(after);
        matrix.whiten(tree, &mut self.whitened);
        for (solved, rows) in self.solved.iter().zip(self.rows.chunks_exact(DIRECTIONS * self.whitened.len())) {
            for (impulse, row) in solved.impulses.iter().zip(rows.chunks_exact(self.whitened.len())) {
                add(&mut self.whitened, row, *impulse);
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

    /// Keeps the points that are reached within the step.
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
        let mut solved = Solved { directions: directions(&point.normal), ..Solved::default() };
        write_jacobians(tree, posture, point, &solved.directions, rows);
        let rate_mps = separation(point, &self.velocities[0]);
        for (direction, row) in rows.chunks_exact_mut(stride).enumerate() {
            matrix.whiten_row(tree, row);
            let own = dot(row, row);
            if own <= RESPONSE_MIN {
                // No joint moves the bodies against each other in this direction.
                row.fill(0.0);
                solved.softened[direction] = f64::INFINITY;
                continue;
            }
            solved.softness[direction] = own * (1.0 - IMPEDANCE) / IMPEDANCE;
            solved.softened[direction] = own + solved.softness[direction];
            solved.impulses[direction] = solved.directions[direction].dot(&point.impulse_ns);
            let rate = solved.directions[direction].dot(&rate_mps);
            solved.targets[direction] =
                if direction == 0 { approach(rate, point.gap_m, step_s) } else { slide(rate, step_s) };
        }
        self.solved.push(solved);
    }

    fn sweep(&mut self) {
        let stride = self.whitened.len();
        let velocity = &mut self.whitened[..];
        for ((rows, solved), point) in
            self.rows.chunks_exact(DIRECTIONS * stride).zip(&mut self.solved).zip(&self.points)
        {
            let row = |direction: usize| &rows[direction * stride..][..stride];
            let wanted = |solved: &Solved, direction: usize, velocity: &[f64]| {
                let missing = solved.targets[direction]
                    - dot(row(direction), velocity)
                    - solved.softness[direction] * solved.impulses[direction];
                solved.impulses[direction] + missing / solved.softened[direction]
            };
            let normal = wanted(solved, 0, velocity).max(0.0);
            add(velocity, row(0), normal - solved.impulses[0]);
            solved.impulses[0] = normal;
            let mut across = [wanted(solved, 1, velocity), wanted(solved, 2, velocity)];
            let size = (across[0] * across[0] + across[1] * across[1]).sqrt();
            let most = point.friction * normal;
            if size > most {
                across = across.map(|part| if size > 0.0 { part * most / size } else { 0.0 });
            }
            for (direction, impulse) in [1, 2].into_iter().zip(across) {
                add(velocity, row(direction), impulse - solved.impulses[direction]);
                solved.impulses[direction] = impulse;
            }
        }
    }
}

/// Velocity (m/s) with which the second body's point moves away from the first one's.
fn separation(point: &ContactPoint, velocities: &[Motion]) -> Vector3<f64> {
    let [first, second] =
        point.bodies.map(|body| body.map_or(Vector3::zeros(), |body| velocities[body].at(&point.place_m)));
    second - first
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

/// Writes rates of separation per rate of each degree of freedom, a row for each direction.
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
            let moved = posture.axes[*dof as usize].at(&point.place_m) * sign;
            for (row, direction) in directions.iter().enumerate() {
                rows[row * stride + *dof as usize] += moved.dot(direction);
            }
        }
    }
    if point.bodies.iter().all(Option::is_some) {
        // Contacts within the body do not move it as a whole; rounding must not either.
        for row in rows.chunks_exact_mut(stride) {
            row[..ROOT_DOFS].fill(0.0);
        }
    }
}
