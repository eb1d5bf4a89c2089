//! [`MultibodyWorld`] in double precision.

use rapier3d_f64 as rapier;

#[path = "world.rs"]
mod world;
pub use world::MultibodyWorld;
