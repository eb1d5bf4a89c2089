//! Loss of [`super::loss`] as one Candle operation for a CPU, with its gradient in closed form.
//!
//! Candle's own operations on a minibatch of 17 actions take longer than the arithmetic in them.

use std::sync::{Arc, Mutex, PoisonError};

use candle_core::{CpuStorage, CustomOp2, Layout, Result, Shape, Tensor, bail};
use treadmill_config::PpoConfig;
use treadmill_policy::gaussian::HALF_LN_TAU;

use crate::loss::LOG_RATIO_MAX;

/// Transitions of one gradient step as plain numbers; the fields are those of [`super::loss::Minibatch`].
#[derive(Clone, Debug)]
pub(crate) struct MinibatchRows {
    pub(crate) actions: Vec<f32>,
    pub(crate) log_probs: Vec<f32>,
    pub(crate) advantages: Vec<f32>,
    pub(crate) returns: Vec<f32>,
}

#[cfg(test)]
impl MinibatchRows {
    /// Returns the same transitions for Candle's operations.
    pub(crate) fn tensors(&self) -> Result<crate::loss::Minibatch> {
        let rows = self.returns.len();
        let tensor = |numbers: &[f32]| Tensor::new(numbers, &candle_core::Device::Cpu);
        Ok(crate::loss::Minibatch {
            actions: tensor(&self.actions)?.reshape((rows, self.actions.len() / rows))?,
            log_probs: tensor(&self.log_probs)?,
            advantages: tensor(&self.advantages)?,
            returns: tensor(&self.returns)?,
        })
    }
}

/// Parts of the loss before their coefficients; the fields are those of [`super::loss::Loss`].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LossParts {
    pub(crate) policy: f64,
    pub(crate) value: f64,
    pub(crate) entropy: f64,
    pub(crate) bounds: f64,
    /// Rows whose probability ratio is outside the clip range.
    pub(crate) clipped: usize,
}

/// Parts of the loss, and its gradient.
#[derive(Debug, Default)]
struct Evaluated {
    parts: LossParts,
    output_gradient: Vec<f32>,
    log_std_gradient: Vec<f32>,
}

/// Returns the total loss, a scalar with a gradient for `output` and `log_std`, and its parts. Arguments as for
/// [`super::loss::ppo_loss`].
///
/// # Errors
/// If a tensor has the wrong shape, is not `f32`, or is not on the CPU.
pub(crate) fn fused_ppo_loss(
    output: &Tensor,
    log_std: &Tensor,
    rows: MinibatchRows,
    config: &PpoConfig,
) -> Result<(Tensor, LossParts)> {
    let evaluated = Arc::new(Mutex::default());
    let operation = Operation { rows, config: config.clone(), evaluated: Arc::clone(&evaluated) };
    let total = output.contiguous()?.apply_op2(&log_std.contiguous()?, operation)?;
    let parts = lock(&evaluated).parts;
    Ok((total, parts))
}

struct Operation {
    rows: MinibatchRows,
    config: PpoConfig,
    evaluated: Arc<Mutex<Evaluated>>,
}

impl CustomOp2 for Operation {
    fn name(&self) -> &'static str {
        "fused-ppo-loss"
    }

    fn cpu_fwd(&self, s1: &CpuStorage, l1: &Layout, s2: &CpuStorage, l2: &Layout) -> Result<(CpuStorage, Shape)> {
        let (Some((start, end)), Some((from, to))) = (l1.contiguous_offsets(), l2.contiguous_offsets()) else {
            bail!("the fused loss takes contiguous tensors only");
        };
        let (output, log_std) = (&s1.as_slice::<f32>()?[start..end], &s2.as_slice::<f32>()?[from..to]);
        let (count, actions) = (self.rows.returns.len(), log_std.len());
        if output.len() != count * (actions + 1) || self.rows.actions.len() != count * actions {
            bail!("the loss of {count} rows of {actions} actions got {} outputs", output.len());
        }
        let evaluated = evaluate(output, log_std, &self.rows, &self.config);
        let LossParts { policy, value, entropy, bounds, .. } = evaluated.parts;
        let c = &self.config;
        let total =
            policy + c.value_coefficient * value - c.entropy_coefficient * entropy + c.bounds_coefficient * bounds;
        *lock(&self.evaluated) = evaluated;
        Ok((CpuStorage::F32(vec![total as f32]), Shape::from(())))
    }

    fn bwd(
        &self,
        output: &Tensor,
        log_std: &Tensor,
        _total: &Tensor,
        total_gradient: &Tensor,
    ) -> Result<(Option<Tensor>, Option<Tensor>)> {
        let evaluated = lock(&self.evaluated);
        let of = |gradient: &[f32], tensor: &Tensor| {
            Tensor::from_slice(gradient, tensor.shape(), tensor.device())?.broadcast_mul(total_gradient)
        };
        Ok((Some(of(&evaluated.output_gradient, output)?), Some(of(&evaluated.log_std_gradient, log_std)?)))
    }
}

