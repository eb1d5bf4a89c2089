//! Several humanoids, stepped in one call on several threads.

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyReadwriteArray2};
use pyo3::{
    exceptions::{PyRuntimeError, PyValueError},
    prelude::*,
    types::PyDict,
};
use rayon::{ThreadPool, ThreadPoolBuilder, prelude::*};
use treadmill_humanoid::{
    EnvTask, Environment, Physics, VectorEnvironment,
    environment::{EnvironmentPass, Slot},
    worlds_per_pass,
};

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
    vector: VectorEnvironment<Seen>,
    pool: Option<ThreadPool>,
}

/// What a caller sees of an environment beside its observation.
#[derive(Clone, Copy, Default)]
struct Seen {
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
        let vector = VectorEnvironment::new(count, || settings.environment(), |_, _| Seen::default())?;
        Ok(Self { vector, pool: pool(threads, count)? })
    }

    /// Returns name and size of each block of an observation, in order.
    #[getter]
    fn blocks(&self) -> Vec<(String, usize)> {
        blocks(&self.first())
    }

    /// Returns the smallest and largest control of each motor.
    #[getter]
    fn action_ranges(&self) -> Vec<[f32; 2]> {
        self.first().action_ranges().to_vec()
    }

    /// Returns the duration of a step (s).
    #[getter]
    fn control_step_s(&self) -> f64 {
        self.first().control_step_s()
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
        let (count, width) = (self.vector.slots().len(), self.vector.observation_size());
        let rows = observations.as_slice_mut()?;
        check_sizes(&[("mask", mask.len(), count), ("seeds", seeds.len(), count)])?;
        check_sizes(&[("observations", rows.len(), count * width)])?;
        py.detach(|| {
            self.for_each_pass(rows, |pass, rows| {
                let first = pass.first;
                pass.step(
                    |_, _| false,
                    |index, slot, observation, _| {
                        if mask[index] {
                            reset(slot, seeds[index], observation);
                            copy(observation, &mut rows[(index - first) * width..]);
                        }
                    },
                );
            });
        });
        let infos = self.vector.slots().iter().zip(mask);
        let infos: Vec<_> = infos
            .map(|(slot, &is_reset)| slot.environment.info().filter(|_| is_reset).map(|info| (info, Moment::Reset)))
            .collect();
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
        let (count, width) = (self.vector.slots().len(), self.vector.observation_size());
        let action_size = self.vector.action_size();
        check_sizes(&[("resets", resets.len(), count), ("seeds", seeds.len(), count)])?;
        check_sizes(&[("actions", actions.len(), count * action_size)])?;
        check_finite(actions, resets, action_size)?;
        let observations = PyArray2::zeros(py, [count, width], false);
        let mut writable = observations.readwrite();
        let rows = writable.as_slice_mut()?;
        py.detach(|| {
            self.for_each_pass(rows, |pass, rows| {
                let first = pass.first;
                pass.step(
                    |index, slot| {
                        if !resets[index] {
                            slot.environment.begin_step(&actions[index * action_size..][..action_size]);
                        }
                        !resets[index]
                    },
                    |index, slot, observation, outcome| {
                        match outcome {
                            None => reset(slot, seeds[index], observation),
                            Some(step) => {
                                let Slot { environment, kept } = slot;
                                kept.followed.update(environment.physics(), environment.control_step_s());
                                let (terminated, truncated, fault) = (step.terminated, step.truncated, step.fault);
                                kept.result = StepResult { reward: step.reward.into(), terminated, truncated, fault };
                            }
                        }
                        copy(observation, &mut rows[(index - first) * width..]);
                    },
                );
            });
        });
        drop(writable);
        let moment = |is_reset| if is_reset { Moment::Reset } else { Moment::Step };
        let slots = self.vector.slots();
        let infos = slots.iter().zip(resets).map(|(slot, &reset)| Some((slot.environment.info()?, moment(reset))));
        let infos: Vec<_> = infos.collect();
        let infos = info::columns(py, &infos, self.task())?;
        let faults: Vec<bool> = slots.iter().map(|slot| slot.kept.result.fault).collect();
        if faults.contains(&true) {
            infos.set_item(FAULT, PyArray1::from_slice(py, &faults))?;
            infos.set_item(format!("_{FAULT}"), PyArray1::from_vec(py, faults))?;
        }
        let results = || slots.iter().map(|slot| slot.kept.result);
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
        self.vector.slots().get(index).map(|slot| (slot.environment.physics(), slot.kept.followed))
    }

    fn first(&self) -> &Environment {
        &self.vector.slots()[0].environment
    }

    fn task(&self) -> EnvTask {
        self.first().config().env.task
    }

    /// Calls `act` with every pass, and its rows of the observations, on all threads.
    fn for_each_pass(&mut self, rows: &mut [f64], act: impl Fn(EnvironmentPass<'_, Seen>, &mut [f64]) + Sync) {
        let width = worlds_per_pass() * self.vector.observation_size();
        let passes = self.vector.passes().zip(rows.chunks_mut(width));
        match &self.pool {
            None => passes.for_each(|(pass, rows)| act(pass, rows)),
            Some(pool) => {
                let passes: Vec<_> = passes.collect();
                // Several passes at a time would leave threads idle at the end of each step.
                pool.install(|| passes.into_par_iter().with_max_len(1).for_each(|(pass, rows)| act(pass, rows)));
            }
        }
    }
}

/// Starts the episode of a seed.
fn reset(Slot { environment, kept }: &mut Slot<Seen>, seed: u64, observation: &mut [f32]) {
    environment.reset(seed, observation);
    kept.followed.reset(environment.physics());
    kept.result = StepResult::default();
}

fn copy(observation: &[f32], row: &mut [f64]) {
    row.iter_mut().zip(observation).for_each(|(place, &number)| *place = number.into());
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
