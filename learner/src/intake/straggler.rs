//! Limits how long the other actors wait for one that has not delivered yet.

use std::{
    collections::{BTreeSet, HashSet},
    time::{Duration, Instant},
};

/// Shortest wait: fragments of equal size do not arrive at the same instant.
const WAIT_MIN: Duration = Duration::from_millis(50);
/// The others always wait for this part of the time that the round has taken.
const WAIT_DIVISOR: u32 = 4;

/// Rounds in a row that may wait for actors that never deliver. Without this bound, a client that announces actors
/// under new names would delay every round.
const FUTILE_WAITS_MAX: u32 = 3;
/// Most names of actors that have delivered.
const KNOWN_MAX: usize = 4096;

/// Decides when a round ends. In a round, each awaited actor delivers once.
///
/// If `d` actors have delivered after a time `t`, the others may take `t / d` longer: one more actor in the round is
/// worth that much time. They may always take `t / 4`, because what a late actor has simulated is lost. A late actor is
/// not awaited again until it delivers in two rounds in a row, which it can do only if it is as fast as the others, or
/// until its fragments are made shorter. So a slow actor costs at most its own share.
///
/// A delivery takes constant time, whatever the number of actors; a new round or a change of membership takes linear time.
#[derive(Debug)]
pub(super) struct StragglerPolicy {
    begun: Instant,
    alive: BTreeSet<String>,
    delivered: HashSet<String>,
    delivered_before: HashSet<String>,
    late: HashSet<String>,
    /// Actors that have ever delivered.
    known: HashSet<String>,
    futile_waits: u32,
    deadline: Option<Instant>,
    /// Number of awaited actors that have not delivered.
    missing: usize,
}

impl StragglerPolicy {
    pub(super) fn new(now: Instant) -> Self {
        Self {
            begun: now,
            alive: BTreeSet::new(),
            delivered: HashSet::new(),
            delivered_before: HashSet::new(),
            late: HashSet::new(),
            known: HashSet::new(),
            futile_waits: 0,
            deadline: None,
            missing: 0,
        }
    }

    /// Replaces the set of live actors.
    pub(super) fn set_alive(&mut self, alive: BTreeSet<String>) {
        if self.known.len() == KNOWN_MAX {
            self.known.retain(|actor| alive.contains(actor));
        }
        self.alive = alive;
        self.count_missing();
    }

    /// Returns the live actors.
    pub(super) fn alive(&self) -> &BTreeSet<String> {
        &self.alive
    }

    /// Begins a round: the actors simulate.
    pub(super) fn begin_round(&mut self, now: Instant) {
        self.begun = now;
        self.delivered_before = std::mem::take(&mut self.delivered);
        self.deadline = None;
        self.count_missing();
    }

    /// Awaits an actor again although it was late.
    pub(super) fn forgive(&mut self, actor: &str) {
        if self.late.remove(actor) {
            self.missing += usize::from(self.is_missing(actor));
        }
    }

    /// Records a fragment of `actor`.
    pub(super) fn record_delivery(&mut self, actor: &str, now: Instant) {
        let was_missing = self.is_missing(actor);
        if self.delivered_before.contains(actor) {
            self.late.remove(actor);
        }
        if !self.delivered.contains(actor) {
            self.delivered.insert(actor.to_string());
        }
        self.missing -= usize::from(was_missing);
        if self.known.len() < KNOWN_MAX && !self.known.contains(actor) {
            self.known.insert(actor.to_string());
            if std::mem::take(&mut self.futile_waits) > 0 {
                self.count_missing();
            }
        }
        // A sender that was not awaited must not hold the round open.
        if was_missing || self.deadline.is_none() {
            let passed = now.duration_since(self.begun);
            let share = passed / self.delivered.len() as u32;
            self.deadline = Some(now + share.max(passed / WAIT_DIVISOR).max(WAIT_MIN));
        }
    }

    /// Whether the round is over: every awaited actor has delivered or is late.
    pub(super) fn is_round_over(&mut self, now: Instant) -> bool {
        let Some(deadline) = self.deadline else { return false };
        if self.missing == 0 {
            return true;
        }
        if now <= deadline {
            return false;
        }
        let missing: Vec<&String> = self.alive.iter().filter(|actor| self.is_missing(actor)).collect();
        if missing.iter().any(|actor| !self.known.contains(*actor)) {
            self.futile_waits += 1;
        }
        let still_late = self.late.iter().filter(|actor| self.is_undelivered(actor));
        self.late = missing.into_iter().chain(still_late).cloned().collect();
        self.missing = 0;
        true
    }

    fn is_undelivered(&self, actor: &str) -> bool {
        self.alive.contains(actor) && !self.delivered.contains(actor)
    }

    fn is_missing(&self, actor: &str) -> bool {
        let is_awaited = self.futile_waits < FUTILE_WAITS_MAX || self.known.contains(actor);
        is_awaited && self.is_undelivered(actor) && !self.late.contains(actor)
    }

