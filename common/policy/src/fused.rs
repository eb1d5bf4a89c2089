//! Several networks over the same observations as one Candle operation with its own gradient.
//!
//! Candle's graph has one node instead of thirty, the element-wise loops are vectorised, and memory is reused. The operation
//! runs on a CPU only; `plain` runs on a GPU.
//!
//! **Results do not depend on the number of threads.** Rows are divided into chunks of [`CHUNK_ROWS`]. Chunk `c` adds its
//! gradient to lane `c mod L`, where `L` follows from the number of rows. Each lane processes its chunks in order, and lanes
//! are summed in order.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use candle_core::{CpuStorage, CustomOp2, Layout, Result, Shape, Storage, Tensor, bail};
use rayon::ThreadPool;
use rayon::prelude::*;

use super::kernel::{Mlp, Scratch};
use super::{NetworkPart, NetworkShape};

/// Rows that are processed together, so that the activations of one layer stay in the second-level cache.
const CHUNK_ROWS: usize = 256;
/// Memory of all lanes in bytes. Every chunk has a lane of its own up to 93 chunks (23,808 rows) of the default networks, and
/// up to 29 with hidden layers of 512 and 256, so that as many threads find work. More lanes cost nothing on one thread: 8,192
/// rows take 191 ms in one minibatch of 32 lanes, and 198 ms in four of 8.
const LANE_BYTES_MAX: usize = 128 << 20;
/// Fewest lanes that the memory is divided into.
const LANES_MIN: usize = 8;
/// Parameters whose sum over lanes is one task.
const SUM_PARAMETERS: usize = 8192;
/// Sets of buffers kept for reuse.
const SPARE_BUFFERS: usize = 2;

/// Networks that share one flat parameter vector and one input.
///
/// They run on the threads of a pool, or on the calling thread if there is no pool or it has a single thread.
#[derive(Clone, Debug)]
pub struct FusedNetworks {
    inner: Arc<Inner>,
}

#[derive(Debug)]
struct Inner {
    networks: Vec<Mlp>,
    observation: usize,
    parameter_count: usize,
    pool: Option<Arc<ThreadPool>>,
    spare: Mutex<Vec<Vec<Buffers>>>,
}

/// One network's results of the forward pass, and its memory for the backward pass.
#[derive(Debug, Default)]
struct Buffers {
    /// What the network sees, `[rows, input]`, if that is not all of the observations.
    seen: Vec<f32>,
    activations: Vec<f32>,
    output: Vec<f32>,
    lanes: Vec<Lane>,
}

/// One partial gradient and the memory to compute it.
#[derive(Debug, Default)]
struct Lane {
    gradient: Vec<f32>,
    output_gradient: Vec<f32>,
    scratch: Scratch,
}

impl FusedNetworks {
    /// Returns the networks of `part`, which also determines the output.
    pub fn new(shape: &NetworkShape, part: NetworkPart, pool: Option<Arc<ThreadPool>>) -> Self {
        let networks = match part {
            NetworkPart::ActorCritic => vec![Mlp::new(shape.actor()), Mlp::new(shape.critic())],
            NetworkPart::Actor => vec![Mlp::new(shape.actor())],
            NetworkPart::Critic => vec![Mlp::new(shape.critic())],
        };
        let inner = Inner {
            networks,
            observation: shape.observation,
            parameter_count: shape.parameter_count(),
            pool,
            spare: Mutex::default(),
        };
        Self { inner: Arc::new(inner) }
    }

    /// Applies the networks to `observations`, `[rows, observation]`; `parameters` is the whole flat vector.
    ///
    /// The gradient is defined with respect to the parameters, not to the observations.
    ///
    /// # Errors
    /// If a tensor has the wrong shape, is not `f32`, or is not on the CPU.
    pub fn forward(&self, parameters: &Tensor, observations: &Tensor) -> Result<Tensor> {
        let operation = Operation { inner: self.inner.clone(), buffers: Mutex::default() };
        parameters.contiguous()?.apply_op2(&observations.contiguous()?, operation)
    }
}

/// One application; owns its buffers until Candle drops the graph.
struct Operation {
    inner: Arc<Inner>,
    buffers: Mutex<Vec<Buffers>>,
}

