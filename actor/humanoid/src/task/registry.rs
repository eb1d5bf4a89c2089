//! Tasks by name: the built-in ones, and those that a program defines itself.

use std::sync::Arc;

use super::{HumanoidTask, Task, motion::MotionTask, velocity::VelocityTask};
use crate::config::{ChosenTask, EnvironmentConfig, is_task_name};
use crate::error::ModelError;
use crate::physics::Physics;

/// Longest observation of a task.
const OBSERVATION_MAX: usize = 4096;
/// Most terms of a task's reward, equal to a fragment's limit.
const REWARD_TERMS_MAX: usize = 64;

/// Builds a task for a simulation.
pub type TaskBuilder = fn(&EnvironmentConfig, &Physics) -> Result<Box<dyn Task>, ModelError>;

/// Tasks that a program can simulate: the built-in ones, and its own under the names that [`EnvConfig::own_task`] has.
///
/// [`EnvConfig::own_task`]: crate::config::EnvConfig::own_task
#[derive(Clone, Debug, Default)]
pub struct TaskRegistry {
    own: Arc<[(&'static str, TaskBuilder)]>,
}

impl TaskRegistry {
    /// Returns a registry with tasks of the program.
    ///
    /// # Panics
    /// If a name is not 1 to 64 of the characters a-z, 0-9 and -.
    #[must_use]
    pub fn new(own: &[(&'static str, TaskBuilder)]) -> Self {
        for (name, _) in own {
            assert!(is_task_name(name), "the task name `{name}` is not 1 to 64 of the characters a-z, 0-9 and -");
        }
        Self { own: own.into() }
    }

    /// Returns the names of the program's own tasks.
    #[must_use]
    pub fn own_names(&self) -> Vec<&'static str> {
        self.own.iter().map(|(name, _)| *name).collect()
    }

    /// Builds the task that a configuration selects.
    pub(crate) fn build(&self, config: &EnvironmentConfig, physics: &Physics) -> Result<Box<dyn Task>, ModelError> {
        let name = match config.env.chosen_task() {
            ChosenTask::HumanoidV5 | ChosenTask::HumanoidV4 => return Ok(Box::new(HumanoidTask::new(config, physics))),
            ChosenTask::Velocity => return Ok(Box::new(VelocityTask::new(config, physics)?)),
            ChosenTask::Motion => return Ok(Box::new(MotionTask::new(config, physics)?)),
            ChosenTask::External => {
                return Err(ModelError::Task("other programs simulate the external task".to_owned()));
            }
            ChosenTask::Own(name) => name,
        };
        let Some((_, builder)) = self.own.iter().find(|(known, _)| *known == name) else {
            return Err(ModelError::UnknownTask { name: name.to_owned(), known: self.own_names().join(", ") });
        };
        checked(name, builder(config, physics)?)
    }
}

/// Checks the terms of a program's own task.
fn checked(name: &str, task: Box<dyn Task>) -> Result<Box<dyn Task>, ModelError> {
    let mut end = 0;
    for term in task.terms() {
        if term.range.start != end || term.range.is_empty() {
            return Err(ModelError::Task(format!("the term `{}` of `{name}` does not begin at {end}", term.name)));
        }
        end = term.range.end;
    }
    check_reward_terms(&*task)?;
    match end {
        1..=OBSERVATION_MAX => Ok(task),
        _ => Err(ModelError::Task(format!("`{name}` observes {end} numbers; allowed: 1 to {OBSERVATION_MAX}"))),
    }
}

/// Returns whether a name is 1 to 64 of the characters a-z, 0-9 and _.
fn is_metric_name(name: &str) -> bool {
    let is_allowed = |letter: u8| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == b'_';
    (1..=64).contains(&name.len()) && name.bytes().all(is_allowed)
}

/// Rejects names of the reward's terms that cannot be tags of metrics.
fn check_reward_terms(task: &dyn Task) -> Result<(), ModelError> {
    let mut names: Vec<&str> = Vec::new();
    task.reward_terms(&mut |name, _| names.push(name));
    if names.len() > REWARD_TERMS_MAX {
        return Err(ModelError::Task(format!("the reward has {} terms; allowed: {REWARD_TERMS_MAX}", names.len())));
    }
    for (index, name) in names.iter().enumerate() {
        if !is_metric_name(name) || names[..index].contains(name) {
            return Err(ModelError::Task(format!(
                "the reward's term `{name}` needs a name of its own, of 1 to 64 of the characters a-z, 0-9 and _"
            )));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::randomisation::SensorNoise;
    use crate::task::{ObservationTerm, Step, StepEvaluation};

    /// Task that only names the terms of its reward.
    struct Rewarded(Vec<&'static str>);

    impl Task for Rewarded {
        fn terms(&self) -> &[ObservationTerm] {
            &[]
        }

        fn begin(&mut self, _: u64, _: &Physics) {}

        fn evaluate(&mut self, _: &Step<'_>) -> StepEvaluation {
            StepEvaluation { reward: 0.0, terminated: false, truncated: false }
        }

        fn observe(&mut self, _: &Physics, _: &mut SensorNoise, _: &mut [f32]) {}

        fn reward_terms(&self, each: &mut dyn FnMut(&'static str, f64)) {
            self.0.iter().for_each(|name| each(name, 0.0));
        }
    }

    #[test]
    fn terms_of_the_reward_need_names_of_their_own() {
        check_reward_terms(&Rewarded(vec!["height", "effort_2"])).unwrap();
        check_reward_terms(&Rewarded(Vec::new())).unwrap();
        for (names, named) in [
            (vec!["height", "height"], "`height`"),
            (vec!["height", "Effort"], "`Effort`"),
            (vec!["a/b"], "`a/b`"),
            (vec![""], "``"),
            (vec!["height"; REWARD_TERMS_MAX + 1], "65 terms"),
        ] {
            let refused = check_reward_terms(&Rewarded(names)).unwrap_err().to_string();
            assert!(refused.contains(named), "{refused}");
        }
    }
}
