//! Tasks that a program defines itself, by name.

use std::sync::OnceLock;

use super::{HumanoidTask, Task, velocity::VelocityTask};
use crate::config::EnvironmentConfig;
use crate::error::ModelError;
use crate::physics::Physics;

/// Longest observation of a task.
const OBSERVATION_MAX: usize = 4096;
/// Most terms of a task's reward, equal to a fragment's limit.
const REWARD_TERMS_MAX: usize = 64;

/// Builds a task for a simulation.
pub type TaskBuilder = fn(&EnvironmentConfig, &Physics) -> Result<Box<dyn Task>, ModelError>;

/// Tasks of this program, under the names that [`EnvironmentConfig::own_task`] has.
static OWN_TASKS: OnceLock<Vec<(&'static str, TaskBuilder)>> = OnceLock::new();

/// Registers the tasks of this program for all its environments. The program calls it once, before the first environment.
///
/// # Panics
/// If it is called twice, or a name is not 1 to 64 of the characters a-z, 0-9 and -.
pub fn register_own_tasks(tasks: &[(&'static str, TaskBuilder)]) {
    for (name, _) in tasks {
        assert!(is_name(name, b'-'), "the task name `{name}` is not 1 to 64 of the characters a-z, 0-9 and -");
    }
    assert!(OWN_TASKS.set(tasks.to_vec()).is_ok(), "the program registers its tasks twice");
}

/// Returns whether a name is 1 to 64 of the characters a-z, 0-9 and `separator`.
fn is_name(name: &str, separator: u8) -> bool {
    let is_allowed = |letter: u8| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == separator;
    (1..=64).contains(&name.len()) && name.bytes().all(is_allowed)
}

/// Returns the names of this program's own tasks.
pub fn own_tasks() -> Vec<&'static str> {
    OWN_TASKS.get().into_iter().flatten().map(|(name, _)| *name).collect()
}

/// Builds the task that a configuration selects.
pub(crate) fn build(config: &EnvironmentConfig, physics: &Physics) -> Result<Box<dyn Task>, ModelError> {
    let name = config.own_task.as_str();
    if name.is_empty() {
        return Ok(match &config.velocity {
            None => Box::new(HumanoidTask::new(config, physics)),
            Some(velocity) => Box::new(VelocityTask::new(velocity, config, physics)?),
        });
    }
    let Some((_, builder)) = OWN_TASKS.get().into_iter().flatten().find(|(known, _)| *known == name) else {
        return Err(ModelError::UnknownTask { name: name.to_owned(), known: own_tasks().join(", ") });
    };
    let task = builder(config, physics)?;
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

/// Rejects names of the reward's terms that cannot be tags of metrics.
fn check_reward_terms(task: &dyn Task) -> Result<(), ModelError> {
    let mut names: Vec<&str> = Vec::new();
    task.reward_terms(&mut |name, _| names.push(name));
    if names.len() > REWARD_TERMS_MAX {
        return Err(ModelError::Task(format!("the reward has {} terms; allowed: {REWARD_TERMS_MAX}", names.len())));
    }
    for (index, name) in names.iter().enumerate() {
        if !is_name(name, b'_') || names[..index].contains(name) {
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
    use crate::info::StepInfo;
    use crate::randomisation::SensorNoise;
    use crate::task::{ObservationTerm, Step, StepEvaluation};

    /// Task that only names the terms of its reward.
    struct Rewarded(Vec<&'static str>);

    impl Task for Rewarded {
        fn terms(&self) -> &[ObservationTerm] {
            &[]
        }

        fn begin(&mut self, _: u64, _: &Physics) -> StepInfo {
            StepInfo::default()
        }

        fn evaluate(&mut self, _: &Step<'_>) -> StepEvaluation {
            StepEvaluation { reward: 0.0, terminated: false, truncated: false, info: StepInfo::default() }
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
