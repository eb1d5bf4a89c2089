//! A learner's side of the pool.

use std::{
    collections::{BTreeMap, BTreeSet},
    sync::{
        Arc, Mutex, PoisonError,
        mpsc::{Receiver, SyncSender, sync_channel},
    },
    time::Duration,
};

use treadmill_proto::{
    PoolAnswer, PoolDemand, PoolJoin,
    ident::check_ident,
    limits::{ENVS_MAX, SMALL_BYTES_MAX},
};
use zenoh::{
    Wait,
    bytes::ZBytes,
    handlers::{FifoChannel, FifoChannelHandler},
    pubsub::Subscriber,
    qos::Priority,
    query::{Query, Reply},
    sample::{Sample, SampleKind},
};

use super::{actor_key, demand_key, join_key, release_key, room_key};
use crate::{
    admission::rate_limited_log::RateLimitedLog,
    error::BusError,
    flows::{
        presence::{learner_key, run_of},
        shared::{last_part, publisher, reply_on, serve},
    },
    session::Bus,
};

/// Events of a learner that may wait. Further ones are dropped: demands are repeated, and actors ask again.
const QUEUE: usize = 4096;
/// Longest wait for the tokens of the pool.
const COUNT_TIMEOUT: Duration = Duration::from_secs(5);
/// Most actors of a pool that are tracked; further ones find no place.
const ACTORS_MAX: usize = 4096;

/// Event of a learner's pool.
pub enum PoolEvent {
    /// Another learner published its demand.
    Demand(PoolDemand),
    /// The learner of this run is gone.
    Gone(String),
    /// An actor would join.
    Join(PendingJoin),
    /// An actor or observer asks for the demand.
    Asked(PendingDemand),
    /// An actor came to the pool, or left it.
    Actors,
}

/// Actor that waits for the answer whether it is admitted.
pub struct PendingJoin {
    /// Name of the actor.
    pub actor: String,
    /// What it asked.
    pub join: PoolJoin,
    query: Query,
}

impl PendingJoin {
    /// Answers.
    pub fn answer(self, run: &str, admitted: bool) {
        let answer = PoolAnswer { admitted }.to_bytes();
        reply_on(&self.query, &join_key(run, &self.actor), answer, "answer of the pool");
    }
}

/// Question for the demand.
pub struct PendingDemand {
    query: Query,
}

impl PendingDemand {
    /// Answers.
    pub fn answer(self, demand: &PoolDemand) {
        reply_on(&self.query, &demand_key(&demand.run), demand.to_bytes(), "demand");
    }
}

/// Tokens of the pool, as they are being asked for.
struct Count {
    replies: FifoChannelHandler<Reply>,
    /// Actors that were known when it began.
    before: BTreeSet<String>,
    found: BTreeMap<String, u32>,
}

impl Count {
    /// Takes the answers that have come. Returns whether these are all.
    fn is_complete(&mut self) -> bool {
        loop {
            match self.replies.try_recv() {
                Ok(Some(reply)) => {
                    let token = reply.result().ok().map(|sample| sample.key_expr().to_string());
                    let read = token.as_deref().and_then(read_token);
                    self.found.extend(read.map(|(name, envs)| (name.to_string(), envs)));
                }
                Ok(None) => return false,
                Err(_) => return true,
            }
        }
    }
}

/// A learner's side of the pool.
pub struct PoolServer {
    bus: Bus,
    run: String,
    events: Receiver<PoolEvent>,
    actors: Arc<Mutex<BTreeMap<String, u32>>>,
    count: Option<Count>,
    publish_demand: Box<dyn Fn(Vec<u8>) + Send>,
    publish_room: Box<dyn Fn(Vec<u8>) + Send>,
    _subscribers: [Subscriber<()>; 3],
}

impl PoolServer {
    /// Opens the flows of a run.
    ///
    /// # Errors
    /// If the bus fails.
    pub fn open(bus: &Bus, run: &str) -> Result<Self, BusError> {
        let (sender, events) = sync_channel(QUEUE);
        let actors = Arc::default();
        let demands = bus
            .session
            .declare_subscriber(demand_key("*"))
            .callback(of_demands(sender.clone(), run.to_string()))
            .wait()
            .map_err(BusError::flow("listening to the demands of runs"))?;
        let tokens = bus
            .session
            .liveliness()
            .declare_subscriber(actor_key("*", "*"))
            .history(true)
            .callback(of_tokens(sender.clone(), Arc::clone(&actors)))
            .wait()
            .map_err(BusError::flow("watching the actors of the pool"))?;
        let gone = sender.clone();
        let learners = bus
            .session
            .liveliness()
            .declare_subscriber(learner_key("*"))
            .callback(move |sample: Sample| {
                if let (SampleKind::Delete, Some(run)) = (sample.kind(), run_of(sample.key_expr().as_str())) {
                    drop(gone.try_send(PoolEvent::Gone(run.to_string())));
                }
            })
            .wait()
            .map_err(BusError::flow("watching learners"))?;
        let (asked, refusals) = (sender.clone(), RateLimitedLog::default());
        serve(bus, demand_key(run), "answering with the demand", move |query| {
            drop(asked.try_send(PoolEvent::Asked(PendingDemand { query })));
        })?;
        serve(bus, join_key(run, "*"), "admitting actors", move |query| {
            let actor = last_part(query.key_expr().as_str()).to_string();
            let payload = query.payload().map(ZBytes::to_bytes).unwrap_or_default();
            match check_ident("actor", &actor).and_then(|()| PoolJoin::decode_checked(&payload)) {
                Ok(join) => drop(sender.try_send(PoolEvent::Join(PendingJoin { actor, join, query }))),
                Err(error) => refusals.emit(|| tracing::warn!(%error, "request to join rejected")),
            }
        })?;
        Ok(Self {
            bus: bus.clone(),
            run: run.to_string(),
            events,
            actors,
            count: None,
            publish_demand: Box::new(publisher(bus, demand_key(run))?),
            publish_room: Box::new(publisher(bus, room_key(run))?),
            _subscribers: [demands, tokens, learners],
        })
    }

