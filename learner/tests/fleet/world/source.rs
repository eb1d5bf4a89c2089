//! The learner's end of the fleet: fragments in, receipts out.

use std::{
    collections::BTreeSet,
    time::{Duration, Instant},
};

use bytes::Bytes;
use treadmill_bus::learner::ReceivedFragment;
use treadmill_learner::intake::FragmentSource;
use treadmill_proto::{Fragment, Outcome, PolicyVersion, Receipt};

use super::{Event, FleetWorld, Shared};

/// Source of the fragments that arrive in a [`FleetWorld`].
pub struct MemoryFragmentSource(pub Shared);

impl FragmentSource for MemoryFragmentSource {
    type Incoming = MemoryFragment;

    fn next(&mut self, timeout: Duration) -> Option<MemoryFragment> {
        let until = self.0.borrow().now + timeout;
        loop {
            if let Some(fragment) = self.0.borrow_mut().queue.pop_front() {
                return Some(fragment);
            }
            if !FleetWorld::step(&self.0, until) {
                let mut world = self.0.borrow_mut();
                world.now = until;
                if world.now > world.deadline {
                    world.timed_out.ask();
                }
                return None;
            }
        }
    }

    fn actor(incoming: &MemoryFragment) -> &str {
        &incoming.name
    }

    fn version(incoming: &MemoryFragment) -> Option<PolicyVersion> {
        Fragment::decode(&incoming.payload).ok().map(|fragment| fragment.version)
    }

    fn take(incoming: &mut MemoryFragment) -> Option<ReceivedFragment> {
        Some(std::mem::take(&mut incoming.payload).into())
    }

    fn answer(incoming: MemoryFragment, receipt: &Receipt) {
        let MemoryFragment { world, actor, name, incarnation, sequence, .. } = incoming;
        let mut world = world.borrow_mut();
        if matches!(receipt.outcome, Outcome::TooOld | Outcome::Vanished) {
            world.dropped.insert((name, incarnation, sequence));
        }
        world.send(Event::Answer { actor, incarnation, sequence, receipt: receipt.clone() });
    }

    fn actors(&mut self) -> BTreeSet<String> {
        self.0.borrow().actors.iter().map(|actor| actor.name.clone()).collect()
    }

    fn membership(&self) -> u64 {
        // A restarted process keeps its name.
        0
    }

    fn now(&self) -> Instant {
        let world = self.0.borrow();
        world.begun + world.now
    }
}

/// Fragment that waits for its receipt.
pub struct MemoryFragment {
    pub(super) world: Shared,
    pub(super) actor: usize,
    pub(super) name: String,
    pub(super) incarnation: u64,
    pub(super) sequence: u64,
    pub(super) payload: Bytes,
}
