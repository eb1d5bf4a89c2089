//! Flag that says whether a publisher has subscribers.

use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

use zenoh::{Wait, matching::MatchingListener, pubsub::Publisher};

use crate::error::BusError;

/// Shared flag: whether a subscriber exists.
#[derive(Clone, Debug, Default)]
pub struct Watched(Arc<AtomicBool>);

impl Watched {
    /// Returns the flag of `publisher`, and the listener that sets it; `what` names the operation in errors.
    pub(in crate::flows) fn follow(
        publisher: &Publisher,
        what: &str,
    ) -> Result<(Self, MatchingListener<()>), BusError> {
        let watched = Self::default();
        let listener = publisher
            .matching_listener()
            .callback({
                let watched = watched.clone();
                move |status| watched.set(status.matching())
            })
            .wait()
            .map_err(BusError::flow(what))?;
        if publisher.matching_status().wait().is_ok_and(|status| status.matching()) {
            watched.set(true);
        }
        Ok((watched, listener))
    }

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
