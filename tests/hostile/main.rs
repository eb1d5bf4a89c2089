//! Hostile clients against a real learner. They are raw Zenoh, without the limits of our own side of the bus.
//!
//! This is a process of its own for two reasons. Clients that flood over TLS need the bus on one thread
//! (`support::bus_on_one_thread`), and the bus reads that setting once in a process. Floods would also delay messages that
//! other tests count.

mod access;
#[allow(dead_code, reason = "the example and other tests use the rest")]
mod attacks;
mod floods;
#[path = "../support/mod.rs"]
mod support;
