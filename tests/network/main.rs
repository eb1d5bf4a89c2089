//! Runs over several processes: what goes over the bus, and what happens when a part of a run fails.
//!
//! Hostile clients are in `tests/hostile`: they need the bus of their process on one thread, which routers cannot have, and
//! some of the tests here open a router in this process.

mod accounts;
mod bus;
mod control;
mod copies;
mod external;
mod faults;
mod poses;
mod prometheus;
mod security;
#[path = "../support/mod.rs"]
mod support;
