//! Gradient steps on the processor, on plain slices: forward, loss, backward, clip, Adam.
//!
//! **Results do not depend on the number of threads.** The rows of a minibatch are divided into chunks of [`CHUNK_ROWS`].
//! Chunk `c` adds its gradient to lane `c mod L`, where `L` follows from the number of rows. Each lane processes its chunks in
//! order, and lanes are summed in order.

use rayon::{ThreadPool, prelude::*};
use treadmill_config::PpoConfig;
use treadmill_policy::{CHUNK_ROWS, Mlp, NetworkShape, Tape, gaussian::clamp_log_std};

use crate::{
    batch::{Batch, minibatches},
    loss_gradient::{LossSums, LossTerms},
    measures::PolicyShift,
    optimiser::{clip_factor, global_norm},
    state::PpoState,
    update_stats::{PassSums, UpdateError, check_finite},
};

/// Memory of all lanes in bytes. Every chunk has a lane of its own up to 47 chunks (12,032 rows) of networks of 256 and 128, so
/// that as many threads find work.
const LANE_BYTES_MAX: usize = 128 << 20;
/// Fewest lanes that the memory is divided into.
const LANES_MIN: usize = 8;
/// Parameters whose sum over lanes is one task.
const SUM_PARAMETERS: usize = 8192;

/// Batch of one update, and memory for its gradient steps.
pub(crate) struct CpuPass<'a> {
    batch: &'a Batch,
    /// Normalised advantages, times their weights.
    advantages: &'a [f32],
    config: &'a PpoConfig,
    shape: &'a NetworkShape,
    pool: &'a ThreadPool,
    actor: Mlp,
    critic: Mlp,
    /// Most partial gradients per network.
    lanes_max: usize,
    actor_lanes: Vec<Lane>,
    critic_lanes: Vec<Lane>,
    gradient: Vec<f32>,
}

/// Partial gradient of one network, and the memory to compute it.
#[derive(Default)]
struct Lane {
    tape: Tape,
    gradient: Vec<f32>,
    /// Gradient by `log_std`, which belongs to the actor.
    log_std_gradient: Vec<f64>,
    sums: LossSums,
}

impl<'a> CpuPass<'a> {
    pub(crate) fn new(
        batch: &'a Batch,
        advantages: &'a [f32],
        shape: &'a NetworkShape,
        config: &'a PpoConfig,
        pool: &'a ThreadPool,
    ) -> Self {
        let (actor, critic) = (Mlp::new(shape.actor()), Mlp::new(shape.critic()));
        let lane = |network: &Mlp| network.range().len() + CHUNK_ROWS * network.tape_width();
        let lane_bytes = size_of::<f32>() * (lane(&actor) + lane(&critic));
        Self {
            batch,
            advantages,
            config,
            shape,
            pool,
            lanes_max: LANES_MIN.max(LANE_BYTES_MAX / lane_bytes),
            actor_lanes: Vec::new(),
            critic_lanes: Vec::new(),
            gradient: vec![0.0; shape.parameter_count()],
            actor,
            critic,
        }
    }

    /// Takes one pass over the batch in the given order.
    pub(crate) fn run(
        &mut self,
        order: &[u32],
        shift: &PolicyShift,
        state: &mut PpoState,
    ) -> Result<PassSums, UpdateError> {
        let mut sums = PassSums::default();
        let pool = self.pool;
        // On a thread of the pool, so that the others wait for its next task and are not woken for each.
        pool.install(|| {
            let mut ranges = minibatches(order.len(), self.config.minibatch_rows(order.len()));
            ranges.try_for_each(|range| self.gradient_step(&order[range], state, &mut sums))
        })?;
        let parameters = &state.parameters;
        check_finite(parameters.iter().all(|p| p.is_finite()), "parameter vector")?;
        sums.divergence =
            shift.divergence(&shift.means_of(&self.actor, parameters, pool), &parameters[self.shape.log_std()]);
        check_finite(sums.divergence.is_finite(), "divergence from the old policy")?;
        Ok(sums)
    }

