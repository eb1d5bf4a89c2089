//! Accounts of experience on its way from an actor to a learner, as state machines: events in, actions out. Nothing
//! here does input or output, reads a clock or starts a thread, so the shipped programs and the simulations in tests
//! run the same code.
//!
//! # Layout, in the order of the data
//! - [`delivery`]: an actor's fragments, from produced to durable.
//! - [`ledger`]: the fragments that a learner has handled, of every actor process.
//! - [`lineage`]: the policy versions that a learner's newest one descends from.
//! - [`pool`]: division of actors that belong to no run among the runs.

pub mod delivery;
pub mod ledger;
pub mod lineage;
pub mod pool;
