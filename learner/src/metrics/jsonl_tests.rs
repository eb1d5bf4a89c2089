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
fn a_resume_removes_later_lines_and_those_that_are_not_metrics() {
    let kept = line(10, "0.1") + &line(20, "0.30000000000000004");
    let torn = r#"{"run":"r","tag":"roll"#;
    let not_text = [b"\xff\0\n\n", line(5, "1.0").as_bytes(), &[0; 100]].concat();
    for (before, after) in [
        ((kept.clone() + &line(21, "3.0") + torn).into_bytes(), kept),
        // A complete last line without a newline stays.
        (line(10, "1.0").trim_end().as_bytes().to_vec(), line(10, "1.0")),
        (not_text, line(5, "1.0")),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("metrics.jsonl");
        fs::write(&path, before).unwrap();
        JsonLines::truncate_after(&path, 20).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), after);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "the temporary file was left");
        JsonLines::append(&path).unwrap().write(&[metric(30, 4.0)]).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), after + &line(30, "4.0"));
    }
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
