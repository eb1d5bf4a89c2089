//! One update: several epochs of gradient steps over one batch. If a number is not finite, the whole update is undone.

use treadmill_config::PpoConfig;
use treadmill_gpu::GpuError;
use treadmill_policy::{Networks, ParameterError, Policy};

use crate::{
    batch::{Batch, shuffle, weighted_advantages},
    device::Device,
    gpu_passes::{self, GpuPasses},
    measures::{adapt_learning_rate, explained_variance},
    options::PpoOptions,
    passes::{CpuPasses, Passes},
    settings::BatchSize,
    state::PpoState,
    update_stats::{UpdateError, UpdateStats, check_finite},
};

/// Multiple of [`PpoConfig::target_kl`] above which a pass over the batch is undone. Trainings of robots reach 2.6.
const KL_MAX: f64 = 8.0;
/// The learning rate is divided by this after a pass that was undone.
const UNDONE_FACTOR: f64 = 4.0;

/// Proximal policy optimisation: improves a [`PpoState`] batch by batch.
#[derive(Clone, Debug)]
pub struct Ppo {
    pub(crate) options: PpoOptions,
    pub(crate) config: PpoConfig,
}

impl Ppo {
    /// Returns the algorithm with its settings.
    pub fn new(options: PpoOptions, config: &PpoConfig) -> Self {
        Self { options, config: config.clone() }
    }

    /// Replaces the settings.
    pub fn set_config(&mut self, config: &PpoConfig) {
        self.config = config.clone();
    }

    /// Takes the memory of a GPU that updates need, so that a lack of it is found before the first one. Returns what is
    /// known of the GPU, and that memory in bytes; `None` on a processor.
    ///
    /// # Errors
    /// If the memory is too small.
    pub fn reserve(&self, networks: &Networks) -> Result<Option<(String, u64)>, GpuError> {
        let Device::Cuda(gpu, session) = &self.options.device else { return Ok(None) };
        let rows = BatchSize::of(&self.config).transitions_max;
        let session = gpu_passes::reserve(gpu, session, networks, &self.config, rows)?;
        Ok(session.as_ref().map(|session| (gpu.to_string(), session.memory_bytes())))
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
        Policy::with_pool(state.networks.clone(), state.parameters.clone(), self.options.pool.clone())
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
        let (PpoOptions { device, .. }, config) = (&self.options, &self.config);
        let networks = &state.networks.clone();
        let advantages = weighted_advantages(batch);
        let mut passes: Box<dyn Passes> = match device {
            Device::Cuda(gpu, session) => Box::new(GpuPasses::new(batch, &advantages, state, config, (gpu, session))?),
            _ => Box::new(CpuPasses::new(batch, &advantages, networks, config, &self.options, &state.parameters)?),
        };
        let mut order: Vec<u32> = (0..batch.len() as u32).collect();
        let mut stats = UpdateStats {
            explained_variance: explained_variance(&batch.values, &batch.returns),
            ..UpdateStats::default()
        };
        for _ in 0..epochs {
            shuffle(&mut order, &mut state.shuffle);
            let approx_kl = passes.pass(state, &order, &mut stats)?;
            check_finite(approx_kl.is_finite(), "divergence from the old policy")?;
            if config.target_kl > 0.0 && approx_kl > KL_MAX * config.target_kl {
                passes.undo(state)?;
                state.learning_rate = (state.learning_rate / UNDONE_FACTOR).max(config.learning_rate_min);
                stats.undone_passes += 1;
                continue;
            }
            stats.approx_kl = approx_kl;
            state.learning_rate = adapt_learning_rate(state.learning_rate, approx_kl, config);
        }
        passes.finish(state)?;
        stats.finish(&networks.log_std(&state.parameters), state.learning_rate);
        Ok(stats)
    }
}

#[cfg(test)]
#[path = "update_tests.rs"]
mod tests;
