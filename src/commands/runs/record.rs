//! Results of one run, read from its files.

use std::{
    collections::BTreeMap,
    fs::{self, File},
    path::{Path, PathBuf},
};

use anyhow::Context;
use treadmill_learner::{
    leadership::{Manifest, Status},
    metrics::jsonl::for_each_metric,
};
use treadmill_runtime::{
    run_folder::RunFolder,
    run_lock::{holder, killed},
};

use crate::shared::saved_run;

/// Results of one run.
#[derive(Debug, Default)]
pub(crate) struct Record {
    pub(crate) name: String,
    pub(crate) folder: PathBuf,
    pub(crate) env_steps: u64,
    pub(crate) wall_s: f64,
    /// Greatest mean distance of an evaluation, and the environment steps that its policy had learnt from.
    pub(crate) best_eval_distance_m: Option<f64>,
    pub(crate) best_eval_at: Option<u64>,
    /// Means over the last training episodes.
    pub(crate) training_distance_m: Option<f64>,
    /// Greatest mean distance in training.
    pub(crate) training_best_m: Option<f64>,
    pub(crate) training_return: Option<f64>,
    pub(crate) fall_fraction: Option<f64>,
    /// Mean error of the velocity in the last evaluation of a task with commands (m/s). The least one says little: it
    /// is that of robots that soon fall.
    pub(crate) velocity_error_mps: Option<f64>,
    /// Mean share of a motion that is done in the last evaluation of a motion task, and error of its links (m).
    pub(crate) done_share: Option<f64>,
    pub(crate) body_error_m: Option<f64>,
    /// Whether a process trains it now, and else whether the last one was killed.
    pub(crate) is_running: bool,
    pub(crate) was_killed: bool,
    /// Words that group runs.
    pub(crate) tags: Vec<String>,
    /// Free text about the run.
    pub(crate) description: String,
    /// Values as TOML, by `section.key`.
    pub(crate) config: BTreeMap<String, String>,
}

/// Share of falls above which a run with commands is sorted after the others.
const FALLS_MOSTLY: f64 = 0.5;
/// Stands for a key that a run's configuration does not have.
const ABSENT: &str = "–";

impl Record {
    /// Reads configuration and metrics.
    pub(crate) fn read(folder: &Path) -> anyhow::Result<Self> {
        let name =
            folder.file_name().map_or_else(|| folder.display().to_string(), |name| name.to_string_lossy().into_owned());
        let path = folder.join("config.toml");
        let text = fs::read_to_string(&path).with_context(|| format!("cannot read `{}`", path.display()))?;
        let table: toml::Table =
            text.parse().with_context(|| format!("`{}` is not a configuration", path.display()))?;
        let run = RunFolder::open(&folder.display().to_string()).ok();
        let is_running = run.as_ref().is_some_and(|run| holder(run).is_some());
        let was_killed = run.as_ref().is_some_and(|run| killed(run).is_some());
        let mut record = Self { name, folder: folder.to_path_buf(), is_running, was_killed, ..Self::default() };
        record.set_config(&table);
        let path = folder.join("metrics.jsonl");
        // A run that is just starting has no metrics.
        if let Ok(file) = File::open(&path) {
            for_each_metric(file, |metric, _| {
                record.add(&metric.tag, metric.value);
                Ok(())
            })
            .with_context(|| format!("cannot read `{}`", path.display()))?;
        }
        Ok(record)
    }

    /// Reads the newest state in a store, and the manifest that names it.
    pub(crate) fn of_store(url: &str) -> anyhow::Result<(Self, Manifest)> {
        let (state, manifest) = saved_run::of_store(url)?;
        let means = state.episodes.means();
        let mut record = Self {
            name: state.run.clone(),
            folder: PathBuf::from(url),
            env_steps: state.counters.env_steps,
            wall_s: state.counters.wall_s,
            training_distance_m: means.map(|means| means.distance_mean_m),
            training_best_m: means.map(|means| means.distance_mean_m),
            training_return: means.map(|means| means.return_mean),
            fall_fraction: means.map(|means| means.fall_fraction),
            is_running: manifest.status == Status::Training,
            ..Self::default()
        };
        record.set_config(&state.config_toml.parse().context("the configuration in the store cannot be read")?);
        Ok((record, manifest))
    }

    fn set_config(&mut self, table: &toml::Table) {
        for (section, keys) in table {
            for (key, value) in keys.as_table().into_iter().flatten() {
                self.config.insert(format!("{section}.{key}"), value.to_string());
            }
        }
        let label = |key: &str| table.get("run").and_then(|keys| keys.get(key)).cloned();
        self.tags = label("tags").and_then(|tags| tags.try_into().ok()).unwrap_or_default();
        self.description = label("description").and_then(|text| text.try_into().ok()).unwrap_or_default();
    }

