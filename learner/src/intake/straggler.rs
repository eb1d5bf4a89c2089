//! Limits how long the other actors wait for one that has not delivered yet.

use std::{
    collections::BTreeSet,
    time::{Duration, Instant},
};

/// Shortest wait: fragments of equal size do not arrive at the same instant.
const WAIT_MIN: Duration = Duration::from_millis(50);

/// Rounds in a row that may wait for actors that never deliver. Without this bound, a client that announces actors
/// under new names would delay every round.
const FUTILE_WAITS_MAX: u32 = 3;
/// Most names of actors that have delivered.
const KNOWN_MAX: usize = 4096;

/// Decides when a round ends. In a round, each awaited actor delivers once.
///
/// If `d` actors have delivered after a time `t`, the others may take `t / d` longer: one more actor in the round is
/// worth that much time. A late actor is not awaited again until it delivers in two rounds in a row, which it can do
/// only if it is as fast as the others. So a slow actor costs at most its own share.
#[derive(Debug)]
pub(super) struct StragglerPolicy {
    begun: Instant,
    delivered: BTreeSet<String>,
    delivered_before: BTreeSet<String>,
    late: BTreeSet<String>,
    /// Actors that have ever delivered.
    known: BTreeSet<String>,
    futile_waits: u32,
    deadline: Option<Instant>,
}

impl StragglerPolicy {
    pub(super) fn new(now: Instant) -> Self {
        Self {
            begun: now,
            delivered: BTreeSet::new(),
            delivered_before: BTreeSet::new(),
            late: BTreeSet::new(),
            known: BTreeSet::new(),
            futile_waits: 0,
            deadline: None,
        }
    }

    /// Begins a round: the actors simulate.
    pub(super) fn begin_round(&mut self, now: Instant) {
        self.begun = now;
        self.delivered_before = std::mem::take(&mut self.delivered);
        self.deadline = None;
    }

    /// Records a fragment of `actor`.
    pub(super) fn record_delivery(&mut self, actor: &str, now: Instant) {
        if self.delivered_before.contains(actor) {
            self.late.remove(actor);
        }
        self.delivered.insert(actor.to_string());
        if self.known.len() < KNOWN_MAX && self.known.insert(actor.to_string()) {
            self.futile_waits = 0;
        }
        let share = now.duration_since(self.begun) / self.delivered.len() as u32;
        self.deadline = Some(now + share.max(WAIT_MIN));
    }

    /// Whether the round is over: every awaited actor has delivered or is late.
    pub(super) fn is_round_over(&mut self, alive: &BTreeSet<String>, now: Instant) -> bool {
        let Some(deadline) = self.deadline else { return false };
        let await_unknown = self.futile_waits < FUTILE_WAITS_MAX;
        let missing = || {
            let is_awaited = |actor: &&String| await_unknown || self.known.contains(*actor);
            alive.iter().filter(|actor| !self.delivered.contains(*actor)).filter(is_awaited)
        };
        if missing().all(|actor| self.late.contains(actor)) {
            return true;
        }
        if now <= deadline {
            return false;
        }
        if missing().any(|actor| !self.known.contains(actor)) {
            self.futile_waits += 1;
        }
        self.late = missing().cloned().collect();
        if self.known.len() == KNOWN_MAX {
            self.known.retain(|actor| alive.contains(actor));
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(names: &[&str]) -> BTreeSet<String> {
        names.iter().map(|name| (*name).to_string()).collect()
    }

    #[test]
    fn a_round_lasts_until_every_actor_has_delivered() {
        let begun = Instant::now();
        let mut policy = StragglerPolicy::new(begun);
        let (both, later) = (names(&["a", "b"]), begun + Duration::from_secs(1));
        assert!(!policy.is_round_over(&both, later), "no actor has delivered");
        policy.record_delivery("a", later);
        assert!(!policy.is_round_over(&both, later));
        policy.record_delivery("b", later);
        assert!(policy.is_round_over(&both, later));
        assert!(policy.is_round_over(&names(&["a"]), later), "an actor that has left is not awaited");
    }

    #[test]
    fn names_that_never_deliver_are_awaited_a_limited_number_of_times() {
        let (begun, mut waits) = (Instant::now(), 0);
        let mut policy = StragglerPolicy::new(begun);
        for round in 0..20 {
            let start = begun + Duration::from_secs(10 * round);
            let alive = names(&["good", &format!("fake-{round}")]);
            policy.begin_round(start);
            policy.record_delivery("good", start + Duration::from_secs(1));
            waits += u32::from(!policy.is_round_over(&alive, start + Duration::from_secs(1)));
            assert!(policy.is_round_over(&alive, start + Duration::from_secs(3)));
        }
        assert_eq!(waits, FUTILE_WAITS_MAX);
        // A new actor that delivers is awaited like the others.
        policy.record_delivery("new", begun + Duration::from_secs(201));
        let start = begun + Duration::from_secs(210);
        policy.begin_round(start);
        policy.record_delivery("good", start + Duration::from_secs(1));
        assert!(!policy.is_round_over(&names(&["good", "new"]), start + Duration::from_secs(1)));
    }

    #[test]
    fn the_wait_is_limited_to_one_share() {
        let begun = Instant::now();
        let at = |tenths: u64| begun + Duration::from_millis(100 * tenths);
        let all = names(&["a", "b", "c", "slow"]);
        let mut policy = StragglerPolicy::new(begun);
        for actor in ["a", "b", "c"] {
            policy.record_delivery(actor, at(9));
        }
        assert!(!policy.is_round_over(&all, at(12)), "a third of 0.9 s");
        assert!(policy.is_round_over(&all, at(13)));
        // After being late once, it is not awaited in the next round.
        policy.begin_round(at(13));
        for actor in ["a", "b", "c"] {
            policy.record_delivery(actor, at(22));
        }
        assert!(policy.is_round_over(&all, at(22)));
        // Its next delivery was begun in an earlier round, so only the one after that shows whether it is fast enough.
        for (start, is_awaited) in [(22, false), (31, false), (40, true)] {
            policy.begin_round(at(start));
            for actor in ["a", "b", "c"] {
                policy.record_delivery(actor, at(start + 9));
            }
            assert_eq!(policy.is_round_over(&all, at(start + 9)), !is_awaited, "{start}");
            policy.record_delivery("slow", at(start + 9));
        }
    }
}
