//! Begins a run: configuration, robot, folder and first state.

use treadmill_config::{Config, ConfigSource, LearnerMode, RolloutConfig};
use treadmill_humanoid::{Model, PHYSICS_VERSION, card::BodySize};
use treadmill_learner::checkpoint::TrainingState;
use treadmill_ppo::settings;
use treadmill_proto::limits::fragment_envs_max;
use treadmill_runtime::{machine, run_folder::RunFolder, run_lock::RunLock, seeds};

use crate::launch::{
    automatic,
    choice::choose_environments,
    exit_code::Usage,
    model,
    prepared::{
        FirstState, Launcher, Prepared, RunCommand, RunSetup, Start, actor_processes, check_external, check_not_stored,
        complete, open_device,
    },
    run_args::{AnyRunArgs, NewRunArgs, OF_ANY_ROBOT, add_count},
    warm_start::{Fork, InitFrom, OBSERVATION_KEYS},
};

/// Begins a run. `changes` are keys set by flags of the command.
///
/// # Errors
/// If flags or configuration are refused, or the folder cannot be created.
pub fn begin(
    launcher: Launcher<'_>,
    new: &NewRunArgs,
    any: &AnyRunArgs,
    changes: &[(&str, toml::Value)],
) -> anyhow::Result<Start> {
    let Sources { source, fork, init_from } = sources(launcher, new, any, changes)?;
    let mut config = source.build()?;
    complete(&mut config);
    // A deterministic run is the same with any number of threads.
    if config.learner.chunk_rows == 0 && !config.run.deterministic {
        let threads = machine::threads(config.learner.threads as usize);
        config.learner.chunk_rows = settings::chunk_rows(&config.ppo, threads);
    }
    check_external(launcher.command, &config, any)?;
    match fork {
        Some(fork) => branch_off(launcher, new, any, config, fork),
        None if config.is_external() => begin_external(new, any, config, init_from),
        None => {
            let is_given = new.gives("rollout.envs") || changes.iter().any(|(key, _)| *key == "rollout.envs");
            begin_built_in(launcher, new, any, (config, is_given), init_from)
        }
    }
}

/// Configuration of a new run as its flags give it, and what it begins from.
pub struct Sources {
    /// Keys by flags and files.
    pub source: ConfigSource,
    fork: Option<Fork>,
    init_from: Option<InitFrom>,
}

/// Reads the configuration of a new run.
///
/// # Errors
/// If flags are refused, or what the run begins from cannot be read.
pub fn sources(
    launcher: Launcher<'_>,
    new: &NewRunArgs,
    any: &AnyRunArgs,
    changes: &[(&str, toml::Value)],
) -> anyhow::Result<Sources> {
    let fork = new.fork.as_ref().map(|run| Fork::read(run, any.checkpoint)).transpose()?;
    let mut source = ConfigSource::default();
    match &fork {
        Some(fork) => source.text(&fork.state.config_toml, "the configuration of the forked run")?,
        None => source.preset(new.preset())?,
    }
    let init_from = if fork.is_none() { InitFrom::read(new, any)? } else { None };
    if fork.is_none() {
        add_size(&mut source, launcher, new, any, changes, init_from.as_ref())?;
    }
    if launcher.command == RunCommand::Learner && fork.is_none() {
        // Its actors are on other machines, and do not wait for the update.
        source.value("learner.mode", LearnerMode::Async.name())?;
    }
    new.add_to(&mut source, launcher.tasks, changes)?;
    any.steps.map_or(Ok(()), |steps| add_count(&mut source, "run.steps", steps))?;
    Ok(Sources { source, fork, init_from })
}

/// Adds the keys that follow from the size of a robot of the velocity task, unless a preset has those of its robot.
fn add_size(
    source: &mut ConfigSource,
    launcher: Launcher<'_>,
    new: &NewRunArgs,
    any: &AnyRunArgs,
    changes: &[(&str, toml::Value)],
    init_from: Option<&InitFrom>,
) -> anyhow::Result<()> {
    if new.preset() != OF_ANY_ROBOT {
        return Ok(());
    }
    let mut whole = source.clone();
    new.add_to(&mut whole, launcher.tasks, changes)?;
    let config = whole.build()?;
    let mut size = None;
    if !config.is_external() {
        let file = any.model.as_deref();
        let text = model::completed(&config, file, &any.model_file, InitFrom::model_of(init_from))?;
        let found = Model::from_mjcf(&text).and_then(|model| BodySize::of(&model));
        // A body of another kind has commands of its own.
        size = found.inspect_err(|why| tracing::warn!("commands and rewards are those of a G1: {why}")).ok();
    }
    for (key, value) in automatic::keys(size) {
        source.value(key, value)?;
    }
    Ok(())
}

