//! Treadmill: actor.
