//! [`MultibodyWorld`] in Rapier's usual single precision.

use rapier3d as rapier;

#[path = "world.rs"]
mod world;
pub use world::MultibodyWorld;