impl CustomOp2 for Operation {
    fn name(&self) -> &'static str {
        "fused-networks"
    }

    fn cpu_fwd(&self, s1: &CpuStorage, l1: &Layout, s2: &CpuStorage, l2: &Layout) -> Result<(CpuStorage, Shape)> {
        let (parameters, observations) = (contiguous(s1, l1)?, contiguous(s2, l2)?);
        let (rows, width) = l2.shape().dims2()?;
        let Inner { parameter_count, observation, .. } = *self.inner;
        if parameters.len() != parameter_count || width != observation {
            let found = parameters.len();
            bail!("network takes {parameter_count} parameters and {observation} observations, got {found} and {width}");
        }
        let mut buffers = lock(&self.buffers);
        if buffers.is_empty() {
            *buffers = lock(&self.inner.spare).pop().unwrap_or_default();
        }
        let output = self.inner.forward(parameters, observations, rows, &mut buffers);
        Ok((CpuStorage::F32(output), Shape::from((rows, self.inner.output()))))
    }

    fn bwd(
        &self,
        parameters: &Tensor,
        observations: &Tensor,
        _output: &Tensor,
        output_gradient: &Tensor,
    ) -> Result<(Option<Tensor>, Option<Tensor>)> {
        let output_gradient = output_gradient.contiguous()?;
        let gradient = with_slice(parameters, |parameters| {
            with_slice(observations, |observations| {
                with_slice(&output_gradient, |output_gradient| {
                    let rows = observations.len() / self.inner.observation;
                    self.inner.backward(parameters, observations, rows, output_gradient, &mut lock(&self.buffers))
                })
            })
        })?;
        let gradient = Tensor::from_vec(gradient, parameters.shape(), parameters.device())?;
        Ok((Some(gradient), None))
    }
}

impl Drop for Operation {
    fn drop(&mut self) {
        let buffers = std::mem::take(&mut *lock(&self.buffers));
        let mut spare = lock(&self.inner.spare);
        if spare.len() < SPARE_BUFFERS && !buffers.is_empty() {
            spare.push(buffers);
        }
    }
}

impl Inner {
    fn output(&self) -> usize {
        self.networks.iter().map(Mlp::output).sum()
    }

    fn forward(&self, parameters: &[f32], observations: &[f32], rows: usize, buffers: &mut Vec<Buffers>) -> Vec<f32> {
        buffers.resize_with(self.networks.len(), Buffers::default);
        let mut tasks = Vec::new();
        for (network, buffers) in self.networks.iter().zip(&mut *buffers) {
            buffers.activations.resize(rows * network.hidden(), 0.0);
            buffers.output.resize(rows * network.output(), 0.0);
            let width = network.input();
            let seen = if width == self.observation {
                observations
            } else {
                buffers.seen.clear();
                observations
                    .chunks_exact(self.observation)
                    .for_each(|row| buffers.seen.extend_from_slice(&row[..width]));
                &buffers.seen
            };
            let mut activations = &mut buffers.activations[..];
            let outputs = buffers.output.chunks_mut(CHUNK_ROWS * network.output());
            for (input, output) in seen.chunks(CHUNK_ROWS * width).zip(outputs) {
                let chunk = input.len() / width * network.hidden();
                let (activation, rest) = activations.split_at_mut(chunk);
                tasks.push((network, input, activation, output));
                activations = rest;
            }
        }
        self.for_each(tasks, |(network, input, activations, output)| {
            let rows = input.len() / network.input();
            network.forward(&parameters[network.range.clone()], input, rows, activations, output);
        });
        self.join_outputs(rows, buffers)
    }

    /// Returns the outputs of all networks, joined row by row.
    fn join_outputs(&self, rows: usize, buffers: &[Buffers]) -> Vec<f32> {
        let total = self.output();
        let mut joined = vec![0.0; rows * total];
        let mut column = 0;
        for (network, buffers) in self.networks.iter().zip(buffers) {
            let width = network.output();
            for (target, source) in joined.chunks_exact_mut(total).zip(buffers.output.chunks_exact(width)) {
                target[column..column + width].copy_from_slice(source);
            }
            column += width;
        }
        joined
    }