    /// Takes one gradient step over the given rows, and adds their contributions to `sums`.
    fn gradient_step(&mut self, rows: &[u32], state: &mut PpoState, sums: &mut PassSums) -> Result<(), UpdateError> {
        let log_std = self.shape.log_std();
        let terms =
            LossTerms::new(self.batch, self.advantages, self.config, &state.parameters[log_std.clone()], rows.len());
        let loss = self.compute_gradient(&terms, rows, &state.parameters);
        check_finite(terms.total(&loss, rows.len()).is_finite(), "loss")?;
        let norm = global_norm(&self.gradient);
        check_finite(norm.is_finite(), "gradient")?;

        let PpoState { parameters, optimiser, learning_rate, .. } = state;
        optimiser.apply(parameters, &self.gradient, clip_factor(norm, self.config.max_grad_norm), *learning_rate);
        clamp_log_std(&mut parameters[log_std]);

        sums.policy_loss += loss.policy;
        sums.value_loss += loss.value;
        sums.bounds_loss += loss.bounds;
        sums.clipped += loss.clipped;
        sums.entropy += rows.len() as f64 * terms.entropy();
        sums.grad_norm += rows.len() as f64 * norm;
        Ok(())
    }

    /// Computes the flat gradient of the loss over the given rows. Returns the loss.
    fn compute_gradient(&mut self, terms: &LossTerms, rows: &[u32], parameters: &[f32]) -> LossSums {
        let Self { batch, shape, actor, critic, actor_lanes, critic_lanes, gradient, config, .. } = self;
        let lanes = rows.len().div_ceil(CHUNK_ROWS).min(self.lanes_max);
        let lane_rows = |lane: usize| rows.chunks(CHUNK_ROWS).skip(lane).step_by(lanes);
        actor_lanes.resize_with(lanes, Lane::default);
        critic_lanes.resize_with(lanes, Lane::default);

        let evaluate = |network: &Mlp, rows: &[u32], tape: &mut Tape| {
            let rows = rows.iter().map(|row| *row as usize);
            network.gather(&batch.observations, shape.observation, rows, tape);
            network.forward(parameters, tape);
        };
        let actor_lane = |(number, lane): (usize, &mut Lane)| {
            lane.begin(actor, shape.action);
            let Lane { tape, gradient, log_std_gradient, sums } = lane;
            for (index, rows) in lane_rows(number).enumerate() {
                evaluate(actor, rows, tape);
                terms.policy(rows, &tape.output, &mut tape.gradient, log_std_gradient, sums);
                actor.backward(parameters, tape, gradient, index > 0);
            }
        };
        let critic_lane = |(number, lane): (usize, &mut Lane)| {
            lane.begin(critic, 0);
            let Lane { tape, gradient, sums, .. } = lane;
            for (index, rows) in lane_rows(number).enumerate() {
                evaluate(critic, rows, tape);
                terms.value(rows, &tape.output, &mut tape.gradient, sums);
                critic.backward(parameters, tape, gradient, index > 0);
            }
        };
        rayon::join(
            || actor_lanes.par_iter_mut().enumerate().with_max_len(1).for_each(actor_lane),
            || critic_lanes.par_iter_mut().enumerate().with_max_len(1).for_each(critic_lane),
        );

        sum_gradients(actor_lanes, &mut gradient[actor.range()]);
        sum_gradients(critic_lanes, &mut gradient[critic.range()]);
        for (index, target) in gradient[shape.log_std()].iter_mut().enumerate() {
            let sum = actor_lanes.iter().map(|lane| lane.log_std_gradient[index]).sum::<f64>();
            *target = (sum - config.entropy_coefficient) as f32;
        }
        let mut loss = LossSums::default();
        for Lane { sums, .. } in actor_lanes.iter().chain(&*critic_lanes) {
            loss.policy += sums.policy;
            loss.value += sums.value;
            loss.bounds += sums.bounds;
            loss.clipped += sums.clipped;
        }
        loss
    }
}

impl Lane {
    /// Begins a gradient step. The first chunk replaces the gradient of the networks.
    fn begin(&mut self, network: &Mlp, actions: usize) {
        self.gradient.resize(network.range().len(), 0.0);
        self.log_std_gradient.clear();
        self.log_std_gradient.resize(actions, 0.0);
        self.sums = LossSums::default();
    }
}

/// Sums the partial gradients of one network.
fn sum_gradients(lanes: &[Lane], gradient: &mut [f32]) {
    gradient.par_chunks_mut(SUM_PARAMETERS).enumerate().for_each(|(part, target)| {
        let start = part * SUM_PARAMETERS;
        target.fill(0.0);
        for lane in lanes {
            let parts = &lane.gradient[start..start + target.len()];
            target.iter_mut().zip(parts).for_each(|(sum, part)| *sum += part);
        }
    });
}

#[cfg(test)]
#[path = "gradient_step_tests.rs"]
pub(crate) mod tests;
