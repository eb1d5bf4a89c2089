//! Code that exists only because of a fault in Zenoh. Each file names the upstream issue and says when it can be deleted.

pub mod one_core;
pub mod threads;
