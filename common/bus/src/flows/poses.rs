//! Poses for viewers, published only while a subscriber exists.
//!
//! They travel on `treadmill/{run}/poses/{actor}`. The actor first checks whether a subscriber exists, which costs one read of
//! a flag. A slow link loses poses and delays nothing.

use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

use zenoh::{
    Wait,
    matching::MatchingListener,
    pubsub::Publisher,
    qos::{CongestionControl, Priority},
};

use crate::{Bus, BusError, keys};

/// Shared flag: whether a subscriber exists.
#[derive(Clone, Debug, Default)]
pub struct Watched(Arc<AtomicBool>);

impl Watched {
    /// Returns whether a subscriber exists now.
    #[must_use]
    pub fn now(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Sets the flag.
    pub fn set(&self, is_watched: bool) {
        self.0.store(is_watched, Ordering::Relaxed);
    }
}

/// Publishes an actor's poses.
pub struct PosePublisher {
    watched: Watched,
    publisher: Publisher<'static>,
    _listener: MatchingListener<()>,
}

impl PosePublisher {
    /// Declares the publisher and watches for subscribers to this actor's poses.
    pub fn open(bus: &Bus, run: &str, actor: &str) -> Result<Self, BusError> {
        let watched = Watched::default();
        let publisher = bus
            .session
            .declare_publisher(keys::poses(run, actor))
            .congestion_control(CongestionControl::Drop)
            .priority(Priority::Background)
            .wait()
            .map_err(BusError::flow("declaring poses"))?;
        let listener = publisher
            .matching_listener()
            .callback({
                let watched = watched.clone();
                move |status| watched.set(status.matching())
            })
            .wait()
            .map_err(BusError::flow("looking for viewers"))?;
        if publisher.matching_status().wait().is_ok_and(|status| status.matching()) {
            watched.set(true);
        }
        Ok(Self { watched, publisher, _listener: listener })
    }

    /// Returns the flag that says whether a subscriber exists.
    #[must_use]
    pub fn watched(&self) -> Watched {
        self.watched.clone()
    }

    /// Publishes a pose, or drops it if the link is busy.
    pub fn publish(&self, pose: Vec<u8>) {
        if let Err(error) = self.publisher.put(pose).wait() {
            tracing::debug!(%error, "pose not sent");
        }
    }
}
