//! Ledger of handled fragments: a fragment that is sent twice is learnt from once, and none is lost.

use std::collections::{BTreeMap, BTreeSet, btree_map::Entry};

use serde::{Deserialize, Serialize};

/// Actor processes that are kept. Beyond this, the one that was silent longest is removed, and first those without accepted
/// fragments. So a sender of many fragments that are dropped pushes no other out.
const ACTORS_MAX: usize = 4096;
/// Sequence numbers beyond a gap that are kept for each process. A wider gap is skipped, because a sender keeps fewer
/// fragments: the pending ones and those of a batch.
const AHEAD_MAX: usize = 65_536;
/// Sum of these numbers over all processes, because every checkpoint holds them; beyond this, the widest gap is skipped.
const AHEAD_TOTAL_MAX: usize = 4 * AHEAD_MAX;
/// Kept numbers of one process between two checks of that sum.
const COUNT_EVERY: usize = 64;

/// Rules by which a well-formed fragment is dropped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum DropRule {
    /// Its policy is older than allowed.
    TooOld,
    /// Its policy is not an ancestor of the newest.
    Vanished,
}

/// Outcome of a handled fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LedgerEntry {
    /// Accepted.
    Accepted,
    /// Dropped.
    Dropped(DropRule),
}

/// What the ledger knows of a received fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KnownFragment {
    /// Whether it is the first of its process.
    pub is_new_process: bool,
    /// Number up to which a checkpoint holds every outcome of the process.
    pub durable_through: u64,
    /// Outcome, if the fragment was handled before.
    pub entry: Option<LedgerEntry>,
}

/// Outcomes of the fragments of one or more actor processes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Account {
    /// Accepted.
    pub accepted: u64,
    /// Dropped by rule: policy too old.
    pub too_old: u64,
    /// Dropped by rule: policy unknown after a resume.
    pub vanished: u64,
    /// Numbers that the sender settled and this learner never handled: refused, or dropped by rule by a learner that
    /// died before it saved that.
    pub unseen: u64,
    /// Environment steps of accepted fragments.
    pub env_steps: u64,
    /// Environment steps of dropped fragments.
    pub env_steps_dropped: u64,
}

impl Account {
    fn count(&mut self, entry: LedgerEntry, env_steps: u64) {
        let (count, steps) = match entry {
            LedgerEntry::Accepted => (&mut self.accepted, &mut self.env_steps),
            LedgerEntry::Dropped(DropRule::TooOld) => (&mut self.too_old, &mut self.env_steps_dropped),
            LedgerEntry::Dropped(DropRule::Vanished) => (&mut self.vanished, &mut self.env_steps_dropped),
        };
        *count += 1;
        *steps += env_steps;
    }

    fn add(&mut self, other: &Self) {
        self.accepted += other.accepted;
        self.too_old += other.too_old;
        self.vanished += other.vanished;
        self.unseen = self.unseen.saturating_add(other.unseen);
        self.env_steps += other.env_steps;
        self.env_steps_dropped += other.env_steps_dropped;
    }
}

/// One actor process in the ledger.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ActorProcess {
    /// Name of the actor.
    pub actor: String,
    /// Incarnation of the process.
    pub incarnation: u64,
    /// Every number up to this one was handled.
    pub through: u64,
    /// Highest number that was received.
    pub newest: u64,
    /// Numbers below `newest` that were not received. Those of a process that has ended are lost.
    pub missing: u64,
    /// Outcomes of the handled fragments.
    pub account: Account,
}

/// Handled fragments of every actor process.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Ledger {
    /// Keyed by actor and incarnation.
    processes: BTreeMap<(String, u64), Watermark>,
    /// Accounts of removed processes.
    forgotten: Account,
    clock: u64,
}

#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Watermark {
    /// Every number up to this one was handled.
    through: u64,
    /// Numbers beyond a gap that were handled.
    ahead: BTreeSet<u64>,
    /// Numbers that were dropped by rule and may be sent again.
    dropped: BTreeMap<u64, DropRule>,
    /// `through` at the last checkpoint.
    durable_through: u64,
    last_seen: u64,
    account: Account,
}