/// Begins a run of a task of this program. `has_envs` is whether the number of environments is given.
fn begin_built_in(
    launcher: Launcher<'_>,
    new: &NewRunArgs,
    any: &AnyRunArgs,
    (mut config, has_envs): (Config, bool),
    init_from: Option<InitFrom>,
) -> anyhow::Result<Start> {
    let device = open_device(&config, any.device)?;
    let file = any.model.as_deref();
    let mut text = model::completed(&config, file, &any.model_file, InitFrom::model_of(init_from.as_ref()))?;
    if let Some(from) = &init_from {
        text = from.in_its_order(&text, file)?.into();
    }
    text = model::with_given_motions(&config, &text, &any.motion)?.into();
    let environment = model::environment(launcher.tasks, &config, &text, file)?;
    if let Some(file) = file {
        model::examine(launcher.tasks, &config, &text, file)?;
    }
    model::warn_of_unreachable(&environment);
    let networks = model::networks(&config, &environment)?;
    settings::choose(&mut config.ppo, &networks);
    let mut choice = None;
    if launcher.command == RunCommand::Train {
        if !has_envs {
            choice = choose_environments(&mut config, launcher.tasks, &text, &networks, &device);
        }
        check_fragments(&config, environment.observation_size(), environment.action_size())?;
    }
    let fresh = TrainingState::fresh("", &config, &text, networks, seeds::unique());
    let mut state = TrainingState { physics_version: PHYSICS_VERSION, ..fresh };
    let origin = init_from.as_ref().map(|from| from.copy_to(&mut state)).transpose()?;
    let (folder, lock) = create_folder(new, any, new.preset())?;
    let run = folder.name().to_string();
    state.run.clone_from(&run);
    let setup = RunSetup { config, folder, device, run, origin, store: None, choice };
    Ok(ready(setup, FirstState::Known(Box::new(state)), lock))
}

/// Begins a run whose task an actor registers; it has no state until then, unless the configuration knows the task.
fn begin_external(
    new: &NewRunArgs,
    any: &AnyRunArgs,
    config: Config,
    init_from: Option<InitFrom>,
) -> anyhow::Result<Start> {
    let device = open_device(&config, any.device)?;
    let known = config.task.known();
    if let Some(why) = known.as_ref().and_then(|task| TrainingState::objection(&config, task)) {
        return Err(Usage(why).into());
    }
    let (folder, lock) = create_folder(new, any, new.preset())?;
    let run = folder.name().to_string();
    let mut setup = RunSetup { config, folder, device, run, origin: None, store: None, choice: None };
    let state = match known {
        Some(task) => {
            let fresh = setup.set_task(task, init_from.as_ref()).inspect_err(|_| setup.folder.discard())?;
            FirstState::Known(Box::new(fresh))
        }
        None => FirstState::AwaitsTask(init_from.map(Box::new)),
    };
    Ok(ready(setup, state, lock))
}

fn ready(setup: RunSetup, state: FirstState, lock: RunLock) -> Start {
    Start::Ready(Box::new(Prepared { setup, state }), lock)
}

/// Begins a run with the learning state of another one.
fn branch_off(
    launcher: Launcher<'_>,
    new: &NewRunArgs,
    any: &AnyRunArgs,
    mut config: Config,
    fork: Fork,
) -> anyhow::Result<Start> {
    let device = open_device(&config, any.device)?;
    let (prefix, origin) = (format!("{}-fork", fork.state.run), Some(fork.origin.clone()));
    settings::choose(&mut config.ppo, fork.state.ppo.networks());
    let mut state = fork.with_config(&config, new)?;
    model::check_flags(any.model.as_deref(), &any.model_file)?;
    if !config.is_external() {
        if let Some(file) = &any.model {
            model::check_same(&config, &state.model_xml, file, &any.model_file)?;
        }
        any.motion.check_same(&state.model_xml)?;
        let environment = model::environment(launcher.tasks, &config, &state.model_xml, None)?;
        let (size, wanted) = (environment.observation_size(), state.shape().observation);
        if size != wanted || environment.privileged_size() != state.shape().privileged {
            let why = format!("`--fork`: this configuration has {size} observations, and the networks take {wanted}");
            return Err(Usage(format!("{why}; keep {OBSERVATION_KEYS}")).into());
        }
        if launcher.command == RunCommand::Train {
            check_fragments(&config, size, state.shape().action)?;
        }
    }
    let (folder, lock) = create_folder(new, any, &prefix)?;
    let run = folder.name().to_string();
    state.run.clone_from(&run);
    let setup = RunSetup { config, folder, device, run, origin, store: None, choice: None };
    Ok(ready(setup, FirstState::Known(Box::new(state)), lock))
}

fn create_folder(new: &NewRunArgs, any: &AnyRunArgs, prefix: &str) -> anyhow::Result<(RunFolder, RunLock)> {
    if let (Some(root), None) = (&new.run_dir, &any.store)
        && let Ok(folder) = RunFolder::open(&root.to_string_lossy())
        && folder.root() == root
    {
        check_not_stored(&folder)?;
    }
    let folder = RunFolder::create(new.run_dir.as_deref(), prefix)?;
    Ok(RunLock::take(&folder).map(|lock| (folder, lock))?)
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
