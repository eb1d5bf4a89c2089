//! Leadership of a run whose state is in a store: the store decides who may write it.
//!
//! After each update, the leader writes its state as a new object, then advances the manifest to it by a conditional
//! write. A learner that was overtaken fails at that write, and steps down before it announces anything.
//!
//! # Layout
//! - Here: [`Leadership`], which saves states.
//! - [`manifest`]: [`Manifest`], which names the newest state and its leader.
//! - `housekeeping`: thread that removes old states and notices a successor.
//! - [`follower`]: [`StateFollower`](follower::StateFollower), which keeps the newest state loaded and decides when to
//!   take over.

pub mod follower;
mod housekeeping;
pub mod manifest;
#[cfg(test)]
mod tests;

use std::{
    sync::{Arc, atomic::AtomicBool},
    time::{Duration, Instant},
};

use treadmill_runtime::{epoch, machine, seeds};
use treadmill_store::{Store, StoreError, Tag};

use self::housekeeping::Housekeeping;
pub use self::manifest::{Manifest, Status};
use crate::{
    checkpoint::Counters,
    waiting::{MayPass, Obstacle},
};

/// Name of the manifest.
pub(crate) const MANIFEST: &str = "manifest.json";
/// Folder of the states.
const STATES: &str = "states";
/// Pause between two attempts to end a leadership.
const END_PAUSE: Duration = Duration::from_millis(500);

/// Error of leading or following a run.
#[derive(Debug, thiserror::Error)]
pub enum LeadershipError {
    /// Another learner leads the run now.
    #[error(
        "another learner leads run `{run}` in epoch {epoch}: process {pid} on host {host}; this one was in epoch {own}"
    )]
    Overtaken {
        /// Name of the run.
        run: String,
        /// Epoch of this learner.
        own: u64,
        /// Epoch of the other one.
        epoch: u64,
        /// Its process.
        pid: u32,
        /// Its host.
        host: String,
    },
    /// The manifest is damaged, or of another version.
    #[error("the manifest in the store `{store}` cannot be used: {why}; restore it, or choose another --store")]
    Manifest {
        /// URL of the store.
        store: String,
        /// What is wrong.
        why: String,
    },
    /// The store failed.
    #[error(transparent)]
    Store(#[from] StoreError),
}

impl MayPass for LeadershipError {
    fn obstacle(&self) -> Option<Obstacle> {
        match self {
            Self::Store(source) => source.obstacle(),
            _ => None,
        }
    }
}

/// Reads the manifest of a store, if there is one, and its tag.
///
/// # Errors
/// If the store fails or the manifest is damaged.
pub fn read_manifest(store: &Store) -> Result<Option<(Manifest, Tag)>, LeadershipError> {
    match store.get(MANIFEST) {
        Ok((bytes, tag)) => {
            let manifest =
                Manifest::decode(&bytes).map_err(|why| LeadershipError::Manifest { store: store.to_string(), why })?;
            Ok(Some((manifest, tag)))
        }
        Err(StoreError::Missing { .. }) => Ok(None),
        Err(why) => Err(why.into()),
    }
}

/// Returns the name of a writer in manifests.
fn writer_name(writer: u64) -> String {
    format!("{writer:016x}")
}

/// Right to write a run's state, for as long as no other learner advances the manifest.
#[derive(Debug)]
pub struct Leadership {
    store: Store,
    epoch: u64,
    /// Number that distinguishes this learner from another one that tries the same epoch.
    writer: u64,
    /// Tag of the manifest as this learner knows it; `None` before the store's first manifest.
    tag: Option<Tag>,
    /// Manifest that this learner wrote last.
    manifest: Option<Manifest>,
    /// Number of states that this learner has saved, which is part of their names. A store may derive tags from an
    /// object's bytes, so each manifest must differ from the last one.
    saves: u64,
    /// `None` in simulations.
    housekeeping: Option<Housekeeping>,
}

impl Leadership {
    /// Prepares to lead after the manifest `last`; the first [`Self::save`] takes the lead.
    ///
    /// # Errors
    /// If the system refuses a thread.
    pub fn prepare(store: &Store, last: Option<&(Manifest, Tag)>) -> std::io::Result<Self> {
        let epoch = epoch::next(last.map_or(0, |(manifest, _)| manifest.epoch));
        let mut leadership = Self::simulated(store, last, seeds::unique());
        leadership.epoch = epoch;
        leadership.housekeeping = Some(Housekeeping::start(store, epoch, leadership.writer)?);
        Ok(leadership)
    }

    /// The same as process `writer`, without a clock or a thread: for simulations.
    #[must_use]
    pub fn simulated(store: &Store, last: Option<&(Manifest, Tag)>, writer: u64) -> Self {
        Self {
            store: store.clone(),
            epoch: last.map_or(0, |(manifest, _)| manifest.epoch) + 1,
            writer,
            tag: last.map(|(_, tag)| tag.clone()),
            manifest: None,
            saves: 0,
            housekeeping: None,
        }
    }

