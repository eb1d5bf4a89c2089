//! An actor that belongs to no run: finds one that needs it.

use std::{
    cmp::Reverse,
    collections::{BTreeMap, BTreeSet},
    sync::{Arc, Mutex, PoisonError},
    time::Duration,
};

use tokio::task::JoinSet;
use treadmill_bus::{
    Bus, BusError,
    actor::{PoolRoom, ask_to_join, pool_demands, pool_token},
};
use treadmill_humanoid::PHYSICS_VERSION;
use treadmill_proto::{PoolDemand, PoolJoin};
use treadmill_runtime::{error_chain, seeds::checksum, shutdown::Shutdown};

use crate::{ActorError, policy_fetcher::Refresh};

/// Longest wait for the answers of learners; one that hangs delays the others' actors by it.
const ANSWER_TIMEOUT: Duration = Duration::from_secs(1);
/// Pause of an actor without a run between two searches: the first one, and the longest. A run that has room calls.
const PAUSE: Duration = Duration::from_millis(200);
const PAUSE_MAX: Duration = Duration::from_secs(10);
/// Pause after which the user hears of the wait.
const PAUSE_NOTICED: Duration = Duration::from_secs(3);
/// Runs whose last fragments may still be under way after the actor left them. Those of further ones are given up.
const LEFT_MAX: usize = 8;

/// Deliveries under way.
pub type Deliveries = JoinSet<Result<Refresh, BusError>>;

/// Place of an actor in the pool.
pub struct PoolPlace {
    seeker: Seeker,
    room: PoolRoom,
    /// Deliveries that were under way when the actor left their run.
    left: BTreeMap<String, Deliveries>,
    _token: Box<dyn Send + Sync>,
}

/// Searches for a run. Clones share what they know.
#[derive(Clone)]
pub struct Seeker {
    bus: Bus,
    actor: String,
    envs: u32,
    /// Runs that this program cannot simulate.
    unfit: Arc<Mutex<BTreeSet<String>>>,
}

impl PoolPlace {
    /// Enters the pool.
    ///
    /// # Errors
    /// If the bus fails.
    pub fn enter(bus: &Bus, actor: &str, envs: u32) -> Result<Self, BusError> {
        let token = Box::new(pool_token(bus, actor, envs)?);
        let seeker = Seeker { bus: bus.clone(), actor: actor.to_string(), envs, unfit: Arc::default() };
        Ok(Self { seeker, room: PoolRoom::open(bus)?, left: BTreeMap::new(), _token: token })
    }

    /// Returns the part that a task may take along.
    pub fn seeker(&self) -> &Seeker {
        &self.seeker
    }

    /// Waits until a run admits this actor, which has none. Returns `None` after a request to stop.
    ///
    /// # Errors
    /// If the bus fails.
    pub async fn find(&self, notify: fn(&str), shutdown: &Shutdown) -> Result<Option<String>, BusError> {
        let mut pause = PAUSE;
        let mut has_notified = false;
        loop {
            let found = tokio::select! {
                found = self.seeker.seek(None) => found?,
                () = shutdown.wait() => return Ok(None),
            };
            if found.is_some() {
                return Ok(found);
            }
            if pause >= PAUSE_NOTICED && !has_notified {
                notify("no run needs this actor now; waiting for one");
                has_notified = true;
            }
            // Actors that came together do not search together.
            let jitter = 0.5
                + checksum(&[self.seeker.actor.as_bytes(), &pause.as_nanos().to_le_bytes()]) as f64 / u64::MAX as f64;
            tokio::select! {
                () = tokio::time::sleep(pause.mul_f64(jitter)) => pause = (2 * pause).min(PAUSE_MAX),
                () = self.room.called() => pause = PAUSE,
                () = shutdown.wait() => return Ok(None),
            }
        }
    }

    /// Keeps the deliveries of a run that the actor leaves: its learner may be paused, or away for a while.
    pub fn keep(&mut self, run: &str, deliveries: Deliveries) {
        self.left.retain(|_, of_run| {
            while of_run.try_join_next().is_some() {}
            !of_run.is_empty()
        });
        if deliveries.is_empty() {
            return;
        }
        if self.left.len() >= LEFT_MAX {
            let given_up = self.left.pop_first().map(|(run, _)| run);
            tracing::warn!(run = given_up, "the last fragments for a run that does not answer are given up");
        }
        self.left.insert(run.to_string(), deliveries);
    }

    /// Waits for the deliveries of an earlier membership in `run`, at most for `timeout`: the learner takes the fragments
    /// of an actor in their order.
    pub async fn settle(&mut self, run: &str, timeout: Duration) {
        if let Some(mut deliveries) = self.left.remove(run) {
            let settled = async { while deliveries.join_next().await.is_some() {} };
            if tokio::time::timeout(timeout, settled).await.is_err() {
                tracing::warn!(run, "the last fragments of the time before are given up");
            }
        }
    }
}

impl Seeker {
    /// Asks the runs other than `present` for a place, those that lack most environments first. Returns the run that
    /// admits the actor.
    ///
    /// # Errors
    /// If the bus fails.
    pub async fn seek(&self, present: Option<&str>) -> Result<Option<String>, BusError> {
        let mut demands = pool_demands(&self.bus, ANSWER_TIMEOUT).await?;
        let unfit = self.unfit.lock().unwrap_or_else(PoisonError::into_inner).clone();
        demands.retain(|demand| {
            let is_fit = demand.physics_version == PHYSICS_VERSION && !unfit.contains(&demand.run);
            demand.open && is_fit && present != Some(&demand.run)
        });
        let lack = |demand: &PoolDemand| i64::from(demand.envs_target) - i64::from(demand.envs);
        let is_idle = present.is_none();
        demands.retain(|demand| is_idle || lack(demand) > 0);
        demands
            .sort_by_key(|demand| Reverse((lack(demand), checksum(&[demand.run.as_bytes(), self.actor.as_bytes()]))));
        let join = PoolJoin { envs: self.envs, idle: is_idle };
        for demand in demands {
            if ask_to_join(&self.bus, &demand.run, &self.actor, &join, ANSWER_TIMEOUT).await? {
                return Ok(Some(demand.run));
            }
        }
        Ok(None)
    }

    /// Records why this program cannot work for a run.
    pub fn refuse(&self, run: &str, why: &ActorError) {
        tracing::warn!(run, why = error_chain(why), "this actor does not join the run");
        self.unfit.lock().unwrap_or_else(PoisonError::into_inner).insert(run.to_string());
    }
}
