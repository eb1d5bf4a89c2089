//! One update: several epochs of gradient steps over one batch. If a number is not finite, the whole update is undone.

use std::sync::Arc;

use candle_core::{Device, Tensor, Var};
use rayon::ThreadPool;
use treadmill_config::PpoConfig;
use treadmill_policy::gaussian::clamp_log_std;
use treadmill_policy::{NetworkPart, NetworkShape, Networks, ParameterError, Policy};

use crate::{
    batch::{Batch, minibatches, shuffle, weighted_advantages},
    device_pass::DevicePass,
    fused_loss::fused_ppo_loss,
    measures::{PolicyShift, adapt_learning_rate, explained_variance},
    mirror::BatchMirror,
    optimiser::{clip_factor, global_norm},
    state::PpoState,
};

/// What learning needs beside its state.
#[derive(Clone, Debug)]
pub struct PpoOptions {
    /// Shape of the networks.
    pub shape: NetworkShape,
    /// Device of the networks. On a GPU, the whole update runs there.
    pub device: Device,
    /// Threads of the update on a CPU; the results do not depend on their number.
    pub pool: Arc<ThreadPool>,
    /// Mirror for `ppo.symmetry`.
    pub mirror: Option<BatchMirror>,
    /// Limit of normalised observations.
    pub observation_clip: f32,
}

/// Proximal policy optimisation: improves a [`PpoState`] batch by batch.
#[derive(Clone, Debug)]
pub struct Ppo {
    pub(crate) options: PpoOptions,
    pub(crate) config: PpoConfig,
    networks: Networks,
    actor: Networks,
}

