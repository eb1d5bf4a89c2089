//! Intake: validates fragments from the bus, sends receipts, and collects batches.
//!
//! A receipt returns the sender's credit. In mode [`LearnerMode::Sync`], batches hold only fragments of the newest
//! policy: the learner owes the receipts until it has published the next policy, so that senders continue with it. It
//! never waits for one particular actor: once every actor has delivered, or the stragglers' time is up, it sends the
//! receipts, and the other actors fill the batch. In mode [`LearnerMode::Async`], it answers accepted fragments at once.
//!
//! A fragment's stages here: received, accepted, batch. *Incoming* is a received fragment that waits for its receipt.
//!
//! # Layout
//! - Here: [`Intake`], which collects batches.
//! - `source`: [`FragmentSource`], where fragments come from.
//! - `validator`: [`FragmentValidator`], which accepts or rejects a fragment.
//! - `ledger`: [`Ledger`], the handled fragments of every actor process.
//! - [`ledger_report`]: the ledger as a file.
//! - `lineage`: [`Lineage`], the policy versions that the newest descends from.
//! - `straggler`: limits the wait for stragglers.

mod ledger;
pub mod ledger_report;
mod lineage;
mod source;
mod straggler;
mod validator;

use std::{collections::BTreeSet, time::Duration};

use treadmill_config::LearnerMode;
use treadmill_ppo::AcceptedFragment;
use treadmill_proto::{Outcome, Receipt};
use treadmill_runtime::shutdown::Shutdown;

pub use ledger::{Account, ActorProcess, DropRule, Ledger, LedgerEntry};
pub use lineage::{Descent, Lineage};
pub use source::{BusFragmentSource, FragmentSource};
use straggler::StragglerPolicy;
pub use validator::{ExpectedFragment, FragmentCounts, FragmentValidator};

/// Longest wait for a fragment between two checks for shutdown and interruption.
const TICK: Duration = Duration::from_millis(20);

/// Collects batches.
pub struct Intake<S: FragmentSource> {
    source: S,
    mode: LearnerMode,
    /// Validator, with the ledger and the counts.
    pub validator: FragmentValidator,
    stragglers: StragglerPolicy,
    owed: Vec<OwedReceipt<S::Incoming>>,
    /// Fragment that came when a batch was already full.
    queued: Option<S::Incoming>,
    /// Fragments of the next batch so far, and their transitions.
    accepted: Vec<AcceptedFragment>,
    transitions: usize,
    /// Actors that were alive at the last poll.
    present: BTreeSet<String>,
}

/// Result of [`Intake::collect`].
#[derive(Debug)]
pub enum Collected {
    /// A batch is complete.
    Batch(CollectedBatch),
    /// `interrupt` returned true.
    Interrupted,
    /// Shutdown was requested.
    Stopped,
}

/// Accepted fragment whose receipt is still owed.
struct OwedReceipt<I> {
    incoming: I,
    incarnation: u64,
}

/// Size of a batch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BatchSize {
    /// Transitions that the intake waits for.
    pub transitions: usize,
    /// Transitions that it takes without waiting, while fragments are queued.
    pub transitions_max: usize,
}

/// Fragments of one update.
#[derive(Debug)]
pub struct CollectedBatch {
    /// Whole fragments, sorted by sender and sequence number, so that their arrival order does not matter.
    pub fragments: Vec<AcceptedFragment>,
    /// Whether more fragments are queued.
    pub has_backlog: bool,
}

impl<S: FragmentSource> Intake<S> {
    /// Intake that takes its fragments from `source`.
    pub fn new(source: S, mode: LearnerMode, validator: FragmentValidator) -> Self {
        let stragglers = StragglerPolicy::new(source.now());
        Self {
            source,
            mode,
            validator,
            stragglers,
            owed: Vec::new(),
            queued: None,
            accepted: Vec::new(),
            transitions: 0,
            present: BTreeSet::new(),
        }
    }

    /// Returns the names of the actors that are alive.
    pub fn alive(&self) -> BTreeSet<String> {
        self.source.actors()
    }

