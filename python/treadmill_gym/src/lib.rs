//! Native part of the Gymnasium package `treadmill_gym`, which imports it as `treadmill_gym._native`.
//!
//! The Python part adds spaces, seeds, wrappers and Gymnasium's reset rules.
//!
//! # Layout
//! - `settings`: settings and model from keyword arguments.
//! - `one`: one humanoid, stepped on the caller's thread.
//! - `many`: several humanoids, stepped in one call on several threads.
//! - `info`: infos of a step as dictionaries.
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
