//! From rollouts to weights.
//!
//! # Layout, in the order of the data
//! - [`intake`]: fragments from the bus, judged, answered and gathered into a batch.
//! - [`gae`]: generalised advantage estimation, a pure function.
//! - [`ppo`]: the loss and the update.
//! - [`optimiser`]: Adam and gradient clipping over one flat slice.
//! - [`experience`]: fragments turned into what the update wants.
//! - [`mirror`]: left and right exchanged.
//! - [`training`]: the loop: collect, update, save, publish, log.
//! - [`pace`]: how much of what actors bring is learnt from, and how thoroughly.
//! - [`control`]: commands to the training thread, and how the run goes.
//! - [`pulse`]: a sign of life from the training thread.
//! - [`trial`]: policies that are evaluated while training goes on.
//! - [`checkpoint`]: everything a run is, in one file.
//! - [`room`]: waiting for a disk that is full.
//! - [`accounts`]: what became of every actor process's fragments, as a file.
//! - [`scalars`]: what is logged after each update.
//! - [`histograms`]: how actions and lags are spread.
//! - [`report`]: every place it goes to.
//! - [`logging`]: where it is logged to.
//!
//! The loop runs on a thread of its own; nothing here is async, and nothing depends on the actor's crates.

pub mod accounts;
pub mod checkpoint;
pub mod control;
pub mod episodes;
pub mod experience;
pub mod gae;
pub mod histograms;
pub mod intake;
pub mod logging;
pub mod mirror;
pub mod optimiser;
pub mod pace;
pub mod ppo;
pub mod pulse;
pub mod report;
pub mod room;
pub mod scalars;
pub mod training;
pub mod trial;
