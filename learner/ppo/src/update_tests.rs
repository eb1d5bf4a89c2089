//! Whole updates on small problems.

use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};
use treadmill_policy::gaussian::{LOG_STD_MAX, kl_divergence, log_probability, sample};
use treadmill_policy::{NetworkShape, Networks, PolicyMirror};

use super::*;
use crate::{batch::normalised, tensor_gradient::TensorGradient};

fn rng(seed: u64) -> Xoshiro256PlusPlus {
    Xoshiro256PlusPlus::seed_from_u64(seed)
}

fn shape() -> NetworkShape {
    NetworkShape { observation: 4, action: 2, hidden: vec![16, 8], privileged: 0 }
}

fn config() -> PpoConfig {
    PpoConfig { minibatch: 300, epochs: 3, ..PpoConfig::default() }
}

/// The algorithm and its state.
#[derive(Clone)]
struct Updater {
    ppo: Ppo,
    state: PpoState,
}

impl Updater {
    fn shape(&self) -> &NetworkShape {
        self.state.shape()
    }

    fn policy(&self) -> Policy {
        self.ppo.policy(&self.state).expect("its own parameters fit")
    }

    /// Updates with minibatches in the order of `seed`.
    fn update(&mut self, batch: &Batch, seed: u64) -> Result<UpdateStats, UpdateError> {
        self.state.shuffle = rng(seed);
        self.ppo.update(&mut self.state, batch, self.ppo.config.epochs)
    }
}

fn updater(config: &PpoConfig, threads: usize) -> Updater {
    updater_of(shape().into(), config, threads)
}

fn updater_of(networks: Networks, config: &PpoConfig, threads: usize) -> Updater {
    let parameters = networks.initial_parameters(-0.5, &mut rng(1));
    let options = PpoOptions::on_cpu(threads).expect("threads start");
    let state = PpoState::new(networks, parameters, rng(1), config);
    Updater { ppo: Ppo::new(options, config), state }
}

/// Batch of actions of the updater's policy. The best action is the first two observations, the return their sum.
fn batch(updater: &Updater, rows: usize, seed: u64) -> Batch {
    let (shape, mut rng) = (updater.shape(), rng(seed));
    let policy = updater.policy();
    let mut normals = |count: usize| (0..count).map(|_| StandardNormal.sample(&mut rng)).collect::<Vec<f32>>();
    let observations = normals(rows * shape.observation);
    let noise = normals(rows * shape.action);
    let mut means = vec![0.0; rows * shape.action];
    policy.means(&observations, rows, &mut means);
    let values = policy.values(&observations, rows);
    let mut batch = Batch { actions: vec![0.0; noise.len()], values, ..Batch::default() };
    for row in 0..rows {
        let range = row * shape.action..(row + 1) * shape.action;
        let action = &mut batch.actions[range.clone()];
        sample(&means[range.clone()], policy.log_std(), &noise[range.clone()], action);
        batch.weights.push(1.0);
        batch.log_probs.push(log_probability(action, &means[range], policy.log_std()));
        let seen = &observations[row * shape.observation..];
        batch.advantages.push(-(0..shape.action).map(|i| (action[i] - seen[i]).powi(2)).sum::<f32>());
        batch.returns.push(seen[0] + seen[1]);
    }
    (batch.observations, batch.means) = (observations, means);
    batch
}

/// Policy loss and value loss of the whole batch under the updater's parameters, and the gradient of the total.
fn losses(updater: &Updater, batch: &Batch) -> ([f64; 2], Vec<f32>) {
    let Updater { ppo: Ppo { config, .. }, state: PpoState { networks, parameters, .. } } = updater;
    let rows: Vec<u32> = (0..batch.len() as u32).collect();
    let mut gradient = vec![0.0; parameters.len()];
    let tensors = TensorGradient::upload(batch, &normalised(&batch.advantages), networks, config);
    let loss = tensors.and_then(|t| t.compute(&rows, parameters, &mut gradient)).expect("candle runs");
    ([loss.policy, loss.value].map(|sum| sum / rows.len() as f64), gradient)
}