fn evaluate(output: &[f32], log_std: &[f32], rows: &MinibatchRows, config: &PpoConfig) -> Evaluated {
    let (actions, count) = (log_std.len(), rows.returns.len());
    let share = 1.0 / count as f32;
    let precision: Vec<f32> = log_std.iter().map(|log_std| (-2.0 * log_std).exp()).collect();
    let constant = log_std.iter().sum::<f32>() + HALF_LN_TAU * actions as f32;
    let clip = config.clip_range as f32;
    let limit = config.bounds_limit as f32;
    let bounds_slope = (2.0 * config.bounds_coefficient) as f32 * share;
    let value_slope = config.value_coefficient as f32 * share;
    let mut parts = LossParts::default();
    let mut output_gradient = vec![0.0; output.len()];
    let mut log_std_sums = vec![0.0_f64; actions];
    for (row, (output, gradient)) in
        output.chunks_exact(actions + 1).zip(output_gradient.chunks_exact_mut(actions + 1)).enumerate()
    {
        let (means, value) = (&output[..actions], output[actions]);
        let taken = &rows.actions[row * actions..][..actions];
        let mut distance = 0.0;
        for ((action, mean), precision) in taken.iter().zip(means).zip(&precision) {
            distance += (action - mean) * (action - mean) * precision;
        }
        let log_ratio = -0.5 * distance - constant - rows.log_probs[row];
        let ratio = log_ratio.min(LOG_RATIO_MAX as f32).exp();
        let advantage = rows.advantages[row];
        let (gain, clipped_gain) = (ratio * advantage, ratio.clamp(1.0 - clip, 1.0 + clip) * advantage);
        parts.policy -= f64::from(gain.min(clipped_gain));
        parts.clipped += usize::from((ratio - 1.0).abs() > clip);
        // The derivative of the ratio is the ratio. Where the clipped gain is smaller, it is constant.
        let slope = if gain <= clipped_gain && log_ratio < LOG_RATIO_MAX as f32 { -gain * share } else { 0.0 };
        for (index, mean) in means.iter().enumerate() {
            let difference = taken[index] - mean;
            let pull = difference * precision[index];
            let excess = mean - mean.clamp(-limit, limit);
            gradient[index] = slope * pull + bounds_slope * excess;
            log_std_sums[index] += f64::from(slope * (difference * pull - 1.0));
            parts.bounds += f64::from(excess * excess);
        }
        let error = value - rows.returns[row];
        parts.value += f64::from(error * error) * 0.5;
        gradient[actions] = value_slope * error;
    }
    for sum in [&mut parts.policy, &mut parts.value, &mut parts.bounds] {
        *sum /= count as f64;
    }
    parts.entropy = f64::from(constant) + 0.5 * actions as f64;
    let log_std_gradient = log_std_sums.iter().map(|sum| (sum - config.entropy_coefficient) as f32).collect();
    Evaluated { parts, output_gradient, log_std_gradient }
}

