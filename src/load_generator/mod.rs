//! Load generator of `bench bus`: real connections into the learner's real intake, which accepts without training.
//!
//! # Layout
//! - [`load_step`]: starts the processes for one number of actors and measures them.
//! - [`host`]: process with the learner's intake. [`load`]: processes that play actors.
//! - [`helper`]: starts such a process and exchanges lines with it.
//! - [`workload`]: the fragment and the policies that are sent.
//! - [`raw`]: TCP without a bus, for comparison. [`usage`]: processor time and memory of this process.

mod helper;
pub(crate) mod host;
pub(crate) mod load;
pub(crate) mod load_step;
pub(crate) mod raw;
mod usage;
mod workload;
