//! Policy networks: shape, parameters, evaluation, normalisation and export.
//!
//! All parameters of actor and critic are in **one** flat `f32` vector, in the order of [`NetworkShape::tensors`]. So the
//! forward pass, Adam, gradient clipping, checksums and publishing each use one slice.
//!
//! # Layout
//! - `shape`: [`NetworkShape`] with widths, offsets and names.
//! - `tensors`: the flat vector as safetensors bytes; checks of external data.
//! - `init`: orthogonal initialisation.
//! - `gaussian`: log-probability, sampling and entropy of actions.
//! - `elementwise`: vectorised loops for biases and ELU.
//! - `matrix`: products of matrices on slices.
//! - `mirror`: [`PolicyMirror`] of observations and actions, even and odd parts.
//! - `networks`: [`Networks`], dense or equivariant to a mirror, whose parameters are learnt.
//! - `structure`: [`NetworkStructure`] of networks, for programs of a GPU.
//! - `mlp`: [`Mlp`], forward and backward pass of one network on slices, for CPUs.
//! - [`plain`]: the same networks from Candle's operations, as a reference.
//! - `inference`: [`Policy`], which actors evaluate.
//! - `moments`: running mean and variance of observations and returns.
//! - `normaliser`: normalisation by them.
//! - `exported`, `onnx`: a policy as a safetensors or ONNX file.

mod elementwise;
pub mod exported;
pub mod gaussian;
mod inference;
mod init;
mod matrix;
mod mirror;
mod mlp;
mod moments;
mod networks;
pub mod normaliser;
pub mod onnx;
pub mod plain;
mod shape;
mod structure;
mod tensors;

pub use inference::Policy;
pub use mirror::{PolicyMirror, Reflection, mirror_indices};
pub use mlp::{CHUNK_ROWS, ForwardWeights, Mlp, Tape};
pub use networks::Networks;
pub use shape::{Dense, NamedTensor, NetworkShape};
pub use structure::{LayerBlock, NetworkLayer, NetworkStructure, SignedPair};
pub use tensors::{
    ParameterError, actor_from_safetensors, actor_to_safetensors, check_parameters, from_safetensors, to_safetensors,
};
pub(crate) use tensors::{column, to_safetensors_with};
