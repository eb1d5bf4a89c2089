//! Joint-space dynamics of articulated bodies, for several worlds at once.
//!
//! The state has the coordinates of MJCF: a position vector (root position, root quaternion w x y z, one angle per hinge)
//! and a velocity vector (root velocity in world axes, root angular velocity in the root's axes, one rate per hinge).
//!
//! - `structure`: what all worlds of a model share: bodies and degrees of freedom.
//! - `world`: state and parameters of one world.
//! - `engine`, `group`, `exchange`: passes over several worlds, step by step.
//! - `posture`: forward kinematics.
//! - `mass_matrix`: assembly and factorisation.
//! - `forces`: accelerations without constraints.
//! - `constraints`: limits, friction losses, servos' torque limits, contacts.
//! - `momentum`: conservation of momentum.
//! - `responses`: approximate responses to forces, for the softness of constraints.

mod constraints;
mod engine;
mod exchange;
mod forces;
mod group;
mod mass_matrix;
mod momentum;
mod posture;
mod responses;
mod structure;
#[cfg(test)]
mod tests;
mod world;

pub use engine::worlds_per_pass;
pub(crate) use engine::{advance, refresh};
pub(crate) use group::Pass;
pub(crate) use posture::Posture;
pub(crate) use structure::{ROOT_DOFS, ROOT_POSITIONS, Structure};
pub(crate) use world::{BodyState, Drive, Impulse, Parameters, World};
