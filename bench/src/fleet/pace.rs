//! Time that the simulation of a played actor takes.

use std::time::{Duration, Instant};

/// Simulation clock of one played actor. It runs in ideal time: a timer that fires late delays no later simulation.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    /// End of the newest simulation.
    free_at: Instant,
}

impl Pace {
    /// Returns the clock of an actor that can simulate from `now` on.
    pub fn new(now: Instant) -> Self {
        Self { free_at: now }
    }

    /// Returns when the next simulation begins: the previous one is finished then, and the credit is there.
    pub fn begin(&self, credit_at: Instant) -> Instant {
        self.free_at.max(credit_at)
    }

    /// Returns when a simulation is finished that began at `begun`. `rate` is in environment steps per second; infinity
    /// takes no time.
    pub fn finish(&mut self, begun: Instant, env_steps: u64, rate: f64) -> Instant {
        self.free_at = begun + duration(env_steps, rate);
        self.free_at
    }
}

/// Returns the time that `env_steps` take.
pub fn duration(env_steps: u64, rate: f64) -> Duration {
    Duration::from_secs_f64(env_steps as f64 / rate)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn a_simulation_begins_after_the_previous_one_and_after_its_credit() {
        let start = Instant::now();
        let at = |ms| start + Duration::from_millis(ms);
        let mut pace = Pace::new(start);
        // 128 steps of 10 environments at 1280 steps/s take one second.
        assert_eq!(pace.finish(pace.begin(start), 1280, 1280.0), at(1000));
        assert_eq!(pace.begin(at(300)), at(1000), "the credit came during the simulation");
        assert_eq!(pace.finish(at(1000), 1280, 1280.0), at(2000));
        assert_eq!(pace.begin(at(2500)), at(2500), "the actor waits for its credit");
        assert_eq!(pace.finish(at(2500), 1280, f64::INFINITY), at(2500));
    }

    proptest! {
        #[test]
        fn no_actor_has_more_steps_than_its_rate_allows(
            credits in prop::collection::vec((0u64..2000, 1u64..5000), 1..40),
            rate in 1.0f64..1e6,
        ) {
            let start = Instant::now();
            let (mut pace, mut credit_at, mut env_steps) = (Pace::new(start), start, 0);
            for (pause_ms, steps) in credits {
                credit_at += Duration::from_millis(pause_ms);
                let begun = pace.begin(credit_at);
                prop_assert!(begun >= credit_at);
                let ready = pace.finish(begun, steps, rate);
                env_steps += steps;
                // A nanosecond for the rounding of each duration.
                let possible = ready.duration_since(start).as_secs_f64() * rate + 40e-9 * rate + 1e-3;
                prop_assert!(env_steps as f64 <= possible, "{env_steps} steps, but {possible} were possible");
            }
        }
    }
}
