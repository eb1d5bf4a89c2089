//! Runs of several processes: messages on the bus, and failures of single processes.
//!
//! Hostile clients are in `tests/hostile`: they need a bus on one thread, which a router in the same process cannot have,
//! and some tests here open a router.

mod accounts;
#[path = "../hostile/attacks.rs"]
#[allow(
    dead_code,
    clippy::duplicate_mod,
    reason = "the tests of hostile clients use the rest, with its sample fragment"
)]
mod attacks;
mod broken_links;
mod bus;
mod control;
mod copies;
mod external;
mod faults;
mod policies;
mod pool;
mod poses;
mod prometheus;
mod security;
mod several_learners;
mod silence;
mod stepping_down;
#[path = "../support/mod.rs"]
mod support;
mod takeover;
mod versions;
