//! Learner of the simulation: the leadership and the follower are the real ones.

use std::time::Instant;

use serde::{Deserialize, Serialize};
use treadmill_learner::{
    checkpoint::Counters,
    leadership::{
        Leadership, LeadershipError,
        follower::{LeaderSight, Sight, StateFollower},
    },
};
use treadmill_store::Store;

/// Name of the run.
const RUN: &str = "walk";

/// State of a run: what it has learnt from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RunState {
    pub updates: u64,
    /// Sequence numbers learnt from, in order, for each actor.
    pub learnt: Vec<Vec<u64>>,
}

impl RunState {
    pub fn decode(bytes: &[u8]) -> Self {
        serde_json::from_slice(bytes).expect("a state that a learner wrote")
    }

    /// Highest sequence number up to which this actor's fragments are learnt from, all of them.
    pub fn through(&self, actor: usize) -> u64 {
        let mut through = 0;
        let mut learnt = self.learnt[actor].clone();
        learnt.sort_unstable();
        for sequence in learnt {
            if sequence == through + 1 {
                through = sequence;
            }
        }
        through
    }
}

/// A learner that leads, or means to.
pub struct Lead {
    pub leadership: Leadership,
    /// State with the last update.
    pub state: RunState,
    /// State of the last save that succeeded; `None` before this learner leads.
    pub durable: Option<RunState>,
    /// Whether `state` has to be saved before anything else.
    pub is_saving: bool,
}

/// One learner process.
pub struct Learner {
    pub lead: Option<Lead>,
    follower: StateFollower,
    pub is_frozen: bool,
}

impl Learner {
    pub fn new(store: &Store) -> Self {
        Self { lead: None, follower: StateFollower::new(store), is_frozen: false }
    }

    /// Whether it has taken the lead, as far as it knows.
    pub fn leads(&self) -> bool {
        self.lead.as_ref().is_some_and(|lead| lead.durable.is_some())
    }

    /// Follows the run; prepares to lead if it is due. Returns the state from which it would go on.
    pub fn follow(&mut self, store: &Store, sight: Sight, writer: u64, now: Instant) -> Option<RunState> {
        self.follower.refresh(now).ok()?;
        if !self.follower.is_due(sight, now) || sight.leader == LeaderSight::Stalled && !self.follower.try_write() {
            return None;
        }
        let loaded = self.follower.loaded()?.clone();
        let state = RunState::decode(&loaded.state);
        let leadership = Leadership::simulated(store, Some(&(loaded.manifest, loaded.tag)), writer);
        self.lead = Some(Lead { leadership, state: state.clone(), durable: None, is_saving: true });
        Some(state)
    }

    /// Saves what is to be saved. Returns true if it has been saved now; steps down if another learner leads.
    pub fn save(&mut self, store: &Store) -> bool {
        let Some(lead) = self.lead.as_mut().filter(|lead| lead.is_saving) else { return false };
        let encoded = serde_json::to_vec(&lead.state).expect("numbers");
        let counters = Counters { updates: lead.state.updates, ..Counters::default() };
        match lead.leadership.save(RUN, &counters, &encoded) {
            Ok(()) => {
                (lead.durable, lead.is_saving) = (Some(lead.state.clone()), false);
                true
            }
            Err(LeadershipError::Overtaken { .. }) => {
                (self.lead, self.follower) = (None, StateFollower::new(store));
                false
            }
            // The store fails: the learner waits.
            Err(_) => false,
        }
    }

    /// Learns from fragments of one update.
    pub fn learn(&mut self, fragments: &[(usize, u64)]) {
        let Some(lead) = &mut self.lead else { return };
        for (actor, sequence) in fragments {
            lead.state.learnt[*actor].push(*sequence);
        }
        lead.state.updates += 1;
        lead.is_saving = true;
    }
}
