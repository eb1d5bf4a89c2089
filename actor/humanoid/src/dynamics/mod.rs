//! Joint-space dynamics of the articulated body.
//!
//! The state has the coordinates of MJCF: a position vector (root position, root quaternion w x y z, one angle per hinge)
//! and a velocity vector (root velocity in world axes, root angular velocity in the root's axes, one rate per hinge).
//!
//! - `tree`: bodies and degrees of freedom.
//! - `spatial`: spatial vectors and inertias.
//! - `posture`: forward kinematics.
//! - `mass_matrix`: assembly and factorisation.
//! - `flight`: one time step without contacts.
//! - `momentum`: conservation of momentum in that step.
//! - `limits`: the hinges' ranges within that step.
//! - `softness`: compliance of limits and contacts.
//! - `contacts`: impulses at contact points.
//! - `rows`: products of rows over the degrees of freedom.

mod contacts;
mod flight;
mod limits;
mod mass_matrix;
mod momentum;
mod posture;
mod rows;
mod softness;
mod spatial;
mod tree;

#[cfg(test)]
mod tests;

pub(crate) use contacts::{ContactPoint, Contacts};
pub(crate) use flight::Flight;
pub(crate) use posture::Posture;
pub(crate) use spatial::Motion;
pub(crate) use tree::{ROOT_DOFS, ROOT_POSITIONS, Tree};
