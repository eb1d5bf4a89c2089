//! Load generator of `bench bus`, real connections into the learner's real intake without training; and of `bench fleet`.
//!
//! # Layout
//! - [`fleet`]: played actors around a real learner, for `bench fleet`. The others are for `bench bus`.
//! - [`load_step`]: starts the processes for one number of actors and measures them.
//! - [`host`]: process with the learner's intake. [`load`]: processes that simulate actors.
//! - [`helper`]: starts these processes and exchanges lines with them.
//! - [`workload`]: the fragment and the policies that are sent.
//! - [`raw`]: plain TCP for comparison. [`usage`]: processor time and memory of this process.

pub(crate) mod fleet;
pub(crate) mod helper;
pub(crate) mod host;
pub(crate) mod load;
pub(crate) mod load_step;
pub(crate) mod raw;
mod usage;
mod workload;
