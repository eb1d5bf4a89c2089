//! The learner's mathematics against the results of PyTorch and numpy in `golden/`.
//!
//! Each test also shows that its comparison finds one wrong sign.

mod golden;

use std::collections::BTreeMap;

use candle_core::{Device, Result, Tensor, Var};
use golden::{GoldenMismatch, compare, flipped, narrow, read};
use serde::Deserialize;
use treadmill_config::PpoConfig;
use treadmill_policy::normaliser::{Normaliser, RunningMoments, ScalarNormaliser};
use treadmill_ppo::{
    gae::{self, Steps},
    loss::{Minibatch, ppo_loss},
    optimiser::{OptimiserState, clip_factor, global_norm},
};

#[derive(Clone, Deserialize)]
struct AdvantagesFile {
    envs: usize,
    gamma: f32,
    lambda: f32,
    rewards: Vec<f64>,
    values: Vec<f64>,
    terminated: Vec<bool>,
    truncated: Vec<bool>,
    truncated_values: Vec<f64>,
    final_values: Vec<f64>,
    next_values: Vec<f64>,
    advantages: Vec<f64>,
    returns: Vec<f64>,
}

impl AdvantagesFile {
    fn compare(&self) -> std::result::Result<(), GoldenMismatch> {
        let values = narrow(&self.values);
        let (truncated_values, final_values) = (narrow(&self.truncated_values), narrow(&self.final_values));
        let next = gae::next_values(&values, &self.terminated, &self.truncated, &truncated_values, &final_values);
        compare("values after each step", &next, &self.next_values, 1e-7)?;
        let steps = Steps {
            envs: self.envs,
            rewards: &narrow(&self.rewards),
            values: &values,
            next_values: &next,
            terminated: &self.terminated,
            truncated: &self.truncated,
        };
        let found = gae::estimate(&steps, self.gamma, self.lambda);
        compare("advantages", &found.advantages, &self.advantages, 1e-6)?;
        compare("returns", &found.returns, &self.returns, 1e-6)
    }
}

#[test]
fn advantages_equal_those_of_n_step_returns() {
    let file: AdvantagesFile = read(include_str!("golden/advantages.json"));
    file.compare().expect("the same advantages");
    AdvantagesFile { rewards: flipped(&file.rewards), ..file.clone() }.compare().expect_err("a reward is wrong");
    AdvantagesFile { values: flipped(&file.values), ..file.clone() }.compare().expect_err("a value is wrong");
    AdvantagesFile { truncated_values: flipped(&file.truncated_values), ..file.clone() }
        .compare()
        .expect_err("a value of a true last observation is wrong");
    AdvantagesFile { advantages: flipped(&file.advantages), ..file.clone() }.compare().expect_err("a number is wrong");

    // Confusing termination with truncation is an error in both directions.
    let with = |kind: &[bool], other: &[bool]| kind.iter().zip(other).position(|(kind, other)| *kind && !*other);
    let mut both = file.clone();
    let at = with(&file.terminated, &file.truncated).expect("a step that only terminated");
    both.terminated[at] = false;
    both.compare().expect_err("a terminated step that continues");
    let at = with(&file.truncated, &file.terminated).expect("a step that was only truncated");
    let mut both = file.clone();
    both.terminated[at] = true;
    both.truncated_values.remove(0);
    both.compare().expect_err("a truncated step that terminated");
}

#[derive(Clone, Deserialize)]
struct LossFile {
    config: PpoConfig,
    output: Vec<f64>,
    log_std: Vec<f64>,
    actions: Vec<f64>,
    log_probs: Vec<f64>,
    advantages: Vec<f64>,
    returns: Vec<f64>,
    parts: BTreeMap<String, f64>,
    log_ratio: Vec<f64>,
    output_gradient: Vec<f64>,
    log_std_gradient: Vec<f64>,
}

