//! Delivery of an actor's fragments: each is sent until a receipt settles it, and kept until a checkpoint holds it.
//!
//! ```text
//! produced ──► pending ──► kept ──► durable
//!                │  ▲        │
//!       dropped ◄┘  └────────┘ another learner leads: it may not have what was accepted
//! ```

use std::{
    collections::{BTreeMap, btree_map::Entry},
    time::Duration,
};

use bytes::Bytes;
use treadmill_proto::{Outcome, Receipt};

/// Why a fragment is sent again that no learner has answered: a slow disk looks like a lost link from here.
const NO_RECEIPT: &str =
    "no receipt came: the learner may be gone, out of reach, or waiting for its disk or store, as its log says";
/// Pause before a fragment is sent again.
const RETRY: Duration = Duration::from_millis(200);
/// How often that pause doubles while the learner is busy.
const BUSY_DOUBLINGS_MAX: u32 = 4;
/// Pause of a quarantined sender before its next attempt.
const QUARANTINE_RETRY: Duration = Duration::from_secs(10);
/// Attempts between two warnings about the same fragment.
const RETRIES_PER_WARNING: u64 = 50;
/// Attempts before the first warning: a learner may be restarting.
const RETRIES_BEFORE_NOTICE: u64 = 5;

/// What happened to the fragments of an actor process.
#[derive(Clone, Debug)]
pub enum Event {
    /// A learner answered an attempt.
    Answered {
        /// Number of the fragment.
        sequence: u64,
        /// Answer.
        receipt: Receipt,
    },
    /// No learner answered an attempt in time, or another learner leads since.
    Silent {
        /// Number of the fragment.
        sequence: u64,
    },
    /// A learner of this epoch exists, by an announcement or a policy.
    Heard {
        /// Term of the learner.
        epoch: u64,
    },
    /// The policy in use is from this incarnation of the learner.
    Adopted {
        /// Incarnation of the learner.
        incarnation: u64,
    },
}

/// What the actor does next.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Action {
    /// Send a fragment once the pause is over.
    Send(Attempt),
    /// A fragment is settled: fetch the policy that its receipt names, then return the credit.
    Settled {
        /// Number of the fragment.
        sequence: u64,
    },
    /// Warn that fragments are kept, with the reason.
    Warn {
        /// Why the last attempt did not settle the fragment.
        reason: String,
    },
    /// Notify the user: no learner answers.
    Lost {
        /// Pending fragments.
        pending: usize,
    },
    /// Notify the user: the learner answers again.
    Found,
}

/// Attempt to deliver a fragment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Attempt {
    /// Number of the fragment.
    pub sequence: u64,
    /// Its encoding.
    pub bytes: Bytes,
    /// Wait before it.
    pub pause: Duration,
}

/// Counts over the life of the process: `produced = accepted + dropped_by_rule + in_flight`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DeliveryCounts {
    /// Handed over for delivery.
    pub produced: u64,
    /// Accepted by the learner.
    pub accepted: u64,
    /// Too old, of a vanished version, or malformed.
    pub dropped_by_rule: u64,
    /// Pending.
    pub in_flight: u64,
    /// Attempts after the first one of each fragment.
    pub resent: u64,
    /// Accepted, but not yet part of a checkpoint.
    pub awaiting_durability: u64,
}

/// Fragment without a receipt that settles it.
#[derive(Clone, Debug)]
struct Pending {
    bytes: Bytes,
    retries: u64,
    /// Attempts in a row that found the learner busy.
    busy: u32,
}

impl Pending {
    fn new(bytes: Bytes) -> Self {
        Self { bytes, retries: 0, busy: 0 }
    }
}

/// State of every fragment of one actor process in one run. Bounded: credit limits the pending fragments, and each
/// update makes the kept ones durable, so these are at most a batch plus the pending ones.
#[derive(Clone, Debug, Default)]
pub struct Delivery {
    /// Highest epoch heard of; 0 if none.
    epoch: u64,
    /// Learner that accepted the kept fragments.
    incarnation: u64,
    counts: DeliveryCounts,
    pending: BTreeMap<u64, Pending>,
    kept: BTreeMap<u64, Bytes>,
    newest: u64,
    is_lost: bool,
    forgets_accepted: bool,
}

impl Delivery {
    /// Begins with the policy of this incarnation.
    #[must_use]
    pub fn new(incarnation: u64) -> Self {
        Self { incarnation, ..Self::default() }
    }

    /// Plants a fault: accepted fragments are forgotten at once. Tests show with it that a simulation finds lost fragments.
    #[doc(hidden)]
    #[must_use]
    pub fn with_fault(self) -> Self {
        Self { forgets_accepted: true, ..self }
    }

    /// Takes a fragment that was produced, whose number within this process is one more than the last one's. Returns
    /// the first attempt to deliver it.
    pub fn produce(&mut self, sequence: u64, bytes: Bytes) -> Attempt {
        self.counts.produced += 1;
        self.newest = self.newest.max(sequence);
        self.pending.insert(sequence, Pending::new(bytes.clone()));
        Attempt { sequence, bytes, pause: Duration::ZERO }
    }

