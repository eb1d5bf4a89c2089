//! Share of the fleet's work that is learnt from, and share of its time without work, over the last updates.

use std::{collections::VecDeque, time::Instant};

use crate::intake::FleetEffort;

/// Efficiency of the fleet over the last updates; `None` where senders do not say what they did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Efficiency {
    /// Environment steps learnt from, divided by those that the actors counted.
    pub used_share: Option<f64>,
    /// Share of the actors' time in which they did not simulate.
    pub idle_share: Option<f64>,
}

/// Measures the efficiency.
#[derive(Debug)]
pub struct EfficiencyMeter {
    marks: VecDeque<Mark>,
}

#[derive(Clone, Copy, Debug)]
struct Mark {
    at: Instant,
    learnt: u64,
    effort: FleetEffort,
    /// Seconds that actors were alive, summed over actors.
    alive_s: f64,
}

impl EfficiencyMeter {
    /// Number of updates in the measurement.
    const UPDATES: usize = 20;

    /// Starts to measure.
    pub fn new(now: Instant) -> Self {
        Self { marks: [Mark { at: now, learnt: 0, effort: FleetEffort::default(), alive_s: 0.0 }].into() }
    }

    /// Records an update that learnt from `learnt` environment steps; 0 if it was undone. `effort` is that since the start.
    pub fn mark(&mut self, now: Instant, learnt: u64, effort: FleetEffort, alive: usize) -> Efficiency {
        let last = self.marks.back().copied().expect("there is always a mark");
        let alive_s = last.alive_s + alive as f64 * now.duration_since(last.at).as_secs_f64();
        self.marks.push_back(Mark { at: now, learnt: last.learnt + learnt, effort, alive_s });
        if self.marks.len() > Self::UPDATES {
            self.marks.pop_front();
        }
        let first = self.marks.front().copied().expect("a mark was just added");
        let newest = self.marks.back().copied().expect("a mark was just added");
        let simulated = newest.effort.env_steps - first.effort.env_steps;
        let (collect_s, alive_s) = (newest.effort.collect_s - first.effort.collect_s, newest.alive_s - first.alive_s);
        let share = |part: f64, whole: f64| (part / whole).clamp(0.0, 1.0);
        Efficiency {
            used_share: (simulated > 0).then(|| share((newest.learnt - first.learnt) as f64, simulated as f64)),
            idle_share: (collect_s > 0.0 && alive_s > 0.0).then(|| 1.0 - share(collect_s, alive_s)),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    #[test]
    fn shares_are_those_computed_by_hand() {
        let begun = Instant::now();
        let at = |seconds| begun + Duration::from_secs(seconds);
        let mut meter = EfficiencyMeter::new(begun);
        let effort = |env_steps, collect_s| FleetEffort { env_steps, collect_s };
        let first = meter.mark(at(10), 90, effort(100, 15.0), 2);
        assert_eq!(first, Efficiency { used_share: Some(0.9), idle_share: Some(0.25) });
        let undone = meter.mark(at(20), 0, effort(200, 35.0), 3);
        assert_eq!(undone, Efficiency { used_share: Some(0.45), idle_share: Some(1.0 - 35.0 / 50.0) });
    }

    #[test]
    fn only_the_last_updates_count() {
        let begun = Instant::now();
        let mut meter = EfficiencyMeter::new(begun);
        meter.mark(begun + Duration::from_secs(1), 0, FleetEffort { env_steps: 1000, collect_s: 1.0 }, 1);
        let mut newest = Efficiency::default();
        for update in 2..40 {
            let effort = FleetEffort { env_steps: 1000 + 8 * update, collect_s: 0.5 * update as f64 };
            newest = meter.mark(begun + Duration::from_secs(update), 8, effort, 1);
        }
        assert_eq!(newest, Efficiency { used_share: Some(1.0), idle_share: Some(0.5) });
    }

    #[test]
    fn nothing_is_known_of_senders_that_say_nothing() {
        let begun = Instant::now();
        let mut meter = EfficiencyMeter::new(begun);
        let unknown = meter.mark(begun + Duration::from_secs(1), 0, FleetEffort::default(), 4);
        assert_eq!(unknown, Efficiency::default());
    }
}
