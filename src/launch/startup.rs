//! Preparation of a run from its flags: configuration, folder, first or resumed state.

use std::{fs, path::PathBuf};

use anyhow::Context;
use clap::Args;
use serde_json::json;
use treadmill_config::{Config, ConfigSource, EnvTask, LearnerMode, RolloutConfig};
use treadmill_humanoid::PHYSICS_VERSION;
use treadmill_learner::checkpoint::{self, TrainingState, Which};
use treadmill_policy::device::{Device, DeviceKind};
use treadmill_ppo::BatchMirror;
use treadmill_proto::{Task, WIRE_VERSION, limits::fragment_envs_max};
use treadmill_runtime::{
    atomic_file, error_chain, machine,
    numbers::parse_count,
    run_folder::{RunFolder, RunFolderError},
    run_lock::RunLock,
    seeds, words,
};

use crate::{
    launch::{exit_code::Usage, model, resumption},
    shared::existing_file::existing_file,
};

/// Flags that configure a new run. A resumed run has them saved and accepts those that agree.
#[derive(Args, Clone, Debug, Default)]
pub struct NewRunArgs {
    /// Preset to start the configuration from: walk (the default), walk-v5obs, walk-v4obs, smoke or sim2sim.
    #[arg(long, value_name = "NAME")]
    pub preset: Option<String>,
    /// Configuration file (TOML), applied over the preset.
    #[arg(long, value_name = "FILE", value_parser = existing_file)]
    pub config: Option<PathBuf>,
    /// Set a configuration key, as in ppo.learning_rate=3e-4; may be repeated.
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Task: humanoid-v5, humanoid-v4, `external` for the task that the first actor registers, or the name of such a task,
    /// as in gymnasium/Humanoid-v5 (see docs/guide/external-tasks.md).
    #[arg(long, value_name = "NAME")]
    pub task: Option<String>,
    /// Seed of every random stream.
    #[arg(long)]
    pub seed: Option<u64>,
    /// Folder of the run; by default runs/PRESET-N with the first free N.
    #[arg(long, value_name = "DIR")]
    pub run_dir: Option<PathBuf>,
}

impl NewRunArgs {
    fn preset(&self) -> &str {
        self.preset.as_deref().unwrap_or("walk")
    }

    /// Adds the file, the keys and the task, in this order, then `changes`, which are keys of other flags, and the seed.
    pub fn add_to(&self, source: &mut ConfigSource, changes: &[(&str, toml::Value)]) -> anyhow::Result<()> {
        if let Some(file) = &self.config {
            source.file(file)?;
        }
        for pair in &self.set {
            source.set(pair)?;
        }
        let task = self.task.as_deref().map(task_keys).transpose()?;
        for (key, value) in task.unwrap_or_default().iter().chain(changes) {
            source.value(key, value.clone())?;
        }
        self.seed.map_or(Ok(()), |seed| add_count(source, "run.seed", seed))
    }
}

/// Flags of new and resumed runs.
#[derive(Args, Clone, Debug, Default)]
pub struct AnyRunArgs {
    /// Total number of environment steps of the run, as in 8000000, 8M or 1e6.
    #[arg(long, value_parser = parse_count)]
    pub steps: Option<u64>,
    /// Resume this run: its folder, or its name below runs/.
    #[arg(long, value_name = "RUN")]
    pub resume: Option<String>,
    /// Resume the run in --run-dir if it has a checkpoint, else begin it: one command line for a service.
    #[arg(long, requires = "run_dir", conflicts_with = "resume")]
    pub resume_or_start: bool,
    /// MJCF file of a robot other than the built-in humanoid (see docs/guide/robots.md); a resumed run keeps its own.
    #[arg(long, value_name = "FILE", value_parser = existing_file)]
    pub model: Option<PathBuf>,
    /// Checkpoint to resume from: latest, best, or the number of updates of a kept one.
    #[arg(long, value_name = "WHICH", requires = "resume")]
    pub checkpoint: Option<Which>,
    /// Device for the networks: cpu, or cuda in a build with that feature.
    #[arg(long, value_name = "DEVICE", default_value = "cpu")]
    pub device: DeviceKind,
    /// Do not show progress.
    #[arg(long)]
    pub no_progress: bool,
    /// Print all metrics every `learner.table_every_updates` updates.
    #[arg(long)]
    pub log_metrics: bool,
    /// Print one JSON summary as the last line of standard output.
    #[arg(long)]
    pub json: bool,
}

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
}

