//! What becomes of a fragment: decided in one place, before anything is learnt from it.

use std::{sync::Arc, time::Instant};

use serde::{Deserialize, Serialize};
use treadmill_bus::{
    ReceivedFragment,
    admission::rate_limited_log::RateLimitedLog,
    admission::{Admission, Sender},
};
use treadmill_proto::{Fragment, Malformed, Outcome, Receipt};

use super::{
    ledger::{Fate, Ledger, Rule},
    lineage::{Descent, Lineage},
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
    gate: Arc<Admission>,
    refusals: RateLimitedLog,
    quarantines: RateLimitedLog,
    /// Refused unread for lack of room, since this start.
    turned_away: u64,
    /// Size of the fragments that were taken, since this start.
    accepted_bytes: u64,
    /// What was dealt with.
    pub ledger: Ledger,
    /// Counts.
    pub tally: Tally,
}

impl Judge {
    /// A judge with what a checkpoint remembers, who tells `gate` what he thinks of senders.
    pub fn new(expected: Expected, gate: Arc<Admission>, ledger: Ledger, tally: Tally) -> Self {
        let (refusals, quarantines) = (RateLimitedLog::default(), RateLimitedLog::default());
        Self { expected, gate, refusals, quarantines, turned_away: 0, accepted_bytes: 0, ledger, tally }
    }

    /// Looks at what `actor` sent: the fragment if it is taken, else the receipt that says why not.
    pub fn judge(
        &mut self,
        actor: &str,
        arrival: ReceivedFragment,
        lineage: &Lineage,
        now: Instant,
    ) -> Result<Accepted, Box<Receipt>> {
        let refuse = |outcome, reason: String, durable_through| {
            Box::new(Receipt { outcome, reason, version: lineage.newest(), durable_through })
        };
        // What came through the gate before its sender was put in quarantine.
        let sender = self.gate.identify(actor, arrival.claimed_incarnation);
        if self.gate.holds(&sender, now) {
            self.tally.quarantined += 1;
            let reason = format!("too many refused fragments in a row from `{actor}`; wait a minute");
            return Err(refuse(Outcome::Quarantined, reason, 0));
        }
        let sound = arrival.fragment.and_then(|fragment| self.fits(actor, fragment, lineage));
        let fragment = match sound {
            Ok(fragment) => fragment,
            Err(why) => {
                self.tally.malformed += 1;
                self.refusals.warn(|| format!("a fragment from `{actor}` was refused: {why}"));
                if self.gate.failed(&sender, now) {
                    self.quarantines.warn(|| format!("`{actor}` is put in quarantine"));
                }
                return Err(refuse(Outcome::Malformed, why.to_string(), 0));
            }
        };
        let (incarnation, sequence) = (fragment.actor_incarnation, fragment.sequence);
        if !self.ledger.knows(actor, incarnation) {
            tracing::info!("`{actor}` delivers as process {incarnation}");
        }
        self.ledger.settle(actor, incarnation, fragment.settled_through);
        let durable_through = self.ledger.durable_through(actor, incarnation);
        if let Some(fate) = self.ledger.fate(actor, incarnation, sequence) {
            self.tally.duplicate += 1;
            self.useless(&sender, now);
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
            // The future was refused above.
            Descent::Vanished | Descent::Future => {
                self.tally.vanished += 1;
                self.useless(&sender, now);
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
                self.gate.taken(actor, incarnation, now);
                self.tally.accepted += 1;
                self.accepted_bytes += arrival.bytes as u64;
                Ok(Accepted { fragment, lag })
            }
            Err((_, outcome, reason)) => Err(refuse(outcome, reason, durable_through)),
        }
    }

    fn useless(&self, sender: &Sender, now: Instant) {
        if self.gate.useless(sender, now) {
            let name = sender.name();
            self.quarantines.warn(|| format!("`{name}` is put in quarantine: nothing it sent of late was of use"));
        }
    }

    /// Takes the gate's own counts into the tally.
    pub fn count_unread(&mut self) {
        let unread = self.gate.take_unread();
        self.tally.malformed += unread.malformed;
        self.tally.quarantined += unread.quarantined;
        self.turned_away += unread.turned_away;
    }

    /// Fragments that were refused unread for lack of room, since this start.
    pub fn turned_away(&self) -> u64 {
        self.turned_away
    }

    /// Bytes of the fragments that were taken, since this start.
    pub fn accepted_bytes(&self) -> u64 {
        self.accepted_bytes
    }

    /// Who is in quarantine.
    pub fn quarantined(&self, now: Instant) -> Vec<String> {
        self.gate.held(now)
    }

    fn fits(&self, actor: &str, fragment: Fragment, lineage: &Lineage) -> Result<Fragment, Malformed> {
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
        // A version is saved before it is handed out, so nobody can have one that is yet to come.
        if lineage.descent(fragment.version) == Descent::Future {
            let newest = lineage.newest().number;
            return differ("version", fragment.version.number.to_string(), format!("at most {newest}, the newest"));
        }
        Ok(fragment)
    }
}

#[cfg(test)]
#[path = "judge_tests.rs"]
mod tests;