    fn count_missing(&mut self) {
        self.missing = self.alive.iter().filter(|actor| self.is_missing(actor)).count();
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn names(names: &[&str]) -> BTreeSet<String> {
        names.iter().map(|name| (*name).to_string()).collect()
    }

    #[test]
    fn a_round_lasts_until_every_actor_has_delivered() {
        let begun = Instant::now();
        let mut policy = StragglerPolicy::new(begun);
        let later = begun + Duration::from_secs(1);
        policy.set_alive(names(&["a", "b"]));
        assert!(!policy.is_round_over(later), "no actor has delivered");
        policy.record_delivery("a", later);
        assert!(!policy.is_round_over(later));
        policy.record_delivery("b", later);
        assert!(policy.is_round_over(later));
        policy.begin_round(begun);
        policy.record_delivery("a", later);
        assert!(!policy.is_round_over(later));
        policy.set_alive(names(&["a"]));
        assert!(policy.is_round_over(later), "an actor that has left is not awaited");
    }

    #[test]
    fn names_that_never_deliver_are_awaited_a_limited_number_of_times() {
        let (begun, mut waits) = (Instant::now(), 0);
        let mut policy = StragglerPolicy::new(begun);
        for round in 0..20 {
            let start = begun + Duration::from_secs(10 * round);
            policy.set_alive(names(&["good", &format!("fake-{round}")]));
            policy.begin_round(start);
            policy.record_delivery("good", start + Duration::from_secs(1));
            waits += u32::from(!policy.is_round_over(start + Duration::from_secs(1)));
            assert!(policy.is_round_over(start + Duration::from_secs(3)));
        }
        assert_eq!(waits, FUTILE_WAITS_MAX);
        // A new actor that delivers is awaited like the others.
        policy.record_delivery("new", begun + Duration::from_secs(201));
        let start = begun + Duration::from_secs(210);
        policy.set_alive(names(&["good", "new"]));
        policy.begin_round(start);
        policy.record_delivery("good", start + Duration::from_secs(1));
        assert!(!policy.is_round_over(start + Duration::from_secs(1)));
    }

    #[test]
    fn the_wait_is_limited_to_one_share() {
        let begun = Instant::now();
        let at = |tenths: u64| begun + Duration::from_millis(100 * tenths);
        let mut policy = StragglerPolicy::new(begun);
        policy.set_alive(names(&["a", "b", "c", "slow"]));
        for actor in ["a", "b", "c"] {
            policy.record_delivery(actor, at(9));
        }
        assert!(!policy.is_round_over(at(12)), "a third of 0.9 s");
        assert!(policy.is_round_over(at(13)));
        // After being late once, it is not awaited in the next round.
        policy.begin_round(at(13));
        for actor in ["a", "b", "c"] {
            policy.record_delivery(actor, at(22));
        }
        assert!(policy.is_round_over(at(22)));
        // Its next delivery was begun in an earlier round, so only the one after that shows whether it is fast enough.
        for (start, is_awaited) in [(22, false), (31, false), (40, true)] {
            policy.begin_round(at(start));
            for actor in ["a", "b", "c"] {
                policy.record_delivery(actor, at(start + 9));
            }
            assert_eq!(policy.is_round_over(at(start + 9)), !is_awaited, "{start}");
            policy.record_delivery("slow", at(start + 9));
        }
    }

    #[test]
    fn senders_that_are_not_awaited_do_not_prolong_a_round() {
        let begun = Instant::now();
        let at = |tenths: u64| begun + Duration::from_millis(100 * tenths);
        let mut policy = StragglerPolicy::new(begun);
        policy.set_alive(names(&["a", "ghost"]));
        policy.record_delivery("a", at(9));
        for tenths in 10..18 {
            policy.record_delivery("a", at(tenths));
            policy.record_delivery(&format!("without token {tenths}"), at(tenths));
        }
        assert!(!policy.is_round_over(at(18)) && policy.is_round_over(at(19)));
    }

    #[test]
    fn a_late_actor_with_shorter_fragments_is_awaited_again() {
        let begun = Instant::now();
        let at = |tenths: u64| begun + Duration::from_millis(100 * tenths);
        let mut policy = StragglerPolicy::new(begun);
        policy.set_alive(names(&["a", "slow"]));
        policy.record_delivery("a", at(9));
        assert!(policy.is_round_over(at(19)));
        policy.begin_round(at(19));
        policy.forgive("slow");
        policy.forgive("a");
        policy.record_delivery("a", at(28));
        assert!(!policy.is_round_over(at(28)));
        policy.record_delivery("slow", at(29));
        assert!(policy.is_round_over(at(29)));
    }

    proptest! {
        #[test]
        fn the_count_of_missing_actors_is_that_of_a_fresh_count(
            events in prop::collection::vec((0_u8..6, 0_usize..6, 0_u64..400), 1..120),
        ) {
            let mut now = Instant::now();
            let mut policy = StragglerPolicy::new(now);
            let mut alive = BTreeSet::new();
            for (kind, actor, passed_ms) in events {
                now += Duration::from_millis(passed_ms);
                let name = format!("a{actor}");
                match kind {
                    0 => drop(alive.insert(name)),
                    1 => drop(alive.remove(&name)),
                    2 => policy.begin_round(now),
                    3 => policy.forgive(&name),
                    _ => policy.record_delivery(&name, now),
                }
                if kind < 2 {
                    policy.set_alive(alive.clone());
                }
                policy.is_round_over(now);
                let counted = policy.missing;
                policy.count_missing();
                prop_assert_eq!(counted, policy.missing);
            }
        }
    }
}