impl Prepared {
    /// Sets the task of a new run and creates its state.
    pub fn set_task(&mut self, task: Task) -> anyhow::Result<()> {
        let (observation, action) = (task.observation_size as usize, task.action_size as usize);
        self.config.task = task.into();
        self.config.check()?;
        let fresh = TrainingState::fresh(&self.run, &self.config, "", observation, action, seeds::unique());
        self.state = Some(fresh);
        Ok(fs::write(self.folder.config(), self.config.to_toml())?)
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
    let begun = new.run_dir.as_deref().filter(|root| any.resume_or_start && RunFolder::has_checkpoint(root));
    let saved = any.resume.clone().or(begun.map(|root| root.display().to_string()));
    let start = match saved {
        Some(run) => resumption::resume(command, &run, new, any, changes)?,
        None => begin(command, new, any, changes)?,
    };
    let Start::Ready(prepared, _) = &start else { return Ok(start) };
    let stale = prepared.folder.remove_stale_files()?;
    if stale > 0 {
        tracing::info!(stale, "removed temporary files that a killed process left");
    }
    write_run_files(prepared)
        .inspect_err(|_| prepared.folder.discard())
        .with_context(|| format!("cannot write to {}", prepared.folder.root().display()))?;
    Ok(start)
}

/// Adds a count to a configuration.
fn add_count(source: &mut ConfigSource, key: &str, count: u64) -> anyhow::Result<()> {
    let count =
        i64::try_from(count).map_err(|_| Usage(format!("`{key}` is {count}; allowed: at most {}", i64::MAX)))?;
    Ok(source.value(key, count)?)
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

/// Returns the keys that `--task NAME` sets: the task, and its name if it is external.
fn task_keys(name: &str) -> Result<Vec<(&'static str, toml::Value)>, Usage> {
    if EnvTask::NAMES.contains(&name) {
        return Ok(vec![("env.task", name.into())]);
    }
    let ours = name.to_lowercase();
    if EnvTask::NAMES.contains(&ours.as_str()) {
        return Err(Usage(format!(
            "--task {name}: the built-in task is `{ours}`; `gymnasium/{name}` is Gymnasium's own, which Python actors simulate"
        )));
    }
    Ok(vec![("env.task", EnvTask::External.name().into()), ("task.name", name.into())])
}

/// Returns the number of actor processes of `train`: `wanted`, or one per core if that is 0.
pub fn actor_processes(wanted: u32, envs: u32) -> u32 {
    let wanted = if wanted == 0 { machine::cores() as u32 } else { wanted };
    wanted.min(envs)
}

/// Refuses actors with more environments than a fragment holds.
fn check_fragments(config: &Config, observation: usize, action: usize) -> Result<(), Usage> {
    let RolloutConfig { envs, actors, fragment_steps, .. } = config.rollout;
    let steps = if fragment_steps == 0 { RolloutConfig::STEPS_MIN } else { fragment_steps };
    let (actors, envs_max) = (actor_processes(actors, envs), fragment_envs_max(steps, observation, action));
    let needed = (envs as usize).div_ceil(envs_max.max(1));
    if needed <= actors as usize {
        return Ok(());
    }
    Err(Usage(format!(
        "{actors} actors cannot send fragments of {envs} environments with {steps} steps, because a fragment holds at most \
         {envs_max} environments; use --actors {needed}, fewer --envs, or a smaller rollout.fragment_steps"
    )))
}

fn begin(
    command: RunCommand,
    new: &NewRunArgs,
    any: &AnyRunArgs,
    changes: &[(&str, toml::Value)],
) -> anyhow::Result<Start> {
    let mut source = ConfigSource::default();
    source.preset(new.preset())?;
    if command == RunCommand::Learner {
        // Its actors are on other machines, and do not wait for the update.
        source.value("learner.mode", "async")?;
    }
    new.add_to(&mut source, changes)?;
    any.steps.map_or(Ok(()), |steps| add_count(&mut source, "run.steps", steps))?;
    let mut config = source.build()?;
    complete(&mut config);
    check_external(command, &config, any)?;
    let device = open_device(&config, any.device)?;
    if config.is_external() {
        let known = config.task.known();
        if let Some(why) = known.as_ref().and_then(|task| TrainingState::objection(&config, task)) {
            return Err(Usage(why).into());
        }
        let (folder, lock) = create_folder(new)?;
        let run = folder.name().to_string();
        let mut prepared = Prepared { config, folder, device, mirror: None, run, state: None };
        known.map_or(Ok(()), |task| prepared.set_task(task))?;
        return Ok(Start::Ready(Box::new(prepared), lock));
    }
    let text = model::text(any.model.as_deref())?;
    let environment = model::environment(&config, &text, any.model.as_deref())?;
    let mirror = model::mirror(&config, &text)?;
    let (observation, action) = (environment.observation_size(), environment.action_size());
    if command == RunCommand::Train {
        check_fragments(&config, observation, action)?;
    }
    let (folder, lock) = create_folder(new)?;
    let fresh = TrainingState::fresh(folder.name(), &config, &text, observation, action, seeds::unique());
    let state = TrainingState { physics_version: PHYSICS_VERSION, ..fresh };
    let prepared = Prepared { config, folder, device, mirror, run: state.run.clone(), state: Some(state) };
    Ok(Start::Ready(Box::new(prepared), lock))
}

fn create_folder(new: &NewRunArgs) -> Result<(RunFolder, RunLock), RunFolderError> {
    let folder = RunFolder::create(new.run_dir.as_deref(), new.preset())?;
    RunLock::take(&folder).map(|lock| (folder, lock))
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

/// Returns the configuration keys of the flags that were given.
pub fn changes(flags: &[(&'static str, Option<u32>)]) -> Vec<(&'static str, toml::Value)> {
    flags.iter().filter_map(|(key, value)| value.map(|value| (*key, i64::from(value).into()))).collect()
}
