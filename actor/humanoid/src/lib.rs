//! Treadmill: the humanoid environment.
//!
//! A humanoid on a floor, simulated by Rapier with the tasks of Gymnasium's Humanoid-v5 and -v4: the built-in one with 17
//! joints, or any that an MJCF text describes.
//! No Zenoh, no tokio, no Candle: evaluation, benchmarks and the Python package use this crate too.
//!
//! # Layout
//! - [`environment`]: owns time. Episodes, resets, faults; the entry point.
//! - [`task`]: reward and end of an episode, as pure functions.
//! - [`info`]: a step in detail, under Gymnasium's names.
//! - [`observation`]: what the policy sees.
//! - [`physics`]: named quantities of the simulated body; the only place in the project that names Rapier.
//! - [`model`]: MJCF text → bodies, hinge chains, motors.
//! - `dynamics`: how an articulated body moves between contacts.
//! - [`randomisation`]: what differs from episode to episode, so that a policy depends on none of it.
//! - [`config`], [`error`]: what can be set, and what is refused.

pub mod config;
pub mod environment;
pub mod error;
pub mod info;
pub mod model;
pub mod observation;
pub mod physics;
pub mod randomisation;
pub mod task;

mod dynamics;

pub use config::{CONTROL_STEP_S, EnvironmentConfig, ObservationKind, Task};
pub use environment::{Environment, EnvironmentSnapshot, EpisodeState};
pub use error::{InputError, ModelError, SnapshotError, StateError};
pub use info::{InfoValue, StepInfo};
pub use model::{HUMANOID_XML, Model, mirror::Mirror, read_model_file};
pub use observation::{OBSERVATION_SIZE_COMPACT, Observation};
pub use physics::{ContactForce, JointQuality, Physics, PhysicsFault, PhysicsSnapshot, Variation};
pub use randomisation::Randomisation;
pub use task::Step;
