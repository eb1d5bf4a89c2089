//! Pages and sources, checked against each other and against the program; limits of style.

mod architecture;
#[path = "../hostile/attacks.rs"]
#[allow(dead_code, reason = "the tests of hostile clients use the rest")]
mod attacks;
mod circles;
mod machines;
mod recipes;
mod reference;
#[path = "../support/mod.rs"]
mod support;
mod tidy;
mod troubleshooting;
mod tutorial;
