//! Running mean and variance of observations and returns, which no outlier ruins and old rows leave slowly.

use serde::{Deserialize, Serialize};

/// Rows that the moments count at most. Beyond them, older rows lose weight: by 1/e over as many new rows. So moments
/// follow a run that changes, and a run of fewer steps has the moments of all its rows.
pub const ROWS_REMEMBERED: f64 = 2e7;
/// Distance from the centre in standard deviations to which a number is clamped before it is added. A normaliser that
/// clips at 10 shows the networks nothing beyond it. One number among `n` changes the mean by at most 20 σ / n and the
/// variance by at most 400 σ² / n.
const OUTLIER_STDS: f64 = 20.0;
/// Parts of a batch whose spreads are compared. The lower median of so many is right while half of the rows are.
const GROUPS: usize = 16;
/// Spread of a column that counts as constant, as a fraction of its mean; rounding is below it.
const CONSTANT_STD: f64 = 1e-6;

/// Running count, mean and sum of squared deviations of each column.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RunningMoments {
    /// Rows seen, at most [`ROWS_REMEMBERED`].
    pub count: f64,
    /// Mean of each column.
    pub mean: Vec<f64>,
    /// Sum over rows of the squared deviation from the mean, for each column.
    pub m2: Vec<f64>,
}

impl RunningMoments {
    /// Returns the moments of zero rows with `width` columns.
    pub fn new(width: usize) -> Self {
        Self { count: 0.0, mean: vec![0.0; width], m2: vec![0.0; width] }
    }

    /// Adds the rows of a batch, `[n, width]`; see [`Self::update_parts`].
    ///
    /// # Panics
    /// As for [`Self::update_parts`].
    pub fn update(&mut self, rows: &[f32], width: usize) {
        self.update_parts(&[rows], width);
    }

    /// Adds the rows of a batch that stand in several parts, each `[n, width]`. They must be finite, because the
    /// moments would keep NaN and infinity for ever.
    ///
    /// Outliers are clamped first. A column's centre is its mean, its scale the standard deviation or, if it is larger, the
    /// spread of the batch around the centre: the lower median over sixteen groups of rows. So a shift of most rows is
    /// followed at once, and one part with absurd numbers is not. In the first batch, the centre is the lower median of the
    /// groups' means. Columns without any scale, and a first batch of fewer than sixteen rows, are taken as they are.
    ///
    /// # Panics
    /// If `width` differs from that of the moments, or a part does not hold whole rows.
    pub fn update_parts(&mut self, parts: &[&[f32]], width: usize) {
        assert_eq!(width, self.mean.len(), "the moments have another width");
        let whole = parts.iter().all(|part| part.is_empty() || part.len().is_multiple_of(width));
        assert!(whole, "a part holds no whole rows of {width}");
        let rows = || parts.iter().flat_map(|part| part.chunks_exact(width.max(1)));
        let count = rows().count();
        if count == 0 {
            return;
        }
        let bounds = self.bounds(rows(), count);
        let clamped = |x: f32, (low, high): (f64, f64)| f64::from(x).clamp(low, high);
        // Two passes, because a one-pass sum of squares loses all digits if the mean is large.
        let mut batch = Self { count: count as f64, ..Self::new(width) };
        for row in rows() {
            for ((sum, x), bounds) in batch.mean.iter_mut().zip(row).zip(&bounds) {
                *sum += clamped(*x, *bounds);
            }
        }
        batch.mean.iter_mut().for_each(|sum| *sum /= count as f64);
        for row in rows() {
            for (((m2, mean), x), bounds) in batch.m2.iter_mut().zip(&batch.mean).zip(row).zip(&bounds) {
                let deviation = clamped(*x, *bounds) - mean;
                *m2 += deviation * deviation;
            }
        }
        self.merge(&batch);
        if self.count > ROWS_REMEMBERED {
            self.m2.iter_mut().for_each(|m2| *m2 *= ROWS_REMEMBERED / self.count);
            self.count = ROWS_REMEMBERED;
        }
    }

