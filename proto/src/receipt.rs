//! Answers of the learner to fragments, which give credit to the actor.

use prost::Message;

use crate::{
    Malformed, PolicyVersion, check_size,
    limits::{SMALL_BYTES_MAX, STEPS_MAX},
    version, wire,
};

/// Outcome of a fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The learner accepted the fragment.
    Accepted,
    /// The learner accepted the fragment before.
    Duplicate,
    /// The lag of its policy exceeds `max_policy_lag`.
    TooOld,
    /// Its policy is unknown: the learner resumed from an older checkpoint, or began the run anew.
    Vanished,
    /// The fragment failed a check, which the reason names.
    Malformed,
    /// The sender is quarantined.
    Quarantined,
    /// The intake is full; the actor sends the fragment again.
    Busy,
    /// The learner is stopping; the actor keeps the fragment for its successor.
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

/// Receipt for one fragment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Receipt {
    /// Outcome of the fragment.
    pub outcome: Outcome,
    /// Error in words; empty without one.
    pub reason: String,
    /// Newest policy version.
    pub version: PolicyVersion,
    /// Sequence number up to which a checkpoint holds every accepted fragment of this actor.
    pub durable_through: u64,
    /// Control steps of the actor's next fragment; 0 means as the policy bundle says.
    pub fragment_steps: u32,
}

impl Receipt {
    /// Encodes as protobuf.
    pub fn encode(&self) -> Vec<u8> {
        let outcome = OUTCOMES.iter().find(|(ours, _)| *ours == self.outcome).map(|(_, wire)| *wire);
        wire::Receipt {
            outcome: outcome.unwrap_or_default().into(),
            reason: self.reason.clone(),
            version: Some(self.version),
            durable_through: self.durable_through,
            fragment_steps: self.fragment_steps,
        }
        .encode_to_vec()
    }

    /// Decodes and checks untrusted protobuf bytes.
    pub fn decode(bytes: &[u8]) -> Result<Self, Malformed> {
        check_size("receipt", bytes.len(), SMALL_BYTES_MAX)?;
        let message = wire::Receipt::decode(bytes).map_err(Malformed::undecodable("receipt"))?;
        let outcome = OUTCOMES
            .iter()
            .find(|(_, wire)| *wire as i32 == message.outcome)
            .map(|(ours, _)| *ours)
            .ok_or_else(|| Malformed::field("outcome", message.outcome, "1 to 8"))?;
        check_fragment_steps(message.fragment_steps)?;
        Ok(Self {
            outcome,
            reason: message.reason,
            version: version::required(message.version)?,
            durable_through: message.durable_through,
            fragment_steps: message.fragment_steps,
        })
    }
}

/// Checks the length of a future fragment; 0 leaves it open.
pub(crate) fn check_fragment_steps(steps: u32) -> Result<(), Malformed> {
    if steps > STEPS_MAX {
        return Err(Malformed::field("fragment_steps", steps, format!("0 to {STEPS_MAX}")));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_outcome_round_trips() {
        for (outcome, _) in OUTCOMES {
            let receipt = Receipt {
                outcome,
                reason: "because".into(),
                version: PolicyVersion::new(1, 2),
                durable_through: 3,
                fragment_steps: 32,
            };
            assert_eq!(Receipt::decode(&receipt.encode()).unwrap(), receipt);
        }
        let long = wire::Receipt { outcome: 1, fragment_steps: STEPS_MAX + 1, ..wire::Receipt::default() };
        assert!(Receipt::decode(&long.encode_to_vec()).unwrap_err().to_string().contains("fragment_steps"));
        assert!(Receipt::decode(&[8, 99]).unwrap_err().to_string().contains("outcome"));
    }
}
