//! Checkpoints: the whole state of a run in one file, written before its version is announced.
//!
//! In the folder `checkpoints`, `latest.bundle` is written after each update. `best.bundle` has the best evaluation so
//! far, or before the first evaluation the best return in training: the mean of the middle half of the last 100 episodes,
//! which a few absurd returns do not change. `NNNNNNNN.bundle`, named by the number of updates, is written every
//! `learner.checkpoint_every_updates`; the last `learner.keep_checkpoints` are kept. A run's history is a line: those after
//! the one that it is resumed from move to a folder `abandoned-after-N`.

mod abandoned;
pub mod curricula;
pub mod encoding;
pub mod episodes;
mod fallback;
mod state;
mod writer;

use std::{
    fs, io,
    path::{Path, PathBuf},
};

use treadmill_runtime::run_folder::RunFolder;
use treadmill_store::StoreError;

use self::encoding::FORMAT;
use crate::waiting::{MayPass, Obstacle};
pub use abandoned::set_aside;
pub use episodes::{EpisodeMeans, EpisodeWindow};
pub use state::{Counters, TrainingState};
pub use writer::CheckpointWriter;

/// Selects a checkpoint of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CheckpointChoice {
    /// The newest.
    Latest,
    /// `best.bundle`.
    Best,
    /// The one after this number of updates.
    Numbered(u64),
    /// `best.bundle` if it exists, else the newest.
    BestOrLatest,
}

impl std::str::FromStr for CheckpointChoice {
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

/// Returns what is left where a checkpoint could not be saved.
fn before(path: &str) -> &'static str {
    if Path::new(path).exists() { "the one before it is untouched" } else { "there is none before it" }
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
        "checkpoint `{path}` has format {found}; this program reads format {FORMAT}: continue with the \
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
    #[error("cannot save checkpoint `{path}`; {}", before(path))]
    Write {
        /// Its path.
        path: String,
        /// Error of the system.
        source: io::Error,
    },
    /// The store failed.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// It cannot be read.
    #[error("cannot read checkpoint `{path}`; choose another one by --checkpoint")]
    Read {
        /// Its path.
        path: String,
        /// Error of the system.
        source: io::Error,
    },
}

impl MayPass for CheckpointError {
    fn obstacle(&self) -> Option<Obstacle> {
        match self {
            Self::Write { source, .. } => source.obstacle(),
            Self::Store(source) => source.obstacle(),
            _ => None,
        }
    }
}

/// Reads one checkpoint of a run. If the newest is requested and unsound, reads the newest sound one with a warning.
///
/// # Errors
/// If the requested checkpoint is missing, unsound, or of another format, and there is no fallback.
pub fn load(folder: &RunFolder, which: CheckpointChoice) -> Result<Loaded, CheckpointError> {
    let checkpoints = folder.checkpoints();
    let (best, latest) = (checkpoints.join("best.bundle"), checkpoints.join("latest.bundle"));
    let exactly = |path: PathBuf| load_file(&path).map(|state| (path, state));
    let (path, state) = match which {
        CheckpointChoice::Best => exactly(best),
        CheckpointChoice::Numbered(number) => exactly(checkpoints.join(numbered(number))),
        CheckpointChoice::BestOrLatest if best.exists() => fallback::load_or_newest_sound(best),
        CheckpointChoice::Latest | CheckpointChoice::BestOrLatest => fallback::load_or_newest_sound(latest),
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
    read(&name, &bytes)
}

/// Decodes and checks the bytes of a checkpoint; `name` stands in errors.
///
/// # Errors
/// If they are damaged, or of a format or configuration that this version refuses.
pub fn read(name: &str, bytes: &[u8]) -> Result<TrainingState, CheckpointError> {
    let state = decode(name, bytes)?;
    state.config().map_err(|why| CheckpointError::Configuration { path: name.to_string(), why })?;
    state.check().map_err(|why| CheckpointError::Shape { path: name.to_string(), why })?;
    Ok(state)
}

/// Decodes the bytes of a checkpoint file, without checking the state.
///
/// # Errors
/// If the file is damaged or has another format.
pub fn decode(path: &str, bytes: &[u8]) -> Result<TrainingState, CheckpointError> {
    encoding::decode(path, encoding::payload(path, bytes)?)
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

/// Returns the object of a numbered checkpoint in a store, or of the best one.
#[must_use]
pub fn object(number: Option<u64>) -> String {
    format!("{}/{}", writer::IN_STORE, number.map_or_else(|| "best.bundle".to_string(), numbered))
}

fn numbered(number: u64) -> String {
    format!("{number:08}.bundle")
}