    /// Returns the range of plausible numbers of each column, given the `count` rows of a batch.
    fn bounds<'a>(&self, rows: impl Iterator<Item = &'a [f32]> + Clone, count: usize) -> Vec<(f64, f64)> {
        let width = self.mean.len();
        if self.count == 0.0 && count < GROUPS {
            return vec![(f64::NEG_INFINITY, f64::INFINITY); width];
        }
        let centres = if self.count > 0.0 {
            self.mean.clone()
        } else {
            medians(&group_means(rows.clone(), count, width, |_, x| x))
        };
        let mut scales = if self.count > 0.0 { self.variance() } else { vec![0.0; width] };
        if count >= GROUPS {
            let squares = group_means(rows, count, width, |column, x| (x - centres[column]).powi(2));
            scales.iter_mut().zip(medians(&squares)).for_each(|(scale, square)| *scale = scale.max(square));
        }
        let bounds = |(centre, scale): (&f64, f64)| match scale.sqrt() {
            std if std > CONSTANT_STD * centre.abs() => (centre - OUTLIER_STDS * std, centre + OUTLIER_STDS * std),
            _ => (f64::NEG_INFINITY, f64::INFINITY),
        };
        centres.iter().zip(scales).map(bounds).collect()
    }

    /// Merges the moments of other rows: Chan, Golub & LeVeque 1979, "Updating formulae and a pairwise algorithm
    /// for computing sample variances", equation 2.1.
    ///
    /// # Panics
    /// If the widths differ.
    pub fn merge(&mut self, other: &Self) {
        assert_eq!(self.mean.len(), other.mean.len(), "the moments have another width");
        let total = self.count + other.count;
        if total == 0.0 {
            return;
        }
        let share = other.count / total;
        for i in 0..self.mean.len() {
            let delta = other.mean[i] - self.mean[i];
            self.mean[i] += delta * share;
            self.m2[i] += other.m2[i] + delta * delta * self.count * share;
        }
        self.count = total;
    }

    /// Replaces the moments by those of the rows together with their mirror images, and the count by half of theirs. In
    /// a mirrored row, each entry is a sign times the entry at an index.
    ///
    /// # Panics
    /// If the widths differ.
    pub fn symmetrise(&mut self, reflection: &[(usize, f32)]) {
        assert_eq!(reflection.len(), self.mean.len(), "the mirror has another width");
        let Self { count, mean, m2 } = self.clone();
        for (entry, (image, sign)) in reflection.iter().enumerate() {
            let half_apart = 0.5 * (mean[entry] - f64::from(*sign) * mean[*image]);
            self.mean[entry] = 0.5 * (mean[entry] + f64::from(*sign) * mean[*image]);
            self.m2[entry] = 0.5 * (m2[entry] + m2[*image]) + count * half_apart * half_apart;
        }
    }

    /// Returns the population variance of each column; 1 before the first row.
    pub fn variance(&self) -> Vec<f64> {
        let divide = |m2: &f64| if self.count > 0.0 { m2 / self.count } else { 1.0 };
        self.m2.iter().map(divide).collect()
    }

    /// Returns whether all moments are finite.
    pub fn is_finite(&self) -> bool {
        self.count.is_finite() && self.mean.iter().chain(&self.m2).all(|number| number.is_finite())
    }
}

/// Returns the mean of `of(column, x)` over the rows of each of [`GROUPS`] groups of neighbouring rows, `[group][column]`.
fn group_means<'a>(
    rows: impl Iterator<Item = &'a [f32]>,
    count: usize,
    width: usize,
    of: impl Fn(usize, f64) -> f64,
) -> Vec<Vec<f64>> {
    let mut groups = vec![vec![0.0; width]; GROUPS];
    let mut sizes = [0.0; GROUPS];
    for (number, row) in rows.enumerate() {
        let group = number * GROUPS / count;
        sizes[group] += 1.0;
        for (column, (sum, x)) in groups[group].iter_mut().zip(row).enumerate() {
            *sum += of(column, f64::from(*x));
        }
    }
    for (group, size) in groups.iter_mut().zip(sizes) {
        group.iter_mut().for_each(|sum| *sum /= size);
    }
    groups
}

/// Returns the lower median over groups of each column.
fn medians(groups: &[Vec<f64>]) -> Vec<f64> {
    let column = |column: usize| {
        let mut numbers: Vec<f64> = groups.iter().map(|group| group[column]).collect();
        let (_, median, _) = numbers.select_nth_unstable_by((groups.len() - 1) / 2, f64::total_cmp);
        *median
    };
    (0..groups[0].len()).map(column).collect()
}

#[cfg(test)]
#[path = "moments_tests.rs"]
mod tests;
