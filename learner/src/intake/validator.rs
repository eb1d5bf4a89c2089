//! Accepts or rejects each fragment before the learner uses it.

use std::{sync::Arc, time::Instant};

use serde::{Deserialize, Serialize};
use treadmill_bus::learner::{Admission, RateLimitedLog, ReceivedFragment, Sender};
use treadmill_experience::{
    ledger::{DropRule, KnownFragment, Ledger, LedgerEntry},
    lineage::{Descent, Lineage},
};
use treadmill_ppo::{AcceptedFragment, Implausible};
use treadmill_proto::{Fragment, Malformed, Outcome, Receipt};

use super::rejections::Rejections;

/// Properties that every fragment of a run must have.
#[derive(Clone, Debug)]
pub struct ExpectedFragment {
    /// Name of the run.
    pub run: String,
    /// Hash of the configuration and the model.
    pub config_hash: u64,
    /// Entries of one observation.
    pub observation_size: u32,
    /// Entries of one action.
    pub action_size: u32,
    /// Largest allowed lag in versions.
    pub max_policy_lag: u64,
    /// Version of the physics; 0 accepts any, as runs of external tasks do.
    pub physics_version: u32,
}

/// Number of fragments by outcome, over the whole run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FragmentCounts {
    /// Accepted.
    pub accepted: u64,
    /// Accepted before.
    pub duplicate: u64,
    /// Dropped by rule: policy too old.
    pub too_old: u64,
    /// Dropped by rule: policy unknown after a resume.
    pub vanished: u64,
    /// Rejected as malformed.
    pub malformed: u64,
    /// Rejected unread, because the sender is in quarantine.
    pub quarantined: u64,
    /// Rejected because a value is no plausible experience of the run.
    pub implausible: u64,
}

/// Validates fragments against the checkpoint's ledger, and reports bad senders to admission control.
#[derive(Debug)]
pub struct FragmentValidator {
    expected: ExpectedFragment,
    admission: Arc<Admission>,
    malformed_log: RateLimitedLog,
    implausible_log: RateLimitedLog,
    quarantine_log: RateLimitedLog,
    /// Number of fragments rejected unread because the queue was full, since this start.
    pub turned_away: u64,
    /// Size of the accepted fragments in bytes, since this start.
    pub accepted_bytes: u64,
    /// Senders of rejected fragments, since this start.
    pub rejections: Rejections,
    /// Handled fragments.
    pub ledger: Ledger,
    /// Fragments by outcome.
    pub counts: FragmentCounts,
}

impl FragmentValidator {
    /// Validator that continues with a checkpoint's ledger and counts.
    pub fn new(expected: ExpectedFragment, admission: Arc<Admission>, ledger: Ledger, counts: FragmentCounts) -> Self {
        Self {
            expected,
            admission,
            malformed_log: RateLimitedLog::default(),
            implausible_log: RateLimitedLog::default(),
            quarantine_log: RateLimitedLog::default(),
            turned_away: 0,
            accepted_bytes: 0,
            rejections: Rejections::default(),
            ledger,
            counts,
        }
    }

    /// Returns the largest allowed lag in versions.
    pub fn max_policy_lag(&self) -> u64 {
        self.expected.max_policy_lag
    }

    /// Returns the hash of what actors depend on, which does not change during a run.
    pub fn config_hash(&self) -> u64 {
        self.expected.config_hash
    }

    /// Validates a fragment that `actor` sent. Returns it if it is accepted, else the receipt with the reason.
    pub fn validate(
        &mut self,
        actor: &str,
        received: ReceivedFragment,
        lineage: &Lineage,
        now: Instant,
    ) -> Result<AcceptedFragment, Box<Receipt>> {
        let version = lineage.newest();
        let rejection = |outcome, reason: String, durable_through| {
            Box::new(Receipt { outcome, reason, version, durable_through, fragment_steps: 0 })
        };
        // The fragment may have been queued before its sender was put in quarantine.
        let sender = self.admission.identify(actor, received.claimed_incarnation);
        if self.admission.is_quarantined(&sender, now) {
            self.counts.quarantined += 1;
            let reason = format!("`{actor}` is in quarantine for up to 60 s");
            return Err(rejection(Outcome::Quarantined, reason, 0));
        }
        let checked = received.fragment.and_then(|fragment| self.check(actor, fragment, lineage));
        let fragment = checked.map_err(|why| {
            self.report_malformed(actor, &sender, &why, now);
            rejection(Outcome::Malformed, why.to_string(), 0)
        })?;
        let (incarnation, sequence) = (fragment.actor_incarnation, fragment.sequence);
        let KnownFragment { is_new_process, durable_through, entry } =
            self.ledger.look_up(actor, incarnation, sequence, fragment.settled_through);
        if is_new_process {
            let wire_version = fragment.wire_version;
            tracing::info!(%actor, incarnation, wire_version, "first fragment of an actor process");
        }
        if let Some(entry) = entry {
            self.counts.duplicate += 1;
            self.report_useless(&sender, now);
            // The first receipt was lost: the sender gets the same outcome again.
            let (outcome, reason) = match entry {
                LedgerEntry::Accepted => (Outcome::Duplicate, ""),
                LedgerEntry::Dropped(DropRule::TooOld) => (Outcome::TooOld, "dropped when first received"),
                LedgerEntry::Dropped(DropRule::Vanished) => (Outcome::Vanished, "dropped when first received"),
            };
            return Err(rejection(outcome, reason.to_string(), durable_through));
        }
        let env_steps = fragment.transitions() as u64;
        let lag = self.check_lag(&fragment, lineage, &sender, now);
        let entry = lag.as_ref().map_or_else(|(rule, ..)| LedgerEntry::Dropped(*rule), |_| LedgerEntry::Accepted);
        self.ledger.insert(actor, incarnation, sequence, entry, env_steps);
        match lag {
            Ok(lag) => {
                self.admission.record_accepted(actor, incarnation, now);
                self.counts.accepted += 1;
                self.accepted_bytes += received.bytes as u64;
                Ok(AcceptedFragment { fragment, lag })
            }
            Err((_, outcome, reason)) => Err(rejection(outcome, reason, durable_through)),
        }
    }

