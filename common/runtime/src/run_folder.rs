//! Folder with a run's files.
//!
//! ```text
//! runs/NAME/
//!   config.toml           the configuration as used
//!   command.txt           the command line, one line per start
//!   resume.txt            the command that goes on with the run
//!   versions.json         versions of this program, the toolchain's target and the machine
//!   endpoint.txt          the learner's endpoint
//!   lock.json             the process that writes into this folder
//!   store.txt             the store of the run's state, if that is not in checkpoints/
//!   model.xml             the humanoid
//!   model_source.toml     where the file of another robot is on the machine that began the run
//!   metrics.jsonl         one line per scalar
//!   accounts.jsonl        one line per actor process
//!   events.out.tfevents.* metrics for TensorBoard
//!   checkpoints/          latest.bundle, best.bundle, NNNNNNNN.bundle
//!   learning_curve.png    at the end
//! ```

use std::{
    fs, io,
    path::{Path, PathBuf},
};

use treadmill_proto::ident::check_ident;

use crate::{
    atomic_file,
    holder::Holder,
    words::{nearest, nearest_path, quoted},
};

/// Most runs that an error lists.
const RUNS_LISTED_MAX: usize = 12;
/// Files of a run that may as well be a user's.
const OVERWRITTEN: [&str; 2] = ["config.toml", "model.xml"];

/// Folder of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct RunFolder {
    root: PathBuf,
    name: String,
}

/// Error of opening or creating a run's folder.
#[derive(Debug, thiserror::Error)]
pub enum RunFolderError {
    /// The run does not exist.
    #[error("there is no run at `{path}`; {known}")]
    Missing {
        /// The path as given.
        path: String,
        /// Runs that exist.
        known: String,
    },
    /// The run cannot be read.
    #[error("the run folder `{path}` cannot be read; give this user the right to read it, or run this as its owner")]
    Unreadable {
        /// The folder.
        path: String,
        /// The system's error.
        source: io::Error,
    },
    /// The folder already holds a run.
    #[error("`{path}` already holds a run; continue it with `--resume {}`, or choose another --run-dir", quoted(path))]
    Taken {
        /// The folder.
        path: String,
    },
    /// Another process writes into the folder.
    #[error(
        "`{path}` is in use by {holder}; stop that process first, as by `treadmill control stop {}`, or choose another \
         --run-dir",
        quoted(path)
    )]
    InUse {
        /// The folder.
        path: String,
        /// The other process.
        holder: Holder,
    },
    /// A file that every run writes is there, and no run wrote it.
    #[error("`{path}` has a file `{file}` that a run would replace; move it, or choose another --run-dir")]
    Foreign {
        /// The folder.
        path: String,
        /// The file.
        file: &'static str,
    },
    /// The system refused.
    #[error("the run folder `{path}` cannot be used; choose one that you may write to with --run-dir")]
    Io {
        /// The folder.
        path: String,
        /// The system's error.
        source: io::Error,
    },
}

/// Declares functions that return the path of a file or folder of the run.
macro_rules! paths {
    ($($what:literal $function:ident = $name:literal;)*) => {$(
        #[doc = concat!("Returns the path of ", $what, ".")]
        pub fn $function(&self) -> PathBuf {
            self.root.join($name)
        }
    )*};
}

impl RunFolder {
    /// Creates the folder of a new run: `run_dir`, or `runs/PREFIX-N` with the first free N.
    pub fn create(run_dir: Option<&Path>, prefix: &str) -> Result<Self, RunFolderError> {
        if let Some(root) = run_dir {
            let folder = Self::at(root);
            if folder.is_used() {
                return Err(RunFolderError::Taken { path: root.display().to_string() });
            }
            // The lock is the first file of a run.
            if let Some(file) = OVERWRITTEN.into_iter().find(|name| !folder.lock().exists() && root.join(name).exists())
            {
                return Err(RunFolderError::Foreign { path: root.display().to_string(), file });
            }
            return folder.prepare();
        }
        for number in 1u32.. {
            let folder = Self::at(&Path::new("runs").join(format!("{prefix}-{number}")));
            fs::create_dir_all("runs").map_err(|source| folder.io(source))?;
            // Two simultaneous starts get two folders, because only one of them can create each.
            match fs::create_dir(&folder.root) {
                Ok(()) => return folder.prepare(),
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(folder.io(error)),
            }
        }
        unreachable!("no file system holds 4 billion runs")
    }

