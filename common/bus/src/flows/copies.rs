//! Copies of accepted fragments for recorders and debuggers, made only while somebody listens.
//!
//! They travel on `treadmill/{run}/@rollouts/{actor}`. No wildcard matches a part of a key that begins with `@`, so whoever
//! watches `treadmill/**` does not get megabytes by accident. Training never waits for them: they are handed to a thread of
//! their own through a bounded queue, and what finds it full, or a link that is too slow, is left out. Fragments are numbered,
//! so that a recorder sees what it missed.

use std::sync::{
    Arc,
    atomic::{AtomicBool, AtomicUsize, Ordering},
    mpsc::{SyncSender, sync_channel},
};

use zenoh::{
    Wait,
    bytes::ZBytes,
    matching::MatchingListener,
    pubsub::Publisher,
    qos::{CongestionControl, Priority},
};

use crate::{Bus, BusError, keys};

/// Copies that may wait for the link.
const QUEUE: usize = 32;
/// Their bytes.
const QUEUE_BYTES_MAX: usize = 64 << 20;

/// The learner's end.
pub struct RolloutCopies {
    is_watched: Arc<AtomicBool>,
    waiting_bytes: Arc<AtomicUsize>,
    queue: SyncSender<(String, ZBytes)>,
    // Its only use is to tell whether anybody listens.
    _publisher: Publisher<'static>,
    _listener: MatchingListener<()>,
}

impl RolloutCopies {
    /// Begins to look whether anybody listens.
    pub fn open(bus: &Bus, run: &str) -> Result<Self, BusError> {
        let is_watched = Arc::new(AtomicBool::new(false));
        // One for all actors: a publisher for each name that ever sent something would be memory without bound.
        let publisher = bus
            .session
            .declare_publisher(keys::rollout_copies(run, "*"))
            .wait()
            .map_err(BusError::flow("declaring copies of fragments"))?;
        let listener = publisher
            .matching_listener()
            .callback({
                let is_watched = is_watched.clone();
                move |status| is_watched.store(status.matching(), Ordering::Relaxed)
            })
            .wait()
            .map_err(BusError::flow("looking for recorders"))?;
        if publisher.matching_status().wait().is_ok_and(|status| status.matching()) {
            is_watched.store(true, Ordering::Relaxed);
        }
        let (queue, waiting) = sync_channel::<(String, ZBytes)>(QUEUE);
        let waiting_bytes = Arc::new(AtomicUsize::new(0));
        std::thread::Builder::new()
            .name("rollout-copies".to_string())
            .spawn({
                let (session, run, waiting_bytes) = (bus.session.clone(), run.to_string(), waiting_bytes.clone());
                move || {
                    for (actor, fragment) in waiting {
                        let size = fragment.len();
                        let sent = session
                            .put(keys::rollout_copies(&run, &actor), fragment)
                            .congestion_control(CongestionControl::Drop)
                            .priority(Priority::Background)
                            .wait();
                        waiting_bytes.fetch_sub(size, Ordering::Relaxed);
                        if let Err(why) = sent {
                            tracing::debug!("a copy of a fragment could not be sent: {why}");
                        }
                    }
                }
            })
            .map_err(|why| BusError::Flow { what: "starting the copies' thread".to_string(), why: why.to_string() })?;
        Ok(Self { is_watched, waiting_bytes, queue, _publisher: publisher, _listener: listener })
    }

    /// Whether anybody listens at this moment.
    pub fn is_watched(&self) -> bool {
        self.is_watched.load(Ordering::Relaxed)
    }

    /// Tells it from now on.
    pub(super) fn watch(&self) -> Arc<AtomicBool> {
        self.is_watched.clone()
    }

    /// Hands a copy over, or leaves it out where too many wait.
    pub fn offer(&self, actor: &str, fragment: impl Into<ZBytes>) {
        let fragment = fragment.into();
        let size = fragment.len();
        let waiting = self.waiting_bytes.fetch_add(size, Ordering::Relaxed);
        if waiting + size > QUEUE_BYTES_MAX || self.queue.try_send((actor.to_string(), fragment)).is_err() {
            self.waiting_bytes.fetch_sub(size, Ordering::Relaxed);
            tracing::debug!("a copy of a fragment of `{actor}` was left out: {waiting} bytes wait already");
        }
    }
}
