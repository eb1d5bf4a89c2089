//! The actor in Python. The scripts beside this file are for other tests, which let Python read what Treadmill wrote.

mod actor;
#[path = "../support/mod.rs"]
mod support;