    /// Opens or creates the folder for what this machine logs of a run whose state is in a store: `run_dir`, or `runs/RUN`.
    ///
    /// # Errors
    /// [`RunFolderError::Taken`] if it holds another run, [`RunFolderError::Io`] if the system refuses.
    pub fn of_stored(run_dir: Option<&Path>, run: &str, store: &str) -> Result<Self, RunFolderError> {
        let root = run_dir.map_or_else(|| Path::new("runs").join(run), Path::to_path_buf);
        let folder = Self::at(&root);
        let known = fs::read_to_string(folder.store()).unwrap_or_default();
        if folder.is_used() && known.trim() != store {
            return Err(RunFolderError::Taken { path: root.display().to_string() });
        }
        let folder = folder.prepare()?;
        folder.set_store(store)?;
        Ok(folder)
    }

    /// Writes the URL of the store of the run's state.
    ///
    /// # Errors
    /// [`RunFolderError::Io`].
    pub fn set_store(&self, store: &str) -> Result<(), RunFolderError> {
        atomic_file::write(&self.store(), format!("{store}\n").as_bytes()).map_err(|source| self.io(source))
    }

    /// Opens the folder of an existing run, by path or by name below `runs/`.
    pub fn open(run: &str) -> Result<Self, RunFolderError> {
        let given = Path::new(run);
        for root in [given.to_path_buf(), Path::new("runs").join(given)] {
            let folder = Self::at(&root);
            match fs::metadata(folder.checkpoints()) {
                Ok(facts) if facts.is_dir() => return Ok(folder),
                Err(why) if why.kind() == io::ErrorKind::PermissionDenied => {
                    return Err(RunFolderError::Unreadable { path: root.display().to_string(), source: why });
                }
                _ => {}
            }
        }
        Err(RunFolderError::Missing { path: run.to_string(), known: known_runs(run) })
    }

    fn at(root: &Path) -> Self {
        let base = root.file_name().map(|name| name.to_string_lossy().to_lowercase()).unwrap_or_default();
        let name: String = base
            .chars()
            .map(|c| if c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_' || c == '-' { c } else { '-' })
            // A name that begins with a hyphen would be taken for a flag.
            .skip_while(|c| *c == '-')
            .take(64)
            .collect();
        let name = if check_ident("run", &name).is_ok() { name } else { "run".to_string() };
        Self { root: root.to_path_buf(), name }
    }

    /// Whether the folder `root` holds a run with a checkpoint.
    #[must_use]
    pub fn has_checkpoint(root: &Path) -> bool {
        let entries = fs::read_dir(Self::at(root).checkpoints()).into_iter().flatten().flatten();
        entries.into_iter().any(|entry| !atomic_file::is_temporary(&entry.file_name().to_string_lossy()))
    }

    /// Whether a run has begun here.
    fn is_used(&self) -> bool {
        Self::has_checkpoint(&self.root) || self.metrics().exists()
    }

    /// Removes the files of a run that failed to start. Keeps everything if training has begun, and files that the run did
    /// not write.
    pub fn discard(&self) {
        if self.is_used() {
            return;
        }
        // What cannot be removed stays: the failed start is the error to report.
        let _ = self.remove_stale_files();
        for name in [
            "config.toml",
            "command.txt",
            "resume.txt",
            "versions.json",
            "model.xml",
            "model_source.toml",
            "endpoint.txt",
            "lock.json",
            "store.txt",
        ] {
            let _ = fs::remove_file(self.root.join(name));
        }
        let _ = fs::remove_dir(self.checkpoints());
        let _ = fs::remove_dir(&self.root);
    }

    fn prepare(self) -> Result<Self, RunFolderError> {
        fs::create_dir_all(self.checkpoints()).map_err(|source| self.io(source))?;
        Ok(self)
    }

    /// Removes the temporary files that killed processes left in this folder. Returns how many there were.
    pub fn remove_stale_files(&self) -> Result<usize, RunFolderError> {
        let remove = |folder: &Path| atomic_file::remove_stale(folder).map_err(|source| self.io(source));
        Ok(remove(&self.root)? + remove(&self.checkpoints())?)
    }

    fn io(&self, source: io::Error) -> RunFolderError {
        RunFolderError::Io { path: self.root.display().to_string(), source }
    }

    /// Returns the path of the folder.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Returns the run's name, which is valid in keys of the bus.
    pub fn name(&self) -> &str {
        &self.name
    }

    paths! {
        "the checkpoints" checkpoints = "checkpoints";
        "the scalars, one per line" metrics = "metrics.jsonl";
        "the configuration as used" config = "config.toml";
        "the learning curve" learning_curve = "learning_curve.png";
        "the accounts of fragments, one line per actor process" accounts = "accounts.jsonl";
        "the lock, see [`crate::run_lock`]" lock = "lock.json";
        "the URL of the store" store = "store.txt";
        "the place of the robot's file" model_source = "model_source.toml";
        "the learner's endpoint" endpoint = "endpoint.txt";
        "the command that goes on with the run" resume = "resume.txt";
    }
}

/// Returns the run that `given` may mean, and those that exist.
fn known_runs(given: &str) -> String {
    let entries = fs::read_dir("runs").into_iter().flatten().flatten();
    let is_run = |entry: &fs::DirEntry| entry.path().join("checkpoints").is_dir();
    let mut names: Vec<String> =
        entries.filter(is_run).map(|entry| format!("runs/{}", entry.file_name().to_string_lossy())).collect();
    names.sort();
    let bare = names.iter().filter_map(|name| name.strip_prefix("runs/"));
    let near = nearest(given, names.iter().map(String::as_str).chain(bare)).map(str::to_string);
    // A path within a run, as of a checkpoint.
    let is_run = |folder: &Path| folder != Path::new("") && folder.join("checkpoints").is_dir();
    let above = Path::new(given).ancestors().skip(1).find(|folder| is_run(folder));
    let beside = nearest_path(Path::new(given)).filter(|near| Path::new(near).is_file() || is_run(Path::new(near)));
    let near = above.map(|folder| folder.display().to_string()).or(near).or(beside);
    let hint = near.map(|near| format!("did you mean `{near}`? "));
    let list = match names.len() {
        0 => "there are no runs here yet: `treadmill train` makes one".to_string(),
        count @ 1..=RUNS_LISTED_MAX => format!("runs here: {}", names[..count].join(", ")),
        count => format!("runs here: {} and {} more", names[..RUNS_LISTED_MAX].join(", "), count - RUNS_LISTED_MAX),
    };
    hint.unwrap_or_default() + &list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_found_and_not_overwritten() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path().join("My Run.1");
        let run = RunFolder::create(Some(&root), "walk").unwrap();
        assert_eq!(run.name(), "my-run-1");
        assert_eq!(RunFolder::open(root.to_str().unwrap()).unwrap(), run);
        // A run that was killed before or while it wrote its first checkpoint does not count.
        fs::write(run.checkpoints().join(format!(".latest.bundle.{}.tmp", 1 << 30)), "half").unwrap();
        assert_eq!(RunFolder::create(Some(&root), "walk").unwrap(), run);
        fs::write(root.join(format!(".config.toml.{}.tmp", 1 << 30)), "half").unwrap();
        assert_eq!(run.remove_stale_files().unwrap(), 2);
        fs::write(run.checkpoints().join("latest.bundle"), "state").unwrap();
        let again = RunFolder::create(Some(&root), "walk").unwrap_err().to_string();
        assert!(again.contains("--resume"), "{again}");
    }

