//! Results of PyTorch and numpy, written by `make.py`, and their comparison with the learner's.

use serde::de::DeserializeOwned;

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
