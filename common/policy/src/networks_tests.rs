//! Equivariant networks against their dense equals.

use proptest::prelude::*;
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};

use super::*;
use crate::{Policy, mirror_indices};

/// PolicyMirror of ten entries, of which the critic alone sees the last three, and of five actions.
pub(crate) fn mirror() -> PolicyMirror {
    PolicyMirror {
        observation: vec![
            (1, -1.0),
            (0, -1.0),
            (2, 1.0),
            (3, -1.0),
            (5, 1.0),
            (4, 1.0),
            (6, -1.0),
            (9, 1.0),
            (8, -1.0),
            (7, 1.0),
        ],
        action: vec![(3, -1.0), (1, 1.0), (2, -1.0), (0, -1.0), (4, -1.0)],
    }
}

fn shape(hidden: &[usize]) -> NetworkShape {
    NetworkShape { observation: 10, action: 5, hidden: hidden.to_vec(), privileged: 3 }
}

fn networks(hidden: &[usize]) -> Networks {
    Networks::new(shape(hidden), Some(mirror())).expect("the mirror fits")
}

fn normals(count: usize, seed: u64) -> Vec<f32> {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    (0..count).map(|_| StandardNormal.sample(&mut random)).collect()
}

fn mirrored(rows: &[f32], reflection: &[(usize, f32)]) -> Vec<f32> {
    rows.chunks_exact(reflection.len()).flat_map(|row| reflection.iter().map(|(at, sign)| sign * row[*at])).collect()
}

fn outputs(policy: &Policy, observations: &[f32]) -> [Vec<f32>; 2] {
    let rows = observations.len() / policy.shape().observation;
    let mut means = vec![0.0; rows * policy.shape().action];
    policy.means(observations, rows, &mut means);
    [means, policy.values(observations, rows)]
}

#[track_caller]
fn assert_near(found: &[f32], expected: &[f32]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-6 * expected.abs().max(1.0), "{found} {expected}");
    }
}

proptest! {
    #[test]
    fn actions_and_values_follow_the_mirror_and_equal_those_of_dense_networks(
        hidden in prop::collection::vec((1_usize..9).prop_map(|half| 2 * half), 0..3),
        (rows, seed) in (1_usize..7, 0_u64..1000),
    ) {
        let networks = networks(&hidden);
        // Sums that stay about 1 differ by less than 1e-6 in single precision.
        let parameters: Vec<f32> = normals(networks.parameter_count(), seed).iter().map(|p| 0.2 * p).collect();
        let observations = normals(rows * 10, seed + 1000);
        let policy = Policy::new(networks.clone(), parameters.clone()).expect("they fit");
        let [means, values] = outputs(&policy, &observations);
        let PolicyMirror { observation, action } = mirror();
        let [image_means, image_values] = outputs(&policy, &mirrored(&observations, &observation));
        assert_near(&image_means, &mirrored(&means, &action));
        assert_near(&image_values, &values);
        prop_assert!(means.iter().all(|mean| *mean != 0.0), "each action depends on the observation");

        let dense = networks.dense(&parameters).into_owned();
        let equal = Policy::new(shape(&hidden), dense.clone()).expect("they fit");
        let [dense_means, dense_values] = outputs(&equal, &observations);
        assert_near(&dense_means, &means);
        assert_near(&dense_values, &values);
        assert_near(equal.log_std(), policy.log_std());
        assert_near(&networks.learnt(dense).expect("they are equivariant"), &parameters);
    }

    #[test]
    fn folding_is_the_transpose_of_the_map_to_dense_parameters(seed in 0_u64..1000) {
        let networks = networks(&[6, 4]);
        let parameters = normals(networks.parameter_count(), seed);
        let gradient = normals(networks.shape().parameter_count(), seed + 1000);
        let product = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| f64::from(*a) * f64::from(*b)).sum::<f64>();
        let found = product(&networks.fold(&gradient), &parameters);
        let expected = product(&gradient, &networks.dense(&parameters));
        prop_assert!((found - expected).abs() < 1e-4 * expected.abs().max(1.0), "{found} {expected}");
    }
}

#[test]
fn half_of_the_weights_are_learnt() {
    let dense = Networks::from(NetworkShape { observation: 10, privileged: 0, ..shape(&[256, 128]) });
    let networks = Networks::new(dense.shape().clone(), Some(mirror())).expect("the mirror fits");
    let ratio = networks.parameter_count() as f64 / dense.parameter_count() as f64;
    assert!((0.5..0.51).contains(&ratio), "{ratio}");
    assert_eq!(networks.log_std_range().len(), 4);
    let ends = [networks.actor().range().end, networks.critic().range().start];
    assert_eq!(ends, [networks.log_std_range().start, networks.log_std_range().end]);
}

#[test]
fn other_parameters_are_not_taken_for_equivariant_ones() {
    let dense = normals(shape(&[16]).parameter_count(), 1);
    let distance = networks(&[16]).learnt(dense).expect_err("they are random");
    assert!((0.5..0.9).contains(&distance), "{distance}");
}

#[test]
fn a_mirror_that_does_not_fit_is_refused() {
    let refused = |shape: NetworkShape, change: fn(&mut PolicyMirror)| {
        let mut mirror = mirror();
        change(&mut mirror);
        Networks::new(shape, Some(mirror)).expect_err("it does not fit")
    };
    assert!(refused(shape(&[8, 5]), |_| ()).contains("a layer of 5 units"));
    assert!(refused(shape(&[8]), |mirror| mirror.action.truncate(4)).contains("4 entries, expected 5"));
    assert!(refused(shape(&[8]), |mirror| mirror.action[0] = (1, -1.0)).contains("entry 0"));
    assert!(refused(shape(&[8]), |mirror| mirror.action[0].0 = 9).contains("entry 0"));
    assert!(refused(shape(&[8]), |mirror| mirror.action[1].1 = 0.5).contains("0.5 times"));
    let wide = NetworkShape { privileged: 2, ..shape(&[8]) };
    assert!(refused(wide, |_| ()).contains("entry 7 of an observation is one that only the critic sees"));
}

#[test]
fn a_mirror_is_sent_as_signed_numbers_from_1() {
    let PolicyMirror { observation, action } = mirror();
    assert_eq!(mirror_indices(&action), [-4, 2, -3, -1, -5]);
    let received = PolicyMirror::of_indices(&mirror_indices(&observation), &mirror_indices(&action));
    assert_eq!(received, Some(mirror()));
    assert_eq!(PolicyMirror::of_indices(&[], &[]), None);
}
