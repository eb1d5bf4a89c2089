//! Effects of lag and of a mirror on a batch.

use rand::RngExt;
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};
use treadmill_policy::{NetworkShape, Networks};

use super::*;

const STEPS: u32 = 6;
const ENVS: u32 = 2;
/// Seeds of the parameters of two policies.
const NEWEST: u64 = 0x5e31_645e_38a6_c541;
const OLD: u64 = 0x00ea_63de_0efd_875e;

fn shape() -> NetworkShape {
    NetworkShape { observation: 3, action: 2, hidden: vec![8], privileged: 0 }
}

fn parameters(seed: u64) -> Vec<f32> {
    let initial = Networks::from(shape()).initial_parameters(-0.5, &mut Xoshiro256PlusPlus::seed_from_u64(seed));
    // Initial action means are close to 0; with larger weights they differ between policies.
    initial.iter().map(|p| p * 3.0).collect()
}

fn policy(seed: u64) -> Policy {
    Policy::new(shape(), parameters(seed)).expect("they fit")
}

/// Fragment acted by `acting`, with actions at fixed offsets from its means.
fn fragment(acting: &Policy) -> Fragment {
    let rows = (STEPS * ENVS) as usize;
    let observations: Vec<f32> = (0..rows * 3).map(|i| ((i * 37 % 19) as f32 - 9.0) / 9.0).collect();
    let mut actions = vec![0.0; rows * 2];
    acting.means(&observations, rows, &mut actions);
    let means = actions.clone();
    actions.iter_mut().enumerate().for_each(|(i, action)| *action += ((i % 5) as f32 - 2.0) * 0.3);
    let log_probs = actions.chunks(2).zip(means.chunks(2));
    let log_probs = log_probs.map(|(a, m)| gaussian::log_probability(a, m, acting.log_std())).collect();
    let mut flags = vec![0; rows];
    flags[3] = TERMINATED;
    Fragment {
        steps: STEPS,
        envs: ENVS,
        observation_size: 3,
        action_size: 2,
        observations,
        actions,
        log_probs,
        rewards: (0..rows).map(|i| i as f32).collect(),
        flags,
        last_observations: vec![0.5; 6],
        ..Fragment::default()
    }
}

fn batch_of(acting: &Policy, newest: &Policy, lag: u64) -> Batch {
    let config = PpoConfig::default();
    let accepted = [AcceptedFragment { fragment: fragment(acting), lag }];
    let normaliser = Normaliser::identity(3, 10.0);
    let built = build_batch(&accepted, newest, &normaliser, &mut RunningMoments::new(1), &config);
    let BuiltBatch { batch, rejected } = built;
    assert_eq!(rejected, []);
    batch
}

#[test]
fn experience_of_the_newest_policy_is_not_corrected() {
    let newest = policy(NEWEST);
    let plain = batch_of(&newest, &newest, 0);
    assert!(plain.weights.iter().all(|weight| *weight == 1.0));
    for (found, claimed) in plain.log_probs.iter().zip(&fragment(&newest).log_probs) {
        assert!((found - claimed).abs() < 1e-5, "{found} {claimed}");
    }
    let mut means = vec![0.0; plain.means.len()];
    newest.means(&plain.observations, plain.len(), &mut means);
    assert_eq!(plain.means, means);
    // If the older version has the same parameters, the correction is 1 within rounding.
    let corrected = batch_of(&newest, &newest, 1);
    assert_eq!((&corrected.advantages, &corrected.returns), (&plain.advantages, &plain.returns));
    for (found, wanted) in corrected.weights.iter().zip(&plain.weights) {
        assert!((found - wanted).abs() < 1e-4, "{found} {wanted}");
    }
}

#[test]
fn older_experience_is_weighted_by_its_probability_ratio() {
    let (old, newest) = (policy(OLD), policy(NEWEST));
    let decoupled = batch_of(&old, &newest, 2);
    let acted = fragment(&old);
    let mut truncated = 0;
    for (row, weight) in decoupled.weights.iter().enumerate() {
        let (action, mean) = (&acted.actions[row * 2..][..2], &decoupled.means[row * 2..][..2]);
        assert_eq!(decoupled.log_probs[row], gaussian::log_probability(action, mean, newest.log_std()));
        let ratio = (decoupled.log_probs[row] - acted.log_probs[row]).exp();
        assert!((weight - ratio.min(1.0)).abs() < 1e-6 && *weight > 0.0);
        truncated += usize::from(ratio > 1.0);
    }
    assert!((1..decoupled.weights.len()).contains(&truncated), "{truncated} ratios above 1");
}

