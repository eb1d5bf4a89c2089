//! Writes the checkpoints of one run.

use std::{
    fs, io,
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

use treadmill_runtime::{atomic_file, run_folder::RunFolder};
use treadmill_store::Store;

use super::{CheckpointError, TrainingState, encoding, numbered};

/// Name of the newest checkpoint in a folder.
const LATEST: &str = "latest.bundle";
/// Shortest time between two names that are durable.
const NAME_EVERY: Duration = Duration::from_secs(1);
/// Folder of checkpoints in a store.
pub(super) const IN_STORE: &str = "checkpoints";

/// Writes the checkpoints of one run. In a store it writes the best and numbered ones; the newest belongs to
/// [`Leadership`](crate::leadership::Leadership) there.
#[derive(Clone, Debug)]
pub struct CheckpointWriter {
    place: Place,
    every_updates: u64,
    keep: usize,
    /// When the newest checkpoint last had a durable name.
    named: Option<Instant>,
}

/// Writes a file atomically.
type WriteFile = fn(&Path, &[u8]) -> io::Result<()>;

#[derive(Clone, Debug)]
enum Place {
    Folder(PathBuf),
    Store(Store),
}

impl CheckpointWriter {
    /// Writer that also writes a numbered checkpoint every `every_updates` updates and keeps the last `keep`.
    pub fn new(folder: &RunFolder, every_updates: u64, keep: usize) -> Self {
        Self { place: Place::Folder(folder.checkpoints()), every_updates, keep, named: None }
    }

    /// The same in a store.
    #[must_use]
    pub fn in_store(store: &Store, every_updates: u64, keep: usize) -> Self {
        Self { place: Place::Store(store.clone()), every_updates, keep, named: None }
    }

    /// Writes `latest.bundle`. Returns the encoded state. At most once a second it waits until the name is durable: a crash
    /// of the machine may take the run back by a second.
    pub fn save(&mut self, state: &TrainingState) -> Result<Vec<u8>, CheckpointError> {
        let bytes = encoding::encode(state)?;
        if self.named.is_some_and(|named| named.elapsed() < NAME_EVERY) {
            self.write(LATEST, &bytes, atomic_file::write_quickly)?;
        } else {
            self.write(LATEST, &bytes, atomic_file::write)?;
            self.named = Some(Instant::now());
        }
        Ok(bytes)
    }

    /// Whether a numbered checkpoint is due after this number of updates.
    pub fn is_due(&self, updates: u64) -> bool {
        self.keep > 0 && updates > 0 && updates.is_multiple_of(self.every_updates)
    }

    /// Writes an encoded state as the checkpoint of this number of updates, and removes surplus ones.
    pub fn save_numbered(&self, updates: u64, bytes: &[u8]) -> Result<(), CheckpointError> {
        self.save_kept(updates, bytes)?;
        self.prune(updates);
        Ok(())
    }

    /// Writes an encoded state as the checkpoint of this number of updates. Returns its place.
    pub fn save_kept(&self, updates: u64, bytes: &[u8]) -> Result<String, CheckpointError> {
        self.write(&numbered(updates), bytes, atomic_file::write)?;
        Ok(self.place_of(&numbered(updates)))
    }

    /// Changes how often numbered checkpoints are written, and how many are kept.
    pub fn set_retention(&mut self, every_updates: u64, keep: usize) {
        (self.every_updates, self.keep) = (every_updates, keep);
    }

    /// Writes an encoded state as `best.bundle`. Its name becomes durable with that of the newest one.
    pub fn save_best(&self, bytes: &[u8]) -> Result<(), CheckpointError> {
        self.write("best.bundle", bytes, atomic_file::write_quickly)
    }

    fn place_of(&self, name: &str) -> String {
        match &self.place {
            Place::Folder(folder) => folder.join(name).display().to_string(),
            Place::Store(store) => format!("{store}/{IN_STORE}/{name}"),
        }
    }

    fn write(&self, name: &str, bytes: &[u8], to_file: WriteFile) -> Result<(), CheckpointError> {
        match &self.place {
            Place::Folder(folder) => to_file(&folder.join(name), bytes)
                .map_err(|source| CheckpointError::Write { path: self.place_of(name), source }),
            Place::Store(store) => Ok(store.put(&format!("{IN_STORE}/{name}"), bytes)?),
        }
    }

    /// Removes the oldest checkpoints that were due, up to this one. Later ones are of a branch that the run has left,
    /// others were asked for.
    fn prune(&self, newest: u64) {
        let names = match &self.place {
            Place::Folder(folder) => fs::read_dir(folder)
                .into_iter()
                .flatten()
                .flatten()
                .map(|entry| entry.file_name().to_string_lossy().into_owned())
                .collect(),
            Place::Store(store) => store.list(IN_STORE).unwrap_or_default(),
        };
        let number = |name: &String| name.strip_suffix(".bundle")?.parse::<u64>().ok();
        let mut numbers: Vec<u64> =
            names.iter().filter_map(number).filter(|n| *n <= newest && self.is_due(*n)).collect();
        numbers.sort_unstable();
        let surplus = numbers.len().saturating_sub(self.keep);
        for number in &numbers[..surplus] {
            if let Err(why) = self.remove(&numbered(*number)) {
                tracing::warn!(checkpoint = number, error = %why, "old checkpoint not removed");
            }
        }
    }

    fn remove(&self, name: &str) -> Result<(), CheckpointError> {
        match &self.place {
            Place::Folder(folder) => fs::remove_file(folder.join(name))
                .map_err(|source| CheckpointError::Write { path: self.place_of(name), source }),
            Place::Store(store) => Ok(store.delete(&format!("{IN_STORE}/{name}"))?),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checkpoints_of_a_branch_that_was_left_stay_beside_those_of_the_new_one() {
        let root = tempfile::tempdir().unwrap();
        let folder = RunFolder::create(Some(&root.path().join("run")), "run").unwrap();
        let writer = CheckpointWriter::new(&folder, 50, 3);
        // The run goes back to a checkpoint before update 100.
        writer.save_kept(70, b"state").unwrap();
        for updates in [800, 850, 900, 100, 150, 200, 250] {
            writer.save_numbered(updates, b"state").unwrap();
        }
        let left: Vec<u64> =
            (0..1000).filter(|updates| folder.checkpoints().join(numbered(*updates)).exists()).collect();
        assert_eq!(left, [70, 150, 200, 250, 800, 850, 900], "and so does one that was asked for");
    }
}
