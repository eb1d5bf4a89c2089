//! Result of an update: its statistics, or why it was undone.

use treadmill_policy::ParameterError;

use crate::loss_gradient::LossSums;

/// Statistics of an update: means over all gradient steps, weighted by rows, unless stated otherwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct UpdateStats {
    /// Clipped surrogate; negative if the policy improves.
    pub policy_loss: f64,
    /// Half the mean squared error of the normalised values.
    pub value_loss: f64,
    /// Entropy of the policy in nats, summed over actions.
    pub entropy: f64,
    /// Squared excess of action means over the limit, summed over actions.
    pub bounds_loss: f64,
    /// KL divergence in nats from the policy that the update started from to that after the last epoch, in closed form
    /// over a sample of the rows.
    pub approx_kl: f64,
    /// Passes that were undone, because they led too far from the policy that the update started from.
    pub undone_passes: u32,
    /// Share of rows whose probability ratio is outside the clip range.
    pub clip_fraction: f64,
    /// Share of the variance of the returns that the values before the update explain.
    pub explained_variance: f64,
    /// Euclidean norm of the gradient before clipping.
    pub grad_norm: f64,
    /// Learning rate after the update.
    pub learning_rate: f64,
    /// Standard deviation of the actions after the update, mean over actions.
    pub std: f64,
    /// Gradient steps taken.
    pub gradient_steps: u64,
    /// Rows evaluated and differentiated: batch times epochs.
    pub samples: u64,
}

/// Why an update was undone. The updater's state is restored, the random stream's is not.
#[derive(Debug, thiserror::Error)]
pub enum UpdateError {
    /// The batch holds no transition.
    #[error("the batch is empty")]
    Empty,
    /// A field of the batch has the wrong length.
    #[error("the {field} hold {found} numbers, expected {expected}")]
    Length {
        /// Name of the field.
        field: &'static str,
        /// Its length.
        found: usize,
        /// Length that fits the network and the other fields.
        expected: usize,
    },
    /// A number became infinite or not a number.
    #[error("the {what} is not finite")]
    NonFinite {
        /// Quantity that is not finite, such as the loss.
        what: &'static str,
    },
    /// The GPU failed.
    #[error(transparent)]
    Gpu(#[from] treadmill_gpu::GpuError),
    /// Candle failed.
    #[error("the tensor library failed")]
    Tensor(#[from] candle_core::Error),
    /// The parameters cannot be evaluated.
    #[error("the parameters cannot be used")]
    Parameters(#[from] ParameterError),
}

impl UpdateStats {
    /// Adds the loss of one gradient step.
    pub(crate) fn add(&mut self, rows: usize, loss: &LossSums, entropy: f32) {
        self.policy_loss += loss.policy;
        self.value_loss += loss.value;
        self.bounds_loss += loss.bounds;
        self.clip_fraction += loss.clipped;
        self.entropy += rows as f64 * f64::from(entropy);
        self.gradient_steps += 1;
        self.samples += rows as u64;
    }

    /// Converts sums to means.
    pub(crate) fn finish(&mut self, log_std: &[f32], learning_rate: f64) {
        let samples = self.samples.max(1) as f64;
        for sum in [
            &mut self.policy_loss,
            &mut self.value_loss,
            &mut self.entropy,
            &mut self.bounds_loss,
            &mut self.grad_norm,
            &mut self.clip_fraction,
        ] {
            *sum /= samples;
        }
        self.std = log_std.iter().map(|l| f64::from(*l).exp()).sum::<f64>() / log_std.len() as f64;
        self.learning_rate = learning_rate;
    }
}

/// Returns an error with the name of the quantity unless it is finite.
pub(crate) fn check_finite(is_finite: bool, what: &'static str) -> Result<(), UpdateError> {
    if is_finite { Ok(()) } else { Err(UpdateError::NonFinite { what }) }
}