    #[test]
    fn a_users_file_is_not_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path().join("run");
        fs::create_dir(&root).unwrap();
        fs::write(root.join("config.toml"), "# mine").unwrap();
        let refused = RunFolder::create(Some(&root), "walk").unwrap_err().to_string();
        assert!(refused.contains("`config.toml`") && refused.contains("--run-dir"), "{refused}");
        // That of a start that was killed before its first checkpoint.
        fs::write(root.join("lock.json"), "").unwrap();
        RunFolder::create(Some(&root), "walk").unwrap();
    }

    #[test]
    fn a_folder_of_a_stored_run_is_not_mixed_with_another_run() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path().join("walk");
        let run = RunFolder::of_stored(Some(&root), "walk", "s3://box/walk").unwrap();
        fs::write(run.metrics(), "{}").unwrap();
        assert_eq!(RunFolder::of_stored(Some(&root), "walk", "s3://box/walk").unwrap(), run);
        let refused = RunFolder::of_stored(Some(&root), "walk", "s3://box/other").unwrap_err();
        assert!(matches!(refused, RunFolderError::Taken { .. }));
    }

    #[test]
    fn only_a_run_that_never_began_is_discarded() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path().join("run");
        let run = RunFolder::create(Some(&root), "walk").unwrap();
        fs::write(run.config(), "").unwrap();
        fs::write(root.join("notes.txt"), "mine").unwrap();
        run.discard();
        assert!(!run.config().exists() && root.join("notes.txt").exists());
        fs::remove_file(root.join("notes.txt")).unwrap();
        run.clone().prepare().unwrap().discard();
        assert!(!root.exists());
        let run = run.prepare().unwrap();
        fs::write(run.checkpoints().join("latest.bundle"), "state").unwrap();
        run.discard();
        assert!(run.checkpoints().join("latest.bundle").exists());
    }

    #[test]
    fn names_are_made_from_folders() {
        for (folder, name) in
            [("Walk 1", "walk-1"), ("über", "ber"), (".hidden", "hidden"), ("--x-", "x-"), ("テスト", "run")]
        {
            assert_eq!(RunFolder::at(Path::new(folder)).name(), name);
        }
    }

    #[test]
    fn a_missing_run_is_named() {
        assert!(RunFolder::open("no/such/run").unwrap_err().to_string().contains("no/such/run"));
    }
}
