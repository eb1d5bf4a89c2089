//! Speed, share of the fleet's work that is learnt from, and shares of the time without work, over the last updates.

use std::{
    collections::VecDeque,
    time::{Duration, Instant},
};

use crate::intake::FleetEffort;

/// Speed and efficiency over the last updates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Efficiency {
    /// Environment steps per second.
    pub env_steps_per_s: f64,
    /// Share of the time in which the learner waited for rollouts.
    pub wait_share: f64,
    /// Environment steps learnt from, divided by those that the actors counted; `None` where they do not say.
    pub used_share: Option<f64>,
    /// Share of the actors' time in which they did not simulate; `None` where they do not say.
    pub idle_share: Option<f64>,
}

/// Measures speed and efficiency.
#[derive(Debug)]
pub struct EfficiencyMeter {
    marks: VecDeque<Mark>,
}

#[derive(Clone, Copy, Debug)]
struct Mark {
    at: Instant,
    env_steps: u64,
    waited: Duration,
    learnt: u64,
    effort: FleetEffort,
    /// Seconds that actors were alive, summed over actors.
    alive_s: f64,
}

/// Time over which speed and efficiency are measured; longer where updates are slow, so that there are enough of them.
const WINDOW: Duration = Duration::from_secs(10);
const UPDATES_MIN: usize = 20;
/// Most updates of a measurement, so that it stays small.
const UPDATES_MAX: usize = 4096;

impl EfficiencyMeter {
    /// Starts to measure.
    pub fn new(now: Instant, env_steps: u64) -> Self {
        let (waited, effort) = (Duration::ZERO, FleetEffort::default());
        Self { marks: [Mark { at: now, env_steps, waited, learnt: 0, effort, alive_s: 0.0 }].into() }
    }

    /// Records an update that waited for its batch and learnt from `learnt` environment steps; 0 if it was undone.
    /// `env_steps` are those of the run so far, and `effort` is that since the start.
    pub fn mark(
        &mut self,
        now: Instant,
        env_steps: u64,
        waited: Duration,
        learnt: u64,
        effort: FleetEffort,
        alive: usize,
    ) -> Efficiency {
        let last = self.marks.back().copied().expect("there is always a mark");
        let alive_s = last.alive_s + alive as f64 * now.duration_since(last.at).as_secs_f64();
        let (waited, learnt) = (last.waited + waited, last.learnt + learnt);
        let newest = Mark { at: now, env_steps, waited, learnt, effort, alive_s };
        self.marks.push_back(newest);
        let is_old = |mark: &Mark| now.duration_since(mark.at) > WINDOW;
        while self.marks.len() > UPDATES_MAX || self.marks.len() > UPDATES_MIN && self.marks.get(1).is_some_and(is_old)
        {
            self.marks.pop_front();
        }
        let first = self.marks.front().copied().expect("a mark was just added");
        let passed_s = now.duration_since(first.at).as_secs_f64().max(1e-9);
        let simulated = newest.effort.env_steps - first.effort.env_steps;
        let (collect_s, alive_s) = (newest.effort.collect_s - first.effort.collect_s, newest.alive_s - first.alive_s);
        let share = |part: f64, whole: f64| (part / whole).clamp(0.0, 1.0);
        Efficiency {
            env_steps_per_s: (env_steps - first.env_steps) as f64 / passed_s,
            wait_share: share((waited - first.waited).as_secs_f64(), passed_s),
            used_share: (simulated > 0).then(|| share((newest.learnt - first.learnt) as f64, simulated as f64)),
            idle_share: (collect_s > 0.0 && alive_s > 0.0).then(|| 1.0 - share(collect_s, alive_s)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WAITED: Duration = Duration::from_millis(500);

    #[test]
    fn figures_are_those_computed_by_hand() {
        let begun = Instant::now();
        let at = |seconds| begun + Duration::from_secs(seconds);
        let mut meter = EfficiencyMeter::new(begun, 1000);
        let effort = |env_steps, collect_s| FleetEffort { env_steps, collect_s };
        let first = meter.mark(at(10), 1090, WAITED, 90, effort(100, 15.0), 2);
        let shares = |used, idle| (Some(used), Some(idle));
        assert_eq!((first.env_steps_per_s, first.wait_share), (9.0, 0.05));
        assert_eq!((first.used_share, first.idle_share), shares(0.9, 0.25));
        let undone = meter.mark(at(20), 1190, 3 * WAITED, 0, effort(200, 35.0), 3);
        assert_eq!((undone.env_steps_per_s, undone.wait_share), (9.5, 0.1));
        assert_eq!((undone.used_share, undone.idle_share), shares(0.45, 1.0 - 35.0 / 50.0));
    }

    #[test]
    fn only_the_last_updates_count() {
        let begun = Instant::now();
        let mut meter = EfficiencyMeter::new(begun, 0);
        let at = |second| begun + Duration::from_secs(second);
        meter.mark(at(1), 100, 2 * WAITED, 0, FleetEffort { env_steps: 1000, collect_s: 1.0 }, 1);
        let mut newest = Efficiency::default();
        for update in 2..40 {
            let effort = FleetEffort { env_steps: 1000 + 8 * update, collect_s: 0.5 * update as f64 };
            newest = meter.mark(at(update), 100 + 10 * update, WAITED, 8, effort, 1);
        }
        let (used_share, idle_share) = (Some(1.0), Some(0.5));
        assert_eq!(newest, Efficiency { env_steps_per_s: 10.0, wait_share: 0.5, used_share, idle_share });
    }

    #[test]
    fn nothing_is_known_of_senders_that_say_nothing() {
        let begun = Instant::now();
        let mut meter = EfficiencyMeter::new(begun, 0);
        let unknown = meter.mark(begun + Duration::from_secs(1), 0, Duration::ZERO, 0, FleetEffort::default(), 4);
        assert_eq!(unknown, Efficiency::default());
    }
}
