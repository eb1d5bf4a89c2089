//! What became of the fragments of played actors.

use std::{collections::BTreeMap, time::Duration};

use serde_json::{Map, Value, json};

use crate::process::number;

/// Sums over fragments; those of several actors can be added.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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
    fn fields(&mut self) -> [(&'static str, &mut u64); 10] {
        [
            ("produced", &mut self.produced),
            ("produced_steps", &mut self.produced_steps),
            ("produced_bytes", &mut self.produced_bytes),
            ("accepted", &mut self.accepted),
            ("accepted_steps", &mut self.accepted_steps),
            ("dropped", &mut self.dropped),
            ("dropped_steps", &mut self.dropped_steps),
            ("resent", &mut self.resent),
            ("simulated_us", &mut self.simulated_us),
            ("proven", &mut self.proven),
        ]
    }

    /// Returns the fragments without a receipt.
    pub fn in_flight(&self) -> u64 {
        self.produced - self.accepted - self.dropped
    }

    /// Adds another tally.
    pub fn add(&mut self, mut other: Self) {
        self.fields().into_iter().zip(other.fields()).for_each(|((_, mine), (_, theirs))| *mine += *theirs);
    }

    /// Returns every sum by name.
    pub fn to_json(mut self) -> Map<String, Value> {
        let in_flight = self.in_flight();
        let fields = self.fields().map(|(name, sum)| (name, *sum));
        fields.into_iter().chain([("in_flight", in_flight)]).map(|(name, sum)| (name.to_string(), sum.into())).collect()
    }

    /// Returns the sums of the answer of another process.
    pub fn from_json(answer: &Value) -> anyhow::Result<Self> {
        let mut tally = Self::default();
        for (name, sum) in tally.fields() {
            *sum = number(answer, name)? as u64;
        }
        Ok(tally)
    }
}

/// Most times of each kind that an actor keeps; later ones are not measured.
const TIMES_MAX: usize = 100_000;

/// Measured times.
#[derive(Clone, Debug, Default)]
pub struct Times {
    /// From the first send of a fragment to the receipt that settled it (ms).
    pub receipts_ms: Vec<f64>,
    /// From the request of a policy to the policy (ms).
    pub fetches_ms: Vec<f64>,
    /// From the end of a simulation to the send of its fragment (ms); large if the played side lacks processor time.
    pub late_ms: Vec<f64>,
    /// Unix time at which each policy arrived (s), by its number.
    pub arrivals: BTreeMap<u64, f64>,
}

impl Times {
    /// Adds the durations of another actor.
    pub fn add(&mut self, other: &Self) {
        self.receipts_ms.extend(&other.receipts_ms);
        self.fetches_ms.extend(&other.fetches_ms);
        self.late_ms.extend(&other.late_ms);
    }

    /// Returns the durations.
    pub fn to_json(&self) -> Value {
        json!({"receipts_ms": self.receipts_ms, "fetches_ms": self.fetches_ms, "late_ms": self.late_ms})
    }

    /// Returns the durations of the answer of another process.
    pub fn from_json(answer: &Value) -> Self {
        let list = |name: &str| answer[name].as_array().into_iter().flatten().filter_map(Value::as_f64).collect();
        let [receipts_ms, fetches_ms, late_ms] = ["receipts_ms", "fetches_ms", "late_ms"].map(list);
        Self { receipts_ms, fetches_ms, late_ms, arrivals: BTreeMap::new() }
    }
}

/// Adds a time in milliseconds.
pub fn keep_time(times_ms: &mut Vec<f64>, time: Duration) {
    if times_ms.len() < TIMES_MAX {
        times_ms.push((time.as_secs_f64() * 1e5).round() / 100.0);
    }
}