    /// Returns the next event, or `None` if none comes within `timeout`.
    pub fn next(&self, timeout: Duration) -> Option<PoolEvent> {
        self.events.recv_timeout(timeout).ok()
    }

    /// Returns the environments of every actor of the pool.
    pub fn actors(&mut self) -> BTreeMap<String, u32> {
        let mut actors = self.actors.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(count) = &mut self.count
            && count.is_complete()
        {
            // Those that came or went meanwhile were announced.
            actors.retain(|name, _| count.found.contains_key(name) || !count.before.contains(name));
            let room = ACTORS_MAX.saturating_sub(actors.len());
            let missed = count.found.iter().filter(|(name, _)| !count.before.contains(*name)).take(room);
            let missed: Vec<_> = missed.map(|(name, envs)| (name.clone(), *envs)).collect();
            actors.extend(missed);
            self.count = None;
        }
        actors.clone()
    }

    /// Asks for all tokens of the pool: a session that joins other routers may miss some that were there before.
    ///
    /// # Errors
    /// If the bus fails.
    pub fn count_actors(&mut self) -> Result<(), BusError> {
        let before = self.actors.lock().unwrap_or_else(PoisonError::into_inner).keys().cloned().collect();
        let replies = self
            .bus
            .session
            .liveliness()
            .get(actor_key("*", "*"))
            .timeout(COUNT_TIMEOUT)
            .with(FifoChannel::new(ACTORS_MAX))
            .wait()
            .map_err(BusError::flow("counting the actors of the pool"))?;
        self.count = Some(Count { replies, before, found: BTreeMap::new() });
        Ok(())
    }

    /// Publishes the demand to the other learners.
    pub fn publish(&self, demand: &PoolDemand) {
        (self.publish_demand)(demand.to_bytes());
    }

    /// Calls actors that have no run.
    pub fn call_idle(&self) {
        (self.publish_room)(Vec::new());
    }

    /// Lets an actor look for another run.
    pub fn release(&self, actor: &str) {
        let key = release_key(&self.run, actor);
        if let Err(error) = self.bus.session.put(key, Vec::new()).priority(Priority::DataHigh).wait() {
            tracing::debug!(%error, "release not sent");
        }
    }
}

fn of_demands(sender: SyncSender<PoolEvent>, own: String) -> impl Fn(Sample) + Send + Sync {
    let rejections = RateLimitedLog::default();
    move |sample: Sample| {
        if sample.payload().len() > SMALL_BYTES_MAX {
            return;
        }
        match PoolDemand::decode_checked(&sample.payload().to_bytes()) {
            Ok(demand) if demand.run == own => {}
            Ok(demand) if sample.key_expr().as_str() == demand_key(&demand.run) => {
                drop(sender.try_send(PoolEvent::Demand(demand)));
            }
            Ok(demand) => rejections.emit(|| tracing::warn!(run = demand.run, "demand on the key of another run")),
            Err(error) => rejections.emit(|| tracing::warn!(%error, "demand of a run rejected")),
        }
    }
}

fn of_tokens(
    sender: SyncSender<PoolEvent>,
    actors: Arc<Mutex<BTreeMap<String, u32>>>,
) -> impl Fn(Sample) + Send + Sync {
    move |sample: Sample| {
        let Some((name, envs)) = read_token(sample.key_expr().as_str()) else { return };
        let mut actors = actors.lock().unwrap_or_else(PoisonError::into_inner);
        match sample.kind() {
            SampleKind::Put if actors.len() < ACTORS_MAX || actors.contains_key(name) => {
                actors.insert(name.to_string(), envs);
            }
            // The token of its successor of this name may have come first.
            SampleKind::Delete if actors.get(name) == Some(&envs) => drop(actors.remove(name)),
            _ => return,
        }
        drop(sender.try_send(PoolEvent::Actors));
    }
}

/// Returns name and environments of an actor from its token.
fn read_token(key: &str) -> Option<(&str, u32)> {
    let (name, envs) = key.strip_prefix("treadmill/@pool/actors/")?.split_once('/')?;
    let envs: u32 = envs.parse().ok()?;
    (check_ident("actor", name).is_ok() && (1..=ENVS_MAX).contains(&envs)).then_some((name, envs))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_token_names_actor_and_environments() {
        assert_eq!(read_token(&actor_key("host-1", "32")), Some(("host-1", 32)));
        for bad in ["0", "65537", "-1", "many", "3/2"] {
            assert_eq!(read_token(&actor_key("host-1", bad)), None, "{bad}");
        }
        assert_eq!(read_token(&actor_key("Host", "32")), None);
        assert_eq!(read_token("treadmill/run/actors/host-1"), None);
    }
}
