//! The Python actor and the player of exported policies. Other tests use the scripts beside this file to read Treadmill's
//! files in Python.

mod actor;
mod mjcf;
mod peers;
#[path = "../support/mod.rs"]
mod support;
mod sweep;
mod transfer;
