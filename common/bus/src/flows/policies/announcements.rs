//! Announcements of new policies on `treadmill/{run}/policy/version`.

use treadmill_proto::PolicyAnnouncement;
use zenoh::{
    Wait,
    handlers::{RingChannel, RingChannelHandler},
    pubsub::Subscriber,
    sample::Sample,
};

use crate::{error::BusError, session::Bus};

/// Returns the key of the announcements.
pub(super) fn key(run: &str) -> String {
    format!("treadmill/{run}/policy/version")
}

/// Announcements of new policies; only the newest is kept.
pub struct Announcements {
    ring: Subscriber<RingChannelHandler<Sample>>,
}

impl Announcements {
    /// Waits for the next announcement. `None` if it is invalid or the session is closed.
    pub async fn next(&self) -> Option<PolicyAnnouncement> {
        let sample = self.ring.recv_async().await.ok()?;
        PolicyAnnouncement::decode(&sample.payload().to_bytes()).ok()
    }
}

/// Subscribes to announcements.
pub fn watch_announcements(bus: &Bus, run: &str) -> Result<Announcements, BusError> {
    let ring = bus
        .session
        .declare_subscriber(key(run))
        .with(RingChannel::new(1))
        .wait()
        .map_err(BusError::flow("listening to announcements"))?;
    Ok(Announcements { ring })
}
