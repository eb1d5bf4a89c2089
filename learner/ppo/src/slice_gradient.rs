//! Gradient of the loss on a processor, on plain slices: gather, forward, loss, backward.
//!
//! **Results do not depend on the number of threads.** The rows of a minibatch are divided into chunks.
//! Chunk `c` adds its gradient to lane `c mod L`, where `L` follows from the number of rows. Each lane processes its
//! chunks in order, and lanes are summed in order.

use std::borrow::Cow;

use rayon::prelude::*;
use treadmill_config::PpoConfig;
use treadmill_policy::{ForwardWeights, Mlp, Networks, Tape};

use crate::{
    batch::Batch,
    loss_gradient::{LossSums, LossTerms},
};

/// Memory of all lanes in bytes. Every chunk has a lane of its own up to 47 chunks of 256 rows (12,032 rows) of networks of
/// 256 and 128, so that as many threads find work.
const LANE_BYTES_MAX: usize = 128 << 20;
/// Fewest lanes that the memory is divided into.
const LANES_MIN: usize = 8;
/// Parameters whose sum over lanes is one task.
const SUM_PARAMETERS: usize = 8192;

/// Batch of one update, and memory for its gradients.
pub(crate) struct SliceGradient<'a> {
    batch: &'a Batch,
    /// Normalised advantages, times their weights.
    advantages: &'a [f32],
    config: &'a PpoConfig,
    networks: &'a Networks,
    /// Observations as both networks read them.
    inputs: Cow<'a, [f32]>,
    /// Those of a minibatch.
    gathered: Vec<f32>,
    actor: Mlp,
    critic: Mlp,
    actor_weights: ForwardWeights,
    critic_weights: ForwardWeights,
    /// Rows of a chunk.
    chunk_rows: usize,
    /// Most partial gradients per network.
    lanes_max: usize,
    actor_lanes: Vec<Lane>,
    critic_lanes: Vec<Lane>,
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

impl<'a> SliceGradient<'a> {
    pub(crate) fn new(
        batch: &'a Batch,
        advantages: &'a [f32],
        networks: &'a Networks,
        config: &'a PpoConfig,
        chunk_rows: usize,
    ) -> Self {
        let (actor, critic) = (networks.actor(), networks.critic());
        let inputs = critic.inputs(&batch.observations);
        let lane = |network: &Mlp| network.range().len() + chunk_rows * network.tape_width();
        let lane_bytes = size_of::<f32>() * (lane(&actor) + lane(&critic));
        let lanes_max = LANES_MIN.max(LANE_BYTES_MAX / lane_bytes);
        Self {
            batch,
            advantages,
            config,
            networks,
            inputs,
            gathered: Vec::new(),
            actor,
            critic,
            actor_weights: ForwardWeights::default(),
            critic_weights: ForwardWeights::default(),
            chunk_rows,
            lanes_max,
            actor_lanes: Vec::new(),
            critic_lanes: Vec::new(),
        }
    }

