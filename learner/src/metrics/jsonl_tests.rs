//! Writing and truncating `metrics.jsonl`.

use std::fs;

use treadmill_proto::json::Metric;

use super::JsonLines;

fn metric(step: u64, value: f64) -> Metric {
    Metric { run: "r".into(), tag: "rollout/ep_rew_mean".into(), step, value, time_unix_s: 12.5 }
}

fn line(step: u64, value: &str) -> String {
    format!(r#"{{"run":"r","tag":"rollout/ep_rew_mean","step":{step},"value":{value},"time_unix_s":12.5}}"#) + "\n"
}

#[test]
fn lines_are_appended_without_non_finite_values() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("metrics.jsonl");
    JsonLines::append(&path).unwrap().write(&[metric(1, 0.5), metric(1, f64::NAN)]).unwrap();
    let mut lines = JsonLines::append(&path).unwrap();
    lines.write(&[metric(2, f64::INFINITY), metric(3, -2.0)]).unwrap();
    lines.write(&[]).unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), line(1, "0.5") + &line(3, "-2.0"));
}

#[test]
fn a_resume_removes_later_lines_and_a_truncated_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("metrics.jsonl");
    let kept = line(10, "0.1") + &line(20, "0.30000000000000004");
    fs::write(&path, kept.clone() + &line(21, "3.0") + r#"{"run":"r","tag":"roll"#).unwrap();
    JsonLines::truncate_after(&path, 20).unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), kept);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "the temporary file was left");

    JsonLines::append(&path).unwrap().write(&[metric(30, 4.0)]).unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), kept + &line(30, "4.0"));
}

#[test]
fn a_complete_last_line_without_a_newline_stays() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("metrics.jsonl");
    fs::write(&path, line(10, "1.0").trim_end()).unwrap();
    JsonLines::truncate_after(&path, 10).unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), line(10, "1.0"));
}

#[test]
fn bytes_that_are_not_text_do_not_stop_a_resume() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("metrics.jsonl");
    let mut bytes = vec![0xff, 0x00, b'\n', b'\n'];
    bytes.extend_from_slice(line(5, "1.0").as_bytes());
    bytes.extend_from_slice(&[0; 100]);
    fs::write(&path, bytes).unwrap();
    JsonLines::truncate_after(&path, 10).unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), line(5, "1.0"));
}

#[test]
fn a_missing_file_is_accepted_but_a_folder_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    JsonLines::truncate_after(&folder.path().join("metrics.jsonl"), 0).unwrap();
    assert!(JsonLines::truncate_after(folder.path(), 0).is_err());
    assert!(JsonLines::append(folder.path()).is_err());
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    let mut lines = JsonLines::append(std::path::Path::new("/dev/full")).unwrap();
    assert_eq!(lines.write(&[metric(1, 1.0)]).unwrap_err().kind(), std::io::ErrorKind::StorageFull);
}
