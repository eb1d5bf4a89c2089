//! Policy named by a RUN argument: of a run's folder, of a bundle file, or of a file written by `export`.

use std::{fs, path::Path};

use anyhow::Context;
use treadmill_actor::settings;
use treadmill_config::{Config, EnvTask};
use treadmill_humanoid::{CONTROL_STEP_S, Environment, Model};
use treadmill_learner::checkpoint::{self, TrainingState, Which, encoding};
use treadmill_policy::exported::{ActionFacts, ExportedPolicy, ObservationFacts};
use treadmill_proto::Task;
use treadmill_runtime::run_folder::RunFolder;

use crate::launch::exit_code::Usage;

/// Reads the policy of a run's folder (its checkpoint `which`), of a bundle file or of an exported file.
///
/// # Errors
/// If there is no such run or file, or its policy cannot be used.
pub fn load(run: &str, which: Which) -> anyhow::Result<ExportedPolicy> {
    let path = Path::new(run);
    if !path.is_file() {
        let state = checkpoint::load(&RunFolder::open(run)?, which)?;
        return from_state(&state).with_context(|| format!("cannot use the policy of `{run}`"));
    }
    let bytes = fs::read(path).with_context(|| format!("cannot read `{run}`"))?;
    let policy = if encoding::is_checkpoint(&bytes) || path.extension().is_some_and(|end| end == "bundle") {
        from_state(&checkpoint::load_file(path)?)
    } else {
        ExportedPolicy::from_bytes(&bytes).map_err(anyhow::Error::from)
    };
    policy.with_context(|| format!("`{run}` is not a usable policy"))
}

/// Returns the configuration that a policy was trained under, as far as episodes depend on it.
pub fn trained_under(policy: &ExportedPolicy) -> Config {
    Config {
        env: policy.env.clone(),
        randomisation: policy.randomisation.clone(),
        task: policy.task.clone(),
        ..Config::default()
    }
}

/// Builds the environment of a policy under `config`, which was made from [`trained_under`].
///
/// # Errors
/// If the task is external, or the model does not fit the policy.
pub fn environment(run: &str, policy: &ExportedPolicy, config: &Config) -> anyhow::Result<Environment> {
    if config.is_external() {
        return Err(Usage(format!(
            "`{run}` was trained for the task `{}`, which this program does not simulate; export the policy with \
             `treadmill export {run} --safetensors FILE` and play it in that environment (see python/README.md)",
            config.task_name()
        ))
        .into());
    }
    let environment = Environment::new(&settings::training(config), &policy.model_xml)
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
                "`{run}` drives `{name}` from action.low {found_low} to action.high {found_high}, its model from {low} to {high}"
            );
        }
    }
    if policy.control_step_s != CONTROL_STEP_S {
        anyhow::bail!(
            "control_step_s of `{run}` is {}; this program simulates only {CONTROL_STEP_S}",
            policy.control_step_s
        );
    }
    Ok(environment)
}

fn from_state(state: &TrainingState) -> anyhow::Result<ExportedPolicy> {
    let config = state.config().map_err(anyhow::Error::msg)?;
    let (action, control_step_s) = match config.task.known() {
        Some(task) => (external_action(&task), task.control_step_s),
        None => (motors(&Model::from_mjcf(&state.model_xml)?), CONTROL_STEP_S),
    };
    let kind = if config.is_external() { EnvTask::External.name() } else { config.env.observation.name() };
    let (observation, mean, variance) =
        ObservationFacts::from_moments(kind, &state.observation_moments, config.policy.observation_clip as f32);
    Ok(ExportedPolicy {
        shape: state.shape.clone(),
        parameters: state.parameters.clone(),
        observation,
        mean,
        variance,
        action,
        control_step_s,
        task: config.task,
        env: config.env,
        randomisation: config.randomisation,
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
