//! What several commands and the viewer (`watch/`) use.
//!
//! # Layout
//! - [`saved_policy`]: reads the policy of a run, a checkpoint or an exported file.
//! - [`network_args`]: flags about the network.
//! - [`learner_address`]: flags that say where a learner is, and a session with it.
//! - [`viewer_args`]: flags of `watch`.

pub mod learner_address;
pub mod network_args;
pub mod saved_policy;
pub mod viewer_args;
