//! What learning needs beside its state.

use std::sync::Arc;

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use treadmill_policy::CHUNK_ROWS;

use crate::device::Device;

/// What learning needs beside its state.
#[derive(Clone, Debug)]
pub struct PpoOptions {
    /// Device that computes gradients.
    pub device: Device,
    /// Threads of the update on a CPU; the results do not depend on their number.
    pub pool: Arc<ThreadPool>,
    /// Rows of a gradient step that a thread takes at a time.
    pub chunk_rows: usize,
    /// Limit of normalised observations.
    pub observation_clip: f32,
}

impl PpoOptions {
    /// Returns options for a CPU.
    ///
    /// # Errors
    /// If the threads cannot be started.
    pub fn on_cpu(threads: usize) -> Result<Self, ThreadPoolBuildError> {
        let builder = ThreadPoolBuilder::new().thread_name(|index| format!("update-{index}"));
        let pool = builder.num_threads(threads).build()?;
        Ok(Self { device: Device::Cpu, pool: Arc::new(pool), chunk_rows: CHUNK_ROWS, observation_clip: 10.0 })
    }
}