    /// Reports a malformed fragment, which may put its sender in quarantine.
    fn report_malformed(&mut self, actor: &str, sender: &Sender, why: &Malformed, now: Instant) {
        self.counts.malformed += 1;
        if self.rejections.record(actor, &why.to_string(), now) {
            self.malformed_log.emit(|| tracing::warn!(%actor, error = %why, "fragment rejected"));
        }
        if self.admission.record_malformed(sender, now) {
            self.quarantine_log.emit(|| tracing::warn!(%actor, "sender quarantined"));
        }
    }

    /// Reports an accepted fragment that the learner did not learn from, which may put its sender in quarantine.
    pub fn report_implausible(&mut self, fragment: &Fragment, why: &Implausible, now: Instant) {
        self.counts.implausible += 1;
        let (actor, sequence) = (&fragment.actor, fragment.sequence);
        if self.rejections.record(actor, &why.to_string(), now) {
            self.implausible_log.emit(|| tracing::warn!(%actor, sequence, error = %why, "fragment not learnt from"));
        }
        let sender = self.admission.identify(actor, Some(fragment.actor_incarnation));
        if self.admission.record_implausible(&sender, now) {
            self.quarantine_log.emit(|| tracing::warn!(%actor, "sender quarantined: implausible fragments in a row"));
        }
    }

    /// Reports a fragment that the learner learnt from, so that earlier implausible ones of its sender no longer count.
    pub fn report_learnt(&self, fragment: &Fragment) {
        self.admission.record_learnt(&self.admission.identify(&fragment.actor, Some(fragment.actor_incarnation)));
    }

    /// Returns the lag of a well-formed fragment, or the rule by which it is dropped.
    fn check_lag(
        &mut self,
        fragment: &Fragment,
        lineage: &Lineage,
        sender: &Sender,
        now: Instant,
    ) -> Result<u64, (DropRule, Outcome, String)> {
        match lineage.descent(fragment.version) {
            // `check` has rejected versions of the future.
            Descent::Vanished | Descent::Future => {
                self.counts.vanished += 1;
                self.report_useless(sender, now);
                let reason = format!("policy version {:?} is not an ancestor of the newest", fragment.version);
                Err((DropRule::Vanished, Outcome::Vanished, reason))
            }
            Descent::Lag(lag) if lag > self.expected.max_policy_lag => {
                self.counts.too_old += 1;
                let reason = format!("{lag} versions behind, at most {} are allowed", self.expected.max_policy_lag);
                Err((DropRule::TooOld, Outcome::TooOld, reason))
            }
            Descent::Lag(lag) => Ok(lag),
        }
    }

    /// Reports a duplicate or a fragment of an unknown policy, which may put its sender in quarantine.
    fn report_useless(&self, sender: &Sender, now: Instant) {
        if self.admission.record_useless(sender, now) {
            self.quarantine_log.emit(|| {
                tracing::warn!(actor = %sender.name(), "sender quarantined: too many duplicate or vanished fragments");
            });
        }
    }

    /// Adds the fragments that admission control rejected unread to the counts.
    pub fn count_unread(&mut self) {
        let unread = self.admission.take_unread();
        self.counts.malformed += unread.malformed;
        self.counts.quarantined += unread.quarantined;
        self.turned_away += unread.turned_away;
    }

    /// Returns the senders in quarantine.
    pub fn quarantined(&self, now: Instant) -> Vec<String> {
        self.admission.quarantined(now)
    }

    /// Checks that a fragment belongs to this run and was sent by `actor`.
    fn check(&self, actor: &str, fragment: Fragment, lineage: &Lineage) -> Result<Fragment, Malformed> {
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
        // It may be of a run that was begun anew under this name, which differs in what follows. `check_lag` drops it.
        if lineage.descent(fragment.version) == Descent::Vanished {
            return Ok(fragment);
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
        let (found, wanted) = (fragment.physics_version, expected.physics_version);
        if wanted != 0 && found != wanted {
            let wanted = format!("{wanted}, the physics of the run: use the same version of treadmill");
            return differ("physics_version", found.to_string(), wanted);
        }
        // A version is saved before it is published, so no actor can have a later one.
        if lineage.descent(fragment.version) == Descent::Future {
            let newest = lineage.newest().number;
            return differ("version", fragment.version.number.to_string(), format!("at most {newest}, the newest"));
        }
        Ok(fragment)
    }
}

#[cfg(test)]
#[path = "validator_tests.rs"]
mod tests;
