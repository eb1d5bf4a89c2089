//! Passes over a batch on a GPU.

use std::sync::{Mutex, MutexGuard, PoisonError};

use treadmill_config::PpoConfig;
use treadmill_gpu::{Gpu, GpuBatch, GpuError, PassSettings, Session};
use treadmill_policy::Networks;

use crate::{
    batch::{Batch, minibatches},
    measures::{KL_ROWS, PolicyShift, spread_rows},
    passes::Passes,
    settings::BatchSize,
    state::PpoState,
    update_stats::{UpdateError, UpdateStats, check_finite},
};

/// Passes whose state is on a GPU until the update ends.
pub(crate) struct GpuPasses<'a> {
    session: MutexGuard<'a, Option<Session>>,
    config: &'a PpoConfig,
    /// Gradient steps of a pass.
    steps: u64,
}

/// Allocates the memory of updates with such settings, unless it is there. Returns it.
///
/// # Errors
/// If the memory of the GPU is too small, or the driver fails.
pub(crate) fn reserve<'a>(
    gpu: &Gpu,
    session: &'a Mutex<Option<Session>>,
    networks: &Networks,
    config: &PpoConfig,
    rows: usize,
) -> Result<MutexGuard<'a, Option<Session>>, GpuError> {
    let mut session = session.lock().unwrap_or_else(PoisonError::into_inner);
    let largest = |rows: usize| minibatches(rows, config.minibatch_rows()).map(|range| range.len()).max().unwrap_or(0);
    // A minibatch has up to one and a half times the rows, also of a batch that has grown.
    let grown = config.minibatch_rows() * config.growth(u64::MAX) as usize * 3 / 2;
    let most = largest(rows).max(grown).min(rows.max(BatchSize::of(config).transitions_max));
    if session.as_ref().is_none_or(|session| !session.fits(networks, rows, largest(rows), KL_ROWS)) {
        let batch = rows.max(BatchSize::of(config).transitions_max);
        // The old memory is free before the new is taken, once the GPU has done all.
        gpu.synchronize()?;
        *session = None;
        gpu.synchronize()?;
        *session = Some(Session::new(gpu, networks, batch, most, KL_ROWS)?);
    }
    Ok(session)
}

impl<'a> GpuPasses<'a> {
    /// Uploads a batch. `advantages` are the normalised ones, times their weights.
    pub(crate) fn new(
        batch: &Batch,
        advantages: &[f32],
        state: &PpoState,
        config: &'a PpoConfig,
        (gpu, session): (&Gpu, &'a Mutex<Option<Session>>),
    ) -> Result<Self, GpuError> {
        let networks = &state.networks;
        let mut session = reserve(gpu, session, networks, config, batch.len())?;
        let measured = spread_rows(batch.len());
        let shift = PolicyShift::new(batch, networks, &state.parameters);
        let batch = GpuBatch {
            inputs: &networks.critic().inputs(&batch.observations),
            actions: &batch.actions,
            log_probs: &batch.log_probs,
            advantages,
            returns: &batch.returns,
            measured: &measured,
            old_means: shift.old_means(),
            old_log_std: &networks.log_std(&state.parameters),
        };
        let optimiser = &state.optimiser;
        let parts = [&state.parameters[..], &optimiser.first_moment, &optimiser.second_moment];
        session.as_mut().expect("it was reserved").begin(&batch, parts, optimiser.step)?;
        Ok(Self { session, config, steps: 0 })
    }

    fn session(&mut self) -> &mut Session {
        self.session.as_mut().expect("it was reserved")
    }
}

impl Passes for GpuPasses<'_> {
    fn pass(&mut self, state: &mut PpoState, order: &[u32], stats: &mut UpdateStats) -> Result<f64, UpdateError> {
        let config = self.config;
        let settings = PassSettings {
            learning_rate: state.learning_rate,
            max_grad_norm: config.max_grad_norm,
            clip_range: config.clip_range,
            value_coefficient: config.value_coefficient,
            entropy_coefficient: config.entropy_coefficient,
            bounds_coefficient: config.bounds_coefficient,
            bounds_limit: config.bounds_limit,
        };
        let sizes: Vec<_> = minibatches(order.len(), config.minibatch_rows()).map(|range| range.len()).collect();
        self.steps = sizes.len() as u64;
        let sums = self.session().pass(order, &sizes, &settings)?;
        stats.policy_loss += sums.policy;
        stats.value_loss += sums.value;
        stats.bounds_loss += sums.bounds;
        stats.clip_fraction += sums.clipped;
        stats.entropy += sums.entropy;
        stats.grad_norm += sums.grad_norm;
        stats.gradient_steps += self.steps;
        stats.samples += order.len() as u64;
        check_finite(sums.failure.is_none(), sums.failure.unwrap_or_default())?;
        Ok(sums.divergence)
    }

    fn undo(&mut self, _state: &mut PpoState) -> Result<(), UpdateError> {
        let steps = self.steps;
        Ok(self.session().undo(steps)?)
    }

    fn finish(&mut self, state: &mut PpoState) -> Result<(), UpdateError> {
        let (step, [parameters, first_moment, second_moment]) = self.session().state()?;
        state.parameters = parameters;
        state.optimiser = crate::optimiser::OptimiserState { step, first_moment, second_moment };
        Ok(())
    }
}
