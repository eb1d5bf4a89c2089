//! The gradient on slices against Candle's operations and automatic differentiation in double precision.

use candle_core::{DType, Device, Result, Tensor, Var};
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};
use treadmill_policy::{init::initial_parameters, plain};

use super::*;
use crate::loss::{Loss, Minibatch, ppo_loss};

/// Loss and flat gradient of the given rows, by Candle.
pub(crate) struct ByCandle {
    pub(crate) loss: Loss,
    pub(crate) gradient: Vec<f64>,
}

/// Computes the loss and its gradient. `advantages` are the normalised ones.
pub(crate) fn by_candle(
    batch: &Batch,
    advantages: &[f32],
    rows: &[u32],
    (shape, config): (&NetworkShape, &PpoConfig),
    parameters: &[f32],
) -> Result<ByCandle> {
    let index = Tensor::new(rows, &Device::Cpu)?;
    let plane = |numbers: &[f32], width: usize| {
        let plane = Tensor::from_slice(numbers, (batch.len(), width), &Device::Cpu)?.index_select(&index, 0)?;
        plane.to_dtype(DType::F64)
    };
    let vector = |numbers: &[f32]| plane(numbers, 1)?.flatten_all();
    let minibatch = Minibatch {
        actions: plane(&batch.actions, shape.action)?,
        log_probs: vector(&batch.log_probs)?,
        advantages: vector(advantages)?,
        returns: vector(&batch.returns)?,
    };
    let parameters = Var::from_tensor(&Tensor::new(parameters, &Device::Cpu)?.to_dtype(DType::F64)?)?;
    let output = plain::actor_critic(shape, &parameters, &plane(&batch.observations, shape.observation)?)?;
    let log_std = parameters.narrow(0, shape.log_std().start, shape.action)?;
    let loss = ppo_loss(&output, &log_std, &minibatch, config)?;
    let gradient = loss.total.backward()?.get(&parameters).expect("the parameters take part").to_vec1()?;
    Ok(ByCandle { loss, gradient })
}

/// Returns random experience near a policy of means 0, and other parameters.
fn experience(shape: &NetworkShape, rows: usize) -> (Batch, Vec<f32>) {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(7);
    let parameters = initial_parameters(shape, -0.3, &mut random);
    let parameters = parameters.iter().map(|p| p * 1.5).collect();
    let mut normals = |count: usize| (0..count).map(|_| StandardNormal.sample(&mut random)).collect::<Vec<f32>>();
    let actions: Vec<f32> = normals(rows * shape.action).iter().map(|a| a * 0.7).collect();
    let action_rows = actions.chunks_exact(shape.action);
    let log_std = vec![-0.4; shape.action];
    let log_prob =
        |action: &[f32]| treadmill_policy::gaussian::log_probability(action, &vec![0.0; action.len()], &log_std);
    let batch = Batch {
        observations: normals(rows * shape.observation),
        log_probs: action_rows.map(log_prob).collect(),
        means: vec![0.0; rows * shape.action],
        weights: vec![1.0; rows],
        advantages: normals(rows),
        returns: normals(rows),
        values: vec![0.0; rows],
        actions,
    };
    (batch, parameters)
}

/// Compares loss and gradient of shuffled rows; with at most so many lanes if given.
fn check(shape: &NetworkShape, rows: usize, lanes_max: Option<usize>) {
    let config = PpoConfig {
        entropy_coefficient: 0.01,
        bounds_coefficient: 0.3,
        bounds_limit: 0.02,
        value_coefficient: 0.7,
        ..PpoConfig::default()
    };
    let (batch, parameters) = experience(shape, rows + 10);
    let order: Vec<u32> = (0..rows as u32).map(|row| row * 7 % rows as u32 + 10).collect();
    let expected = by_candle(&batch, &batch.advantages, &order, (shape, &config), &parameters).expect("candle runs");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().expect("threads start");
    let mut pass = CpuPass::new(&batch, &batch.advantages, shape, &config, &pool);
    pass.lanes_max = lanes_max.unwrap_or(pass.lanes_max);
    let terms = LossTerms::new(&batch, &batch.advantages, &config, &parameters[shape.log_std()], rows);
    // Twice, because memory is used again.
    for _ in 0..2 {
        let loss = pool.install(|| pass.compute_gradient(&terms, &order, &parameters));
        assert_eq!(pass.actor_lanes.len(), lanes_max.unwrap_or(rows.div_ceil(CHUNK_ROWS)));
        for (found, expected) in [
            (terms.total(&loss, rows), &expected.loss.total),
            (loss.policy / rows as f64, &expected.loss.policy),
            (loss.value / rows as f64, &expected.loss.value),
            (loss.bounds / rows as f64, &expected.loss.bounds),
            (terms.entropy(), &expected.loss.entropy),
        ] {
            let expected = expected.to_scalar::<f64>().expect("a scalar");
            assert!((found - expected).abs() < 1e-5 * (1.0 + expected.abs()), "{shape:?}: {found} {expected}");
        }
        let log_ratio = expected.loss.log_ratio.to_vec1::<f64>().expect("a vector");
        let clipped = log_ratio.iter().filter(|l| (l.exp() - 1.0).abs() > config.clip_range).count() as f64;
        assert!((loss.clipped - clipped).abs() <= 1.0 && loss.bounds > 0.0, "{loss:?} {clipped}");
        assert!(clipped > 0.0 || rows < 30);
        // Relative to the largest number of each tensor.
        for tensor in shape.tensors() {
            let expected = &expected.gradient[tensor.range()];
            let largest = expected.iter().fold(0.0_f64, |largest, number| largest.max(number.abs()));
            assert!(largest > 0.0, "{} takes part", tensor.name);
            for (found, expected) in pass.gradient[tensor.range()].iter().zip(expected) {
                let off = (f64::from(*found) - expected).abs();
                assert!(off < 1e-5 * largest, "{shape:?} {}: {found} {expected}", tensor.name);
            }
        }
    }
}

#[test]
fn the_gradient_equals_that_of_candles_operations() {
    for (hidden, privileged, rows) in [(vec![16, 8], 0, 33), (vec![4], 2, 700), (vec![], 0, 5), (vec![8; 3], 1, 256)] {
        check(&NetworkShape { observation: 7, action: 3, hidden, privileged }, rows, None);
    }
    for (observation, hidden) in [(45, vec![256, 128]), (348, vec![512, 256])] {
        check(&NetworkShape { observation, action: 17, hidden, privileged: 0 }, CHUNK_ROWS + 30, None);
    }
}

#[test]
fn chunks_that_share_a_lane_give_the_same_gradient() {
    let shape = NetworkShape { observation: 7, action: 3, hidden: vec![16, 8], privileged: 0 };
    check(&shape, 5 * CHUNK_ROWS + 9, Some(2));
}

#[test]
fn every_chunk_has_its_own_lane_while_memory_allows() {
    let lanes_max = |observation, hidden: &[usize]| {
        let shape = NetworkShape { observation, action: 17, hidden: hidden.to_vec(), privileged: 0 };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread starts");
        CpuPass::new(&Batch::default(), &[], &shape, &PpoConfig::default(), &pool).lanes_max
    };
    let found = [lanes_max(45, &[256, 128]), lanes_max(348, &[512, 256]), lanes_max(4096, &[4096; 4])];
    assert_eq!(found, [47, 16, LANES_MIN]);
}
