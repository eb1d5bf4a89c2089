//! Proximal policy optimisation: one batch of transitions in, improved parameters out.
//!
//! | file | holds |
//! |---|---|
//! | `loss` | the mathematics, top-down, in Candle's operations |
//! | `batch` | what an update learns from, and how it is cut into minibatches |
//! | `measures` | KL divergence, clip fraction, explained variance, the adaptive learning rate |
//! | `update` | [`Updater`]: epochs, gradient steps, and the undoing of an update that fails |

mod batch;
pub mod loss;
mod measures;
mod update;

pub use batch::Batch;
pub use measures::{adapt_learning_rate, explained_variance};
pub use update::{UpdateError, UpdateStats, Updater, UpdaterError};
