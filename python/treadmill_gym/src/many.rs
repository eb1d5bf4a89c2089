//! Several humanoids, stepped in one call and on several threads.

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyReadwriteArray2};
use pyo3::{
    exceptions::{PyRuntimeError, PyValueError},
    prelude::*,
    types::PyDict,
};
use rayon::{ThreadPool, ThreadPoolBuilder, prelude::*};
use treadmill_humanoid::{Environment, Physics, StepInfo};

use crate::{
    info::{self, FAULT, Moment},
    one::blocks,
    renderer::Followed,
    settings::{EnvironmentSettings, Given},
};

/// More than this does not fit into the memory of any machine that one process should fill.
const ENVIRONMENTS_MAX: u32 = 65_536;
/// More threads than this are a slip of the pen.
const THREADS_MAX: u32 = 1024;

/// Several humanoids of the same settings. Arrays are `[N]` or `[N, …]`.
#[pyclass(module = "treadmill_gym._native")]
pub struct Humanoids {
    places: Vec<Place>,
    pool: Option<ThreadPool>,
}

/// One environment with all that its step writes, so that threads have nothing in common.
struct Place {
    environment: Environment,
    observation: Vec<f32>,
    followed: Followed,
    result: Outcome,
}

/// What the last step of an environment gave.
#[derive(Clone, Copy, Debug, Default)]
struct Outcome {
    reward: f64,
    terminated: bool,
    truncated: bool,
    fault: bool,
}

type Stepped<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyDict>,
);

#[pymethods]
impl Humanoids {
    /// `max_episode_steps` 0 means no time limit, `threads` 0 one per core.
    #[new]
    fn new(
        num_envs: Bound<'_, PyAny>,
        keywords: &Bound<'_, PyDict>,
        max_episode_steps: Bound<'_, PyAny>,
        threads: Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        let count = Given { name: "num_envs", value: num_envs }.whole(1..=ENVIRONMENTS_MAX)? as usize;
        let threads = Given { name: "threads", value: threads }.whole(0..=THREADS_MAX)? as usize;
        let max_episode_steps = Given { name: "max_episode_steps", value: max_episode_steps }.whole(0..=u32::MAX)?;
        let settings = EnvironmentSettings::read(keywords, max_episode_steps)?;
        let places = (0..count).map(|_| Ok(Place::new(settings.environment()?))).collect::<PyResult<_>>()?;
        Ok(Self { places, pool: pool(threads, count)? })
    }

    /// Name and size of each block of an observation, in order.
    #[getter]
    fn blocks(&self) -> Vec<(&'static str, usize)> {
        blocks(&self.places[0].environment)
    }

    /// Least and greatest control of each motor.
    #[getter]
    fn action_ranges(&self) -> Vec<[f32; 2]> {
        self.places[0].environment.action_ranges().to_vec()
    }

    /// Duration of a step (s).
    #[getter]
    fn control_step_s(&self) -> f64 {
        self.places[0].environment.control_step_s()
    }

    /// Threads that step the environments.
    #[getter]
    fn threads(&self) -> usize {
        self.pool.as_ref().map_or(1, ThreadPool::current_num_threads)
    }

    /// Starts those episodes that `mask` says, each with its seed; writes their observations into `observations`, and
    /// returns their infos.
    fn reset<'py>(
        &mut self,
        py: Python<'py>,
        mask: PyReadonlyArray1<'py, bool>,
        seeds: PyReadonlyArray1<'py, u64>,
        mut observations: PyReadwriteArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let (mask, seeds) = (mask.as_slice()?, seeds.as_slice()?);
        let count = self.places.len();
        let rows = observations.as_slice_mut()?;
        check_sizes(&[("mask", mask.len(), count), ("seeds", seeds.len(), count)])?;
        check_sizes(&[("observations", rows.len(), count * self.width())])?;
        let width = self.width();
        let Self { places, pool } = self;
        py.detach(|| {
            each(pool.as_ref(), places, rows, width, |index, place, row| {
                if mask[index] {
                    place.reset(seeds[index], row);
                }
            });
        });
        let told = self.places.iter().zip(mask);
        let told: Vec<_> = told.map(|(place, &is_reset)| is_reset.then(|| (place.info(), Moment::Reset))).collect();
        info::columns(py, &told, self.task())
    }

    /// One control step of each, `actions` `[N, action]`; those that `resets` says start the episode of their seed in its place.
    /// Returns observations, rewards, which are terminated, which are truncated, and infos.
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        actions: PyReadonlyArray2<'py, f32>,
        resets: PyReadonlyArray1<'py, bool>,
        seeds: PyReadonlyArray1<'py, u64>,
    ) -> PyResult<Stepped<'py>> {
        let (actions, resets, seeds) = (actions.as_slice()?, resets.as_slice()?, seeds.as_slice()?);
        let (count, width, action_size) = (self.places.len(), self.width(), self.places[0].environment.action_size());
        check_sizes(&[("resets", resets.len(), count), ("seeds", seeds.len(), count)])?;
        check_sizes(&[("actions", actions.len(), count * action_size)])?;
        check_finite(actions, resets, action_size)?;
        let observations = PyArray2::zeros(py, [count, width], false);
        let mut writable = observations.readwrite();
        let rows = writable.as_slice_mut()?;
        let Self { places, pool } = self;
        py.detach(|| {
            each(pool.as_ref(), places, rows, width, |index, place, row| match resets[index] {
                true => place.reset(seeds[index], row),
                false => place.step(&actions[index * action_size..(index + 1) * action_size], row),
            });
        });
        drop(writable);
        let moment = |is_reset| if is_reset { Moment::Reset } else { Moment::Step };
        let told: Vec<_> =
            self.places.iter().zip(resets).map(|(place, &reset)| Some((place.info(), moment(reset)))).collect();
        let infos = info::columns(py, &told, self.task())?;
        let faults: Vec<bool> = self.places.iter().map(|place| place.result.fault).collect();
        if faults.contains(&true) {
            infos.set_item(FAULT, PyArray1::from_slice(py, &faults))?;
            infos.set_item(format!("_{FAULT}"), PyArray1::from_vec(py, faults))?;
        }
        let results = || self.places.iter().map(|place| place.result);
        Ok((
            observations,
            PyArray1::from_iter(py, results().map(|result| result.reward)),
            PyArray1::from_iter(py, results().map(|result| result.terminated)),
            PyArray1::from_iter(py, results().map(|result| result.truncated)),
            infos,
        ))
    }
}

