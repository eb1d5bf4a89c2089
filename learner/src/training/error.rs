//! Why training stops early.

use std::io;

use treadmill_bus::BusError;
use treadmill_ppo::UpdateError;

use crate::{checkpoint::CheckpointError, metrics::CurveError};

/// Why training stopped early.
#[derive(Debug, thiserror::Error)]
pub enum TrainingError {
    /// The bus failed.
    #[error(transparent)]
    Bus(#[from] BusError),
    /// The state could not be saved.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// A log could not be written.
    #[error("the logs of the run cannot be written: {0}")]
    Log(#[from] io::Error),
    /// The networks could not be evaluated.
    #[error("the networks cannot be evaluated: {0}")]
    Evaluation(#[from] candle_core::Error),
    /// Update after update was undone.
    #[error("{updates} updates in a row were undone, the last because {why}; the last sound checkpoint stays in place")]
    NotFinite {
        /// How many.
        updates: u32,
        /// What was not finite.
        why: UpdateError,
    },
    /// The state does not fit together.
    #[error("the state of the run cannot be used: {why}")]
    State {
        /// What is wrong.
        why: String,
    },
    /// The picture could not be drawn.
    #[error("the learning curve cannot be drawn: {0}")]
    Curve(#[from] CurveError),
}
