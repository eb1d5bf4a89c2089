//! Fragments from the bus: judged, answered, gathered into a batch.
//!
//! A receipt is the sender's credit. Where a batch is to be of the newest policy alone ([`LearnerMode::Sync`]), receipts
//! are held back until the batch is learnt from and the next policy is out, so that the sender goes on with the newest.
//! The learner never waits for one particular actor: once everybody has delivered, or patience with the missing ones ran
//! out, the receipts go out and the others fill the batch. Where older policies may take part ([`LearnerMode::Async`]),
//! a fragment is answered as soon as it is taken.

mod judge;
mod ledger;
mod lineage;
mod mailbox;
mod patience;

use std::{collections::BTreeSet, time::Duration};

use treadmill_config::LearnerMode;
use treadmill_runtime::shutdown::Shutdown;
use treadmill_proto::{Outcome, Receipt};

pub use judge::{Accepted, Expected, Judge, Tally};
pub use ledger::{Account, Fate, Ledger, Process, Rule};
pub use lineage::{Descent, Lineage};
pub use mailbox::{BusMailbox, Letter, Mailbox};
use patience::Patience;

/// How often the wait for a fragment looks up.
const TICK: Duration = Duration::from_millis(20);

/// Gathers batches.
pub struct Intake<M: Mailbox> {
    mailbox: M,
    mode: LearnerMode,
    judge: Judge,
    patience: Patience,
    held: Vec<Held<M::Letter>>,
    /// Came when a batch was full already.
    waiting: Option<M::Letter>,
    /// What the next batch has so far, and the transitions in it.
    gathered: Vec<Accepted>,
    transitions: usize,
    /// Who was there when somebody last looked.
    present: BTreeSet<String>,
}

/// How gathering came to an end.
#[derive(Debug)]
pub enum Collected {
    /// There is a batch.
    Batch(Gathered),
    /// Something else is to be done first.
    Interrupted,
    /// Somebody asked to stop.
    Stopped,
}

/// A fragment that was taken and whose receipt is still owed.
struct Held<L> {
    letter: L,
    incarnation: u64,
}

/// How much a batch is to have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wanted {
    /// Transitions that are waited for.
    pub transitions: usize,
    /// Transitions that are taken as long as nobody has to be waited for.
    pub transitions_max: usize,
}

/// What an update is to learn from.
#[derive(Debug)]
pub struct Gathered {
    /// Whole fragments, ordered by sender and sequence number, so that what is learnt does not depend on who came first.
    pub fragments: Vec<Accepted>,
    /// Whether more of them waited than the batch takes.
    pub more_waited: bool,
}

impl<M: Mailbox> Intake<M> {
    /// An intake that takes its fragments from `mailbox`.
    pub fn new(mailbox: M, mode: LearnerMode, judge: Judge) -> Self {
        let patience = Patience::new(mailbox.now());
        Self {
            mailbox,
            mode,
            judge,
            patience,
            held: Vec::new(),
            waiting: None,
            gathered: Vec::new(),
            transitions: 0,
            present: BTreeSet::new(),
        }
    }

    /// What was dealt with, and the counts.
    pub fn judge(&self) -> &Judge {
        &self.judge
    }

    /// Takes what was refused before it was read into the counts.
    pub fn count_unread(&mut self) {
        self.judge.count_unread();
    }

    /// Who is alive.
    pub fn alive(&self) -> BTreeSet<String> {
        self.mailbox.actors()
    }

