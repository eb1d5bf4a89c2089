//! The gradient on slices against that of Candle's operations and automatic differentiation.

use proptest::prelude::*;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};
use treadmill_policy::{CHUNK_ROWS, NetworkShape, PolicyMirror, gaussian::log_probabilities};

use super::*;
use crate::tensor_gradient::TensorGradient;

/// Returns random experience near a policy of means 0, and other parameters.
fn experience(networks: &Networks, rows: usize, seed: u64) -> (Batch, Vec<f32>) {
    let shape = networks.shape();
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let parameters = networks.initial_parameters(-0.3, &mut random).iter().map(|p| p * 1.5).collect();
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

/// Returns the ranges of each tensor of dense networks, or of both equivariant networks and `log_std`.
fn tensors(networks: &Networks) -> Vec<std::ops::Range<usize>> {
    match networks.mirror() {
        None => networks.shape().tensors().iter().map(|tensor| tensor.range()).collect(),
        Some(_) => vec![networks.actor().range(), networks.log_std_range(), networks.critic().range()],
    }
}

/// Returns equivariant networks; the last entry of an observation is the critic's alone.
fn equivariant(hidden: &[usize]) -> Networks {
    let shape = NetworkShape { observation: 7, action: 3, hidden: hidden.to_vec(), privileged: 1 };
    let observation = vec![(3, -1.0), (1, 1.0), (2, -1.0), (0, -1.0), (5, 1.0), (4, 1.0), (6, -1.0)];
    let mirror = PolicyMirror { observation, action: vec![(1, -1.0), (0, -1.0), (2, 1.0)] };
    Networks::new(shape, Some(mirror)).expect("the mirror fits")
}

/// Compares loss and gradient of shuffled rows; with at most so many lanes if given. Returns the loss.
fn check(networks: &Networks, rows: usize, lanes_max: Option<usize>, config: &PpoConfig, seed: u64) -> LossSums {
    let (batch, parameters) = experience(networks, rows + 10, seed);
    let order: Vec<u32> = (10..10 + rows as u32).rev().collect();
    let mut expected = vec![0.0; networks.parameter_count()];
    let on_tensors = TensorGradient::upload(&batch, &batch.advantages, networks, config);
    let expected_loss = on_tensors.and_then(|t| t.compute(&order, &parameters, &mut expected)).expect("candle runs");

    // The largest chunks twice, because memory is used again.
    let mut slices = [CHUNK_ROWS, 64].map(|chunk_rows| {
        let slices = SliceGradient::new(&batch, &batch.advantages, networks, config, chunk_rows);
        SliceGradient { lanes_max: lanes_max.unwrap_or(slices.lanes_max), ..slices }
    });
    for chunk in [0, 0, 1] {
        let (slices, mut found) = (&mut slices[chunk], vec![f32::NAN; networks.parameter_count()]);
        let loss = slices.compute(&order, &parameters, &mut found);
        assert_eq!(slices.actor_lanes.len(), lanes_max.unwrap_or(rows.div_ceil(slices.chunk_rows)));
        for (found, expected) in [
            (loss.policy, expected_loss.policy),
            (loss.value, expected_loss.value),
            (loss.bounds, expected_loss.bounds),
            (loss.clipped, expected_loss.clipped),
        ] {
            assert!(
                (found - expected).abs() < 1e-5 * (rows as f64 + expected.abs()),
                "{networks:?}: {found} {expected}"
            );
        }
        // Relative to the largest number of each tensor, or to the part of one row if all nearly cancel.
        for range in tensors(networks) {
            let expected = &expected[range.clone()];
            let largest = expected.iter().fold(0.0_f32, |largest, number| largest.max(number.abs()));
            // Few rows may all be outside the clip range.
            assert!(largest > 0.0 || rows < 12, "{range:?} takes part");
            for (found, expected) in found[range.clone()].iter().zip(expected) {
                let off = (found - expected).abs();
                assert!(
                    off < 1e-5 * largest.max(1.0 / rows as f32),
                    "{networks:?} {range:?}: {found} {expected} {largest}"
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
        let loss = check(&shape.into(), rows, None, &config(), 7);
        assert!(loss.clipped > 0.0 && loss.bounds > 0.0, "{loss:?}");
    }
}

#[test]
fn the_gradient_of_equivariant_networks_equals_that_of_candles_operations() {
    for (hidden, rows) in [(vec![16, 8], 33), (vec![], 50), (vec![4], 700), (vec![8; 3], 256)] {
        check(&equivariant(&hidden), rows, None, &config(), 7);
    }
}

#[test]
fn a_batch_with_its_mirror_image_gives_dense_networks_the_same_gradient() {
    let networks = equivariant(&[16, 8]);
    let PolicyMirror { observation, action } = networks.mirror().expect("they have one").clone();
    let rows = 60;
    let (mut batch, parameters) = experience(&networks, rows, 3);
    let order: Vec<u32> = (0..2 * rows as u32).collect();
    let mut found = vec![0.0; networks.parameter_count()];
    SliceGradient::new(&batch, &batch.advantages, &networks, &config(), CHUNK_ROWS).compute(
        &order[..rows],
        &parameters,
        &mut found,
    );

    for (plane, reflection) in [(&mut batch.observations, &observation), (&mut batch.actions, &action)] {
        let image = |row: &[f32]| reflection.iter().map(|(at, sign)| sign * row[*at]).collect::<Vec<_>>();
        let images: Vec<f32> = plane.chunks_exact(reflection.len()).flat_map(image).collect();
        plane.extend(images);
    }
    batch.means.extend_from_within(..);
    for plane in
        [&mut batch.log_probs, &mut batch.advantages, &mut batch.returns, &mut batch.values, &mut batch.weights]
    {
        plane.extend_from_within(..);
    }
    let dense = Networks::from(networks.shape().clone());
    let mut gradient = vec![0.0; dense.parameter_count()];
    SliceGradient::new(&batch, &batch.advantages, &dense, &config(), CHUNK_ROWS).compute(
        &order,
        &networks.dense(&parameters),
        &mut gradient,
    );
    let largest = found.iter().fold(0.0_f32, |largest, number| largest.max(number.abs()));
    for (found, expected) in found.iter().zip(networks.fold(&gradient)) {
        assert!((found - expected).abs() < 1e-5 * largest, "{found} {expected} {largest}");
    }
}

#[test]
fn chunks_that_share_a_lane_give_the_same_gradient() {
    let shape = NetworkShape { observation: 7, action: 3, hidden: vec![16, 8], privileged: 0 };
    check(&shape.into(), 5 * CHUNK_ROWS + 9, Some(2), &config(), 7);
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
        check(&NetworkShape { observation: 5, action, hidden: vec![], privileged: 0 }.into(), rows, None, &config, seed);
    }
}

#[test]
fn every_chunk_has_its_own_lane_while_memory_allows() {
    let lanes_max = |observation, hidden: &[usize]| {
        let shape = NetworkShape { observation, action: 17, hidden: hidden.to_vec(), privileged: 0 };
        SliceGradient::new(&Batch::default(), &[], &shape.into(), &PpoConfig::default(), CHUNK_ROWS).lanes_max
    };
    let found = [lanes_max(45, &[256, 128]), lanes_max(348, &[512, 256]), lanes_max(4096, &[4096; 4])];
    assert_eq!(found, [47, 16, LANES_MIN]);
}
