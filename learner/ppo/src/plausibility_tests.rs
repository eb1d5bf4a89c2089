//! What is plausible, and how much computations of a log-probability differ.

use candle_core::{Device, Tensor};
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};
use treadmill_policy::{Dense, NetworkShape, Networks, Policy, gaussian, plain};

use super::*;

const LOG_STD: [f32; 2] = [-0.5, 0.3];

/// Numbers of a plausible fragment of two transitions.
struct Sample {
    lag: u64,
    claimed: [f32; 2],
    log_probs: [f32; 2],
    rewards: [f32; 2],
    returns: [f32; 2],
    advantages: [f32; 2],
}

impl Default for Sample {
    fn default() -> Self {
        let planes = ([1.0, 2.0], [-3.0, 4.0], [0.5, -0.5]);
        Self {
            lag: 0,
            claimed: [-2.0, -3.0],
            log_probs: [-2.0, -3.0],
            rewards: planes.0,
            returns: planes.1,
            advantages: planes.2,
        }
    }
}

impl Sample {
    fn numbers(&self) -> FragmentNumbers<'_> {
        FragmentNumbers {
            lag: self.lag,
            claimed: &self.claimed,
            log_probs: &self.log_probs,
            rewards: &self.rewards,
            returns: &self.returns,
            advantages: &self.advantages,
        }
    }

    fn faults(&self) -> Vec<(usize, Implausible)> {
        implausible(&[self.numbers()], &LOG_STD, &known())
    }

    /// Returns the only fault.
    fn fault(&self) -> Implausible {
        let faults = self.faults();
        let [(0, fault)] = &faults[..] else { panic!("{faults:?}") };
        fault.clone()
    }
}

/// Returns of mean 3 and standard deviation 2.
fn known() -> RunningMoments {
    RunningMoments { count: 100.0, mean: vec![3.0], m2: vec![400.0] }
}

#[test]
fn log_probabilities_of_lag_0_must_be_those_of_the_policy() {
    let sample = |claimed| Sample { claimed: [-2.0, claimed], ..Sample::default() };
    // The tolerance is 0.1 + 0.0003.
    for claimed in [-3.0, -3.099, -2.901] {
        assert_eq!(sample(claimed).faults(), []);
    }
    for claimed in [-3.11, -2.89, -1e30, 1e30] {
        assert_eq!(sample(claimed).fault(), Implausible::LogProbability { row: 1, claimed, computed: -3.0 });
    }
    let text = sample(-1e30).fault().to_string();
    assert!(text.contains("transition 1") && text.contains("the actor must"), "{text}");
}

#[test]
fn actions_of_lag_0_must_be_samples_of_the_policy() {
    // At the mean ½ − 0.3 − ln 2π = −1.638; half of the largest squared distance is (400 + 4) / 2.
    let sample = |log_prob| Sample { log_probs: [log_prob, -3.0], claimed: [log_prob, -3.0], ..Sample::default() };
    assert_eq!(sample(-1.638 - 201.9).faults(), []);
    let computed = -1.638 - 202.3;
    assert_eq!(sample(computed).fault(), Implausible::Action { row: 0, computed });
    assert_eq!(sample(f32::NEG_INFINITY).fault(), Implausible::Action { row: 0, computed: f32::NEG_INFINITY });
    assert!(matches!(sample(f32::NAN).fault(), Implausible::Action { row: 0, .. }));
}

#[test]
fn log_probabilities_of_an_older_policy_must_be_possible() {
    let sample = |claimed, computed| Sample {
        lag: 1,
        claimed: [claimed, -3.0],
        log_probs: [computed, -3.0],
        ..Sample::default()
    };
    // Two actions: at most 2 · (5 − ½ ln 2π) = 8.162, at least 2 · (−2 − ½ ln 2π) − 202 = −207.838.
    for (claimed, computed) in [(-2.0, -2.0), (8.1, -2.0), (-207.8, -2.0), (-2.0, -1e9)] {
        assert_eq!(sample(claimed, computed).faults(), [], "{claimed}");
    }
    for claimed in [8.4, -208.1, -1e30, 1e30] {
        assert!(matches!(sample(claimed, -2.0).fault(), Implausible::OutOfRange { row: 0, .. }), "{claimed}");
    }
    let computed = f32::NEG_INFINITY;
    assert_eq!(sample(-2.0, computed).fault(), Implausible::Action { row: 0, computed });
}

#[test]
fn rewards_returns_and_advantages_must_be_near_the_known_ones() {
    // The scale is 2 + 3, the limit 5e6.
    for (quantity, sample) in [
        ("scaled reward", Sample { rewards: [1.0, 5.1e6], ..Sample::default() }),
        ("return", Sample { returns: [1.0, -5.1e6], ..Sample::default() }),
        ("advantage", Sample { advantages: [1.0, f32::INFINITY], ..Sample::default() }),
        ("advantage", Sample { advantages: [1.0, f32::NAN], ..Sample::default() }),
    ] {
        // Among others, because a fragment alone is the median.
        let others = [Sample::default(), Sample::default()];
        let numbers = [others[0].numbers(), sample.numbers(), others[1].numbers()];
        let faults = implausible(&numbers, &LOG_STD, &known());
        let [(1, Implausible::Magnitude { quantity: found, row: 1, limit, .. })] = faults[..] else {
            panic!("{faults:?}")
        };
        assert_eq!((found, limit), (quantity, 5e6));
    }
    assert_eq!(Sample { returns: [4.9e6, -4.9e6], ..Sample::default() }.faults(), []);
}

