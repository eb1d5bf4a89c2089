//! Fragments to the learner: sent until a receipt says what became of them, and kept until they are durable.

use std::{
    collections::{BTreeMap, BTreeSet},
    sync::{Arc, Mutex, MutexGuard},
    time::Duration,
};

use bytes::Bytes;
use treadmill_bus::{Bus, BusError, submit};
use treadmill_proto::{Outcome, Receipt};

use crate::policies::{Policies, Refreshed};

const RETRY: Duration = Duration::from_millis(200);
/// A sender in quarantine comes back after this.
const QUARANTINE_RETRY: Duration = Duration::from_secs(10);
/// Retries between two messages that say that nobody answers.
const RETRIES_PER_MESSAGE: u64 = 50;

/// Counts of fragments over the life of this process: `produced = accepted + dropped_by_rule + in_flight`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Handed to the courier.
    pub produced: u64,
    /// Taken by the learner.
    pub accepted: u64,
    /// Too old, of a vanished version, or refused.
    pub dropped_by_rule: u64,
    /// Without a receipt.
    pub in_flight: u64,
    /// Sent once more.
    pub resent: u64,
    /// Taken, but not yet part of a checkpoint.
    pub awaiting_durability: u64,
}

/// Sends fragments.
pub struct Courier {
    bus: Bus,
    run: String,
    actor: String,
    receipt_timeout: Duration,
    policies: Arc<Policies>,
    book: Mutex<Book>,
}

/// Where every fragment is.
#[derive(Default)]
struct Book {
    /// The learner that `kept` was given to.
    incarnation: u64,
    produced: u64,
    accepted: u64,
    dropped_by_rule: u64,
    resent: u64,
    /// Handed to the courier and without a receipt.
    in_flight: BTreeSet<u64>,
    /// Taken, but not yet part of a checkpoint. The learner makes everything durable once it has a batch, so there are
    /// never more of them than fragments in a batch and in flight.
    kept: BTreeMap<u64, Bytes>,
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
            book: Mutex::new(Book { incarnation, ..Book::default() }),
        }
    }

    /// Counts at this moment.
    pub fn counts(&self) -> Counts {
        let book = self.book();
        Counts {
            produced: book.produced,
            accepted: book.accepted,
            dropped_by_rule: book.dropped_by_rule,
            in_flight: book.in_flight.len() as u64,
            resent: book.resent,
            awaiting_durability: book.kept.len() as u64,
        }
    }

    /// Every fragment up to this sequence number is dealt with for good: neither in flight nor kept.
    pub fn settled_through(&self) -> u64 {
        let book = self.book();
        let open = [book.in_flight.first(), book.kept.keys().next()].into_iter().flatten().min();
        open.map_or(book.newest, |first| first - 1)
    }

    /// Notes a fragment that is about to be delivered.
    pub fn produced(&self, sequence: u64) {
        let mut book = self.book();
        book.produced += 1;
        book.newest = sequence;
        book.in_flight.insert(sequence);
        tracing::debug!("fragment {sequence} is on its way");
    }

    /// Sends one new fragment until it is dealt with, then sees that the newest policy is in use.
    pub async fn deliver(&self, sequence: u64, fragment: Bytes) -> Result<Refreshed, BusError> {
        let receipt = self.send_until_dealt_with(&fragment).await?;
        if receipt.outcome == Outcome::Malformed {
            tracing::error!("the learner refused fragment {sequence}: {}", receipt.reason);
        }
        self.book().settle(sequence, fragment, &receipt);
        let refreshed = self.policies.refresh(Some(receipt.version)).await;
        self.send_again_to_a_new_learner().await?;
        Ok(refreshed)
    }

    fn book(&self) -> MutexGuard<'_, Book> {
        self.book.lock().expect("no holder of this lock panics")
    }

    /// A learner that was restarted knows only what was durable: the rest goes to it once more. Idempotent by sequence
    /// number.
    pub async fn send_again_to_a_new_learner(&self) -> Result<(), BusError> {
        let incarnation = self.policies.current().version.incarnation;
        let again: Vec<(u64, Bytes)> = {
            let mut book = self.book();
            if book.incarnation == incarnation {
                return Ok(());
            }
            book.incarnation = incarnation;
            // A learner that is gone took them; what becomes of them is open again.
            let again: Vec<_> = std::mem::take(&mut book.kept).into_iter().collect();
            book.accepted -= again.len() as u64;
            book.resent += again.len() as u64;
            book.in_flight.extend(again.iter().map(|(sequence, _)| sequence));
            again
        };
        for (sequence, fragment) in again {
            let receipt = self.send_until_dealt_with(&fragment).await?;
            self.book().settle(sequence, fragment, &receipt);
        }
        Ok(())
    }

    async fn send_until_dealt_with(&self, fragment: &Bytes) -> Result<Receipt, BusError> {
        for tries in 0u64.. {
            if tries > 0 {
                self.book().resent += 1;
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

impl Book {
    /// Notes what became of a fragment, and lets go of what is durable.
    fn settle(&mut self, sequence: u64, fragment: Bytes, receipt: &Receipt) {
        self.in_flight.remove(&sequence);
        if matches!(receipt.outcome, Outcome::Accepted | Outcome::Duplicate) {
            self.accepted += 1;
            self.kept.insert(sequence, fragment);
        } else {
            self.dropped_by_rule += 1;
        }
        self.kept.retain(|sequence, _| *sequence > receipt.durable_through);
    }
}

fn what_next(receipt: &Receipt) -> Next {
    match receipt.outcome {
        Outcome::Accepted | Outcome::Duplicate | Outcome::TooOld | Outcome::Vanished | Outcome::Malformed => Next::Done,
        Outcome::Busy | Outcome::Stopping => Next::After(RETRY),
        Outcome::Quarantined => Next::After(QUARANTINE_RETRY),
    }
}

#[cfg(test)]
mod tests {
    use treadmill_proto::PolicyVersion;

    use super::*;

    fn receipt(outcome: Outcome, durable_through: u64) -> Receipt {
        Receipt { outcome, reason: String::new(), version: PolicyVersion::default(), durable_through }
    }

    #[test]
    fn what_is_taken_is_kept_until_it_is_durable() {
        let mut book = Book { in_flight: (1..=3).collect(), produced: 3, newest: 3, ..Book::default() };
        book.settle(2, Bytes::new(), &receipt(Outcome::Accepted, 0));
        assert_eq!(book.kept.keys().copied().collect::<Vec<_>>(), [2]);
        book.settle(1, Bytes::new(), &receipt(Outcome::TooOld, 0));
        book.settle(3, Bytes::new(), &receipt(Outcome::Duplicate, 2));
        assert_eq!(book.kept.keys().copied().collect::<Vec<_>>(), [3], "2 is part of a checkpoint, 1 was dropped");
        assert_eq!((book.accepted, book.dropped_by_rule, book.in_flight.len()), (2, 1, 0));
    }

    #[test]
    fn only_a_verdict_ends_the_sending() {
        for outcome in [Outcome::Accepted, Outcome::Duplicate, Outcome::TooOld, Outcome::Vanished, Outcome::Malformed] {
            assert_eq!(what_next(&receipt(outcome, 0)), Next::Done);
        }
        for outcome in [Outcome::Busy, Outcome::Stopping, Outcome::Quarantined] {
            assert!(matches!(what_next(&receipt(outcome, 0)), Next::After(_)));
        }
    }
}
