//! One humanoid, stepped on the caller's thread.

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::{exceptions::PyValueError, prelude::*, types::PyDict};
use treadmill_humanoid::{Environment, Physics};

use crate::{
    info::{self, FAULT, Moment},
    renderer::Followed,
    settings::EnvironmentSettings,
};

/// Name and size of each block of an observation.
type Blocks = Vec<(String, usize)>;
type Observed<'py> = Bound<'py, PyArray1<f64>>;

/// One humanoid without a time limit.
#[pyclass(module = "treadmill_gym._native")]
pub struct Humanoid {
    environment: Environment,
    observation: Vec<f32>,
    followed: Followed,
}

#[pymethods]
impl Humanoid {
    #[new]
    fn new(keywords: &Bound<'_, PyDict>) -> PyResult<Self> {
        let environment = EnvironmentSettings::read(keywords, 0)?.environment()?;
        Ok(Self { observation: vec![0.0; environment.observation_size()], followed: Followed::default(), environment })
    }

    /// Returns name and size of each block of an observation, in order.
    #[getter]
    fn blocks(&self) -> Blocks {
        blocks(&self.environment)
    }

    /// Returns the smallest and largest control of each motor.
    #[getter]
    fn action_ranges(&self) -> Vec<[f32; 2]> {
        self.environment.action_ranges().to_vec()
    }

    /// Returns the duration of a step (s).
    #[getter]
    fn control_step_s(&self) -> f64 {
        self.environment.control_step_s()
    }

    /// Starts the episode of a seed. Returns observation and info.
    fn reset<'py>(&mut self, py: Python<'py>, seed: u64) -> PyResult<(Observed<'py>, Bound<'py, PyDict>)> {
        let Self { environment, observation, .. } = self;
        py.detach(|| environment.reset(seed, observation));
        self.followed.reset(self.environment.physics());
        Ok((self.observed(py), self.info(py, Moment::Reset)?))
    }

    /// Does a control step. Returns observation, reward, whether the episode terminated, and info.
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        action: PyReadonlyArray1<'py, f32>,
    ) -> PyResult<(Observed<'py>, f64, bool, Bound<'py, PyDict>)> {
        let action = action.as_slice()?;
        let Self { environment, observation, .. } = self;
        let step = py.detach(|| environment.try_step(action, observation));
        let step = step.map_err(|why| PyValueError::new_err(why.to_string()))?;
        self.followed.update(self.environment.physics(), self.environment.control_step_s());
        let info = self.info(py, Moment::Step)?;
        if step.fault {
            info.set_item(FAULT, true)?;
        }
        Ok((self.observed(py), step.reward.into(), step.terminated, info))
    }
}

impl Humanoid {
    /// Returns the body.
    pub fn physics(&self) -> &Physics {
        self.environment.physics()
    }

    /// Returns the point that the camera follows.
    pub fn followed(&self) -> Followed {
        self.followed
    }

    fn observed<'py>(&self, py: Python<'py>) -> Observed<'py> {
        PyArray1::from_iter(py, self.observation.iter().map(|&number| f64::from(number)))
    }

    fn info<'py>(&self, py: Python<'py>, moment: Moment) -> PyResult<Bound<'py, PyDict>> {
        let info = self.environment.info().copied().unwrap_or_default();
        info::dictionary(py, &info, self.environment.config().env.task, moment)
    }
}

/// Returns name and size of each block of an observation, in order.
pub fn blocks(environment: &Environment) -> Blocks {
    environment.terms().iter().map(|term| (term.name.clone(), term.range.len())).collect()
}
