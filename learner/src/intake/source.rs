//! Source of fragments: the bus, or a model of it in tests.

use std::{
    collections::BTreeSet,
    time::{Duration, Instant},
};

use treadmill_bus::learner::{Alive, IncomingFragment, ReceivedFragment, RolloutCopies, RolloutIntake};
use treadmill_proto::{PolicyVersion, Receipt};

use crate::waiting::Heartbeat;

/// Source of fragments, of the names of living actors, and of the time.
pub trait FragmentSource {
    /// Received fragment that waits for its receipt. If it is dropped without one, its sender sends it again.
    type Incoming;

    /// Returns the next fragment, if one comes within `timeout`.
    fn next(&mut self, timeout: Duration) -> Option<Self::Incoming>;

    /// Returns the name of the actor that sent a fragment.
    fn actor(incoming: &Self::Incoming) -> &str;

    /// Returns the policy version that a fragment names; `None` if it cannot be decoded.
    fn version(incoming: &Self::Incoming) -> Option<PolicyVersion>;

    /// Takes the content out, once; the receipt is still owed.
    fn take(incoming: &mut Self::Incoming) -> Option<ReceivedFragment>;

    /// Sends the receipt, which returns the sender's credit.
    fn answer(incoming: Self::Incoming, receipt: &Receipt);

    /// Returns the names of the actors that are alive.
    fn actors(&mut self) -> BTreeSet<String>;

    /// Returns a number that changes whenever [`Self::actors`] does.
    fn membership(&self) -> u64;

    /// Returns the current time.
    fn now(&self) -> Instant;

    /// Sends a copy of an accepted fragment if there is a subscriber; never blocks.
    fn copy(&self, _incoming: &mut Self::Incoming) {}
}

/// Source of the fragments that come over the bus.
pub struct BusFragmentSource {
    queue: RolloutIntake,
    alive: Alive,
    copies: RolloutCopies,
    heartbeat: Heartbeat,
}

impl BusFragmentSource {
    /// Source of the queued fragments; every call of `next` beats `heartbeat`.
    pub fn new(queue: RolloutIntake, alive: Alive, copies: RolloutCopies, heartbeat: Heartbeat) -> Self {
        Self { queue, alive, copies, heartbeat }
    }
}

impl FragmentSource for BusFragmentSource {
    type Incoming = IncomingFragment;

    fn next(&mut self, timeout: Duration) -> Option<IncomingFragment> {
        self.heartbeat.beat();
        self.queue.next(timeout)
    }

    fn actor(incoming: &IncomingFragment) -> &str {
        &incoming.actor
    }

    fn version(incoming: &IncomingFragment) -> Option<PolicyVersion> {
        incoming.version()
    }

    fn take(incoming: &mut IncomingFragment) -> Option<ReceivedFragment> {
        incoming.take()
    }

    fn answer(incoming: IncomingFragment, receipt: &Receipt) {
        incoming.answer(receipt);
    }

    fn actors(&mut self) -> BTreeSet<String> {
        self.alive.actors()
    }

    fn membership(&self) -> u64 {
        self.alive.changes()
    }

    fn now(&self) -> Instant {
        Instant::now()
    }

    fn copy(&self, incoming: &mut IncomingFragment) {
        incoming.copy_to(&self.copies);
    }
}
