//! Quantiles of any number of samples in constant memory.

/// Bins per factor of ten: a quantile is up to 2.4 % too high.
const BINS_PER_DECADE: f64 = 100.0;
/// Samples up to this count as zero: in metres or radians it is far below rounding.
const SMALLEST: f64 = 1e-16;
/// Bins from [`SMALLEST`] to 1e4. The last bin also counts larger samples and stands for the largest.
const BINS: usize = 2000;

/// Histogram of non-negative samples with logarithmic bins.
#[derive(Clone, Debug)]
pub struct Quantiles {
    counts: Vec<u64>,
    zeros: u64,
    total: u64,
    largest: f64,
}

impl Default for Quantiles {
    fn default() -> Self {
        Self { counts: vec![0; BINS], zeros: 0, total: 0, largest: 0.0 }
    }
}

impl Quantiles {
    /// Counts one sample.
    pub fn add(&mut self, sample: f64) {
        self.total += 1;
        self.largest = self.largest.max(sample);
        if sample <= SMALLEST {
            self.zeros += 1;
        } else {
            let bin = ((sample / SMALLEST).log10() * BINS_PER_DECADE) as usize;
            self.counts[bin.min(BINS - 1)] += 1;
        }
    }

    /// Adds the samples of another histogram.
    pub fn merge(&mut self, other: &Self) {
        self.counts.iter_mut().zip(&other.counts).for_each(|(mine, theirs)| *mine += theirs);
        self.zeros += other.zeros;
        self.total += other.total;
        self.largest = self.largest.max(other.largest);
    }

    /// Returns the value that `share` of the samples do not exceed: the upper end of its bin, at most the largest sample.
    /// Returns 0 without samples.
    pub fn quantile(&self, share: f64) -> f64 {
        let rank = (share * self.total as f64).ceil() as u64;
        let mut passed = self.zeros;
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

    /// Returns the largest sample, exactly.
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
    fn quantiles_match_sorted_samples_within_a_bin() {
        let samples: Vec<f64> = (1..=1000).map(|number| f64::from(number).powi(3) * 1e-9).collect();
        let quantiles = of(samples.iter().rev().copied());
        for (share, rank) in [(0.001, 1), (0.5, 500), (0.99, 990), (0.999, 999), (1.0, 1000)] {
            let (found, exact) = (quantiles.quantile(share), samples[rank - 1]);
            assert!((exact..exact * 1.024).contains(&found) || found == exact, "{share}: {found} instead of {exact}");
        }
        assert_eq!(quantiles.largest(), 1.0);
        assert_eq!(quantiles.quantile(1.0), 1.0, "no quantile exceeds the largest sample");
    }

    #[test]
    fn zeros_and_huge_samples_are_counted() {
        assert_eq!(Quantiles::default().quantile(0.5), 0.0);
        let quantiles = of([0.0, 0.0, 0.0, 1e9]);
        assert_eq!((quantiles.quantile(0.75), quantiles.quantile(1.0)), (0.0, 1e9));
        assert_eq!(quantiles.largest(), 1e9);
    }

    #[test]
    fn merged_histogram_equals_one_of_all_samples() {
        let (low, high) = (of((1..500).map(f64::from)), of((500..=1000).map(f64::from)));
        let mut merged = low;
        merged.merge(&high);
        let together = of((1..=1000).map(f64::from));
        for share in [0.1, 0.5, 0.9, 0.999, 1.0] {
            assert_eq!(merged.quantile(share), together.quantile(share));
        }
    }
}