#[test]
fn before_the_first_return_fragments_are_compared_with_their_median() {
    let none = RunningMoments::new(1);
    let sizes = |sizes: &[f32]| {
        let samples: Vec<_> = sizes.iter().map(|size| Sample { rewards: [0.0, *size], ..Sample::default() }).collect();
        let samples: Vec<_> =
            samples.into_iter().map(|sample| Sample { returns: [0.0; 2], advantages: [0.0; 2], ..sample }).collect();
        let numbers: Vec<_> = samples.iter().map(Sample::numbers).collect();
        implausible(&numbers, &LOG_STD, &none).iter().map(|(place, _)| *place).collect::<Vec<_>>()
    };
    assert_eq!(sizes(&[1.0, 1e7, 2.0]), [1]);
    assert_eq!(sizes(&[1e30, 1.0]), [0]);
    assert_eq!(sizes(&[1e-3, 900.0, 2e-3]), [] as [usize; 0]);
    // Nothing is known of the size of the first reward among none; only numbers that overflow are refused.
    assert_eq!(sizes(&[0.0, 1e7, 0.0]), [] as [usize; 0]);
    assert_eq!(sizes(&[0.0, 3e37, 0.0]), [1]);
    assert_eq!(sizes(&[3e37]), [0]);
    assert_eq!(sizes(&[]), [] as [usize; 0]);
}

/// Returns the means of one row in single precision, each sum from the last element to the first.
fn reversed_means(layers: &[Dense], parameters: &[f32], row: &[f32]) -> Vec<f32> {
    let mut row = row.to_vec();
    for (i, layer) in layers.iter().enumerate() {
        let (weight, bias) = (&parameters[layer.weight()], &parameters[layer.bias()]);
        let product = |o: usize| (0..layer.input).rev().fold(0.0, |sum, k| sum + weight[o * layer.input + k] * row[k]);
        let linear = (0..layer.output).map(|o| product(o) + bias[o]);
        row = linear.map(|z| if i + 1 == layers.len() || z > 0.0 { z } else { z.exp_m1() }).collect();
    }
    row
}

/// Returns the largest difference between log-probabilities of the same actions by four ways to compute the means.
fn largest_difference(shape: &NetworkShape, gain: f32, log_std: f32) -> f32 {
    const ROWS: usize = 600;
    let mut random = Xoshiro256PlusPlus::seed_from_u64(0x5e31_645e_38a6_c541);
    let initial = Networks::from(shape.clone()).initial_parameters(log_std, &mut random);
    let log_std_range = shape.log_std();
    let scaled = |(i, p): (usize, &f32)| if log_std_range.contains(&i) { *p } else { p * gain };
    let parameters: Vec<f32> = initial.iter().enumerate().map(scaled).collect();
    let policy = Policy::new(shape.clone(), parameters.clone()).expect("they fit");
    let mut normals = |count: usize| -> Vec<f32> { (0..count).map(|_| StandardNormal.sample(&mut random)).collect() };
    let (observations, noise) = (normals(ROWS * shape.observation), normals(ROWS * shape.action));
    // An actor evaluates eight environments at once.
    let mut acted = vec![0.0; ROWS * shape.action];
    for (seen, means) in observations.chunks(8 * shape.observation).zip(acted.chunks_mut(8 * shape.action)) {
        policy.means(seen, means.len() / shape.action, means);
    }
    let mut actions = vec![0.0; acted.len()];
    for ((mean, noise), action) in
        acted.chunks(shape.action).zip(noise.chunks(shape.action)).zip(actions.chunks_mut(shape.action))
    {
        gaussian::sample(mean, policy.log_std(), noise, action);
    }
    let claimed = gaussian::log_probabilities(&actions, &acted, policy.log_std());
    let mut together = vec![0.0; acted.len()];
    policy.means(&observations, ROWS, &mut together);
    let tensor = Tensor::from_slice(&observations, (ROWS, shape.observation), &Device::Cpu).expect("candle runs");
    let flat = Tensor::from_slice(&parameters, parameters.len(), &Device::Cpu).expect("candle runs");
    let plain = plain::network(&shape.actor(), &flat, &tensor).expect("candle runs");
    let plain = plain.flatten_all().and_then(|means| means.to_vec1::<f32>()).expect("candle runs");
    let reversed: Vec<f32> = observations
        .chunks(shape.observation)
        .flat_map(|row| reversed_means(&shape.actor(), &parameters, row))
        .collect();
    let differences = [together, plain, reversed].map(|means| {
        let found = gaussian::log_probabilities(&actions, &means, policy.log_std());
        found.iter().zip(&claimed).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
    });
    differences.into_iter().fold(0.0, f32::max)
}

#[test]
fn the_tolerance_is_far_above_the_differences_between_computations() {
    for (observation, hidden) in [(45, vec![256, 128]), (348, vec![512, 256])] {
        let shape = NetworkShape { observation, action: 17, hidden, privileged: 0 };
        // As at the start of a run, after long training, and with the smallest standard deviation that there can be.
        for (gain, log_std) in [(1.0, -0.5), (2.0, -1.5), (2.0, LOG_STD_MIN)] {
            let largest = largest_difference(&shape, gain, log_std);
            assert!(largest > 0.0 && largest < LOG_PROB_TOLERANCE / 5.0, "{largest} for {gain} {log_std}");
        }
    }
}