/// Sums over the rows of one pass, and the divergence after it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PassSums {
    pub(crate) policy_loss: f64,
    pub(crate) value_loss: f64,
    pub(crate) entropy: f64,
    pub(crate) bounds_loss: f64,
    pub(crate) grad_norm: f64,
    pub(crate) clipped: f64,
    pub(crate) divergence: f64,
}

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
    /// KL divergence in nats from the policy that the update started from to that after the last epoch, in closed form over a
    /// sample of the rows.
    pub approx_kl: f64,
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
    #[error("{field} of the batch has {found} numbers, expected {expected}")]
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
    /// Candle failed.
    #[error("the tensor library failed")]
    Tensor(#[from] candle_core::Error),
    /// The parameters cannot be evaluated.
    #[error("the parameters cannot be used")]
    Parameters(#[from] ParameterError),
}

impl Ppo {
    /// Returns the algorithm with its settings.
    pub fn new(options: PpoOptions, config: &PpoConfig) -> Self {
        let PpoOptions { shape, device, pool, .. } = &options;
        let networks = Networks::on(device, shape, NetworkPart::ActorCritic, Some(pool.clone()));
        let actor = Networks::on(device, shape, NetworkPart::Actor, Some(pool.clone()));
        Self { networks, actor, options, config: config.clone() }
    }

    /// Replaces the settings.
    pub fn set_config(&mut self, config: &PpoConfig) {
        self.config = config.clone();
    }

    /// Returns the policy of a state, which evaluates many rows on the threads of the update.
    ///
    /// # Errors
    /// If the parameters do not fit the shape or are not finite.
    pub fn policy(&self, state: &PpoState) -> Result<Policy, ParameterError> {
        let PpoOptions { shape, device, pool, .. } = &self.options;
        Policy::with_pool(shape.clone(), state.parameters.clone(), pool.clone(), device)
    }

    /// Takes `epochs` passes over a batch, in an order drawn from the state's random stream.
    ///
    /// # Errors
    /// If the batch does not fit, or a loss, gradient or parameter is not finite. Then only the random stream has changed.
    pub fn update(&self, state: &mut PpoState, batch: &Batch, epochs: u32) -> Result<UpdateStats, UpdateError> {
        if batch.is_empty() {
            return Err(UpdateError::Empty);
        }
        if let Some((field, found, expected)) = batch.wrong_length(&self.options.shape) {
            return Err(UpdateError::Length { field, found, expected });
        }
        if let Some(what) = batch.non_finite() {
            return Err(UpdateError::NonFinite { what });
        }
        let before = state.clone();
        let result = self.run_epochs(state, batch, epochs);
        if result.is_err() {
            *state = PpoState { shuffle: state.shuffle.clone(), ..before };
        }
        result
    }

    fn run_epochs(&self, state: &mut PpoState, batch: &Batch, epochs: u32) -> Result<UpdateStats, UpdateError> {
        let PpoOptions { shape, device, pool, .. } = &self.options;
        let advantages = weighted_advantages(batch);
        let mut order: Vec<u32> = (0..batch.len() as u32).collect();
        let shift = PolicyShift::new(batch, shape, &state.parameters[shape.log_std()], device)?;
        let mut on_device = match &self.networks {
            Networks::Fused(_) => None,
            Networks::Plain(..) => Some(DevicePass::upload(batch, &advantages, shape, &self.config, device, state)?),
        };
        let mut stats = UpdateStats {
            explained_variance: explained_variance(&batch.values, &batch.returns),
            ..UpdateStats::default()
        };
        for _ in 0..epochs {
            shuffle(&mut order, &mut state.shuffle);
            let sums = match &mut on_device {
                Some(pass) => pass.run(&order, &self.actor, &shift, state)?,
                None => {
                    // On a thread of the pool, so that the others wait for its next task and are not woken for each.
                    pool.install(|| self.pass(state, batch, &order, &advantages, &shift))?
                }
            };
            stats.add(&sums, &order, self.config.minibatch_rows(order.len()));
            state.learning_rate = adapt_learning_rate(state.learning_rate, sums.divergence, &self.config);
        }
        stats.finish(&state.parameters[shape.log_std()], state.learning_rate);
        Ok(stats)
    }

    /// Takes one pass over the batch on the CPU.
    fn pass(
        &self,
        state: &mut PpoState,
        batch: &Batch,
        order: &[u32],
        advantages: &[f32],
        shift: &PolicyShift,
    ) -> Result<PassSums, UpdateError> {
        let mut sums = PassSums::default();
        for range in minibatches(order.len(), self.config.minibatch_rows(order.len())) {
            self.gradient_step(state, batch, &order[range], advantages, &mut sums)?;
        }
        let parameters = &state.parameters;
        check_finite(parameters.iter().all(|p| p.is_finite()), "parameter vector")?;
        let tensor = Tensor::from_slice(parameters, parameters.len(), &self.options.device)?;
        let means = shift.new_means(&self.actor, &tensor)?.flatten_all()?.to_vec1::<f32>()?;
        sums.divergence = shift.divergence(&means, &parameters[self.options.shape.log_std()]);
        check_finite(sums.divergence.is_finite(), "divergence from the old policy")?;
        Ok(sums)
    }

    /// Forward, loss, backward, clipping, Adam. Adds the rows' contributions to `sums`.
    fn gradient_step(
        &self,
        state: &mut PpoState,
        batch: &Batch,
        rows: &[u32],
        advantages: &[f32],
        sums: &mut PassSums,
    ) -> Result<(), UpdateError> {
        let (observations, minibatch) = batch.gather(rows, advantages, &self.options.shape, &self.options.device)?;
        // A separate leaf: Candle's gradient of a slice of the flat vector would be as long as the vector.
        let log_std_range = self.options.shape.log_std();
        let log_std = leaf(&state.parameters[log_std_range.clone()], &self.options.device)?;
        let parameters = leaf(&state.parameters, &self.options.device)?;

        let output = self.networks.forward(&parameters, &observations)?;
        let (total, parts) = fused_ppo_loss(&output, &log_std, minibatch, &self.config)?;
        check_finite(scalar(&total)?.is_finite(), "loss")?;

        let gradients = total.backward()?;
        let gradient_of = |leaf: &Var| gradients.get(leaf).expect("the loss depends on every leaf").to_vec1::<f32>();
        let mut gradient = gradient_of(&parameters)?;
        gradient[log_std_range.clone()].copy_from_slice(&gradient_of(&log_std)?);
        let norm = global_norm(&gradient);
        check_finite(norm.is_finite(), "gradient")?;

        let PpoState { parameters, optimiser, learning_rate, .. } = state;
        optimiser.apply(parameters, &gradient, clip_factor(norm, self.config.max_grad_norm), *learning_rate);
        clamp_log_std(&mut parameters[log_std_range]);

        let weight = rows.len() as f64;
        sums.policy_loss += weight * parts.policy;
        sums.value_loss += weight * parts.value;
        sums.entropy += weight * parts.entropy;
        sums.bounds_loss += weight * parts.bounds;
        sums.grad_norm += weight * norm;
        sums.clipped += parts.clipped as f64;
        Ok(())
    }
}

impl UpdateStats {
    /// Adds the sums of one pass over rows in the given order.
    fn add(&mut self, sums: &PassSums, order: &[u32], minibatch: usize) {
        self.policy_loss += sums.policy_loss;
        self.value_loss += sums.value_loss;
        self.entropy += sums.entropy;
        self.bounds_loss += sums.bounds_loss;
        self.grad_norm += sums.grad_norm;
        self.clip_fraction += sums.clipped;
        self.approx_kl = sums.divergence;
        self.gradient_steps += minibatches(order.len(), minibatch).count() as u64;
        self.samples += order.len() as u64;
    }

    /// Converts sums to means.
    fn finish(&mut self, log_std: &[f32], learning_rate: f64) {
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

fn leaf(numbers: &[f32], device: &Device) -> candle_core::Result<Var> {
    Var::from_slice(numbers, numbers.len(), device)
}

fn scalar(tensor: &Tensor) -> candle_core::Result<f64> {
    Ok(f64::from(tensor.to_scalar::<f32>()?))
}

#[cfg(test)]
#[path = "update_tests.rs"]
mod tests;
