//! Copies of accepted fragments for recorders and debuggers, made only while a subscriber exists.
//!
//! They travel on `treadmill/{run}/@rollouts/{actor}`. No wildcard matches a key part that begins with `@`, so a subscriber
//! of `treadmill/**` does not receive megabytes by accident. Training never waits for copies: a thread takes them from a
//! bounded queue, and copies that find it or the link full are dropped. Fragments are numbered, so a recorder sees gaps.

use std::sync::{
    Arc,
    atomic::{AtomicUsize, Ordering},
    mpsc::{Receiver, SyncSender, sync_channel},
};

use zenoh::{
    Session, Wait,
    bytes::ZBytes,
    matching::MatchingListener,
    pubsub::Publisher,
    qos::{CongestionControl, Priority},
};

use crate::{
    error::BusError,
    flows::{shared::start_thread, watched::Watched},
    session::Bus,
};

/// Copies that may wait for the link.
const QUEUE: usize = 32;
/// Bytes of copies that may wait for the link.
const QUEUE_BYTES_MAX: usize = 64 << 20;

/// Returns the key of an actor's copies; `*` stands for any actor.
fn key(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/@rollouts/{actor}")
}

/// Sends copies of accepted fragments.
pub struct RolloutCopies {
    watched: Watched,
    waiting_bytes: Arc<AtomicUsize>,
    queue: SyncSender<(String, ZBytes)>,
    // Before the publisher, with which it would vanish: Zenoh logs an error then.
    _listener: MatchingListener<()>,
    /// Reports whether a subscriber exists; it publishes nothing.
    _publisher: Publisher<'static>,
}

impl RolloutCopies {
    /// Starts the thread and watches for subscribers.
    pub fn open(bus: &Bus, run: &str) -> Result<Self, BusError> {
        // One publisher for all actors: one for each name ever seen would need unbounded memory.
        let publisher = bus
            .session
            .declare_publisher(key(run, "*"))
            .wait()
            .map_err(BusError::flow("declaring copies of fragments"))?;
        let (watched, listener) = Watched::follow(&publisher, "looking for recorders")?;
        let (queue, waiting) = sync_channel::<(String, ZBytes)>(QUEUE);
        let waiting_bytes = Arc::new(AtomicUsize::new(0));
        start_thread("rollout-copies", {
            let (session, run, waiting_bytes) = (bus.session.clone(), run.to_string(), waiting_bytes.clone());
            move || send(&session, &run, waiting, &waiting_bytes)
        })?;
        Ok(Self { watched, waiting_bytes, queue, _publisher: publisher, _listener: listener })
    }

    /// Returns the flag that says whether a subscriber exists.
    pub fn watched(&self) -> Watched {
        self.watched.clone()
    }

    /// Queues a copy, or drops it if too many wait.
    pub fn offer(&self, actor: &str, fragment: impl Into<ZBytes>) {
        let fragment = fragment.into();
        let size = fragment.len();
        let waiting_bytes = self.waiting_bytes.fetch_add(size, Ordering::Relaxed);
        if waiting_bytes + size > QUEUE_BYTES_MAX || self.queue.try_send((actor.to_string(), fragment)).is_err() {
            self.waiting_bytes.fetch_sub(size, Ordering::Relaxed);
            tracing::debug!(actor, waiting_bytes, "fragment copy dropped: queue full");
        }
    }
}

fn send(session: &Session, run: &str, waiting: Receiver<(String, ZBytes)>, waiting_bytes: &AtomicUsize) {
    for (actor, fragment) in waiting {
        let size = fragment.len();
        let sent = session
            .put(key(run, &actor), fragment)
            .congestion_control(CongestionControl::Drop)
            .priority(Priority::Background)
            .wait();
        waiting_bytes.fetch_sub(size, Ordering::Relaxed);
        if let Err(error) = sent {
            tracing::debug!(%error, "fragment copy not sent");
        }
    }
}
