//! Log of a run that is read while the run writes it.

use std::{
    fs::File,
    io::{self, Read, Seek, SeekFrom},
    os::unix::fs::MetadataExt,
    path::{Path, PathBuf},
};

use treadmill_proto::json::Metric;

use super::goal::Goal;

/// What pruners compare of one run.
#[derive(Debug, Default)]
pub(crate) struct FollowedLog {
    path: PathBuf,
    /// File that was read so far, and how many of its bytes.
    inode: u64,
    bytes: u64,
    /// Environment steps so far.
    pub(crate) step: u64,
    values: Vec<(u64, f64)>,
}

impl FollowedLog {
    /// Follows the log of a run, which may not have begun.
    pub(crate) fn of(run: &Path) -> Self {
        Self { path: run.join("metrics.jsonl"), ..Self::default() }
    }

    /// Reads the lines that were completed since the last call.
    ///
    /// # Errors
    /// If the file is there and cannot be read.
    pub(crate) fn read(&mut self, goal: &Goal) -> io::Result<()> {
        let mut file = match File::open(&self.path) {
            Err(why) if why.kind() == io::ErrorKind::NotFound => return Ok(()),
            opened => opened?,
        };
        let found = file.metadata()?;
        // A run that goes on replaces its log by one without the steps that it repeats.
        if found.ino() != self.inode || found.len() < self.bytes {
            *self = Self { path: std::mem::take(&mut self.path), inode: found.ino(), ..Self::default() };
        }
        file.seek(SeekFrom::Start(self.bytes))?;
        let mut text = Vec::new();
        file.read_to_end(&mut text)?;
        let complete = text.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
        self.bytes += complete as u64;
        // A crash may have cut a line; the run removes it when it goes on.
        let metrics =
            text[..complete].split(|byte| *byte == b'\n').filter_map(|line| serde_json::from_slice(line).ok());
        for Metric { tag, step, value, .. } in metrics {
            if tag == "time/time_elapsed" {
                self.step = step;
            }
            if tag == goal.tag {
                self.values.push((step, goal.compared(value)));
            }
        }
        Ok(())
    }

    /// Returns what is compared at these environment steps; nothing before the first value.
    pub(crate) fn at(&self, step: u64) -> Option<f64> {
        self.values.iter().rev().find(|(at, _)| *at <= step).map(|(_, value)| *value)
    }

    /// Returns whether a metric that is compared with a number has reached it.
    pub(crate) fn has_reached(&self) -> bool {
        self.values.iter().any(|(_, missing)| *missing <= 0.0)
    }
}

#[cfg(test)]
mod tests {
    use std::{fs, io::Write};

    use super::*;

    fn line(tag: &str, step: u64, value: f64) -> String {
        format!("{{\"run\":\"r\",\"tag\":\"{tag}\",\"step\":{step},\"value\":{value},\"time_unix_s\":1.0}}\n")
    }

    #[test]
    fn a_log_is_followed_while_it_grows_and_after_it_is_replaced() {
        let (folder, tag) = (tempfile::tempdir().unwrap(), "rollout/ep_rew_mean");
        let (path, goal) = (folder.path().join("metrics.jsonl"), Goal::read(&format!("highest {tag}")).unwrap());
        let mut log = FollowedLog::of(folder.path());
        log.read(&goal).unwrap();
        assert_eq!((log.step, log.at(9)), (0, None));
        let cut = line(tag, 20, 7.0);
        fs::write(&path, line(tag, 10, 5.0) + &line("time/time_elapsed", 10, 1.0) + &cut[..20]).unwrap();
        log.read(&goal).unwrap();
        assert_eq!((log.step, log.at(9), log.at(10), log.at(99)), (10, None, Some(5.0), Some(5.0)));
        let mut file = File::options().append(true).open(&path).unwrap();
        file.write_all(format!("{}{{\"tag\":\"rollout\n", &cut[20..]).as_bytes()).unwrap();
        log.read(&goal).unwrap();
        assert_eq!((log.at(19), log.at(20), log.values.len()), (Some(5.0), Some(7.0), 2));
        // The new file is as long as the old one, so that only its inode differs.
        let new = folder.path().join("new");
        fs::write(&new, fs::read_to_string(&path).unwrap().replace(":5,", ":6,")).unwrap();
        fs::rename(&new, &path).unwrap();
        log.read(&goal).unwrap();
        assert_eq!((log.at(10), log.values.len()), (Some(6.0), 2));
        File::options().write(true).open(&path).unwrap().set_len(line(tag, 10, 6.0).len() as u64).unwrap();
        log.read(&goal).unwrap();
        assert_eq!((log.step, log.at(99)), (0, Some(6.0)));
    }

    #[test]
    fn what_misses_a_number_is_compared_by_how_much() {
        let folder = tempfile::tempdir().unwrap();
        let tag = "eval/distance_mean_m";
        fs::write(folder.path().join("metrics.jsonl"), line(tag, 10, 1.0) + &line(tag, 20, 12.0)).unwrap();
        for (goal, at, has_reached) in [
            (format!("steps until {tag} >= 10"), [9.0, -2.0], true),
            (format!("seconds until {tag} <= 1"), [0.0, 11.0], true),
            (format!("steps until {tag} >= 50"), [49.0, 38.0], false),
        ] {
            let mut log = FollowedLog::of(folder.path());
            log.read(&Goal::read(&goal).unwrap()).unwrap();
            assert_eq!((log.at(10), log.at(20)), (Some(at[0]), Some(at[1])), "{goal}");
            assert_eq!(log.has_reached(), has_reached, "{goal}");
        }
    }
}
