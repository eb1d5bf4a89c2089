//! Preparation of a run from its flags: configuration, folder, first or resumed state.

use std::{fs, path::PathBuf};

use anyhow::Context;
use serde_json::json;
use treadmill_config::{Config, LearnerMode};
use treadmill_humanoid::PHYSICS_VERSION;
use treadmill_learner::checkpoint::{self, TrainingState};
use treadmill_policy::device::{Device, DeviceKind};
use treadmill_ppo::BatchMirror;
use treadmill_proto::{Task, WIRE_VERSION};
use treadmill_runtime::{atomic_file, error_chain, machine, run_folder::RunFolder, run_lock::RunLock, seeds, words};

use crate::launch::{
    begin,
    exit_code::Usage,
    resumption,
    run_args::{AnyRunArgs, NewRunArgs},
    warm_start::InitFrom,
};

/// Result of preparing a run.
pub enum Start {
    /// It can begin, and this process alone may write into its folder while it keeps the lock.
    Ready(Box<Prepared>, RunLock),
    /// It has all its steps.
    Finished(RunFolder, Box<TrainingState>),
}

impl Start {
    /// Sets the name of a new run on the bus.
    ///
    /// # Errors
    /// If a resumed or finished run has another name.
    pub fn set_name(&mut self, run: String) -> Result<(), Usage> {
        let (saved, prepared) = match self {
            Self::Ready(prepared, _) => {
                let saved = prepared.state.as_ref().filter(|state| state.counters.resumes > 0);
                (saved.map(|state| state.run.clone()), Some(prepared))
            }
            Self::Finished(_, state) => (Some(state.run.clone()), None),
        };
        if let Some(saved) = saved.filter(|saved| *saved != run) {
            return Err(Usage(format!(
                "`--run {run}`: the saved run is `{saved}`, and a resumed run keeps its name; leave --run out"
            )));
        }
        if let Some(prepared) = prepared {
            prepared.state.iter_mut().for_each(|state| state.run.clone_from(&run));
            prepared.run = run;
        }
        Ok(())
    }
}

/// Run that is ready to begin.
pub struct Prepared {
    /// Its configuration. `run.steps` is the goal of this start, which may be less than that of the run.
    pub config: Config,
    /// Its folder.
    pub folder: RunFolder,
    /// Device of its networks.
    pub device: Device,
    /// Mirror for its updates, with `ppo.symmetry`.
    pub mirror: Option<BatchMirror>,
    /// Its name on the bus.
    pub run: String,
    /// Its state; `None` until an actor has registered the external task, which defines the sizes.
    pub state: Option<TrainingState>,
    /// Policy that a new run begins with.
    pub init_from: Option<InitFrom>,
    /// Where its first state came from, if it is not fresh.
    pub origin: Option<String>,
    /// URL of the store of its state, unless that is in its folder.
    pub store: Option<String>,
}

impl Prepared {
    /// Returns the command that resumes this run.
    pub fn resume_command(&self, command: &str) -> String {
        resume_command(command, &self.folder, self.store.as_deref())
    }

    /// Sets the task of a new run and creates its state.
    pub fn set_task(&mut self, task: Task) -> anyhow::Result<()> {
        let (observation, action) = (task.observation_size as usize, task.action_size as usize);
        self.config.task = task.into();
        self.config.check()?;
        let mut fresh = TrainingState::fresh(&self.run, &self.config, "", observation, 0, action, seeds::unique());
        self.origin = self.init_from.as_ref().map(|from| from.copy_to(&mut fresh)).transpose()?;
        self.state = Some(fresh);
        Ok(atomic_file::write(&self.folder.config(), self.config.to_toml().as_bytes())?)
    }
}

/// Returns the command that resumes the run of a folder, or of a store.
pub fn resume_command(command: &str, folder: &RunFolder, store: Option<&str>) -> String {
    match store {
        Some(url) => format!("treadmill {command} --store {} --resume-or-start", words::quoted(url)),
        None => format!("treadmill {command} --resume {}", words::quoted(&folder.root().display().to_string())),
    }
}

/// Returns the command that resumes the run of a folder, by the files there.
pub fn resume_command_of(folder: &RunFolder) -> String {
    let text = |path: PathBuf| fs::read_to_string(path).unwrap_or_default();
    let config: toml::Table = text(folder.config()).parse().unwrap_or_default();
    let task = config.get("env").and_then(|env| env.get("task")).and_then(toml::Value::as_str);
    let command = if task == Some("external") { "learner" } else { "train" };
    let store = text(folder.store());
    resume_command(command, folder, Some(store.trim()).filter(|url| !url.is_empty()))
}

/// Refuses the folder of a run whose state is in a store, where a checkpoint in the folder is wanted.
pub fn check_not_stored(folder: &RunFolder) -> Result<(), Usage> {
    let is_stored = fs::read_to_string(folder.store()).is_ok_and(|url| !url.trim().is_empty());
    match is_stored && !RunFolder::has_checkpoint(folder.root()) {
        true => Err(Usage(format!(
            "the state of the run in `{}` is in a store; continue it with `{}`",
            folder.root().display(),
            resume_command_of(folder)
        ))),
        false => Ok(()),
    }
}

/// Command that a run is prepared for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunCommand {
    /// Learner with actor processes beside it.
    Train,
    /// Learner alone.
    Learner,
}