#[test]
fn an_importance_weight_never_overflows() {
    for (new, old) in [(-1e30, 1e30), (1e30, -1e30), (-1e30, -1e30), (f32::MAX, f32::MIN), (f32::NEG_INFINITY, 0.0)] {
        let weight = importance_weight(new, old);
        assert_eq!(weight, if new < old { 0.0 } else { 1.0 }, "{new} {old}");
    }
    assert!((importance_weight(-2.0, -1.0) - (-1.0_f32).exp()).abs() < 1e-7);
}

/// Fragments of both policies with different numbers of steps and kinds of ends.
fn various(newest: &Policy, old: &Policy) -> Vec<AcceptedFragment> {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(NEWEST);
    let mut accepted = Vec::new();
    for (steps, lag) in [(1, 0), (6, 1), (4, 0), (3, 2), (6, 0)] {
        let mut part = fragment(if lag == 0 { newest } else { old });
        let rows = (steps * ENVS) as usize;
        part.steps = steps;
        part.observations.truncate(rows * 3);
        part.actions.truncate(rows * 2);
        [&mut part.log_probs, &mut part.rewards].into_iter().for_each(|plane| plane.truncate(rows));
        part.flags = (0..rows).map(|_| random.random_range(0..=TRUNCATED)).collect();
        let ends = part.flags.iter().enumerate();
        let lasts =
            ends.filter(|(i, flags)| Fragment::needs_last_observation(**flags, *i as u32 / ENVS, steps)).count();
        part.last_observations = (0..lasts * 3).map(|_| random.random_range(-1.0..1.0)).collect();
        accepted.push(AcceptedFragment { fragment: part, lag });
    }
    accepted
}

#[test]
fn fragments_together_give_the_numbers_of_each_alone() {
    let (old, newest) = (policy(OLD), policy(NEWEST));
    let (normaliser, config) = (Normaliser::identity(3, 10.0), PpoConfig::default());
    // Known units, so that values take part; the moments barely move, so that units are the same.
    let moments = RunningMoments { count: 1e9, mean: vec![2.0], m2: vec![9e9] };
    let build = |accepted: &[AcceptedFragment]| {
        let mut moments = moments.clone();
        build_batch(accepted, &newest, &normaliser, &mut moments, &config).batch
    };
    let accepted = various(&newest, &old);
    let together = build(&accepted);
    assert!(together.values.iter().any(|value| value.abs() > 0.1), "the critic takes part");
    let mut start = 0;
    for accepted in &accepted {
        let alone = build(std::slice::from_ref(accepted));
        let rows = start..start + alone.len();
        start = rows.end;
        for (together, alone) in [
            (&together.advantages, &alone.advantages),
            (&together.returns, &alone.returns),
            (&together.values, &alone.values),
            (&together.weights, &alone.weights),
            (&together.log_probs, &alone.log_probs),
        ] {
            for (found, wanted) in together[rows.clone()].iter().zip(alone) {
                assert!((found - wanted).abs() < 1e-4, "{found} {wanted}");
            }
        }
    }
    assert_eq!(start, together.len());
}

#[test]
fn the_number_of_threads_changes_no_batch() {
    let accepted: Vec<_> = (0..60).flat_map(|_| various(&policy(NEWEST), &policy(OLD))).collect();
    let batches = [1, 2, 5].map(|threads| {
        let pool = std::sync::Arc::new(rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads"));
        let newest = Policy::with_pool(shape(), parameters(NEWEST), pool).expect("they fit");
        let mut moments = RunningMoments { count: 10.0, mean: vec![2.0], m2: vec![90.0] };
        let normaliser = Normaliser::identity(3, 10.0);
        let config = PpoConfig::default();
        (build_batch(&accepted, &newest, &normaliser, &mut moments, &config), moments)
    });
    assert!(batches[0].0.batch.len() > 2000);
    assert_eq!(batches[1], batches[0]);
    assert_eq!(batches[2], batches[0]);
}
