//! Everything a run is, in one file, written before the version it holds is announced.
//!
//! `checkpoints/latest.bundle` after each update, `best.bundle` at the best evaluation so far (the
//! best mean return in training before the first evaluation), `NNNNNNNN.bundle` (the
//! number of updates) every so many updates, the last few of which are kept.

pub mod encoding;
mod fallback;
mod state;

use std::{
    fs, io,
    path::{Path, PathBuf},
};

use treadmill_runtime::{atomic_file, run_folder::RunFolder};

pub use state::{Counters, TrainingState};

/// Which checkpoint of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Which {
    /// The newest.
    Latest,
    /// The one with the best mean return.
    Best,
    /// The one after so many updates.
    Numbered(u64),
    /// The best if there is one, else the newest.
    BestOrLatest,
}

impl std::str::FromStr for Which {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "latest" => Ok(Self::Latest),
            "best" => Ok(Self::Best),
            _ => text.parse().map(Self::Numbered).map_err(|_| {
                format!("`{text}` is no checkpoint; allowed: best, latest, or the number of updates of a kept one")
            }),
        }
    }
}

/// Why a checkpoint cannot be read or written.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// It is not there.
    #[error("there is no checkpoint `{path}`; {known}")]
    Missing {
        /// Where it was looked for.
        path: String,
        /// Those that are there.
        known: String,
    },
    /// It is there and unsound.
    #[error("checkpoint `{path}` is damaged: {why}; choose another one by --checkpoint")]
    Damaged {
        /// Its path.
        path: String,
        /// What is wrong.
        why: String,
    },
    /// It was written by another version of this program.
    #[error(
        "checkpoint `{path}` has format {found}; this program reads format {known}: go on with the version that wrote it, \
         which versions.json in the run's folder names"
    )]
    Format {
        /// Its path.
        path: String,
        /// Its format.
        found: u32,
        /// Ours.
        known: u32,
    },
    /// Its parts do not fit each other.
    #[error("checkpoint `{path}` does not fit its network: {why}")]
    Shape {
        /// Its path.
        path: String,
        /// What does not fit.
        why: String,
    },
    /// Its configuration is one that this version refuses.
    #[error("checkpoint `{path}` holds a configuration that is refused: {why}")]
    Configuration {
        /// Its path.
        path: String,
        /// Why, with the key.
        why: String,
    },
    /// Neither it nor any other checkpoint of the run is sound.
    #[error("no checkpoint of this run is sound: {tried}; begin a new run, or put back a copy of one of these files")]
    NoneSound {
        /// Every one that was tried, with what is wrong with it.
        tried: String,
    },
    /// The state could not be encoded.
    #[error("the state cannot be encoded: {why}")]
    Encode {
        /// What the encoder said.
        why: String,
    },
    /// The system refused to write.
    #[error("cannot save checkpoint `{path}`: {source}; the one before it is untouched")]
    Write {
        /// Its path.
        path: String,
        /// What the system said.
        source: io::Error,
    },
    /// The system refused to read.
    #[error("cannot read checkpoint `{path}`: {source}; choose another one by --checkpoint")]
    Read {
        /// Its path.
        path: String,
        /// What the system said.
        source: io::Error,
    },
}

/// Reads one checkpoint of a run. Where the newest is wanted and unsound, the newest sound one is read instead, with a
/// warning; one that is named is read or refused.
pub fn load(folder: &RunFolder, which: Which) -> Result<TrainingState, CheckpointError> {
    let checkpoints = folder.checkpoints();
    let (best, latest) = (checkpoints.join("best.bundle"), checkpoints.join("latest.bundle"));
    match which {
        Which::Best => load_file(&best),
        Which::Numbered(number) => load_file(&checkpoints.join(numbered(number))),
        Which::BestOrLatest if best.exists() => fallback::load_or_newest_sound(&best),
        Which::Latest | Which::BestOrLatest => fallback::load_or_newest_sound(&latest),
    }
}

