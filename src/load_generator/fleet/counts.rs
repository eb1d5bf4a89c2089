//! Fragments of a played actor: by outcome, and those without a receipt or a checkpoint.

use std::{
    collections::{BTreeMap, BTreeSet},
    time::Duration,
};

use serde_json::{Map, Value};
use treadmill_proto::{Outcome, Receipt};

/// Sums over fragments and answers; those of several actors can be added.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Tally {
    pub(super) produced: u64,
    pub(super) produced_steps: u64,
    pub(super) accepted: u64,
    pub(super) accepted_steps: u64,
    /// Dropped by a rule: too old, or of a vanished version.
    pub(super) dropped: u64,
    pub(super) dropped_steps: u64,
    pub(super) in_flight: u64,
    pub(super) in_flight_steps: u64,
    /// Additional times that fragments were sent.
    pub(super) resent: u64,
    /// Answers by outcome.
    pub(super) duplicate: u64,
    pub(super) too_old: u64,
    pub(super) vanished: u64,
    pub(super) busy: u64,
    pub(super) quarantined: u64,
    pub(super) stopping: u64,
    /// Sends without an answer.
    pub(super) silent: u64,
    /// Time that the simulation of the produced fragments took.
    pub(super) simulated_us: u64,
    /// In flight, and produced before the newest change of the rates.
    pub(super) before_rates: u64,
}

impl Tally {
    fn fields(&mut self) -> [(&'static str, &mut u64); 18] {
        [
            ("produced", &mut self.produced),
            ("produced_steps", &mut self.produced_steps),
            ("accepted", &mut self.accepted),
            ("accepted_steps", &mut self.accepted_steps),
            ("dropped", &mut self.dropped),
            ("dropped_steps", &mut self.dropped_steps),
            ("in_flight", &mut self.in_flight),
            ("in_flight_steps", &mut self.in_flight_steps),
            ("resent", &mut self.resent),
            ("duplicate", &mut self.duplicate),
            ("too_old", &mut self.too_old),
            ("vanished", &mut self.vanished),
            ("busy", &mut self.busy),
            ("quarantined", &mut self.quarantined),
            ("stopping", &mut self.stopping),
            ("silent", &mut self.silent),
            ("simulated_us", &mut self.simulated_us),
            ("before_rates", &mut self.before_rates),
        ]
    }

    /// Adds another tally.
    pub(super) fn add(&mut self, mut other: Self) {
        self.fields().into_iter().zip(other.fields()).for_each(|((_, mine), (_, theirs))| *mine += *theirs);
    }

    /// Returns every sum by name.
    pub(super) fn to_json(mut self) -> Map<String, Value> {
        self.fields().into_iter().map(|(name, sum)| (name.to_string(), (*sum).into())).collect()
    }

    /// Returns the sums of the answer of another process.
    pub(super) fn from_json(answer: &Value) -> anyhow::Result<Self> {
        let mut tally = Self::default();
        for (name, sum) in tally.fields() {
            *sum = super::super::helper::number(answer, name)? as u64;
        }
        Ok(tally)
    }
}

/// Measured times (ms).
#[derive(Clone, Debug, Default)]
pub(super) struct Times {
    /// From the first send of a fragment to the receipt that settled it.
    pub(super) receipts_ms: Vec<f64>,
    /// From the request of a policy to the policy.
    pub(super) fetches_ms: Vec<f64>,
    /// From the end of a simulation to the send of its fragment; large if the played side lacks processor time.
    pub(super) late_ms: Vec<f64>,
}

/// Most times of each kind that an actor keeps; later ones are not measured.
const TIMES_MAX: usize = 100_000;

/// Adds a time in milliseconds.
pub(super) fn keep_time(times_ms: &mut Vec<f64>, time: Duration) {
    if times_ms.len() < TIMES_MAX {
        times_ms.push((time.as_secs_f64() * 1e5).round() / 100.0);
    }
}

/// Counts of one played actor.
#[derive(Debug, Default)]
pub(super) struct ActorCounts {
    tally: Tally,
    pub(super) times: Times,
    /// Environment steps of each fragment without a receipt, by sequence number.
    pending: BTreeMap<u64, u64>,
    /// Accepted fragments that no checkpoint holds yet.
    awaiting_durability: BTreeSet<u64>,
    newest: u64,
    /// Newest fragment at the last change of the rates.
    newest_at_rates: u64,
}

impl ActorCounts {
    /// Notes a change of the rates.
    pub(super) fn change_rates(&mut self) {
        self.newest_at_rates = self.newest;
    }

    /// Registers the next fragment and returns its sequence number.
    pub(super) fn produce(&mut self, env_steps: u64, simulated: Duration) -> u64 {
        self.newest += 1;
        self.tally.produced += 1;
        self.tally.produced_steps += env_steps;
        self.tally.simulated_us += simulated.as_micros() as u64;
        self.pending.insert(self.newest, env_steps);
        self.newest
    }

