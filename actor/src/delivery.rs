//! Delivery of fragments: sends each until a receipt settles it, and keeps accepted ones until they are durable.

use std::{
    collections::{BTreeMap, BTreeSet},
    sync::{
        Arc, Mutex, MutexGuard,
        atomic::{AtomicBool, AtomicU32, Ordering},
    },
    time::Duration,
};

use bytes::Bytes;
use treadmill_bus::{Bus, BusError, submit};
use treadmill_proto::{Outcome, Receipt};

use crate::policy_fetcher::{PolicyFetcher, Refresh};

const RETRY: Duration = Duration::from_millis(200);
/// How often that pause doubles while the learner is busy.
const BUSY_DOUBLINGS_MAX: u32 = 4;
/// Pause of a quarantined sender before its next attempt.
const QUARANTINE_RETRY: Duration = Duration::from_secs(10);
/// Retries between two warnings about the same fragment.
const RETRIES_PER_WARNING: u64 = 50;
/// Retries before the first warning: a learner may be restarting.
const RETRIES_BEFORE_NOTICE: u64 = 5;

/// Encoded fragment without a receipt.
#[derive(Clone, Debug)]
pub struct PendingFragment {
    /// Sequence number within this process.
    pub sequence: u64,
    /// Protobuf bytes.
    pub bytes: Bytes,
}

/// Counts of fragments over the life of this process: `produced = accepted + dropped_by_rule + in_flight`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DeliveryCounts {
    /// Handed to the uploader.
    pub produced: u64,
    /// Accepted by the learner.
    pub accepted: u64,
    /// Too old, of a vanished version, or malformed.
    pub dropped_by_rule: u64,
    /// Pending.
    pub in_flight: u64,
    /// Additional times that fragments were sent.
    pub resent: u64,
    /// Accepted, but not yet part of a checkpoint.
    pub awaiting_durability: u64,
}

/// Sends the fragments of one actor process.
pub struct Uploader {
    bus: Bus,
    run: String,
    actor: String,
    receipt_timeout: Duration,
    policies: Arc<PolicyFetcher>,
    /// Control steps of the next fragment.
    fragment_steps: AtomicU32,
    notify: fn(&str),
    /// Whether the user was notified that no learner answers.
    is_lost: AtomicBool,
    state: Mutex<DeliveryState>,
}

/// State of every fragment.
#[derive(Default)]
struct DeliveryState {
    /// Learner that accepted `awaiting_durability`.
    incarnation: u64,
    produced: u64,
    accepted: u64,
    dropped_by_rule: u64,
    resent: u64,
    /// Sequence numbers of pending fragments.
    pending: BTreeSet<u64>,
    /// Accepted fragments that no checkpoint holds yet. Each update makes them durable, so they number at most a batch plus
    /// the pending fragments.
    awaiting_durability: BTreeMap<u64, Bytes>,
    /// Highest sequence number.
    newest: u64,
}

/// Action that a receipt asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum NextStep {
    Settle,
    RetryAfter(Duration),
}

impl Uploader {
    /// Creates the uploader of one actor process, whose first fragment has `fragment_steps`.
    pub fn new(
        bus: Bus,
        run: &str,
        actor: &str,
        receipt_timeout: Duration,
        policies: Arc<PolicyFetcher>,
        fragment_steps: u32,
    ) -> Self {
        let incarnation = policies.current().version.incarnation;
        Self {
            bus,
            run: run.to_string(),
            actor: actor.to_string(),
            receipt_timeout,
            policies,
            fragment_steps: fragment_steps.into(),
            notify: |_| {},
            is_lost: AtomicBool::new(false),
            state: Mutex::new(DeliveryState { incarnation, ..DeliveryState::default() }),
        }
    }

    /// Notifies the user when no learner answers, and when one answers again.
    #[must_use]
    pub fn with_notices(mut self, notify: fn(&str)) -> Self {
        self.notify = notify;
        self
    }

    /// Returns the control steps of the next fragment.
    pub fn fragment_steps(&self) -> u32 {
        self.fragment_steps.load(Ordering::Relaxed)
    }