/// Returns the divergence of one policy from another over all rows of a batch.
fn exact_divergence(before: &Policy, after: &Policy, batch: &Batch) -> f64 {
    let means = |policy: &Policy| {
        let mut means = vec![0.0; batch.actions.len()];
        policy.means(&batch.observations, batch.len(), &mut means);
        means
    };
    kl_divergence(&means(before), before.log_std(), &means(after), after.log_std())
}

/// Asserts that only the random streams may differ.
#[track_caller]
fn assert_same(a: &Updater, b: &Updater) {
    assert_eq!(a.state, PpoState { shuffle: a.state.shuffle.clone(), ..b.state.clone() });
}

#[test]
fn an_update_lowers_both_losses_and_returns_its_statistics() {
    let mut updater = updater(&config(), 1);
    let batch = batch(&updater, 1000, 2);
    let (before, _) = losses(&updater, &batch);
    let stats = updater.update(&batch, 3).expect("a sound batch");
    let (after, _) = losses(&updater, &batch);
    for (before, after) in before.iter().zip(after) {
        assert!(after < before - 0.005, "{before} {after}");
    }
    assert!(before[0].abs() < 1e-5, "advantages of mean 0 under ratios of 1");
    assert_eq!((stats.gradient_steps, stats.samples), (9, 3000));
    assert!(stats.value_loss < before[1] && stats.value_loss > after[1], "the mean lies between first and last");
    assert!(stats.approx_kl > 0.0 && stats.grad_norm > 0.0 && stats.entropy > 1.0);
    assert!((0.0..1.0).contains(&stats.clip_fraction));
    assert!(stats.explained_variance < 0.5, "a fresh critic explains little: {}", stats.explained_variance);
    assert!((stats.std - 0.6).abs() < 0.1);
    assert_eq!(stats.learning_rate, updater.state.learning_rate);
    assert_eq!(updater.state.optimiser.step, 9);
}

#[test]
fn equivariant_networks_remain_so_and_learn() {
    let mirror =
        PolicyMirror { observation: vec![(1, 1.0), (0, 1.0), (2, -1.0), (3, 1.0)], action: vec![(1, 1.0), (0, 1.0)] };
    let networks = Networks::new(shape(), Some(mirror)).expect("the mirror fits");
    let mut updater = updater_of(networks, &PpoConfig { minibatch: 250, ..config() }, 1);
    let observations = [0.8, -0.5, 0.3, 0.1, -0.5, 0.8, -0.3, 0.1];
    for i in 0..60 {
        let batch = batch(&updater, 1000, 100 + i);
        updater.update(&batch, i).expect("a sound batch");
        let policy = updater.policy();
        let mut means = [0.0; 4];
        policy.means(&observations, 2, &mut means);
        let values = policy.values(&observations, 2);
        assert!((means[0] - means[3]).abs() < 1e-6 && (means[1] - means[2]).abs() < 1e-6, "{means:?}");
        assert!((values[0] - values[1]).abs() < 1e-6 && policy.log_std()[0] == policy.log_std()[1]);
        assert!(i < 59 || (means[0] - 0.8).abs() < 0.25 && (means[1] + 0.5).abs() < 0.25, "{means:?}");
    }
}

#[test]
fn many_updates_solve_the_problem() {
    let mut updater = updater(&PpoConfig { minibatch: 250, ..config() }, 1);
    let mut stats = UpdateStats::default();
    for i in 0..60 {
        let batch = batch(&updater, 1000, 100 + i);
        stats = updater.update(&batch, i).expect("a sound batch");
    }
    assert!(stats.explained_variance > 0.9, "{stats:?}");
    let policy = updater.policy();
    let mut means = [0.0; 4];
    policy.means(&[0.8, -0.5, 0.0, 0.0, -0.6, 0.7, 0.0, 0.0], 2, &mut means);
    for (mean, best) in means.iter().zip([0.8, -0.5, -0.6, 0.7]) {
        assert!((mean - best).abs() < 0.25, "{means:?}");
    }
}

