//! A model as a tree of bodies in several worlds: paths of degrees of freedom, poses, and the mass matrix.
//!
//! The state has the coordinates of MJCF: a position vector (root position, root quaternion w x y z, one angle per hinge)
//! and a velocity vector (root velocity in world axes, root angular velocity in the root's axes, one rate per hinge).
//!
//! - `structure`: what all worlds of a model share: bodies and degrees of freedom.
//! - `posture`: forward kinematics.
//! - `mass_matrix`: assembly and factorisation.
//! - `responses`: approximate responses to forces, for the softness of constraints.

mod mass_matrix;
mod posture;
mod responses;
mod structure;

pub(crate) use self::mass_matrix::MassMatrix;
pub(crate) use self::posture::{BodyMasses, Posture, compose, integrate};
#[cfg(test)]
pub(crate) use self::responses::Responses;
pub(crate) use self::structure::{ConnectionNode, Coordinate, ROOT_DOFS, ROOT_POSITIONS, Structure};
