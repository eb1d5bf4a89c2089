//! Hinges at the ends of their ranges, within a step without contacts.
//!
//! A limit is soft (see [`super::softness`]) for a stretch, and then hard.

use super::mass_matrix::MassMatrix;
use super::softness::{IMPEDANCE, settle};
use super::tree::{ROOT_DOFS, ROOT_POSITIONS, Tree};

/// How far beyond its end a hinge may be flung (rad). MuJoCo's own limits let a knee go 0.33 rad too far (99.9 % of
/// control steps under maximal random torques); up to here they are the same.
const STOP_RAD: f64 = 0.1;
/// Passes over all limits that are reached; their effects on each other are small.
const SWEEPS: usize = 8;

/// Workspace for the limits of a tree.
#[derive(Clone, Debug)]
pub(crate) struct Limits {
    reached: Vec<Reached>,
    /// `[reached][dofs]`: velocity change of the whole tree per unit of impulse.
    responses: Vec<f64>,
}

#[derive(Clone, Copy, Debug)]
struct Reached {
    dof: usize,
    /// +1 at the upper end, −1 at the lower one.
    outwards: f64,
    /// Outward rate aimed at (rad/s).
    target_radps: f64,
    /// Velocity change of the hinge itself per unit of impulse, with the limit's own softness.
    softened: f64,
    softness: f64,
    impulse_nms: f64,
}

impl Limits {
    pub(crate) fn new(tree: &Tree) -> Self {
        Self { reached: Vec::with_capacity(tree.hinges.len()), responses: vec![0.0; tree.hinges.len() * tree.dofs()] }
    }

    /// Changes the velocity at the end of a step so that limits act on it.
    pub(crate) fn hold(
        &mut self,
        tree: &Tree,
        matrix: &MassMatrix,
        position: &[f64],
        before: &[f64],
        after: &mut [f64],
        step_s: f64,
    ) {
        self.prepare(tree, matrix, position, before, after, step_s);
        if !self.reached.is_empty() {
            for _ in 0..SWEEPS {
                self.sweep(tree.dofs(), after);
            }
        }
    }

    /// Finds the limits that are reached, and what an impulse of each does.
    pub(super) fn prepare(
        &mut self,
        tree: &Tree,
        matrix: &MassMatrix,
        position: &[f64],
        before: &[f64],
        after: &[f64],
        step_s: f64,
    ) {
        self.find(tree, position, before, after, step_s);
        for (limit, response) in self.reached.iter_mut().zip(self.responses.chunks_exact_mut(tree.dofs())) {
            response.fill(0.0);
            response[limit.dof] = 1.0;
            matrix.solve(tree, response);
            let own = response[limit.dof];
            limit.softness = own * (1.0 - IMPEDANCE) / IMPEDANCE;
            limit.softened = own + limit.softness;
        }
    }

    /// One pass over all limits that are reached.
    pub(super) fn sweep(&mut self, dofs: usize, after: &mut [f64]) {
        for (limit, response) in self.reached.iter_mut().zip(self.responses.chunks_exact(dofs)) {
            let outward = after[limit.dof] * limit.outwards;
            let missing = limit.target_radps - outward + limit.softness * limit.impulse_nms;
            // The impulse is counted inwards: it can only be positive.
            let impulse = (limit.impulse_nms - missing / limit.softened).max(0.0);
            let change = impulse - limit.impulse_nms;
            limit.impulse_nms = impulse;
            for (rate, response) in after.iter_mut().zip(response) {
                *rate -= response * change * limit.outwards;
            }
        }
    }

    fn find(&mut self, tree: &Tree, position: &[f64], before: &[f64], after: &[f64], step_s: f64) {
        self.reached.clear();
        for (hinge, node) in tree.hinges.iter().enumerate() {
            let dof = ROOT_DOFS + hinge;
            let angle = position[ROOT_POSITIONS + hinge];
            let moved = step_s * (before[dof] + after[dof]) / 2.0;
            let (outwards, beyond) = if 2.0 * angle + moved > node.min_rad + node.max_rad {
                (1.0, angle - node.max_rad)
            } else {
                (-1.0, node.min_rad - angle)
            };
            let end = beyond + moved * outwards;
            if beyond <= 0.0 && end <= 0.0 {
                continue;
            }
            // Part of the step that is spent beyond the limit.
            let active_s = if beyond >= 0.0 { step_s } else { step_s * end / (end - beyond) };
            let (rate, start) = (before[dof] * outwards, beyond.max(0.0));
            let target_radps = settle(rate, start, active_s).min((STOP_RAD - start).max(0.0) / active_s);
            self.reached.push(Reached { dof, outwards, target_radps, softened: 0.0, softness: 0.0, impulse_nms: 0.0 });
        }
    }
}
