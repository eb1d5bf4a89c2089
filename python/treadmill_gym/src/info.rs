//! Gymnasium's infos of a step: a dictionary, with columns for several environments.

use numpy::{PyArray1, PyArray2, ndarray::Array2};
use pyo3::{prelude::*, types::PyDict};
use treadmill_humanoid::{EnvTask, InfoValue, StepInfo};

/// Key of a step that could not be simulated; present on such steps only, and not one of Gymnasium's.
pub const FAULT: &str = "fault";

/// Kind of step that an info describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moment {
    /// Start of an episode, which has fewer entries.
    Reset,
    /// Control step.
    Step,
}

/// Returns the info of one environment.
pub fn dictionary<'py>(
    py: Python<'py>,
    info: &StepInfo,
    task: EnvTask,
    moment: Moment,
) -> PyResult<Bound<'py, PyDict>> {
    let dictionary = PyDict::new(py);
    for (name, value) in info.entries(task).take(count(info, task, moment)) {
        match value {
            InfoValue::Number(number) => dictionary.set_item(name, number)?,
            InfoValue::Numbers(numbers) => dictionary.set_item(name, PyArray1::from_slice(py, numbers))?,
        }
    }
    Ok(dictionary)
}

/// Returns the infos of several environments: for each name an array with a row per environment, and under `_name` a mask of
/// the rows that have the entry. Other rows are zero. `None` is an environment without info.
pub fn columns<'py>(
    py: Python<'py>,
    rows: &[Option<(&StepInfo, Moment)>],
    task: EnvTask,
) -> PyResult<Bound<'py, PyDict>> {
    let columns = PyDict::new(py);
    // Names and sizes are the same for all environments.
    let Some((any, _)) = rows.iter().flatten().next() else { return Ok(columns) };
    for (index, (name, value)) in any.entries(task).enumerate() {
        let has_entry =
            |row: &Option<(&StepInfo, Moment)>| row.is_some_and(|(info, moment)| index < count(info, task, moment));
        let mask: Vec<bool> = rows.iter().map(has_entry).collect();
        if !mask.contains(&true) {
            continue;
        }
        let entry = |row: usize| rows[row].filter(|_| mask[row]).and_then(|(info, _)| info.entries(task).nth(index));
        match value {
            InfoValue::Number(_) => {
                let number = |row| match entry(row) {
                    Some((_, InfoValue::Number(number))) => number,
                    _ => 0.0,
                };
                columns.set_item(name, PyArray1::from_iter(py, (0..rows.len()).map(number)))?;
            }
            InfoValue::Numbers(numbers) => {
                let mut all = Array2::zeros((rows.len(), numbers.len()));
                for (row, mut target) in all.outer_iter_mut().enumerate() {
                    if let Some((_, InfoValue::Numbers(numbers))) = entry(row) {
                        target.iter_mut().zip(numbers).for_each(|(slot, number)| *slot = *number);
                    }
                }
                columns.set_item(name, PyArray2::from_owned_array(py, all))?;
            }
        }
        columns.set_item(format!("_{name}"), PyArray1::from_vec(py, mask))?;
    }
    Ok(columns)
}

/// Returns the number of entries of an info; a reset has the first ones of a step.
fn count(info: &StepInfo, task: EnvTask, moment: Moment) -> usize {
    match moment {
        Moment::Reset => info.reset_entries(task).count(),
        Moment::Step => usize::MAX,
    }
}
