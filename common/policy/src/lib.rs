//! The policy network: its shape, its parameters as one flat vector, and how it is evaluated.
//!
//! All parameters of actor and critic stand in **one** flat `f32` vector, in the order of [`NetworkShape::tensors`], so
//! that the forward pass, Adam, gradient clipping, checksums and the broadcast each run over one slice.
//!
//! | file | holds |
//! |---|---|
//! | `shape` | [`NetworkShape`]: widths, offsets, names |
//! | `tensors` | the flat vector as safetensors bytes, and checks of what comes from outside |
//! | `init` | orthogonal initialisation |
//! | `gaussian` | log-probability, sampling, entropy of actions |
//! | `elementwise` | the vectorised loops: ELU and its derivative |
//! | `kernel` | forward and backward pass of one network over one chunk of rows |
//! | `fused` | both networks as one Candle operation with its own gradient |
//! | `plain` | the same networks from Candle's own operations: the reference for tests, and what runs on a GPU |
//! | `networks` | [`Networks`]: which of the two runs where |
//! | `agreement` | whether both say the same on this processor |
//! | `inference` | [`Policy`]: what an actor evaluates |

pub mod agreement;
pub mod device;
mod elementwise;
pub mod exported;
mod fused;
pub mod gaussian;
mod inference;
pub mod init;
mod kernel;
mod networks;
pub mod normaliser;
pub mod onnx;
pub mod plain;
mod shape;
mod tensors;

pub use fused::FusedNetworks;
pub use inference::Policy;
pub use networks::{Networks, Part};
pub use shape::{Dense, NamedTensor, NetworkShape};
pub use tensors::{ParameterError, check_parameters, from_safetensors, to_safetensors};
pub(crate) use tensors::{column, to_safetensors_with};
