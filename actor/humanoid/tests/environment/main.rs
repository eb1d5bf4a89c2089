//! Episodes and observations of the humanoid.

mod bad_input;
mod contacts;
mod control_steps;
mod determinism;
mod episode_states;
mod episodes;
#[path = "../golden/mod.rs"]
mod golden;
mod ground;
mod motion;
mod observations;
mod physics_version;
mod randomisation;
mod sensor_noise;
mod support;
mod velocity;
