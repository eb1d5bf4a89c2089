//! Fragments from the bus: validated, answered, collected into a batch.
//!
//! A receipt is the sender's credit. Where a batch is to be of the newest policy alone ([`LearnerMode::Sync`]), the
//! learner owes receipts until it has learnt from the batch and published the next policy, so that senders continue with
//! the newest. It never waits for one particular actor: once every actor has delivered, or the stragglers' time is up, it
//! sends the receipts and the other actors fill the batch. Where older policies may take part ([`LearnerMode::Async`]), a
//! fragment is answered as soon as it is accepted.
//!
//! # Layout
//! - Here: [`Intake`], which collects batches.
//! - `source`: [`FragmentSource`], where fragments come from.
//! - `validator`: [`FragmentValidator`], which accepts or rejects a fragment.
//! - `ledger`: [`Ledger`], which fragments of every actor process were dealt with.
//! - [`ledger_report`]: the ledger as a file.
//! - `lineage`: [`Lineage`], which policy versions this learner descends from.
//! - `straggler`: how long the other actors wait for a straggler.

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
pub use source::{BusFragmentSource, FragmentMessage, FragmentSource};
use straggler::StragglerPolicy;
pub use validator::{ExpectedFragment, FragmentCounts, FragmentValidator};

/// Longest wait for a fragment between two checks for shutdown and interruption.
const TICK: Duration = Duration::from_millis(20);

/// Collects batches.
pub struct Intake<S: FragmentSource> {
    source: S,
    mode: LearnerMode,
    validator: FragmentValidator,
    stragglers: StragglerPolicy,
    owed: Vec<OwedReceipt<S::Message>>,
    /// Fragment that came when a batch was full already.
    queued: Option<S::Message>,
    /// Fragments of the next batch so far, and their transitions.
    accepted: Vec<AcceptedFragment>,
    transitions: usize,
    /// Actors that were alive at the last poll.
    present: BTreeSet<String>,
}

/// How collecting ended.
#[derive(Debug)]
pub enum Collected {
    /// There is a batch.
    Batch(CollectedBatch),
    /// The caller interrupted it.
    Interrupted,
    /// Shutdown was requested.
    Stopped,
}

/// Accepted fragment whose receipt is still owed.
struct OwedReceipt<M> {
    message: M,
    incarnation: u64,
}

/// Size of a batch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BatchSize {
    /// Transitions that the intake waits for.
    pub transitions: usize,
    /// Transitions that it takes while fragments are queued, without waiting.
    pub transitions_max: usize,
}

/// Fragments of one update.
#[derive(Debug)]
pub struct CollectedBatch {
    /// Whole fragments, ordered by sender and sequence number, so that the result does not depend on their arrival order.
    pub fragments: Vec<AcceptedFragment>,
    /// Whether more fragments are queued than the batch takes.
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

    /// The validator, with its ledger and counts.
    pub fn validator(&self) -> &FragmentValidator {
        &self.validator
    }

    /// Adds fragments that were rejected unread to the counts.
    pub fn count_unread(&mut self) {
        self.validator.count_unread();
    }

    /// Names of the actors that are alive.
    pub fn alive(&self) -> BTreeSet<String> {
        self.source.actors()
    }

    /// Collects whole fragments until there are as many transitions as `size` asks for, or shutdown is requested, or
    /// `interrupt` returns true. After an interruption, the next call continues with the fragments collected so far.
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
                self.stragglers.delivered(&accepted.fragment.actor, self.source.now());
                self.add(accepted);
            }
            let present = self.poll_actors();
            if self.transitions < size.transitions && self.stragglers.is_over(&present, self.source.now()) {
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
        fragments.sort_by(|a, b| {
            let key = |accepted: &AcceptedFragment| (accepted.fragment.actor_incarnation, accepted.fragment.sequence);
            a.fragment.actor.cmp(&b.fragment.actor).then_with(|| key(a).cmp(&key(b)))
        });
        Collected::Batch(CollectedBatch { fragments, has_backlog: self.queued.is_some() })
    }

    fn add(&mut self, accepted: AcceptedFragment) {
        self.transitions += accepted.fragment.transitions();
        self.accepted.push(accepted);
    }

    /// Returns the names of the actors that are alive; logs those that came or went.
    fn poll_actors(&mut self) -> BTreeSet<String> {
        let present = self.source.actors();
        if present != self.present {
            present.difference(&self.present).for_each(|actor| tracing::info!("`{actor}` is there"));
            self.present.difference(&present).for_each(|actor| tracing::info!("`{actor}` is gone"));
            self.present = present.clone();
        }
        present
    }

    fn next(&mut self, timeout: Duration, lineage: &Lineage) -> Option<AcceptedFragment> {
        let message = match self.queued.take() {
            Some(message) => message,
            None => self.source.next(timeout)?,
        };
        self.receive(message, lineage)
    }

    /// Validates one fragment; answers it at once if it is rejected, or accepted in asynchronous mode.
    fn receive(&mut self, mut message: S::Message, lineage: &Lineage) -> Option<AcceptedFragment> {
        let received = message.take()?;
        let now = self.source.now();
        match self.validator.validate(message.actor(), received, lineage, now) {
            Ok(accepted) => {
                self.source.copy(&mut message);
                let owed = OwedReceipt { message, incarnation: accepted.fragment.actor_incarnation };
                match self.mode {
                    LearnerMode::Sync => self.owed.push(owed),
                    LearnerMode::Async => self.answer(owed, lineage),
                }
                Some(accepted)
            }
            Err(receipt) => {
                message.answer(&receipt);
                None
            }
        }
    }

    /// Sends every receipt that is owed: the senders continue, with the newest policy.
    pub fn send_owed_receipts(&mut self, lineage: &Lineage) {
        for owed in std::mem::take(&mut self.owed) {
            self.answer(owed, lineage);
        }
        self.stragglers.begin(self.source.now());
    }

    fn answer(&self, OwedReceipt { message, incarnation }: OwedReceipt<S::Message>, lineage: &Lineage) {
        let durable_through = self.validator.ledger.durable_through(message.actor(), incarnation);
        message.answer(&Receipt {
            outcome: Outcome::Accepted,
            reason: String::new(),
            version: lineage.newest(),
            durable_through,
        });
    }

    /// Notes that a checkpoint on disk holds everything accepted so far.
    pub fn mark_durable(&mut self) {
        self.validator.ledger.mark_durable();
    }

    /// Answers every waiting sender that the learner stops. No checkpoint holds those fragments, so the senders keep them
    /// for the next learner.
    pub fn stop(&mut self, lineage: &Lineage) {
        let owed = std::mem::take(&mut self.owed).into_iter().map(|owed| owed.message);
        let mut messages: Vec<S::Message> = owed.chain(self.queued.take()).collect();
        messages.extend(std::iter::from_fn(|| self.source.next(Duration::ZERO)));
        for message in messages {
            message.answer(&Receipt {
                outcome: Outcome::Stopping,
                reason: "the learner is stopping".to_string(),
                version: lineage.newest(),
                durable_through: 0,
            });
        }
    }
}
