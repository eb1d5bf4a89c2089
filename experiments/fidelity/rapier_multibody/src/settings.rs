//! Settings of a simulation.

use serde::Deserialize;

/// Length of a control step (s).
pub const CONTROL_STEP_S: f64 = 0.015;

/// Entry `config` of a case; the flags of `--speed` have the same names.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MultibodySettings {
    /// Physics steps per control step.
    pub substeps: u32,
    /// Rapier divides each physics step into this many steps of its own, each with one pass over all constraints.
    pub solver_iterations: usize,
    pub self_collision: bool,
    /// Whether the root link's frame lies at its centre of mass; see [`crate::single`].
    pub root_at_centre: bool,
    /// Whether to calculate in double precision.
    pub double: bool,
}

impl Default for MultibodySettings {
    fn default() -> Self {
        Self { substeps: 5, solver_iterations: 4, self_collision: true, root_at_centre: true, double: false }
    }
}
