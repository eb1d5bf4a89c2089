//! Normalisation by running mean and variance.
//!
//! [`RunningMoments`] is the learner's running state. [`Normaliser`] is the fixed function that is published with each
//! policy version, so that a rollout uses the statistics of its version.

use serde::{Deserialize, Serialize};

pub use super::moments::RunningMoments;

/// Added to a variance before its root is taken, so that a constant column is not divided by zero.
pub const VARIANCE_EPSILON: f64 = 1e-5;
/// Floor of a standard deviation as a fraction of the mean; see [`ScalarNormaliser::from_moments`].
const STD_FLOOR: f64 = 1e-4;
/// Least floor of a standard deviation.
const STD_MIN: f64 = 1e-12;

/// Normalisation `(x − mean) / √(variance + ε)`, clipped; ε is [`VARIANCE_EPSILON`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Normaliser {
    /// Mean of each column.
    pub mean: Vec<f32>,
    /// `1 / √(variance + ε)` of each column.
    pub inverse_std: Vec<f32>,
    /// Limit to which results are clipped, in both directions.
    pub clip: f32,
}

impl Normaliser {
    /// Returns the normalisation by these moments; before the first row it only clips.
    pub fn from_moments(moments: &RunningMoments, clip: f32) -> Self {
        if moments.count == 0.0 {
            return Self::identity(moments.mean.len(), clip);
        }
        let inverse = |variance: f64| (1.0 / (variance + VARIANCE_EPSILON).sqrt()) as f32;
        Self {
            mean: moments.mean.iter().map(|m| *m as f32).collect(),
            inverse_std: moments.variance().into_iter().map(inverse).collect(),
            clip,
        }
    }

    /// Returns a normalisation of `width` columns that only clips.
    pub fn identity(width: usize, clip: f32) -> Self {
        Self { mean: vec![0.0; width], inverse_std: vec![1.0; width], clip }
    }

    /// Returns the number of columns.
    pub fn width(&self) -> usize {
        self.mean.len()
    }

    /// Returns whether the numbers are usable for rows of `width` columns; checks external data.
    pub fn is_valid(&self, width: usize) -> bool {
        self.mean.len() == width
            && self.inverse_std.len() == width
            && self.mean.iter().all(|m| m.is_finite())
            && self.inverse_std.iter().all(|s| s.is_finite() && *s > 0.0)
            && self.clip.is_finite()
            && self.clip > 0.0
    }

    /// Normalises rows, `[n, width]`, in place; NaN stays NaN.
    ///
    /// # Panics
    /// If `rows` does not hold whole rows.
    pub fn apply(&self, rows: &mut [f32]) {
        assert!(rows.is_empty() || rows.len().is_multiple_of(self.width()), "no whole rows of {}", self.width());
        for row in rows.chunks_exact_mut(self.width().max(1)) {
            for ((x, mean), inverse_std) in row.iter_mut().zip(&self.mean).zip(&self.inverse_std) {
                *x = ((*x - mean) * inverse_std).clamp(-self.clip, self.clip);
            }
        }
    }

    /// Replaces `target` by the normalised `rows`.
    ///
    /// # Panics
    /// If `rows` does not hold whole rows.
    pub fn apply_into(&self, rows: &[f32], target: &mut Vec<f32>) {
        target.clear();
        target.extend_from_slice(rows);
        self.apply(target);
    }
}

/// Normalisation of one quantity in both directions, for value targets: the critic learns normalised returns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScalarNormaliser {
    /// Mean of the quantity.
    pub mean: f32,
    /// Standard deviation of the quantity, with a floor; see [`ScalarNormaliser::from_moments`].
    pub std: f32,
}

