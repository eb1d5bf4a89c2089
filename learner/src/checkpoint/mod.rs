//! Checkpoints: the whole state of a run in one file, written before its version is announced.
//!
//! In the folder `checkpoints`, `latest.bundle` is written after each update. `best.bundle` has the best evaluation so
//! far, or before the first evaluation the best return in training: the mean of the middle half of the last 100 episodes,
//! which a few absurd returns do not change. `NNNNNNNN.bundle`, named by the number of updates, is written every
//! `learner.checkpoint_every_updates`; the last `learner.keep_checkpoints` are kept.

pub mod encoding;
mod fallback;
mod format_3;
mod format_5;
mod state;

use std::{
    fs, io,
    path::{Path, PathBuf},
};

use treadmill_runtime::{atomic_file, run_folder::RunFolder};

use self::encoding::{FORMAT, FORMAT_OLDEST};
pub use state::{Counters, TrainingState};

/// Selects a checkpoint of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Which {
    /// The newest.
    Latest,
    /// `best.bundle`.
    Best,
    /// The one after this number of updates.
    Numbered(u64),
    /// `best.bundle` if it exists, else the newest.
    BestOrLatest,
}

impl std::str::FromStr for Which {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "latest" => Ok(Self::Latest),
            "best" => Ok(Self::Best),
            _ => text.parse().map(Self::Numbered).map_err(|_| {
                format!("`{text}` is not a checkpoint; allowed: best, latest, or the number of updates of a kept one")
            }),
        }
    }
}

/// Checkpoint that was read.
#[derive(Debug)]
pub struct Loaded {
    /// Which one it is, as `--checkpoint` names it.
    pub name: String,
    /// The state.
    pub state: TrainingState,
}

/// Why a checkpoint cannot be read or written.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// It does not exist.
    #[error("there is no checkpoint `{path}`; {known}")]
    Missing {
        /// Its path.
        path: String,
        /// Existing checkpoints.
        known: String,
    },
    /// It is damaged.
    #[error("checkpoint `{path}` is damaged: {why}; choose another one by --checkpoint")]
    Damaged {
        /// Its path.
        path: String,
        /// What is wrong.
        why: String,
    },
    /// Another version of this program wrote it.
    #[error(
        "checkpoint `{path}` has format {found}; this program reads formats {FORMAT_OLDEST} to {FORMAT}: continue with the \
         version that wrote it, named in versions.json in the run's folder"
    )]
    Format {
        /// Its path.
        path: String,
        /// Format of the file.
        found: u32,
    },
    /// Its parts are inconsistent.
    #[error("checkpoint `{path}` does not fit its network: {why}")]
    Shape {
        /// Its path.
        path: String,
        /// What is inconsistent.
        why: String,
    },
    /// This version refuses its configuration.
    #[error("checkpoint `{path}` has a configuration that this version refuses: {why}")]
    Configuration {
        /// Its path.
        path: String,
        /// Reason, with the key.
        why: String,
    },
    /// No checkpoint of the run is sound.
    #[error("no checkpoint of this run is sound: {tried}; start a new run, or restore a copy of one of these files")]
    NoneSound {
        /// Each checkpoint that was tried, with its error.
        tried: String,
    },
    /// The state could not be encoded.
    #[error("the state cannot be encoded: {why}")]
    Encode {
        /// Message of the encoder.
        why: String,
    },
    /// It cannot be written.
    #[error("cannot save checkpoint `{path}`; the one before it is untouched")]
    Write {
        /// Its path.
        path: String,
        /// Error of the system.
        source: io::Error,
    },
    /// It cannot be read.
    #[error("cannot read checkpoint `{path}`; choose another one by --checkpoint")]
    Read {
        /// Its path.
        path: String,
        /// Error of the system.
        source: io::Error,
    },
}

/// Reads one checkpoint of a run. If the newest is requested and unsound, reads the newest sound one with a warning.
///
/// # Errors
/// If the requested checkpoint is missing, unsound, or of another format, and there is no fallback.
pub fn load(folder: &RunFolder, which: Which) -> Result<Loaded, CheckpointError> {
    let checkpoints = folder.checkpoints();
    let (best, latest) = (checkpoints.join("best.bundle"), checkpoints.join("latest.bundle"));
    let exactly = |path: PathBuf| load_file(&path).map(|state| (path, state));
    let (path, state) = match which {
        Which::Best => exactly(best),
        Which::Numbered(number) => exactly(checkpoints.join(numbered(number))),
        Which::BestOrLatest if best.exists() => fallback::load_or_newest_sound(best),
        Which::Latest | Which::BestOrLatest => fallback::load_or_newest_sound(latest),
    }?;
    Ok(Loaded { name: name_of(&path), state })
}

