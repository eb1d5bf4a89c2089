//! PPO updates on an NVIDIA GPU.
//!
//! A gradient step is a list of launches of our own kernels, from the gathering of its rows to Adam. The driver captures the
//! list as a graph, once per number of rows, so that a step is one call; a pass over the batch reads nothing back until its
//! end. The driver's library is loaded when a GPU is asked for, so that one program serves machines with and without one.
//!
//! # Layout
//! - `kernels.cu`: the kernels, and `kernels.ptx`, what NVIDIA's compiler makes of them (`compile.py`).
//! - `layout`: where parameters, batch and activations lie in the GPU's memory.
//! - `program`: the launches of a gradient step.
//! - `driver`: the driver: [`Gpu`], memory, launches, graphs.
//! - `session`: [`Session`], passes over a batch.
//! - `error`: [`GpuError`], with a remedy.
//!
//! Tests need no GPU: `tests/stand_in/cuda.c` is a driver that runs the same kernels, compiled as C.

mod driver;
mod error;
mod layout;
mod program;
mod session;

pub use driver::Gpu;
pub use error::GpuError;
pub use session::{GpuBatch, PassSettings, PassSums, Session, memory_bytes};
