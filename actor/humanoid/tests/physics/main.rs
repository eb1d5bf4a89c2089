//! Motion of the humanoid, of small bodies with a closed form, and of other models.

mod body;
mod boxes;
mod coordinates;
mod dynamics;
mod hinge;
mod model_motion;
mod variation;