#[test]
fn one_gradient_step_equals_that_of_candles_operations() {
    let config = PpoConfig { minibatch: 600, epochs: 1, target_kl: 0.0, max_grad_norm: 0.1, ..PpoConfig::default() };
    let mut updater = updater(&config, 1);
    let batch = batch(&updater, 600, 2);
    let (_, gradient) = losses(&updater, &batch);
    let norm = gradient.iter().map(|g| f64::from(*g).powi(2)).sum::<f64>().sqrt();

    let start = updater.state.parameters.clone();
    let stats = updater.update(&batch, 3).expect("a sound batch");
    assert!((stats.grad_norm - norm).abs() < 1e-5 * norm && norm > 0.1, "{} {norm}", stats.grad_norm);
    // After one step from zero the first moment is a tenth of the clipped gradient.
    for (moment, gradient) in updater.state.optimiser.first_moment.iter().zip(&gradient) {
        let expected = 0.1 * f64::from(*gradient) * (0.1 / norm);
        assert!((f64::from(*moment) - expected).abs() < 1e-7, "{moment} {expected}");
    }
    let moved = updater.state.parameters.iter().zip(&start).filter(|(new, old)| new != old).count();
    assert!(moved > start.len() * 9 / 10, "{moved} of {} parameters moved", start.len());
}

#[test]
fn the_number_of_threads_does_not_change_a_bit() {
    let config = PpoConfig { minibatch: 1500, epochs: 2, ..PpoConfig::default() };
    let mut alone = updater(&config, 1);
    let batch = batch(&alone, 3001, 5);
    let stats = alone.update(&batch, 6).expect("a sound batch");
    for threads in [2, 3] {
        let mut together = updater(&config, threads);
        assert_eq!(together.update(&batch, 6).expect("a sound batch"), stats);
        assert_same(&together, &alone);
    }
}

#[test]
fn a_restored_updater_continues_with_the_same_bits() {
    let mut whole = updater(&config(), 1);
    let first = batch(&whole, 700, 8);
    whole.update(&first, 9).expect("a sound batch");
    let mut restored = Updater { state: whole.state.clone(), ..updater(&config(), 1) };
    let second = batch(&whole, 700, 10);
    for updater in [&mut whole, &mut restored] {
        updater.update(&second, 11).expect("a sound batch");
    }
    assert_same(&restored, &whole);
}

#[test]
fn an_update_with_a_non_finite_number_is_undone() {
    let mut updater = updater(&config(), 1);
    let good = batch(&updater, 700, 8);
    updater.update(&good, 9).expect("a sound batch");
    let mut untouched = updater.clone();

    let spoil: [fn(&mut Batch); 7] = [
        |batch| batch.returns[0] = 3e30,
        |batch| batch.means[3] = f32::NAN,
        |batch| batch.observations[1234] = f32::NAN,
        |batch| batch.actions[77] = f32::INFINITY,
        |batch| batch.log_probs[699] = f32::NAN,
        |batch| batch.advantages[3] = f32::NAN,
        |batch| batch.returns[0] = f32::INFINITY,
    ];
    for spoil in spoil {
        let mut bad = good.clone();
        spoil(&mut bad);
        let error = updater.update(&bad, 9).expect_err("not finite");
        assert!(matches!(error, UpdateError::NonFinite { .. }), "{error}");
        assert_same(&updater, &untouched);
    }
    for updater in [&mut updater, &mut untouched] {
        updater.update(&good, 12).expect("a sound batch");
    }
    assert_same(&updater, &untouched);
}

#[test]
fn parameters_that_overflow_are_undone() {
    let config = PpoConfig { minibatch: 700, epochs: 1, ..config() };
    let mut updater = updater(&config, 1);
    updater.state.learning_rate = 1e300;
    let fresh = updater.clone();
    let batch = batch(&updater, 700, 8);
    let error = updater.update(&batch, 9).expect_err("an infinite step");
    assert!(matches!(error, UpdateError::NonFinite { what: "parameter vector" }), "{error}");
    assert_same(&updater, &fresh);
}

