//! Batch of one update, and its minibatches.

use std::ops::Range;

use rand::{Rng, RngExt};
use treadmill_policy::NetworkShape;

/// `S` transitions, in any order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Batch {
    /// Normalised observations, `[S, observation]`.
    pub observations: Vec<f32>,
    /// Actions before clipping to their range, `[S, action]`.
    pub actions: Vec<f32>,
    /// Action means of the policy that the update starts from, `[S, action]`; they measure how far the update moves it.
    pub means: Vec<f32>,
    /// Log-probabilities of the actions under that policy, the denominator of the ratios, `[S]`.
    pub log_probs: Vec<f32>,
    /// Factors on the normalised advantages, `[S]`: 1, or less if another policy acted.
    pub weights: Vec<f32>,
    /// Advantages as estimated, `[S]`; the update normalises them.
    pub advantages: Vec<f32>,
    /// Value targets, normalised, `[S]`.
    pub returns: Vec<f32>,
    /// Values before the update in the same units, `[S]`; used only for the explained variance.
    pub values: Vec<f32>,
}

impl Batch {
    /// Number of transitions, `S`.
    pub fn len(&self) -> usize {
        self.returns.len()
    }

    /// Whether the batch has no transitions.
    pub fn is_empty(&self) -> bool {
        self.returns.is_empty()
    }

    /// Returns name, numbers and width of each field.
    fn fields(&self, shape: &NetworkShape) -> [(&'static str, &[f32], usize); 8] {
        [
            ("batch's observations", &self.observations, shape.observation),
            ("batch's actions", &self.actions, shape.action),
            ("batch's means", &self.means, shape.action),
            ("batch's log-probabilities", &self.log_probs, 1),
            ("batch's weights", &self.weights, 1),
            ("batch's advantages", &self.advantages, 1),
            ("batch's returns", &self.returns, 1),
            ("batch's values", &self.values, 1),
        ]
    }

    /// Returns the first field with a wrong length, its length, and the expected length.
    pub(crate) fn wrong_length(&self, shape: &NetworkShape) -> Option<(&'static str, usize, usize)> {
        let lengths = self.fields(shape).map(|(name, numbers, width)| (name, numbers.len(), self.len() * width));
        lengths.into_iter().find(|(_, found, expected)| found != expected)
    }

    /// Returns the name of a field with a number that is infinite or NaN.
    pub(crate) fn non_finite(&self, shape: &NetworkShape) -> Option<&'static str> {
        let is_bad = |numbers: &[f32]| numbers.iter().any(|number| !number.is_finite());
        self.fields(shape).into_iter().find_map(|(name, numbers, _)| is_bad(numbers).then_some(name))
    }
}

/// Returns the given rows of a plane, `[S, width]`.
pub(crate) fn picked(plane: &[f32], width: usize, rows: &[u32]) -> Vec<f32> {
    let mut picked = Vec::with_capacity(rows.len() * width);
    for row in rows.iter().map(|row| *row as usize) {
        picked.extend_from_slice(&plane[row * width..(row + 1) * width]);
    }
    picked
}

/// Normalises the advantages over the whole batch and multiplies them by their weights.
pub(crate) fn weighted_advantages(batch: &Batch) -> Vec<f32> {
    let mut advantages = normalised(&batch.advantages);
    advantages.iter_mut().zip(&batch.weights).for_each(|(advantage, weight)| *advantage *= weight);
    advantages
}

/// Returns advantages with mean 0 and standard deviation 1; 1e-8 is added to the deviation.
pub(crate) fn normalised(advantages: &[f32]) -> Vec<f32> {
    let count = advantages.len() as f64;
    let mean = advantages.iter().map(|a| f64::from(*a)).sum::<f64>() / count;
    let variance = advantages.iter().map(|a| (f64::from(*a) - mean).powi(2)).sum::<f64>() / count;
    let scale = 1.0 / (variance.sqrt() + 1e-8);
    advantages.iter().map(|a| ((f64::from(*a) - mean) * scale) as f32).collect()
}