    /// Adds the next metric of the log.
    fn add(&mut self, tag: &str, value: f64) {
        match tag {
            "time/total_timesteps" => self.env_steps = value as u64,
            "time/time_elapsed" => self.wall_s = value,
            "rollout/ep_rew_mean" => self.training_return = Some(value),
            "rollout/distance_mean_m" => self.training_distance_m = Some(value),
            "rollout/distance_best_m" => self.training_best_m = Some(value),
            "rollout/fall_fraction" => self.fall_fraction = Some(value),
            "eval/velocity_error" => self.velocity_error_mps = Some(value),
            "eval/body_error" => self.body_error_m = Some(value),
            "eval/done_share" => self.done_share = Some(value),
            "eval/distance_mean_m" if self.best_eval_distance_m.is_none_or(|best| value > best) => {
                self.best_eval_distance_m = Some(value);
                self.best_eval_at = None;
            }
            // Follows the distance: the policy is older than its result.
            "eval/total_timesteps" if self.best_eval_at.is_none() && self.best_eval_distance_m.is_some() => {
                self.best_eval_at = Some(value as u64);
            }
            _ => {}
        }
    }

    /// Returns the task's name.
    pub(crate) fn task(&self) -> String {
        let text =
            |key: &str| self.config.get(key).map(|value| value.trim_matches('"')).filter(|text| !text.is_empty());
        text("task.name").or(text("env.own_task")).or(text("env.task")).unwrap_or(ABSENT).to_string()
    }

    /// Returns whether the run is running, has all its steps, or was stopped or killed before.
    pub(crate) fn state(&self) -> &'static str {
        let wanted = self.config.get("run.steps").and_then(|steps| steps.parse::<u64>().ok());
        match (self.is_running, wanted) {
            (true, _) => "running",
            (false, Some(wanted)) if self.env_steps >= wanted => "finished",
            (false, _) if self.was_killed => "killed",
            _ => "stopped",
        }
    }

    /// Whether its task has commands.
    pub(crate) fn has_commands(&self) -> bool {
        self.config.get("env.task").is_some_and(|task| task == "\"velocity\"")
    }

    /// Returns numbers by which runs are sorted, the best first: those with commands by their velocity error, and after
    /// them those that mostly fall, whose errors say little; then those that imitate motions by how much of them they do;
    /// then the others by the best known distance.
    pub(crate) fn order(&self) -> (u8, f64) {
        if self.has_commands() {
            let falls = self.fall_fraction.is_some_and(|share| share > FALLS_MOSTLY);
            return (u8::from(falls), self.velocity_error_mps.unwrap_or(f64::INFINITY));
        }
        if let Some(done) = self.done_share {
            return (2, -done);
        }
        (3, -self.best_m().unwrap_or(f64::NEG_INFINITY))
    }

    /// Returns the best distance (m), as the progress of training has it: of an evaluation, or else in training.
    pub(crate) fn best_m(&self) -> Option<f64> {
        self.best_eval_distance_m.or(self.training_best_m)
    }

    /// Returns the mean speed over the whole run.
    pub(crate) fn env_steps_per_s(&self) -> Option<f64> {
        (self.wall_s > 0.0).then(|| self.env_steps as f64 / self.wall_s)
    }

    pub(crate) fn config_value(&self, key: &str) -> &str {
        self.config.get(key).map_or(ABSENT, String::as_str)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn best_evaluation_and_last_value_of_other_metrics_count() {
        let mut record = Record::default();
        for (tag, value) in [
            ("time/total_timesteps", 100.0),
            ("eval/distance_mean_m", 3.0),
            ("eval/total_timesteps", 60.0),
            ("eval/distance_mean_m", 9.5),
            ("eval/total_timesteps", 160.0),
            ("eval/distance_mean_m", 4.0),
            ("eval/total_timesteps", 260.0),
            ("eval/velocity_error", 0.2),
            ("eval/velocity_error", 0.3),
            ("time/total_timesteps", 300.0),
            ("time/time_elapsed", 2.0),
        ] {
            record.add(tag, value);
        }
        assert_eq!((record.env_steps, record.best_eval_distance_m, record.best_eval_at), (300, Some(9.5), Some(160)));
        assert_eq!((record.env_steps_per_s(), record.order()), (Some(150.0), (3, -9.5)));
        record.config.insert("env.task".into(), "\"velocity\"".into());
        assert_eq!(record.order(), (0, 0.3));
        record.add("rollout/fall_fraction", 0.9);
        assert_eq!(record.order(), (1, 0.3), "it falls before it can err");
        assert_eq!((record.training_return, record.config_value("a.b")), (None, ABSENT));
    }
}