impl Humanoids {
    /// A body, to be looked at, and where the camera looks.
    pub fn seen(&self, index: usize) -> Option<(&Physics, Followed)> {
        self.places.get(index).map(|place| (place.environment.physics(), place.followed))
    }

    fn width(&self) -> usize {
        self.places[0].observation.len()
    }

    fn task(&self) -> treadmill_humanoid::RewardTask {
        self.places[0].environment.config().task
    }
}

impl Place {
    fn new(environment: Environment) -> Self {
        let observation = vec![0.0; environment.observation_size()];
        Self { environment, observation, followed: Followed::default(), result: Outcome::default() }
    }

    fn info(&self) -> &StepInfo {
        self.environment.info()
    }

    fn reset(&mut self, seed: u64, row: &mut [f64]) {
        self.environment.reset(seed, &mut self.observation);
        self.followed.jump(self.environment.physics());
        self.result = Outcome::default();
        self.tell(row);
    }

    fn step(&mut self, action: &[f32], row: &mut [f64]) {
        let step = self.environment.step(action, &mut self.observation);
        self.followed.walk(self.environment.physics());
        let (terminated, truncated, fault) = (step.terminated, step.truncated, step.fault);
        self.result = Outcome { reward: step.reward.into(), terminated, truncated, fault };
        self.tell(row);
    }

    fn tell(&self, row: &mut [f64]) {
        row.iter_mut().zip(&self.observation).for_each(|(slot, &number)| *slot = number.into());
    }
}

/// Threads of their own where more than one is asked for: those that all share would be missing in a forked process.
fn pool(threads: usize, count: usize) -> PyResult<Option<ThreadPool>> {
    let cores = || std::thread::available_parallelism().map_or(1, usize::from);
    match if threads == 0 { cores() } else { threads }.min(count) {
        0 | 1 => Ok(None),
        threads => ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|index| format!("physics-{index}"))
            .build()
            .map(Some)
            .map_err(|why| PyRuntimeError::new_err(format!("{threads} threads cannot be started: {why}"))),
    }
}

/// Calls `act` for each environment with its row of the observations.
fn each(
    pool: Option<&ThreadPool>,
    places: &mut [Place],
    rows: &mut [f64],
    width: usize,
    act: impl Fn(usize, &mut Place, &mut [f64]) + Sync,
) {
    match pool {
        None => {
            let both = places.iter_mut().zip(rows.chunks_exact_mut(width));
            both.enumerate().for_each(|(index, (place, row))| act(index, place, row));
        }
        Some(pool) => pool.install(|| {
            let both = places.par_iter_mut().zip(rows.par_chunks_exact_mut(width)).enumerate();
            // Large pieces would leave threads idle at the end of each step: steps take unlike times.
            both.with_max_len(1).for_each(|(index, (place, row))| act(index, place, row));
        }),
    }
}

fn check_sizes(sizes: &[(&str, usize, usize)]) -> PyResult<()> {
    match sizes.iter().find(|(_, found, expected)| found != expected) {
        Some((name, found, expected)) => {
            Err(PyValueError::new_err(format!("{name} has {found} entries, but must have {expected}")))
        }
        None => Ok(()),
    }
}

/// Refuses actions that are no numbers, before anything has moved; those of environments that are reset are not looked at.
fn check_finite(actions: &[f32], resets: &[bool], action_size: usize) -> PyResult<()> {
    let is_bad = |(at, action): &(usize, &f32)| !action.is_finite() && !resets[at / action_size];
    match actions.iter().enumerate().find(is_bad) {
        Some((at, action)) => {
            let (env, entry) = (at / action_size, at % action_size);
            let why = format!("actions[{env}][{entry}] is {action}, but every entry must be a finite number");
            Err(PyValueError::new_err(why))
        }
        None => Ok(()),
    }
}