    fn backward(
        &self,
        parameters: &[f32],
        observations: &[f32],
        rows: usize,
        output_gradient: &[f32],
        buffers: &mut [Buffers],
    ) -> Result<Vec<f32>> {
        if buffers.len() != self.networks.len() {
            bail!("the backward pass needs a forward pass first");
        }
        let total = self.output();
        let chunks = rows.div_ceil(CHUNK_ROWS);
        let lanes = self.lanes(chunks);
        let mut tasks = Vec::new();
        let mut column = 0;
        for (network, buffers) in self.networks.iter().zip(&mut *buffers) {
            buffers.lanes.resize_with(lanes, Lane::default);
            let activations = &buffers.activations[..];
            let seen = if network.input() == self.observation { observations } else { &buffers.seen[..] };
            for (i, lane) in buffers.lanes.iter_mut().enumerate() {
                tasks.push((network, column, i, lane, seen, activations));
            }
            column += network.output();
        }
        self.for_each(tasks, |(network, column, first, lane, seen, activations)| {
            let width = network.input();
            lane.gradient.resize(network.range.len(), 0.0);
            for chunk in (first..chunks).step_by(lanes) {
                let (from, to) = (chunk * CHUNK_ROWS, rows.min((chunk + 1) * CHUNK_ROWS));
                lane.output_gradient.clear();
                for row in output_gradient[from * total..to * total].chunks_exact(total) {
                    lane.output_gradient.extend_from_slice(&row[column..column + network.output()]);
                }
                network.backward(
                    &parameters[network.range.clone()],
                    &seen[from * width..to * width],
                    to - from,
                    &activations[from * network.hidden()..to * network.hidden()],
                    &lane.output_gradient,
                    &mut lane.scratch,
                    &mut lane.gradient,
                    chunk != first,
                );
            }
        });
        Ok(self.sum_lanes(buffers))
    }

    /// Returns the number of partial gradients per network for so many chunks: one per chunk while memory allows.
    fn lanes(&self, chunks: usize) -> usize {
        let bytes = self.networks.iter().map(|network| network.lane_numbers(CHUNK_ROWS) * size_of::<f32>()).sum();
        chunks.min(LANES_MIN.max(LANE_BYTES_MAX.checked_div(bytes).unwrap_or(LANES_MIN)))
    }

    /// Returns the flat gradient, with zeros for parameters outside these networks.
    fn sum_lanes(&self, buffers: &[Buffers]) -> Vec<f32> {
        let mut gradient = vec![0.0; self.parameter_count];
        let mut tasks = Vec::new();
        let mut rest = &mut gradient[..];
        let mut end = 0;
        for (network, buffers) in self.networks.iter().zip(buffers) {
            let (before, after) = rest.split_at_mut(network.range.end - end);
            let parts = before[network.range.start - end..].chunks_mut(SUM_PARAMETERS).enumerate();
            tasks.extend(parts.map(|(part, target)| (part * SUM_PARAMETERS, target, &buffers.lanes)));
            (rest, end) = (after, network.range.end);
        }
        self.for_each(tasks, |(start, target, lanes)| {
            for lane in lanes {
                let parts = &lane.gradient[start..start + target.len()];
                target.iter_mut().zip(parts).for_each(|(sum, part)| *sum += part);
            }
        });
        gradient
    }

    fn for_each<T: Send>(&self, tasks: Vec<T>, work: impl Fn(T) + Send + Sync) {
        match &self.pool {
            Some(pool) if tasks.len() > 1 && pool.current_num_threads() > 1 => {
                pool.install(|| tasks.into_par_iter().with_max_len(1).for_each(work))
            }
            _ => tasks.into_iter().for_each(work),
        }
    }
}

fn contiguous<'a>(storage: &'a CpuStorage, layout: &Layout) -> Result<&'a [f32]> {
    match layout.contiguous_offsets() {
        Some((start, end)) => Ok(&storage.as_slice::<f32>()?[start..end]),
        None => bail!("the fused networks take contiguous tensors only"),
    }
}

/// Calls `work` with the numbers of a contiguous tensor on the CPU.
fn with_slice<T>(tensor: &Tensor, work: impl FnOnce(&[f32]) -> Result<T>) -> Result<T> {
    let (storage, layout) = tensor.storage_and_layout();
    match &*storage {
        Storage::Cpu(storage) => work(contiguous(storage, layout)?),
        _ => bail!("the fused networks run on the CPU only"),
    }
}

/// Locks a mutex even if poisoned: buffers are overwritten before they are read.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
#[path = "fused_tests.rs"]
mod tests;
