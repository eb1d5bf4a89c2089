//! Where fragments come from: the bus, or a model of it in tests.

use std::{
    collections::BTreeSet,
    time::{Duration, Instant},
};

use treadmill_bus::{Alive, ReceivedFragment, IncomingFragment, RolloutCopies, RolloutIntake};
use treadmill_proto::Receipt;

use crate::pulse::Pulse;

/// Fragments as they arrive, who is alive, and what time it is.
pub trait Mailbox {
    /// A fragment that waits for its receipt.
    type Letter: Letter;

    /// The next fragment, if one comes within `patience`.
    fn next(&mut self, patience: Duration) -> Option<Self::Letter>;

    /// Names of the actors that are alive.
    fn actors(&self) -> BTreeSet<String>;

    /// The present moment.
    fn now(&self) -> Instant;

    /// Hands on a copy of a fragment that was taken, if somebody wants one; never waits.
    fn copy(&self, _letter: &mut Self::Letter) {}
}

/// A fragment that waits for its receipt. Dropped without one, its sender sends it again.
pub trait Letter {
    /// Who sent it.
    fn actor(&self) -> &str;

    /// The fragment, once; the answer is still owed.
    fn take(&mut self) -> Option<ReceivedFragment>;

    /// Answers, which gives the sender its credit back.
    fn answer(self, receipt: &Receipt);
}

/// What comes over the bus.
pub struct BusMailbox {
    queue: RolloutIntake,
    alive: Alive,
    copies: RolloutCopies,
    pulse: Pulse,
}

impl BusMailbox {
    /// A mailbox over what is declared on the bus; whoever looks into it shows a sign of life.
    pub fn new(queue: RolloutIntake, alive: Alive, copies: RolloutCopies, pulse: Pulse) -> Self {
        Self { queue, alive, copies, pulse }
    }
}

impl Mailbox for BusMailbox {
    type Letter = IncomingFragment;

    fn next(&mut self, patience: Duration) -> Option<IncomingFragment> {
        self.pulse.beat();
        self.queue.next(patience)
    }

    fn actors(&self) -> BTreeSet<String> {
        self.alive.actors()
    }

    fn now(&self) -> Instant {
        Instant::now()
    }

    fn copy(&self, letter: &mut IncomingFragment) {
        letter.copy_to(&self.copies);
    }
}

impl Letter for IncomingFragment {
    fn actor(&self) -> &str {
        &self.actor
    }

    fn take(&mut self) -> Option<ReceivedFragment> {
        IncomingFragment::take(self)
    }

    fn answer(self, receipt: &Receipt) {
        IncomingFragment::answer(self, receipt);
    }
}
