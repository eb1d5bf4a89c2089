//! What became of the fragments of played actors.

use std::{collections::BTreeMap, time::Duration};

use serde::{Deserialize, Serialize};

/// Sums over fragments; those of several actors can be added.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tally {
    pub produced: u64,
    pub produced_steps: u64,
    pub produced_bytes: u64,
    pub accepted: u64,
    pub accepted_steps: u64,
    /// Dropped by a rule: too old, or of a vanished version.
    pub dropped: u64,
    pub dropped_steps: u64,
    /// Additional times that fragments were sent.
    pub resent: u64,
    /// Time that the simulation of the produced fragments took.
    pub simulated_us: u64,
    /// Actors of which a fragment was accepted.
    pub proven: u64,
}

impl Tally {
    /// Returns the fragments without a receipt.
    pub fn in_flight(&self) -> u64 {
        self.produced - self.accepted - self.dropped
    }

    /// Adds another tally.
    pub fn add(&mut self, other: Self) {
        self.produced += other.produced;
        self.produced_steps += other.produced_steps;
        self.produced_bytes += other.produced_bytes;
        self.accepted += other.accepted;
        self.accepted_steps += other.accepted_steps;
        self.dropped += other.dropped;
        self.dropped_steps += other.dropped_steps;
        self.resent += other.resent;
        self.simulated_us += other.simulated_us;
        self.proven += other.proven;
    }
}

/// Most times of each kind that an actor keeps; later ones are not measured.
const TIMES_MAX: usize = 100_000;

/// Measured times.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Times {
    /// From the first send of a fragment to the receipt that settled it (ms).
    pub receipts_ms: Vec<f64>,
    /// From the request of a policy to the policy (ms).
    pub fetches_ms: Vec<f64>,
    /// From the end of a simulation to the send of its fragment (ms); large if the played side lacks processor time.
    pub late_ms: Vec<f64>,
    /// Unix time at which each policy arrived (s), by its number.
    #[serde(skip)]
    pub arrivals: BTreeMap<u64, f64>,
}

impl Times {
    /// Adds the durations of another actor.
    pub fn add(&mut self, other: &Self) {
        self.receipts_ms.extend(&other.receipts_ms);
        self.fetches_ms.extend(&other.fetches_ms);
        self.late_ms.extend(&other.late_ms);
    }
}

/// Adds a time in milliseconds.
pub fn keep_time(times_ms: &mut Vec<f64>, time: Duration) {
    if times_ms.len() < TIMES_MAX {
        times_ms.push((time.as_secs_f64() * 1e5).round() / 100.0);
    }
}
