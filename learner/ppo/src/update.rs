//! One update: several epochs of gradient steps over one batch. If a number is not finite, the whole update is undone.

use std::sync::Arc;

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use treadmill_config::PpoConfig;
use treadmill_policy::{
    ParameterError, Policy,
    device::Device,
    gaussian::{self, clamp_log_std},
};

use crate::{
    batch::{Batch, minibatches, shuffle, weighted_advantages},
    loss_gradient::LossSums,
    measures::{PolicyShift, adapt_learning_rate, explained_variance},
    optimiser::{clip_factor, global_norm},
    slice_gradient::SliceGradient,
    state::PpoState,
    tensor_gradient::TensorGradient,
    update_stats::{UpdateError, UpdateStats, check_finite},
};

/// Multiple of [`PpoConfig::target_kl`] above which a pass over the batch is undone. Trainings of robots reach 2.6.
const KL_MAX: f64 = 8.0;
/// The learning rate is divided by this after a pass that was undone.
const UNDONE_FACTOR: f64 = 4.0;

/// What learning needs beside its state.
#[derive(Clone, Debug)]
pub struct PpoOptions {
    /// Device that computes gradients and values.
    pub device: Device,
    /// Threads of the update on a CPU; the results do not depend on their number.
    pub pool: Arc<ThreadPool>,
    /// Limit of normalised observations.
    pub observation_clip: f32,
}

impl PpoOptions {
    /// Returns options for a CPU.
    ///
    /// # Errors
    /// If the threads cannot be started.
    pub fn on_cpu(threads: usize) -> Result<Self, ThreadPoolBuildError> {
        let builder = ThreadPoolBuilder::new().thread_name(|index| format!("update-{index}"));
        let pool = builder.num_threads(threads).build()?;
        Ok(Self { device: Device::Cpu, pool: Arc::new(pool), observation_clip: 10.0 })
    }
}

/// Proximal policy optimisation: improves a [`PpoState`] batch by batch.
#[derive(Clone, Debug)]
pub struct Ppo {
    pub(crate) options: PpoOptions,
    pub(crate) config: PpoConfig,
    is_on_device: bool,
}

impl Ppo {
    /// Returns the algorithm with its settings.
    pub fn new(options: PpoOptions, config: &PpoConfig) -> Self {
        Self { is_on_device: !options.device.is_cpu(), options, config: config.clone() }
    }

    /// Replaces the settings.
    pub fn set_config(&mut self, config: &PpoConfig) {
        self.config = config.clone();
    }

    /// Returns the largest distance of a probability ratio from 1 that the loss rewards.
    pub fn clip_range(&self) -> f64 {
        self.config.clip_range
    }

    /// Returns the policy of a state, which evaluates many rows on the threads of the update.
    ///
    /// # Errors
    /// If the parameters do not fit the shape or are not finite.
    pub fn policy(&self, state: &PpoState) -> Result<Policy, ParameterError> {
        let PpoOptions { device, pool, .. } = &self.options;
        Policy::with_pool(state.networks.clone(), state.parameters.clone(), pool.clone(), device)
    }

    /// Takes `epochs` passes over a batch, in an order drawn from the state's random stream. A pass that leads too far from
    /// the policy of the batch is undone, and the next one takes smaller steps.
    ///
    /// # Errors
    /// If the batch does not fit, or a loss, gradient or parameter is not finite. Then only the random stream has changed.
    pub fn update(&self, state: &mut PpoState, batch: &Batch, epochs: u32) -> Result<UpdateStats, UpdateError> {
        if batch.is_empty() {
            return Err(UpdateError::Empty);
        }
        if let Some((field, found, expected)) = batch.wrong_length(state.networks.shape()) {
            return Err(UpdateError::Length { field, found, expected });
        }
        if let Some(what) = batch.non_finite(state.networks.shape()) {
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
        let (PpoOptions { device, pool, .. }, config) = (&self.options, &self.config);
        let networks = &state.networks.clone();
        let advantages = weighted_advantages(batch);
        let mut on_device = match self.is_on_device {
            true => Some(TensorGradient::upload(batch, &advantages, networks, config, device)?),
            false => None,
        };
        let mut on_slices = SliceGradient::new(batch, &advantages, networks, config);
        let mut compute_gradient = |rows: &[u32], parameters: &[f32], gradient: &mut [f32]| match &mut on_device {
            Some(tensors) => tensors.compute(rows, parameters, gradient).map_err(UpdateError::from),
            None => Ok(on_slices.compute(rows, parameters, gradient)),
        };

        let mut order: Vec<u32> = (0..batch.len() as u32).collect();
        let mut gradient = vec![0.0; state.parameters.len()];
        let shift = PolicyShift::new(batch, networks, &state.parameters);
        let mut stats = UpdateStats {
            explained_variance: explained_variance(&batch.values, &batch.returns),
            ..UpdateStats::default()
        };
        for _ in 0..epochs {
            let before = (config.target_kl > 0.0).then(|| (state.parameters.clone(), state.optimiser.clone()));
            shuffle(&mut order, &mut state.shuffle);
            // On a thread of the pool, so that the others wait for its next task and are not woken for each.
            pool.install(|| -> Result<(), UpdateError> {
                for range in minibatches(order.len(), config.minibatch_rows()) {
                    let rows = &order[range];
                    let loss = compute_gradient(rows, &state.parameters, &mut gradient)?;
                    self.step(state, rows.len(), &loss, &gradient, &mut stats)?;
                }
                Ok(())
            })?;
            check_finite(state.parameters.iter().all(|p| p.is_finite()), "parameter vector")?;
            let approx_kl = shift.divergence(&state.parameters, pool);
            check_finite(approx_kl.is_finite(), "divergence from the old policy")?;
            if let Some((parameters, optimiser)) = before
                && approx_kl > KL_MAX * config.target_kl
            {
                (state.parameters, state.optimiser) = (parameters, optimiser);
                state.learning_rate = (state.learning_rate / UNDONE_FACTOR).max(config.learning_rate_min);
                stats.undone_passes += 1;
                continue;
            }
            stats.approx_kl = approx_kl;
            state.learning_rate = adapt_learning_rate(state.learning_rate, approx_kl, config);
        }
        stats.finish(&networks.log_std(&state.parameters), state.learning_rate);
        Ok(stats)
    }

    /// Takes the step of a gradient: clipping, then Adam.
    fn step(
        &self,
        state: &mut PpoState,
        rows: usize,
        loss: &LossSums,
        gradient: &[f32],
        stats: &mut UpdateStats,
    ) -> Result<(), UpdateError> {
        let PpoState { networks, parameters, optimiser, learning_rate, .. } = state;
        stats.add(rows, loss, gaussian::entropy(&networks.log_std(parameters)));
        check_finite((loss.policy + loss.value + loss.bounds).is_finite(), "loss")?;
        let norm = global_norm(gradient);
        check_finite(norm.is_finite(), "gradient")?;
        stats.grad_norm += rows as f64 * norm;
        optimiser.apply(parameters, gradient, clip_factor(norm, self.config.max_grad_norm), *learning_rate);
        clamp_log_std(&mut parameters[networks.log_std_range()]);
        Ok(())
    }
}

#[cfg(test)]
#[path = "update_tests.rs"]
mod tests;