    /// Counts an answer that does not settle the fragment, or a missing one; the fragment is sent again.
    pub(super) fn resend(&mut self, outcome: Option<Outcome>) {
        self.tally.resent += 1;
        match outcome {
            None => self.tally.silent += 1,
            Some(Outcome::Quarantined) => self.tally.quarantined += 1,
            Some(Outcome::Stopping) => self.tally.stopping += 1,
            Some(_) => self.tally.busy += 1,
        }
    }

    /// Records the receipt that settles a fragment.
    pub(super) fn settle(&mut self, sequence: u64, receipt: &Receipt) {
        let env_steps = self.pending.remove(&sequence).unwrap_or(0);
        let tally = &mut self.tally;
        match receipt.outcome {
            Outcome::Accepted | Outcome::Duplicate => {
                tally.duplicate += u64::from(receipt.outcome == Outcome::Duplicate);
                tally.accepted += 1;
                tally.accepted_steps += env_steps;
                self.awaiting_durability.insert(sequence);
            }
            outcome => {
                tally.too_old += u64::from(outcome == Outcome::TooOld);
                tally.vanished += u64::from(outcome == Outcome::Vanished);
                tally.dropped += 1;
                tally.dropped_steps += env_steps;
            }
        }
        self.awaiting_durability = self.awaiting_durability.split_off(&(receipt.durable_through.saturating_add(1)));
    }

    /// Returns the sums.
    pub(super) fn tally(&self) -> Tally {
        Tally {
            in_flight: self.pending.len() as u64,
            in_flight_steps: self.pending.values().sum(),
            before_rates: self.pending.range(..=self.newest_at_rates).count() as u64,
            ..self.tally
        }
    }

    /// Returns the number of accepted fragments that no checkpoint holds yet.
    pub(super) fn awaiting_durability(&self) -> u64 {
        self.awaiting_durability.len() as u64
    }

    /// Returns the highest sequence number up to which every fragment is durable or dropped.
    pub(super) fn settled_through(&self) -> u64 {
        let open = [self.pending.keys().next(), self.awaiting_durability.first()].into_iter().flatten().min();
        open.map_or(self.newest, |first| first - 1)
    }
}

#[cfg(test)]
mod tests {
    use treadmill_proto::PolicyVersion;

    use super::*;

    fn receipt(outcome: Outcome, durable_through: u64) -> Receipt {
        let version = PolicyVersion::default();
        Receipt { outcome, reason: String::new(), version, durable_through, fragment_steps: 0 }
    }

    #[test]
    fn every_fragment_is_accepted_dropped_or_in_flight() {
        let mut counts = ActorCounts::default();
        for env_steps in [10, 20, 30] {
            counts.produce(env_steps, Duration::from_micros(7));
        }
        counts.change_rates();
        assert_eq!(counts.tally().before_rates, 3);
        counts.produce(40, Duration::from_micros(7));
        counts.settle(2, &receipt(Outcome::Accepted, 0));
        counts.resend(Some(Outcome::Busy));
        counts.resend(None);
        counts.settle(1, &receipt(Outcome::TooOld, 0));
        counts.settle(3, &receipt(Outcome::Duplicate, 0));
        let expected = Tally {
            produced: 4,
            produced_steps: 100,
            accepted: 2,
            accepted_steps: 50,
            dropped: 1,
            dropped_steps: 10,
            in_flight: 1,
            in_flight_steps: 40,
            resent: 2,
            duplicate: 1,
            too_old: 1,
            busy: 1,
            silent: 1,
            simulated_us: 28,
            ..Tally::default()
        };
        assert_eq!(counts.tally(), expected);
        assert_eq!(counts.tally().before_rates, 0, "the fragment in flight has the new rate");
        assert_eq!(Tally::from_json(&counts.tally().to_json().into()).unwrap(), expected);
    }

    #[test]
    fn fragments_are_settled_once_they_are_dropped_or_durable() {
        let mut counts = ActorCounts::default();
        for _ in 0..3 {
            counts.produce(1, Duration::ZERO);
        }
        assert_eq!(counts.settled_through(), 0);
        counts.settle(1, &receipt(Outcome::Vanished, 0));
        assert_eq!(counts.settled_through(), 1);
        counts.settle(2, &receipt(Outcome::Accepted, 0));
        assert_eq!((counts.settled_through(), counts.awaiting_durability()), (1, 1), "no checkpoint holds it yet");
        counts.settle(3, &receipt(Outcome::Accepted, 2));
        assert_eq!((counts.settled_through(), counts.awaiting_durability()), (2, 1));
    }
}