    /// Returns the present counts.
    pub fn counts(&self) -> DeliveryCounts {
        let state = self.state();
        DeliveryCounts {
            produced: state.produced,
            accepted: state.accepted,
            dropped_by_rule: state.dropped_by_rule,
            in_flight: state.pending.len() as u64,
            resent: state.resent,
            awaiting_durability: state.awaiting_durability.len() as u64,
        }
    }

    /// Returns the highest sequence number up to which every fragment is durable or dropped.
    pub fn settled_through(&self) -> u64 {
        let state = self.state();
        let open = [state.pending.first(), state.awaiting_durability.keys().next()].into_iter().flatten().min();
        open.map_or(state.newest, |first| first - 1)
    }

    /// Registers a produced fragment, which is then pending.
    pub fn register(&self, sequence: u64) {
        let mut state = self.state();
        state.produced += 1;
        state.newest = sequence;
        state.pending.insert(sequence);
        tracing::debug!(sequence, "fragment produced");
    }

    /// Sends one fragment until it is settled, then fetches the policy that its receipt names.
    pub async fn deliver(&self, fragment: PendingFragment) -> Result<Refresh, BusError> {
        let receipt = self.send_until_settled(&fragment.bytes).await?;
        if receipt.outcome == Outcome::Malformed {
            tracing::error!(actor = %self.actor, sequence = fragment.sequence, reason = %receipt.reason, "fragment rejected");
        }
        if receipt.fragment_steps > 0 {
            self.fragment_steps.store(receipt.fragment_steps, Ordering::Relaxed);
        }
        self.state().settle(fragment, &receipt);
        let refresh = self.policies.refresh(Some(receipt.version)).await;
        self.resend_to_new_learner().await?;
        Ok(refresh)
    }

    fn state(&self) -> MutexGuard<'_, DeliveryState> {
        self.state.lock().expect("no holder of this lock panics")
    }

    /// Sends accepted fragments again after a restart of the learner, which knows only the durable ones. The learner
    /// recognises duplicates by their sequence number.
    async fn resend_to_new_learner(&self) -> Result<(), BusError> {
        let incarnation = self.policies.current().version.incarnation;
        let pending: Vec<PendingFragment> = {
            let mut state = self.state();
            if state.incarnation == incarnation {
                return Ok(());
            }
            state.incarnation = incarnation;
            let accepted = std::mem::take(&mut state.awaiting_durability);
            state.accepted -= accepted.len() as u64;
            state.resent += accepted.len() as u64;
            state.pending.extend(accepted.keys());
            accepted.into_iter().map(|(sequence, bytes)| PendingFragment { sequence, bytes }).collect()
        };
        for fragment in pending {
            let receipt = self.send_until_settled(&fragment.bytes).await?;
            self.state().settle(fragment, &receipt);
        }
        Ok(())
    }

    async fn send_until_settled(&self, bytes: &Bytes) -> Result<Receipt, BusError> {
        let (mut retries, mut busy) = (0u64, 0u32);
        let settles = |receipt: &Receipt| {
            self.policies.admits(receipt.version) && next_step(receipt.outcome, 0) == NextStep::Settle
        };
        let mut newest_epoch = self.policies.newest_epoch();
        loop {
            let (run, actor) = (&self.run, &self.actor);
            newest_epoch.mark_unchanged();
            let answer = tokio::select! {
                answer = submit(&self.bus, run, actor, bytes.clone(), self.receipt_timeout, settles) => answer?,
                // The learner that it was sent to may be gone without a trace.
                _ = newest_epoch.changed() => None,
            };
            let is_silent = answer.is_none();
            let (pause, reason) = match answer {
                None => (RETRY, "no learner answers".to_string()),
                // Its acceptance would never become durable.
                Some(receipt) if !self.policies.admits(receipt.version) => {
                    (RETRY, "a learner answers that another one has overtaken".to_string())
                }
                Some(receipt) => {
                    if self.is_lost.swap(false, Ordering::Relaxed) {
                        (self.notify)("the learner answers again");
                    }
                    let step = next_step(receipt.outcome, busy);
                    busy = if receipt.outcome == Outcome::Busy { busy + 1 } else { 0 };
                    match step {
                        NextStep::Settle => return Ok(receipt),
                        NextStep::RetryAfter(pause) => (pause, receipt.reason),
                    }
                }
            };
            if is_silent && retries == RETRIES_BEFORE_NOTICE && !self.is_lost.swap(true, Ordering::Relaxed) {
                let pending = self.state().pending.len();
                (self.notify)(&format!("no learner answers; keeping {pending} fragments and trying again"));
            }
            if retries % RETRIES_PER_WARNING == RETRIES_BEFORE_NOTICE {
                tracing::warn!(actor = %self.actor, %reason, "keeping fragments and retrying");
            }
            tokio::time::sleep(pause).await;
            retries += 1;
            self.state().resent += 1;
        }
    }
}

