//! Follows the metrics of a run while its learner writes them.

use std::{
    collections::HashMap,
    fs::File,
    io::{BufRead, BufReader},
    path::PathBuf,
};

use anyhow::Context;
use treadmill_proto::json::Metric;

/// Tags that every update has. An update is complete once it has them all.
const REQUIRED: [&str; 8] = [
    "time/time_elapsed",
    "time/update_s",
    "time/publish_s",
    "time/serial_s",
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
    pub values: HashMap<String, f64>,
}

impl LoggedUpdate {
    /// Returns the value of a tag that every update has.
    pub fn value(&self, tag: &str) -> f64 {
        self.values.get(tag).copied().unwrap_or(0.0)
    }
}

/// Updates of a run, read from `metrics.jsonl`.
pub struct RunMetrics {
    path: PathBuf,
    file: Option<BufReader<File>>,
    /// Beginning of a line that is not complete.
    line: Vec<u8>,
    updates: Vec<LoggedUpdate>,
}

impl RunMetrics {
    /// Follows a file that may not exist yet.
    pub fn follow(path: PathBuf) -> Self {
        Self { path, file: None, line: Vec::new(), updates: Vec::new() }
    }

    /// Reads the lines written since the last call. Returns the complete updates.
    pub fn poll(&mut self) -> anyhow::Result<&[LoggedUpdate]> {
        if self.file.is_none() {
            self.file = File::open(&self.path).ok().map(BufReader::new);
        }
        while let Some(file) = &mut self.file
            && file.read_until(b'\n', &mut self.line).context("the learner's metrics cannot be read")? > 0
            && self.line.ends_with(b"\n")
        {
            if let Ok(metric) = Metric::from_json(&std::mem::take(&mut self.line)) {
                self.add(metric);
            }
        }
        let is_complete = |update: &LoggedUpdate| REQUIRED.iter().all(|tag| update.values.contains_key(*tag));
        let newest_is_complete = self.updates.last().is_none_or(is_complete);
        Ok(&self.updates[..self.updates.len() - usize::from(!newest_is_complete)])
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
        assert_eq!((updates[0].value("train/batch"), updates[1].value("rollout/used_share")), (10.5, 20.5));
    }
}
