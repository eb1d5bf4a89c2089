//! Plan of a sweep with what has become of its trials: one file in the sweep's folder, replaced atomically.

use std::{
    fs::{self, File, TryLockError},
    path::{Path, PathBuf},
};

use anyhow::Context;
use serde::{Deserialize, Serialize};
use treadmill_runtime::{atomic_file, seeds, words::quoted};

use super::search::{Setting, SweepSearch};
use crate::launch::exit_code::Usage;

const FILE: &str = "sweep.json";
const LOCK: &str = "sweep.lock";
/// Most characters of a sweep's name in those of its runs.
const SWEEP_CHARS_MAX: usize = 40;

/// Trial: an ordinary run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Trial {
    pub(crate) seed: u64,
    /// Number of its setting; in a population, of its member.
    pub(crate) setting: usize,
    pub(crate) keys: Setting,
    /// Whether Optuna found it hopeless.
    #[serde(default)]
    pub(crate) is_pruned: bool,
    /// Exit code, once it has ended.
    pub(crate) exit: Option<i32>,
    /// Trial that it forked, and at how many environment steps.
    pub(crate) parent: Option<(usize, u64)>,
}

/// Plan of a sweep.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Plan {
    /// Folder in which the sweep was started: paths in flags begin there.
    pub(crate) started_in: PathBuf,
    /// Flags of `train` for every trial.
    pub(crate) flags: Vec<String>,
    /// Name and text of the search file.
    pub(crate) file: Option<(String, String)>,
    /// Flags that replace entries of the file.
    pub(crate) settings: Option<usize>,
    pub(crate) seeds: Option<usize>,
    /// Database of Optuna, if not a file in the sweep's folder.
    #[serde(default)]
    pub(crate) storage: Option<String>,
    /// Name of its study there: that of the sweep's folder at first.
    #[serde(default)]
    pub(crate) study: String,
    /// Trials at once.
    pub(crate) parallel: usize,
    /// Whether one actor runs in lock-step.
    pub(crate) deterministic: bool,
    /// Endpoints of the router of a pool whose actors the trials use; without any, each trial has its own.
    #[serde(default)]
    pub(crate) connect: Vec<String>,
    /// Begin of the names of its runs at that router, where other sweeps of the same name may be.
    #[serde(default)]
    pub(crate) bus_name: String,
    pub(crate) goal: String,
    /// Seed of the first trial and of what is drawn.
    pub(crate) seed: u64,
    /// Environment steps of each trial.
    pub(crate) steps: u64,
    /// Intervals that a population has finished.
    pub(crate) intervals: u64,
    pub(crate) trials: Vec<Trial>,
}

impl Plan {
    /// Returns the search that the flags and the file describe.
    ///
    /// # Errors
    /// All entries of the file that are wrong.
    pub(crate) fn search(&self) -> Result<SweepSearch, Usage> {
        match &self.file {
            Some((name, text)) => SweepSearch::read(text, name, self.settings, self.seeds),
            None => SweepSearch::of_seeds(self.seeds.unwrap_or_default()),
        }
    }

    /// Adds the trials of a search.
    pub(crate) fn propose(&mut self, search: &SweepSearch) {
        for (setting, keys) in search.settings(self.seed).iter().enumerate() {
            self.add(setting, keys, search);
        }
    }

    /// Adds the trials of a setting, whose number counts from 0.
    pub(crate) fn add(&mut self, setting: usize, keys: &Setting, search: &SweepSearch) {
        for number in 0..search.seeds {
            // The seeds are the same for each setting, so that chance favours none; members of a population differ.
            let is_population = search.interval_steps().is_some();
            let seed = self.seed.saturating_add(if is_population { setting } else { number } as u64);
            self.trials.push(Trial { seed, setting: setting + 1, keys: keys.clone(), ..Trial::default() });
        }
    }

    /// Returns the trial of each member of a population that goes on, in the order of the members.
    pub(crate) fn living(&self) -> Vec<usize> {
        let is_last = |index: &usize| {
            let setting = self.trials[*index].setting;
            !self.trials[index + 1..].iter().any(|later| later.setting == setting)
        };
        let mut living: Vec<usize> = (0..self.trials.len()).filter(is_last).collect();
        living.sort_by_key(|index| self.trials[*index].setting);
        living
    }

    /// Returns how many trials failed.
    pub(crate) fn failed(&self) -> usize {
        self.trials.iter().filter(|trial| !trial.is_pruned && trial.exit.is_some_and(|code| code != 0)).count()
    }

    /// Returns the trials that have not ended.
    pub(crate) fn unfinished(&self) -> Vec<usize> {
        (0..self.trials.len()).filter(|index| self.trials[*index].exit.is_none()).collect()
    }
}

/// Folder of a sweep, which this process alone writes to.
#[derive(Debug)]
pub(crate) struct SweepFolder {
    root: PathBuf,
    _lock: File,
}

impl SweepFolder {
    /// Returns whether a folder holds a sweep.
    pub(crate) fn is_sweep(root: &Path) -> bool {
        root.join(FILE).is_file()
    }

