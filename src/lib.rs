//! What the command line shares with the viewer, which is a program of its own (`watch/`).
//!
//! # Layout
//! - [`saved_policy`]: the policy of a run, a checkpoint or an exported file.
//! - [`network`]: flags about the network.
//! - [`operator`]: where a learner is, and patience until it answers.
//! - [`viewing`]: flags of `watch`.
//! - [`signals`]: Ctrl-C, once and twice.
//! - [`log`]: warnings on standard error.
//! - [`outcome`]: errors and exit codes.
//! - [`output`]: standard output that may be closed, and where the log goes.
//! - [`patience`]: long steps that say so.

pub mod log;
pub mod network;
pub mod operator;
pub mod outcome;
pub mod output;
pub mod patience;
pub mod saved_policy;
pub mod signals;
pub mod viewing;