impl ScalarNormaliser {
    /// Returns the normalisation by these moments; before the first number it is the identity.
    ///
    /// The standard deviation has a floor of 1e-4 of the mean's absolute value, so that rounding is not amplified if numbers
    /// hardly differ, and of 1e-12. The relative floor makes the normalisation independent of the unit of rewards.
    ///
    /// # Panics
    /// If the moments are not those of one column.
    pub fn from_moments(moments: &RunningMoments) -> Self {
        assert_eq!(moments.mean.len(), 1, "moments of one column");
        if moments.count == 0.0 {
            return Self { mean: 0.0, std: 1.0 };
        }
        let floor = (STD_FLOOR * moments.mean[0]).abs().max(STD_MIN);
        let std = (moments.variance()[0] + floor * floor).sqrt() as f32;
        Self { mean: moments.mean[0] as f32, std }
    }

    /// Normalises numbers in place.
    pub fn normalise(&self, numbers: &mut [f32]) {
        numbers.iter_mut().for_each(|x| *x = (*x - self.mean) / self.std);
    }

    /// Converts normalised numbers back, in place.
    pub fn denormalise(&self, numbers: &mut [f32]) {
        numbers.iter_mut().for_each(|x| *x = *x * self.std + self.mean);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normalised_rows_agree_with_a_calculation_by_hand() {
        let moments = RunningMoments { count: 2.0, mean: vec![1.0, -1.0], m2: vec![8.0, 0.0] };
        let normaliser = Normaliser::from_moments(&moments, 10.0);
        let mut rows = Vec::new();
        normaliser.apply_into(&[3.0, -1.0, 101.0, 1.0, f32::NAN, -2.0], &mut rows);
        assert!((rows[0] - 1.0).abs() < 1e-5);
        assert_eq!(rows[1..4], [0.0, 10.0, 10.0]);
        assert!(rows[4].is_nan());
        assert_eq!(rows[5], -10.0);
    }

    #[test]
    fn constant_columns_become_zero_and_stay_bounded_when_they_change() {
        // A mass, zeros and a moving column, in as many batches as a run has updates.
        let mut moments = RunningMoments::new(3);
        for update in 0..500 {
            let rows: Vec<f32> = (0..64).flat_map(|row| [8.907_463_f32, 0.0, (update * row) as f32]).collect();
            moments.update(&rows, 3);
        }
        let normaliser = Normaliser::from_moments(&moments, 10.0);
        assert!(normaliser.is_valid(3));
        let mut rows = [8.907_463, 0.0, 7.0, 9.0, 4000.0, 7.0];
        normaliser.apply(&mut rows);
        assert_eq!(rows[..2], [0.0, 0.0]);
        assert_eq!(rows[3..5], [10.0, 10.0]);
        assert!(rows[2].abs() < 2.0);
    }

    #[test]
    fn before_any_data_normalisation_only_clips() {
        let mut rows = [0.5, -3.0, 11.0, 7.0];
        Normaliser::from_moments(&RunningMoments::new(2), 10.0).apply(&mut rows);
        assert_eq!(rows, [0.5, -3.0, 10.0, 7.0]);
        let scalar = ScalarNormaliser::from_moments(&RunningMoments::new(1));
        assert_eq!(scalar, ScalarNormaliser { mean: 0.0, std: 1.0 });
    }

    #[test]
    fn denormalising_reverses_normalising() {
        let scalar = ScalarNormaliser::from_moments(&RunningMoments { count: 4.0, mean: vec![5.0], m2: vec![16.0] });
        let mut numbers = [7.0, 5.0];
        scalar.normalise(&mut numbers);
        assert!((numbers[0] - 1.0).abs() < 1e-5 && numbers[1] == 0.0);
        scalar.denormalise(&mut numbers);
        assert!((numbers[0] - 7.0).abs() < 1e-5 && numbers[1] == 5.0);
    }

    #[test]
    fn unusable_numbers_are_invalid() {
        let good = Normaliser::identity(3, 10.0);
        assert!(good.is_valid(3));
        assert!(!good.is_valid(4));
        assert!(!Normaliser { inverse_std: vec![1.0, 0.0, 1.0], ..good.clone() }.is_valid(3));
        assert!(!Normaliser { mean: vec![f32::NAN, 0.0, 0.0], ..good.clone() }.is_valid(3));
        assert!(!Normaliser { clip: -1.0, ..good }.is_valid(3));
    }
}
