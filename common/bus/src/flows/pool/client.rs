//! An actor's side of the pool.

use std::{collections::BTreeMap, time::Duration};

use treadmill_proto::{PoolAnswer, PoolDemand, PoolJoin};
use zenoh::{
    Wait,
    handlers::{RingChannel, RingChannelHandler},
    pubsub::Subscriber,
    qos::Priority,
    sample::{Sample, SampleKind},
};

use super::{RUNS_MAX, actor_key, demand_key, join_key, release_key, room_key};
use crate::{
    error::BusError,
    flows::{
        presence::learner_key,
        shared::{ask, next_valid},
        subscription::{Feed, observe},
    },
    session::Bus,
};

/// Longest wait for a further answer.
const SILENCE: Duration = Duration::from_millis(300);

/// Declares the token of an actor in the pool, which lasts until it is dropped.
///
/// # Errors
/// If the bus fails.
pub fn pool_token(bus: &Bus, actor: &str, envs: u32) -> Result<impl Send + Sync + use<>, BusError> {
    let key = actor_key(actor, &envs.to_string());
    bus.session
        .liveliness()
        .declare_token(key)
        .wait()
        .map_err(BusError::flow("declaring the actor's token in the pool"))
}

/// Returns the demand of every learner that answers, one for each run: that of the newest epoch. A learner that hangs
/// delays the others' answers by [`SILENCE`].
///
/// # Errors
/// If the bus fails.
pub async fn pool_demands(bus: &Bus, timeout: Duration) -> Result<Vec<PoolDemand>, BusError> {
    let replies = ask(bus, demand_key("*"), Vec::new(), timeout, Priority::Data, "asking what runs want")?;
    let mut runs = BTreeMap::<String, PoolDemand>::new();
    let mut patience = timeout;
    loop {
        let next = next_valid(&replies, "demand", |bytes| PoolDemand::decode_checked(&bytes));
        let Ok(Some(demand)) = tokio::time::timeout(patience, next).await else { break };
        patience = SILENCE;
        let known = runs.get(&demand.run);
        if known.is_none_or(|known| known.epoch <= demand.epoch) && (known.is_some() || runs.len() < RUNS_MAX) {
            runs.insert(demand.run.clone(), demand);
        }
    }
    Ok(runs.into_values().collect())
}

/// Asks a run for a place. `None` if no answer came, as from a run whose rules do not admit this actor.
///
/// # Errors
/// If the bus fails.
pub async fn ask_to_join(
    bus: &Bus,
    run: &str,
    actor: &str,
    join: &PoolJoin,
    timeout: Duration,
) -> Result<Option<bool>, BusError> {
    let replies = ask(bus, join_key(run, actor), join.to_bytes(), timeout, Priority::Data, "asking for a place")?;
    let decode = |bytes: bytes::Bytes| PoolAnswer::decode_checked(&bytes);
    // Beside its successor, a learner that was overtaken may answer.
    let mut admitted = None;
    while let Some(answer) = next_valid(&replies, "answer of the pool", decode).await {
        admitted = Some(answer.admitted);
        if answer.admitted {
            break;
        }
    }
    Ok(admitted)
}

/// Calls to an actor that works for a run.
pub struct PoolCalls {
    release: Feed,
    learner: Subscriber<RingChannelHandler<Sample>>,
}

impl PoolCalls {
    /// Subscribes to the releases of an actor, and to the token of the run's learner.
    ///
    /// # Errors
    /// If the bus fails.
    pub fn open(bus: &Bus, run: &str, actor: &str) -> Result<Self, BusError> {
        let release = observe(bus, &release_key(run, actor), 1)?;
        let learner = bus
            .session
            .liveliness()
            .declare_subscriber(learner_key(run))
            .history(true)
            .with(RingChannel::new(4))
            .wait()
            .map_err(BusError::flow("watching the learner"))?;
        Ok(Self { release, learner })
    }

    /// Waits until the learner releases the actor. Cancel-safe.
    pub async fn released(&self) {
        if self.release.arrival().await.is_none() {
            std::future::pending().await
        }
    }

    /// Waits until the learner comes or goes; returns whether it is there. Cancel-safe.
    pub async fn learner(&self) -> bool {
        match self.learner.recv_async().await {
            Ok(sample) => sample.kind() == SampleKind::Put,
            Err(_) => std::future::pending().await,
        }
    }
}

/// Calls of runs that have room to actors that have no run.
pub struct PoolRoom {
    feed: Feed,
}

impl PoolRoom {
    /// Subscribes to the calls.
    ///
    /// # Errors
    /// If the bus fails.
    pub fn open(bus: &Bus) -> Result<Self, BusError> {
        Ok(Self { feed: observe(bus, &room_key("*"), 1)? })
    }

    /// Waits for a call. Cancel-safe.
    pub async fn called(&self) {
        if self.feed.arrival().await.is_none() {
            std::future::pending().await
        }
    }
}
