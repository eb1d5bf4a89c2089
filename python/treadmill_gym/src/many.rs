//! Several humanoids, stepped in one call on several threads.

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyReadwriteArray2};
use pyo3::{
    exceptions::{PyRuntimeError, PyValueError},
    prelude::*,
    types::PyDict,
};
use rayon::{ThreadPool, ThreadPoolBuilder, prelude::*};
use treadmill_humanoid::{Environment, Physics, RewardTask, StepInfo, worlds_per_pass};

use crate::{
    info::{self, FAULT, Moment},
    one::blocks,
    renderer::Followed,
    settings::{EnvironmentSettings, Keyword},
};

/// Most environments; bounds the memory of one process.
const ENVIRONMENTS_MAX: u32 = 65_536;
/// Most threads; a larger number is a typing error.
const THREADS_MAX: u32 = 1024;

/// Several humanoids with the same settings. Arrays are `[N]` or `[N, …]`.
#[pyclass(module = "treadmill_gym._native")]
pub struct Humanoids {
    slots: Vec<Slot>,
    pool: Option<ThreadPool>,
}

/// One environment and all results of its step, so that threads share no data.
struct Slot {
    environment: Environment,
    observation: Vec<f32>,
    followed: Followed,
    result: StepResult,
}

/// Result of an environment's last step.
#[derive(Clone, Copy, Debug, Default)]
struct StepResult {
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
    /// Builds `num_envs` humanoids. `max_episode_steps` 0 means no time limit; `threads` 0 means one per core.
    #[new]
    fn new(
        num_envs: Bound<'_, PyAny>,
        keywords: &Bound<'_, PyDict>,
        max_episode_steps: Bound<'_, PyAny>,
        threads: Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        let count = Keyword { name: "num_envs", value: num_envs }.whole(1..=ENVIRONMENTS_MAX)? as usize;
        let threads = Keyword { name: "threads", value: threads }.whole(0..=THREADS_MAX)? as usize;
        let max_episode_steps = Keyword { name: "max_episode_steps", value: max_episode_steps }.whole(0..=u32::MAX)?;
        let settings = EnvironmentSettings::read(keywords, max_episode_steps)?;
        let slots = (0..count).map(|_| Ok(Slot::new(settings.environment()?))).collect::<PyResult<_>>()?;
        Ok(Self { slots, pool: pool(threads, count)? })
    }

    /// Returns name and size of each block of an observation, in order.
    #[getter]
    fn blocks(&self) -> Vec<(String, usize)> {
        blocks(&self.slots[0].environment)
    }

    /// Returns the smallest and largest control of each motor.
    #[getter]
    fn action_ranges(&self) -> Vec<[f32; 2]> {
        self.slots[0].environment.action_ranges().to_vec()
    }

    /// Returns the duration of a step (s).
    #[getter]
    fn control_step_s(&self) -> f64 {
        self.slots[0].environment.control_step_s()
    }

    /// Returns the number of threads that step the environments.
    #[getter]
    fn threads(&self) -> usize {
        self.pool.as_ref().map_or(1, ThreadPool::current_num_threads)
    }

