//! Poses for viewers, published only while a subscriber exists.
//!
//! They travel on `treadmill/{run}/poses/{actor}`. The actor first checks whether a subscriber exists, which costs one
//! read of a flag. A slow link loses poses and delays nothing.

use zenoh::{
    Wait,
    matching::MatchingListener,
    pubsub::Publisher,
    qos::{CongestionControl, Priority},
};

use super::{
    subscription::{Feed, observe},
    watched::Watched,
};
use crate::{error::BusError, session::Bus};

/// Returns the key of an actor's poses.
fn key(run: &str, actor: &str) -> String {
    format!("treadmill/{run}/poses/{actor}")
}

/// Subscribes to the poses of an actor, or of every actor; at most `capacity` wait.
pub fn watch_poses(bus: &Bus, run: &str, actor: Option<&str>, capacity: usize) -> Result<Feed, BusError> {
    observe(bus, &key(run, actor.unwrap_or("*")), capacity)
}

/// Publishes an actor's poses.
pub struct PosePublisher {
    watched: Watched,
    // Before the publisher, with which it would vanish: Zenoh logs an error then.
    _listener: MatchingListener<()>,
    publisher: Publisher<'static>,
}

impl PosePublisher {
    /// Declares the publisher and watches for subscribers to this actor's poses.
    pub fn open(bus: &Bus, run: &str, actor: &str) -> Result<Self, BusError> {
        let publisher = bus
            .session
            .declare_publisher(key(run, actor))
            .congestion_control(CongestionControl::Drop)
            .priority(Priority::Background)
            .wait()
            .map_err(BusError::flow("declaring poses"))?;
        let (watched, listener) = Watched::follow(&publisher, "looking for viewers")?;
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
