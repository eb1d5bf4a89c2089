//! How long the other actors wait for one that has not delivered yet.

use std::{
    collections::BTreeSet,
    time::{Duration, Instant},
};

/// Waiting never ends sooner than this: fragments of equal size do not arrive at the same instant.
const WAIT_MIN: Duration = Duration::from_millis(50);

/// Rounds in a row that may wait in vain for actors that have never delivered. Without this bound, a client that announces
/// actors under new names would delay every round.
const IN_VAIN_MAX: u32 = 3;
/// Actors that have delivered and are remembered for it.
const KNOWN_MAX: usize = 4096;

/// Decides when a round ends. In a round, each actor that is waited for delivers once.
///
/// With `d` of the actors in after a time `t`, the others may take `t / d` longer: a round with one actor more is worth
/// that much time and no more. An actor that was late is not waited for again until it delivers in two rounds in a row,
/// which it can do only if it is as fast as the others. So a slow actor costs its own share at most.
#[derive(Debug)]
pub(super) struct StragglerPolicy {
    begun: Instant,
    delivered: BTreeSet<String>,
    delivered_before: BTreeSet<String>,
    late: BTreeSet<String>,
    /// Have delivered at some time.
    known: BTreeSet<String>,
    in_vain: u32,
    until: Option<Instant>,
}

impl StragglerPolicy {
    pub(super) fn new(now: Instant) -> Self {
        let none = BTreeSet::new;
        Self {
            begun: now,
            delivered: none(),
            delivered_before: none(),
            late: none(),
            known: none(),
            in_vain: 0,
            until: None,
        }
    }

    /// Actors begin to simulate.
    pub(super) fn begin(&mut self, now: Instant) {
        self.begun = now;
        self.delivered_before = std::mem::take(&mut self.delivered);
        self.until = None;
    }

    /// Notes a fragment.
    pub(super) fn delivered(&mut self, actor: &str, now: Instant) {
        if self.delivered_before.contains(actor) {
            self.late.remove(actor);
        }
        self.delivered.insert(actor.to_string());
        if self.known.len() < KNOWN_MAX && self.known.insert(actor.to_string()) {
            self.in_vain = 0;
        }
        let worth = now.duration_since(self.begun) / self.delivered.len() as u32;
        self.until = Some(now + worth.max(WAIT_MIN));
    }

    /// Whether the round is over: every actor that is waited for has delivered, or is late.
    pub(super) fn is_over(&mut self, alive: &BTreeSet<String>, now: Instant) -> bool {
        let Some(until) = self.until else { return false };
        let count_strangers = self.in_vain < IN_VAIN_MAX;
        let missing = || {
            let is_counted = |actor: &&String| count_strangers || self.known.contains(*actor);
            alive.iter().filter(|actor| !self.delivered.contains(*actor)).filter(is_counted)
        };
        if missing().all(|actor| self.late.contains(actor)) {
            return true;
        }
        if now <= until {
            return false;
        }
        if missing().any(|actor| !self.known.contains(actor)) {
            self.in_vain += 1;
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
    fn a_round_lasts_until_everybody_is_in() {
        let begun = Instant::now();
        let mut policy = StragglerPolicy::new(begun);
        let (both, later) = (names(&["a", "b"]), begun + Duration::from_secs(1));
        assert!(!policy.is_over(&both, later), "nobody has delivered");
        policy.delivered("a", later);
        assert!(!policy.is_over(&both, later));
        policy.delivered("b", later);
        assert!(policy.is_over(&both, later));
        assert!(policy.is_over(&names(&["a"]), later), "the dead are not waited for");
    }

    #[test]
    fn names_that_never_deliver_are_not_waited_for_again_and_again() {
        let (begun, mut waits) = (Instant::now(), 0);
        let mut policy = StragglerPolicy::new(begun);
        for round in 0..20 {
            let start = begun + Duration::from_secs(10 * round);
            let alive = names(&["good", &format!("fake-{round}")]);
            policy.begin(start);
            policy.delivered("good", start + Duration::from_secs(1));
            waits += u32::from(!policy.is_over(&alive, start + Duration::from_secs(1)));
            assert!(policy.is_over(&alive, start + Duration::from_secs(3)));
        }
        assert_eq!(waits, IN_VAIN_MAX);
        // Somebody new who does deliver is waited for like anybody else.
        policy.delivered("new", begun + Duration::from_secs(201));
        let start = begun + Duration::from_secs(210);
        policy.begin(start);
        policy.delivered("good", start + Duration::from_secs(1));
        assert!(!policy.is_over(&names(&["good", "new"]), start + Duration::from_secs(1)));
    }

    #[test]
    fn waiting_is_worth_one_share() {
        let begun = Instant::now();
        let at = |tenths: u64| begun + Duration::from_millis(100 * tenths);
        let all = names(&["a", "b", "c", "slow"]);
        let mut policy = StragglerPolicy::new(begun);
        for actor in ["a", "b", "c"] {
            policy.delivered(actor, at(9));
        }
        assert!(!policy.is_over(&all, at(12)), "a third of 0.9 s");
        assert!(policy.is_over(&all, at(13)));
        // Late once: in the next round it is not waited for.
        policy.begin(at(13));
        for actor in ["a", "b", "c"] {
            policy.delivered(actor, at(22));
        }
        assert!(policy.is_over(&all, at(22)));
        // What it delivers now was begun long ago; only in the round after that can it be as fast as the others.
        for (start, is_waited_for) in [(22, false), (31, false), (40, true)] {
            policy.begin(at(start));
            for actor in ["a", "b", "c"] {
                policy.delivered(actor, at(start + 9));
            }
            assert_eq!(policy.is_over(&all, at(start + 9)), !is_waited_for, "{start}");
            policy.delivered("slow", at(start + 9));
        }
    }
}
