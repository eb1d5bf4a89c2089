//! An actor that belongs to no run: finds one that needs it.

use std::{
    cmp::Reverse,
    collections::{BTreeMap, VecDeque},
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicU32, Ordering},
    },
    time::{Duration, Instant},
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
/// Time for which a run without an answer is not asked again, and one that this program cannot simulate; most such runs.
const SILENT: Duration = Duration::from_secs(10);
const UNFIT: Duration = Duration::from_secs(300);
const AVOIDED_MAX: usize = 1024;
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
    /// Deliveries that were under way when the actor left their run, the oldest first.
    left: VecDeque<(String, Deliveries)>,
    _token: Box<dyn Send + Sync>,
}

/// Searches for a run. Clones share what they know.
#[derive(Clone)]
pub struct Seeker {
    bus: Bus,
    actor: String,
    envs: u32,
    /// Runs that are not asked now, and since when: this program cannot simulate them, or they gave no answer, because
    /// their rules may not admit this actor.
    avoided: Arc<Mutex<BTreeMap<String, (Instant, Duration)>>>,
    /// Most environments that an open run wanted when it was last asked.
    largest: Arc<AtomicU32>,
}

impl PoolPlace {
    /// Enters the pool.
    ///
    /// # Errors
    /// If the bus fails.
    pub fn enter(bus: &Bus, actor: &str, envs: u32) -> Result<Self, BusError> {
        let token = Box::new(pool_token(bus, actor, envs)?);
        let seeker = Seeker {
            bus: bus.clone(),
            actor: actor.to_string(),
            envs,
            avoided: Arc::default(),
            largest: Arc::default(),
        };
        Ok(Self { seeker, left: VecDeque::new(), _token: token })
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
        let mut calls = None;
        loop {
            let found = tokio::select! {
                found = self.seeker.seek(None) => found?,
                () = shutdown.wait() => return Ok(None),
            };
            if found.is_some() {
                return Ok(found);
            }
            // Only an actor that waits hears calls: of a large pool, most actors work.
            let room = match &mut calls {
                Some(room) => room,
                calls => calls.insert(PoolRoom::open(&self.seeker.bus)?),
            };
            if pause >= PAUSE_NOTICED && !has_notified {
                let largest = self.seeker.largest.load(Ordering::Relaxed);
                match (1..self.seeker.envs).contains(&largest) {
                    true => notify(&format!(
                        "no run can use {} environments of one actor: they want at most {largest} (run.envs_max); use a \
                         smaller --envs",
                        self.seeker.envs
                    )),
                    false => notify("no run needs this actor now; waiting for one"),
                }
                has_notified = true;
            }
            // Actors that came together do not search together.
            let jitter = 0.5
                + checksum(&[self.seeker.actor.as_bytes(), &pause.as_nanos().to_le_bytes()]) as f64 / u64::MAX as f64;
            let rested = async {
                tokio::select! {
                    () = tokio::time::sleep(pause.mul_f64(jitter)) => (2 * pause).min(PAUSE_MAX),
                    () = room.called() => {
                        tokio::time::sleep(PAUSE.mul_f64(jitter)).await;
                        PAUSE
                    }
                }
            };
            tokio::select! {
                next = rested => pause = next,
                () = shutdown.wait() => return Ok(None),
            }
        }
    }

    /// Keeps the deliveries of a run that the actor leaves: its learner may be paused, or away for a while.
    pub fn keep(&mut self, run: &str, deliveries: Deliveries) {
        self.left.retain_mut(|(_, of_run)| {
            while of_run.try_join_next().is_some() {}
            !of_run.is_empty()
        });
        if deliveries.is_empty() {
            return;
        }
        if self.left.len() >= LEFT_MAX {
            let given_up = self.left.pop_front().map(|(run, _)| run);
            tracing::warn!(run = given_up, "the last fragments for a run that does not answer are given up");
        }
        self.left.push_back((run.to_string(), deliveries));
    }

    /// Waits for the deliveries of an earlier membership in `run`, at most for `timeout`: the learner takes the fragments
    /// of an actor in their order.
    pub async fn settle(&mut self, run: &str, timeout: Duration) {
        while let Some(place) = self.left.iter().position(|(of, _)| of == run) {
            let Some((_, mut deliveries)) = self.left.remove(place) else { return };
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
        let avoided = {
            let mut avoided = lock(&self.avoided);
            avoided.retain(|_, (since, lasts)| since.elapsed() < *lasts);
            avoided.clone()
        };
        demands.retain(|demand| {
            let is_fit = demand.physics_version == PHYSICS_VERSION && !avoided.contains_key(&demand.run);
            demand.open && is_fit && present != Some(&demand.run)
        });
        let largest = demands.iter().map(PoolDemand::envs_wanted).max().unwrap_or_default();
        self.largest.store(largest, Ordering::Relaxed);
        let lack = |demand: &PoolDemand| i64::from(demand.envs_target) - i64::from(demand.envs);
        demands
            .sort_by_key(|demand| Reverse((lack(demand), checksum(&[demand.run.as_bytes(), self.actor.as_bytes()]))));
        // An actor without a run is of use beyond what a run should have, if those with room cannot have it.
        let rounds: &[bool] = if present.is_none() { &[false, true] } else { &[false] };
        for stranded in rounds {
            let join = PoolJoin { envs: self.envs, stranded: *stranded };
            for demand in demands.iter().filter(|demand| *stranded || lack(demand) > 0) {
                if lock(&self.avoided).contains_key(&demand.run) {
                    continue;
                }
                match ask_to_join(&self.bus, &demand.run, &self.actor, &join, ANSWER_TIMEOUT).await? {
                    Some(true) => return Ok(Some(demand.run.clone())),
                    Some(false) => {}
                    None => self.avoid(&demand.run, SILENT),
                }
            }
        }
        Ok(None)
    }

    /// Records why this program cannot work for a run. An operator may mend that.
    pub fn refuse(&self, run: &str, why: &ActorError) {
        tracing::warn!(run, why = error_chain(why), "this actor does not join the run");
        self.avoid(run, UNFIT);
    }

    fn avoid(&self, run: &str, lasts: Duration) {
        let mut avoided = lock(&self.avoided);
        if avoided.len() < AVOIDED_MAX {
            avoided.insert(run.to_string(), (Instant::now(), lasts));
        }
    }
}

fn lock<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}
