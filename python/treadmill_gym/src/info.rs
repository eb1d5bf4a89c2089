//! What is told of a step, as Gymnasium tells it: a dictionary, or for several environments one of columns.

use numpy::{PyArray1, PyArray2, ndarray::Array2};
use pyo3::{prelude::*, types::PyDict};
use treadmill_humanoid::{InfoValue, RewardTask, StepInfo};

/// Gymnasium has no name for a step that could not be simulated; the key is there on such steps only.
pub const FAULT: &str = "fault";

/// Which step is told of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moment {
    /// The start of an episode, of which less is known.
    Reset,
    /// A step.
    Step,
}

/// The info of one environment.
pub fn dictionary<'py>(
    py: Python<'py>,
    info: &StepInfo,
    task: RewardTask,
    moment: Moment,
) -> PyResult<Bound<'py, PyDict>> {
    let told = PyDict::new(py);
    for (name, value) in info.entries(task).take(count(info, task, moment)) {
        match value {
            InfoValue::Number(number) => told.set_item(name, number)?,
            InfoValue::Numbers(numbers) => told.set_item(name, PyArray1::from_slice(py, numbers))?,
        }
    }
    Ok(told)
}

/// The infos of several environments: for each name an array with a row per environment, and under `_name` which rows are
/// told; those that are not hold zeros. `None` stands for an environment that nothing is told of.
pub fn columns<'py>(
    py: Python<'py>,
    rows: &[Option<(&StepInfo, Moment)>],
    task: RewardTask,
) -> PyResult<Bound<'py, PyDict>> {
    let told = PyDict::new(py);
    // What names there are, and of how many numbers each, is the same for all.
    let Some((any, _)) = rows.iter().flatten().next() else { return Ok(told) };
    for (index, (name, value)) in any.entries(task).enumerate() {
        let is_told =
            |row: &Option<(&StepInfo, Moment)>| row.is_some_and(|(info, moment)| index < count(info, task, moment));
        let mask: Vec<bool> = rows.iter().map(is_told).collect();
        if !mask.contains(&true) {
            continue;
        }
        let of = |row: usize| rows[row].filter(|_| mask[row]).and_then(|(info, _)| info.entries(task).nth(index));
        match value {
            InfoValue::Number(_) => {
                let number = |row| match of(row) {
                    Some((_, InfoValue::Number(number))) => number,
                    _ => 0.0,
                };
                told.set_item(name, PyArray1::from_iter(py, (0..rows.len()).map(number)))?;
            }
            InfoValue::Numbers(numbers) => {
                let mut all = Array2::zeros((rows.len(), numbers.len()));
                for (row, mut target) in all.outer_iter_mut().enumerate() {
                    if let Some((_, InfoValue::Numbers(numbers))) = of(row) {
                        target.iter_mut().zip(numbers).for_each(|(slot, number)| *slot = *number);
                    }
                }
                told.set_item(name, PyArray2::from_owned_array(py, all))?;
            }
        }
        told.set_item(format!("_{name}"), PyArray1::from_vec(py, mask))?;
    }
    Ok(told)
}

/// How many of the entries of a step are told; those of a reset are the first ones.
fn count(info: &StepInfo, task: RewardTask, moment: Moment) -> usize {
    match moment {
        Moment::Reset => info.reset_entries(task).count(),
        Moment::Step => usize::MAX,
    }
}
