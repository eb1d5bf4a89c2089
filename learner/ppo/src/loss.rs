//! Loss of proximal policy optimisation: Schulman et al. 2017, arXiv:1707.06347.
//!
//! `B` is the number of rows of a minibatch, `A` the number of actions.

use candle_core::{Result, Tensor};
use candle_nn::loss::mse;
use treadmill_config::PpoConfig;
use treadmill_policy::gaussian::HALF_LN_TAU;

/// Largest logarithm of a probability ratio. The loss is clipped long before; a larger one would make the exponential
/// infinite, and its product with a weight of 0 not a number.
pub const LOG_RATIO_MAX: f64 = 20.0;

/// Transitions of one gradient step, without the observations, which the networks have evaluated.
#[derive(Clone, Debug)]
pub struct Minibatch {
    /// Actions before clipping to their range, `[B, A]`.
    pub actions: Tensor,
    /// Log-probabilities of those actions under the policy that chose them, `[B]`.
    pub log_probs: Tensor,
    /// Normalised advantages, `[B]`.
    pub advantages: Tensor,
    /// Normalised value targets, `[B]`.
    pub returns: Tensor,
}

/// Loss and its parts.
#[derive(Clone, Debug)]
pub struct Loss {
    /// Sum that is minimised, a scalar.
    pub total: Tensor,
    /// Clipped surrogate, a scalar.
    pub policy: Tensor,
    /// Half the mean squared error of the values, before its coefficient, a scalar.
    pub value: Tensor,
    /// Entropy of the policy in nats, summed over actions, a scalar.
    pub entropy: Tensor,
    /// Squared excess of action means, before its coefficient, a scalar.
    pub bounds: Tensor,
    /// `ln π_new(a|s) − ln π_old(a|s)`, `[B]`, detached, at most [`LOG_RATIO_MAX`].
    pub log_ratio: Tensor,
}

/// Computes `total = policy + value_coefficient · value − entropy_coefficient · entropy + bounds_coefficient · bounds`.
///
/// `output` is that of both networks, `[B, A + 1]`: action means, then the value. `log_std` is `[A]`.
///
/// # Errors
/// If a tensor has the wrong shape.
pub fn ppo_loss(output: &Tensor, log_std: &Tensor, minibatch: &Minibatch, config: &PpoConfig) -> Result<Loss> {
    let actions = log_std.elem_count();
    let means = output.narrow(1, 0, actions)?.contiguous()?;
    let values = output.narrow(1, actions, 1)?.flatten_all()?;

    // ratio = π_new(a|s) / π_old(a|s).
    let log_ratio = (log_probability(&minibatch.actions, &means, log_std)? - &minibatch.log_probs)?;
    let log_ratio = log_ratio.minimum(LOG_RATIO_MAX)?;
    let ratio = log_ratio.exp()?;

    // Equation 7: the worse of the plain and the clipped gain, so that leaving the clip range gains nothing.
    let clipped = ratio.clamp(1.0 - config.clip_range, 1.0 + config.clip_range)?;
    let gain = (&ratio * &minibatch.advantages)?.minimum(&(clipped * &minibatch.advantages)?)?;
    let policy = gain.mean_all()?.neg()?;

    let value = (mse(&values, &minibatch.returns)? * 0.5)?;
    let entropy = (log_std.sum_all()? + f64::from(HALF_LN_TAU + 0.5) * actions as f64)?;

    // Pulls back means beyond the range of actions; clipping alone would leave them without a gradient. The nearest
    // mean within the limit is a constant target, which gives the same gradient as |mean| − limit.
    let within = means.detach().clamp(-config.bounds_limit, config.bounds_limit)?;
    let bounds = ((&means - within)?.sqr()?.sum_all()? / means.dim(0)? as f64)?;

    let total = (&policy + (&value * config.value_coefficient)?)?;
    let total = (total - (&entropy * config.entropy_coefficient)?)?;
    let total = (total + (&bounds * config.bounds_coefficient)?)?;
    Ok(Loss { total, policy, value, entropy, bounds, log_ratio: log_ratio.detach() })
}

/// Log-density of each row of actions, `[B]`: `Σ −½ ((a − μ)/σ)² − ln σ − ½ ln 2π` (see `treadmill_policy::gaussian`).
fn log_probability(actions: &Tensor, means: &Tensor, log_std: &Tensor) -> Result<Tensor> {
    // The sum over actions is a matrix product with 1/σ², which is faster in Candle than a broadcast and a sum.
    let precision = (log_std * -2.0)?.exp()?.unsqueeze(1)?;
    let squared_distance = (actions - means)?.sqr()?.matmul(&precision)?.squeeze(1)?;
    let constant = (log_std.sum_all()? + f64::from(HALF_LN_TAU) * log_std.elem_count() as f64)?;
    (squared_distance * -0.5)?.broadcast_sub(&constant)
}

#[cfg(test)]
#[path = "loss_tests.rs"]
mod tests;
