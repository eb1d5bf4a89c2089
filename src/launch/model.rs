//! Model of the robot: built in, or from `--model FILE`.

use std::{
    borrow::Cow,
    path::{Path, PathBuf},
};

use clap::Args;
use treadmill_config::{ChosenTask, Config, ConfigSource, EnvConfig, EnvTask};
use treadmill_humanoid::{
    Environment, HUMANOID_XML, HomePose, Model, ModelError, TaskRegistry,
    card::Proposal,
    mjcf::{self, motions_of, with_motions},
    motion::MotionClip,
    read_model_file,
};
use treadmill_learner::checkpoint::TrainingState;
use treadmill_policy::{NetworkShape, Networks, PolicyMirror};
use treadmill_runtime::{
    error_chain,
    words::{nearest_path, quoted},
};

use crate::{
    launch::exit_code::Usage,
    shared::{model_file::ModelFileArgs, motion_file::MotionArgs},
};

/// Distance of a motion from the range of an action that is worth a warning (rad): gravity takes some of that range, too.
const UNREACHABLE_RAD: f64 = 0.05;

/// Flags about robot and task of commands that play without a run.
#[derive(Args, Clone, Debug, Default)]
pub struct ModelArgs {
    /// MJCF or URDF file, or card, of a robot other than the built-in humanoid; see docs/guide/robots.md.
    #[arg(long, value_name = "FILE")]
    pub model: Option<PathBuf>,
    /// Flags about that file.
    #[command(flatten)]
    pub file: ModelFileArgs,
    /// Motions to imitate, in place of those of the policy.
    #[command(flatten)]
    pub motion: MotionArgs,
    /// Set a key of [env], [velocity], [rewards], [motion], [ground] or [randomisation], as in env.substeps=5; may be
    /// repeated.
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

impl ModelArgs {
    /// Returns `base` with the given keys set.
    pub fn config(&self, base: &Config) -> anyhow::Result<Config> {
        let mut source = ConfigSource::default();
        source.text(&base.to_toml(), "the run's configuration")?;
        for pair in &self.set {
            if !["env.", "velocity.", "rewards.", "motion.", "ground.", "randomisation."]
                .iter()
                .any(|section| pair.trim_start().starts_with(section))
            {
                let why = format!(
                    "`--set {pair}` has no effect here; allowed: keys of [env], [velocity], [rewards], [motion], \
                     [ground] and [randomisation]"
                );
                return Err(Usage(why).into());
            }
            source.set(pair)?;
        }
        Ok(source.build()?)
    }
}

/// Returns the text of a model file, or by default of the built-in humanoid, with the card that `env.robot` names. For the
/// velocity and the motion task a model without a card gets that of the model `like`, if there is one, or else the one that
/// [`Proposal`] finds; for the motion task a model without motions gets those of `like`.
pub fn completed(
    config: &Config,
    file: Option<&Path>,
    files: &ModelFileArgs,
    like: &str,
) -> Result<Cow<'static, str>, Usage> {
    let text = text(file, files)?;
    let completed = with_servos(config, text, file, like)?;
    // A motion belongs to the policy that imitates it, as the card does.
    let motions = motions_of(like).unwrap_or_default();
    if config.env.chosen_task() != ChosenTask::Motion || motions.is_empty() {
        return Ok(completed);
    }
    match motions_of(&completed) {
        Ok(own) if own.is_empty() => {
            Ok(Cow::Owned(with_motions(&completed, &motions).map_err(|why| in_file(file, &why))?))
        }
        _ => Ok(completed),
    }
}

/// Returns a model text with the card that it needs.
fn with_servos<'a>(
    config: &Config,
    text: Cow<'a, str>,
    file: Option<&Path>,
    like: &str,
) -> Result<Cow<'a, str>, Usage> {
    let needs_card = matches!(config.env.chosen_task(), ChosenTask::Velocity | ChosenTask::Motion);
    match (config.env.robot.as_str(), file) {
        ("", _) if needs_card && mjcf::card_of(&text).is_none() => {
            let card = mjcf::card_of(like).map_or_else(|| found_card(config, &text, file), Ok)?;
            let whole = mjcf::with_card(&text, &card).map_err(|why| in_file(file, &why))?;
            Ok(Cow::Owned(whole))
        }
        ("", _) => Ok(text),
        // The cards that come along are of other robots than the built-in humanoid.
        (name, None) => Err(Usage(format!(
            "config key `env.robot` is `{name}`, and the file of that robot is missing; name it: --model FILE \
             (docs/guide/your-robot.md says where it is from)"
        ))),
        (name, _) => {
            Ok(Cow::Owned(mjcf::with_built_in(&text, name).map_err(|why| Usage(format!("env.robot: {why}")))?))
        }
    }
}

