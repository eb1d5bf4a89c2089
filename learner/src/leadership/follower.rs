//! Follows a run in a store: keeps its newest state loaded, and decides when to take over.

use std::time::{Duration, Instant};

use bytes::Bytes;
use treadmill_store::{Store, StoreError, Tag};

use super::{LeadershipError, Manifest, Status, read_manifest};
use crate::waiting::STALLED_AFTER;

/// Time after which a follower takes over from a leader whose liveliness token it has seen to go, if there is no progress.
const PATIENCE: Duration = Duration::from_secs(1);
/// The same for a leader that does not answer. Its token may stay for long: routers may repeat it to each other.
const PATIENCE_SILENT: Duration = Duration::from_secs(4);
/// The same for a leader that says that it waits for a write.
const PATIENCE_STALLED: Duration = Duration::from_secs(3);
/// The same without actors in sight: the follower itself may be the one that is cut off. Between these bounds it is
/// this many of the longest intervals between two states.
const PATIENCE_ALONE: (Duration, Duration) = (Duration::from_secs(5), Duration::from_secs(30));
const PATIENCE_ALONE_INTERVALS: u32 = 3;
/// Object of a trial write, beside the states. By its epoch, a leader removes one that was left.
const TRIAL: &str = "states/000000000000-trial";
/// Attempts to read a state before its leader removes it.
const READS_MAX: usize = 10;

/// What a follower sees of the leader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeaderSight {
    /// It answers.
    Answers,
    /// It answers that it waits for its disk or its store.
    Stalled,
    /// Its liveliness token is there, but it does not answer.
    Silent,
    /// Its token is not there.
    Absent,
}

/// What a follower sees on the bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sight {
    /// The leader.
    pub leader: LeaderSight,
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

/// Reads the newest state of a run, or `None` if the store holds none.
///
/// # Errors
/// If the store fails, the manifest is damaged, or the state that it names is missing.
pub fn newest_state(store: &Store) -> Result<Option<LoadedState>, LeadershipError> {
    let mut missing = None;
    for _ in 0..READS_MAX {
        let Some((manifest, tag)) = read_manifest(store)? else { return Ok(None) };
        match store.get(&manifest.state) {
            Ok((state, _)) => return Ok(Some(LoadedState { manifest, tag, state: state.into() })),
            // Its leader may have removed it since, and names a newer one.
            Err(why @ StoreError::Missing { .. }) => missing = Some(why),
            Err(why) => return Err(why.into()),
        }
    }
    missing.map_or(Ok(None), |why| Err(why.into()))
}

/// Since when a follower has seen the same at each look. A break begins each anew: a follower that was itself cut off,
/// from bus or store, knows nothing of that time.
#[derive(Clone, Copy, Debug, Default)]
struct Since {
    /// A leader that waits for a write.
    stalled: Option<Instant>,
    /// Actors, but no answer of the leader.
    silent: Option<Instant>,
    /// The same, and its token was not there, though it has answered before.
    absent: Option<Instant>,
    /// Neither actors nor the leader.
    alone: Option<Instant>,
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
    /// Since when the leader is missed, without progress.
    since: Since,
    /// Tag of the last manifest whose state was not there.
    stateless: Option<Tag>,
    /// Epoch of the last leader that has answered.
    answered: Option<u64>,
}

impl StateFollower {
    /// Follower of the run in `store`.
    #[must_use]
    pub fn new(store: &Store) -> Self {
        Self {
            store: store.clone(),
            loaded: None,
            changed: None,
            interval: Duration::ZERO,
            since: Since::default(),
            stateless: None,
            answered: None,
        }
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
    /// If the store fails, the manifest is damaged, or it still names a state that was missing before. What was loaded
    /// stays.
    pub fn refresh(&mut self, now: Instant) -> Result<(), LeadershipError> {
        let refreshed = self.load_newest(now);
        if refreshed.is_err() {
            self.since = Since::default();
        }
        refreshed
    }

    fn load_newest(&mut self, now: Instant) -> Result<(), LeadershipError> {
        let Some((manifest, tag)) = read_manifest(&self.store)? else { return Ok(()) };
        if self.loaded.as_ref().is_some_and(|loaded| loaded.tag == tag) {
            return Ok(());
        }
        // Also if its name is known: `control set` writes a state again.
        let state = match self.store.get(&manifest.state) {
            Ok((state, _)) => state.into(),
            // The leader has removed it since, which is progress: the manifest names a newer one.
            Err(StoreError::Missing { .. }) if self.stateless.as_ref() != Some(&tag) => {
                (self.since, self.stateless) = (Since::default(), Some(tag));
                return Ok(());
            }
            Err(why) => return Err(why.into()),
        };
        if let Some(changed) = self.changed {
            self.interval = self.interval.max(now.duration_since(changed));
        }
        (self.changed, self.since) = (Some(now), Since::default());
        self.loaded = Some(LoadedState { manifest, tag, state });
        Ok(())
    }

    /// Returns whether this learner can write to the store, and faster than a stalled leader. The trial is a state's
    /// size, because a full store may still take small objects. It is done before taking over from a leader that
    /// answers.
    #[must_use]
    pub fn try_write(&self) -> bool {
        let Some(loaded) = &self.loaded else { return false };
        let begun = Instant::now();
        let written = self.store.put(TRIAL, &loaded.state).and_then(|()| self.store.delete(TRIAL));
        written.is_ok() && begun.elapsed() < STALLED_AFTER
    }

    /// Returns whether it is time to take over. Call it after each [`Self::refresh`] that succeeded.
    pub fn is_due(&mut self, sight: Sight, now: Instant) -> bool {
        let Some(loaded) = &self.loaded else { return false };
        match loaded.manifest.status {
            Status::Released => return true,
            Status::Stopped | Status::Finished => return false,
            Status::Training => {}
        }
        let epoch = loaded.manifest.epoch;
        let is_missed = matches!(sight.leader, LeaderSight::Silent | LeaderSight::Absent);
        if !is_missed {
            self.answered = Some(epoch);
        }
        // A token that never came may still be on its way.
        let is_absent = sight.leader == LeaderSight::Absent && self.answered == Some(epoch);
        let begun = |is_seen: bool, since: Option<Instant>| is_seen.then(|| since.unwrap_or(now));
        self.since = Since {
            stalled: begun(sight.leader == LeaderSight::Stalled, self.since.stalled),
            silent: begun(is_missed && sight.actors, self.since.silent),
            absent: begun(is_missed && sight.actors && is_absent, self.since.absent),
            alone: begun(is_missed && !sight.actors, self.since.alone),
        };
        let Since { stalled, silent, absent, alone } = self.since;
        let patience_alone = (self.interval * PATIENCE_ALONE_INTERVALS).clamp(PATIENCE_ALONE.0, PATIENCE_ALONE.1);
        [(stalled, PATIENCE_STALLED), (silent, PATIENCE_SILENT), (absent, PATIENCE), (alone, patience_alone)]
            .iter()
            .any(|(since, patience)| since.is_some_and(|since| now.duration_since(since) >= *patience))
    }
}
