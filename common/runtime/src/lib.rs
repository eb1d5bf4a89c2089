//! What every Treadmill process needs from its machine.
//!
//! # Layout
//! - [`seeds`]: named random streams, derived from the run's seed.
//! - [`run_folder`]: where a run keeps its files.
//! - [`atomic_file`]: writes a file whole or not at all.
//! - [`shutdown`]: asks every part of a process to stop.
//! - [`error_chain`]: an error's message with its causes.
//! - [`machine`]: hardware facts for benchmark sheets.

pub mod atomic_file;
mod error_chain;
pub mod machine;
pub mod run_folder;
pub mod seeds;
pub mod shutdown;

pub use error_chain::error_chain;
