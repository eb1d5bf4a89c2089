//! Settings and model from keyword arguments. Errors name the keyword, its value and the accepted values.

use std::{error::Error, io, iter::successors, ops::RangeInclusive, path::Path};

use pyo3::{
    exceptions::{PyFileNotFoundError, PyOSError, PyTypeError, PyValueError},
    prelude::*,
    types::{PyBool, PyDict},
};
use treadmill_humanoid::{Environment, HUMANOID_XML, ModelError, ModelFiles, read_model_file};
use treadmill_settings::{ConfigError, EnvConfig, EnvObservation, EnvTask, EnvironmentConfig, KeyDoc, Section};

/// Keys of `[env]` that are no keywords: Gymnasium counts the steps of an episode, and has no tasks and cards of ours.
const NO_KEYWORDS: [&str; 3] = ["max_episode_steps", "own_task", "robot"];

/// Gymnasium's name of its own model file, which stands for the built-in model here.
const BUILT_IN: &str = "humanoid.xml";
/// Accepted `frame_skip`: with Gymnasium's time step, it gives the default control step.
const FRAME_SKIP: u32 = 5;

/// Settings and model of an environment.
pub struct EnvironmentSettings {
    config: EnvironmentConfig,
    /// Control steps after which an episode is truncated; 0 means never.
    max_episode_steps: u32,
    model_xml: String,
    /// Path of the model file; `None` for the built-in model.
    file: Option<String>,
}

impl EnvironmentSettings {
    /// Reads keyword arguments. Episodes are truncated after `max_episode_steps`; 0 means never.
    ///
    /// # Errors
    /// `TypeError` for an unknown keyword, `ValueError` for an invalid value, `OSError` for an unreadable model file.
    pub fn read(keywords: &Bound<'_, PyDict>, max_episode_steps: u32) -> PyResult<Self> {
        let keys = EnvConfig::describe().keys.into_iter().filter(|key| !NO_KEYWORDS.contains(&key.name()));
        let keys: Vec<KeyDoc> = keys.collect();
        let mut env = toml::Table::from_iter([("observation".to_owned(), EnvObservation::GymnasiumV5.name().into())]);
        let mut file = None;
        for (name, value) in keywords.iter() {
            let name: String = name.extract()?;
            let keyword = Keyword { name: &name, value };
            match name.as_str() {
                "frame_skip" => keyword.frame_skip()?,
                "xml_file" => file = keyword.file()?,
                _ => {
                    let key = keys.iter().find(|key| key.name() == name).ok_or_else(|| unknown(&name, &keys))?;
                    env.insert(name.clone(), keyword.setting(key)?);
                }
            }
        }
        let env: EnvConfig = env.try_into().map_err(|why: toml::de::Error| PyValueError::new_err(why.to_string()))?;
        if !matches!(env.task, EnvTask::HumanoidV5 | EnvTask::HumanoidV4) {
            let why = format!("task is '{}', but must be 'humanoid-v5' or 'humanoid-v4'", env.task.name());
            return Err(PyValueError::new_err(why));
        }
        let config = EnvironmentConfig::from(env);
        config.check().map_err(|why| refused_setting(&why))?;
        let model_xml = match &file {
            Some(path) => {
                read_model_file(Path::new(path), &ModelFiles::default()).map_err(|why| refusal(&why, Some(path)))?
            }
            None => HUMANOID_XML.to_owned(),
        };
        Ok(Self { config, max_episode_steps, model_xml, file })
    }

    /// Builds one environment.
    ///
    /// # Errors
    /// `ValueError` for settings or a model that cannot be simulated, or with which every episode would end at once.
    pub fn environment(&self) -> PyResult<Environment> {
        let file = self.file.as_deref();
        let environment = Environment::new(&self.config, &self.model_xml).map_err(|why| refusal(&why, file))?;
        let height_m = environment.nominal_position()[2];
        let [low_m, high_m] = self.config.env.healthy_z_range;
        if self.config.env.terminate_when_unhealthy && !(low_m < height_m && height_m < high_m) {
            return Err(PyValueError::new_err(format!(
                "healthy_z_range is ({low_m}, {high_m}), but the robot starts with its root at {height_m} m, so every \
                 episode would end at once; use healthy_z_range=({:.2}, {:.2}), for example",
                0.7 * height_m,
                1.4 * height_m
            )));
        }
        Ok(environment.with_max_episode_steps(self.max_episode_steps))
    }
}

