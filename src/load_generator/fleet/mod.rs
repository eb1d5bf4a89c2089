//! Played fleet of `bench fleet`: a real learner with real updates among actors that do not simulate.
//!
//! A played actor behaves on the bus as a real one does. It does not simulate: a fragment is ready when a real actor of the
//! given rate would have finished it.
//!
//! # Layout
//! - [`actors`]: process of many played actors. [`actor`]: one of them.
//! - [`pace`]: time that simulation takes. [`policy`]: transitions under each policy version. [`counts`]: what became of them.
//! - [`processes`]: learner and routers as child processes, and their use of the machine.
//! - [`run_metrics`]: follows the learner's metrics.
//! - [`measure`]: starts the processes, sets the rates and marks the measured window.
//! - [`figures`]: figures of the measured window.

mod actor;
pub(crate) mod actors;
mod counts;
mod figures;
pub(crate) mod measure;
mod pace;
mod policy;
mod processes;
mod run_metrics;

/// Name of the run on the bus.
pub(crate) const RUN: &str = "fleet";
