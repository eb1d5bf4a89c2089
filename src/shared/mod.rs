//! Modules that several commands and the viewer (`watch/`) use.
//!
//! # Layout
//! - [`saved_policy`]: the policy of a run, a checkpoint or an exported file.
//! - [`network_args`]: flags of the network.
//! - [`learner_address`]: flags that locate a learner, and a session with it.
//! - [`viewer_args`]: flags of `watch`.

pub mod learner_address;
pub mod network_args;
pub mod saved_policy;
pub mod viewer_args;
