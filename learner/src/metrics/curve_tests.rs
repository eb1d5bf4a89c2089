//! Learning curves of ordinary and unusual metrics.

use std::fs;
use std::path::Path;

use super::{CurveError, draw_curve};

const TAGS: [&str; 3] = ["rollout/ep_rew_mean", "rollout/distance_mean_m", "rollout/velocity_mean_mps"];

fn line(tag: &str, step: u64, value: &str) -> String {
    format!(r#"{{"run":"r","tag":"{tag}","step":{step},"value":{value},"time_unix_s":1.0}}"#) + "\n"
}

/// Draws over an older image, and returns the width and height in the PNG's header.
fn drawn(metrics: &str) -> (u32, u32) {
    let folder = tempfile::tempdir().unwrap();
    let (jsonl, png) = (folder.path().join("metrics.jsonl"), folder.path().join("curve.png"));
    fs::write(&jsonl, metrics).unwrap();
    fs::write(&png, "old").unwrap();
    draw_curve(&jsonl, &png).unwrap();
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "a temporary file was left");
    let bytes = fs::read(&png).unwrap();
    assert_eq!(bytes[..8], *b"\x89PNG\r\n\x1a\n");
    let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
    (number(16), number(20))
}

#[test]
fn a_run_is_drawn() {
    let metrics: String = (0..300u64)
        .flat_map(|update| {
            TAGS.map(|tag| line(tag, update * 32_768, &format!("{}", (update as f64).sqrt() * 3.5 - 5.0)))
        })
        .collect();
    assert_eq!(drawn(&metrics), (1200, 1200));
}

#[test]
fn unusual_metrics_are_drawn() {
    let points =
        |values: &[(u64, &str)]| -> String { values.iter().map(|(step, value)| line(TAGS[0], *step, value)).collect() };
    let cases = [
        String::new(),
        "\n\nno json\n{".to_string(),
        points(&[(0, "0.0")]),
        points(&[(1, "-7.5")]),
        points(&[(5, "3.0"), (9, "3.0"), (12, "3.0")]),
        points(&[(5, "1e12"), (9, "-1e12"), (12, "1e-300")]),
        points(&[(5, "1e308"), (9, "-1e308"), (9, "null"), (10, "1e999"), (u64::MAX, "1.0")]),
        points(&[(9, "1.0000000000000002"), (5, "1.0"), (5, "1.0000000000000004")]),
        line("rollout/ep_len_mean", 5, "1.0"),
    ];
    for metrics in cases {
        assert_eq!(drawn(&metrics), (1200, 1200), "{metrics}");
    }
}

#[test]
fn read_and_write_errors_name_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let (jsonl, png) = (folder.path().join("metrics.jsonl"), folder.path().join("gone").join("curve.png"));
    let error = draw_curve(&jsonl, Path::new("curve.png")).unwrap_err();
    assert!(matches!(&error, CurveError::Read { path, .. } if *path == jsonl), "{error}");
    fs::write(&jsonl, "").unwrap();
    let error = draw_curve(&jsonl, &png).unwrap_err();
    assert!(matches!(&error, CurveError::Write { path, .. } if *path == png), "{error}");
}
