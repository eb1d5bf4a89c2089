//! Modules that several commands use.
//!
//! # Layout
//! - [`saved_policy`]: the policy of a run, a checkpoint or an exported file.
//! - [`saved_run`]: a checkpoint of a run in a folder or a store.
//! - [`network_args`]: flags of the network.
//! - [`learner_address`]: flags that locate a learner, and a session with it.
//! - [`model_file`]: flags about the file of a robot.
//! - [`motion_file`]: flags about motions, and their files.
//! - `existing_file`: reads a flag that names a file.
//! - `foreign_text`: makes text from another machine safe to print, and shortens names.

pub(crate) mod existing_file;
pub(crate) mod foreign_text;
pub mod learner_address;
pub mod model_file;
pub mod motion_file;
pub mod network_args;
pub mod saved_policy;
pub mod saved_run;
