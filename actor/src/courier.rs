//! Fragments to the learner: sent until a receipt says what became of them, and kept until they are durable.

use std::{
    collections::{BTreeMap, BTreeSet},
    sync::{
        Arc, Mutex, MutexGuard,
        atomic::{AtomicU64, Ordering},
    },
    time::Duration,
};

use bytes::Bytes;
use treadmill_common::bus::{Bus, BusError, submit};
use treadmill_proto::{Outcome, Receipt};

use crate::policies::{Policies, Refreshed};

const RETRY: Duration = Duration::from_millis(200);
/// A sender in quarantine comes back after this.
const QUARANTINE_RETRY: Duration = Duration::from_secs(10);
/// Retries between two messages that say that nobody answers.
const RETRIES_PER_MESSAGE: u64 = 50;

/// Counts of fragments: `produced = accepted + dropped_by_rule + in_flight`.
#[derive(Debug, Default)]
pub struct Counts {
    /// Handed to the courier.
    pub produced: AtomicU64,
    /// Taken by the learner.
    pub accepted: AtomicU64,
    /// Too old, of a vanished version, or refused.
    pub dropped_by_rule: AtomicU64,
    /// Sent once more.
    pub resent: AtomicU64,
}

impl Counts {
    /// Fragments without a receipt.
    pub fn in_flight(&self) -> u64 {
        // Read in this order, a fragment that moves meanwhile is counted in flight rather than twice.
        let done = self.accepted.load(Ordering::SeqCst) + self.dropped_by_rule.load(Ordering::SeqCst);
        self.produced.load(Ordering::SeqCst).saturating_sub(done)
    }
}

/// Sends fragments.
pub struct Courier {
    bus: Bus,
    run: String,
    actor: String,
    receipt_timeout: Duration,
    policies: Arc<Policies>,
    /// Counts.
    pub counts: Counts,
    kept: Mutex<Kept>,
}

/// Fragments that were taken but are not yet part of a checkpoint. The learner makes everything durable once it has a
/// batch, so there are never more of them than fragments in a batch and in flight.
#[derive(Default)]
struct Kept {
    incarnation: u64,
    fragments: BTreeMap<u64, Bytes>,
    /// Handed to the courier and without a receipt.
    in_flight: BTreeSet<u64>,
    newest: u64,
}

/// What is to be done after a receipt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Next {
    Done,
    After(Duration),
}

impl Courier {
    /// A courier of one actor process.
    pub fn new(bus: Bus, run: &str, actor: &str, receipt_timeout: Duration, policies: Arc<Policies>) -> Self {
        let incarnation = policies.current().version.incarnation;
        Self {
            bus,
            run: run.to_string(),
            actor: actor.to_string(),
            receipt_timeout,
            policies,
            counts: Counts::default(),
            kept: Mutex::new(Kept { incarnation, ..Kept::default() }),
        }
    }

    /// Fragments that were taken but are not yet part of a checkpoint.
    pub fn awaiting_durability(&self) -> u64 {
        self.kept().fragments.len() as u64
    }

    /// Every fragment up to this sequence number is dealt with for good: neither in flight nor kept.
    pub fn settled_through(&self) -> u64 {
        let kept = self.kept();
        let open = [kept.in_flight.first(), kept.fragments.keys().next()].into_iter().flatten().min();
        open.map_or(kept.newest, |first| first - 1)
    }

    /// Notes a fragment that is about to be delivered.
    pub fn produced(&self, sequence: u64) {
        self.counts.produced.fetch_add(1, Ordering::SeqCst);
        let mut kept = self.kept();
        kept.in_flight.insert(sequence);
        kept.newest = sequence;
    }

    /// Sends one new fragment until it is dealt with, then sees that the newest policy is in use.
    pub async fn deliver(&self, sequence: u64, fragment: Bytes) -> Result<Refreshed, BusError> {
        let receipt = self.send_until_dealt_with(&fragment).await?;
        self.kept().in_flight.remove(&sequence);
        match receipt.outcome {
            Outcome::Accepted | Outcome::Duplicate => {
                self.counts.accepted.fetch_add(1, Ordering::SeqCst);
                self.keep(sequence, fragment, receipt.durable_through);
            }
            _ => {
                self.counts.dropped_by_rule.fetch_add(1, Ordering::SeqCst);
                if receipt.outcome == Outcome::Malformed {
                    tracing::error!("the learner refused fragment {sequence}: {}", receipt.reason);
                }
            }
        }
        let refreshed = self.policies.refresh(Some(receipt.version)).await;
        self.send_again_to_a_new_learner().await?;
        Ok(refreshed)
    }

    fn kept(&self) -> MutexGuard<'_, Kept> {
        self.kept.lock().expect("no holder of this lock panics")
    }

    fn keep(&self, sequence: u64, fragment: Bytes, durable_through: u64) {
        let mut kept = self.kept();
        kept.fragments.insert(sequence, fragment);
        kept.fragments.retain(|sequence, _| *sequence > durable_through);
    }

    /// A learner that was restarted knows only what was durable: the rest goes to it once more. Idempotent by sequence
    /// number.
    pub async fn send_again_to_a_new_learner(&self) -> Result<(), BusError> {
        let incarnation = self.policies.current().version.incarnation;
        let again: Vec<(u64, Bytes)> = {
            let mut kept = self.kept();
            if kept.incarnation == incarnation {
                return Ok(());
            }
            kept.incarnation = incarnation;
            kept.fragments.iter().map(|(sequence, fragment)| (*sequence, fragment.clone())).collect()
        };
        for (sequence, fragment) in again {
            self.counts.resent.fetch_add(1, Ordering::SeqCst);
            let receipt = self.send_until_dealt_with(&fragment).await?;
            if matches!(receipt.outcome, Outcome::Accepted | Outcome::Duplicate) {
                self.keep(sequence, fragment, receipt.durable_through);
            } else {
                // It was counted as accepted by a learner that is gone.
                self.counts.dropped_by_rule.fetch_add(1, Ordering::SeqCst);
                self.counts.accepted.fetch_sub(1, Ordering::SeqCst);
                self.kept().fragments.remove(&sequence);
            }
        }
        Ok(())
    }

    async fn send_until_dealt_with(&self, fragment: &Bytes) -> Result<Receipt, BusError> {
        for tries in 0u64.. {
            if tries > 0 {
                self.counts.resent.fetch_add(1, Ordering::SeqCst);
            }
            let answer = submit(&self.bus, &self.run, &self.actor, fragment.clone(), self.receipt_timeout).await?;
            let next = answer.as_ref().map_or(Next::After(RETRY), what_next);
            match (next, answer) {
                (Next::Done, Some(receipt)) => return Ok(receipt),
                (Next::After(pause), answer) => {
                    if tries % RETRIES_PER_MESSAGE == 5 {
                        let why = answer.map_or("no learner answers".to_string(), |receipt| receipt.reason);
                        tracing::warn!("{}: {why}; keeping fragments and trying on", self.actor);
                    }
                    tokio::time::sleep(pause).await;
                }
                (Next::Done, None) => unreachable!("without a receipt the fragment is sent again"),
            }
        }
        unreachable!("tries do not run out")
    }
}

fn what_next(receipt: &Receipt) -> Next {
    match receipt.outcome {
        Outcome::Accepted | Outcome::Duplicate | Outcome::TooOld | Outcome::Vanished | Outcome::Malformed => Next::Done,
        Outcome::Busy | Outcome::Stopping => Next::After(RETRY),
        Outcome::Quarantined => Next::After(QUARANTINE_RETRY),
    }
}
