//! Settings and model from keyword arguments. Errors name the keyword, its value and the accepted values.

use std::{error::Error, io, iter::successors, ops::RangeInclusive, path::Path};

use pyo3::{
    exceptions::{PyFileNotFoundError, PyOSError, PyTypeError, PyValueError},
    prelude::*,
    types::{PyBool, PyDict},
};
use treadmill_humanoid::{
    Environment, EnvironmentConfig, HUMANOID_XML, ModelError, ObservationKind, RewardTask, read_model_file,
};

/// All keywords, for the error about an unknown one.
const KEYWORDS: &str = "contact_cost_range, contact_cost_weight, control_step_s, ctrl_cost_weight, \
    exclude_current_positions_from_observation, forward_reward_weight, frame_skip, healthy_reward, healthy_z_range, \
    include_cfrc_ext_in_observation, include_cinert_in_observation, include_cvel_in_observation, \
    include_qfrc_actuator_in_observation, keyframe, observation, reset_noise_scale, self_collision, substeps, \
    task, terminate_when_unhealthy, xml_file";

/// Gymnasium's name of its own model file, which stands for the built-in model here.
const BUILT_IN: &str = "humanoid.xml";
/// Accepted `frame_skip`: with Gymnasium's time step, it gives the default control step.
const FRAME_SKIP: u32 = 5;
/// Accepted `substeps`.
const REPEATS: RangeInclusive<u32> = 1..=1000;

/// Settings and model of an environment.
pub struct EnvironmentSettings {
    config: EnvironmentConfig,
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
        let mut config = EnvironmentConfig {
            observation: ObservationKind::GymnasiumV5,
            max_episode_steps,
            ..EnvironmentConfig::default()
        };
        let mut file = None;
        for (name, value) in keywords.iter() {
            let name: String = name.extract()?;
            let keyword = Keyword { name: &name, value };
            match name.as_str() {
                "task" => config.task = keyword.choice(&TASKS)?,
                "observation" => config.observation = keyword.choice(&OBSERVATIONS)?,
                "forward_reward_weight" => config.forward_reward_weight = keyword.number()?,
                "ctrl_cost_weight" => config.ctrl_cost_weight = keyword.number()?,
                "contact_cost_weight" => config.contact_cost_weight = keyword.number()?,
                "contact_cost_range" => config.contact_cost_range = keyword.range()?,
                "healthy_reward" => config.healthy_reward = keyword.number()?,
                "terminate_when_unhealthy" => config.terminate_when_unhealthy = keyword.flag()?,
                "healthy_z_range" => config.healthy_z_range = keyword.range()?,
                "reset_noise_scale" => config.reset_noise_scale = keyword.number()?,
                "exclude_current_positions_from_observation" => {
                    config.exclude_current_positions_from_observation = keyword.flag()?;
                }
                "include_cinert_in_observation" => config.include_cinert_in_observation = keyword.flag()?,
                "include_cvel_in_observation" => config.include_cvel_in_observation = keyword.flag()?,
                "include_qfrc_actuator_in_observation" => {
                    config.include_qfrc_actuator_in_observation = keyword.flag()?
                }
                "include_cfrc_ext_in_observation" => config.include_cfrc_ext_in_observation = keyword.flag()?,
                "keyframe" => config.keyframe = keyword.text()?,
                "control_step_s" => config.control_step_s = keyword.number()?,
                "substeps" => config.substeps = keyword.whole(REPEATS)?,
                "self_collision" => config.self_collision = keyword.flag()?,
                "frame_skip" => keyword.frame_skip()?,
                "xml_file" => file = keyword.file()?,
                _ => {
                    let why =
                        format!("unknown keyword argument `{name}`; accepted, besides those of pictures: {KEYWORDS}");
                    return Err(PyTypeError::new_err(why));
                }
            }
        }
        let model_xml = match &file {
            Some(path) => read_model_file(Path::new(path)).map_err(|why| refusal(&why, Some(path)))?,
            None => HUMANOID_XML.to_owned(),
        };
        Ok(Self { config, model_xml, file })
    }

    /// Builds one environment.
    ///
    /// # Errors
    /// `ValueError` for settings or a model that cannot be simulated, or with which every episode would end at once.
    pub fn environment(&self) -> PyResult<Environment> {
        let file = self.file.as_deref();
        let environment = Environment::new(&self.config, &self.model_xml).map_err(|why| refusal(&why, file))?;
        let height_m = environment.nominal_position()[2];
        let [low_m, high_m] = self.config.healthy_z_range;
        if self.config.terminate_when_unhealthy && !(low_m < height_m && height_m < high_m) {
            return Err(PyValueError::new_err(format!(
                "healthy_z_range is ({low_m}, {high_m}), but the robot starts with its root at {height_m} m, so every \
                 episode would end at once; use healthy_z_range=({:.2}, {:.2}), for example",
                0.7 * height_m,
                1.4 * height_m
            )));
        }
        Ok(environment)
    }
}

