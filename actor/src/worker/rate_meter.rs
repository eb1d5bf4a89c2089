//! Speed of an actor in its statistics.

use std::{
    collections::VecDeque,
    time::{Duration, Instant},
};

/// Time over which the speed in the statistics is measured, as the learner measures its own.
const RATE_WINDOW: Duration = Duration::from_secs(10);

/// Measures environment steps per second between two updates.
pub(super) struct RateMeter {
    /// Times and environment steps of the last statistics.
    marks: VecDeque<(Instant, u64)>,
}

impl RateMeter {
    /// Begins without any step.
    pub(super) fn start() -> Self {
        Self { marks: [(Instant::now(), 0)].into() }
    }

    /// Takes the steps so far, and returns the speed.
    pub(super) fn update(&mut self, env_steps: u64) -> f64 {
        let now = Instant::now();
        self.marks.push_back((now, env_steps));
        while self.marks.get(1).is_some_and(|(at, _)| now.duration_since(*at) > RATE_WINDOW) {
            self.marks.pop_front();
        }
        let (since, before) = self.marks[0];
        (env_steps - before) as f64 / now.duration_since(since).as_secs_f64().max(1e-9)
    }
}
