//! Passes over a batch on a device: the processor here, a GPU in [`crate::gpu_passes`].

use rayon::ThreadPool;
use treadmill_config::PpoConfig;
use treadmill_policy::{
    Networks,
    gaussian::{self, clamp_log_std},
};

use crate::{
    batch::{Batch, minibatches},
    device::Device,
    loss_gradient::LossSums,
    measures::PolicyShift,
    optimiser::{OptimiserState, clip_factor, global_norm},
    options::PpoOptions,
    slice_gradient::SliceGradient,
    state::PpoState,
    tensor_gradient::TensorGradient,
    update_stats::{UpdateError, UpdateStats, check_finite},
};

/// Takes passes over the batch of one update.
pub(crate) trait Passes {
    /// Takes a gradient step on each minibatch of `order`, and adds their statistics. Returns the divergence from the policy
    /// that the update began with.
    fn pass(&mut self, state: &mut PpoState, order: &[u32], stats: &mut UpdateStats) -> Result<f64, UpdateError>;

    /// Restores parameters and moments from before the last pass.
    fn undo(&mut self, state: &mut PpoState) -> Result<(), UpdateError>;

    /// Leaves parameters and moments in the state.
    fn finish(&mut self, state: &mut PpoState) -> Result<(), UpdateError>;
}

/// Passes on the processor.
pub(crate) struct CpuPasses<'a> {
    gradient: Gradient<'a>,
    flat: Vec<f32>,
    networks: &'a Networks,
    config: &'a PpoConfig,
    pool: &'a ThreadPool,
    shift: PolicyShift,
    before: (Vec<f32>, OptimiserState),
}

/// What computes a gradient.
enum Gradient<'a> {
    Slices(Box<SliceGradient<'a>>),
    Tensors(TensorGradient<'a>),
}

impl<'a> CpuPasses<'a> {
    /// Prepares passes over a batch. `advantages` are the normalised ones, times their weights.
    pub(crate) fn new(
        batch: &'a Batch,
        advantages: &'a [f32],
        networks: &'a Networks,
        config: &'a PpoConfig,
        options: &'a PpoOptions,
        parameters: &[f32],
    ) -> Result<Self, UpdateError> {
        let gradient = match options.device {
            Device::Candle => Gradient::Tensors(TensorGradient::upload(batch, advantages, networks, config)?),
            _ => Gradient::Slices(SliceGradient::new(batch, advantages, networks, config, options.chunk_rows).into()),
        };
        let shift = PolicyShift::new(batch, networks, parameters);
        let flat = vec![0.0; parameters.len()];
        let pool = &options.pool;
        Ok(Self { gradient, flat, networks, config, pool, shift, before: (Vec::new(), OptimiserState::default()) })
    }

    fn steps(&mut self, state: &mut PpoState, order: &[u32], stats: &mut UpdateStats) -> Result<(), UpdateError> {
        for range in minibatches(order.len(), self.config.minibatch_rows()) {
            let rows = &order[range];
            let loss = match &mut self.gradient {
                Gradient::Slices(slices) => slices.compute(rows, &state.parameters, &mut self.flat),
                Gradient::Tensors(tensors) => tensors.compute(rows, &state.parameters, &mut self.flat)?,
            };
            self.step(state, rows.len(), &loss, stats)?;
        }
        Ok(())
    }

    /// Takes the step of a gradient: clipping, then Adam.
    fn step(
        &self,
        state: &mut PpoState,
        rows: usize,
        loss: &LossSums,
        stats: &mut UpdateStats,
    ) -> Result<(), UpdateError> {
        let PpoState { parameters, optimiser, learning_rate, .. } = state;
        stats.add(rows, loss, gaussian::entropy(&self.networks.log_std(parameters)));
        check_finite((loss.policy + loss.value + loss.bounds).is_finite(), "loss")?;
        let norm = global_norm(&self.flat);
        check_finite(norm.is_finite(), "gradient")?;
        stats.grad_norm += rows as f64 * norm;
        optimiser.apply(parameters, &self.flat, clip_factor(norm, self.config.max_grad_norm), *learning_rate);
        clamp_log_std(&mut parameters[self.networks.log_std_range()]);
        Ok(())
    }
}

impl Passes for CpuPasses<'_> {
    fn pass(&mut self, state: &mut PpoState, order: &[u32], stats: &mut UpdateStats) -> Result<f64, UpdateError> {
        if self.config.target_kl > 0.0 {
            self.before = (state.parameters.clone(), state.optimiser.clone());
        }
        // On a thread of the pool, so that the others wait for its next task and are not woken for each.
        self.pool.install(|| self.steps(state, order, stats))?;
        check_finite(state.parameters.iter().all(|p| p.is_finite()), "parameter vector")?;
        Ok(self.shift.divergence(&state.parameters, self.pool))
    }

    fn undo(&mut self, state: &mut PpoState) -> Result<(), UpdateError> {
        (state.parameters, state.optimiser) = std::mem::take(&mut self.before);
        Ok(())
    }

    fn finish(&mut self, _state: &mut PpoState) -> Result<(), UpdateError> {
        Ok(())
    }
}
