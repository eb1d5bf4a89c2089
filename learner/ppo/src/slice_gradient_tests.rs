//! The gradient on slices against that of Candle's operations and automatic differentiation.

use candle_core::Device;
use proptest::prelude::*;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};
use treadmill_policy::{gaussian::log_probabilities, init::initial_parameters};

use super::*;
use crate::tensor_gradient::TensorGradient;

/// Returns random experience near a policy of means 0, and other parameters.
fn experience(shape: &NetworkShape, rows: usize, seed: u64) -> (Batch, Vec<f32>) {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let parameters = initial_parameters(shape, -0.3, &mut random).iter().map(|p| p * 1.5).collect();
    let mut normals = |count: usize| (0..count).map(|_| StandardNormal.sample(&mut random)).collect::<Vec<f32>>();
    let actions: Vec<f32> = normals(rows * shape.action).iter().map(|a| a * 0.7).collect();
    let (zeros, log_std) = (vec![0.0; rows * shape.action], vec![-0.4; shape.action]);
    let batch = Batch {
        observations: normals(rows * shape.observation),
        log_probs: log_probabilities(&actions, &zeros, &log_std),
        means: zeros,
        weights: vec![1.0; rows],
        advantages: normals(rows),
        returns: normals(rows),
        values: vec![0.0; rows],
        actions,
    };
    (batch, parameters)
}

fn config() -> PpoConfig {
    PpoConfig {
        entropy_coefficient: 0.01,
        bounds_coefficient: 0.3,
        bounds_limit: 0.02,
        value_coefficient: 0.7,
        ..PpoConfig::default()
    }
}

/// Compares loss and gradient of shuffled rows; with at most so many lanes if given. Returns the loss.
fn check(shape: &NetworkShape, rows: usize, lanes_max: Option<usize>, config: &PpoConfig, seed: u64) -> LossSums {
    let (batch, parameters) = experience(shape, rows + 10, seed);
    let order: Vec<u32> = (10..10 + rows as u32).rev().collect();
    let mut expected = vec![0.0; shape.parameter_count()];
    let tensors = TensorGradient::upload(&batch, &batch.advantages, shape, config, &Device::Cpu);
    let expected_loss = tensors.and_then(|t| t.compute(&order, &parameters, &mut expected)).expect("candle runs");

    let mut slices = SliceGradient::new(&batch, &batch.advantages, shape, config);
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
        // Relative to the largest number of each tensor, or to the part of one row if all nearly cancel.
        for tensor in shape.tensors() {
            let expected = &expected[tensor.range()];
            let largest = expected.iter().fold(0.0_f32, |largest, number| largest.max(number.abs()));
            // Few rows may all be outside the clip range.
            assert!(largest > 0.0 || rows < 12, "{} takes part", tensor.name);
            for (found, expected) in found[tensor.range()].iter().zip(expected) {
                let off = (found - expected).abs();
                assert!(
                    off < 1e-5 * largest.max(1.0 / rows as f32),
                    "{shape:?} {}: {found} {expected} {largest}",
                    tensor.name
                );
            }
        }
    }
    expected_loss
}

#[test]
fn the_gradient_equals_that_of_candles_operations() {
    let small = [(vec![16, 8], 0, 33), (vec![4], 2, 700), (vec![8; 3], 1, 256)];
    let small =
        small.map(|(hidden, privileged, rows)| (NetworkShape { observation: 7, action: 3, hidden, privileged }, rows));
    let presets = [(45, vec![256, 128], CHUNK_ROWS + 30), (348, vec![512, 256], 40)]
        .map(|(observation, hidden, rows)| (NetworkShape { observation, action: 17, hidden, privileged: 0 }, rows));
    for (shape, rows) in small.into_iter().chain(presets) {
        let loss = check(&shape, rows, None, &config(), 7);
        assert!(loss.clipped > 0.0 && loss.bounds > 0.0, "{loss:?}");
    }
}

#[test]
fn chunks_that_share_a_lane_give_the_same_gradient() {
    let shape = NetworkShape { observation: 7, action: 3, hidden: vec![16, 8], privileged: 0 };
    check(&shape, 5 * CHUNK_ROWS + 9, Some(2), &config(), 7);
}

proptest! {
    #[test]
    fn every_setting_gives_the_gradient_of_candles_operations(
        (rows, action, seed) in (3_usize..12, 1_usize..5, 0_u64..1000),
        coefficients in (0.01..0.1_f64, 0.0..1.0_f64, 0.1..2.0_f64, 0.05..0.5_f64, 0.3..1.5_f64),
    ) {
        let (entropy_coefficient, bounds_coefficient, value_coefficient, clip_range, bounds_limit) = coefficients;
        let config = PpoConfig {
            entropy_coefficient, bounds_coefficient, value_coefficient, clip_range, bounds_limit, ..PpoConfig::default()
        };
        check(&NetworkShape { observation: 5, action, hidden: vec![], privileged: 0 }, rows, None, &config, seed);
    }
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