const TASKS: [(&str, RewardTask); 2] =
    [("humanoid-v5", RewardTask::HumanoidV5), ("humanoid-v4", RewardTask::HumanoidV4)];
const OBSERVATIONS: [(&str, ObservationKind); 3] = [
    ("gymnasium-v5", ObservationKind::GymnasiumV5),
    ("gymnasium-v4", ObservationKind::GymnasiumV4),
    ("compact", ObservationKind::Compact),
];

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

    fn number(&self) -> PyResult<f64> {
        let number = (!self.value.is_instance_of::<PyBool>()).then(|| self.value.extract().ok()).flatten();
        number.ok_or_else(|| self.refuse("a number"))
    }

    fn range(&self) -> PyResult<[f64; 2]> {
        self.value.extract().map_err(|_| self.refuse("two numbers, the lower and the upper limit"))
    }

    fn flag(&self) -> PyResult<bool> {
        self.value.extract().map_err(|_| self.refuse("True or False"))
    }

    /// Returns a whole number in a range.
    pub fn whole(&self, range: RangeInclusive<u32>) -> PyResult<u32> {
        let number = (!self.value.is_instance_of::<PyBool>()).then(|| self.value.extract().ok()).flatten();
        let (low, high) = (range.start(), range.end());
        number
            .filter(|number| range.contains(number))
            .ok_or_else(|| self.refuse(&format!("a whole number between {low} and {high}")))
    }

    fn choice<T: Copy>(&self, choices: &[(&str, T)]) -> PyResult<T> {
        let text: Option<String> = self.value.extract().ok();
        choices.iter().find(|(name, _)| text.as_deref() == Some(*name)).map(|(_, choice)| *choice).ok_or_else(|| {
            let names: Vec<_> = choices.iter().map(|(name, _)| format!("'{name}'")).collect();
            self.refuse(&format!("one of {}", names.join(", ")))
        })
    }

    fn frame_skip(&self) -> PyResult<()> {
        match self.whole(REPEATS) {
            Ok(FRAME_SKIP) => Ok(()),
            _ => Err(self.refuse(&format!(
                "{FRAME_SKIP}: `control_step_s` sets the duration of a step, `substeps` its number of physics steps"
            ))),
        }
    }

    fn text(&self) -> PyResult<String> {
        self.value.extract().map_err(|_| self.refuse("a text"))
    }

    /// Returns the path of a model file; `None` for the built-in model.
    fn file(&self) -> PyResult<Option<String>> {
        let path = self.value.py().import("os")?.call_method1("fspath", (&self.value,));
        let path: Option<String> = path.and_then(|path| path.extract()).ok();
        let path = path.ok_or_else(|| self.refuse("the path of an MJCF file"))?;
        Ok((path != BUILT_IN).then_some(path))
    }
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
        _ => PyValueError::new_err(message),
    }
}