    /// Computes the flat gradient of the loss over the given rows, on the threads of the pool that calls it. Returns
    /// the loss.
    pub(crate) fn compute(&mut self, rows: &[u32], parameters: &[f32], gradient: &mut [f32]) -> LossSums {
        let Self { batch, networks, inputs, gathered, actor, critic, actor_lanes, critic_lanes, config, .. } = self;
        let shape = networks.shape();
        let (columns, chunk) = (shape.observation, self.chunk_rows);
        gathered.resize(rows.len() * columns, 0.0);
        rayon::join(
            || gather(inputs, columns, rows, gathered, chunk),
            || {
                rayon::join(
                    || actor.prepare(parameters, &mut self.actor_weights),
                    || critic.prepare(parameters, &mut self.critic_weights),
                )
            },
        );
        let (gathered, actor_weights, critic_weights) = (&*gathered, &self.actor_weights, &self.critic_weights);
        let terms = LossTerms::new(batch, self.advantages, config, &networks.log_std(parameters), rows.len());
        let lanes = rows.len().div_ceil(chunk).min(self.lanes_max);
        let chunks = || rows.chunks(chunk).zip(gathered.chunks(chunk * columns));
        let chunks_of = |lane: usize| chunks().skip(lane).step_by(lanes).enumerate();
        actor_lanes.resize_with(lanes, Lane::default);
        critic_lanes.resize_with(lanes, Lane::default);

        let actor_lane = |(number, lane): (usize, &mut Lane)| {
            let Lane { tape, gradient, log_std_gradient, sums } = lane.begin(actor, shape.action);
            for (index, (rows, inputs)) in chunks_of(number) {
                actor.forward(actor_weights, inputs, columns, tape);
                let (means, by_means) = tape.output_and_gradient();
                terms.policy(rows, means, by_means, log_std_gradient, sums);
                actor.backward(parameters, inputs, columns, tape, gradient, index > 0);
            }
        };
        let critic_lane = |(number, lane): (usize, &mut Lane)| {
            let Lane { tape, gradient, sums, .. } = lane.begin(critic, 0);
            for (index, (rows, inputs)) in chunks_of(number) {
                critic.forward(critic_weights, inputs, columns, tape);
                let (values, by_values) = tape.output_and_gradient();
                terms.value(rows, values, by_values, sums);
                critic.backward(parameters, inputs, columns, tape, gradient, index > 0);
            }
        };
        rayon::join(
            || actor_lanes.par_iter_mut().enumerate().with_max_len(1).for_each(actor_lane),
            || critic_lanes.par_iter_mut().enumerate().with_max_len(1).for_each(critic_lane),
        );

        sum_gradients(actor_lanes, &mut gradient[actor.range()]);
        sum_gradients(critic_lanes, &mut gradient[critic.range()]);
        let sum = |action: usize| actor_lanes.iter().map(|lane| lane.log_std_gradient[action]).sum::<f64>();
        let by_log_std: Vec<f64> = (0..shape.action).map(|action| sum(action) - config.entropy_coefficient).collect();
        gradient[networks.log_std_range()].copy_from_slice(&networks.fold_log_std(&by_log_std));
        actor_lanes.iter().chain(&*critic_lanes).map(|lane| lane.sums).sum()
    }
}

impl Lane {
    /// Begins a gradient. Its first chunk replaces the gradient of the network.
    fn begin(&mut self, network: &Mlp, actions: usize) -> &mut Self {
        self.gradient.resize(network.range().len(), 0.0);
        self.log_std_gradient.clear();
        self.log_std_gradient.resize(actions, 0.0);
        self.sums = LossSums::default();
        self
    }
}

/// Copies rows of `inputs` to `gathered`, a chunk of rows at a time; both have so many columns.
fn gather(inputs: &[f32], columns: usize, rows: &[u32], gathered: &mut [f32], chunk: usize) {
    let chunks = gathered.par_chunks_mut(chunk * columns).zip(rows.par_chunks(chunk));
    chunks.for_each(|(gathered, rows)| {
        for (target, row) in gathered.chunks_exact_mut(columns).zip(rows) {
            target.copy_from_slice(&inputs[*row as usize * columns..][..columns]);
        }
    });
}

/// Sums the partial gradients of one network.
fn sum_gradients(lanes: &[Lane], gradient: &mut [f32]) {
    gradient.par_chunks_mut(SUM_PARAMETERS).enumerate().for_each(|(part, target)| {
        let range = part * SUM_PARAMETERS..part * SUM_PARAMETERS + target.len();
        let mut parts = lanes.iter().map(|lane| &lane.gradient[range.clone()]);
        target.copy_from_slice(parts.next().expect("a minibatch has rows"));
        for part in parts {
            target.iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
        }
    });
}

#[cfg(test)]
#[path = "slice_gradient_tests.rs"]
mod tests;
