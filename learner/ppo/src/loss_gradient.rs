//! Loss of [`crate::loss`] and its gradient in closed form, on plain slices. Actor and critic have separate parts of
//! the loss.

use std::iter::Sum;

use multiversion::multiversion;
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
        gradient: &mut [f32],
        log_std_gradient: &mut [f64],
        sums: &mut LossSums,
    ) {
        policy_rows(self, rows, means, gradient, log_std_gradient, sums);
    }

    /// Half the squared error of the values of the given rows. Writes its gradient by the values, `[rows]`.
    pub(crate) fn value(&self, rows: &[u32], values: &[f32], gradient: &mut [f32], sums: &mut LossSums) {
        let slope = self.config.value_coefficient as f32 * self.share;
        for ((row, value), by_value) in rows.iter().zip(values).zip(gradient) {
            let error = value - self.batch.returns[*row as usize];
            sums.value += f64::from(error * error) * 0.5;
            *by_value = slope * error;
        }
    }
}

/// [`LossTerms::policy`], compiled for the vector registers of this machine.
#[multiversion(targets("x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl", "x86_64+avx2"))]
fn policy_rows(
    terms: &LossTerms,
    rows: &[u32],
    means: &[f32],
    gradient: &mut [f32],
    log_std_gradient: &mut [f64],
    sums: &mut LossSums,
) {
    let LossTerms { batch, advantages, config, precision, constant, share } = terms;
    let actions = precision.len();
    let clip = config.clip_range as f32;
    let limit = config.bounds_limit as f32;
    let bounds_slope = (2.0 * config.bounds_coefficient) as f32 * share;
    let rows = rows.iter().map(|row| *row as usize);
    for ((row, means), by_mean) in rows.zip(means.chunks_exact(actions)).zip(gradient.chunks_exact_mut(actions)) {
        let taken = &batch.actions[row * actions..][..actions];
        let distance = sum_in_lanes(taken, means, precision, |action, mean, precision| {
            (action - mean) * (action - mean) * precision
        });
        let log_ratio = -0.5 * distance - constant - batch.log_probs[row];
        let ratio = log_ratio.min(LOG_RATIO_MAX as f32).exp();
        let advantage = advantages[row];
        let (gain, clipped_gain) = (ratio * advantage, ratio.clamp(1.0 - clip, 1.0 + clip) * advantage);
        sums.policy -= f64::from(gain.min(clipped_gain));
        sums.clipped += f64::from(u8::from((ratio - 1.0).abs() > clip));
        // The derivative of the ratio is the ratio. Where the clipped gain is smaller, it is constant.
        let moves = gain <= clipped_gain && log_ratio < LOG_RATIO_MAX as f32;
        let slope = if moves { -gain * share } else { 0.0 };
        let columns = means.iter().zip(taken).zip(precision).zip(by_mean).zip(&mut *log_std_gradient);
        for ((((mean, action), precision), by_mean), by_log_std) in columns {
            let difference = action - mean;
            let pull = difference * precision;
            *by_mean = slope * pull + bounds_slope * (mean - mean.clamp(-limit, limit));
            *by_log_std += f64::from(slope * (difference * pull - 1.0));
        }
        sums.bounds += f64::from(sum_in_lanes(means, means, means, |mean, _, _| {
            let excess = mean - mean.clamp(-limit, limit);
            excess * excess
        }));
    }
}

/// Returns the sum of a term of the entries of three rows of equal length, in a fixed order that fits vector registers.
#[inline(always)]
fn sum_in_lanes(a: &[f32], b: &[f32], c: &[f32], term: impl Fn(f32, f32, f32) -> f32) -> f32 {
    let mut sums = [0.0; 8];
    let ((a, a_rest), (b, b_rest), (c, c_rest)) = (a.as_chunks::<8>(), b.as_chunks::<8>(), c.as_chunks::<8>());
    for ((a, b), c) in a.iter().zip(b).zip(c) {
        for (lane, sum) in sums.iter_mut().enumerate() {
            *sum += term(a[lane], b[lane], c[lane]);
        }
    }
    for (((sum, a), b), c) in sums.iter_mut().zip(a_rest).zip(b_rest).zip(c_rest) {
        *sum += term(*a, *b, *c);
    }
    sums.iter().sum()
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
        let (mut gradient, mut log_std_gradient, mut sums) = ([0.0; 3], [0.0], LossSums::default());
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
