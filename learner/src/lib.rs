//! Learner: trains the policy from the actors' rollout fragments.
//!
//! # Layout
//!
//! Each folder uses only those above it:
//! - [`waiting`]: waits of the training thread for a disk or a store, and how other threads see them.
//! - [`pool`]: the run's part in the pool of actors that belong to no run.
//! - [`intake`]: validates fragments from the bus, sends receipts, and collects a batch.
//! - [`checkpoint`]: the whole state of a run in one file.
//! - [`leadership`]: who may write the state of a run that is in a store.
//! - [`metrics`]: scalars and histograms, and their outputs.
//! - [`training`]: the loop: collect, update, save, publish, log. The crate `treadmill-ppo` holds the mathematics.
//!
//! The loop runs on its own thread. Nothing here is async, and nothing depends on the actor's crates.

pub mod checkpoint;
pub mod intake;
pub mod leadership;
pub mod metrics;
pub mod pool;
pub mod training;
pub mod waiting;
