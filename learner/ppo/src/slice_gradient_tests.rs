//! The gradient on slices against that of Candle's operations and automatic differentiation.

use candle_core::Device;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};
use treadmill_policy::{gaussian::log_probability, init::initial_parameters};

use super::*;
use crate::tensor_gradient::TensorGradient;

/// Returns random experience near a policy of means 0, and other parameters.
fn experience(shape: &NetworkShape, rows: usize) -> (Batch, Vec<f32>) {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(7);
    let parameters = initial_parameters(shape, -0.3, &mut random);
    let parameters = parameters.iter().map(|p| p * 1.5).collect();
    let mut normals = |count: usize| (0..count).map(|_| StandardNormal.sample(&mut random)).collect::<Vec<f32>>();
    let actions: Vec<f32> = normals(rows * shape.action).iter().map(|a| a * 0.7).collect();
    let action_rows = actions.chunks_exact(shape.action);
    let log_std = vec![-0.4; shape.action];
    let log_prob = |action: &[f32]| log_probability(action, &vec![0.0; action.len()], &log_std);
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
    let mut expected = vec![0.0; shape.parameter_count()];
    let tensors = TensorGradient::upload(&batch, &batch.advantages, shape, &config, &Device::Cpu);
    let expected_loss = tensors.and_then(|t| t.compute(&order, &parameters, &mut expected)).expect("candle runs");

    let mut slices = SliceGradient::new(&batch, &batch.advantages, shape, &config);
    slices.lanes_max = lanes_max.unwrap_or(slices.lanes_max);
    // Twice, because memory is used again.
    for _ in 0..2 {
        let mut found = vec![f32::NAN; shape.parameter_count()];
        let loss = slices.compute(&order, &parameters, &mut found);
        assert_eq!(slices.actor_lanes.len(), lanes_max.unwrap_or(rows.div_ceil(CHUNK_ROWS)));
        for (found, expected) in [
            (loss.policy, expected_loss.policy),
            (loss.value, expected_loss.value),
            (loss.bounds, expected_loss.bounds),
            (loss.clipped, expected_loss.clipped),
        ] {
            assert!((found - expected).abs() < 1e-5 * (rows as f64 + expected.abs()), "{shape:?}: {found} {expected}");
        }
        assert!(rows < 30 || loss.clipped > 0.0 && loss.bounds > 0.0, "{loss:?}");
        // Relative to the largest number of each tensor.
        for tensor in shape.tensors() {
            let expected = &expected[tensor.range()];
            let largest = expected.iter().fold(0.0_f32, |largest, number| largest.max(number.abs()));
            assert!(largest > 0.0, "{} takes part", tensor.name);
            for (found, expected) in found[tensor.range()].iter().zip(expected) {
                let off = (found - expected).abs();
                assert!(off < 1e-5 * largest, "{shape:?} {}: {found} {expected} {largest}", tensor.name);
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
        SliceGradient::new(&Batch::default(), &[], &shape, &PpoConfig::default()).lanes_max
    };
    let found = [lanes_max(45, &[256, 128]), lanes_max(348, &[512, 256]), lanes_max(4096, &[4096; 4])];
    assert_eq!(found, [47, 16, LANES_MIN]);
}
