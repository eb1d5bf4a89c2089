//! What learner and actor must agree on.
//!
//! # Layout
//! - [`config`]: every key, in two stages: text as given, then values checked.
//! - [`device`]: where the networks are computed.
//! - [`policy`]: the networks: shape, parameters, forward pass.
//! - [`normaliser`]: running statistics of observations and values.
//! - [`exported`]: a policy with all that is needed to play it, as one safetensors file.
//! - [`onnx`]: the same as an ONNX model.
//! - [`bus`]: sessions, keys and flows; the only place that names Zenoh.
//! - [`seeds`]: named random streams from the run's seed.
//! - [`run_folder`]: where a run keeps its files.
//! - `open_json`: infinite numbers in JSON.
//! - [`atomic_file`]: files that are either whole or absent.
//! - [`shutdown`]: one way to ask every part to stop.
//! - [`machine`]: what hardware this is, for benchmark sheets.

pub mod atomic_file;
pub mod bus;
pub mod config;
pub mod device;
pub mod exported;
pub mod machine;
pub mod normaliser;
pub mod onnx;
mod open_json;
pub mod policy;
pub mod run_folder;
pub mod seeds;
pub mod shutdown;
