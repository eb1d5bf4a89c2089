//! Commands as users run them: arguments, checks, benchmarks, saved runs, exports, pictures, dashboard.

mod bench;
mod check;
mod dashboard;
mod eval;
mod export;
mod export_velocity;
mod film;
mod lifecycle;
mod model;
mod motion;
mod runs;
mod slips;
mod states;
#[path = "../support/mod.rs"]
mod support;
mod usage;
mod velocity;
