//! Fragments of a played actor: by outcome, and those without a receipt or a checkpoint.

use std::{collections::BTreeMap, time::Duration};

use bytes::Bytes;
use serde_json::{Map, Value};
use treadmill_experience::delivery::{Action, Attempt, Delivery, Event};
use treadmill_proto::Outcome;

/// Sums over fragments and answers; those of several actors can be added.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tally {
    pub produced: u64,
    pub produced_steps: u64,
    pub accepted: u64,
    pub accepted_steps: u64,
    /// Dropped by a rule: too old, or of a vanished version.
    pub dropped: u64,
    pub dropped_steps: u64,
    pub in_flight: u64,
    pub in_flight_steps: u64,
    /// Additional times that fragments were sent.
    pub resent: u64,
    /// Answers by outcome.
    pub duplicate: u64,
    pub too_old: u64,
    pub vanished: u64,
    pub busy: u64,
    pub quarantined: u64,
    pub stopping: u64,
    /// Sends without an answer.
    pub silent: u64,
    /// Time that the simulation of the produced fragments took.
    pub simulated_us: u64,
    /// In flight, and produced before the newest change of the rates.
    pub before_rates: u64,
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
    pub fn add(&mut self, mut other: Self) {
        self.fields().into_iter().zip(other.fields()).for_each(|((_, mine), (_, theirs))| *mine += *theirs);
    }

    /// Returns every sum by name.
    pub fn to_json(mut self) -> Map<String, Value> {
        self.fields().into_iter().map(|(name, sum)| (name.to_string(), (*sum).into())).collect()
    }

    /// Returns the sums of the answer of another process.
    pub fn from_json(answer: &Value) -> anyhow::Result<Self> {
        let mut tally = Self::default();
        for (name, sum) in tally.fields() {
            *sum = crate::helper::number(answer, name)? as u64;
        }
        Ok(tally)
    }
}

/// Measured times (ms).
#[derive(Clone, Debug, Default)]
pub struct Times {
    /// From the first send of a fragment to the receipt that settled it.
    pub receipts_ms: Vec<f64>,
    /// From the request of a policy to the policy.
    pub fetches_ms: Vec<f64>,
    /// From the end of a simulation to the send of its fragment; large if the played side lacks processor time.
    pub late_ms: Vec<f64>,
}

/// Most times of each kind that an actor keeps; later ones are not measured.
const TIMES_MAX: usize = 100_000;

/// Adds a time in milliseconds.
pub fn keep_time(times_ms: &mut Vec<f64>, time: Duration) {
    if times_ms.len() < TIMES_MAX {
        times_ms.push((time.as_secs_f64() * 1e5).round() / 100.0);
    }
}

/// Counts of one played actor, around the delivery of its fragments.
#[derive(Debug)]
pub struct ActorCounts {
    delivery: Delivery,
    tally: Tally,
    pub times: Times,
    /// Environment steps of each fragment without a receipt, by number.
    pending: BTreeMap<u64, u64>,
    newest: u64,
    /// Newest fragment at the last change of the rates.
    newest_at_rates: u64,
}

impl ActorCounts {
    /// Begins with the policy of this learner.
    pub fn new(incarnation: u64) -> Self {
        Self {
            delivery: Delivery::new(incarnation),
            tally: Tally::default(),
            times: Times::default(),
            pending: BTreeMap::new(),
            newest: 0,
            newest_at_rates: 0,
        }
    }

    /// Notes a change of the rates.
    pub fn change_rates(&mut self) {
        self.newest_at_rates = self.newest;
    }

    /// Registers the next fragment and returns its number.
    pub fn produce(&mut self, env_steps: u64, simulated: Duration) -> u64 {
        self.newest += 1;
        self.tally.produced += 1;
        self.tally.produced_steps += env_steps;
        self.tally.simulated_us += simulated.as_micros() as u64;
        self.pending.insert(self.newest, env_steps);
        self.newest
    }

    /// Returns the first attempt to deliver a fragment.
    pub fn begin_delivery(&mut self, sequence: u64, bytes: Bytes) -> Attempt {
        self.delivery.produce(sequence, bytes)
    }

