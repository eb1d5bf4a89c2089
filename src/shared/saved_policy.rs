//! Policy named by a RUN argument: of a run's folder, of a bundle file, or of a file written by `export`.

use std::{fmt, fs, path::Path};

use anyhow::Context;
use treadmill_config::{ChosenTask, Config, ConfigSource};
use treadmill_humanoid::{Environment, Model, TaskRegistry};
use treadmill_learner::checkpoint::{self, CheckpointChoice, Loaded, TrainingState, encoding};
use treadmill_policy::exported::{ActionFacts, ExportedPolicy, ObservationFacts, ReturnFacts};
use treadmill_ppo::TrainedPolicy;
use treadmill_proto::Task;
use treadmill_runtime::numbers::thousands;

use crate::{launch::exit_code::Usage, shared::saved_run};

/// Policy that was read, and where it comes from.
#[derive(Clone)]
pub struct SavedPolicy {
    /// The policy.
    pub policy: ExportedPolicy,
    /// Configuration that it was trained under, as far as episodes depend on it.
    pub config: Config,
    /// Its checkpoint; `None` for a file that `export` wrote.
    pub origin: Option<Origin>,
}

/// Checkpoint that a policy comes from.
#[derive(Clone, Debug)]
pub struct Origin {
    /// Its name, as `--checkpoint` takes it, or its file.
    pub checkpoint: String,
    /// Environment steps learnt from until then.
    pub env_steps: u64,
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "checkpoint {}, {} steps", self.checkpoint, thousands(self.env_steps))
    }
}

/// Reads the policy of a run's folder or store, of a bundle file or of an exported file. `which` selects a checkpoint
/// of a folder; by default the best if there is one, else the latest.
///
/// # Errors
/// If there is no such run or file, its policy cannot be used, or `which` selects a checkpoint of a file.
pub fn load(run: &str, which: Option<CheckpointChoice>) -> anyhow::Result<SavedPolicy> {
    let path = Path::new(run);
    if !path.is_file() {
        let Loaded { name, state } = saved_run::load(run, which.unwrap_or(CheckpointChoice::BestOrLatest))?;
        return from_state(&state, name).with_context(|| format!("cannot use the policy of `{run}`"));
    }
    if which.is_some() {
        let why = format!("--checkpoint selects a checkpoint of a run, and `{run}` is a file; leave --checkpoint out");
        return Err(Usage(why).into());
    }
    let bytes = fs::read(path).with_context(|| format!("cannot read `{run}`"))?;
    let loaded = if encoding::is_checkpoint(&bytes) || path.extension().is_some_and(|end| end == "bundle") {
        from_state(&checkpoint::load_file(path)?, run.to_string())
    } else if path.extension().is_some_and(|end| end == "onnx") {
        let why = format!(
            "`{run}` is an ONNX model, which other programs play; name the run, its checkpoint, or a file written by \
             `treadmill export RUN --safetensors FILE`"
        );
        return Err(Usage(why).into());
    } else {
        let policy = ExportedPolicy::from_bytes(&bytes).map_err(anyhow::Error::from);
        policy.and_then(|policy| {
            let config = configuration(&policy)?;
            Ok(SavedPolicy { policy, config, origin: None })
        })
    };
    loaded.with_context(|| format!("`{run}` is not a usable policy"))
}

