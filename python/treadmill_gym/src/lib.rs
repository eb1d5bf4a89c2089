//! Treadmill: the humanoid as a Gymnasium environment, native part.
//!
//! Python imports this as `treadmill_gym._native`. Only the package beside it uses it, `python/treadmill_gym`, which has spaces,
//! seeds, wrappers and Gymnasium's rules about resets.
//!
//! # Layout
//! - `settings`: keyword arguments → settings and model.
//! - `one`: one humanoid, stepped on the caller's thread.
//! - `many`: several, stepped in one call and on several threads.
//! - `info`: what is told of a step, as dictionaries.
//! - `renderer`: pictures.

mod info;
mod many;
mod one;
mod renderer;
mod settings;

/// The native part of `treadmill_gym`.
#[pyo3::pymodule]
mod _native {
    #[pymodule_export]
    use super::{many::Humanoids, one::Humanoid, renderer::Renderer};
}