    /// Collects whole fragments until they have `size.transitions`, shutdown is requested, or `interrupt` returns true.
    /// After an interruption, the next call continues with the fragments collected so far.
    pub fn collect(
        &mut self,
        size: BatchSize,
        lineage: &Lineage,
        shutdown: &Shutdown,
        mut interrupt: impl FnMut() -> bool,
    ) -> Collected {
        while self.transitions < size.transitions {
            if shutdown.asked() {
                return Collected::Stopped;
            }
            if interrupt() {
                return Collected::Interrupted;
            }
            if let Some(accepted) = self.next(TICK, lineage) {
                self.stragglers.record_delivery(&accepted.fragment.actor, self.source.now());
                self.add(accepted);
            }
            let present = self.poll_actors();
            if self.transitions < size.transitions && self.stragglers.is_round_over(&present, self.source.now()) {
                self.send_owed_receipts(lineage);
            }
        }
        while self.transitions < size.transitions_max
            && let Some(accepted) = self.next(Duration::ZERO, lineage)
        {
            self.add(accepted);
        }
        if self.queued.is_none() {
            self.queued = self.source.next(Duration::ZERO);
        }
        self.transitions = 0;
        let mut fragments = std::mem::take(&mut self.accepted);
        fragments.sort_by(|AcceptedFragment { fragment: a, .. }, AcceptedFragment { fragment: b, .. }| {
            (&a.actor, a.actor_incarnation, a.sequence).cmp(&(&b.actor, b.actor_incarnation, b.sequence))
        });
        Collected::Batch(CollectedBatch { fragments, has_backlog: self.queued.is_some() })
    }

    fn add(&mut self, accepted: AcceptedFragment) {
        self.transitions += accepted.fragment.transitions();
        self.accepted.push(accepted);
    }

    /// Returns the names of the actors that are alive; logs those that joined or left.
    fn poll_actors(&mut self) -> BTreeSet<String> {
        let present = self.source.actors();
        if present != self.present {
            present.difference(&self.present).for_each(|actor| tracing::info!(%actor, "actor joined"));
            self.present.difference(&present).for_each(|actor| tracing::info!(%actor, "actor left"));
            self.present = present.clone();
        }
        present
    }

    fn next(&mut self, timeout: Duration, lineage: &Lineage) -> Option<AcceptedFragment> {
        let incoming = match self.queued.take() {
            Some(incoming) => incoming,
            None => self.source.next(timeout)?,
        };
        self.receive(incoming, lineage)
    }

    /// Validates one fragment. Answers it at once if it is rejected, or if it is accepted in asynchronous mode.
    fn receive(&mut self, mut incoming: S::Incoming, lineage: &Lineage) -> Option<AcceptedFragment> {
        let received = S::take(&mut incoming)?;
        let now = self.source.now();
        match self.validator.validate(S::actor(&incoming), received, lineage, now) {
            Ok(accepted) => {
                self.source.copy(&mut incoming);
                let owed = OwedReceipt { incoming, incarnation: accepted.fragment.actor_incarnation };
                match self.mode {
                    LearnerMode::Sync => self.owed.push(owed),
                    LearnerMode::Async => self.answer(owed, lineage),
                }
                Some(accepted)
            }
            Err(receipt) => {
                S::answer(incoming, &receipt);
                None
            }
        }
    }

    /// Sends every owed receipt, so that the senders continue with the newest policy.
    pub fn send_owed_receipts(&mut self, lineage: &Lineage) {
        for owed in std::mem::take(&mut self.owed) {
            self.answer(owed, lineage);
        }
        self.stragglers.begin_round(self.source.now());
    }

    fn answer(&self, OwedReceipt { incoming, incarnation }: OwedReceipt<S::Incoming>, lineage: &Lineage) {
        let durable_through = self.validator.ledger.durable_through(S::actor(&incoming), incarnation);
        let (outcome, version) = (Outcome::Accepted, lineage.newest());
        S::answer(incoming, &Receipt { outcome, reason: String::new(), version, durable_through, fragment_steps: 0 });
    }

    /// Answers every waiting sender that the learner is stopping. No checkpoint holds those fragments, so the senders
    /// keep them for the next learner.
    pub fn stop(&mut self, lineage: &Lineage) {
        let receipt = Receipt {
            outcome: Outcome::Stopping,
            reason: "the learner is stopping".to_string(),
            version: lineage.newest(),
            durable_through: 0,
            fragment_steps: 0,
        };
        let owed = std::mem::take(&mut self.owed).into_iter().map(|owed| owed.incoming);
        let mut waiting: Vec<S::Incoming> = owed.chain(self.queued.take()).collect();
        waiting.extend(std::iter::from_fn(|| self.source.next(Duration::ZERO)));
        waiting.into_iter().for_each(|incoming| S::answer(incoming, &receipt));
    }
}
