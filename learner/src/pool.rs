//! The run's part in the pool of actors that belong to no run, on a thread of its own.

use std::{
    collections::BTreeMap,
    io,
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicBool, Ordering},
        mpsc::{self, Receiver},
    },
    thread,
    time::{Duration, Instant},
};

use treadmill_bus::{
    Bus, BusError,
    learner::{AliveView, PoolEvent, PoolServer},
};
use treadmill_config::RunConfig;
use treadmill_experience::pool::PoolShare;
use treadmill_proto::{
    PoolDemand,
    pool::{DEMAND_LASTS, RUN_ENVS_MAX},
};

/// Most events that are answered with one view.
const EVENTS_MAX: usize = 1024;
/// Longest wait for the thread when the run ends.
const END_TIMEOUT: Duration = Duration::from_secs(1);
/// Longest wait for an event.
const TICK: Duration = Duration::from_millis(100);
/// Shortest time between two publications of a changed demand, and longest time between two of any.
const PUBLISH_MIN: Duration = Duration::from_millis(500);
const PUBLISH_MAX: Duration = Duration::from_secs(5);
/// Time to the first count of the pool's actors, whose tokens may have been missed; and between two.
const COUNT_FIRST: Duration = Duration::from_secs(2);
const COUNT_EVERY: Duration = Duration::from_secs(180);
/// Time for which an actor without a token counts, and most such actors.
const GUEST: Duration = Duration::from_secs(60);
const GUESTS_MAX: usize = 1024;
/// Time between two calls for actors, or to one that should leave: a call may get lost.
const CALL_EVERY: Duration = Duration::from_secs(1);
const _: () = assert!(PUBLISH_MAX.as_secs() * 3 < DEMAND_LASTS.as_secs());

/// What the training thread says about the run.
#[derive(Clone, Debug)]
pub struct PoolWish {
    /// Weight of the run.
    pub share: f64,
    /// Smallest useful number of environments.
    pub envs_min: u32,
    /// Largest useful number of environments.
    pub envs_max: u32,
    /// Whether it takes actors.
    pub is_open: bool,
    /// Environments of each actor that has sent a fragment.
    pub envs: Arc<BTreeMap<String, u32>>,
}

impl PoolWish {
    /// What the configuration says.
    pub fn of(run: &RunConfig) -> Self {
        let RunConfig { share, envs_min, envs_max, .. } = *run;
        Self { share, envs_min, envs_max, is_open: true, envs: Arc::default() }
    }
}

/// Part of a run in the pool. When it is dropped, its actors go to other runs.
pub struct Pool {
    wish: Arc<Mutex<PoolWish>>,
    demand: Arc<Mutex<PoolDemand>>,
    closed: Arc<AtomicBool>,
    /// Disconnected once the thread has ended.
    ended: Receiver<()>,
}

impl Pool {
    /// Opens the part of a run, whose live actors `alive` has; `demand` has its name, physics and epoch.
    ///
    /// # Errors
    /// If the bus or the system fails.
    pub fn open(bus: &Bus, demand: PoolDemand, wish: PoolWish, alive: AliveView) -> Result<Self, BusError> {
        let server = PoolServer::open(bus, &demand.run)?;
        let (wish, closed) = (Arc::new(Mutex::new(wish)), Arc::new(AtomicBool::new(false)));
        let shown = Arc::new(Mutex::new(demand.clone()));
        let serving = Serving {
            share: PoolShare::new(demand),
            server,
            alive,
            begun: Instant::now(),
            published: None,
            called: Duration::ZERO,
            released: Duration::ZERO,
            guests: BTreeMap::new(),
            count_due: COUNT_FIRST,
        };
        let (running, ended) = mpsc::channel();
        let work = {
            let (wish, shown, closed) = (wish.clone(), shown.clone(), closed.clone());
            move || {
                serving.run(&wish, &shown, &closed);
                drop(running);
            }
        };
        thread::Builder::new().name("pool".to_string()).spawn(work).map_err(|why: io::Error| BusError::Flow {
            what: "starting the thread of the pool".into(),
            why: why.to_string(),
        })?;
        Ok(Self { wish, demand: shown, closed, ended })
    }

    /// Returns what the run wants of the pool and has of it.
    pub fn demand(&self) -> PoolDemand {
        lock(&self.demand).clone()
    }

    /// Changes what the run wants.
    pub fn set(&self, change: impl FnOnce(&mut PoolWish)) {
        change(&mut lock(&self.wish));
    }
}

