//! Which fragments were dealt with, so that sending one twice is harmless and none is forgotten.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

/// Actor processes that are remembered; the one that was silent longest gives way.
const ACTORS_MAX: usize = 4096;
/// Sequence numbers beyond a gap that are remembered for each process; a wider gap is given up, since the sender keeps
/// fewer fragments than that.
const AHEAD_MAX: usize = 65_536;

impl Watermark {
    fn close_gap(&mut self) {
        while self.ahead.remove(&(self.through + 1)) {
            self.through += 1;
        }
    }
}

/// Watermarks of every actor process.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Ledger {
    /// Keyed by actor and incarnation.
    processes: BTreeMap<(String, u64), Watermark>,
    clock: u64,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Watermark {
    /// Every number up to this one was dealt with.
    through: u64,
    /// Numbers beyond a gap that were dealt with.
    ahead: BTreeSet<u64>,
    /// What `through` was when the last checkpoint was written.
    durable_through: u64,
    last_seen: u64,
}

impl Ledger {
    /// Whether this fragment was dealt with before.
    pub fn contains(&self, actor: &str, incarnation: u64, sequence: u64) -> bool {
        self.processes
            .get(&(actor.to_string(), incarnation))
            .is_some_and(|mark| sequence <= mark.through || mark.ahead.contains(&sequence))
    }

    /// Notes that a fragment was dealt with: taken, or dropped by rule.
    pub fn insert(&mut self, actor: &str, incarnation: u64, sequence: u64) {
        self.clock += 1;
        let mark = self.processes.entry((actor.to_string(), incarnation)).or_default();
        mark.last_seen = self.clock;
        if sequence > mark.through {
            mark.ahead.insert(sequence);
        }
        if mark.ahead.len() > AHEAD_MAX {
            mark.through = mark.ahead.first().map_or(mark.through, |first| first - 1);
        }
        mark.close_gap();
        self.forget_the_oldest();
    }

    fn forget_the_oldest(&mut self) {
        if self.processes.len() > ACTORS_MAX {
            let oldest = self.processes.iter().min_by_key(|(_, mark)| mark.last_seen).map(|(key, _)| key.clone());
            oldest.map(|key| self.processes.remove(&key));
        }
    }

    /// Notes that the sender will not send anything up to this number again. Without this, a number that this ledger
    /// never saw, because it was dropped by rule by a learner that is gone, would hold the watermark back for ever.
    pub fn settle(&mut self, actor: &str, incarnation: u64, through: u64) {
        self.clock += 1;
        let mark = self.processes.entry((actor.to_string(), incarnation)).or_default();
        mark.last_seen = self.clock;
        mark.through = mark.through.max(through);
        mark.ahead = mark.ahead.split_off(&(mark.through + 1));
        mark.close_gap();
        self.forget_the_oldest();
    }

    /// Called on the copy that goes into a checkpoint, and on the ledger itself once that checkpoint is written.
    pub fn mark_durable(&mut self) {
        self.processes.values_mut().for_each(|mark| mark.durable_through = mark.through);
    }

    /// The highest number up to which everything of this process is part of a checkpoint.
    pub fn durable_through(&self, actor: &str, incarnation: u64) -> u64 {
        self.processes.get(&(actor.to_string(), incarnation)).map_or(0, |mark| mark.durable_through)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_gap_holds_the_watermark_back() {
        let mut ledger = Ledger::default();
        ledger.insert("a", 1, 1);
        ledger.insert("a", 1, 3);
        ledger.mark_durable();
        assert_eq!(ledger.durable_through("a", 1), 1);
        assert!(ledger.contains("a", 1, 3) && !ledger.contains("a", 1, 2));
        ledger.insert("a", 1, 2);
        assert_eq!(ledger.durable_through("a", 1), 1, "not before the next checkpoint");
        ledger.mark_durable();
        assert_eq!(ledger.durable_through("a", 1), 3);
    }

    #[test]
    fn what_the_sender_settled_closes_a_gap() {
        let mut ledger = Ledger::default();
        ledger.insert("a", 1, 5);
        ledger.insert("a", 1, 7);
        ledger.settle("a", 1, 4);
        ledger.mark_durable();
        assert_eq!(ledger.durable_through("a", 1), 5);
        ledger.settle("a", 1, 2);
        assert!(ledger.contains("a", 1, 4) && !ledger.contains("a", 1, 6) && ledger.contains("a", 1, 7));
    }

    #[test]
    fn another_incarnation_is_another_sender() {
        let mut ledger = Ledger::default();
        ledger.insert("a", 1, 1);
        assert!(!ledger.contains("a", 2, 1));
    }

    #[test]
    fn memory_is_bounded() {
        let mut ledger = Ledger::default();
        (0..ACTORS_MAX as u64 + 50).for_each(|incarnation| ledger.insert("a", incarnation, 1));
        assert_eq!(ledger.processes.len(), ACTORS_MAX);
        assert!(!ledger.contains("a", 0, 1), "the oldest gave way");
        (0..AHEAD_MAX as u64 + 50).for_each(|i| ledger.insert("b", 1, 2 + 2 * i));
        assert!(ledger.processes[&("b".to_string(), 1)].ahead.len() <= AHEAD_MAX);
    }

    proptest! {
        #[test]
        fn whatever_the_order_exactly_what_was_put_in_is_contained(numbers in prop::collection::vec(1u64..40, 0..80)) {
            let mut ledger = Ledger::default();
            numbers.iter().for_each(|number| ledger.insert("a", 1, *number));
            for number in 1..40 {
                prop_assert_eq!(ledger.contains("a", 1, number), numbers.contains(&number));
            }
        }
    }
}
