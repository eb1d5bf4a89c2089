//! Intake: validates fragments from the bus, sends receipts, and collects batches.
//!
//! A receipt returns the sender's credit and says how long its next fragment should be. A batch holds all that the fleet has
//! delivered, and at least `ppo.batch` transitions.
//!
//! In mode [`LearnerMode::Sync`], batches hold only fragments of the newest policy. A round ends when every live actor has
//! delivered one, or the stragglers' time is up. A batch needs one or more rounds. The learner owes the receipts of a round
//! until it begins the next, after the last round of a batch under a new policy.
//!
//! In mode [`LearnerMode::Async`], the learner answers accepted fragments at once. A batch waits for as many
//! transitions as one fragment of every live actor has, from any senders: with smaller batches, the policy would change
//! many times while an actor simulates, and most experience would be too old. Fragments that find the batch full wait
//! for the next one, and so do their senders.
//!
//! A fragment's stages here: received, accepted, batch. *Incoming* is a received fragment that waits for its receipt.
//!
//! # Layout
//! - Here: [`Intake`], which collects batches.
//! - `source`: [`FragmentSource`], where fragments come from.
//! - `validator`: [`FragmentValidator`], which accepts or rejects a fragment.
//! - `fleet`: [`FleetPlan`], the actors' environments, speeds, horizons and effort; `horizon`: the rule for horizons.
//! - [`ledger_report`]: the ledger of handled fragments as a file.
//! - `rejections`: [`Rejections`], the senders of rejected fragments.
//! - `straggler`: limits the wait for stragglers.

mod fleet;
mod horizon;
pub mod ledger_report;
mod rejections;
mod source;
mod straggler;
mod validator;

use std::{
    collections::{BTreeSet, VecDeque},
    time::Duration,
};

use treadmill_config::LearnerMode;
use treadmill_experience::lineage::{Descent, Lineage};
use treadmill_ppo::AcceptedFragment;
pub use treadmill_ppo::BatchSize;
use treadmill_proto::{Outcome, Receipt};
use treadmill_runtime::shutdown::Shutdown;

use fleet::Effort;
pub use fleet::{FleetEffort, FleetPlan};
pub use horizon::HorizonRule;
pub use rejections::{Rejection, Rejections};
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
    /// Environments, speeds and horizons of the actors.
    pub fleet: FleetPlan,
    stragglers: StragglerPolicy,
    /// Value of [`FragmentSource::membership`] when the live actors were last read.
    membership: Option<u64>,
    /// Transitions of one fragment of every live actor.
    round_transitions: usize,
    owed: Vec<OwedReceipt<S::Incoming>>,
    /// Received fragments that wait for a place in a batch, the next first.
    waiting: VecDeque<S::Incoming>,
    /// Fragments of the next batch so far, and their transitions.
    accepted: Vec<AcceptedFragment>,
    transitions: usize,
    /// Time in which no fragment was there to take, since it was last asked for.
    idle: Duration,
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

/// Fragments of one update.
#[derive(Debug)]
pub struct CollectedBatch {
    /// Whole fragments, sorted by sender and sequence number, so that their arrival order does not matter.
    pub fragments: Vec<AcceptedFragment>,
    /// Whether more fragments wait, which the batch has no place for.
    pub has_backlog: bool,
}

impl<S: FragmentSource> Intake<S> {
    /// Intake that takes its fragments from `source`.
    pub fn new(source: S, mode: LearnerMode, validator: FragmentValidator, fleet: FleetPlan) -> Self {
        let stragglers = StragglerPolicy::new(source.now());
        Self {
            source,
            mode,
            validator,
            fleet,
            stragglers,
            membership: None,
            round_transitions: 0,
            owed: Vec::new(),
            waiting: VecDeque::new(),
            accepted: Vec::new(),
            transitions: 0,
            idle: Duration::ZERO,
        }
    }

    /// Returns the time in which no fragment was there to take, since the last call.
    pub fn take_idle(&mut self) -> Duration {
        std::mem::take(&mut self.idle)
    }

    /// Returns the names of the actors that are alive.
    pub fn alive(&self) -> &BTreeSet<String> {
        self.stragglers.alive()
    }

    /// Collects whole fragments until a batch is complete, shutdown is requested, or `interrupt` returns true.
    /// After an interruption, the next call continues with the fragments collected so far.
    pub fn collect(
        &mut self,
        size: BatchSize,
        lineage: &Lineage,
        shutdown: &Shutdown,
        mut interrupt: impl FnMut() -> bool,
    ) -> Collected {
        loop {
            self.poll_actors();
            self.waiting.extend(std::iter::from_fn(|| self.source.next(Duration::ZERO)));
            self.accept_waiting(size, lineage);
            if self.is_complete(size) {
                return Collected::Batch(self.close_batch(lineage));
            }
            if shutdown.asked() {
                return Collected::Stopped;
            }
            if interrupt() {
                return Collected::Interrupted;
            }
            if self.mode == LearnerMode::Sync && self.stragglers.is_round_over(self.source.now()) {
                self.begin_round(lineage);
            }
            let begun = self.source.now();
            self.waiting.extend(self.source.next(TICK));
            self.idle += self.source.now().duration_since(begun);
        }
    }