    /// Creates the folder of a new sweep: `run_dir`, or `runs/sweep-N` with the first free N.
    ///
    /// # Errors
    /// If the folder holds a sweep or a run, or the system refuses.
    pub(crate) fn create(run_dir: Option<&Path>) -> anyhow::Result<Self> {
        let free = || (1..).map(|number| PathBuf::from(format!("runs/sweep-{number}"))).find(|root| !root.exists());
        let root = run_dir.map(Path::to_path_buf).or_else(free).unwrap_or_default();
        let shown = root.display().to_string();
        if Self::is_sweep(&root) {
            let go_on = format!("`treadmill sweep --resume {}`", quoted(&shown));
            let why = format!("`{shown}` already holds a sweep; go on with {go_on}, or choose another --run-dir");
            return Err(Usage(why).into());
        }
        if root.join("checkpoints").exists() || root.join("trial-1").exists() {
            return Err(Usage(format!("`{shown}` already holds a run; choose another --run-dir")).into());
        }
        if run_dir.is_none() && fs::create_dir_all("runs").is_ok() && fs::create_dir(&root).is_err() && root.exists() {
            // Another sweep took the name meanwhile.
            return Self::create(None);
        }
        fs::create_dir_all(&root).with_context(|| format!("the folder `{shown}` cannot be created"))?;
        Self::lock(&root)
    }

    /// Opens the folder of a sweep, by path or by name below `runs/`, and its plan.
    ///
    /// # Errors
    /// If there is no sweep, another process has it, or its plan cannot be read.
    pub(crate) fn open(given: &str) -> anyhow::Result<(Self, Plan)> {
        let folder = Self::lock(&find(given)?)?;
        let plan = read(folder.root())?;
        Ok((folder, plan))
    }

    fn lock(root: &Path) -> anyhow::Result<Self> {
        let path = root.join(LOCK);
        let open = File::options().create(true).truncate(false).write(true).open(&path);
        let file = open.with_context(|| format!("`{}` cannot be written", path.display()))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let why = format!("`{}` is in use by another sweep; stop that first", root.display());
                return Err(Usage(why).into());
            }
            Err(TryLockError::Error(why)) => return Err(why).context("the sweep's folder cannot be locked"),
        }
        // Absolute, because trials begin in the folder where the sweep was started.
        let root = fs::canonicalize(root).with_context(|| format!("`{}` cannot be read", root.display()))?;
        Ok(Self { root, _lock: file })
    }

    /// Returns the path of the folder.
    pub(crate) fn root(&self) -> &Path {
        &self.root
    }

    /// Returns the folder of the trial with this index.
    pub(crate) fn trial(&self, index: usize) -> PathBuf {
        trial(&self.root, index)
    }

    /// Returns the file with the output of a trial.
    pub(crate) fn log(&self, index: usize) -> PathBuf {
        self.root.join(format!("trial-{}.log", index + 1))
    }

    /// Writes the plan.
    ///
    /// # Errors
    /// If the folder cannot be written.
    pub(crate) fn save(&self, plan: &Plan) -> anyhow::Result<()> {
        let text = serde_json::to_string_pretty(plan)? + "\n";
        self.write(FILE, &text)
    }

    /// Writes a file of the folder.
    ///
    /// # Errors
    /// If the folder cannot be written.
    pub(crate) fn write(&self, name: &str, text: &str) -> anyhow::Result<()> {
        let path = self.root.join(name);
        let remedy = "free some space, then go on with `treadmill sweep --resume`";
        atomic_file::write(&path, text.as_bytes())
            .with_context(|| format!("`{}` cannot be written; {remedy}", path.display()))
    }
}

/// Returns the name of a new sweep on a bus: that of its folder, and a number of its own.
pub(crate) fn bus_name(root: Option<&Path>) -> String {
    let name = root.and_then(Path::file_name).unwrap_or("sweep".as_ref()).to_string_lossy().to_lowercase();
    let allowed = |c: char| if c.is_ascii_alphanumeric() || "_-".contains(c) { c } else { '-' };
    let name: String = name.chars().map(allowed).take(SWEEP_CHARS_MAX).collect();
    format!("{name}-{:08x}", seeds::unique() as u32)
}

/// Returns the folder of a trial in that of a sweep.
pub(crate) fn trial(root: &Path, index: usize) -> PathBuf {
    root.join(format!("trial-{}", index + 1))
}

/// Returns the folder of a sweep, by path or by name below `runs/`.
///
/// # Errors
/// If there is no sweep.
pub(crate) fn find(given: &str) -> Result<PathBuf, Usage> {
    let mut roots = [PathBuf::from(given), Path::new("runs").join(given)].into_iter();
    roots
        .find(|root| SweepFolder::is_sweep(root))
        .ok_or_else(|| Usage(format!("there is no sweep at `{given}`; name the folder that has the file {FILE}")))
}

/// Reads the plan of a sweep.
///
/// # Errors
/// If it cannot be read.
pub(crate) fn read(root: &Path) -> anyhow::Result<Plan> {
    let path = root.join(FILE);
    let text = fs::read_to_string(&path).with_context(|| format!("cannot read `{}`", path.display()))?;
    serde_json::from_str(&text).with_context(|| format!("`{}` is not the plan of a sweep", path.display()))
}
