//! Where fragments come from: the bus, or a model of it in tests.

use std::{
    collections::BTreeSet,
    time::{Duration, Instant},
};

use bytes::Bytes;
use treadmill_common::bus::{Alive, Delivery, RolloutCopies, RolloutIntake};
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

    /// Whether somebody wants copies of what is taken.
    fn is_watched(&self) -> bool {
        false
    }

    /// Hands on a copy of a fragment that was taken; never waits.
    fn copy(&self, _actor: &str, _fragment: Bytes) {}
}

/// A fragment that waits for its receipt. Dropped without one, its sender sends it again.
pub trait Letter {
    /// Who sent it.
    fn actor(&self) -> &str;

    /// The encoded fragment, once; the answer is still owed.
    fn take_payload(&mut self) -> Bytes;

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
    type Letter = Delivery;

    fn next(&mut self, patience: Duration) -> Option<Delivery> {
        self.pulse.beat();
        self.queue.next(patience)
    }

    fn actors(&self) -> BTreeSet<String> {
        self.alive.actors()
    }

    fn now(&self) -> Instant {
        Instant::now()
    }

    fn is_watched(&self) -> bool {
        self.copies.is_watched()
    }

    fn copy(&self, actor: &str, fragment: Bytes) {
        self.copies.offer(actor, fragment);
    }
}

impl Letter for Delivery {
    fn actor(&self) -> &str {
        &self.actor
    }

    fn take_payload(&mut self) -> Bytes {
        let payload = self.payload.clone();
        self.release_payload();
        payload
    }

    fn answer(self, receipt: &Receipt) {
        Delivery::answer(self, receipt);
    }
}
