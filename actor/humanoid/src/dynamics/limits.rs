//! Hinge limits within a step without contacts.
//!
//! A limit is soft (see [`super::softness`]) up to [`STOP_RAD`] beyond its end, and then hard.

use super::mass_matrix::MassMatrix;
use super::rows::{add_scaled, dot, stride};
use super::softness::{IMPEDANCE, damped_rate};
use super::tree::{ROOT_DOFS, ROOT_POSITIONS, Tree};

/// Excess of a hinge beyond its range at which the limit becomes hard (rad). MuJoCo's limits are soft throughout: there a
/// knee exceeds its range by up to 0.33 rad (99.9 % of control steps under maximal random torques).
const STOP_RAD: f64 = 0.1;
/// Upper bound of the passes over all active limits.
const SWEEPS_MAX: usize = 50;
/// The passes end when one changes no hinge's rate by more than this (rad/s).
const SETTLED_RADPS: f64 = 1e-7;

/// Workspace for the limits of a tree.
#[derive(Clone, Debug)]
pub(crate) struct Limits {
    active: Vec<ActiveLimit>,
    /// `[active][stride]`: whitened row of the hinge, see [`super::mass_matrix`].
    rows: Vec<f64>,
    /// Velocity at the end of the step, whitened.
    whitened: Vec<f64>,
    dofs: usize,
}

#[derive(Clone, Copy, Debug, Default)]
struct ActiveLimit {
    dof: usize,
    /// +1 at the upper end, −1 at the lower one.
    outwards: f64,
    /// Target outward rate (rad/s).
    target_radps: f64,
    /// Velocity change of the hinge itself per unit of impulse.
    response: f64,
    softness: f64,
    impulse_nms: f64,
}

impl Limits {
    pub(crate) fn new(tree: &Tree) -> Self {
        let (dofs, stride) = (tree.dofs(), stride(tree.dofs()));
        Self {
            active: Vec::with_capacity(tree.hinges.len()),
            rows: vec![0.0; tree.hinges.len() * stride],
            whitened: vec![0.0; stride],
            dofs,
        }
    }

    /// Applies limits to the velocity `after` at the end of a step; `before` is that at its start.
    pub(crate) fn solve(
        &mut self,
        tree: &Tree,
        matrix: &MassMatrix,
        position: &[f64],
        before: &[f64],
        after: &mut [f64],
        step_s: f64,
    ) {
        self.prepare(tree, matrix, position, before, after, step_s);
        if self.active.is_empty() {
            return;
        }
        let mut whitened = std::mem::take(&mut self.whitened);
        whitened[..self.dofs].copy_from_slice(after);
        matrix.whiten(tree, &mut whitened);
        for _ in 0..SWEEPS_MAX {
            if self.sweep(&mut whitened) < SETTLED_RADPS {
                break;
            }
        }
        matrix.unwhiten(tree, &mut whitened);
        after.copy_from_slice(&whitened[..self.dofs]);
        self.whitened = whitened;
    }

    /// Finds the active limits and their responses to an impulse.
    pub(super) fn prepare(
        &mut self,
        tree: &Tree,
        matrix: &MassMatrix,
        position: &[f64],
        before: &[f64],
        after: &[f64],
        step_s: f64,
    ) {
        self.find_active(tree, position, before, after, step_s);
        let stride = stride(self.dofs);
        for (limit, row) in self.active.iter_mut().zip(self.rows.chunks_exact_mut(stride)) {
            row.fill(0.0);
            row[limit.dof] = limit.outwards;
            matrix.whiten_row(tree, row);
            limit.response = dot(row, row);
            limit.softness = limit.response * (1.0 - IMPEDANCE) / IMPEDANCE;
        }
    }

    /// Makes one pass over all active limits; returns its largest change of a hinge's rate (rad/s).
    pub(super) fn sweep(&mut self, whitened: &mut [f64]) -> f64 {
        let stride = stride(self.dofs);
        let mut largest_radps: f64 = 0.0;
        for (limit, row) in self.active.iter_mut().zip(self.rows.chunks_exact(stride)) {
            let missing = limit.target_radps - dot(row, whitened) + limit.softness * limit.impulse_nms;
            // The impulse acts inwards and cannot be negative.
            let impulse = (limit.impulse_nms - missing / (limit.response + limit.softness)).max(0.0);
            let change = impulse - limit.impulse_nms;
            limit.impulse_nms = impulse;
            add_scaled(whitened, row, -change);
            largest_radps = largest_radps.max(change.abs() * limit.response);
        }
        largest_radps
    }

    fn find_active(&mut self, tree: &Tree, position: &[f64], before: &[f64], after: &[f64], step_s: f64) {
        self.active.clear();
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
            // Time of the step beyond the limit.
            let active_s = if beyond >= 0.0 { step_s } else { step_s * end / (end - beyond) };
            let (rate, start) = (before[dof] * outwards, beyond.max(0.0));
            let target_radps = damped_rate(rate, start, active_s).min((STOP_RAD - start).max(0.0) / active_s);
            self.active.push(ActiveLimit { dof, outwards, target_radps, ..ActiveLimit::default() });
        }
    }
}