/// Builds the environment of a policy under `config`, which was made from [`SavedPolicy::config`].
///
/// # Errors
/// If the task is external, or the model does not fit the policy.
pub fn environment(
    tasks: &TaskRegistry,
    run: &str,
    policy: &ExportedPolicy,
    config: &Config,
) -> anyhow::Result<Environment> {
    if config.is_external() {
        return Err(Usage(format!(
            "`{run}` was trained for the task `{}`, which this program does not simulate; export the policy with \
             `treadmill export {run} --safetensors FILE` and play it in that environment (see python/README.md)",
            config.task_name()
        ))
        .into());
    }
    let environment = Environment::with_tasks(&config.environment().without_curricula(), &policy.model_xml, tasks)
        .with_context(|| format!("cannot build the environment of `{run}`"))?;
    let found = environment.observation_size();
    let sizes = (policy.shape.observation, policy.shape.action);
    if sizes != (found, environment.action_size()) {
        anyhow::bail!(
            "`{run}` has a policy for {} observations and {} actions, but its model has {found} and {}",
            sizes.0,
            sizes.1,
            environment.action_size()
        );
    }
    let ranges = policy.action.low.iter().zip(&policy.action.high).map(|(low, high)| [*low, *high]);
    for ((found, [low, high]), name) in ranges.zip(environment.action_ranges()).zip(&policy.action.names) {
        if found != [*low, *high] {
            let [found_low, found_high] = found;
            anyhow::bail!(
                "`{run}` drives `{name}` from action.low {found_low} to action.high {found_high}, its model from {low} \
                 to {high}"
            );
        }
    }
    Ok(environment)
}

fn from_state(state: &TrainingState, checkpoint: String) -> anyhow::Result<SavedPolicy> {
    let origin = Some(Origin { checkpoint, env_steps: state.counters.env_steps });
    let trained = state.ppo.trained_policy();
    let policy = exported(state, trained)?;
    let config = configuration(&policy)?;
    Ok(SavedPolicy { policy, config, origin })
}

/// Reads the settings that a policy carries.
fn configuration(policy: &ExportedPolicy) -> anyhow::Result<Config> {
    let mut source = ConfigSource::default();
    let parsed = source.text(&policy.settings, "the settings of the policy").and_then(|()| source.build());
    let config = parsed.context("its environment settings cannot be used")?;
    if !config.is_external() && policy.control_step_s != config.env.control_step_s {
        let (found, wanted) = (policy.control_step_s, config.env.control_step_s);
        anyhow::bail!("its metadata entry `control_step_s` is {found}; expected env.control_step_s, which is {wanted}");
    }
    Ok(config)
}

fn exported(state: &TrainingState, trained: TrainedPolicy) -> anyhow::Result<ExportedPolicy> {
    let config = state.config().map_err(anyhow::Error::msg)?;
    let (action, control_step_s) = match config.task.known() {
        Some(task) => (external_action(&task), task.control_step_s),
        None => (motors(&Model::from_mjcf(&state.model_xml)?), config.env.control_step_s),
    };
    let kind = match config.env.chosen_task() {
        ChosenTask::HumanoidV5 | ChosenTask::HumanoidV4 => config.env.observation.name(),
        ChosenTask::Velocity | ChosenTask::Motion | ChosenTask::External => config.env.task.name(),
        ChosenTask::Own(name) => name,
    };
    let (observation, mean, variance) =
        ObservationFacts::from_moments(kind, &trained.observation_moments, config.policy.observation_clip as f32);
    Ok(ExportedPolicy {
        shape: state.shape().clone(),
        parameters: trained.parameters,
        observation,
        mean,
        variance,
        action,
        returns: trained.value_moments.as_ref().map(ReturnFacts::from_moments),
        control_step_s,
        settings: config.episodes_toml(),
        model_xml: state.model_xml.clone(),
    })
}

fn motors(model: &Model) -> ActionFacts {
    ActionFacts {
        names: model.motors.iter().map(|motor| motor.name.clone()).collect(),
        low: model.motors.iter().map(|motor| motor.control[0] as f32).collect(),
        high: model.motors.iter().map(|motor| motor.control[1] as f32).collect(),
    }
}

/// Returns the action facts of an external task, whose entries are named by their numbers.
fn external_action(task: &Task) -> ActionFacts {
    let narrow = |range: &[f64]| range.iter().map(|end| *end as f32).collect();
    ActionFacts {
        names: (0..task.action_size).map(|index| index.to_string()).collect(),
        low: narrow(&task.action_low),
        high: narrow(&task.action_high),
    }
}
