//! Treadmill: the humanoid environment.
//!
//! Simulates humanoids with the tasks of Gymnasium's Humanoid-v5 and -v4: the built-in one with 17 joints, or any that an
//! MJCF text describes. Rapier finds what touches; the equations of motion are ours. One pass simulates several humanoids,
//! one per lane of a vector register.
//!
//! This crate depends on neither Zenoh, tokio nor Candle, so that evaluation, benchmarks and the Python package can use it
//! too.
//!
//! # Layout
//! - [`environment`]: the entry point; episodes, resets, faults; steps of several environments together.
//! - [`task`]: what is observed and rewarded, and when an episode ends.
//! - [`info`]: a step in detail, under Gymnasium's names.
//! - [`observation`]: observations of Gymnasium's tasks.
//! - [`physics`]: named quantities of the simulated humanoid.
//! - [`model`]: bodies, hinge chains, motors, pairs of shapes that may touch.
//! - [`mjcf`]: MJCF text → model.
//! - [`home`]: examination of the pose in which episodes start.
//! - [`card`]: robot cards, which complete a model by servos and a default pose.
//! - [`motion`]: motions to imitate, from files.
//! - `terrain`: generated ground.
//! - `articulation`: a model as a tree of bodies: paths, poses, mass matrix.
//! - `dynamics`: motion of articulated bodies with their constraints.
//! - `collision`: contact points; the only module of the workspace that names Rapier.
//! - `lanes`: numbers of several worlds side by side.
//! - `randomisation`: draws each episode's model, sensor noise, delays and pushes from its seed.
//! - [`config`], [`error`]: settings and errors.
//!
//! # Links and bodies
//! A *link* is a `<body>` of the model text (a link in URDF). A *body* is a rigid body: one link, or several that are welded
//! together because no joint lies between them.

pub mod card;
pub mod config;
pub mod environment;
pub mod error;
pub mod home;
pub mod info;
pub mod mjcf;
pub mod model;
pub mod motion;
pub mod observation;
pub mod physics;
pub mod task;

mod articulation;
mod clearance;
mod collision;
mod dynamics;
mod lanes;
mod randomisation;
mod terrain;

pub use config::{
    EnvConfig, EnvObservation, EnvTask, EnvironmentConfig, PHYSICS_VERSION, PhysicsSettings, RandomisationConfig,
};
pub use dynamics::worlds_per_pass;
pub use environment::{Environment, EpisodeState, VectorEnvironment};
pub use error::{InputError, ModelError, StateError};
pub use home::HomePose;
pub use info::{InfoValue, StepInfo};
pub use mjcf::{HUMANOID_XML, ModelFiles, read_model_file};
pub use model::{Model, mirror::Mirror};
pub use observation::Observation;
pub use physics::{ContactForce, Physics, PhysicsFault, Variation};
pub use randomisation::SensorNoise;
pub use task::{ObservationTerm, StepOutcome, Task, TaskRegistry};