impl Watermark {
    /// Returns the outcome of a fragment that was handled before.
    fn entry(&self, sequence: u64) -> Option<LedgerEntry> {
        let was_dropped = self.dropped.get(&sequence).map(|rule| LedgerEntry::Dropped(*rule));
        let is_known = sequence <= self.through || self.ahead.contains(&sequence);
        was_dropped.or(is_known.then_some(LedgerEntry::Accepted))
    }

    fn close_gap(&mut self) {
        while let Some(next) = self.through.checked_add(1)
            && self.ahead.remove(&next)
        {
            self.through = next;
        }
    }

    /// Skips every number up to `through` that is still missing.
    fn skip_to(&mut self, through: u64) {
        if through <= self.through {
            return;
        }
        let beyond = self.ahead.split_off(&through.saturating_add(1));
        let missing = (through - self.through).saturating_sub(self.ahead.len() as u64);
        self.account.unseen = self.account.unseen.saturating_add(missing);
        self.ahead = beyond;
        self.through = through;
        self.close_gap();
    }
}

impl Ledger {
    /// Settles what the sender of a fragment will not send again, and returns what is known of the fragment.
    pub fn look_up(&mut self, actor: &str, incarnation: u64, sequence: u64, settled_through: u64) -> KnownFragment {
        let (mark, is_new_process) = self.settle(actor, incarnation, settled_through);
        let known =
            KnownFragment { is_new_process, durable_through: mark.durable_through, entry: mark.entry(sequence) };
        self.remove_oldest();
        known
    }

    /// Records the outcome of a fragment of `env_steps` environment steps.
    pub fn insert(&mut self, actor: &str, incarnation: u64, sequence: u64, entry: LedgerEntry, env_steps: u64) {
        self.clock += 1;
        let mark = self.processes.entry((actor.to_string(), incarnation)).or_default();
        mark.last_seen = self.clock;
        mark.account.count(entry, env_steps);
        if sequence > mark.through {
            mark.ahead.insert(sequence);
        }
        if let LedgerEntry::Dropped(rule) = entry {
            mark.dropped.insert(sequence, rule);
        }
        mark.close_gap();
        if mark.ahead.len() > AHEAD_MAX
            && let Some(first) = mark.ahead.first().copied()
        {
            mark.skip_to(first);
        }
        if mark.dropped.len() > AHEAD_MAX {
            mark.dropped.pop_first();
        }
        let kept = mark.ahead.len() + mark.dropped.len();
        self.remove_oldest();
        // Counting visits every process, and most fragments leave no gap.
        if kept > 0 && kept.is_multiple_of(COUNT_EVERY) {
            self.skip_widest_gap();
        }
    }

    /// Skips the widest gap if too many numbers are kept in all.
    fn skip_widest_gap(&mut self) {
        let kept = |mark: &Watermark| mark.ahead.len() + mark.dropped.len();
        let total: usize = self.processes.values().map(kept).sum();
        if total > AHEAD_TOTAL_MAX
            && let Some(widest) = self.processes.values_mut().max_by_key(|mark| kept(mark))
        {
            let last = widest.ahead.last().copied().unwrap_or(widest.through);
            widest.skip_to(last);
            widest.dropped.clear();
        }
    }

    /// Removes a process other than the present one if there are too many.
    fn remove_oldest(&mut self) {
        if self.processes.len() > ACTORS_MAX {
            let others = self.processes.iter().filter(|(_, mark)| mark.last_seen != self.clock);
            let oldest = others.min_by_key(|(_, mark)| (mark.account.accepted > 0, mark.last_seen));
            let oldest = oldest.map(|(key, _)| key.clone());
            if let Some(mark) = oldest.and_then(|key| self.processes.remove(&key)) {
                self.forgotten.add(&mark.account);
            }
        }
    }