/// Returns the name by which `--checkpoint` selects a file.
fn name_of(path: &Path) -> String {
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    name.parse::<u64>().map_or(name, |number| number.to_string())
}

/// Reads one checkpoint file.
pub fn load_file(path: &Path) -> Result<TrainingState, CheckpointError> {
    let name = path.display().to_string();
    let bytes = match fs::read(path) {
        Ok(bytes) => bytes,
        Err(why) if why.kind() == io::ErrorKind::NotFound => {
            return Err(CheckpointError::Missing { known: known(path.parent().unwrap_or(path)), path: name });
        }
        Err(source) => return Err(CheckpointError::Read { path: name, source }),
    };
    let state = decode(&name, &bytes)?;
    state.config().map_err(|why| CheckpointError::Configuration { path: name.clone(), why })?;
    state.check().map_err(|why| CheckpointError::Shape { path: name, why })?;
    Ok(state)
}

/// Decodes the bytes of a checkpoint file, without checking the state.
///
/// # Errors
/// If the file is damaged or has another format.
pub fn decode(path: &str, bytes: &[u8]) -> Result<TrainingState, CheckpointError> {
    let (format, payload) = encoding::payload(path, bytes)?;
    match format {
        3 => encoding::decode::<format_3::State3>(path, payload).map(Into::into),
        4 | 5 => encoding::decode::<format_5::State5>(path, payload).map(Into::into),
        _ => encoding::decode(path, payload),
    }
}

fn known(folder: &Path) -> String {
    let mut names: Vec<String> = fallback::bundles(folder).iter().map(|path| name_of(path)).collect();
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
#[derive(Clone, Debug)]
pub struct CheckpointWriter {
    folder: PathBuf,
    every_updates: u64,
    keep: usize,
}

impl CheckpointWriter {
    /// Writer that also writes a numbered checkpoint every `every_updates` updates and keeps the last `keep`.
    pub fn new(folder: &RunFolder, every_updates: u64, keep: usize) -> Self {
        Self { folder: folder.checkpoints(), every_updates, keep }
    }

    /// Writes `latest.bundle`. Returns the encoded state.
    pub fn save(&self, state: &TrainingState) -> Result<Vec<u8>, CheckpointError> {
        let bytes = encoding::encode(state)?;
        self.write("latest.bundle", &bytes)?;
        Ok(bytes)
    }

    /// Whether a numbered checkpoint is due after this number of updates.
    pub fn is_due(&self, updates: u64) -> bool {
        self.keep > 0 && updates > 0 && updates.is_multiple_of(self.every_updates)
    }

    /// Writes an encoded state as the checkpoint of this number of updates, and removes surplus ones.
    pub fn save_numbered(&self, updates: u64, bytes: &[u8]) -> Result<(), CheckpointError> {
        self.write(&numbered(updates), bytes)?;
        self.prune();
        Ok(())
    }

    /// Changes how often numbered checkpoints are written, and how many are kept.
    pub fn set_retention(&mut self, every_updates: u64, keep: usize) {
        (self.every_updates, self.keep) = (every_updates, keep);
    }

    /// Copies the newest, which has `updates` updates, to a numbered checkpoint. Returns its path.
    pub fn keep_newest(&self, updates: u64) -> Result<PathBuf, CheckpointError> {
        let latest = self.latest();
        let bytes =
            fs::read(&latest).map_err(|source| CheckpointError::Read { path: latest.display().to_string(), source })?;
        self.write(&numbered(updates), &bytes)?;
        Ok(self.folder.join(numbered(updates)))
    }

    /// Writes an encoded state as `best.bundle`.
    pub fn save_best(&self, bytes: &[u8]) -> Result<(), CheckpointError> {
        self.write("best.bundle", bytes)
    }

    /// Path of the newest checkpoint.
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
                tracing::warn!(checkpoint = number, error = %why, "old checkpoint not removed");
            }
        }
    }
}
