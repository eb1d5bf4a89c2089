//! Announcements of new policies on `treadmill/{run}/policy/version`.

use treadmill_proto::PolicyAnnouncement;

use crate::{
    error::BusError,
    flows::subscription::{Feed, observe},
    session::Bus,
};

/// Returns the key of the announcements.
pub(super) fn key(run: &str) -> String {
    format!("treadmill/{run}/policy/version")
}

/// Announcements of new policies; only the newest is kept.
pub struct Announcements {
    feed: Feed,
}

impl Announcements {
    /// Waits for the next announcement. `None` if it is invalid or the session is closed.
    pub async fn next(&self) -> Option<PolicyAnnouncement> {
        PolicyAnnouncement::decode(&self.feed.arrival().await?.payload).ok()
    }
}

/// Subscribes to announcements.
pub fn watch_announcements(bus: &Bus, run: &str) -> Result<Announcements, BusError> {
    Ok(Announcements { feed: observe(bus, &key(run), 1)? })
}
