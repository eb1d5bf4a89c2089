//! Hostile clients against a real learner. They use raw Zenoh, without the limits of Treadmill's own clients.
//!
//! These tests are a program of their own for two reasons. Clients that flood over TLS need the bus on one thread
//! (`support::bus_on_one_thread`), and Zenoh reads that setting once per process. Floods would also delay messages that
//! other tests count.

mod access;
#[allow(dead_code, reason = "the example and other tests use the rest")]
mod attacks;
mod floods;
mod stalled;
#[path = "../support/mod.rs"]
mod support;