/// Returns the card that is found from a model alone.
///
/// # Errors
/// All that cannot be found, and how to give it.
fn found_card(config: &Config, text: &str, file: Option<&Path>) -> Result<String, Usage> {
    let proposed = Model::without_motors(text).and_then(|model| Proposal::of(&model));
    let proposed = proposed.map_err(|why| in_file(file, &why))?;
    let is_motion = config.env.chosen_task() == ChosenTask::Motion;
    let Proposal { card, missing } = if is_motion { proposed.moving_all() } else { proposed };
    if missing.is_empty() {
        return Ok(card);
    }
    let shown = file.unwrap_or(Path::new("FILE")).display().to_string();
    Err(Usage(format!(
        "model file `{shown}`: {}; draft a card by `treadmill robot {} --draft card.toml`, and train with --model card.toml",
        missing.join("; "),
        quoted(&shown)
    )))
}

/// Returns a model text with the motions of flags, which the motion task needs and no other one takes.
pub fn with_given_motions(config: &Config, text: &str, given: &MotionArgs) -> Result<String, Usage> {
    let is_motion = config.env.chosen_task() == ChosenTask::Motion;
    if !is_motion && !given.motion.is_empty() {
        let task = config.task_name();
        return Err(Usage(format!("--motion has no effect on the task `{task}`; add --task motion")));
    }
    let whole = given.add_to(text)?;
    if is_motion && motions_of(&whole).is_ok_and(|motions| motions.is_empty()) {
        return Err(Usage("the motion task needs a motion; give one: --motion FILE (docs/guide/motion.md)".to_owned()));
    }
    Ok(whole)
}

/// Warns of hinges whose motion the policy cannot reach, by the range of its actions around the default pose.
pub fn warn_of_unreachable(environment: &Environment) {
    let model = environment.physics().model();
    for motor in &model.motors {
        let [low, high] = motor.control;
        let angles =
            || model.motions.iter().flat_map(MotionClip::frames).map(|frame| f64::from(frame[7 + motor.hinge]));
        let beyond_rad = angles().map(|angle| (low - angle).max(angle - high)).fold(0.0, f64::max);
        if beyond_rad > UNREACHABLE_RAD {
            let name = &model.hinges[motor.hinge].name;
            tracing::warn!(
                "hinge `{name}` of the motion goes {beyond_rad:.2} rad beyond what actions can ask for, {low:.2} to {high:.2} \
                 rad; raise its `action_scale_rad` in the robot card"
            );
        }
    }
}

/// Refuses flags about a model file where none is given.
pub fn check_flags(file: Option<&Path>, files: &ModelFileArgs) -> Result<(), Usage> {
    match files.given().filter(|_| file.is_none()) {
        Some(flag) => Err(Usage(format!("{flag} has no effect without --model"))),
        None => Ok(()),
    }
}

/// Returns the text of a model file, or by default of the built-in humanoid.
pub fn text(file: Option<&Path>, files: &ModelFileArgs) -> Result<Cow<'static, str>, Usage> {
    check_flags(file, files)?;
    match file {
        None => Ok(Cow::Borrowed(HUMANOID_XML)),
        Some(path) => Ok(Cow::Owned(read_model_file(path, &files.files()).map_err(|why| {
            let near = (!path.exists()).then(|| nearest_path(path)).flatten();
            let hint = near.map(|near| format!("; did you mean `{near}`?")).unwrap_or_default();
            Usage(in_file(Some(path), &why).0 + &hint)
        })?)),
    }
}

/// Returns the text of a model file for a policy that was trained with the model `trained_with`: completed, by the card of
/// that model if it has none, with hinges and motors in its order.
pub fn for_policy(config: &Config, file: &Path, files: &ModelFileArgs, trained_with: &str) -> Result<String, Usage> {
    let text = completed(config, Some(file), files, trained_with)?;
    mjcf::in_order_of(&text, trained_with).map_err(|why| in_file(Some(file), &why))
}

