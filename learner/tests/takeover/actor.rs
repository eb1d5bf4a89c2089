//! Actor of the simulation: the shipped delivery, and what a learner called durable.

use std::collections::BTreeSet;

use bytes::Bytes;
use treadmill_experience::delivery::{Delivery, Event};
use treadmill_proto::{Outcome, PolicyVersion, Receipt};

/// Fragments that may be pending at once.
const CREDIT: usize = 2;

/// One actor process.
pub struct Actor {
    pub delivery: Delivery,
    /// Epoch of the policy in use, which stands for the learner's incarnation too.
    pub acting: u64,
    newest: u64,
    /// Fragments that a learner called durable.
    pub durable: BTreeSet<u64>,
}

impl Default for Actor {
    fn default() -> Self {
        Self { delivery: Delivery::new(0), acting: 0, newest: 0, durable: BTreeSet::new() }
    }
}

impl Actor {
    /// Takes an announcement or a receipt's version. Returns false if a higher epoch was heard of before.
    pub fn hear(&mut self, epoch: u64) -> bool {
        if !self.delivery.admits(epoch) {
            return false;
        }
        assert!(epoch >= self.acting, "the actor acts on epoch {epoch} after {}", self.acting);
        self.acting = epoch;
        // The learner takes all that is pending, so what is to be sent needs no message here.
        self.delivery.handle(Event::Adopted { incarnation: epoch });
        true
    }

    /// Simulates one fragment, if there is credit.
    pub fn simulate(&mut self) {
        if self.delivery.pending().count() < CREDIT {
            self.newest += 1;
            self.delivery.produce(self.newest, Bytes::new());
        }
    }

    /// Takes the receipt of a fragment that a learner of this epoch accepted.
    pub fn take(&mut self, sequence: u64, epoch: u64, durable_through: u64) {
        if !self.hear(epoch) || !self.delivery.pending().any(|pending| pending == sequence) {
            return;
        }
        let before: BTreeSet<u64> = self.delivery.kept().chain([sequence]).collect();
        let version = PolicyVersion { epoch, ..PolicyVersion::new(epoch, 0) };
        let receipt =
            Receipt { outcome: Outcome::Accepted, reason: String::new(), version, durable_through, fragment_steps: 0 };
        self.delivery.handle(Event::Answered { sequence, receipt });
        let kept: BTreeSet<u64> = self.delivery.kept().collect();
        self.durable.extend(before.difference(&kept));
    }

    /// Returns whether the actor still has a fragment.
    pub fn has(&self, sequence: u64) -> bool {
        self.delivery.pending().chain(self.delivery.kept()).any(|open| open == sequence)
    }
}
