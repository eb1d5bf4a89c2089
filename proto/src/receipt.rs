//! The learner's answer to a fragment: the actor's credit.

use prost::Message;

use crate::{Malformed, PolicyVersion, bundle, wire};

/// What became of a fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Taken.
    Accepted,
    /// Taken before.
    Duplicate,
    /// Its policy is further back than `max_policy_lag`.
    TooOld,
    /// Its policy is unknown to a learner that resumed from an older checkpoint.
    Vanished,
    /// Refused; the reason says why.
    Malformed,
    /// The sender keeps failing.
    Quarantined,
    /// The intake is full: send it again.
    Busy,
    /// The learner is stopping: keep it for its successor.
    Stopping,
}

const OUTCOMES: [(Outcome, wire::Outcome); 8] = [
    (Outcome::Accepted, wire::Outcome::Accepted),
    (Outcome::Duplicate, wire::Outcome::Duplicate),
    (Outcome::TooOld, wire::Outcome::TooOld),
    (Outcome::Vanished, wire::Outcome::Vanished),
    (Outcome::Malformed, wire::Outcome::Malformed),
    (Outcome::Quarantined, wire::Outcome::Quarantined),
    (Outcome::Busy, wire::Outcome::Busy),
    (Outcome::Stopping, wire::Outcome::Stopping),
];

/// A receipt.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Receipt {
    /// What became of the fragment.
    pub outcome: Outcome,
    /// What was wrong, in words, where something was.
    pub reason: String,
    /// The newest policy version.
    pub version: PolicyVersion,
    /// Every accepted fragment of this actor up to this sequence number is part of a checkpoint.
    pub durable_through: u64,
}

impl Receipt {
    /// Protobuf bytes.
    pub fn encode(&self) -> Vec<u8> {
        let outcome = OUTCOMES.iter().find(|(ours, _)| *ours == self.outcome).map(|(_, wire)| *wire);
        wire::Receipt {
            outcome: outcome.unwrap_or_default().into(),
            reason: self.reason.clone(),
            version: Some(self.version.into()),
            durable_through: self.durable_through,
        }
        .encode_to_vec()
    }

    /// Reads protobuf bytes from a stranger.
    pub fn decode(bytes: &[u8]) -> Result<Self, Malformed> {
        bundle::check_small("receipt", bytes.len())?;
        let message = wire::Receipt::decode(bytes)
            .map_err(|why| Malformed::Undecodable { what: "receipt", why: why.to_string() })?;
        let outcome = OUTCOMES
            .iter()
            .find(|(_, wire)| *wire as i32 == message.outcome)
            .map(|(ours, _)| *ours)
            .ok_or_else(|| Malformed::field("outcome", message.outcome, "1 to 8"))?;
        Ok(Self {
            outcome,
            reason: message.reason,
            version: bundle::version(message.version)?,
            durable_through: message.durable_through,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_outcome_survives_the_wire() {
        for (outcome, _) in OUTCOMES {
            let receipt = Receipt {
                outcome,
                reason: "because".into(),
                version: PolicyVersion { incarnation: 1, number: 2 },
                durable_through: 3,
            };
            assert_eq!(Receipt::decode(&receipt.encode()).unwrap(), receipt);
        }
        assert!(Receipt::decode(&[8, 99]).unwrap_err().to_string().contains("outcome"));
    }
}
