//! Run that is ready to begin, and the checks that new and resumed runs share.

use std::fs;

use treadmill_config::{Config, LearnerMode};
use treadmill_humanoid::TaskRegistry;
use treadmill_learner::checkpoint::TrainingState;
use treadmill_ppo::device::{Device, DeviceKind};
use treadmill_ppo::settings;
use treadmill_proto::Task;
use treadmill_runtime::{atomic_file, error_chain, machine, run_folder::RunFolder, run_lock::RunLock, seeds};

use crate::launch::{exit_code::Usage, resume_line, run_args::AnyRunArgs, warm_start::InitFrom};

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
        let saved = match self {
            Self::Ready(prepared, _) => prepared.state.known().filter(|state| state.counters.resumes > 0),
            Self::Finished(_, state) => Some(&**state),
        };
        if let Some(saved) = saved.map(|state| &state.run).filter(|saved| **saved != run) {
            return Err(Usage(format!(
                "`--run {run}`: the saved run is `{saved}`, and a resumed run keeps its name; leave --run out"
            )));
        }
        if let Self::Ready(prepared, _) = self {
            if let FirstState::Known(state) = &mut prepared.state {
                state.run.clone_from(&run);
            }
            prepared.setup.run = run;
        }
        Ok(())
    }
}

/// Run that is ready to begin.
pub struct Prepared {
    /// Everything but its state.
    pub setup: RunSetup,
    /// State that it begins with.
    pub state: FirstState,
}

/// State that a run begins with.
pub enum FirstState {
    /// Fresh, of another run, or resumed.
    Known(Box<TrainingState>),
    /// Fresh once an actor has registered the external task, which defines the sizes; with the policy to begin with.
    AwaitsTask(Option<Box<InitFrom>>),
}

impl FirstState {
    /// Returns the state, if it is known.
    pub fn known(&self) -> Option<&TrainingState> {
        match self {
            Self::Known(state) => Some(state),
            Self::AwaitsTask(_) => None,
        }
    }
}

/// Configuration, folder and device of a run.
pub struct RunSetup {
    /// Its configuration. `run.steps` is the goal of this start, which may be less than that of the run.
    pub config: Config,
    /// Its folder.
    pub folder: RunFolder,
    /// Device of its networks.
    pub device: Device,
    /// Its name on the bus.
    pub run: String,
    /// Where its first state came from, if it is not fresh.
    pub origin: Option<String>,
    /// URL of the store of its state, unless that is in its folder.
    pub store: Option<String>,
    /// What was chosen for this machine, and why.
    pub choice: Option<String>,
}

impl RunSetup {
    /// Returns the command that resumes this run.
    pub fn resume_command(&self, command: &str) -> String {
        resume_line::of_this_process(command, &self.folder, self.store.as_deref())
    }

    /// Sets the external task of a new run, and returns its first state, with the policy of `init_from`.
    ///
    /// # Errors
    /// If the task is not allowed, the policy does not fit, or the configuration cannot be written.
    pub fn set_task(&mut self, task: Task, init_from: Option<&InitFrom>) -> anyhow::Result<TrainingState> {
        let networks = TrainingState::networks_for(&self.config, &task).map_err(Usage)?;
        self.config.task = task.into();
        settings::choose(&mut self.config.ppo, &networks);
        self.config.check()?;
        let mut fresh = TrainingState::fresh(&self.run, &self.config, "", networks, seeds::unique());
        self.origin = init_from.map(|from| from.copy_to(&mut fresh)).transpose()?;
        atomic_file::write(&self.folder.config(), self.config.to_toml().as_bytes())?;
        Ok(fresh)
    }
}

/// Refuses the folder of a run whose state is in a store, where a checkpoint in the folder is wanted.
pub fn check_not_stored(folder: &RunFolder) -> Result<(), Usage> {
    let is_stored = fs::read_to_string(folder.store()).is_ok_and(|url| !url.trim().is_empty());
    match is_stored && !RunFolder::has_checkpoint(folder.root()) {
        true => Err(Usage(format!(
            "the state of the run in `{}` is in a store; continue it with `{}`",
            folder.root().display(),
            resume_line::of_folder(folder)
        ))),
        false => Ok(()),
    }
}

/// Program that prepares a run: its command, and the tasks that it can simulate.
#[derive(Clone, Copy, Debug)]
pub struct Launcher<'a> {
    /// Command.
    pub command: RunCommand,
    /// Tasks.
    pub tasks: &'a TaskRegistry,
}

/// Command that a run is prepared for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunCommand {
    /// Learner with actor processes beside it.
    Train,
    /// Learner alone.
    Learner,
}

impl RunCommand {
    /// Returns the name of the command.
    pub fn name(self) -> &'static str {
        match self {
            Self::Train => "train",
            Self::Learner => "learner",
        }
    }
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
            "--deterministic promises the same weights bit for bit, which a GPU does not compute; use --device cpu, or \
             leave --deterministic out"
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
