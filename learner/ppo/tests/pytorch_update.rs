//! Whole PPO updates against PyTorch's in `golden/update.json`.
//!
//! Each test also shows that its comparison finds one wrong sign.

mod golden;

use std::collections::BTreeMap;

use golden::{GoldenMismatch, compare, flipped, narrow, read};
use rand::RngExt;
use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};
use serde::Deserialize;
use treadmill_config::PpoConfig;
use treadmill_policy::NetworkShape;
use treadmill_ppo::{Batch, Ppo, PpoOptions, PpoState, UpdateStats};

/// Relative to the parameters' root mean square, 0.3, or to their size. Each gradient step moves them by about 1e-3.
const PARAMETER_TOLERANCE: f64 = 1e-5;

/// Order of rows in each epoch, which PyTorch follows.
#[derive(Deserialize)]
struct OrderFile {
    seed: u64,
    rows: u32,
    orders: Vec<Vec<u32>>,
}

#[test]
fn the_recorded_order_equals_that_of_the_shuffle() {
    let file: OrderFile = read(include_str!("golden/order.json"));
    let mut random = Xoshiro256PlusPlus::seed_from_u64(file.seed);
    let mut order: Vec<u32> = (0..file.rows).collect();
    let orders: Vec<Vec<u32>> = (0..4)
        .map(|_| {
            (1..order.len()).rev().for_each(|i| order.swap(i, random.random_range(0..=i)));
            order.clone()
        })
        .collect();
    assert_eq!(file.orders, orders, "let \"orders\" in order.json be {orders:?}, and run make.py again");
}

#[derive(Clone, Deserialize)]
struct UpdateFile {
    observation: usize,
    action: usize,
    hidden: Vec<usize>,
    parameters: Vec<f64>,
    batch: BatchFile,
    one_step: UpdateCase,
    whole: UpdateCase,
    rising: UpdateCase,
}

#[derive(Clone, Deserialize)]
struct BatchFile {
    observations: Vec<f64>,
    actions: Vec<f64>,
    means: Vec<f64>,
    log_probs: Vec<f64>,
    advantages: Vec<f64>,
    returns: Vec<f64>,
    values: Vec<f64>,
}

#[derive(Clone, Deserialize)]
struct UpdateCase {
    config: PpoConfig,
    seed: u64,
    gradient_steps: u64,
    stats: BTreeMap<String, f64>,
    parameters: Vec<f64>,
    first_moment: Vec<f64>,
    second_moment: Vec<f64>,
}

impl UpdateFile {
    fn read() -> Self {
        read(include_str!("golden/update.json"))
    }

    /// Runs the learner's update of the same parameters with the same batch.
    fn run(&self, case: &UpdateCase) -> (PpoState, UpdateStats) {
        let shape = NetworkShape {
            observation: self.observation,
            action: self.action,
            hidden: self.hidden.clone(),
            privileged: 0,
        };
        let batch = Batch {
            observations: narrow(&self.batch.observations),
            actions: narrow(&self.batch.actions),
            means: narrow(&self.batch.means),
            log_probs: narrow(&self.batch.log_probs),
            weights: vec![1.0; self.batch.log_probs.len()],
            advantages: narrow(&self.batch.advantages),
            returns: narrow(&self.batch.returns),
            values: narrow(&self.batch.values),
        };
        let (config, random) = (&case.config, Xoshiro256PlusPlus::seed_from_u64(case.seed));
        let mut state = PpoState::new(shape.clone().into(), narrow(&self.parameters), random, config);
        let options = PpoOptions::on_cpu(1).expect("a thread starts");
        let stats = Ppo::new(options, config).update(&mut state, &batch, config.epochs).expect("the batch is sound");
        (state, stats)
    }

    fn compare(&self, case: &UpdateCase) -> std::result::Result<(), GoldenMismatch> {
        let (state, stats) = self.run(case);
        assert_eq!(stats.gradient_steps, case.gradient_steps);
        compare("parameters", state.parameters(), &case.parameters, PARAMETER_TOLERANCE)?;
        compare("first moment", &state.optimiser().first_moment, &case.first_moment, 1e-4)?;
        compare("second moment", &state.optimiser().second_moment, &case.second_moment, 1e-4)?;
        for (what, found) in [
            ("policy_loss", stats.policy_loss),
            ("value_loss", stats.value_loss),
            ("entropy", stats.entropy),
            ("bounds_loss", stats.bounds_loss),
            ("grad_norm", stats.grad_norm),
            ("approx_kl", stats.approx_kl),
            ("clip_fraction", stats.clip_fraction),
            ("learning_rate", stats.learning_rate),
            ("explained_variance", stats.explained_variance),
            ("std", stats.std),
        ] {
            // Gains and losses nearly cancel in the policy loss, so its relative error is larger.
            let tolerance = if what == "policy_loss" { 1e-2 } else { 1e-4 };
            compare(what, &[found], &[case.stats[what]], tolerance)?;
        }
        Ok(())
    }

    /// Returns the file with a changed batch.
    fn with(&self, change: impl FnOnce(&mut BatchFile)) -> Self {
        let mut changed = self.clone();
        change(&mut changed.batch);
        changed
    }
}

#[test]
fn one_gradient_step_equals_that_of_pytorch() {
    let file = UpdateFile::read();
    let case = &file.one_step;
    assert_eq!(case.gradient_steps, 1);
    file.compare(case).expect("the same step");
    // The first moment is a tenth of the clipped gradient.
    let wrong = UpdateCase { first_moment: flipped(&case.first_moment), ..case.clone() };
    assert_eq!(file.compare(&wrong).expect_err("the sign of a gradient is wrong").what, "first moment");
}

#[test]
fn a_whole_update_equals_that_of_pytorch() {
    let file = UpdateFile::read();
    let case = &file.whole;
    file.compare(case).expect("the same update");
    // The case covers clipped ratios, bounds, clipped gradients and an adapted learning rate.
    let stats = &case.stats;
    assert!(case.gradient_steps > 10 && stats["clip_fraction"] > 0.1 && stats["bounds_loss"] > 0.01, "{stats:?}");
    assert!(stats["grad_norm"] > case.config.max_grad_norm, "gradients are clipped: {stats:?}");
    assert!(stats["learning_rate"] < case.config.learning_rate / 2.0, "it was divided by 1.5 twice: {stats:?}");

    for (what, wrong) in [
        ("parameter", UpdateFile { parameters: flipped(&file.parameters), ..file.clone() }),
        ("advantage", file.with(|batch| batch.advantages = flipped(&batch.advantages))),
        ("return", file.with(|batch| batch.returns = flipped(&batch.returns))),
        ("action", file.with(|batch| batch.actions = flipped(&batch.actions))),
        ("observation", file.with(|batch| batch.observations = flipped(&batch.observations))),
    ] {
        let mismatch = wrong.compare(case).expect_err(what);
        assert_eq!(mismatch.what, "parameters", "the wrong sign of one {what}");
    }
    for (name, number) in &case.stats {
        let mut wrong = case.clone();
        wrong.stats.insert(name.clone(), -number);
        assert_eq!(file.compare(&wrong).expect_err("a wrong sign").what, name);
    }
}

#[test]
fn an_update_with_a_rising_learning_rate_equals_that_of_pytorch() {
    let file = UpdateFile::read();
    let case = &file.rising;
    assert_eq!(case.stats["learning_rate"], case.config.learning_rate_max);
    file.compare(case).expect("the same update");
    // With another learning rate the results differ.
    file.compare(&UpdateCase { config: file.whole.config.clone(), ..case.clone() }).expect_err("another learning rate");
}
