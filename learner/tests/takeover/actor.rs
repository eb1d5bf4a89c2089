//! Actor of the simulation: sends fragments until a receipt settles them, and keeps them until they are durable.

use std::collections::{BTreeMap, BTreeSet};

use treadmill_runtime::epoch::SeenEpoch;

/// Name of the run.
pub const RUN: &str = "walk";
/// Fragments that may be pending at once.
const CREDIT: usize = 2;

/// Receipt of a learner.
#[derive(Clone, Copy, Debug)]
pub struct Receipt {
    pub epoch: u64,
    pub durable_through: u64,
}

/// One actor process.
#[derive(Default)]
pub struct Actor {
    seen: SeenEpoch,
    /// Epoch of the policy in use.
    pub acting: u64,
    newest: u64,
    pub pending: BTreeSet<u64>,
    /// Accepted fragments that may not be durable, with the epoch of the learner that accepted each.
    pub kept: BTreeMap<u64, u64>,
    /// Fragments that a learner called durable.
    pub durable: BTreeSet<u64>,
}

impl Actor {
    /// Takes an announcement or a receipt's version. A learner of a higher epoch gets again what may not be durable.
    pub fn hear(&mut self, epoch: u64) -> bool {
        if !self.seen.admits(RUN, epoch) {
            return false;
        }
        assert!(epoch >= self.acting, "the actor acts on epoch {epoch} after {}", self.acting);
        if epoch > self.acting {
            self.acting = epoch;
            self.pending.extend(std::mem::take(&mut self.kept).into_keys());
        }
        true
    }

    /// Simulates one fragment, if there is credit.
    pub fn simulate(&mut self) {
        if self.pending.len() < CREDIT {
            self.newest += 1;
            self.pending.insert(self.newest);
        }
    }

    /// Takes the receipt of a fragment.
    pub fn take(&mut self, sequence: u64, receipt: Receipt) {
        if !self.hear(receipt.epoch) || !self.pending.remove(&sequence) {
            return;
        }
        self.kept.insert(sequence, receipt.epoch);
        let durable: Vec<u64> = self.kept.keys().copied().filter(|kept| *kept <= receipt.durable_through).collect();
        for sequence in durable {
            self.kept.remove(&sequence);
            self.durable.insert(sequence);
        }
    }
}
