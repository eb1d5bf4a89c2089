//! Links of a session to its neighbours: what a log says of them, and whether there are any.

use zenoh::{Wait, sample::SampleKind};

use treadmill_runtime::shutdown::Shutdown;

use crate::{Bus, BusError, admission::rate_limited_log::RateLimitedLog};

impl Bus {
    /// Logs each link to a neighbour that comes or goes before a request to stop, with its endpoint, rate-limited.
    ///
    /// # Errors
    /// If the session is closed.
    pub fn log_links(&self, shutdown: Shutdown) -> Result<(), BusError> {
        let log = RateLimitedLog::default();
        let event = move |is_removed: bool, endpoint: &str, peer: String| {
            log.emit(|| match is_removed {
                true => tracing::warn!(endpoint, peer, "link lost"),
                false => tracing::info!(endpoint, peer, "linked"),
            });
        };
        self.session
            .info()
            .link_events_listener()
            .history(true)
            .callback(move |link| {
                if shutdown.asked() {
                    return;
                }
                let is_removed = link.kind() == SampleKind::Delete;
                let link = link.link();
                event(is_removed, link.dst().as_str(), link.zid().to_string());
            })
            .background()
            .wait()
            .map_err(BusError::flow("watching links"))
    }

    /// Returns whether there is a link to a learner or a router.
    pub fn is_linked(&self) -> bool {
        self.session.info().routers_zid().wait().next().is_some()
    }
}