/// Prepares a new or resumed run. `changes` are keys set by flags of the command.
///
/// # Errors
/// If flags or configuration are refused, another process has the run, or its folder cannot be read or written.
pub fn prepare(
    command: RunCommand,
    new: &NewRunArgs,
    any: &AnyRunArgs,
    changes: &[(&str, toml::Value)],
) -> anyhow::Result<Start> {
    if any.resume_or_start && new.run_dir.is_none() {
        let why = "--resume-or-start needs the folder of the run: pass --run-dir DIR, or --store URL".to_string();
        return Err(Usage(why).into());
    }
    let begun = new.run_dir.as_deref().filter(|root| any.resume_or_start && RunFolder::has_checkpoint(root));
    let saved = any.resume.clone().or(begun.map(|root| root.display().to_string()));
    let start = match saved {
        Some(run) => resumption::resume(command, &run, new, any, changes)?,
        None => begin::begin(command, new, any, changes)?,
    };
    write_files(&start)?;
    Ok(start)
}

/// Writes the files of a run that is ready, besides its state.
///
/// # Errors
/// If its folder cannot be written; a new one is removed then.
pub fn write_files(start: &Start) -> anyhow::Result<()> {
    let Start::Ready(prepared, _) = start else { return Ok(()) };
    let stale = prepared.folder.remove_stale_files()?;
    if stale > 0 {
        tracing::info!(stale, "removed temporary files that a killed process left");
    }
    write_run_files(prepared)
        .inspect_err(|_| prepared.folder.discard())
        .with_context(|| format!("cannot write to {}", prepared.folder.root().display()))
}

/// Sets what `run.deterministic` requires.
pub fn complete(config: &mut Config) {
    if config.run.deterministic {
        config.rollout.actors = 1;
        config.rollout.max_in_flight = 1;
        config.learner.mode = LearnerMode::Sync;
    }
}

/// Opens the device of a run; called before anything is written, so that a missing device leaves nothing behind.
pub fn open_device(config: &Config, kind: DeviceKind) -> Result<Device, Usage> {
    if config.run.deterministic && kind == DeviceKind::Cuda {
        return Err(Usage(
            "--deterministic promises the same weights bit for bit, which a GPU does not compute; use --device cpu, or leave \
             --deterministic out"
                .to_string(),
        ));
    }
    kind.open().map_err(|why| Usage(error_chain(&why)))
}

/// Refuses commands and flags that make no sense for a task that other programs simulate.
pub fn check_external(command: RunCommand, config: &Config, any: &AnyRunArgs) -> Result<(), Usage> {
    if !config.is_external() {
        return Ok(());
    }
    if command == RunCommand::Train {
        return Err(Usage(
            "the actors that `train` starts simulate only the humanoid; env.task \"external\" needs \
             `treadmill learner`, which actors of that task join (see docs/guide/external-tasks.md)"
                .to_string(),
        ));
    }
    match &any.model {
        None => Ok(()),
        Some(file) => Err(Usage(format!(
            "--model {}: an external task has no model; leave --model out, or train a built-in task",
            file.display()
        ))),
    }
}

/// Returns the number of actor processes of `train`: `wanted`, or one per core if that is 0.
pub fn actor_processes(wanted: u32, envs: u32) -> u32 {
    let wanted = if wanted == 0 { machine::cores() as u32 } else { wanted };
    wanted.min(envs)
}

fn write_run_files(prepared: &Prepared) -> std::io::Result<()> {
    use std::io::Write;
    let Prepared { config, folder, state, .. } = prepared;
    // Atomically: on a full disk, the files of the previous start remain.
    let write = |path: PathBuf, text: &str| atomic_file::write(&path, text.as_bytes());
    // The saved configuration, whose goal may be beyond that of this start.
    let saved = state.as_ref().map_or_else(|| config.to_toml(), |state| state.config_toml.clone());
    write(folder.config(), &saved)?;
    if let Some(text) = state.as_ref().map(|state| &state.model_xml).filter(|text| !text.is_empty()) {
        write(folder.root().join("model.xml"), text)?;
    }
    let mut commands = fs::OpenOptions::new().create(true).append(true).open(folder.root().join("command.txt"))?;
    writeln!(commands, "{}", command_line())?;
    let versions: serde_json::Map<_, _> = facts().into_iter().map(|(name, value)| (name.to_string(), value)).collect();
    write(folder.root().join("versions.json"), &format!("{:#}\n", json!(versions)))
}

/// Returns this process's command line, quoted for a shell.
pub fn command_line() -> String {
    std::env::args().map(|part| words::quoted(&part)).collect::<Vec<_>>().join(" ")
}

/// Returns facts about this program and this machine.
fn facts() -> [(&'static str, serde_json::Value); 8] {
    [
        ("treadmill", env!("CARGO_PKG_VERSION").into()),
        ("checkpoint_format", checkpoint::encoding::FORMAT.into()),
        ("wire_version", WIRE_VERSION.into()),
        ("physics_version", PHYSICS_VERSION.into()),
        ("os", std::env::consts::OS.into()),
        ("architecture", std::env::consts::ARCH.into()),
        ("cpu", machine::cpu_name().into()),
        ("cores", machine::cores().into()),
    ]
}

/// Returns facts about program and machine as text, with the host and the run's seed.
pub fn versions(config: &Config) -> Vec<(String, String)> {
    let plain = |value: serde_json::Value| value.as_str().map_or_else(|| value.to_string(), str::to_string);
    let mut versions: Vec<_> = facts().into_iter().map(|(name, value)| (name.to_string(), plain(value))).collect();
    versions.push(("host".to_string(), machine::host_name()));
    versions.push(("seed".to_string(), config.run.seed.to_string()));
    versions
}
