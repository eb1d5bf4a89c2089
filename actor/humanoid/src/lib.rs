//! Treadmill: the humanoid environment.
//!
//! Rapier simulates a humanoid on a floor with the tasks of Gymnasium's Humanoid-v5 and -v4: the built-in one with 17
//! joints, or any that an MJCF text describes. This crate depends on neither Zenoh, tokio nor Candle, so that evaluation,
//! benchmarks and the Python package can use it too.
//!
//! # Layout
//! - [`environment`]: the entry point; episodes, resets, faults.
//! - [`task`]: reward and end of an episode, as pure functions.
//! - [`info`]: a step in detail, under Gymnasium's names.
//! - [`observation`]: numbers that the policy observes.
//! - [`physics`]: named quantities of the simulated humanoid; the only place in the project that names Rapier.
//! - [`model`]: MJCF text → bodies, hinge chains, motors.
//! - `dynamics`: motion of the articulated body between contacts.
//! - `randomisation`: draws each episode's model, sensor noise, delays and pushes from its seed.
//! - [`config`], [`error`]: settings and errors.
//!
//! # Links and bodies
//! A *link* is a `<body>` of the model text (a link in URDF). A *body* is a rigid body: one link, or several that are welded
//! together because no joint lies between them.

pub mod config;
pub mod environment;
pub mod error;
pub mod info;
pub mod model;
pub mod observation;
pub mod physics;
pub mod task;

mod dynamics;
mod randomisation;

pub use config::{
    CONTROL_STEP_S, EnvironmentConfig, ObservationKind, PHYSICS_VERSION, PhysicsSettings, Randomisation, RewardTask,
};
pub use environment::{Environment, EnvironmentSnapshot, EpisodeState};
pub use error::{InputError, ModelError, SnapshotError, StateError};
pub use info::{InfoValue, StepInfo};
pub use model::{HUMANOID_XML, Model, mirror::Mirror, read_model_file};
pub use observation::{OBSERVATION_SIZE_COMPACT, Observation};
pub use physics::{ContactForce, JointQuality, Physics, PhysicsFault, PhysicsSnapshot, Variation};
pub use task::StepOutcome;