#[test]
fn the_standard_deviation_never_leaves_its_range() {
    let config = PpoConfig { entropy_coefficient: 100.0, learning_rate: 1.0, target_kl: 0.0, ..config() };
    let mut updater = updater(&config, 1);
    let batch = batch(&updater, 700, 8);
    updater.update(&batch, 9).expect("a sound batch");
    assert_eq!(updater.policy().log_std(), [LOG_STD_MAX; 2]);
}

#[test]
fn the_learning_rate_adapts_once_per_epoch() {
    let still = PpoConfig { learning_rate: 1e-9, learning_rate_min: 1e-9, target_kl: 0.01, ..config() };
    let mut updater = updater(&still, 1);
    let batch = batch(&updater, 700, 8);
    let stats = updater.update(&batch, 9).expect("a sound batch");
    assert!((stats.learning_rate / 1e-9 - 1.5_f64.powi(3)).abs() < 1e-9, "{}", stats.learning_rate);
}

#[test]
fn the_divergence_is_that_after_the_last_step() {
    // One pass of one gradient step: the ratios are 1 when its gradient is computed.
    let config = PpoConfig { minibatch: 500, epochs: 1, target_kl: 0.0, learning_rate: 1e-3, ..config() };
    let mut updater = updater(&config, 1);
    let before = updater.policy();
    let batch = batch(&updater, 500, 8);
    let free = updater.clone().update(&batch, 9).expect("a sound batch").approx_kl;
    let config = PpoConfig { target_kl: free / 3.0, ..config };
    updater.ppo.set_config(&config);
    let stats = updater.update(&batch, 9).expect("a sound batch");
    assert_eq!(stats.gradient_steps, 1);
    let after = updater.policy();
    let expected = exact_divergence(&before, &after, &batch);
    assert!(expected > 2.0 * config.target_kl, "{expected}");
    assert!((stats.approx_kl - expected).abs() < 1e-3 * expected, "{} {expected}", stats.approx_kl);
    // The step was too large.
    assert!((stats.learning_rate - 1e-3 / 1.5).abs() < 1e-12, "{}", stats.learning_rate);
}

#[test]
fn passes_that_lead_too_far_are_undone() {
    let config = PpoConfig { target_kl: 0.01, learning_rate: 0.3, learning_rate_max: 0.3, epochs: 8, ..config() };
    let mut updater = updater(&config, 1);
    // As little noise as a finished policy has.
    let range = updater.state.networks.log_std_range();
    updater.state.parameters[range].fill(-3.0);
    let (before, batch) = (updater.policy(), batch(&updater, 500, 8));
    let stats = updater.update(&batch, 9).expect("a sound batch");
    assert!((1..8).contains(&stats.undone_passes), "{stats:?}");
    assert!(stats.approx_kl > 0.0 && stats.approx_kl <= 0.08, "{stats:?}");
    let after = updater.policy();
    let exact = exact_divergence(&before, &after, &batch);
    assert!((stats.approx_kl / exact - 1.0).abs() < 1e-3, "{} {exact}", stats.approx_kl);
    assert!(stats.learning_rate <= 0.3 / 4.0_f64.powi(stats.undone_passes as i32) * 1.5_f64.powi(8), "{stats:?}");
    // Steps that were taken back are not counted by the optimiser.
    assert_eq!(updater.state.gradient_steps(), (8 - u64::from(stats.undone_passes)) * 2);
    let fixed = PpoConfig { target_kl: 0.0, ..config };
    assert_eq!(self::updater(&fixed, 1).update(&batch, 9).expect("a sound batch").undone_passes, 0);
}

