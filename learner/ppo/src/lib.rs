//! Proximal policy optimisation: accepted fragments in, improved parameters out.
//!
//! Pure mathematics: no network, no files, no clock.
//!
//! # Layout, to be read in this order
//! - [`gae`]: generalised advantage estimation, a pure function.
//! - [`state`]: [`PpoState`], which learning continues from.
//! - [`improvement`]: takes fragments, and returns an improved policy with new running statistics.
//! - [`batch_building`]: turns accepted fragments into the batch of one update.
//! - [`plausibility`]: finds fragments whose numbers cannot be what an actor observed.
//! - [`batch`]: the batch itself, and its minibatches.
//! - [`loss`]: the loss, from top to bottom, in Candle's operations.
//! - `loss_gradient`: the same loss and its gradient on slices.
//! - `slice_gradient`: gather, forward, loss, backward on slices.
//! - `tensor_gradient`: the same in Candle's operations: `--device candle`, and the reference of tests.
//! - [`device`]: processor, GPU, or Candle; `options`: it, threads, chunks.
//! - `passes`, `gpu_passes`: passes over a batch on the processor and on a GPU.
//! - [`update`]: [`Ppo`] runs epochs of gradient steps, and restores the old state when one fails.
//! - `update_stats`: what an update reports, or why it was undone.
//! - [`optimiser`]: Adam and gradient clipping over one flat slice.
//! - [`measures`]: KL divergence, clip fraction, explained variance, and the adaptive learning rate.
//! - [`load_adaptation`]: adapts batch size and passes to the load.
//! - [`settings`]: what the rest of the learner asks of the settings.
//! - `trained_policy`: policy that an update leaves.

pub mod batch;
pub mod batch_building;
pub mod device;
pub mod gae;
mod gpu_passes;
pub mod improvement;
pub mod load_adaptation;
pub mod loss;
mod loss_gradient;
pub mod measures;
pub mod optimiser;
mod options;
mod passes;
pub mod plausibility;
pub mod settings;
mod slice_gradient;
pub mod state;
mod tensor_gradient;
mod trained_policy;
pub mod update;
mod update_stats;

pub use batch::Batch;
pub use batch_building::{AcceptedFragment, BuiltBatch, RejectedFragment, build_batch};
pub use improvement::{Improvement, PreparedBatch};
pub use load_adaptation::LoadAdaptation;
pub use measures::{adapt_learning_rate, explained_variance};
pub use options::PpoOptions;
pub use plausibility::Implausible;
pub use settings::BatchSize;
pub use state::PpoState;
pub use trained_policy::TrainedPolicy;
pub use update::Ppo;
pub use update_stats::{UpdateError, UpdateStats};
