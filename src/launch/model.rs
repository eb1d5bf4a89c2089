//! Model of the robot: built in, or from `--model FILE`.

use std::{
    borrow::Cow,
    path::{Path, PathBuf},
};

use clap::Args;
use treadmill_actor::settings;
use treadmill_config::{Config, ConfigSource, EnvConfig, EnvObservation, Symmetry};
use treadmill_humanoid::{Environment, HUMANOID_XML, Model, ModelError, read_model_file};
use treadmill_ppo::{BatchMirror, IndexSwap};

use crate::launch::exit_code::{self, Usage};

/// Flags about robot and task of commands that play without a run.
#[derive(Args, Clone, Debug, Default)]
pub struct ModelArgs {
    /// Another robot than the built-in humanoid, as MJCF; see docs/guide/robots.md.
    #[arg(long, value_name = "FILE")]
    pub model: Option<PathBuf>,
    /// One key of [env] or [randomisation], as in env.substeps=5; may be repeated.
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

impl ModelArgs {
    /// A configuration with the given keys laid over it.
    pub fn config(&self, base: &Config) -> anyhow::Result<Config> {
        let mut source = ConfigSource::default();
        source.text(&base.to_toml(), "the run's configuration")?;
        for pair in &self.set {
            if !["env.", "randomisation."].iter().any(|section| pair.trim_start().starts_with(section)) {
                let why = format!("`--set {pair}` has no effect here; allowed: keys of [env] and [randomisation]");
                return Err(Usage(why).into());
            }
            source.set(pair)?;
        }
        Ok(source.build()?)
    }
}

/// The text of a model file, or of the built-in humanoid where there is none.
pub fn text(file: Option<&Path>) -> Result<Cow<'static, str>, Usage> {
    match file {
        None => Ok(Cow::Borrowed(HUMANOID_XML)),
        Some(path) => Ok(Cow::Owned(read_model_file(path).map_err(|why| blame(Some(path), &why))?)),
    }
}

/// An environment with a model's text, which came from `file` if there is one.
pub fn environment(config: &Config, text: &str, file: Option<&Path>) -> Result<Environment, Usage> {
    if config.is_external() {
        return Err(Usage(
            "config key `env.task` is \"external\", which has no environment here; allowed here: \
                          \"humanoid-v5\" or \"humanoid-v4\""
                .to_string(),
        ));
    }
    let environment = Environment::new(&settings::training(config), text).map_err(|why| blame(file, &why))?;
    if let Some(path) = file {
        check_height(&config.env, environment.physics().model().nominal_position()[2], path)?;
    }
    Ok(environment)
}

/// What the entries of an action are called; nothing where no model says.
pub fn action_names(text: &str) -> Vec<String> {
    let model = Model::from_mjcf(text).ok();
    model.map(|model| model.motors.iter().map(|motor| motor.name.clone()).collect()).unwrap_or_default()
}

/// The mirror that `ppo.symmetry` asks for.
pub fn mirror(config: &Config, text: &str) -> Result<Option<BatchMirror>, Usage> {
    if config.ppo.symmetry == Symmetry::Off {
        return Ok(None);
    }
    let refuse = |why: String| Usage(format!("`ppo.symmetry` is \"mirrored\", but {why}; allowed here: \"off\""));
    if config.env.observation != EnvObservation::Compact {
        return Err(refuse("only the observation \"compact\" has a mirror image".to_string()));
    }
    let environment = environment(config, text, None)?;
    let of_body = treadmill_humanoid::Mirror::of(environment.physics().model()).map_err(refuse)?;
    let observation = IndexSwap(of_body.observation(environment.observation_size()));
    Ok(Some(BatchMirror { observation, action: IndexSwap(of_body.action) }))
}

/// Refuses another model than the one that a run was begun with.
pub fn check_same(run_text: &str, file: &Path) -> Result<(), Usage> {
    if text(Some(file))? == run_text {
        return Ok(());
    }
    Err(Usage(format!(
        "--model {}: the run goes on with the model that it was begun with, and this is another one; leave --model out, \
         or begin a new run with it",
        file.display()
    )))
}

/// A robot that starts outside the healthy range would end every episode at once.
fn check_height(env: &EnvConfig, height_m: f64, path: &Path) -> Result<(), Usage> {
    let [low_m, high_m] = env.healthy_z_range;
    if !env.terminate_when_unhealthy || (low_m < height_m && height_m < high_m) {
        return Ok(());
    }
    Err(Usage(format!(
        "model file `{}`: its root starts at a height of {height_m} m, but only {low_m} m to {high_m} m is healthy, so that \
         every episode would end at once; say what is, as in --set 'env.healthy_z_range=[{:.2}, {:.2}]'",
        path.display(),
        0.7 * height_m,
        1.4 * height_m
    )))
}

fn blame(file: Option<&Path>, why: &ModelError) -> Usage {
    let told = exit_code::chain(anyhow::Chain::new(why));
    match file {
        Some(path) => Usage(format!("model file `{}`: {told}", path.display())),
        None => Usage(told),
    }
}
