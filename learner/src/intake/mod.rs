//! Fragments from the bus: judged, answered, gathered into a batch.
//!
//! A receipt is the sender's credit. In the normal state the learner holds it back until the batch is learnt from and
//! the next policy is out, so that the sender goes on with the newest. It never waits for one particular actor: once
//! every live actor has delivered, or patience with the missing ones ran out, the receipts go out and the others fill
//! the batch.

mod judge;
mod ledger;
mod lineage;
mod quarantine;

use std::{
    collections::BTreeSet,
    time::{Duration, Instant},
};

use treadmill_common::{
    bus::{Alive, Delivery, RolloutIntake},
    shutdown::Shutdown,
};
use treadmill_proto::{Outcome, Receipt};

pub use judge::{Accepted, Expected, Judge, Tally};
pub use ledger::Ledger;
pub use lineage::{Descent, Lineage};
pub use quarantine::Quarantine;

/// How often the wait for a fragment looks up.
const TICK: Duration = Duration::from_millis(20);
/// Patience with missing actors never falls below this: fragments of equal size do not arrive at the same instant.
const PATIENCE_MIN: Duration = Duration::from_millis(100);

/// Gathers batches.
pub struct Intake {
    queue: RolloutIntake,
    alive: Alive,
    judge: Judge,
    held: Vec<Held>,
}

/// A fragment that was taken and whose receipt is still owed.
struct Held {
    delivery: Delivery,
    incarnation: u64,
}

impl Intake {
    /// An intake over what is declared on the bus.
    pub fn new(queue: RolloutIntake, alive: Alive, judge: Judge) -> Self {
        Self { queue, alive, judge, held: Vec::new() }
    }

    /// What was dealt with, and the counts.
    pub fn judge(&self) -> &Judge {
        &self.judge
    }

    /// Who is alive.
    pub fn alive(&self) -> BTreeSet<String> {
        self.alive.actors()
    }

    /// Gathers whole fragments until there are `transitions` of them; `None` once somebody asked to stop.
    ///
    /// Ordered by sender and sequence number, so that what is learnt does not depend on who came first.
    pub fn collect(&mut self, transitions: usize, lineage: &Lineage, shutdown: &Shutdown) -> Option<Vec<Accepted>> {
        let mut begun = Instant::now();
        let mut batch: Vec<Accepted> = Vec::new();
        let mut gathered = 0;
        let mut delivered = BTreeSet::new();
        let mut patience = None;
        while gathered < transitions {
            if shutdown.asked() {
                return None;
            }
            if let Some(delivery) = self.queue.next(TICK)
                && let Some(accepted) = self.take(delivery, lineage)
            {
                delivered.insert(accepted.fragment.actor.clone());
                gathered += accepted.fragment.transitions();
                batch.push(accepted);
                // Others may take twice as long as the first, counted from the start of this round.
                patience.get_or_insert_with(|| Instant::now() + begun.elapsed().max(PATIENCE_MIN));
            }
            let all_are_in = self.alive.actors().is_subset(&delivered);
            let out_of_patience = patience.is_some_and(|patience| Instant::now() > patience);
            if gathered < transitions && !delivered.is_empty() && (all_are_in || out_of_patience) {
                self.answer_held(lineage);
                delivered.clear();
                begun = Instant::now();
                patience = None;
            }
        }
        batch.sort_by(|a, b| {
            let key = |accepted: &Accepted| (accepted.fragment.actor_incarnation, accepted.fragment.sequence);
            a.fragment.actor.cmp(&b.fragment.actor).then_with(|| key(a).cmp(&key(b)))
        });
        Some(batch)
    }

    fn take(&mut self, mut delivery: Delivery, lineage: &Lineage) -> Option<Accepted> {
        let payload = delivery.payload.clone();
        delivery.release_payload();
        match self.judge.judge(&delivery.actor, payload, lineage, Instant::now()) {
            Ok(accepted) => {
                self.held.push(Held { delivery, incarnation: accepted.fragment.actor_incarnation });
                Some(accepted)
            }
            Err(receipt) => {
                delivery.answer(&receipt);
                None
            }
        }
    }

    /// Answers every fragment that was taken: its sender may go on, with the newest policy.
    pub fn answer_held(&mut self, lineage: &Lineage) {
        for Held { delivery, incarnation } in std::mem::take(&mut self.held) {
            let durable_through = self.judge.ledger.durable_through(&delivery.actor, incarnation);
            delivery.answer(&Receipt {
                outcome: Outcome::Accepted,
                reason: String::new(),
                version: lineage.newest(),
                durable_through,
            });
        }
    }

    /// Notes that everything taken so far is part of a checkpoint on disk.
    pub fn mark_durable(&mut self) {
        self.judge.ledger.mark_durable();
    }

    /// Tells everybody who waits that the learner stops: what they sent is not part of any checkpoint, so they keep it
    /// for a successor.
    pub fn stop(&mut self, lineage: &Lineage) {
        let waiting = std::iter::from_fn(|| self.queue.next(Duration::ZERO)).collect::<Vec<_>>();
        for delivery in std::mem::take(&mut self.held).into_iter().map(|held| held.delivery).chain(waiting) {
            delivery.answer(&Receipt {
                outcome: Outcome::Stopping,
                reason: "the learner is stopping".to_string(),
                version: lineage.newest(),
                durable_through: 0,
            });
        }
    }
}
