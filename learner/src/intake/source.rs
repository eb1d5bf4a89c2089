//! Where fragments come from: the bus, or a model of it in tests.

use std::{
    collections::BTreeSet,
    time::{Duration, Instant},
};

use treadmill_bus::{Alive, IncomingFragment, ReceivedFragment, RolloutCopies, RolloutIntake};
use treadmill_proto::Receipt;

use crate::training::Heartbeat;

/// Source of fragments, of the names of living actors, and of the time.
pub trait FragmentSource {
    /// Message with a fragment, which waits for its receipt.
    type Message: FragmentMessage;

    /// The next fragment, if one comes within `timeout`.
    fn next(&mut self, timeout: Duration) -> Option<Self::Message>;

    /// Names of the actors that are alive.
    fn actors(&self) -> BTreeSet<String>;

    /// The present moment.
    fn now(&self) -> Instant;

    /// Passes on a copy of an accepted fragment if there is a subscriber; never waits.
    fn copy(&self, _message: &mut Self::Message) {}
}

/// Message with a fragment, which waits for its receipt. If it is dropped without one, its sender sends it again.
pub trait FragmentMessage {
    /// Name of the actor that sent it.
    fn actor(&self) -> &str;

    /// Takes the fragment out, once; the receipt is still owed.
    fn take(&mut self) -> Option<ReceivedFragment>;

    /// Sends the receipt, which returns the sender's credit.
    fn answer(self, receipt: &Receipt);
}

/// Source of the fragments that come over the bus.
pub struct BusFragmentSource {
    queue: RolloutIntake,
    alive: Alive,
    copies: RolloutCopies,
    heartbeat: Heartbeat,
}

impl BusFragmentSource {
    /// Source over what is declared on the bus; every call of `next` beats `heartbeat`.
    pub fn new(queue: RolloutIntake, alive: Alive, copies: RolloutCopies, heartbeat: Heartbeat) -> Self {
        Self { queue, alive, copies, heartbeat }
    }
}

impl FragmentSource for BusFragmentSource {
    type Message = IncomingFragment;

    fn next(&mut self, timeout: Duration) -> Option<IncomingFragment> {
        self.heartbeat.beat();
        self.queue.next(timeout)
    }

    fn actors(&self) -> BTreeSet<String> {
        self.alive.actors()
    }

    fn now(&self) -> Instant {
        Instant::now()
    }

    fn copy(&self, message: &mut IncomingFragment) {
        message.copy_to(&self.copies);
    }
}

impl FragmentMessage for IncomingFragment {
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
