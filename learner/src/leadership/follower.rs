//! Follows a run in a store: keeps its newest state loaded, and decides when to take over.

use std::time::{Duration, Instant};

use bytes::Bytes;
use treadmill_store::{Store, StoreError, Tag};

use super::{LeadershipError, Manifest, Status, read_manifest};

/// Time without the leader's liveliness token and without progress after which a follower that sees actors takes over. The
/// token itself goes only after the bus's lease of 4 s, unless the leader's connection ends.
const PATIENCE: Duration = Duration::from_secs(1);
/// The same without actors in sight: the follower itself may be the one that is cut off.
const PATIENCE_ALONE: Duration = Duration::from_secs(5);
/// The same, in longest intervals between two states.
const PATIENCE_ALONE_INTERVALS: u32 = 3;

/// What a follower sees on the bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sight {
    /// Whether the leader's liveliness token is there.
    pub leader: bool,
    /// Whether any actor's is.
    pub actors: bool,
}

/// Newest state that a follower has loaded.
#[derive(Clone, Debug)]
pub struct LoadedState {
    /// Manifest that names it.
    pub manifest: Manifest,
    /// Tag of the manifest.
    pub tag: Tag,
    /// Encoded state.
    pub state: Bytes,
}

/// Follows one run.
#[derive(Clone, Debug)]
pub struct StateFollower {
    store: Store,
    loaded: Option<LoadedState>,
    /// When the manifest last changed, as this follower saw it.
    changed: Option<Instant>,
    /// Longest time between two changes.
    interval: Duration,
    /// Since when the leader's token is missing without progress.
    missing_since: Option<Instant>,
}

impl StateFollower {
    /// StateFollower of the run in `store`.
    #[must_use]
    pub fn new(store: &Store) -> Self {
        Self { store: store.clone(), loaded: None, changed: None, interval: Duration::ZERO, missing_since: None }
    }

    /// Returns the newest state that was loaded, by value.
    #[must_use]
    pub fn into_loaded(self) -> Option<LoadedState> {
        self.loaded
    }

    /// Returns the newest state that was loaded.
    #[must_use]
    pub fn loaded(&self) -> Option<&LoadedState> {
        self.loaded.as_ref()
    }

    /// Loads the newest state if the manifest has changed. Without a manifest, nothing is loaded.
    ///
    /// # Errors
    /// If the store fails or the manifest is damaged. What was loaded before stays.
    pub fn refresh(&mut self, now: Instant) -> Result<(), LeadershipError> {
        let Some((manifest, tag)) = read_manifest(&self.store)? else { return Ok(()) };
        if self.loaded.as_ref().is_some_and(|loaded| loaded.tag == tag) {
            return Ok(());
        }
        let known = self.loaded.as_ref().filter(|loaded| loaded.manifest.state == manifest.state);
        let state = match known {
            Some(loaded) => loaded.state.clone(),
            None => match self.store.get(&manifest.state) {
                Ok((state, _)) => state.into(),
                // The leader has removed it since: the manifest names a newer one.
                Err(StoreError::Missing { .. }) => return Ok(()),
                Err(why) => return Err(why.into()),
            },
        };
        if let Some(changed) = self.changed {
            self.interval = self.interval.max(now.duration_since(changed));
        }
        (self.changed, self.missing_since) = (Some(now), None);
        self.loaded = Some(LoadedState { manifest, tag, state });
        Ok(())
    }

    /// Returns whether it is time to take over. Call it after each [`Self::refresh`] that succeeded.
    pub fn is_due(&mut self, sight: Sight, now: Instant) -> bool {
        let Some(loaded) = &self.loaded else { return false };
        match loaded.manifest.status {
            Status::Released => return true,
            Status::Stopped | Status::Finished => return false,
            Status::Training => {}
        }
        if sight.leader {
            self.missing_since = None;
            return false;
        }
        let since = *self.missing_since.get_or_insert(now);
        let alone = PATIENCE_ALONE.max(self.interval * PATIENCE_ALONE_INTERVALS);
        now.duration_since(since) >= if sight.actors { PATIENCE } else { alone }
    }
}
