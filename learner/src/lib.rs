//! The learner: from rollouts to weights.
//!
//! # Layout, in the order of the data
//! - [`intake`]: validates fragments from the bus, answers them, and collects them into a batch.
//! - [`training`]: the loop: collect, update, save, publish, log. The mathematics is the crate `treadmill-ppo`.
//! - [`checkpoint`]: the whole state of a run, in one file.
//! - [`metrics`]: scalars and histograms, and where they are logged.
//!
//! The loop runs on its own thread. Nothing here is async, and nothing depends on the actor's crates.

pub mod checkpoint;
pub mod intake;
pub mod metrics;
pub mod training;
