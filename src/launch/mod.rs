//! Starting and hosting a run, and process-wide services of every command.
//!
//! # Layout
//! - Before a run: `run_args` (flags), `startup` (from flags to a run that is ready), `prepared` (that run), `begin` (a
//!   new run), `warm_start` (from another run's policy or state), `resumption` (loads a saved run and compares the
//!   flags with it), `model` (the robot), `automatic` (settings that follow from its size), `choice` (those that follow
//!   from the machine), `external_task` (waits for the task that the first actor registers), `banner` (text printed
//!   before and after a run).
//! - During a run: `host` (a learner with actors beside it), `films` (of the newest policy), `durability` (a host whose
//!   state is in a store), `standby` (waits until it is time to lead), `supervisor` (restarts actor processes),
//!   `bus_client` (flags and session of an actor or evaluator), `router_session` (session of a learner or router),
//!   `metrics_page` (metrics over HTTP).
//! - The process: `async_runtime`, [`child`] (processes that end with this one), `familiar_flags` (hints for flags of
//!   other programs), `processor` (refuses one that is too old), [`memory`] (allocator settings), `restart` (starts the
//!   program anew), [`exit_code`], [`signals`], [`log`], [`output`], [`slow_step`], [`terminal_screen`].

pub(crate) mod async_runtime;
pub(crate) mod automatic;
pub(crate) mod banner;
pub(crate) mod begin;
pub(crate) mod bus_client;
pub mod child;
pub(crate) mod choice;
pub(crate) mod durability;
pub mod exit_code;
pub(crate) mod external_task;
pub(crate) mod familiar_flags;
mod films;
pub(crate) mod host;
pub mod link_page;
pub mod log;
pub mod memory;
pub(crate) mod metrics_page;
pub(crate) mod model;
pub mod output;
pub(crate) mod prepared;
pub(crate) mod processor;
pub(crate) mod restart;
pub mod resume_line;
pub(crate) mod resumption;
pub(crate) mod router_session;
pub(crate) mod run_args;
pub mod signals;
pub mod slow_step;
pub(crate) mod standby;
pub(crate) mod startup;
pub(crate) mod supervisor;
pub mod terminal_screen;
pub(crate) mod warm_start;
