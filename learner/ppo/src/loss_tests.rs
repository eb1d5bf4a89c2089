//! Loss against numbers computed by hand. `tests/pytorch.rs` compares it and its gradient with PyTorch.

use candle_core::{Device, Var};

use super::*;

/// One minibatch as plain numbers.
#[derive(Clone)]
struct Case {
    output: Vec<f64>,
    log_std: Vec<f64>,
    actions: Vec<f64>,
    log_probs: Vec<f64>,
    advantages: Vec<f64>,
    returns: Vec<f64>,
    config: PpoConfig,
}

fn tensor(numbers: &[f64]) -> Tensor {
    let narrow: Vec<f32> = numbers.iter().map(|x| *x as f32).collect();
    Tensor::new(narrow, &Device::Cpu).expect("a vector is a tensor")
}

impl Case {
    fn rows(&self) -> usize {
        self.returns.len()
    }

    /// Loss by Candle, and the leaves of its gradient.
    fn loss(&self) -> Result<(Loss, Var, Var)> {
        let (rows, actions) = (self.rows(), self.log_std.len());
        let output = Var::from_tensor(&tensor(&self.output).reshape((rows, actions + 1))?)?;
        let log_std = Var::from_tensor(&tensor(&self.log_std))?;
        let minibatch = Minibatch {
            actions: tensor(&self.actions).reshape((rows, actions))?,
            log_probs: tensor(&self.log_probs),
            advantages: tensor(&self.advantages),
            returns: tensor(&self.returns),
        };
        Ok((ppo_loss(&output, &log_std, &minibatch, &self.config)?, output, log_std))
    }
}

/// Six rows of two actions: ratios inside and outside the clip range with advantages of both signs, means outside the
/// bounds, every coefficient in use.
fn case() -> Case {
    let wave = |count: usize, step: f64, scale: f64| (0..count).map(|i| (i as f64 * step).sin() * scale).collect();
    let mut case = Case {
        output: wave(18, 1.7, 1.6),
        log_std: vec![-0.3, 0.2],
        actions: wave(12, 1.1, 1.2),
        log_probs: vec![0.0; 6],
        advantages: vec![1.0, -0.7, 0.8, -1.5, 0.4, -0.2],
        returns: wave(6, 0.9, 2.0),
        config: PpoConfig {
            entropy_coefficient: 0.01,
            bounds_coefficient: 0.3,
            value_coefficient: 0.7,
            ..PpoConfig::default()
        },
    };
    // Old log-probabilities for ratios of 1.5, 1.5, 0.6, 0.6, 1.1 and 0.9.
    let (loss, ..) = case.loss().expect("candle runs");
    let new = loss.log_ratio.to_vec1::<f32>().expect("a vector");
    case.log_probs =
        new.iter().zip([1.5, 1.5, 0.6, 0.6, 1.1, 0.9_f64]).map(|(l, ratio)| f64::from(*l) - ratio.ln()).collect();
    case
}

fn value(tensor: &Tensor) -> f64 {
    f64::from(tensor.to_scalar::<f32>().expect("a scalar"))
}

fn close(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-5, "{a} is not {b}");
}

#[test]
fn every_part_equals_the_one_computed_by_hand() -> Result<()> {
    // σ = 1; new log-probabilities of the rows: −½ ln 2π and −½ ln 2π − ½.
    let base = -0.5 * std::f64::consts::TAU.ln();
    let case = Case {
        output: vec![0.0, 3.0, 2.0, 1.0],
        log_std: vec![0.0],
        actions: vec![0.0, 1.0],
        log_probs: vec![base - 2.0_f64.ln(), base - 0.5],
        advantages: vec![1.0, -3.0],
        returns: vec![1.0, 2.0],
        config: PpoConfig {
            clip_range: 0.2,
            bounds_limit: 1.5,
            bounds_coefficient: 10.0,
            entropy_coefficient: 0.1,
            value_coefficient: 2.0,
            ..PpoConfig::default()
        },
    };
    let (loss, ..) = case.loss()?;
    // Ratios 2, clipped to 1.2 as the advantage is positive, and 1.
    close(value(&loss.policy), -(1.2 - 3.0) / 2.0);
    close(value(&loss.value), 0.5 * (4.0 + 1.0) / 2.0);
    close(value(&loss.entropy), 1.418_938_5);
    close(value(&loss.bounds), 0.25 / 2.0);
    close(value(&loss.total), 0.9 + 2.0 * 1.25 - 0.141_893_85 + 10.0 * 0.125);
    let log_ratio = loss.log_ratio.to_vec1::<f32>()?;
    close(f64::from(log_ratio[0]), 2.0_f64.ln());
    close(f64::from(log_ratio[1]), 0.0);
    Ok(())
}

#[test]
fn the_clipped_side_depends_on_the_sign_of_the_advantage() -> Result<()> {
    let policy = |ratio: f64, advantage: f64| -> Result<f64> {
        let base = -0.5 * std::f64::consts::TAU.ln();
        let case = Case {
            output: vec![0.0, 0.0],
            log_std: vec![0.0],
            actions: vec![0.0],
            log_probs: vec![base - ratio.ln()],
            advantages: vec![advantage],
            returns: vec![0.0],
            config: PpoConfig { clip_range: 0.2, ..PpoConfig::default() },
        };
        Ok(value(&case.loss()?.0.policy))
    };
    close(policy(1.5, 1.0)?, -1.2);
    close(policy(1.5, -1.0)?, 1.5);
    close(policy(0.5, 1.0)?, -0.5);
    close(policy(0.5, -1.0)?, 0.8);
    close(policy(1.1, 1.0)?, -1.1);
    Ok(())
}

#[test]
fn a_clipped_gain_has_no_gradient() -> Result<()> {
    let mut case = case();
    case.config.bounds_coefficient = 0.0;
    let (loss, output, _) = case.loss()?;
    let gradients = loss.total.backward()?;
    let rows = gradients.get(&output).expect("takes part").to_vec2::<f32>()?;
    let moves = rows.iter().map(|row| row[0] != 0.0 || row[1] != 0.0);
    // Clipped: ratio 1.5 with a positive and 0.6 with a negative advantage.
    assert_eq!(moves.collect::<Vec<_>>(), [false, true, true, false, true, true]);
    Ok(())
}
