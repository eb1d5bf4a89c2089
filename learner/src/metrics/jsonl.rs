//! `metrics.jsonl`: one line per scalar, with the same JSON object as on the bus.

use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader};
use std::path::Path;

use treadmill_proto::json::Metric;
use treadmill_runtime::atomic_file;

use super::append_whole;

/// Append-only file of JSON lines.
#[derive(Debug)]
pub struct JsonLines {
    file: File,
}

impl JsonLines {
    /// Opens the file for appending, and creates it if needed.
    pub fn append(path: &Path) -> io::Result<Self> {
        Ok(Self { file: OpenOptions::new().append(true).create(true).open(path)? })
    }

    /// Writes one line per metric; after an error, none is written. Omits NaN and infinity, which JSON lacks.
    pub fn write(&mut self, metrics: &[Metric]) -> io::Result<()> {
        let mut lines = Vec::new();
        for metric in metrics.iter().filter(|metric| metric.value.is_finite()) {
            serde_json::to_writer(&mut lines, metric)?;
            lines.push(b'\n');
        }
        append_whole(&mut self.file, &lines)
    }

    /// On resume, removes every line with a step above `step`, which the run will write again, and every line that is
    /// not a metric, such as one truncated by a crash. Replaces the file atomically; a missing file is not an error.
    /// Call it before [`Self::append`].
    pub fn truncate_after(path: &Path, step: u64) -> io::Result<()> {
        let file = match File::open(path) {
            Ok(file) => file,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
            Err(error) => return Err(error),
        };
        let mut kept = Vec::new();
        // Copies the lines' bytes: encoding a number again may change its last digit.
        for_each_metric(file, |metric, line| {
            if metric.step <= step {
                kept.extend_from_slice(line);
                kept.push(b'\n');
            }
            Ok(())
        })?;
        atomic_file::write(path, &kept)
    }
}

/// Calls `each` with every metric of a file and its line, in order; skips lines that are not metrics.
pub fn for_each_metric(file: File, mut each: impl FnMut(Metric, &[u8]) -> io::Result<()>) -> io::Result<()> {
    let mut reader = BufReader::new(file);
    let mut line = Vec::new();
    while reader.read_until(b'\n', &mut line)? > 0 {
        if let Ok(metric) = serde_json::from_slice(&line) {
            each(metric, line.trim_ascii_end())?;
        }
        line.clear();
    }
    Ok(())
}