    /// Records that the sender will not send any number up to `through` again. Otherwise a number that an earlier
    /// learner dropped by rule, and that this ledger never saw, would stop the watermark for good. Returns whether the
    /// process is new, too.
    fn settle(&mut self, actor: &str, incarnation: u64, through: u64) -> (&mut Watermark, bool) {
        self.clock += 1;
        let entry = self.processes.entry((actor.to_string(), incarnation));
        let is_new = matches!(entry, Entry::Vacant(_));
        let mark = entry.or_default();
        mark.last_seen = self.clock;
        mark.skip_to(through);
        mark.dropped.retain(|sequence, _| *sequence > through);
        (mark, is_new)
    }

    /// Marks every handled number as durable: in the copy for a checkpoint, and in the ledger once that is written.
    pub fn mark_durable(&mut self) {
        self.processes.values_mut().for_each(|mark| mark.durable_through = mark.through);
    }

    /// Returns the number up to which a checkpoint holds every outcome of this process.
    pub fn durable_through(&self, actor: &str, incarnation: u64) -> u64 {
        self.processes.get(&(actor.to_string(), incarnation)).map_or(0, |mark| mark.durable_through)
    }

    /// Sum of all accounts of this run.
    pub fn total(&self) -> Account {
        let mut total = self.forgotten;
        self.processes.values().for_each(|mark| total.add(&mark.account));
        total
    }

