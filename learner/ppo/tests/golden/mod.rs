//! Results of PyTorch and numpy, written by `make.py`, and their comparison with the learner's.

use std::collections::BTreeMap;

use serde::de::DeserializeOwned;
use treadmill_config::PpoConfig;

/// Parses one of the files.
pub fn read<T: DeserializeOwned>(text: &str) -> T {
    serde_json::from_str(text).expect("the file is what make.py writes")
}

/// Converts to single precision; the inputs are exact in it.
pub fn narrow(numbers: &[f64]) -> Vec<f32> {
    numbers.iter().map(|number| *number as f32).collect()
}

/// Returns the numbers with the sign of the largest flipped: a mistake that every comparison has to find.
pub fn flipped(numbers: &[f64]) -> Vec<f64> {
    let size = |i: &usize| numbers[*i].abs();
    let largest = (0..numbers.len()).max_by(|a, b| size(a).total_cmp(&size(b))).expect("there are numbers");
    let mut flipped = numbers.to_vec();
    flipped[largest] = -flipped[largest];
    flipped
}

/// Number outside its tolerance.
#[derive(Debug)]
#[expect(dead_code, reason = "read where a failed assertion prints it")]
pub struct GoldenMismatch {
    pub what: &'static str,
    pub index: usize,
    pub found: f64,
    pub expected: f64,
    pub allowed: f64,
}

/// Compares number by number, to within `tolerance` times the root mean square of all expected numbers, or times the
/// expected number if that is larger.
pub fn compare<N: Copy + Into<f64>>(
    what: &'static str,
    found: &[N],
    expected: &[f64],
    tolerance: f64,
) -> Result<(), GoldenMismatch> {
    assert_eq!(found.len(), expected.len(), "{what}");
    let squares: f64 = expected.iter().map(|number| number * number).sum();
    let scale = (squares / expected.len() as f64).sqrt();
    for (index, (found, expected)) in found.iter().zip(expected).enumerate() {
        let (found, expected) = ((*found).into(), *expected);
        let allowed = tolerance * scale.max(expected.abs());
        let is_close = (found - expected).abs() <= allowed;
        if !is_close {
            return Err(GoldenMismatch { what, index, found, expected, allowed });
        }
    }
    Ok(())
}

/// Returns the default configuration with the values that a file gives by name.
pub fn config(given: &BTreeMap<String, f64>) -> PpoConfig {
    let mut config = PpoConfig::default();
    for (name, number) in given {
        let field = match name.as_str() {
            "clip_range" => &mut config.clip_range,
            "value_coefficient" => &mut config.value_coefficient,
            "entropy_coefficient" => &mut config.entropy_coefficient,
            "bounds_coefficient" => &mut config.bounds_coefficient,
            "bounds_limit" => &mut config.bounds_limit,
            "max_grad_norm" => &mut config.max_grad_norm,
            "learning_rate" => &mut config.learning_rate,
            "learning_rate_min" => &mut config.learning_rate_min,
            "learning_rate_max" => &mut config.learning_rate_max,
            "target_kl" => &mut config.target_kl,
            "minibatch" | "epochs" => {
                let field = if name == "epochs" { &mut config.epochs } else { &mut config.minibatch };
                *field = *number as u32;
                continue;
            }
            other => panic!("the configuration has no field {other}"),
        };
        *field = *number;
    }
    config
}