impl LossFile {
    fn compare(&self) -> std::result::Result<(), GoldenMismatch> {
        let (rows, actions) = (self.returns.len(), self.log_std.len());
        let inner = || -> Result<_> {
            let tensor = |numbers: &[f64]| Tensor::new(narrow(numbers), &Device::Cpu);
            let output = Var::from_tensor(&tensor(&self.output)?.reshape((rows, actions + 1))?)?;
            let log_std = Var::from_tensor(&tensor(&self.log_std)?)?;
            let minibatch = Minibatch {
                actions: tensor(&self.actions)?.reshape((rows, actions))?,
                log_probs: tensor(&self.log_probs)?,
                advantages: tensor(&self.advantages)?,
                returns: tensor(&self.returns)?,
            };
            let loss = ppo_loss(&output, &log_std, &minibatch, &self.config)?;
            let gradients = loss.total.backward()?;
            let of = |leaf: &Var| gradients.get(leaf).expect("takes part").flatten_all()?.to_vec1::<f32>();
            Ok((loss.log_ratio.to_vec1::<f32>()?, of(&output)?, of(&log_std)?, loss))
        };
        let (log_ratio, output_gradient, log_std_gradient, loss) = inner().expect("candle runs");
        for (what, found) in [
            ("policy", &loss.policy),
            ("value", &loss.value),
            ("entropy", &loss.entropy),
            ("bounds", &loss.bounds),
            ("total", &loss.total),
        ] {
            compare(what, &[found.to_scalar::<f32>().expect("a scalar")], &[self.parts[what]], 1e-5)?;
        }
        compare("log ratio", &log_ratio, &self.log_ratio, 1e-5)?;
        compare("gradient of the output", &output_gradient, &self.output_gradient, 1e-5)?;
        compare("gradient of the log std", &log_std_gradient, &self.log_std_gradient, 1e-5)
    }
}

#[test]
fn loss_and_gradient_equal_those_of_pytorch() {
    let file: LossFile = read(include_str!("golden/loss.json"));
    file.compare().expect("the same loss");
    for (what, wrong) in [
        ("advantage", LossFile { advantages: flipped(&file.advantages), ..file.clone() }),
        ("action", LossFile { actions: flipped(&file.actions), ..file.clone() }),
        ("output", LossFile { output: flipped(&file.output), ..file.clone() }),
        ("return", LossFile { returns: flipped(&file.returns), ..file.clone() }),
        ("log std", LossFile { log_std: flipped(&file.log_std), ..file.clone() }),
        ("gradient", LossFile { output_gradient: flipped(&file.output_gradient), ..file.clone() }),
        ("gradient of a log std", LossFile { log_std_gradient: flipped(&file.log_std_gradient), ..file.clone() }),
    ] {
        assert!(wrong.compare().is_err(), "the wrong sign of one {what} goes unnoticed");
    }
    for (name, part) in &file.parts {
        let mut wrong = file.clone();
        wrong.parts.insert(name.clone(), -part);
        assert!(wrong.compare().is_err(), "the wrong sign of the part {name} goes unnoticed");
    }
}

#[derive(Clone, Deserialize)]
struct AdamFile {
    max_norm: f64,
    start: Vec<f64>,
    steps: Vec<AdamStep>,
    first_moment: Vec<f64>,
    second_moment: Vec<f64>,
}

#[derive(Clone, Deserialize)]
struct AdamStep {
    gradient: Vec<f64>,
    learning_rate: f64,
    norm: f64,
    parameters: Vec<f64>,
}

impl AdamFile {
    fn compare(&self) -> std::result::Result<(), GoldenMismatch> {
        let mut parameters = narrow(&self.start);
        let mut state = OptimiserState::new(parameters.len());
        for step in &self.steps {
            let gradient = narrow(&step.gradient);
            let norm = global_norm(&gradient);
            compare("norm", &[norm], &[step.norm], 1e-7)?;
            state.apply(&mut parameters, &gradient, clip_factor(norm, self.max_norm), step.learning_rate);
            compare("parameters", &parameters, &step.parameters, 1e-6)?;
        }
        compare("first moment", &state.first_moment, &self.first_moment, 1e-5)?;
        compare("second moment", &state.second_moment, &self.second_moment, 1e-5)
    }
}

