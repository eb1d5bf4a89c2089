//! Inputs and result of a training run.

use std::sync::{Arc, atomic::AtomicU64};

use treadmill_runtime::run_folder::RunFolder;

use crate::{
    checkpoint::TrainingState,
    metrics::{History, PartTimes, ReportOptions},
    waiting::Heartbeat,
};

/// Inputs of training besides the initial state.
pub struct TrainingOptions {
    /// Folder of the run.
    pub folder: RunFolder,
    /// Term of this learner: higher than that of any earlier learner of the run.
    pub epoch: u64,
    /// Environment steps of the run after which this start ends. The saved configuration may have more.
    pub steps: u64,
    /// Device that computes updates.
    pub device: treadmill_ppo::device::Device,
    /// Outputs of metrics.
    pub report: ReportOptions,
    /// Actor processes that the supervisor has restarted.
    pub restarts: Arc<AtomicU64>,
    /// Heartbeat of the training thread.
    pub heartbeat: Heartbeat,
    /// Names of an action's entries; entries without a name are shown by their number.
    pub action_names: Vec<String>,
}

/// Result of a training run.
#[derive(Clone, Debug)]
pub struct TrainingSummary {
    /// Final state.
    pub state: TrainingState,
    /// Seconds since this process started training.
    pub wall_s: f64,
    /// Environment steps since this process started training.
    pub env_steps: u64,
    /// Whether shutdown was requested before the last step.
    pub stopped: bool,
    /// Returns, distances and errors so far.
    pub history: History,
    /// Times of the parts over the last updates.
    pub parts: PartTimes,
}

impl TrainingSummary {
    /// Summary of a start that has nothing left to do.
    pub fn finished(state: TrainingState) -> Self {
        Self {
            state,
            wall_s: 0.0,
            env_steps: 0,
            stopped: false,
            history: History::default(),
            parts: PartTimes::default(),
        }
    }
}
