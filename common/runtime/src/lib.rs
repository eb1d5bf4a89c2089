//! Basics of every Treadmill process.
//!
//! # Layout
//! - [`seeds`]: named random streams, derived from the run's seed.
//! - [`run_folder`]: the folder with a run's files.
//! - [`atomic_file`]: writes a file atomically.
//! - [`shutdown`]: stops every part of a process.
//! - [`error_chain`]: an error message with its causes.
//! - [`machine`]: facts about this machine, for benchmarks and status reports.

pub mod atomic_file;
mod error_chain;
pub mod machine;
pub mod run_folder;
pub mod seeds;
pub mod shutdown;

pub use error_chain::error_chain;