#[test]
fn clipping_and_adam_equal_those_of_pytorch() {
    let file: AdamFile = read(include_str!("golden/adam.json"));
    file.compare().expect("the same steps");
    for number in 0..file.steps.len() {
        let mut wrong = file.clone();
        wrong.steps[number].gradient = flipped(&wrong.steps[number].gradient);
        assert!(wrong.compare().is_err(), "the wrong sign of a gradient in step {number} goes unnoticed");
    }
    let wrong = AdamFile { first_moment: flipped(&file.first_moment), ..file.clone() };
    assert_eq!(wrong.compare().expect_err("a number is wrong").what, "first moment");
}

#[derive(Clone, Deserialize)]
struct MomentsFile {
    columns: usize,
    parts: Vec<Vec<f64>>,
    mean: Vec<f64>,
    variance: Vec<f64>,
    clip: f32,
    rows: Vec<f64>,
    normalised: Vec<f64>,
    scalars: Vec<f64>,
    scalars_normalised: Vec<f64>,
}

impl MomentsFile {
    fn moments_of(&self, parts: &[Vec<f64>]) -> RunningMoments {
        let mut moments = RunningMoments::new(self.columns);
        parts.iter().for_each(|part| moments.update(&narrow(part), self.columns));
        moments
    }

    fn compare(&self) -> std::result::Result<(), GoldenMismatch> {
        let one_by_one = self.moments_of(&self.parts);
        let (front, back) = self.parts.split_at(2);
        let mut merged = self.moments_of(front);
        merged.merge(&self.moments_of(back));
        for moments in [one_by_one, merged] {
            let found = moments.mean.iter().zip(moments.variance());
            for ((mean, variance), expected) in found.zip(self.mean.iter().zip(&self.variance)) {
                compare("mean", &[*mean], &[*expected.0], 1e-9)?;
                // numpy's mean of a column that never changes is off by rounding, so its variance is not quite 0.
                compare("variance", &[variance + 1e-12], &[expected.1 + 1e-12], 1e-9)?;
            }
            let mut rows = narrow(&self.rows);
            Normaliser::from_moments(&moments, self.clip).apply(&mut rows);
            compare("normalised rows", &rows, &self.normalised, 1e-4)?;
        }
        let scalar = ScalarNormaliser::from_moments(&{
            let mut moments = RunningMoments::new(1);
            self.scalars.chunks(7).for_each(|part| moments.update(&narrow(part), 1));
            moments
        });
        let mut scalars = narrow(&self.scalars);
        scalar.normalise(&mut scalars);
        compare("normalised scalars", &scalars, &self.scalars_normalised, 1e-5)?;
        scalar.denormalise(&mut scalars);
        compare("scalars brought back", &scalars, &self.scalars, 1e-6)
    }
}

#[test]
fn running_statistics_equal_those_of_numpy() {
    let file: MomentsFile = read(include_str!("golden/moments.json"));
    file.compare().expect("the same statistics");
    for number in 0..file.parts.len() {
        let mut wrong = file.clone();
        wrong.parts[number] = flipped(&wrong.parts[number]);
        assert!(wrong.compare().is_err(), "the wrong sign of a number in part {number} goes unnoticed");
    }
    let wrong = MomentsFile { rows: flipped(&file.rows), ..file.clone() };
    assert_eq!(wrong.compare().expect_err("a row is wrong").what, "normalised rows");
    let wrong = MomentsFile { scalars_normalised: flipped(&file.scalars_normalised), ..file.clone() };
    assert_eq!(wrong.compare().expect_err("a scalar is wrong").what, "normalised scalars");
}