    /// Iterates over the processes in the ledger.
    pub fn processes(&self) -> impl Iterator<Item = ActorProcess> {
        self.processes.iter().map(|((actor, incarnation), mark)| {
            let newest = mark.ahead.last().copied().unwrap_or(mark.through);
            ActorProcess {
                actor: actor.clone(),
                incarnation: *incarnation,
                through: mark.through,
                newest,
                missing: (newest - mark.through).saturating_sub(mark.ahead.len() as u64),
                account: mark.account,
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    impl Ledger {
        fn accept(&mut self, actor: &str, incarnation: u64, sequence: u64) {
            self.insert(actor, incarnation, sequence, LedgerEntry::Accepted, 8);
        }

        fn entry(&self, actor: &str, incarnation: u64, sequence: u64) -> Option<LedgerEntry> {
            self.processes.get(&(actor.to_string(), incarnation))?.entry(sequence)
        }

        fn contains(&self, actor: &str, incarnation: u64, sequence: u64) -> bool {
            self.entry(actor, incarnation, sequence).is_some()
        }
    }

    #[test]
    fn a_gap_holds_the_watermark_back() {
        let mut ledger = Ledger::default();
        ledger.accept("a", 1, 1);
        ledger.accept("a", 1, 3);
        ledger.mark_durable();
        assert_eq!(ledger.durable_through("a", 1), 1);
        assert!(ledger.contains("a", 1, 3) && !ledger.contains("a", 1, 2));
        ledger.accept("a", 1, 2);
        assert_eq!(ledger.durable_through("a", 1), 1, "not before the next checkpoint");
        ledger.mark_durable();
        assert_eq!(ledger.durable_through("a", 1), 3);
    }

    #[test]
    fn settled_numbers_close_a_gap() {
        let mut ledger = Ledger::default();
        ledger.accept("a", 1, 5);
        ledger.accept("a", 1, 7);
        ledger.settle("a", 1, 4);
        ledger.mark_durable();
        assert_eq!(ledger.durable_through("a", 1), 5);
        ledger.settle("a", 1, 2);
        assert!(ledger.contains("a", 1, 4) && !ledger.contains("a", 1, 6) && ledger.contains("a", 1, 7));
    }

    #[test]
    fn a_drop_is_kept_until_the_sender_settles_it() {
        let mut ledger = Ledger::default();
        ledger.accept("a", 1, 1);
        ledger.insert("a", 1, 2, LedgerEntry::Dropped(DropRule::Vanished), 8);
        ledger.insert("a", 1, 3, LedgerEntry::Dropped(DropRule::TooOld), 8);
        assert_eq!(ledger.entry("a", 1, 1), Some(LedgerEntry::Accepted));
        assert_eq!(ledger.entry("a", 1, 2), Some(LedgerEntry::Dropped(DropRule::Vanished)));
        assert_eq!(ledger.entry("a", 1, 4), None);
        ledger.settle("a", 1, 2);
        assert_eq!(ledger.entry("a", 1, 3), Some(LedgerEntry::Dropped(DropRule::TooOld)));
        assert_eq!(ledger.processes[&("a".to_string(), 1)].dropped.len(), 1, "only numbers that may be sent again");
    }

    #[test]
    fn every_number_is_accounted_for() {
        let mut ledger = Ledger::default();
        ledger.accept("a", 1, 1);
        ledger.insert("a", 1, 2, LedgerEntry::Dropped(DropRule::TooOld), 8);
        ledger.accept("a", 1, 5);
        ledger.accept("a", 1, 9);
        let process = ledger.processes().next().unwrap();
        assert_eq!((process.through, process.newest, process.missing), (2, 9, 5), "3, 4, 6, 7 and 8 are missing");
        ledger.settle("a", 1, 6);
        let process = ledger.processes().next().unwrap();
        assert_eq!((process.through, process.newest, process.missing), (6, 9, 2), "7 and 8 are");
        let account = Account { accepted: 3, too_old: 1, unseen: 3, env_steps: 24, env_steps_dropped: 8, vanished: 0 };
        assert_eq!(process.account, account);
        ledger.settle("a", 1, u64::MAX);
        assert_eq!(ledger.total().accepted, 3);
    }

    #[test]
    fn incarnations_have_separate_numbers() {
        let mut ledger = Ledger::default();
        ledger.accept("a", 1, 1);
        assert!(!ledger.contains("a", 2, 1));
    }

    #[test]
    fn memory_is_bounded() {
        let mut ledger = Ledger::default();
        (0..ACTORS_MAX as u64 + 50).for_each(|incarnation| ledger.accept("a", incarnation, 1));
        assert_eq!(ledger.processes.len(), ACTORS_MAX);
        assert!(!ledger.contains("a", 0, 1), "the oldest was removed");
        assert_eq!(ledger.total().accepted, ACTORS_MAX as u64 + 50, "its account stays");
        (0..AHEAD_MAX as u64 + 50).for_each(|i| ledger.accept("b", 1, 2 + 2 * i));
        assert!(ledger.processes[&("b".to_string(), 1)].ahead.len() <= AHEAD_MAX);
    }

    #[test]
    fn senders_without_accepted_fragments_push_no_other_out() {
        let mut ledger = Ledger::default();
        ledger.accept("honest", 1, 1);
        for incarnation in 0..2 * ACTORS_MAX as u64 {
            ledger.look_up("flood", incarnation, 1, 0);
            ledger.insert("flood", incarnation, 1, LedgerEntry::Dropped(DropRule::TooOld), 8);
            assert!(ledger.contains("flood", incarnation, 1));
        }
        assert_eq!(ledger.processes.len(), ACTORS_MAX);
        assert!(ledger.contains("honest", 1, 1));
        // A process without accepted fragments keeps what it settled.
        (0..ACTORS_MAX as u64).for_each(|incarnation| ledger.accept("a", incarnation, 1));
        ledger.look_up("late", 1, 8, 7);
        ledger.accept("late", 1, 8);
        ledger.mark_durable();
        assert_eq!(ledger.durable_through("late", 1), 8);
    }

    proptest! {
        #[test]
        fn the_ledger_contains_exactly_the_inserted_numbers_in_any_order(numbers in prop::collection::vec(1u64..40, 0..80)) {
            let mut ledger = Ledger::default();
            numbers.iter().for_each(|number| ledger.accept("a", 1, *number));
            for number in 1..40 {
                prop_assert_eq!(ledger.contains("a", 1, number), numbers.contains(&number));
            }
        }
    }
}