    /// Takes an event and returns what to do. An answer for a fragment that is settled already asks for nothing.
    pub fn handle(&mut self, event: Event) -> Vec<Action> {
        match event {
            Event::Answered { sequence, receipt } => self.answered(sequence, &receipt),
            Event::Silent { sequence } => self.retry(sequence, RETRY, NO_RECEIPT, true),
            Event::Heard { epoch } => {
                self.admits(epoch);
                Vec::new()
            }
            Event::Adopted { incarnation } => self.adopted(incarnation),
        }
    }

    /// Returns the present counts.
    #[must_use]
    pub fn counts(&self) -> DeliveryCounts {
        let (in_flight, awaiting_durability) = (self.pending.len() as u64, self.kept.len() as u64);
        DeliveryCounts { in_flight, awaiting_durability, ..self.counts }
    }

    /// Returns the highest number up to which every fragment is durable or dropped.
    #[must_use]
    pub fn settled_through(&self) -> u64 {
        let open = self.pending.keys().next().into_iter().chain(self.kept.keys().next()).min();
        open.map_or(self.newest, |first| first - 1)
    }

    /// Returns the numbers of the fragments without a receipt that settles them.
    pub fn pending(&self) -> impl Iterator<Item = u64> {
        self.pending.keys().copied()
    }

    /// Returns the numbers of the accepted fragments that may not be durable.
    pub fn kept(&self) -> impl Iterator<Item = u64> {
        self.kept.keys().copied()
    }

    /// Returns whether a learner of this epoch may settle fragments: no other has overtaken it. 0 is unknown.
    pub fn admits(&mut self, epoch: u64) -> bool {
        let is_overtaken = epoch != 0 && epoch < self.epoch;
        self.epoch = self.epoch.max(epoch);
        !is_overtaken
    }

    fn answered(&mut self, sequence: u64, receipt: &Receipt) -> Vec<Action> {
        if !self.admits(receipt.version.epoch) {
            // Its acceptance would never become durable.
            return self.retry(sequence, RETRY, "a learner answers that another one has overtaken", false);
        }
        let Entry::Occupied(entry) = self.pending.entry(sequence) else { return Vec::new() };
        let mut actions = Vec::new();
        if std::mem::take(&mut self.is_lost) {
            actions.push(Action::Found);
        }
        let busy = entry.get().busy;
        if let Some(pause) = pause_after(receipt.outcome, busy) {
            actions.extend(self.retry(sequence, pause, &receipt.reason, false));
            if let (Outcome::Busy, Some(pending)) = (receipt.outcome, self.pending.get_mut(&sequence)) {
                pending.busy = busy.saturating_add(1);
            }
            return actions;
        }
        let Pending { bytes, .. } = entry.remove();
        match receipt.outcome {
            Outcome::Accepted | Outcome::Duplicate => {
                self.counts.accepted += 1;
                if !self.forgets_accepted {
                    self.kept.insert(sequence, bytes);
                }
            }
            _ => self.counts.dropped_by_rule += 1,
        }
        self.kept.retain(|sequence, _| *sequence > receipt.durable_through);
        actions.push(Action::Settled { sequence });
        actions
    }

    fn retry(&mut self, sequence: u64, pause: Duration, reason: &str, is_silent: bool) -> Vec<Action> {
        let in_flight = self.pending.len();
        let Some(pending) = self.pending.get_mut(&sequence) else { return Vec::new() };
        let mut actions = Vec::new();
        if is_silent && pending.retries == RETRIES_BEFORE_NOTICE && !std::mem::replace(&mut self.is_lost, true) {
            actions.push(Action::Lost { pending: in_flight });
        }
        if pending.retries % RETRIES_PER_WARNING == RETRIES_BEFORE_NOTICE {
            actions.push(Action::Warn { reason: reason.to_string() });
        }
        (pending.retries, pending.busy) = (pending.retries + 1, 0);
        self.counts.resent += 1;
        actions.push(Action::Send(Attempt { sequence, bytes: pending.bytes.clone(), pause }));
        actions
    }

    /// Sends accepted fragments again to another learner, which has only the durable ones and recognises them by their
    /// number.
    fn adopted(&mut self, incarnation: u64) -> Vec<Action> {
        if incarnation == std::mem::replace(&mut self.incarnation, incarnation) {
            return Vec::new();
        }
        let kept = std::mem::take(&mut self.kept);
        self.counts.accepted -= kept.len() as u64;
        self.counts.resent += kept.len() as u64;
        let again = kept.into_iter().map(|(sequence, bytes)| {
            self.pending.insert(sequence, Pending::new(bytes.clone()));
            Action::Send(Attempt { sequence, bytes, pause: Duration::ZERO })
        });
        again.collect()
    }
}

/// Returns whether an outcome settles a fragment.
#[must_use]
pub fn settles(outcome: Outcome) -> bool {
    pause_after(outcome, 0).is_none()
}

/// Returns the pause before the next attempt, after `busy` attempts in a row that found the learner busy; `None` if the
/// outcome settles the fragment.
fn pause_after(outcome: Outcome, busy: u32) -> Option<Duration> {
    match outcome {
        Outcome::Accepted | Outcome::Duplicate | Outcome::TooOld | Outcome::Vanished | Outcome::Malformed => None,
        // A learner that is paused or waits for its disk stays busy, and each attempt carries the whole fragment.
        Outcome::Busy => Some(RETRY * (1 << busy.min(BUSY_DOUBLINGS_MAX))),
        Outcome::Stopping => Some(RETRY),
        Outcome::Quarantined => Some(QUARANTINE_RETRY),
    }
}
