//! Loss of [`crate::loss`] and its gradient in closed form, on plain slices. Actor and critic have separate parts of
//! the loss.

use std::iter::Sum;

use treadmill_config::PpoConfig;
use treadmill_policy::gaussian::HALF_LN_TAU;

use crate::{batch::Batch, loss::LOG_RATIO_MAX};

/// Parts of the loss, summed over rows, before their coefficients; see [`crate::loss::Loss`].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LossSums {
    pub(crate) policy: f64,
    pub(crate) value: f64,
    pub(crate) bounds: f64,
    /// Rows whose probability ratio is outside the clip range.
    pub(crate) clipped: f64,
}

impl Sum for LossSums {
    fn sum<I: Iterator<Item = Self>>(parts: I) -> Self {
        parts.fold(Self::default(), |sum, part| Self {
            policy: sum.policy + part.policy,
            value: sum.value + part.value,
            bounds: sum.bounds + part.bounds,
            clipped: sum.clipped + part.clipped,
        })
    }
}

/// What all rows of one gradient step share.
pub(crate) struct LossTerms<'a> {
    batch: &'a Batch,
    /// Normalised advantages of the whole batch, times their weights.
    advantages: &'a [f32],
    config: &'a PpoConfig,
    /// `1 / σ²` of each action.
    precision: Vec<f32>,
    /// Sum over actions of `ln σ + ½ ln 2π`.
    constant: f32,
    /// Part of each row in a mean over the minibatch.
    share: f32,
}

impl<'a> LossTerms<'a> {
    /// Returns the terms of a minibatch of so many rows.
    pub(crate) fn new(
        batch: &'a Batch,
        advantages: &'a [f32],
        config: &'a PpoConfig,
        log_std: &[f32],
        rows: usize,
    ) -> Self {
        let precision = log_std.iter().map(|log_std| (-2.0 * log_std).exp()).collect();
        let constant = log_std.iter().sum::<f32>() + HALF_LN_TAU * log_std.len() as f32;
        Self { batch, advantages, config, precision, constant, share: 1.0 / rows as f32 }
    }

    /// Clipped surrogate and bounds of the given rows. Writes their gradient by the action means, `[rows, A]`, and adds
    /// that by `log_std` without the entropy's.
    pub(crate) fn policy(
        &self,
        rows: &[u32],
        means: &[f32],
        gradient: &mut Vec<f32>,
        log_std_gradient: &mut [f64],
        sums: &mut LossSums,
    ) {
        let actions = self.precision.len();
        let clip = self.config.clip_range as f32;
        let limit = self.config.bounds_limit as f32;
        let bounds_slope = (2.0 * self.config.bounds_coefficient) as f32 * self.share;
        gradient.clear();
        for (row, means) in rows.iter().map(|row| *row as usize).zip(means.chunks_exact(actions)) {
            let taken = &self.batch.actions[row * actions..][..actions];
            let mut distance = 0.0;
            for ((action, mean), precision) in taken.iter().zip(means).zip(&self.precision) {
                distance += (action - mean) * (action - mean) * precision;
            }
            let log_ratio = -0.5 * distance - self.constant - self.batch.log_probs[row];
            let ratio = log_ratio.min(LOG_RATIO_MAX as f32).exp();
            let advantage = self.advantages[row];
            let (gain, clipped_gain) = (ratio * advantage, ratio.clamp(1.0 - clip, 1.0 + clip) * advantage);
            sums.policy -= f64::from(gain.min(clipped_gain));
            sums.clipped += f64::from(u8::from((ratio - 1.0).abs() > clip));
            // The derivative of the ratio is the ratio. Where the clipped gain is smaller, it is constant.
            let moves = gain <= clipped_gain && log_ratio < LOG_RATIO_MAX as f32;
            let slope = if moves { -gain * self.share } else { 0.0 };
            for (index, mean) in means.iter().enumerate() {
                let difference = taken[index] - mean;
                let pull = difference * self.precision[index];
                let excess = mean - mean.clamp(-limit, limit);
                gradient.push(slope * pull + bounds_slope * excess);
                log_std_gradient[index] += f64::from(slope * (difference * pull - 1.0));
                sums.bounds += f64::from(excess * excess);
            }
        }
    }

    /// Half the squared error of the values of the given rows. Writes its gradient by the values, `[rows]`.
    pub(crate) fn value(&self, rows: &[u32], values: &[f32], gradient: &mut Vec<f32>, sums: &mut LossSums) {
        let slope = self.config.value_coefficient as f32 * self.share;
        gradient.clear();
        for (row, value) in rows.iter().zip(values) {
            let error = value - self.batch.returns[*row as usize];
            sums.value += f64::from(error * error) * 0.5;
            gradient.push(slope * error);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_outside_the_clip_range_counts_and_pushes_only_back() {
        // σ = 1, means 0, ratios 2, 1 and 1/2; the gradient of a mean is −advantage × ratio × action ÷ rows.
        let base = -HALF_LN_TAU;
        let batch = Batch {
            actions: vec![1.0; 3],
            log_probs: [2.0_f32, 1.0, 0.5].map(|ratio| base - 0.5 - ratio.ln()).to_vec(),
            ..Batch::default()
        };
        let config = PpoConfig::default();
        let terms = LossTerms::new(&batch, &[1.0, 3.0, 1.0], &config, &[0.0], 3);
        let (mut gradient, mut log_std_gradient, mut sums) = (Vec::new(), [0.0], LossSums::default());
        terms.policy(&[0, 1, 2], &[0.0; 3], &mut gradient, &mut log_std_gradient, &mut sums);
        assert_eq!(sums.clipped, 2.0);
        for (found, expected) in gradient.iter().zip([0.0, -1.0, -0.5 / 3.0]) {
            assert!((found - expected).abs() < 1e-6, "{gradient:?}");
        }
        // Actions at one standard deviation say nothing about it.
        assert!(log_std_gradient[0].abs() < 1e-6);
        assert!((sums.policy + 1.2 + 3.0 + 0.5).abs() < 1e-6);
    }
}
