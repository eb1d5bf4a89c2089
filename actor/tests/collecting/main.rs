//! Environments side by side, and the fragments, poses and saved episodes that an actor makes of them.

mod environments;
mod poses;
mod rollout;
mod saved;
