//! Treadmill: the humanoid as a Gymnasium environment, native part.
//!
//! Python sees this as `treadmill_gym._native`, and nobody but the package beside it uses it: spaces, seeds, wrappers and
//! Gymnasium's rules about resets are Python's, in `python/treadmill_gym`.
//!
//! # Layout
//! - `settings`: keyword arguments → settings and model.
//! - `one`: one humanoid, stepped on the caller's thread.
//! - `many`: several, stepped in one call and on several threads.
//! - `info`: what is told of a step, as dictionaries.
//! - `studio`: pictures.

mod info;
mod many;
mod one;
mod settings;
mod studio;

/// The native part of `treadmill_gym`.
#[pyo3::pymodule]
mod _native {
    #[pymodule_export]
    use super::{many::Humanoids, one::Humanoid, studio::Studio};
}
