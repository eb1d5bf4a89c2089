//! The learner's end of the fleet: what arrives, and what is answered.

use std::{
    collections::BTreeSet,
    time::{Duration, Instant},
};

use bytes::Bytes;
use treadmill_bus::ReceivedFragment;
use treadmill_learner::intake::{FragmentMessage, FragmentSource};
use treadmill_proto::{Outcome, Receipt};

use super::{Event, FleetWorld, Shared};

/// The learner's end.
pub struct MemoryFragmentSource(pub Shared);

impl FragmentSource for MemoryFragmentSource {
    type Message = MemoryMessage;

    fn next(&mut self, patience: Duration) -> Option<MemoryMessage> {
        let until = self.0.borrow().now + patience;
        loop {
            if let Some(message) = self.0.borrow_mut().queue.pop_front() {
                return Some(message);
            }
            if !FleetWorld::step(&self.0, until) {
                let mut world = self.0.borrow_mut();
                world.now = until;
                if world.now > world.patient_until {
                    world.out_of_patience.ask();
                }
                return None;
            }
        }
    }

    fn actors(&self) -> BTreeSet<String> {
        self.0.borrow().actors.iter().map(|actor| actor.name.clone()).collect()
    }

    fn now(&self) -> Instant {
        let world = self.0.borrow();
        world.begun + world.now
    }
}

/// A fragment in the learner's hands.
pub struct MemoryMessage {
    pub(super) world: Shared,
    pub(super) actor: usize,
    pub(super) name: String,
    pub(super) incarnation: u64,
    pub(super) sequence: u64,
    pub(super) payload: Bytes,
}

impl FragmentMessage for MemoryMessage {
    fn actor(&self) -> &str {
        &self.name
    }

    fn take(&mut self) -> Option<ReceivedFragment> {
        Some(std::mem::take(&mut self.payload).into())
    }

    fn answer(self, receipt: &Receipt) {
        let Self { actor, incarnation, sequence, .. } = self;
        if matches!(receipt.outcome, Outcome::TooOld | Outcome::Vanished) {
            self.world.borrow_mut().refused.insert((self.name, incarnation, sequence));
        }
        self.world.borrow_mut().send(Event::Answer { actor, incarnation, sequence, receipt: receipt.clone() });
    }
}