    /// Whether the batch has its size and that of a round or, in synchronous mode, its last round is over.
    fn is_complete(&mut self, size: BatchSize) -> bool {
        self.transitions >= size.transitions
            && match self.mode {
                LearnerMode::Sync => self.stragglers.is_round_over(self.source.now()),
                LearnerMode::Async => self.transitions >= self.round_transitions.min(size.transitions_max),
            }
    }

    /// Closes the batch, and fits the horizons to the fleet that delivered it.
    fn close_batch(&mut self, lineage: &Lineage) -> CollectedBatch {
        if self.mode == LearnerMode::Async {
            self.begin_round(lineage);
        }
        self.transitions = 0;
        let mut fragments = std::mem::take(&mut self.accepted);
        fragments.sort_by(|AcceptedFragment { fragment: a, .. }, AcceptedFragment { fragment: b, .. }| {
            (&a.actor, a.actor_incarnation, a.sequence).cmp(&(&b.actor, b.actor_incarnation, b.sequence))
        });
        CollectedBatch { fragments, has_backlog: !self.waiting.is_empty() }
    }

    /// Accepts waiting fragments while the batch has room, in the order of [`Self::order_waiting`].
    fn accept_waiting(&mut self, size: BatchSize, lineage: &Lineage) {
        self.order_waiting(lineage);
        while self.transitions < size.transitions_max
            && let Some(incoming) = self.waiting.pop_front()
        {
            if let Some(accepted) = self.receive(incoming, lineage) {
                if self.mode == LearnerMode::Sync {
                    self.stragglers.record_delivery(&accepted.fragment.actor, self.source.now());
                }
                self.transitions += accepted.fragment.transitions();
                self.accepted.push(accepted);
            }
        }
    }

    /// Orders the waiting fragments: first those that would be too old for the next batch, then the newest.
    fn order_waiting(&mut self, lineage: &Lineage) {
        if self.waiting.len() > 1 {
            let lag_max = self.validator.max_policy_lag();
            let lag = |incoming: &S::Incoming| match S::version(incoming).map(|version| lineage.descent(version)) {
                Some(Descent::Lag(lag)) if lag < lag_max => lag + 1,
                _ => 0,
            };
            self.waiting.make_contiguous().sort_by_key(lag);
        }
    }

    /// Reads the live actors if they have changed; logs those that joined or left.
    fn poll_actors(&mut self) {
        let membership = self.source.membership();
        if self.membership == Some(membership) {
            return;
        }
        self.membership = Some(membership);
        let alive = self.source.actors();
        let before = self.stragglers.alive();
        alive.difference(before).for_each(|actor| tracing::info!(%actor, "actor joined"));
        before.difference(&alive).for_each(|actor| tracing::info!(%actor, "actor left"));
        self.round_transitions = self.fleet.round_transitions(&alive);
        self.stragglers.set_alive(alive);
    }

    /// Validates one fragment. Answers it at once if it is rejected, or if it is accepted in asynchronous mode.
    fn receive(&mut self, mut incoming: S::Incoming, lineage: &Lineage) -> Option<AcceptedFragment> {
        let received = S::take(&mut incoming)?;
        let now = self.source.now();
        let effort = received.fragment.as_ref().ok().map(Effort::of);
        let validated = self.validator.validate(S::actor(&incoming), received, lineage, now);
        let outcome = validated.as_ref().map_or_else(|receipt| receipt.outcome, |_| Outcome::Accepted);
        if let Some(effort) = effort
            && matches!(outcome, Outcome::Accepted | Outcome::TooOld | Outcome::Vanished)
        {
            self.fleet.record(S::actor(&incoming), &effort);
        }
        match validated {
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
                let fragment_steps = self.fleet.steps(S::actor(&incoming));
                S::answer(incoming, &Receipt { fragment_steps, ..*receipt });
                None
            }
        }
    }

    /// Begins a round: fits the horizons to the fleet, and sends every owed receipt, so that the senders continue with the
    /// newest policy.
    pub fn begin_round(&mut self, lineage: &Lineage) {
        let shorter = self.fleet.plan(self.stragglers.alive());
        self.round_transitions = self.fleet.round_transitions(self.stragglers.alive());
        for owed in std::mem::take(&mut self.owed) {
            self.answer(owed, lineage);
        }
        if self.mode == LearnerMode::Sync {
            shorter.iter().for_each(|actor| self.stragglers.forgive(actor));
            self.stragglers.begin_round(self.source.now());
        }
    }

    fn answer(&self, OwedReceipt { incoming, incarnation }: OwedReceipt<S::Incoming>, lineage: &Lineage) {
        let durable_through = self.validator.ledger.durable_through(S::actor(&incoming), incarnation);
        let (outcome, version, reason) = (Outcome::Accepted, lineage.newest(), String::new());
        let fragment_steps = self.fleet.steps(S::actor(&incoming));
        S::answer(incoming, &Receipt { outcome, reason, version, durable_through, fragment_steps });
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
        let mut unanswered: Vec<S::Incoming> = owed.chain(self.waiting.drain(..)).collect();
        unanswered.extend(std::iter::from_fn(|| self.source.next(Duration::ZERO)));
        unanswered.into_iter().for_each(|incoming| S::answer(incoming, &receipt));
    }
}