/// Returns the error about an unknown keyword.
fn unknown(name: &str, keys: &[KeyDoc]) -> PyErr {
    let mut accepted: Vec<&str> = keys.iter().map(KeyDoc::name).chain(["frame_skip", "xml_file"]).collect();
    accepted.sort_unstable();
    let accepted = accepted.join(", ");
    PyTypeError::new_err(format!("unknown keyword argument `{name}`; accepted, besides those of pictures: {accepted}"))
}

/// Returns the error about a setting, by the name of its keyword.
fn refused_setting(why: &ConfigError) -> PyErr {
    PyValueError::new_err(match why {
        ConfigError::Value { key, value, allowed } => {
            let name = key.rsplit('.').next().unwrap_or(key);
            format!("{name} is {value}, but must be {allowed}")
        }
        why => why.to_string(),
    })
}

/// Keyword argument.
pub struct Keyword<'a, 'py> {
    /// Name.
    pub name: &'a str,
    /// Value.
    pub value: Bound<'py, PyAny>,
}

impl Keyword<'_, '_> {
    /// Returns the error about an invalid value.
    pub fn refuse(&self, expected: &str) -> PyErr {
        let value = self.value.repr().map_or_else(|_| "unprintable".to_owned(), |text| text.to_string());
        PyValueError::new_err(format!("{} is {value}, but must be {expected}", self.name))
    }

    /// Returns the value of a setting.
    fn setting(&self, key: &KeyDoc) -> PyResult<toml::Value> {
        let value = as_toml(&self.value).ok_or_else(|| self.refuse(key.notation))?;
        key.convert(&value).map_err(|why| match why {
            ConfigError::Value { .. } => self.refuse(key.allowed),
            _ => self.refuse(&format!("{}; allowed: {}", key.notation, key.allowed)),
        })
    }

    /// Returns a whole number in a range.
    pub fn whole(&self, range: RangeInclusive<u32>) -> PyResult<u32> {
        let number = (!self.value.is_instance_of::<PyBool>()).then(|| self.value.extract().ok()).flatten();
        let (low, high) = (range.start(), range.end());
        number
            .filter(|number| range.contains(number))
            .ok_or_else(|| self.refuse(&format!("a whole number between {low} and {high}")))
    }

    fn frame_skip(&self) -> PyResult<()> {
        match self.whole(1..=1000) {
            Ok(FRAME_SKIP) => Ok(()),
            _ => Err(self.refuse(&format!(
                "{FRAME_SKIP}: `control_step_s` sets the duration of a step, `substeps` its number of physics steps"
            ))),
        }
    }

    /// Returns the path of a model file; `None` for the built-in model.
    fn file(&self) -> PyResult<Option<String>> {
        let path = self.value.py().import("os")?.call_method1("fspath", (&self.value,));
        let path: Option<String> = path.and_then(|path| path.extract()).ok();
        let path = path.ok_or_else(|| self.refuse("the path of an MJCF file"))?;
        Ok((path != BUILT_IN).then_some(path))
    }
}

/// Returns a Python value in TOML; `None` if TOML has no such value.
fn as_toml(value: &Bound<'_, PyAny>) -> Option<toml::Value> {
    if let Ok(flag) = value.extract::<bool>() {
        return Some(flag.into());
    }
    if let Ok(whole) = value.extract::<i64>() {
        return Some(whole.into());
    }
    if let Ok(number) = value.extract::<f64>() {
        return Some(number.into());
    }
    if let Ok(text) = value.extract::<String>() {
        return Some(text.into());
    }
    let items: Vec<Bound<'_, PyAny>> = value.extract().ok()?;
    items.iter().map(as_toml).collect::<Option<_>>().map(toml::Value::Array)
}

/// Returns the Python exception for a model error, with its causes.
// Not `treadmill_runtime::error_chain`: that crate would add tokio to the package.
fn refusal(why: &ModelError, file: Option<&str>) -> PyErr {
    let path = file.map(|path| format!("xml_file `{path}`"));
    let causes = successors(Some(why as &dyn Error), |&cause| cause.source()).map(ToString::to_string);
    let message = path.into_iter().chain(causes).collect::<Vec<_>>().join(": ");
    match why {
        ModelError::File { source, .. } if source.kind() == io::ErrorKind::NotFound => {
            PyFileNotFoundError::new_err(message)
        }
        ModelError::File { .. } => PyOSError::new_err(message),
        ModelError::Setting(why) => refused_setting(why),
        _ => PyValueError::new_err(message),
    }
}