    /// Counts an event of the delivery, and returns the attempts that follow.
    pub fn handle(&mut self, event: Event) -> Vec<Attempt> {
        let outcome = match &event {
            Event::Answered { receipt, .. } => Some(receipt.outcome),
            _ => None,
        };
        let is_silent = matches!(event, Event::Silent { .. });
        let mut attempts = Vec::new();
        for action in self.delivery.handle(event) {
            match action {
                Action::Send(attempt) => {
                    self.tally.silent += u64::from(is_silent);
                    self.tally.quarantined += u64::from(outcome == Some(Outcome::Quarantined));
                    self.tally.stopping += u64::from(outcome == Some(Outcome::Stopping));
                    self.tally.busy += u64::from(outcome == Some(Outcome::Busy));
                    attempts.push(attempt);
                }
                Action::Settled { sequence } => self.settle(sequence, outcome),
                Action::Warn { .. } | Action::Lost { .. } | Action::Found => {}
            }
        }
        attempts
    }

    fn settle(&mut self, sequence: u64, outcome: Option<Outcome>) {
        let env_steps = self.pending.remove(&sequence).unwrap_or(0);
        let tally = &mut self.tally;
        match outcome {
            Some(Outcome::Accepted | Outcome::Duplicate) => {
                tally.duplicate += u64::from(outcome == Some(Outcome::Duplicate));
                tally.accepted += 1;
                tally.accepted_steps += env_steps;
            }
            _ => {
                tally.too_old += u64::from(outcome == Some(Outcome::TooOld));
                tally.vanished += u64::from(outcome == Some(Outcome::Vanished));
                tally.dropped += 1;
                tally.dropped_steps += env_steps;
            }
        }
    }

    /// Returns the sums.
    pub fn tally(&self) -> Tally {
        Tally {
            resent: self.delivery.counts().resent,
            in_flight: self.pending.len() as u64,
            in_flight_steps: self.pending.values().sum(),
            before_rates: self.pending.range(..=self.newest_at_rates).count() as u64,
            ..self.tally
        }
    }

    /// Returns the number of accepted fragments that no checkpoint holds yet.
    pub fn awaiting_durability(&self) -> u64 {
        self.delivery.counts().awaiting_durability
    }

    /// Returns the highest number up to which every fragment is durable or dropped. A fragment that is not encoded yet
    /// is open.
    pub fn settled_through(&self) -> u64 {
        let unsent = self.pending.keys().next().map_or(self.newest, |first| first - 1);
        unsent.min(self.delivery.settled_through())
    }
}

#[cfg(test)]
mod tests {
    use treadmill_proto::{PolicyVersion, Receipt};

    use super::*;

    #[test]
    fn every_fragment_is_accepted_dropped_or_in_flight() {
        let mut counts = ActorCounts::new(0);
        let produce = |counts: &mut ActorCounts, env_steps| {
            let sequence = counts.produce(env_steps, Duration::from_micros(7));
            counts.begin_delivery(sequence, Bytes::new());
        };
        [10, 20, 30].into_iter().for_each(|env_steps| produce(&mut counts, env_steps));
        counts.change_rates();
        assert_eq!(counts.tally().before_rates, 3);
        produce(&mut counts, 40);
        let answer = |counts: &mut ActorCounts, sequence, outcome, durable_through| {
            let version = PolicyVersion::default();
            let receipt = Receipt { outcome, reason: String::new(), version, durable_through, fragment_steps: 0 };
            counts.handle(Event::Answered { sequence, receipt }).len()
        };
        assert_eq!(answer(&mut counts, 2, Outcome::Accepted, 0), 0);
        assert_eq!(answer(&mut counts, 4, Outcome::Busy, 0), 1, "another attempt");
        assert_eq!(counts.handle(Event::Silent { sequence: 4 }).len(), 1);
        answer(&mut counts, 1, Outcome::TooOld, 0);
        assert_eq!((counts.settled_through(), counts.awaiting_durability()), (1, 1), "no checkpoint holds 2 yet");
        answer(&mut counts, 3, Outcome::Duplicate, 2);
        assert_eq!((counts.settled_through(), counts.awaiting_durability()), (2, 1));
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
}