/// Cuts `rows` into minibatches whose sizes are as close to `size` as possible.
///
/// Every row is used; the sizes differ by at most one row and are below 1.5 · `size`.
pub(crate) fn minibatches(rows: usize, size: usize) -> impl Iterator<Item = Range<usize>> {
    let count = ((rows + size / 2) / size.max(1)).max(1);
    (0..count).map(move |i| rows * i / count..rows * (i + 1) / count)
}

/// Shuffles in place: Durstenfeld 1964, algorithm 235 (Fisher–Yates).
pub(crate) fn shuffle(order: &mut [u32], rng: &mut impl Rng) {
    for i in (1..order.len()).rev() {
        order.swap(i, rng.random_range(0..=i));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_xoshiro::{Xoshiro256PlusPlus, rand_core::SeedableRng};

    #[test]
    fn every_row_is_in_one_minibatch_and_sizes_are_balanced() {
        for (rows, size) in [(8192, 2048), (8200, 2048), (10, 4), (3, 4), (1, 100), (11, 4), (1000, 7), (5, 1)] {
            let mut next = 0;
            let mut sizes = Vec::new();
            for range in minibatches(rows, size) {
                assert_eq!(range.start, next);
                next = range.end;
                sizes.push(range.len());
            }
            assert_eq!(next, rows);
            let (least, most) = (sizes.iter().min().expect("one"), sizes.iter().max().expect("one"));
            assert!(most - least <= 1 && *most < size + size.div_ceil(2) + 1, "{rows} {size}: {sizes:?}");
        }
        assert_eq!(minibatches(8192, 2048).count(), 4);
    }

    #[test]
    fn shuffling_keeps_every_row_and_follows_the_seed() {
        let shuffled = |seed| {
            let mut order: Vec<u32> = (0..100).collect();
            shuffle(&mut order, &mut Xoshiro256PlusPlus::seed_from_u64(seed));
            order
        };
        assert_eq!(shuffled(1), shuffled(1));
        assert_ne!(shuffled(1), shuffled(2));
        let mut sorted = shuffled(1);
        sorted.sort_unstable();
        assert_eq!(sorted, (0..100).collect::<Vec<_>>());
    }

    #[test]
    fn shuffling_reaches_every_order_equally_often() {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(5);
        let mut counts = std::collections::BTreeMap::new();
        for _ in 0..6000 {
            let mut order = [0, 1, 2];
            shuffle(&mut order, &mut rng);
            *counts.entry(order).or_insert(0) += 1;
        }
        assert_eq!(counts.len(), 6);
        assert!(counts.values().all(|c| (850..1150).contains(c)), "{counts:?}");
    }

    #[test]
    fn normalised_advantages_equal_those_computed_by_hand() {
        let result = normalised(&[1.0, 3.0, 5.0]);
        let unit = (8.0_f32 / 3.0).sqrt();
        for (a, e) in result.iter().zip([-2.0 / unit, 0.0, 2.0 / unit]) {
            assert!((a - e).abs() < 1e-6);
        }
        assert_eq!(normalised(&[4.0, 4.0]), [0.0, 0.0]);
    }

    #[test]
    fn fields_of_another_length_or_with_infinite_numbers_are_named() {
        let shape = NetworkShape { observation: 2, action: 1, hidden: vec![], privileged: 0 };
        let batch = Batch {
            observations: vec![0.0, 1.0, 10.0, 11.0, 20.0, 21.0],
            actions: vec![0.5, 1.5, 2.5],
            means: vec![0.0; 3],
            log_probs: vec![-1.0, -2.0, -3.0],
            weights: vec![1.0; 3],
            advantages: vec![0.0; 3],
            returns: vec![7.0, 8.0, 9.0],
            values: vec![0.0; 3],
        };
        assert_eq!(batch.wrong_length(&shape), None);
        assert_eq!(picked(&batch.observations, 2, &[2, 0]), [20.0, 21.0, 0.0, 1.0]);
        let short = Batch { actions: vec![0.5], ..batch };
        assert_eq!(short.wrong_length(&shape), Some(("batch's actions", 1, 3)));
        assert_eq!(short.non_finite(&shape), None);
        let infinite = Batch { values: vec![0.0, f32::INFINITY, 0.0], ..short };
        assert_eq!(infinite.non_finite(&shape), Some("batch's values"));
    }
}
