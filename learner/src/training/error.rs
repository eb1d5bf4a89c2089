//! Error that ends training.

use std::io;

use treadmill_bus::BusError;
use treadmill_ppo::UpdateError;

use crate::{checkpoint::CheckpointError, leadership::LeadershipError};

/// Why training stopped early.
#[derive(Debug, thiserror::Error)]
pub enum TrainingError {
    /// The bus failed.
    #[error(transparent)]
    Bus(#[from] BusError),
    /// The state could not be saved.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// Another learner has taken the run over, or the store failed.
    #[error(transparent)]
    Leadership(#[from] LeadershipError),
    /// A log could not be written.
    #[error("the logs of the run cannot be written")]
    Log(#[from] io::Error),
    /// The networks could not be evaluated.
    #[error("the networks cannot be evaluated")]
    Inference(#[source] UpdateError),
    /// A GPU cannot compute updates.
    #[error(transparent)]
    Gpu(#[from] treadmill_gpu::GpuError),
    /// Too many updates in a row were undone.
    #[error("{updates} updates in a row were undone; the last sound checkpoint stays in place")]
    Undone {
        /// Number of updates.
        updates: u32,
        /// Error of the last update.
        source: UpdateError,
    },
    /// The state is inconsistent.
    #[error("the state of the run cannot be used: {why}")]
    State {
        /// What is wrong.
        why: String,
    },
}