impl DeliveryState {
    /// Records the outcome of a fragment and releases the durable ones.
    fn settle(&mut self, fragment: PendingFragment, receipt: &Receipt) {
        self.pending.remove(&fragment.sequence);
        if matches!(receipt.outcome, Outcome::Accepted | Outcome::Duplicate) {
            self.accepted += 1;
            self.awaiting_durability.insert(fragment.sequence, fragment.bytes);
        } else {
            self.dropped_by_rule += 1;
        }
        self.awaiting_durability.retain(|sequence, _| *sequence > receipt.durable_through);
    }
}

/// Returns what an outcome asks for, after `busy` attempts in a row that found the learner busy.
fn next_step(outcome: Outcome, busy: u32) -> NextStep {
    match outcome {
        Outcome::Accepted | Outcome::Duplicate | Outcome::TooOld | Outcome::Vanished | Outcome::Malformed => {
            NextStep::Settle
        }
        // A learner that is paused or waits for its disk stays busy, and each attempt carries the whole fragment.
        Outcome::Busy => NextStep::RetryAfter(RETRY * (1 << busy.min(BUSY_DOUBLINGS_MAX))),
        Outcome::Stopping => NextStep::RetryAfter(RETRY),
        Outcome::Quarantined => NextStep::RetryAfter(QUARANTINE_RETRY),
    }
}

#[cfg(test)]
mod tests {
    use treadmill_proto::PolicyVersion;

    use super::*;

    fn receipt(outcome: Outcome, durable_through: u64) -> Receipt {
        Receipt {
            outcome,
            reason: String::new(),
            version: PolicyVersion::default(),
            durable_through,
            fragment_steps: 0,
        }
    }

    #[test]
    fn accepted_fragments_are_kept_until_durable() {
        let mut state =
            DeliveryState { pending: (1..=3).collect(), produced: 3, newest: 3, ..DeliveryState::default() };
        let fragment = |sequence| PendingFragment { sequence, bytes: Bytes::new() };
        state.settle(fragment(2), &receipt(Outcome::Accepted, 0));
        assert_eq!(state.awaiting_durability.keys().copied().collect::<Vec<_>>(), [2]);
        state.settle(fragment(1), &receipt(Outcome::TooOld, 0));
        state.settle(fragment(3), &receipt(Outcome::Duplicate, 2));
        let kept: Vec<u64> = state.awaiting_durability.keys().copied().collect();
        assert_eq!(kept, [3], "2 is part of a checkpoint, 1 was dropped");
        assert_eq!((state.accepted, state.dropped_by_rule, state.pending.len()), (2, 1, 0));
    }

    #[test]
    fn only_a_final_outcome_settles_a_fragment() {
        for outcome in [Outcome::Accepted, Outcome::Duplicate, Outcome::TooOld, Outcome::Vanished, Outcome::Malformed] {
            assert_eq!(next_step(outcome, 0), NextStep::Settle);
        }
        for outcome in [Outcome::Busy, Outcome::Stopping, Outcome::Quarantined] {
            assert!(matches!(next_step(outcome, 0), NextStep::RetryAfter(_)));
        }
        let pauses = [0, 1, 4, 5, u32::MAX].map(|busy| next_step(Outcome::Busy, busy));
        assert_eq!(pauses, [1, 2, 16, 16, 16].map(|times| NextStep::RetryAfter(RETRY * times)));
    }
}
