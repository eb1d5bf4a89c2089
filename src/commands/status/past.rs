//! Metrics that a run on this machine logged before the dashboard was opened.

use std::{
    fs::File,
    io::{BufRead, BufReader, Read, Seek, SeekFrom},
    path::Path,
};

use treadmill_proto::json::Metric;

use super::fleet::CURVES;

/// Most bytes that are read, from the end of the log.
const BYTES_MAX: u64 = 256 << 20;
/// Longest line of a metric.
const LINE_BYTES_MAX: u64 = 4096;

/// Reads the metrics of curves; an unreadable log has none.
pub fn read(log: &Path) -> Vec<Metric> {
    let Ok(mut file) = File::open(log) else { return Vec::new() };
    let length = file.metadata().map_or(0, |metadata| metadata.len());
    if length > BYTES_MAX && file.seek(SeekFrom::Start(length - BYTES_MAX)).is_err() {
        return Vec::new();
    }
    let wanted = CURVES.map(|tag| format!("\"tag\":\"{tag}\""));
    let (mut reader, mut line, mut metrics) = (BufReader::new(file), Vec::new(), Vec::new());
    while matches!((&mut reader).take(LINE_BYTES_MAX).read_until(b'\n', &mut line), Ok(1..)) {
        // Most lines have other tags and are not parsed.
        let text = String::from_utf8_lossy(&line);
        if wanted.iter().any(|tag| text.contains(tag)) {
            metrics.extend(Metric::from_json(text.trim_end().as_bytes()).ok());
        }
        line.clear();
    }
    metrics
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_are_read_and_malformed_lines_skipped() {
        let folder = tempfile::tempdir().unwrap();
        let log = folder.path().join("metrics.jsonl");
        let metric = |tag: &str, step| Metric { run: "r".into(), tag: tag.into(), step, value: 1.5, time_unix_s: 2.0 };
        let line = |metric: &Metric| [metric.to_json(), b"\n".to_vec()].concat();
        let (first, second) = (metric("rollout/ep_rew_mean", 8), metric("time/fps", 16));
        let torn = &line(&first)[..40];
        let parts = [
            &line(&first)[..],
            b"\xff\n{}\n",
            &[b'x'; 9000],
            b"\n",
            &line(&metric("train/std", 9)),
            &line(&second),
            torn,
        ];
        std::fs::write(&log, parts.concat()).unwrap();
        assert_eq!(read(&log), [first, second]);
        assert_eq!(read(&folder.path().join("none")), []);
    }
}