    /// Starts episodes where `mask` is true, each with its seed. Writes their observations and returns their infos.
    fn reset<'py>(
        &mut self,
        py: Python<'py>,
        mask: PyReadonlyArray1<'py, bool>,
        seeds: PyReadonlyArray1<'py, u64>,
        mut observations: PyReadwriteArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let (mask, seeds) = (mask.as_slice()?, seeds.as_slice()?);
        let count = self.slots.len();
        let rows = observations.as_slice_mut()?;
        check_sizes(&[("mask", mask.len(), count), ("seeds", seeds.len(), count)])?;
        check_sizes(&[("observations", rows.len(), count * self.width())])?;
        let width = self.width();
        let Self { slots, pool } = self;
        py.detach(|| {
            for_each_pass(pool.as_ref(), slots, rows, width, |first, slots, rows| {
                for (index, (slot, row)) in slots.iter_mut().zip(rows.chunks_exact_mut(width)).enumerate() {
                    if mask[first + index] {
                        slot.reset(seeds[first + index], row);
                    }
                }
            });
        });
        let infos = self.slots.iter().zip(mask);
        let infos: Vec<_> = infos.map(|(slot, &is_reset)| is_reset.then(|| (slot.info(), Moment::Reset))).collect();
        info::columns(py, &infos, self.task())
    }

    /// Steps all environments with `actions` `[N, action]`; where `resets` is true, starts the episode of the seed instead.
    /// Returns observations, rewards, terminations, truncations and infos.
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        actions: PyReadonlyArray2<'py, f32>,
        resets: PyReadonlyArray1<'py, bool>,
        seeds: PyReadonlyArray1<'py, u64>,
    ) -> PyResult<Stepped<'py>> {
        let (actions, resets, seeds) = (actions.as_slice()?, resets.as_slice()?, seeds.as_slice()?);
        let (count, width, action_size) = (self.slots.len(), self.width(), self.slots[0].environment.action_size());
        check_sizes(&[("resets", resets.len(), count), ("seeds", seeds.len(), count)])?;
        check_sizes(&[("actions", actions.len(), count * action_size)])?;
        check_finite(actions, resets, action_size)?;
        let observations = PyArray2::zeros(py, [count, width], false);
        let mut writable = observations.readwrite();
        let rows = writable.as_slice_mut()?;
        let Self { slots, pool } = self;
        py.detach(|| {
            for_each_pass(pool.as_ref(), slots, rows, width, |first, slots, rows| {
                let resets = &resets[first..];
                for (index, slot) in slots.iter_mut().enumerate().filter(|(index, _)| !resets[*index]) {
                    slot.environment.begin_step(&actions[(first + index) * action_size..][..action_size]);
                }
                let stepping = slots.iter_mut().zip(resets).filter(|(_, is_reset)| !**is_reset);
                Environment::step_together(&mut stepping.map(|(slot, _)| &mut slot.environment));
                for (index, (slot, row)) in slots.iter_mut().zip(rows.chunks_exact_mut(width)).enumerate() {
                    match resets[index] {
                        true => slot.reset(seeds[first + index], row),
                        false => slot.finish_step(row),
                    }
                }
            });
        });
        drop(writable);
        let moment = |is_reset| if is_reset { Moment::Reset } else { Moment::Step };
        let infos: Vec<_> =
            self.slots.iter().zip(resets).map(|(slot, &reset)| Some((slot.info(), moment(reset)))).collect();
        let infos = info::columns(py, &infos, self.task())?;
        let faults: Vec<bool> = self.slots.iter().map(|slot| slot.result.fault).collect();
        if faults.contains(&true) {
            infos.set_item(FAULT, PyArray1::from_slice(py, &faults))?;
            infos.set_item(format!("_{FAULT}"), PyArray1::from_vec(py, faults))?;
        }
        let results = || self.slots.iter().map(|slot| slot.result);
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
    /// Returns the body of one environment and the point that the camera follows.
    pub fn view(&self, index: usize) -> Option<(&Physics, Followed)> {
        self.slots.get(index).map(|slot| (slot.environment.physics(), slot.followed))
    }

    fn width(&self) -> usize {
        self.slots[0].observation.len()
    }

    fn task(&self) -> RewardTask {
        self.slots[0].environment.config().task
    }
}

impl Slot {
    fn new(environment: Environment) -> Self {
        let observation = vec![0.0; environment.observation_size()];
        Self { environment, observation, followed: Followed::default(), result: StepResult::default() }
    }

    fn info(&self) -> &StepInfo {
        self.environment.info()
    }

    fn reset(&mut self, seed: u64, row: &mut [f64]) {
        self.environment.reset(seed, &mut self.observation);
        self.followed.reset(self.environment.physics());
        self.result = StepResult::default();
        self.copy_observation(row);
    }

    fn finish_step(&mut self, row: &mut [f64]) {
        let step = self.environment.finish_step(&mut self.observation);
        self.followed.update(self.environment.physics(), self.environment.control_step_s());
        let (terminated, truncated, fault) = (step.terminated, step.truncated, step.fault);
        self.result = StepResult { reward: step.reward.into(), terminated, truncated, fault };
        self.copy_observation(row);
    }

    fn copy_observation(&self, row: &mut [f64]) {
        row.iter_mut().zip(&self.observation).for_each(|(slot, &number)| *slot = number.into());
    }
}

/// Starts a pool if there is more than one thread. Rayon's global pool would have no threads in a forked process.
fn pool(threads: usize, count: usize) -> PyResult<Option<ThreadPool>> {
    let cores = || std::thread::available_parallelism().map_or(1, usize::from);
    match if threads == 0 { cores() } else { threads }.min(count) {
        0 | 1 => Ok(None),
        threads => ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(|index| format!("physics-{index}"))
            .build()
            .map(Some)
            .map_err(|why| PyRuntimeError::new_err(format!("cannot start {threads} threads: {why}"))),
    }
}

/// Calls `act` with every few slots that step in one pass, the index of the first, and their rows of the observations.
fn for_each_pass(
    pool: Option<&ThreadPool>,
    slots: &mut [Slot],
    rows: &mut [f64],
    width: usize,
    act: impl Fn(usize, &mut [Slot], &mut [f64]) + Sync,
) {
    let count = worlds_per_pass();
    match pool {
        None => {
            let chunks = slots.chunks_mut(count).zip(rows.chunks_mut(count * width));
            chunks.enumerate().for_each(|(index, (slots, rows))| act(index * count, slots, rows));
        }
        Some(pool) => pool.install(|| {
            let chunks = slots.par_chunks_mut(count).zip(rows.par_chunks_mut(count * width));
            // Several chunks at a time would leave threads idle at the end of each step.
            let chunks = chunks.with_max_len(1).enumerate();
            chunks.for_each(|(index, (slots, rows))| act(index * count, slots, rows));
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

/// Refuses actions that are not finite, except those of environments that are reset.
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
