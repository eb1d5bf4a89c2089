//! Drives the delivery of fragments over the bus; [`Delivery`] decides what is sent when.

use std::{
    sync::{
        Arc, Mutex, MutexGuard,
        atomic::{AtomicU32, Ordering},
    },
    time::Duration,
};

use bytes::Bytes;
use treadmill_bus::{Bus, BusError, actor::submit};
use treadmill_experience::delivery::{Action, Attempt, Delivery, DeliveryCounts, Event, settles};
use treadmill_proto::{ActorStats, Outcome, Receipt};
use treadmill_runtime::{machine, program};

use crate::policy_fetcher::{PolicyFetcher, Refresh};

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
    delivery: Mutex<Delivery>,
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
            delivery: Mutex::new(Delivery::new(incarnation)),
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
        self.delivery().counts()
    }

    /// Returns the statistics of this process and its deliveries; the caller adds those of what it simulates.
    pub fn stats(&self) -> ActorStats {
        let counts = self.counts();
        ActorStats {
            actor: self.actor.clone(),
            host: machine::host_name(),
            pid: std::process::id(),
            version: Some(self.policies.current().version),
            produced: counts.produced,
            accepted: counts.accepted,
            dropped_by_rule: counts.dropped_by_rule,
            in_flight: counts.in_flight,
            resent: counts.resent,
            awaiting_durability: counts.awaiting_durability,
            resident_bytes: machine::resident_bytes(),
            program_version: program::version().to_string(),
            ..ActorStats::default()
        }
    }

    /// Returns the highest number up to which every fragment is durable or dropped.
    pub fn settled_through(&self) -> u64 {
        self.delivery().settled_through()
    }

    /// Registers a produced fragment, which is then pending.
    pub fn produced(&self, sequence: u64, bytes: Bytes) -> Attempt {
        tracing::debug!(sequence, "fragment produced");
        self.delivery().produce(sequence, bytes)
    }

    /// Delivers one fragment until it is settled, then fetches the policy that its receipt names.
    pub async fn deliver(&self, first: Attempt) -> Result<Refresh, BusError> {
        let receipt = self.settle(first).await?;
        self.adopt(&receipt).await
    }

    /// Sets the length of the next fragment as a receipt says, and fetches the policy that it names.
    pub async fn adopt(&self, receipt: &Receipt) -> Result<Refresh, BusError> {
        if receipt.fragment_steps > 0 {
            self.fragment_steps.store(receipt.fragment_steps, Ordering::Relaxed);
        }
        let refresh = self.policies.refresh(Some(receipt.version)).await;
        let incarnation = self.policies.current().version.incarnation;
        for attempt in self.handle(Event::Adopted { incarnation }) {
            self.settle(attempt).await?;
        }
        Ok(refresh)
    }

    fn delivery(&self) -> MutexGuard<'_, Delivery> {
        self.delivery.lock().expect("no holder of this lock panics")
    }

    /// Takes an event, reports, and returns the attempts that follow.
    fn handle(&self, event: Event) -> Vec<Attempt> {
        let actions = self.delivery().handle(event);
        let mut attempts = Vec::new();
        for action in actions {
            match action {
                Action::Send(attempt) => attempts.push(attempt),
                Action::Settled { .. } => {}
                Action::Warn { reason } => {
                    tracing::warn!(actor = %self.actor, %reason, "keeping fragments and retrying");
                }
                Action::Lost { pending } => {
                    (self.notify)(&format!("no learner answers; keeping {pending} fragments and trying again"));
                }
                Action::Found => (self.notify)("the learner answers again"),
            }
        }
        attempts
    }

    /// Makes attempts until one settles the fragment. Returns its receipt.
    pub async fn settle(&self, first: Attempt) -> Result<Receipt, BusError> {
        let settles = |receipt: &Receipt| self.policies.admits(receipt.version) && settles(receipt.outcome);
        let mut newest_epoch = self.policies.newest_epoch();
        let mut next = first;
        loop {
            let Attempt { sequence, bytes, pause } = next;
            if !pause.is_zero() {
                tokio::time::sleep(pause).await;
            }
            let epoch = *newest_epoch.borrow_and_update();
            self.handle(Event::Heard { epoch });
            let answer = tokio::select! {
                answer = submit(&self.bus, &self.run, &self.actor, bytes, self.receipt_timeout, settles) => answer?,
                // The learner that it was sent to may be gone without a trace.
                _ = newest_epoch.changed() => None,
            };
            let event = match &answer {
                Some(receipt) => Event::Answered { sequence, receipt: receipt.clone() },
                None => Event::Silent { sequence },
            };
            match (self.handle(event).pop(), answer) {
                (Some(attempt), _) => next = attempt,
                (None, Some(receipt)) => {
                    if receipt.outcome == Outcome::Malformed {
                        tracing::error!(actor = %self.actor, sequence, reason = %receipt.reason, "fragment rejected");
                    }
                    return Ok(receipt);
                }
                // Only a receipt settles a fragment.
                (None, None) => unreachable!("silence asks for another attempt"),
            }
        }
    }
}
