//! Statistics of actors.

use std::{
    collections::HashMap,
    sync::{Arc, Mutex},
};

use treadmill_proto::{ActorStats, limits::STATS_BYTES_MAX};
use zenoh::{Wait, pubsub::Subscriber, sample::Sample};

use super::{
    presence::{AliveView, stats_key},
    shared::{last_part, publisher},
};
use crate::{admission::rate_limited_log::RateLimitedLog, error::BusError, session::Bus};

/// Returns a function that publishes an actor's statistics. The bus may drop them.
pub fn publish_stats(bus: &Bus, run: &str, actor: &str) -> Result<impl Fn(Vec<u8>) + Send + Sync + use<>, BusError> {
    publisher(bus, stats_key(run, actor))
}

/// Newest statistics of each live actor.
pub struct StatsFeed {
    alive: AliveView,
    /// Encoded, so that a flood costs no decoding.
    arrived: Arc<Mutex<HashMap<String, Vec<u8>>>>,
    newest: HashMap<String, ActorStats>,
    rejections: RateLimitedLog,
    _subscriber: Subscriber<()>,
}

impl StatsFeed {
    /// Subscribes to the statistics of the run's actors.
    pub fn open(bus: &Bus, run: &str, alive: AliveView) -> Result<Self, BusError> {
        let arrived = Arc::new(Mutex::new(HashMap::new()));
        let subscriber = bus
            .session
            .declare_subscriber(stats_key(run, "*"))
            .callback({
                let (alive, arrived) = (alive.clone(), arrived.clone());
                move |sample: Sample| keep_newest(&sample, &alive, &arrived)
            })
            .wait()
            .map_err(BusError::flow("listening to statistics"))?;
        let (newest, rejections) = (HashMap::new(), RateLimitedLog::default());
        Ok(Self { alive, arrived, newest, rejections, _subscriber: subscriber })
    }

    /// Returns the statistics that arrived since the last call, or why they were rejected.
    pub fn take(&self) -> impl Iterator<Item = Result<ActorStats, String>> {
        let arrived = std::mem::take(&mut *self.arrived.lock().expect("no holder of this lock panics"));
        arrived.into_iter().map(|(actor, bytes)| match ActorStats::decode_checked(&bytes) {
            Ok(stats) if stats.actor == actor => Ok(stats),
            Ok(stats) => Err(format!("from `{actor}`: they name `{}`", stats.actor)),
            Err(error) => Err(format!("from `{actor}`: {error}")),
        })
    }

    /// Takes what arrived, forgets actors that are gone, and returns the newest statistics of each live actor.
    pub fn newest(&mut self) -> &HashMap<String, ActorStats> {
        let arrived: Vec<_> = self.take().collect();
        for stats in arrived {
            match stats {
                Ok(stats) => drop(self.newest.insert(stats.actor.clone(), stats)),
                Err(error) => self.rejections.emit(|| tracing::warn!(%error, "statistics rejected")),
            }
        }
        let alive = self.alive.actors();
        self.newest.retain(|actor, _| alive.contains(actor));
        &self.newest
    }
}

/// Keeps the sample as its actor's newest. Runs in the bus's receiving thread.
fn keep_newest(sample: &Sample, alive: &AliveView, arrived: &Mutex<HashMap<String, Vec<u8>>>) {
    let Some(actor) = sample.key_expr().as_str().strip_suffix("/stats").map(last_part) else { return };
    // Only live actors, whose number is limited: other names cannot fill the map.
    if sample.payload().len() > STATS_BYTES_MAX || !alive.has(actor) {
        return;
    }
    let bytes = sample.payload().to_bytes().into_owned();
    arrived.lock().expect("no holder of this lock panics").insert(actor.to_string(), bytes);
}
