//! Vectors of environments, and the fragments, poses and saved states that an actor takes from them.

mod environments;
mod poses;
mod rollout;
mod state;