/// Builds the environment of a model text, which was read from `file` if given.
pub fn environment(
    tasks: &TaskRegistry,
    config: &Config,
    text: &str,
    file: Option<&Path>,
) -> Result<Environment, Usage> {
    if config.is_external() {
        return Err(Usage(
            "config key `env.task` is \"external\", which this program does not simulate; allowed here: \"humanoid-v5\", \
             \"humanoid-v4\", \"velocity\" or \"motion\""
                .to_string(),
        ));
    }
    let environment = Environment::with_tasks(&config.environment().without_curricula(), text, tasks)
        .map_err(|why| in_file(file, &why))?;
    if let Some(path) = file {
        check_height(&config.env, environment.nominal_position()[2], path)?;
    }
    Ok(environment)
}

/// Examines the pose in which a robot from `file` starts, and warns of what is unusual.
///
/// # Errors
/// All faults with which a training would learn nothing.
pub fn examine(tasks: &TaskRegistry, config: &Config, text: &str, file: &Path) -> Result<(), Usage> {
    let mut environment = config.environment();
    if config.env.chosen_task() == ChosenTask::Motion {
        // Its episodes begin elsewhere, and what it needs of the default pose is what a walker needs.
        environment.env.task = EnvTask::Velocity;
    }
    let found = HomePose::of(&environment, text, tasks).map_err(|why| in_file(Some(file), &why))?;
    let warn = |list: &[String]| list.iter().for_each(|what| tracing::warn!("{}: {what}", file.display()));
    warn(&found.warnings);
    if matches!(config.env.chosen_task(), ChosenTask::Own(_)) {
        // Its episodes may begin as they want.
        warn(&found.faults);
        return Ok(());
    }
    if found.faults.is_empty() {
        return Ok(());
    }
    Err(Usage(format!("model file `{}`: {}", file.display(), found.faults.join("; "))))
}

/// Returns the motor names, one for each entry of an action; empty without a model.
pub fn action_names(text: &str) -> Vec<String> {
    let model = Model::from_mjcf(text).ok();
    model.map(|model| model.motors.iter().map(|motor| motor.name.clone()).collect()).unwrap_or_default()
}

/// Returns the networks of a new run, which `ppo.symmetry` may make equivariant to the mirror of robot and task.
pub fn networks(config: &Config, environment: &Environment) -> Result<Networks, Usage> {
    let shape = NetworkShape {
        observation: environment.observation_size(),
        action: environment.action_size(),
        hidden: config.policy.hidden.iter().map(|width| *width as usize).collect(),
        privileged: environment.privileged_size(),
    };
    let mirror = || {
        let of_body = treadmill_humanoid::Mirror::of(environment.physics().model())?;
        let observation = environment.task().mirrored(&of_body).ok_or("this task has no mirror image")?;
        Ok(PolicyMirror { observation, action: of_body.action })
    };
    TrainingState::networks(config, shape, mirror).map_err(Usage)
}

/// Checks that `file` is the model of the resumed run.
pub fn check_same(config: &Config, run_text: &str, file: &Path, files: &ModelFileArgs) -> Result<(), Usage> {
    if completed(config, Some(file), files, run_text)? == run_text {
        return Ok(());
    }
    Err(Usage(format!(
        "--model {}: a resumed run keeps its model, and this one differs; leave --model out, or begin a new run",
        file.display()
    )))
}

/// Checks that the robot starts within the healthy range; otherwise every episode would end at once.
fn check_height(env: &EnvConfig, height_m: f64, path: &Path) -> Result<(), Usage> {
    let [low_m, high_m] = env.healthy_z_range;
    if has_other_task(env) || !env.terminate_when_unhealthy || (low_m < height_m && height_m < high_m) {
        return Ok(());
    }
    Err(Usage(format!(
        "model file `{}`: its root starts at a height of {height_m} m, but only {low_m} m to {high_m} m is healthy, so that \
         every episode would end at once; set another range, as in --set 'env.healthy_z_range=[{:.2}, {:.2}]'",
        path.display(),
        0.7 * height_m,
        1.4 * height_m
    )))
}

/// Returns whether the task is none of Gymnasium's.
pub fn has_other_task(env: &EnvConfig) -> bool {
    matches!(env.chosen_task(), ChosenTask::Velocity | ChosenTask::Motion | ChosenTask::Own(_))
}

/// Returns the error of a model that was read from `file` if given.
pub fn in_file(file: Option<&Path>, why: &ModelError) -> Usage {
    let why = error_chain(why);
    match file {
        Some(path) => Usage(format!("model file `{}`: {why}", path.display())),
        None => Usage(why),
    }
}
