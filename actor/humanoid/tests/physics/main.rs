//! Motion of bodies: the humanoid, small bodies with a closed form, bodies of other texts.

mod body;
mod boxes;
mod coordinates;
mod dynamics;
mod hinge;
mod model_motion;
mod variation;