/// Reads one bundle file.
pub fn load_file(path: &Path) -> Result<TrainingState, CheckpointError> {
    let shown = path.display().to_string();
    let bytes = match fs::read(path) {
        Ok(bytes) => bytes,
        Err(why) if why.kind() == io::ErrorKind::NotFound => {
            return Err(CheckpointError::Missing { known: known(path.parent().unwrap_or(path)), path: shown });
        }
        Err(source) => return Err(CheckpointError::Read { path: shown, source }),
    };
    let state: TrainingState = encoding::decode(&shown, &bytes)?;
    state.config().map_err(|why| CheckpointError::Configuration { path: shown.clone(), why })?;
    state.check().map_err(|why| CheckpointError::Shape { path: shown, why })?;
    Ok(state)
}

fn known(folder: &Path) -> String {
    let mut names: Vec<String> = fallback::bundles(folder)
        .iter()
        .filter_map(|path| Some(path.file_stem()?.to_string_lossy().into_owned()))
        .map(|name| name.parse::<u64>().map_or(name, |number| number.to_string()))
        .collect();
    names.sort();
    if names.is_empty() {
        "this run has saved none yet".to_string()
    } else {
        format!("this run has: {}", names.join(", "))
    }
}

fn numbered(number: u64) -> String {
    format!("{number:08}.bundle")
}

/// Writes the checkpoints of one run.
#[derive(Debug)]
pub struct CheckpointWriter {
    folder: PathBuf,
    every_updates: u64,
    keep: usize,
}

impl CheckpointWriter {
    /// Writes into the run's folder; every so many updates a numbered one, of which the last `keep` stay.
    pub fn new(folder: &RunFolder, every_updates: u64, keep: usize) -> Self {
        Self { folder: folder.checkpoints(), every_updates, keep }
    }

    /// Writes `latest`, and beside it the numbered one that is due; returns what was written.
    pub fn save(&self, state: &TrainingState) -> Result<Vec<u8>, CheckpointError> {
        let bytes = encoding::encode(state)?;
        self.write("latest.bundle", &bytes)?;
        let updates = state.counters.updates;
        if self.keep > 0 && updates > 0 && updates.is_multiple_of(self.every_updates) {
            self.write(&numbered(updates), &bytes)?;
            self.prune();
        }
        Ok(bytes)
    }

    /// Keeps numbered ones by another rule from now on.
    pub fn set_rule(&mut self, every_updates: u64, keep: usize) {
        (self.every_updates, self.keep) = (every_updates, keep);
    }

    /// Keeps the newest, which is that after so many updates, as a numbered one, too; where it is.
    pub fn keep_newest(&self, updates: u64) -> Result<PathBuf, CheckpointError> {
        let latest = self.latest();
        let bytes =
            fs::read(&latest).map_err(|source| CheckpointError::Read { path: latest.display().to_string(), source })?;
        self.write(&numbered(updates), &bytes)?;
        Ok(self.folder.join(numbered(updates)))
    }

    /// Writes `best`: a checkpoint as it was encoded.
    pub fn save_best(&self, bytes: &[u8]) -> Result<(), CheckpointError> {
        self.write("best.bundle", bytes)
    }

    /// Where the newest lies.
    pub fn latest(&self) -> PathBuf {
        self.folder.join("latest.bundle")
    }

    fn write(&self, name: &str, bytes: &[u8]) -> Result<(), CheckpointError> {
        let path = self.folder.join(name);
        atomic_file::write(&path, bytes)
            .map_err(|source| CheckpointError::Write { path: path.display().to_string(), source })
    }

    fn prune(&self) {
        let mut numbers: Vec<u64> = fs::read_dir(&self.folder)
            .into_iter()
            .flatten()
            .flatten()
            .filter_map(|entry| entry.file_name().to_string_lossy().strip_suffix(".bundle")?.parse().ok())
            .collect();
        numbers.sort_unstable();
        let surplus = numbers.len().saturating_sub(self.keep);
        for number in &numbers[..surplus] {
            if let Err(why) = fs::remove_file(self.folder.join(numbered(*number))) {
                tracing::warn!("checkpoint {number} cannot be removed: {why}");
            }
        }
    }
}
