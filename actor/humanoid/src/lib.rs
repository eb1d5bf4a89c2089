//! Treadmill: the humanoid environment.
//!
//! A humanoid on a floor, simulated by Rapier with the task of Gymnasium's Humanoid-v5: the built-in one with 17 joints,
//! or any that an MJCF text describes.
//! No Zenoh, no tokio, no Candle: evaluation, benchmarks and the Python package use this crate too.
//!
//! # Layout
//! - [`environment`]: owns time. Episodes, resets, faults; the entry point.
//! - [`task`]: reward and end of an episode, as pure functions.
//! - [`observation`]: what the policy sees.
//! - [`physics`]: named quantities of the simulated body; the only place in the project that names Rapier.
//! - [`model`]: MJCF text → bodies, hinge chains, motors.
//! - `dynamics`: how an articulated body moves between contacts.
//! - `chain`: frames of a chain of hinges.
//! - [`randomisation`]: what differs from episode to episode, so that a policy depends on none of it.
//! - [`config`], [`error`]: what can be set, and what is refused.

pub mod config;
pub mod environment;
pub mod error;
pub mod model;
pub mod observation;
pub mod physics;
pub mod randomisation;
pub mod task;

mod chain;
mod dynamics;

pub use config::{CONTROL_STEP_S, EnvironmentConfig};
pub use environment::Environment;
pub use error::ModelError;
pub use model::{HUMANOID_XML, Model, read_model_file};
pub use observation::OBSERVATION_SIZE_COMPACT;
pub use physics::{JointQuality, Physics, PhysicsFault, Variation};
pub use randomisation::Randomisation;
pub use task::{Step, StepInfo};