    /// Gathers whole fragments until there are as many transitions as wanted, or somebody asked to stop, or `interrupt` says
    /// so. What was gathered until an interruption is kept, and the next call goes on with it.
    pub fn collect(
        &mut self,
        wanted: Wanted,
        lineage: &Lineage,
        shutdown: &Shutdown,
        mut interrupt: impl FnMut() -> bool,
    ) -> Collected {
        while self.transitions < wanted.transitions {
            if shutdown.asked() {
                return Collected::Stopped;
            }
            if interrupt() {
                return Collected::Interrupted;
            }
            if let Some(accepted) = self.next(TICK, lineage) {
                self.patience.delivered(&accepted.fragment.actor, self.mailbox.now());
                self.add(accepted);
            }
            let present = self.look_who_is_there();
            if self.transitions < wanted.transitions && self.patience.is_over(&present, self.mailbox.now()) {
                self.answer_held(lineage);
            }
        }
        while self.transitions < wanted.transitions_max
            && let Some(accepted) = self.next(Duration::ZERO, lineage)
        {
            self.add(accepted);
        }
        if self.waiting.is_none() {
            self.waiting = self.mailbox.next(Duration::ZERO);
        }
        self.transitions = 0;
        let mut fragments = std::mem::take(&mut self.gathered);
        fragments.sort_by(|a, b| {
            let key = |accepted: &Accepted| (accepted.fragment.actor_incarnation, accepted.fragment.sequence);
            a.fragment.actor.cmp(&b.fragment.actor).then_with(|| key(a).cmp(&key(b)))
        });
        Collected::Batch(Gathered { fragments, more_waited: self.waiting.is_some() })
    }

    fn add(&mut self, accepted: Accepted) {
        self.transitions += accepted.fragment.transitions();
        self.gathered.push(accepted);
    }

    /// Names of the actors that are alive; who came or went is told.
    fn look_who_is_there(&mut self) -> BTreeSet<String> {
        let present = self.mailbox.actors();
        if present != self.present {
            present.difference(&self.present).for_each(|actor| tracing::info!("`{actor}` is there"));
            self.present.difference(&present).for_each(|actor| tracing::info!("`{actor}` is gone"));
            self.present = present.clone();
        }
        present
    }

    fn next(&mut self, patience: Duration, lineage: &Lineage) -> Option<Accepted> {
        let letter = match self.waiting.take() {
            Some(letter) => letter,
            None => self.mailbox.next(patience)?,
        };
        self.take(letter, lineage)
    }

    fn take(&mut self, mut letter: M::Letter, lineage: &Lineage) -> Option<Accepted> {
        let arrival = letter.take()?;
        let now = self.mailbox.now();
        match self.judge.judge(letter.actor(), arrival, lineage, now) {
            Ok(accepted) => {
                self.mailbox.copy(&mut letter);
                let held = Held { letter, incarnation: accepted.fragment.actor_incarnation };
                match self.mode {
                    LearnerMode::Sync => self.held.push(held),
                    LearnerMode::Async => self.answer(held, lineage),
                }
                Some(accepted)
            }
            Err(receipt) => {
                letter.answer(&receipt);
                None
            }
        }
    }

    /// Answers every fragment that was taken: its sender may go on, with the newest policy.
    pub fn answer_held(&mut self, lineage: &Lineage) {
        for held in std::mem::take(&mut self.held) {
            self.answer(held, lineage);
        }
        self.patience.begin(self.mailbox.now());
    }

    fn answer(&self, Held { letter, incarnation }: Held<M::Letter>, lineage: &Lineage) {
        let durable_through = self.judge.ledger.durable_through(letter.actor(), incarnation);
        letter.answer(&Receipt {
            outcome: Outcome::Accepted,
            reason: String::new(),
            version: lineage.newest(),
            durable_through,
        });
    }

    /// Notes that everything taken so far is part of a checkpoint on disk.
    pub fn mark_durable(&mut self) {
        self.judge.ledger.mark_durable();
    }

    /// Tells everybody who waits that the learner stops: what they sent is not part of any checkpoint, so they keep it
    /// for a successor.
    pub fn stop(&mut self, lineage: &Lineage) {
        let held = std::mem::take(&mut self.held).into_iter().map(|held| held.letter);
        let mut letters: Vec<M::Letter> = held.chain(self.waiting.take()).collect();
        letters.extend(std::iter::from_fn(|| self.mailbox.next(Duration::ZERO)));
        for letter in letters {
            letter.answer(&Receipt {
                outcome: Outcome::Stopping,
                reason: "the learner is stopping".to_string(),
                version: lineage.newest(),
                durable_through: 0,
            });
        }
    }
}