impl Drop for Pool {
    fn drop(&mut self) {
        self.closed.store(true, Ordering::Relaxed);
        // A link to a peer that hangs may hold the thread, and a run must end all the same.
        let _ = self.ended.recv_timeout(END_TIMEOUT);
    }
}

fn lock<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

/// State of the thread. Times are since it began.
struct Serving {
    share: PoolShare,
    server: PoolServer,
    alive: AliveView,
    begun: Instant,
    /// Last published demand, and when.
    published: Option<(PoolDemand, Duration)>,
    called: Duration,
    released: Duration,
    /// Environments of actors that asked for a place and whose token is not here, and when they asked: the bus may lose
    /// tokens on the way between two routers.
    guests: BTreeMap<String, (u32, Duration)>,
    /// When the actors of the pool are counted next.
    count_due: Duration,
}

impl Serving {
    fn run(mut self, wish: &Mutex<PoolWish>, shown: &Mutex<PoolDemand>, closed: &AtomicBool) {
        while !closed.load(Ordering::Relaxed) {
            let event = self.server.next(TICK);
            let now = self.begun.elapsed();
            let wish = lock(wish).clone();
            self.look(&wish, now);
            // What came at the same time is answered with the same view. A flood must not stop the rest.
            let more = std::iter::from_fn(|| self.server.next(Duration::ZERO)).take(EVENTS_MAX);
            for event in event.into_iter().chain(more).collect::<Vec<_>>() {
                self.handle(event, now);
            }
            // Once for all demands that were heard.
            self.share.count();
            lock(shown).clone_from(self.share.demand());
            self.publish(now);
            self.call(now);
        }
        self.end();
    }

    /// Reads who is there and what the run wants.
    fn look(&mut self, wish: &PoolWish, now: Duration) {
        if now >= self.count_due {
            self.count_due = now + COUNT_EVERY;
            if let Err(error) = self.server.count_actors() {
                tracing::debug!(%error, "the actors of the pool are not counted");
            }
        }
        let mut pool = self.server.actors();
        self.guests.retain(|name, (_, asked)| !pool.contains_key(name) && now < *asked + GUEST);
        pool.extend(self.guests.iter().map(|(name, (envs, _))| (name.clone(), *envs)));
        let in_run = self.alive.actors();
        let own = in_run.iter().filter(|name| !pool.contains_key(*name)).filter_map(|name| wish.envs.get(name));
        let own = own.copied().fold(0, u32::saturating_add).min(RUN_ENVS_MAX);
        self.share.set(|demand| {
            demand.envs_own = own;
            demand.share = wish.share;
            (demand.envs_min, demand.envs_max) = (wish.envs_min, wish.envs_max);
            demand.open = wish.is_open;
        });
        self.share.set_actors(&pool, &in_run, now);
    }

    fn handle(&mut self, event: PoolEvent, now: Duration) {
        match event {
            PoolEvent::Demand(demand) => self.share.hear(demand, now),
            PoolEvent::Gone(run) => self.share.forget(&run),
            PoolEvent::Join(pending) => {
                if !self.share.knows(&pending.actor) && self.guests.len() < GUESTS_MAX {
                    self.guests.insert(pending.actor.clone(), (pending.join.envs, now));
                    self.share.add_actor(&pending.actor, pending.join.envs);
                }
                let is_admitted = self.share.admit(&pending.actor, pending.join.stranded, now);
                pending.answer(&self.share.demand().run.clone(), is_admitted);
            }
            PoolEvent::Asked(pending) => pending.answer(self.share.demand()),
            PoolEvent::Actors => {}
        }
    }

    /// Publishes the demand if it has changed, and now and then anyway.
    fn publish(&mut self, now: Duration) {
        let is_due = self.published.as_ref().is_none_or(|(before, at)| {
            let pause = if before == self.share.demand() { PUBLISH_MAX } else { PUBLISH_MIN };
            now >= *at + pause
        });
        if is_due {
            self.server.publish(self.share.demand());
            self.published = Some((self.share.demand().clone(), now));
        }
    }

    /// Calls actors without a run, and releases those that others need more.
    fn call(&mut self, now: Duration) {
        if now >= self.called + CALL_EVERY && self.share.has_room_for_idle() {
            self.server.call_idle();
            self.called = now;
        }
        if now >= self.released + CALL_EVERY {
            let leaving = self.share.releases(now);
            if !leaving.is_empty() {
                leaving.iter().for_each(|actor| self.server.release(actor));
                self.released = now;
            }
        }
    }

    /// Gives every actor free.
    fn end(&mut self) {
        self.share.set(|demand| demand.open = false);
        self.server.publish(self.share.demand());
        self.share.members().for_each(|actor| self.server.release(actor));
    }
}
