//! What becomes of a fragment: decided in one place, before anything is learnt from it.

use bytes::Bytes;
use serde::{Deserialize, Serialize};
use std::time::Instant;
use treadmill_proto::{Fragment, Malformed, Outcome, Receipt};

use super::{
    ledger::{Fate, Ledger, Rule},
    lineage::{Descent, Lineage},
    quarantine::Quarantine,
};

/// What every fragment of a run must agree with.
#[derive(Clone, Debug)]
pub struct Expected {
    /// The run's name.
    pub run: String,
    /// Hash over the configuration and the model.
    pub config_hash: u64,
    /// Entries of one observation.
    pub observation_size: u32,
    /// Entries of one action.
    pub action_size: u32,
    /// Versions that a fragment may be behind.
    pub max_policy_lag: u64,
}

/// Fragments by what became of them, over the whole run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tally {
    /// Taken.
    pub accepted: u64,
    /// Taken before.
    pub duplicate: u64,
    /// Dropped by rule: policy too far back.
    pub too_old: u64,
    /// Dropped by rule: policy unknown after a resume.
    pub vanished: u64,
    /// Refused.
    pub malformed: u64,
    /// Not looked at.
    pub quarantined: u64,
}

/// A fragment that was taken, and how far its policy was behind.
#[derive(Debug)]
pub struct Accepted {
    /// The fragment.
    pub fragment: Fragment,
    /// Versions between its policy and the newest.
    pub lag: u64,
}

/// Decides, and remembers what it decided.
#[derive(Debug)]
pub struct Judge {
    expected: Expected,
    quarantine: Quarantine,
    /// What was dealt with.
    pub ledger: Ledger,
    /// Counts.
    pub tally: Tally,
}

impl Judge {
    /// A judge with what a checkpoint remembers.
    pub fn new(expected: Expected, quarantine_after: u32, ledger: Ledger, tally: Tally) -> Self {
        Self { expected, quarantine: Quarantine::new(quarantine_after), ledger, tally }
    }

    /// Looks at what `actor` sent: the fragment if it is taken, else the receipt that says why not.
    pub fn judge(
        &mut self,
        actor: &str,
        payload: Bytes,
        lineage: &Lineage,
        now: Instant,
    ) -> Result<Accepted, Box<Receipt>> {
        let refuse = |outcome, reason: String, durable_through| {
            Box::new(Receipt { outcome, reason, version: lineage.newest(), durable_through })
        };
        if self.quarantine.holds(actor, now) {
            self.tally.quarantined += 1;
            return Err(refuse(
                Outcome::Quarantined,
                format!("too many refused fragments in a row from `{actor}`; wait a minute"),
                0,
            ));
        }
        let fragment = match Fragment::decode(payload).and_then(|fragment| self.fits(actor, fragment)) {
            Ok(fragment) => fragment,
            Err(why) => {
                self.tally.malformed += 1;
                tracing::warn!("a fragment from `{actor}` was refused: {why}");
                if self.quarantine.failed(actor, now) {
                    tracing::warn!("`{actor}` is put in quarantine");
                }
                return Err(refuse(Outcome::Malformed, why.to_string(), 0));
            }
        };
        self.quarantine.succeeded(actor);
        let (incarnation, sequence) = (fragment.actor_incarnation, fragment.sequence);
        if !self.ledger.knows(actor, incarnation) {
            tracing::info!("`{actor}` delivers as process {incarnation}");
        }
        self.ledger.settle(actor, incarnation, fragment.settled_through);
        let durable_through = self.ledger.durable_through(actor, incarnation);
        if let Some(fate) = self.ledger.fate(actor, incarnation, sequence) {
            self.tally.duplicate += 1;
            // Its receipt got lost: the sender is told what became of it then.
            let (outcome, reason) = match fate {
                Fate::Accepted => (Outcome::Duplicate, String::new()),
                Fate::Dropped(Rule::TooOld) => (Outcome::TooOld, "dropped when it first came".to_string()),
                Fate::Dropped(Rule::Vanished) => (Outcome::Vanished, "dropped when it first came".to_string()),
            };
            return Err(refuse(outcome, reason, durable_through));
        }
        let env_steps = fragment.transitions() as u64;
        let dropped = match lineage.descent(fragment.version) {
            Descent::Vanished => {
                self.tally.vanished += 1;
                let reason = format!("policy version {:?} is not one of this learner's", fragment.version);
                Err((Rule::Vanished, Outcome::Vanished, reason))
            }
            Descent::Lag(lag) if lag > self.expected.max_policy_lag => {
                self.tally.too_old += 1;
                let reason = format!("{lag} versions behind, at most {} are allowed", self.expected.max_policy_lag);
                Err((Rule::TooOld, Outcome::TooOld, reason))
            }
            Descent::Lag(lag) => Ok(lag),
        };
        let fate = dropped.as_ref().map_or_else(|(rule, ..)| Fate::Dropped(*rule), |_| Fate::Accepted);
        self.ledger.insert(actor, incarnation, sequence, fate, env_steps);
        match dropped {
            Ok(lag) => {
                self.tally.accepted += 1;
                Ok(Accepted { fragment, lag })
            }
            Err((_, outcome, reason)) => Err(refuse(outcome, reason, durable_through)),
        }
    }

    /// Who is in quarantine.
    pub fn quarantined(&self, now: Instant) -> Vec<&str> {
        self.quarantine.held(now)
    }

    fn fits(&self, actor: &str, fragment: Fragment) -> Result<Fragment, Malformed> {
        let expected = &self.expected;
        let differ = |field: &'static str, found: String, wanted: String| {
            Err(Malformed::Field { field, value: found, expected: wanted })
        };
        if fragment.run != expected.run {
            return differ("run", format!("`{}`", fragment.run), format!("`{}`", expected.run));
        }
        if fragment.actor != actor {
            return differ("actor", format!("`{}`", fragment.actor), format!("`{actor}`, as the key says"));
        }
        for (field, found, wanted) in [
            ("config_hash", fragment.config_hash, expected.config_hash),
            ("observation_size", fragment.observation_size.into(), expected.observation_size.into()),
            ("action_size", fragment.action_size.into(), expected.action_size.into()),
        ] {
            if found != wanted {
                return differ(field, found.to_string(), format!("{wanted}, as the policy bundle says"));
            }
        }
        Ok(fragment)
    }
}

#[cfg(test)]
#[path = "judge_tests.rs"]
mod tests;