    /// Epoch of this learner.
    #[must_use]
    pub fn epoch(&self) -> u64 {
        self.epoch
    }

    /// The store.
    #[must_use]
    pub fn store(&self) -> &Store {
        &self.store
    }

    /// Returns a flag that is set once another learner is known to lead.
    #[must_use]
    pub fn overtaken(&self) -> Arc<AtomicBool> {
        self.housekeeping.as_ref().map(|housekeeping| housekeeping.overtaken.clone()).unwrap_or_default()
    }

    /// Makes an encoded state of `run` the newest. When this returns, the state is durable, and no learner of a lower epoch
    /// can write any more.
    ///
    /// # Errors
    /// [`LeadershipError::Overtaken`] if another learner leads. After another error, the same call may be repeated.
    pub fn save(&mut self, run: &str, counters: &Counters, encoded: &[u8]) -> Result<(), LeadershipError> {
        self.check()?;
        let Self { epoch, writer, saves, .. } = *self;
        let name = format!("{STATES}/{epoch:012}-{writer:016x}-{:010}-{saves:010}.bundle", counters.updates);
        self.store.put(&name, encoded)?;
        let manifest = Manifest {
            format: manifest::FORMAT,
            run: run.to_string(),
            epoch: self.epoch,
            writer: writer_name(self.writer),
            updates: counters.updates,
            env_steps: counters.env_steps,
            state: name,
            status: Status::Training,
            host: machine::host_name(),
            pid: std::process::id(),
            program_version: treadmill_runtime::program::version().to_string(),
        };
        self.advance(manifest)?;
        self.saves += 1;
        self.housekeeping.iter().for_each(Housekeeping::note_saved);
        Ok(())
    }

    /// Ends the leadership: says in the manifest why, so that standbys know at once. Tries again while the store fails, for
    /// at most about `within`.
    ///
    /// # Errors
    /// As [`Self::save`].
    pub fn end(&mut self, status: Status, within: Duration) -> Result<(), LeadershipError> {
        let Some(manifest) = self.manifest.clone() else { return Ok(()) };
        let begun = Instant::now();
        loop {
            match self.advance(Manifest { status, ..manifest.clone() }) {
                Err(LeadershipError::Store(_)) if begun.elapsed() + END_PAUSE < within => {
                    std::thread::sleep(END_PAUSE);
                }
                ended => return ended,
            }
        }
    }

    /// Returns an error if another learner leads by the store's manifest. Something else may lead as soon as this
    /// returns, so only [`Self::save`] decides what counts.
    ///
    /// # Errors
    /// [`LeadershipError::Overtaken`], or if the store fails.
    pub fn confirm(&self) -> Result<(), LeadershipError> {
        match read_manifest(&self.store)? {
            Some((found, _)) if found.writer != writer_name(self.writer) => Err(self.overtaken_by(&found)),
            _ => Ok(()),
        }
    }

    /// Returns an error if another learner is known to lead.
    ///
    /// # Errors
    /// [`LeadershipError::Overtaken`].
    pub fn check(&self) -> Result<(), LeadershipError> {
        self.housekeeping
            .as_ref()
            .and_then(|housekeeping| housekeeping.successor.get())
            .map_or(Ok(()), |successor| Err(self.overtaken_by(successor)))
    }

    /// Replaces the manifest by a conditional write.
    fn advance(&mut self, manifest: Manifest) -> Result<(), LeadershipError> {
        let bytes = manifest.encode();
        let tag = match self.store.replace(MANIFEST, &bytes, self.tag.as_ref()) {
            Ok(tag) => tag,
            // The write, or one whose answer was lost, may have taken effect all the same.
            Err(why) => match read_manifest(&self.store)? {
                Some((found, tag)) if found == manifest => tag,
                // An earlier write of this learner whose answer was lost.
                Some((found, tag)) if found.writer == manifest.writer && Some(&tag) != self.tag.as_ref() => {
                    self.tag = Some(tag);
                    return self.advance(manifest);
                }
                Some((found, tag)) if Some(&tag) != self.tag.as_ref() => return Err(self.overtaken_by(&found)),
                _ => return Err(why.into()),
            },
        };
        (self.tag, self.manifest) = (Some(tag), Some(manifest));
        Ok(())
    }

    fn overtaken_by(&self, successor: &Manifest) -> LeadershipError {
        LeadershipError::Overtaken {
            run: successor.run.clone(),
            own: self.epoch,
            epoch: successor.epoch,
            pid: successor.pid,
            host: successor.host.clone(),
        }
    }
}
