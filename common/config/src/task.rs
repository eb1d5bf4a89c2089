//! External tasks, which other programs simulate.

use treadmill_proto::Task;

use super::{ChosenTask, Config, ConfigError, EnvTask, TaskConfig, refuse, show};

impl TaskConfig {
    pub(super) fn is_unset(&self) -> bool {
        *self == Self::default()
    }

    /// Returns the task if it is known.
    pub fn known(&self) -> Option<Task> {
        (self.observation_size > 0).then(|| Task {
            name: self.name.clone(),
            observation_size: self.observation_size,
            action_size: self.action_size,
            action_low: self.action_low.clone(),
            action_high: self.action_high.clone(),
            control_step_s: self.control_step_s,
            observation_mirror: self.observation_mirror.clone(),
            action_mirror: self.action_mirror.clone(),
        })
    }
}

impl From<Task> for TaskConfig {
    fn from(task: Task) -> Self {
        Self {
            name: task.name,
            observation_size: task.observation_size,
            action_size: task.action_size,
            action_low: task.action_low,
            action_high: task.action_high,
            control_step_s: task.control_step_s,
            observation_mirror: task.observation_mirror,
            action_mirror: task.action_mirror,
        }
    }
}

impl Config {
    /// Returns whether other programs simulate the task.
    pub fn is_external(&self) -> bool {
        self.env.task == EnvTask::External
    }

    /// Returns the name of the task; the built-in tasks begin with `treadmill/`.
    pub fn task_name(&self) -> String {
        match self.env.chosen_task() {
            ChosenTask::External => self.task.name.clone(),
            ChosenTask::Own(name) => name.to_string(),
            _ => format!("treadmill/{}", self.env.task.name()),
        }
    }

    pub(super) fn check_task(&self) -> Result<(), ConfigError> {
        let task = &self.task;
        if !self.is_external() {
            return match task.is_unset() {
                true => Ok(()),
                false => refuse("task.name", show(&task.name), "nothing in [task] where env.task is not \"external\""),
            };
        }
        if !self.env.own_task.is_empty() {
            return refuse("env.own_task", show(&self.env.own_task), "nothing where env.task is \"external\"");
        }
        if self.run.deterministic {
            let why = "false where env.task is \"external\": its actors do not draw from the run's seed";
            return refuse("run.deterministic", "true", why);
        }
        match task.known() {
            Some(known) => known
                .check()
                .or_else(|error| refuse("task", known.name.clone(), format!("a consistent task, but {error}"))),
            None if TaskConfig { name: String::new(), ..task.clone() }.is_unset() => Ok(()),
            None => refuse("task.observation_size", "0", "1 to 4096 where another key of [task] is given"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ConfigSource;

    fn built(pairs: &[&str]) -> Result<Config, String> {
        let mut source = ConfigSource::default();
        pairs.iter().try_for_each(|pair| source.set(pair)).and_then(|()| source.build()).map_err(|why| why.to_string())
    }

    #[test]
    fn a_task_becomes_known_and_survives_toml() {
        let open = built(&["env.task=external", "task.name=gymnasium/Pendulum-v1"]).unwrap();
        assert_eq!((open.task.known(), open.task_name()), (None, "gymnasium/Pendulum-v1".to_string()));
        let task = Task {
            name: "gymnasium/Pendulum-v1".into(),
            observation_size: 3,
            action_size: 1,
            action_low: vec![-2.0],
            action_high: vec![2.0],
            control_step_s: 0.05,
            observation_mirror: vec![1, -2, -3],
            action_mirror: vec![-1],
        };
        let fixed = Config { task: task.clone().into(), ..open };
        fixed.check().unwrap();
        let mut again = ConfigSource::default();
        again.text(&fixed.to_toml(), "saved").unwrap();
        assert_eq!(again.build().unwrap().task.known(), Some(task));
        assert!(!fixed.evaluates() && Config::default().evaluates());
    }

    #[test]
    fn our_own_tasks_omit_the_task_section() {
        let text = Config::default().to_toml();
        assert!(!text.contains("[task]"), "{text}");
        assert_eq!(Config::default().task_name(), "treadmill/humanoid-v5");
        assert!(built(&["task.name=gymnasium/X-v0"]).unwrap_err().contains("`task.name`"));
    }

    #[test]
    fn settings_that_an_external_task_excludes_are_named() {
        let refused = |more: &[&str]| built(&[&["env.task=external"], more].concat()).unwrap_err();
        assert!(refused(&["run.deterministic=true"]).contains("`run.deterministic`"));
        assert!(refused(&["task.action_size=3"]).contains("`task.observation_size`"));
        assert!(refused(&["task.observation_size=3", "task.action_size=1"]).contains("task.name"));
        assert!(refused(&["task.name=treadmill/humanoid-v5"]).contains("`task.name`"));
        assert!(refused(&["task.action_low=[a]"]).contains("`task.action_low`"));
    }
}
