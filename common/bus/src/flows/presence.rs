//! Liveliness: actors and the learner hold tokens, and the learner knows which actors are alive.

use std::{
    collections::BTreeSet,
    sync::{
        Arc, Mutex,
        atomic::{AtomicU64, Ordering},
    },
    time::Duration,
};

use treadmill_proto::ident::check_ident;
use zenoh::{
    Wait,
    liveliness::LivelinessToken,
    pubsub::Subscriber,
    sample::{Sample, SampleKind},
};

use super::shared::last_part;
use crate::{error::BusError, session::Bus, workarounds::kept_routes::KeptRoutes};

/// Most actors that are tracked; further tokens are ignored.
const ACTORS_MAX: usize = 4096;

/// Most runs that [`live_runs`] returns.
const RUNS_MAX: usize = 64;

/// Returns `treadmill/{run}/actors/{actor}`, the key of an actor's token.
fn actor_key(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/actors/{actor}")
}

/// Returns `treadmill/{run}/actors/{actor}/stats`, the key of an actor's statistics.
pub(super) fn stats_key(run: &str, actor: &str) -> String {
    actor_key(run, actor) + "/stats"
}

/// Returns `treadmill/{run}/learner`, the key of the learner's token.
pub(super) fn learner_key(run: &str) -> String {
    format!("treadmill/{run}/learner")
}

/// Returns the run in a key of [`learner_key`].
pub(super) fn run_of(key: &str) -> Option<&str> {
    key.strip_prefix("treadmill/")?.strip_suffix("/learner")
}

/// Declares an actor's liveliness token, which lasts until it is dropped.
pub fn token(bus: &Bus, run: &str, actor: &str) -> Result<impl Send + Sync + use<>, BusError> {
    bus.session
        .liveliness()
        .declare_token(actor_key(run, actor))
        .wait()
        .map_err(BusError::flow("declaring the actor's token"))
}

/// Returns whether an actor of this name holds a token now; `*` stands for any actor.
///
/// # Errors
/// If the bus fails. No answer within `timeout` counts as no.
pub async fn is_actor_present(bus: &Bus, run: &str, actor: &str, timeout: Duration) -> Result<bool, BusError> {
    is_present(bus, actor_key(run, actor), timeout).await
}

async fn is_present(bus: &Bus, key: String, timeout: Duration) -> Result<bool, BusError> {
    let query = bus.session.liveliness().get(key).timeout(timeout).wait();
    let replies = query.map_err(BusError::flow("looking for a token"))?;
    while let Ok(reply) = replies.recv_async().await {
        if reply.result().is_ok() {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Returns whether a learner of this run holds a token now.
///
/// # Errors
/// If the bus fails. No answer within `timeout` counts as no.
pub async fn is_learner_present(bus: &Bus, run: &str, timeout: Duration) -> Result<bool, BusError> {
    is_present(bus, learner_key(run), timeout).await
}

/// Returns the names of the runs whose learners hold tokens now, in order.
///
/// # Errors
/// If the bus fails. No answer within `timeout` counts as none.
pub async fn live_runs(bus: &Bus, timeout: Duration) -> Result<Vec<String>, BusError> {
    let query = bus.session.liveliness().get(learner_key("*")).timeout(timeout).wait();
    let replies = query.map_err(BusError::flow("looking for learners' tokens"))?;
    let mut runs = BTreeSet::new();
    while let Ok(reply) = replies.recv_async().await {
        let run = reply.result().ok().and_then(|sample| run_of(sample.key_expr().as_str()).map(String::from));
        if runs.len() < RUNS_MAX {
            runs.extend(run.filter(|run| check_ident("run", run).is_ok()));
        }
    }
    Ok(runs.into_iter().collect())
}

/// Live actors, by liveliness token.
pub struct Alive {
    view: AliveView,
    run: String,
    kept_routes: KeptRoutes,
    _subscriber: Subscriber<()>,
    _token: LivelinessToken,
}

impl Alive {
    /// Declares the learner's own token and subscribes to those of actors.
    pub fn watch(bus: &Bus, run: &str) -> Result<Self, BusError> {
        let view = AliveView::default();
        let subscriber = bus
            .session
            .liveliness()
            .declare_subscriber(actor_key(run, "*"))
            .history(true)
            .callback({
                let AliveView { actors, changes } = view.clone();
                move |sample: Sample| {
                    let actor = last_part(sample.key_expr().as_str());
                    let mut actors = actors.lock().expect("no holder of this lock panics");
                    match sample.kind() {
                        SampleKind::Put if actors.len() < ACTORS_MAX && check_ident("actor", actor).is_ok() => {
                            actors.insert(actor.to_string());
                        }
                        SampleKind::Put => {}
                        SampleKind::Delete => drop(actors.remove(actor)),
                    }
                    changes.fetch_add(1, Ordering::Release);
                }
            })
            .wait()
            .map_err(BusError::flow("watching actors"))?;
        let token = bus
            .session
            .liveliness()
            .declare_token(learner_key(run))
            .wait()
            .map_err(BusError::flow("declaring the learner's token"))?;
        let kept_routes = KeptRoutes::new(&bus.session);
        Ok(Self { view, run: run.to_string(), kept_routes, _subscriber: subscriber, _token: token })
    }

    /// Returns a view for another thread.
    pub fn view(&self) -> AliveView {
        self.view.clone()
    }

    /// Returns the names of the live actors.
    pub fn actors(&mut self) -> BTreeSet<String> {
        let actors = self.view.actors();
        self.kept_routes.set_actors(&actors, |actor| stats_key(&self.run, actor));
        actors
    }

    /// Returns a number that changes whenever the live actors do.
    pub fn changes(&self) -> u64 {
        self.view.changes.load(Ordering::Acquire)
    }
}

/// Live actors, as another thread sees them.
#[derive(Clone, Default)]
pub struct AliveView {
    actors: Arc<Mutex<BTreeSet<String>>>,
    changes: Arc<AtomicU64>,
}

impl AliveView {
    /// Returns the names of the live actors.
    pub fn actors(&self) -> BTreeSet<String> {
        self.actors.lock().expect("no holder of this lock panics").clone()
    }

    /// Returns whether this actor is alive.
    pub fn has(&self, actor: &str) -> bool {
        self.actors.lock().expect("no holder of this lock panics").contains(actor)
    }
}
