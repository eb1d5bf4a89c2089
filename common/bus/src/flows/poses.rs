//! Poses for those who watch, sent only while somebody does.
//!
//! They travel on `treadmill/{run}/poses/{actor}`. Whoever makes them asks first whether anybody listens, which costs one read
//! of a flag; a link that is too slow loses poses and holds nobody up.

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

/// Whether anybody listens at this moment.
#[derive(Clone, Debug, Default)]
pub struct Watched(Arc<AtomicBool>);

impl Watched {
    /// Whether anybody listens.
    #[must_use]
    pub fn now(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Says so; the bus does, and tests.
    pub fn set(&self, is_watched: bool) {
        self.0.store(is_watched, Ordering::Relaxed);
    }
}

/// An actor's end.
pub struct PosePublisher {
    watched: Watched,
    publisher: Publisher<'static>,
    _listener: MatchingListener<()>,
}

impl PosePublisher {
    /// Begins to look whether anybody listens to this actor.
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

    /// Tells from now on whether anybody listens.
    #[must_use]
    pub fn watched(&self) -> Watched {
        self.watched.clone()
    }

    /// Sends one, or leaves it out where the link is busy.
    pub fn tell(&self, pose: Vec<u8>) {
        if let Err(why) = self.publisher.put(pose).wait() {
            tracing::debug!("a pose could not be sent: {why}");
        }
    }
}
