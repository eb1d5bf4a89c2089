//! Follows the metrics of a run while its learner writes them.

use std::{
    collections::HashMap,
    fs::File,
    io::{Read, Seek, SeekFrom},
    path::PathBuf,
};

use anyhow::Context;
use treadmill_proto::json::Metric;

/// Tags that every update has. An update is complete once it has them all.
const REQUIRED: [&str; 9] = [
    "time/total_timesteps",
    "time/time_elapsed",
    "time/collect_s",
    "time/update_s",
    "time/checkpoint_s",
    "train/batch",
    "bus/policy_lag_mean",
    "bus/policy_lag_max",
    "actors/alive",
];

/// Scalars of one update.
#[derive(Clone, Debug, Default)]
pub struct LoggedUpdate {
    /// Environment steps of the run so far.
    pub env_steps: u64,
    values: HashMap<String, f64>,
}

impl LoggedUpdate {
    #[cfg(test)]
    pub fn of(env_steps: u64, values: &[(&str, f64)]) -> Self {
        Self { env_steps, values: values.iter().map(|(tag, value)| ((*tag).to_string(), *value)).collect() }
    }

    /// Returns the value of a tag.
    pub fn get(&self, tag: &str) -> Option<f64> {
        self.values.get(tag).copied()
    }

    /// Returns the value of a tag that every update has.
    pub fn value(&self, tag: &str) -> f64 {
        self.get(tag).unwrap_or(0.0)
    }

    fn is_complete(&self) -> bool {
        REQUIRED.iter().all(|tag| self.values.contains_key(*tag))
    }
}

/// Updates of a run, read from `metrics.jsonl`.
pub struct RunMetrics {
    path: PathBuf,
    read: u64,
    /// Beginning of a line that is not complete.
    rest: Vec<u8>,
    updates: Vec<LoggedUpdate>,
}

impl RunMetrics {
    /// Follows a file that may not exist yet.
    pub fn follow(path: PathBuf) -> Self {
        Self { path, read: 0, rest: Vec::new(), updates: Vec::new() }
    }

    /// Reads the lines written since the last call. Returns the complete updates.
    pub fn poll(&mut self) -> anyhow::Result<&[LoggedUpdate]> {
        if let Ok(mut file) = File::open(&self.path) {
            let unreadable = || format!("cannot read `{}`", self.path.display());
            file.seek(SeekFrom::Start(self.read)).with_context(unreadable)?;
            self.read += file.read_to_end(&mut self.rest).with_context(unreadable)? as u64;
            let end = self.rest.iter().rposition(|byte| *byte == b'\n').map_or(0, |last| last + 1);
            let lines: Vec<u8> = self.rest.drain(..end).collect();
            lines
                .split(|byte| *byte == b'\n')
                .filter_map(|line| Metric::from_json(line).ok())
                .for_each(|m| self.add(m));
        }
        let complete = match self.updates.last() {
            Some(last) if !last.is_complete() => self.updates.len() - 1,
            _ => self.updates.len(),
        };
        Ok(&self.updates[..complete])
    }

    fn add(&mut self, metric: Metric) {
        if self.updates.last().is_none_or(|last| last.env_steps != metric.step) {
            self.updates.push(LoggedUpdate { env_steps: metric.step, ..LoggedUpdate::default() });
        }
        if let Some(last) = self.updates.last_mut() {
            last.values.insert(metric.tag, metric.value);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;

    fn lines(step: u64, tags: &[&str]) -> String {
        let line = |tag: &&str| {
            let metric =
                Metric { run: "r".into(), tag: (*tag).to_string(), step, value: step as f64 + 0.5, time_unix_s: 1.0 };
            String::from_utf8(metric.to_json()).unwrap() + "\n"
        };
        tags.iter().map(line).collect()
    }

    #[test]
    fn an_update_appears_once_all_its_lines_are_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("metrics.jsonl");
        let mut metrics = RunMetrics::follow(path.clone());
        assert!(metrics.poll().unwrap().is_empty(), "the file does not exist yet");
        let mut file = File::create(&path).unwrap();
        let (first, second) = (lines(10, &REQUIRED), lines(20, &REQUIRED));
        let (begun, rest) = second.split_at(second.len() - 7);
        write!(file, "{first}{begun}").unwrap();
        assert_eq!(metrics.poll().unwrap().iter().map(|u| u.env_steps).collect::<Vec<_>>(), [10]);
        write!(file, "{rest}{}", lines(20, &["rollout/used_share"])).unwrap();
        let updates = metrics.poll().unwrap();
        assert_eq!(updates.iter().map(|u| u.env_steps).collect::<Vec<_>>(), [10, 20]);
        assert_eq!(updates[1].get("rollout/used_share"), Some(20.5));
        assert_eq!((updates[0].get("rollout/used_share"), updates[0].value("train/batch")), (None, 10.5));
    }
}
