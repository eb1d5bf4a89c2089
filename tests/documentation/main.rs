//! Pages and sources against each other and against the program: what they state is true, and style has limits.

mod architecture;
#[path = "../hostile/attacks.rs"]
#[allow(dead_code, reason = "the tests of hostile clients use the rest")]
mod attacks;
mod machines;
mod reference;
#[path = "../support/mod.rs"]
mod support;
mod tidy;
mod troubleshooting;
mod tutorial;
