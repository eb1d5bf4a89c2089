//! Bounded history of a run: curves over environment steps, and rates over the last seconds.

use std::collections::VecDeque;

/// Most points of one curve: more than any terminal has columns of dots.
const POINTS_MAX: usize = 1024;
/// Largest absolute value that is kept, so that differences stay finite.
const VALUE_MAX: f64 = 1e15;
/// Window of a rate.
const WINDOW_S: f64 = 10.0;
/// Most measurements of a rate that are kept.
const MARKS_MAX: usize = 64;

/// Values over environment steps. A long run is kept whole, with coarser spacing.
#[derive(Clone, Debug, Default)]
pub struct Curve {
    points: Vec<(u64, f64)>,
    /// Smallest number of steps between two points.
    spacing: u64,
}

impl Curve {
    /// Adds a value. A step backwards means a resumed run and removes later points. Non-finite values are ignored.
    pub fn push(&mut self, step: u64, value: f64) {
        if !value.is_finite() {
            return;
        }
        let value = value.clamp(-VALUE_MAX, VALUE_MAX);
        while self.points.last().is_some_and(|(last, _)| *last >= step) {
            self.points.pop();
        }
        // The newest point is always kept; the next one replaces it if it is too near to its predecessor.
        if let [.., (before, _), last] = &mut self.points[..]
            && last.0 < before.saturating_add(self.spacing)
        {
            *last = (step, value);
            return;
        }
        self.points.push((step, value));
        if self.points.len() > POINTS_MAX {
            self.thin();
        }
    }

    /// Removes about half of the points, and keeps the first and the last.
    fn thin(&mut self) {
        let (first, last) = (self.points[0].0, self.points[self.points.len() - 1]);
        self.spacing = (last.0 - first).div_ceil(POINTS_MAX as u64 / 2).max(1);
        self.points.dedup_by(|(step, _), (kept, _)| *step < kept.saturating_add(self.spacing));
        if self.points.last().is_some_and(|kept| kept.0 < last.0) {
            self.points.push(last);
        }
    }

    /// Iterates over the points as (environment steps, value).
    pub fn points(&self) -> impl ExactSizeIterator<Item = (f64, f64)> {
        self.points.iter().map(|(step, value)| (*step as f64, *value))
    }
}

/// Growth of a count per second.
#[derive(Clone, Debug, Default)]
pub struct Rate {
    marks: VecDeque<(f64, f64)>,
}

impl Rate {
    /// Adds the count at a time in seconds. A falling count means a restarted learner and clears the history.
    pub fn push(&mut self, at_s: f64, count: f64) {
        if self.marks.back().is_some_and(|(last_s, last)| at_s <= *last_s || count < *last) {
            self.marks.clear();
        }
        self.marks.push_back((at_s, count));
        while self.marks.len() > MARKS_MAX || self.marks.len() > 2 && self.marks[1].0 <= at_s - WINDOW_S {
            self.marks.pop_front();
        }
    }

    /// Returns the growth per second; `None` before the second measurement.
    pub fn per_s(&self) -> Option<f64> {
        let (first, last) = (self.marks.front()?, self.marks.back()?);
        (last.0 > first.0).then(|| (last.1 - first.1) / (last.0 - first.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps(curve: &Curve) -> Vec<f64> {
        curve.points().map(|(step, _)| step).collect()
    }

    fn last(curve: &Curve) -> Option<f64> {
        curve.points().last().map(|(_, value)| value)
    }

    #[test]
    fn long_run_is_kept_whole_and_within_bounds() {
        let mut curve = Curve::default();
        for update in 0..100_000u64 {
            curve.push(update * 8192, update as f64);
            assert!(curve.points().len() <= POINTS_MAX);
            assert_eq!(last(&curve), Some(update as f64));
        }
        let steps = steps(&curve);
        assert_eq!((steps[0], steps[steps.len() - 1]), (0.0, 99_999.0 * 8192.0));
        assert!(steps.len() > POINTS_MAX / 4, "{}", steps.len());
        let widest = steps.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        assert!(widest <= 8.0 * 99_999.0 * 8192.0 / POINTS_MAX as f64, "gaps are bounded: {widest}");
    }

    #[test]
    fn resumed_run_removes_points_after_its_checkpoint() {
        let mut curve = Curve::default();
        [10, 20, 30, 40].into_iter().for_each(|step| curve.push(step, step as f64));
        curve.push(20, -1.0);
        assert_eq!(curve.points().collect::<Vec<_>>(), [(10.0, 10.0), (20.0, -1.0)]);
        curve.push(30, f64::NAN);
        assert_eq!(last(&curve), Some(-1.0), "NaN is ignored");
        curve.push(u64::MAX, f64::MAX);
        assert_eq!(last(&curve), Some(VALUE_MAX));
    }

    #[test]
    fn rate_is_growth_over_the_last_seconds() {
        let mut rate = Rate::default();
        assert_eq!(rate.per_s(), None);
        rate.push(0.0, 5.0);
        assert_eq!(rate.per_s(), None);
        rate.push(2.0, 9.0);
        assert_eq!(rate.per_s(), Some(2.0));
        // From 2 s (9) to 12 s (29); older measurements do not count.
        rate.push(12.0, 29.0);
        assert_eq!(rate.per_s(), Some(2.0));
        rate.push(22.0, 29.0);
        assert_eq!(rate.per_s(), Some(0.0), "paused run");
        rate.push(24.0, 3.0);
        assert_eq!(rate.per_s(), None, "restarted learner");
        (0..1000).for_each(|mark| rate.push(25.0 + f64::from(mark) * 1e-3, f64::from(mark)));
        assert!(rate.marks.len() <= MARKS_MAX);
    }
}
