//! Quantiles of any number of samples in memory that does not grow.

/// Bins for each factor of ten: a quantile is told up to 2.4 % too high.
const BINS_PER_DECADE: f64 = 100.0;
/// What is at or below this counts as nothing: in metres or radians it is far below any rounding.
const SMALLEST: f64 = 1e-16;
/// From [`SMALLEST`] up to 1e4. The last bin has what is larger, too, and is told as the largest sample.
const BINS: usize = 2000;

/// A histogram with logarithmic bins, for samples that are not negative.
#[derive(Clone, Debug)]
pub struct Quantiles {
    counts: Vec<u64>,
    nothing: u64,
    total: u64,
    largest: f64,
}

impl Default for Quantiles {
    fn default() -> Self {
        Self { counts: vec![0; BINS], nothing: 0, total: 0, largest: 0.0 }
    }
}

impl Quantiles {
    /// Counts one sample.
    pub fn add(&mut self, sample: f64) {
        self.total += 1;
        self.largest = self.largest.max(sample);
        if sample <= SMALLEST {
            self.nothing += 1;
        } else {
            let bin = ((sample / SMALLEST).log10() * BINS_PER_DECADE) as usize;
            self.counts[bin.min(BINS - 1)] += 1;
        }
    }

    /// Counts what another has counted.
    pub fn merge(&mut self, other: &Self) {
        self.counts.iter_mut().zip(&other.counts).for_each(|(mine, theirs)| *mine += theirs);
        self.nothing += other.nothing;
        self.total += other.total;
        self.largest = self.largest.max(other.largest);
    }

    /// The value that this share of the samples does not exceed: the upper end of its bin, and never more than the
    /// largest sample. 0 without samples.
    pub fn quantile(&self, share: f64) -> f64 {
        let rank = (share * self.total as f64).ceil() as u64;
        let mut passed = self.nothing;
        if rank <= passed {
            return 0.0;
        }
        for (bin, count) in self.counts.iter().enumerate() {
            passed += count;
            if rank <= passed && bin + 1 < BINS {
                return (SMALLEST * 10f64.powf((bin + 1) as f64 / BINS_PER_DECADE)).min(self.largest);
            }
        }
        self.largest
    }

    /// The largest sample, exactly.
    pub fn largest(&self) -> f64 {
        self.largest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(samples: impl IntoIterator<Item = f64>) -> Quantiles {
        let mut quantiles = Quantiles::default();
        samples.into_iter().for_each(|sample| quantiles.add(sample));
        quantiles
    }

    #[test]
    fn quantiles_are_those_of_the_sorted_samples_within_a_bin() {
        let samples: Vec<f64> = (1..=1000).map(|number| f64::from(number).powi(3) * 1e-9).collect();
        let quantiles = of(samples.iter().rev().copied());
        for (share, rank) in [(0.001, 1), (0.5, 500), (0.99, 990), (0.999, 999), (1.0, 1000)] {
            let (found, exact) = (quantiles.quantile(share), samples[rank - 1]);
            assert!((exact..exact * 1.024).contains(&found) || found == exact, "{share}: {found} instead of {exact}");
        }
        assert_eq!(quantiles.largest(), 1.0);
        assert_eq!(quantiles.quantile(1.0), 1.0, "the upper end of a bin is not told beyond the largest sample");
    }

    #[test]
    fn nothing_and_everything_have_a_place() {
        assert_eq!(Quantiles::default().quantile(0.5), 0.0);
        let quantiles = of([0.0, 0.0, 0.0, 1e9]);
        assert_eq!((quantiles.quantile(0.75), quantiles.quantile(1.0)), (0.0, 1e9));
        assert_eq!(quantiles.largest(), 1e9);
    }

    #[test]
    fn merging_is_counting_together() {
        let (low, high) = (of((1..500).map(f64::from)), of((500..=1000).map(f64::from)));
        let mut merged = low;
        merged.merge(&high);
        let together = of((1..=1000).map(f64::from));
        for share in [0.1, 0.5, 0.9, 0.999, 1.0] {
            assert_eq!(merged.quantile(share), together.quantile(share));
        }
    }
}
