//! Who takes part, as the learner sees it: who is alive, and what each tells about itself.

use std::{
    collections::{BTreeSet, HashMap},
    sync::{Arc, Mutex},
};

use treadmill_proto::{ActorStats, ident::check_ident, limits::STATS_BYTES_MAX};
use zenoh::{
    Wait,
    liveliness::LivelinessToken,
    pubsub::Subscriber,
    sample::{Sample, SampleKind},
};

use crate::{Bus, BusError, admission::rate_limited_log::RateLimitedLog, admission::read_throttle::ReadThrottle, keys};

/// Actors that are known to be alive, and whose statistics are kept; tokens beyond that are passed over.
const ACTORS_MAX: usize = 4096;
/// Statistics: so many a second at full speed.
const STATS_PER_S: f64 = 2000.0;

/// Who is alive, by liveliness token.
pub struct Alive {
    actors: Arc<Mutex<BTreeSet<String>>>,
    _subscriber: Subscriber<()>,
    _token: LivelinessToken,
}

impl Alive {
    /// Shows the learner's own token and begins to watch those of actors.
    pub fn watch(bus: &Bus, run: &str) -> Result<Self, BusError> {
        let actors = Arc::new(Mutex::new(BTreeSet::new()));
        let subscriber = bus
            .session
            .liveliness()
            .declare_subscriber(keys::actor(run, "*"))
            .history(true)
            .callback({
                let actors = actors.clone();
                move |sample: Sample| {
                    let actor = keys::last_part(sample.key_expr().as_str());
                    let mut actors = actors.lock().expect("no holder of this lock panics");
                    match sample.kind() {
                        SampleKind::Put if actors.len() < ACTORS_MAX && check_ident("actor", actor).is_ok() => {
                            actors.insert(actor.to_string());
                        }
                        SampleKind::Put => {}
                        SampleKind::Delete => drop(actors.remove(actor)),
                    }
                }
            })
            .wait()
            .map_err(BusError::flow("watching actors"))?;
        let token = bus
            .session
            .liveliness()
            .declare_token(keys::learner(run))
            .wait()
            .map_err(BusError::flow("declaring the learner's token"))?;
        Ok(Self { actors, _subscriber: subscriber, _token: token })
    }

    /// Lets another thread look, too.
    pub fn view(&self) -> AliveView {
        AliveView { actors: self.actors.clone() }
    }

    /// Names of the actors that are alive.
    pub fn actors(&self) -> BTreeSet<String> {
        self.actors.lock().expect("no holder of this lock panics").clone()
    }
}

/// Who is alive, as another thread sees it.
#[derive(Clone)]
pub struct AliveView {
    actors: Arc<Mutex<BTreeSet<String>>>,
}

impl AliveView {
    /// Names of the actors that are alive.
    pub fn actors(&self) -> BTreeSet<String> {
        self.actors.lock().expect("no holder of this lock panics").clone()
    }

    /// Whether this one is.
    pub fn has(&self, actor: &str) -> bool {
        self.actors.lock().expect("no holder of this lock panics").contains(actor)
    }
}

/// The newest statistics of each actor that is alive.
pub struct StatsFeed {
    alive: AliveView,
    /// As they came, so that a flood costs no decoding.
    arrived: Arc<Mutex<HashMap<String, Vec<u8>>>>,
    newest: HashMap<String, ActorStats>,
    complaints: RateLimitedLog,
    _subscriber: Subscriber<()>,
}

impl StatsFeed {
    /// Begins to listen.
    pub fn open(bus: &Bus, run: &str, alive: AliveView) -> Result<Self, BusError> {
        let arrived = Arc::new(Mutex::new(HashMap::new()));
        let subscriber = bus
            .session
            .declare_subscriber(keys::stats(run, "*"))
            .callback({
                let (alive, arrived, throttle) = (alive.clone(), arrived.clone(), ReadThrottle::new(STATS_PER_S));
                move |sample: Sample| {
                    throttle.pass();
                    keep_newest(&sample, &alive, &arrived);
                }
            })
            .wait()
            .map_err(BusError::flow("listening to statistics"))?;
        Ok(Self {
            alive,
            arrived,
            newest: HashMap::new(),
            complaints: RateLimitedLog::default(),
            _subscriber: subscriber,
        })
    }

    /// Statistics that came since the last call, or what is wrong with them.
    pub fn take(&self) -> impl Iterator<Item = Result<ActorStats, String>> {
        let arrived = std::mem::take(&mut *self.arrived.lock().expect("no holder of this lock panics"));
        arrived.into_iter().map(|(actor, bytes)| match ActorStats::decode_checked(&bytes) {
            Ok(stats) if stats.actor == actor => Ok(stats),
            Ok(stats) => Err(format!("statistics of `{}` came on the key of `{actor}` and were refused", stats.actor)),
            Err(why) => Err(format!("statistics from `{actor}` were refused: {why}")),
        })
    }

    /// Takes what came and forgets who is gone.
    pub fn newest(&mut self) -> &HashMap<String, ActorStats> {
        let taken: Vec<_> = self.take().collect();
        for stats in taken {
            match stats {
                Ok(stats) => drop(self.newest.insert(stats.actor.clone(), stats)),
                Err(wrong) => self.complaints.warn(|| wrong),
            }
        }
        let alive = self.alive.actors();
        self.newest.retain(|actor, _| alive.contains(actor));
        &self.newest
    }
}

/// Runs in the bus's receiving thread.
fn keep_newest(sample: &Sample, alive: &AliveView, arrived: &Mutex<HashMap<String, Vec<u8>>>) {
    let Some(actor) = keys::stats_actor(sample.key_expr().as_str()) else { return };
    // Only names of the living, of which there are so many at most: nobody can fill it with others.
    if sample.payload().len() > STATS_BYTES_MAX || !alive.has(actor) {
        return;
    }
    let bytes = sample.payload().to_bytes().into_owned();
    arrived.lock().expect("no holder of this lock panics").insert(actor.to_string(), bytes);
}