fn lock(evaluated: &Mutex<Evaluated>) -> std::sync::MutexGuard<'_, Evaluated> {
    evaluated.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use candle_core::{Device, Var};
    use proptest::prelude::*;

    use super::*;
    use crate::loss::ppo_loss;

    fn numbers(tensor: &Tensor) -> Vec<f32> {
        tensor.flatten_all().and_then(|tensor| tensor.to_vec1()).expect("numbers")
    }

    fn close(one: &[f32], other: &[f32]) -> bool {
        one.len() == other.len()
            && one.iter().zip(other).all(|(a, b)| (a - b).abs() <= 1e-5 * (1.0 + a.abs() + b.abs()))
    }

    #[test]
    fn a_row_outside_the_clip_range_counts_and_pushes_only_back() {
        // σ = 1, means 0, ratios 2, 1 and 1/2; the gradient of a mean is −advantage × ratio × action ÷ rows.
        let base = -HALF_LN_TAU;
        let rows = MinibatchRows {
            actions: vec![1.0; 3],
            log_probs: [2.0_f32, 1.0, 0.5].map(|ratio| base - 0.5 - ratio.ln()).to_vec(),
            advantages: vec![1.0, 3.0, 1.0],
            returns: vec![0.0; 3],
        };
        let config = PpoConfig { value_coefficient: 0.0, ..PpoConfig::default() };
        let found = evaluate(&[0.0; 6], &[0.0], &rows, &config);
        assert_eq!(found.parts.clipped, 2);
        assert!(close(&found.output_gradient, &[0.0, 0.0, -1.0, 0.0, -0.5 / 3.0, 0.0]), "{:?}", found.output_gradient);
        // Actions at one standard deviation say nothing about it.
        assert!(close(&found.log_std_gradient, &[0.0]));
        assert!((found.parts.policy + (1.2 + 3.0 + 0.5) / 3.0).abs() < 1e-6);
    }

    proptest! {
        #[test]
        fn loss_and_gradient_equal_those_of_candles_operations(
            count in 1_usize..12,
            actions in 1_usize..5,
            seed in proptest::collection::vec(-1.5_f32..1.5, 200),
            coefficients in (0.0..0.1_f64, 0.0..1.0_f64, 0.1..2.0_f64, 0.05..0.5_f64, 0.3..1.5_f64),
        ) {
            let mut seed = seed.into_iter().cycle();
            let mut take = |length: usize| seed.by_ref().take(length).collect::<Vec<f32>>();
            let (output, log_std) = (take(count * (actions + 1)), take(actions));
            let rows = MinibatchRows {
                actions: take(count * actions),
                log_probs: take(count).iter().map(|log_prob| 2.0 * log_prob - actions as f32).collect(),
                advantages: take(count),
                returns: take(count),
            };
            let (entropy_coefficient, bounds_coefficient, value_coefficient, clip_range, bounds_limit) = coefficients;
            let config = PpoConfig {
                entropy_coefficient, bounds_coefficient, value_coefficient, clip_range, bounds_limit, ..PpoConfig::default()
            };
            let leaf = |numbers: &[f32], shape: (usize, usize)| Var::from_slice(numbers, shape, &Device::Cpu).expect("a tensor");
            let minibatch = rows.tensors().expect("a minibatch");
            let output = leaf(&output, (count, actions + 1));
            let log_std = Var::from_slice(&log_std, actions, &Device::Cpu).expect("a leaf");
            let wanted = ppo_loss(&output, &log_std, &minibatch, &config).expect("the loss");
            let (total, parts) = fused_ppo_loss(&output, &log_std, rows, &config).expect("the loss");

            prop_assert!(close(&numbers(&total), &numbers(&wanted.total)));
            for (found, wanted) in [
                (parts.policy, wanted.policy), (parts.value, wanted.value), (parts.entropy, wanted.entropy), (parts.bounds, wanted.bounds),
            ] {
                prop_assert!(close(&[found as f32], &numbers(&wanted)), "{found} {wanted}");
            }
            let ratios = numbers(&wanted.log_ratio);
            let clipped = ratios.iter().filter(|ratio| (ratio.exp() - 1.0).abs() > config.clip_range as f32);
            prop_assert_eq!(parts.clipped, clipped.count());
            let (found, wanted) = ((total * 3.0).expect("a product").backward(), (wanted.total * 3.0).expect("a product").backward());
            let (found, wanted) = (found.expect("a gradient"), wanted.expect("a gradient"));
            for leaf in [&output, &log_std] {
                let [found, wanted] = [&found, &wanted].map(|gradients| numbers(gradients.get(leaf).expect("a gradient")));
                prop_assert!(close(&found, &wanted), "{found:?} {wanted:?}");
            }
        }
    }
}