#[test]
fn the_divergence_of_a_large_batch_is_measured_on_a_sample_of_it() {
    let config = PpoConfig { minibatch: 1000, epochs: 1, target_kl: 0.0, ..config() };
    let mut updater = updater(&config, 1);
    let batch = batch(&updater, 6000, 8);
    let stats = updater.update(&batch, 9).expect("a sound batch");
    let after = updater.policy();
    let mut means = vec![0.0; 12_000];
    after.means(&batch.observations, 6000, &mut means);
    let exact = kl_divergence(&batch.means, &[-0.5; 2], &means, after.log_std());
    assert!((stats.approx_kl / exact - 1.0).abs() < 0.1, "{} {exact}", stats.approx_kl);
    assert_ne!(stats.approx_kl, exact);
}

#[test]
fn batches_that_do_not_fit_are_refused() {
    let mut updater = updater(&config(), 1);
    let good = batch(&updater, 10, 8);
    assert!(matches!(updater.update(&Batch::default(), 1), Err(UpdateError::Empty)));
    let bad = Batch { observations: vec![0.0; 39], ..good };
    let error = updater.update(&bad, 1).expect_err("a number is missing");
    assert_eq!(error.to_string(), "the batch's observations hold 39 numbers, expected 40");
}

#[test]
fn state_that_does_not_fit_is_refused() {
    let mut updater = updater(&config(), 1);
    assert_eq!(updater.state.check(), Ok(()));
    updater.state.optimiser = crate::optimiser::OptimiserState::new(3);
    let why = updater.state.check().expect_err("three moments");
    assert!(why.starts_with("it has 3 first moments, but its network"), "{why}");
    updater.state.parameters.fill(f32::NAN);
    assert!(matches!(updater.ppo.policy(&updater.state), Err(ParameterError::NonFinite { .. })));
}

/// Updater with the same parameters whose gradients are computed as on a GPU, but on the CPU.
fn on_device(other: &Updater) -> Updater {
    let mut updater = other.clone();
    updater.ppo.options.device = Device::Candle;
    updater
}

#[test]
fn updates_on_a_device_equal_those_on_slices() {
    for privileged in [0, 1] {
        check_device(&NetworkShape { privileged, ..shape() });
    }
}

fn check_device(shape: &NetworkShape) {
    // Clipped gradients, clipped ratios, means out of bounds, and an adapted learning rate take part.
    let config = PpoConfig { max_grad_norm: 0.1, entropy_coefficient: 1e-3, bounds_limit: 0.02, ..config() };
    let mut fused = updater_of(shape.clone().into(), &config, 1);
    let mut device = on_device(&fused);
    for update in 0..5 {
        let batch = batch(&fused, 700, 8 + update);
        let stats = [&mut fused, &mut device].map(|updater| updater.update(&batch, update).expect("sound"));
        for (what, [a, b]) in [
            ("policy loss", [stats[0].policy_loss, stats[1].policy_loss]),
            ("value loss", [stats[0].value_loss, stats[1].value_loss]),
            ("entropy", [stats[0].entropy, stats[1].entropy]),
            ("bounds loss", [stats[0].bounds_loss, stats[1].bounds_loss]),
            ("divergence", [stats[0].approx_kl, stats[1].approx_kl]),
            ("clip fraction", [stats[0].clip_fraction, stats[1].clip_fraction]),
            ("norm", [stats[0].grad_norm, stats[1].grad_norm]),
        ] {
            assert!((a - b).abs() < 1e-5 * (1.0 + a.abs()), "{what}: {a} {b}");
        }
        assert_eq!(stats[0].learning_rate, stats[1].learning_rate);
        assert_eq!((stats[0].gradient_steps, stats[0].samples), (stats[1].gradient_steps, stats[1].samples));
        assert!(stats[0].grad_norm > 0.1 && (update < 4 || stats[0].bounds_loss > 0.0), "{stats:?}");
        let largest = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        let off = largest(fused.state.parameters(), device.state.parameters());
        assert!(off < 1e-5, "parameters are off by {off} after update {update}");
        let (a, b) = (&fused.state.optimiser, &device.state.optimiser);
        assert_eq!(a.step, b.step);
        assert!(largest(&a.first_moment, &b.first_moment) < 1e-5);
        assert!(largest(&a.second_moment, &b.second_moment) < 1e-5);
    }
}
