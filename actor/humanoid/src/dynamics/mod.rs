//! Equations of motion of articulated bodies, for several worlds at once; see [`crate::articulation`] for the coordinates.
//!
//! - `world`: state and parameters of one world.
//! - `engine`: passes over several worlds.
//! - `group`, `exchange`, `steps`: the worlds of one pass, their copies to and from it, and its steps.
//! - `forces`: accelerations without constraints.
//! - `constraints`: limits, friction losses, servos' torque limits, contacts.
//! - `momentum`: conservation of momentum.

mod constraints;
mod engine;
mod exchange;
mod forces;
mod group;
mod momentum;
mod steps;
#[cfg(test)]
mod tests;
mod world;

pub use engine::worlds_per_pass;
pub(crate) use engine::{advance, refresh};
pub(crate) use group::Pass;
pub(crate) use world::{BodyState, Drive, Impulse, Parameters, World};
