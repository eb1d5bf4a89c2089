//! Hinges at the ends of their ranges, within a step without contacts.
//!
//! As in MuJoCo a limit is a soft constraint: once passed it pulls back like a critically damped spring, and takes
//! over a share `IMPEDANCE` of whatever pushes against it ("Computation" chapter of MuJoCo's documentation: solver
//! parameters; the figures are those of MJCF's defaults `solref` 0.02 1 and `solimp` 0.9 0.95).

use super::mass_matrix::MassMatrix;
use super::tree::{ROOT_DOFS, ROOT_POSITIONS, Tree};

/// Share of a force against the limit that the limit takes over.
const IMPEDANCE: f64 = 0.95;
/// Time constant of the pull-back (s).
const TIME_S: f64 = 0.02;
/// How much stronger the friction is for a hinge that is still on its way out: MuJoCo's own would let a knee that is flung
/// against its end go 0.33 rad beyond (99.9 % of control steps under maximal random torques).
const BRAKE: f64 = 4.0;
/// Friction of the limit (1/s): 2 / (impedance × time constant).
const DAMPING_PER_S: f64 = 2.0 / (IMPEDANCE * TIME_S);
/// Spring of the limit (1/s²): 1 / (impedance × time constant × damping ratio)².
const STIFFNESS_PER_S2: f64 = 1.0 / ((IMPEDANCE * TIME_S) * (IMPEDANCE * TIME_S));
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
        self.find(tree, position, before, after, step_s);
        if self.reached.is_empty() {
            return;
        }
        let dofs = tree.dofs();
        for (limit, response) in self.reached.iter_mut().zip(self.responses.chunks_exact_mut(dofs)) {
            response.fill(0.0);
            response[limit.dof] = 1.0;
            matrix.solve(tree, response);
            let own = response[limit.dof];
            limit.softness = own * (1.0 - IMPEDANCE) / IMPEDANCE;
            limit.softened = own + limit.softness;
        }
        for _ in 0..SWEEPS {
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
            let damping = if rate > 0.0 { BRAKE * DAMPING_PER_S } else { DAMPING_PER_S };
            // Implicit in time, so that a long step cannot overshoot.
            let target_radps = (rate - active_s * STIFFNESS_PER_S2 * start)
                / (1.0 + active_s * damping + active_s * active_s * STIFFNESS_PER_S2);
            self.reached.push(Reached { dof, outwards, target_radps, softened: 0.0, softness: 0.0, impulse_nms: 0.0 });
        }
    }
}
