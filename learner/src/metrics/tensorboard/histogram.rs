//! Histograms as TensorBoard reads them: rows of left edge, right edge and count.

/// Number of buckets, as in TensorBoard's writer.
const BUCKETS: usize = 30;

/// Most buckets of whole numbers; the last also counts greater ones.
const WHOLE_MAX: usize = 128;

/// Counts of values in adjacent buckets.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    /// Left edge, right edge, count.
    pub rows: Vec<[f64; 3]>,
}

impl Histogram {
    /// Counts numbers in buckets of equal width from the smallest to the greatest; without numbers it has no rows.
    /// Omits numbers that are not finite. If all are equal, the last bucket counts them, and all buckets have width 0.
    pub fn of(values: impl Iterator<Item = f32> + Clone) -> Self {
        let finite = values.filter(|value| value.is_finite()).map(f64::from);
        let ends = finite
            .clone()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
        let (low, high) = ends;
        if low > high {
            return Self { rows: Vec::new() };
        }
        let width = (high - low) / BUCKETS as f64;
        let mut counts = [0u64; BUCKETS];
        for value in finite {
            let index = if width > 0.0 { ((value - low) / width) as usize } else { BUCKETS };
            counts[index.min(BUCKETS - 1)] += 1;
        }
        let edge = |index: usize| if index == BUCKETS { high } else { low + width * index as f64 };
        let rows = counts.iter().enumerate().map(|(index, count)| [edge(index), edge(index + 1), *count as f64]);
        Self { rows: rows.collect() }
    }

    /// Histogram of (whole number, count): one bucket around each number from 0 to the greatest.
    pub fn of_whole(counted: impl Iterator<Item = (u64, u64)>) -> Self {
        let mut rows: Vec<[f64; 3]> = Vec::new();
        for (number, count) in counted {
            let index = (number as usize).min(WHOLE_MAX - 1);
            for next in rows.len()..=index {
                rows.push([next as f64 - 0.5, next as f64 + 0.5, 0.0]);
            }
            rows[index][2] += count as f64;
        }
        Self { rows }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_is_counted_once_including_the_edges() {
        // Thirty buckets of width 0.1 from 0 to 3: 0 is in the first, 0.25 in the third, 3 in the last.
        let histogram = Histogram::of([0.0, 0.25, 3.0, f32::NAN, 3.0].into_iter());
        assert_eq!(histogram.rows.len(), 30);
        assert_eq!((histogram.rows[0][2], histogram.rows[2][2], histogram.rows[29][2]), (1.0, 1.0, 2.0));
        assert_eq!((histogram.rows[0][0], histogram.rows[29][1]), (0.0, 3.0));
        assert!(histogram.rows.windows(2).all(|pair| pair[0][1] == pair[1][0]));
        assert_eq!(histogram.rows.iter().map(|row| row[2]).sum::<f64>(), 4.0);
    }

    #[test]
    fn no_values_equal_values_and_huge_values_are_counted() {
        assert!(Histogram::of([].into_iter()).rows.is_empty());
        let equal = Histogram::of([0.5, 0.5].into_iter());
        assert_eq!((equal.rows[28], equal.rows[29]), ([0.5, 0.5, 0.0], [0.5, 0.5, 2.0]));
        let huge = Histogram::of([f32::MIN, f32::MAX].into_iter());
        assert_eq!((huge.rows[0][2], huge.rows[29][2]), (1.0, 1.0));
        assert!(huge.rows.iter().flatten().all(|entry| entry.is_finite()));
    }

    #[test]
    fn whole_numbers_have_one_bucket_each_up_to_a_limit() {
        let lags = Histogram::of_whole([(2, 64), (0, 128), (2, 1)].into_iter());
        assert_eq!(lags.rows, [[-0.5, 0.5, 128.0], [0.5, 1.5, 0.0], [1.5, 2.5, 65.0]]);
        let far = Histogram::of_whole([(u64::MAX, 3)].into_iter());
        assert_eq!((far.rows.len(), far.rows[WHOLE_MAX - 1][2]), (WHOLE_MAX, 3.0));
    }
}
