//! Pairs of shapes that may touch.

use super::softness::Softness;

/// A shape of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ShapeIndex {
    /// Index in [`super::Model::bodies`].
    pub body: usize,
    /// Index in [`super::Body::shapes`].
    pub shape: usize,
}

/// Two shapes, or a shape and the ground, that may touch.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// Shape; of two shapes the one that comes first in the model.
    pub first: ShapeIndex,
    /// Other shape; `None` is the ground.
    pub second: Option<ShapeIndex>,
    /// Friction coefficients along the two directions of the friction pyramid; 0 without friction.
    pub friction: [f64; 2],
    /// Distance (m) below which the contact pushes.
    pub margin_m: f64,
    /// Softness of the contact.
    pub softness: Softness,
}
