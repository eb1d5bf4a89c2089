//! One update: several epochs of gradient steps over one batch. If a number is not finite, the whole update is undone.

use std::sync::Arc;

use rayon::ThreadPool;
use treadmill_config::PpoConfig;
use treadmill_policy::{NetworkShape, ParameterError, Policy, device::Device};

use crate::{
    batch::{Batch, shuffle, weighted_advantages},
    device_pass::DevicePass,
    gradient_step::CpuPass,
    measures::{PolicyShift, adapt_learning_rate, explained_variance},
    mirror::BatchMirror,
    state::PpoState,
    update_stats::{UpdateError, UpdateStats},
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
        let (PpoOptions { shape, device, pool, .. }, config) = (&self.options, &self.config);
        let advantages = weighted_advantages(batch);
        let mut order: Vec<u32> = (0..batch.len() as u32).collect();
        let shift = PolicyShift::new(batch, shape, &state.parameters[shape.log_std()]);
        let mut on_device = match self.is_on_device {
            true => Some(DevicePass::upload(batch, &advantages, &shift, shape, config, device, state)?),
            false => None,
        };
        let mut on_cpu = CpuPass::new(batch, &advantages, shape, config, pool);
        let mut stats = UpdateStats {
            explained_variance: explained_variance(&batch.values, &batch.returns),
            ..UpdateStats::default()
        };
        for _ in 0..epochs {
            shuffle(&mut order, &mut state.shuffle);
            let sums = match &mut on_device {
                Some(pass) => pass.run(&order, &shift, state)?,
                None => on_cpu.run(&order, &shift, state)?,
            };
            stats.add(&sums, &order, config.minibatch_rows(order.len()));
            state.learning_rate = adapt_learning_rate(state.learning_rate, sums.divergence, config);
        }
        stats.finish(&state.parameters[shape.log_std()], state.learning_rate);
        Ok(stats)
    }
}

#[cfg(test)]
#[path = "update_tests.rs"]
mod tests;
