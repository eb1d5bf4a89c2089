//! Basics of every Treadmill process.
//!
//! # Layout
//! - [`seeds`]: named random streams, derived from the run's seed.
//! - [`run_folder`]: the folder with a run's files; [`run_lock`]: the right to write into it; [`holder`]: who has it.
//! - [`epoch`]: the terms of a run's learners.
//! - [`atomic_file`]: writes a file atomically.
//! - [`shutdown`]: stops every part of a process.
//! - [`error_chain`]: an error message with its causes.
//! - [`numbers`]: large numbers as people write and read them.
//! - [`words`]: quoted arguments and nearest names for messages.
//! - [`machine`]: facts about this machine, for benchmarks and status reports.

pub mod atomic_file;
pub mod epoch;
mod error_chain;
pub mod holder;
pub mod machine;
pub mod numbers;
pub mod program;
pub mod run_folder;
pub mod run_lock;
pub mod seeds;
pub mod shutdown;
pub mod words;

pub use error_chain::error_chain;
