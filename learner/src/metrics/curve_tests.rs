//! Learning curves of ordinary and unusual metrics.

use std::fs::{self, File};
use std::path::Path;

use treadmill_config::{Config, ConfigSource};

use super::curve::value_range;
use super::curve_points::CurvePoints;
use super::{CurveError, CurveFacts, draw_curve};

const TAGS: [&str; 3] = ["rollout/ep_rew_mean", "rollout/distance_mean_m", "rollout/velocity_mean_mps"];

fn line(tag: &str, step: u64, value: &str) -> String {
    format!(r#"{{"run":"r","tag":"{tag}","step":{step},"value":{value},"time_unix_s":1.0}}"#) + "\n"
}

/// Draws over an older image; returns width, height and pixels.
fn image(metrics: &str, facts: &CurveFacts) -> (u32, u32, Vec<u8>) {
    let folder = tempfile::tempdir().unwrap();
    let (jsonl, png) = (folder.path().join("metrics.jsonl"), folder.path().join("curve.png"));
    fs::write(&jsonl, metrics).unwrap();
    fs::write(&png, "old").unwrap();
    draw_curve(&jsonl, facts, &png).unwrap();
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2, "a temporary file was left");
    let mut reader = png::Decoder::new(std::io::BufReader::new(File::open(&png).unwrap())).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    (info.width, info.height, pixels)
}

fn drawn(metrics: &str) -> (u32, u32) {
    let (width, height, _) = image(metrics, &CurveFacts::default());
    (width, height)
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
    let error = draw_curve(&jsonl, &CurveFacts::default(), Path::new("curve.png")).unwrap_err();
    assert!(matches!(&error, CurveError::Read { path, .. } if *path == jsonl), "{error}");
    fs::write(&jsonl, "").unwrap();
    let error = draw_curve(&jsonl, &CurveFacts::default(), &png).unwrap_err();
    assert!(matches!(&error, CurveError::Write { path, .. } if *path == png), "{error}");
}

#[test]
fn a_task_with_commands_has_four_panels_and_the_error_of_standing() {
    let mut source = ConfigSource::default();
    source
        .text(
            "[env]\ntask = \"velocity\"\nrobot = \"h1\"\n[velocity]\nlin_vel_x_mps = [0.0, 1.0]\n\
                 lin_vel_y_mps = [0.0, 0.0]\nang_vel_z_radps = [-0.4, 0.4]\nstanding_share = 0.5",
            "test",
        )
        .unwrap();
    let facts = CurveFacts::of(&source.build().unwrap());
    // Half of the commands say: stand; the mean of the others is 0.5 m/s and 0.2 rad/s.
    let [velocity_mps, yaw_radps] = facts.standing_errors.unwrap();
    assert!((velocity_mps - 0.25).abs() < 1e-12 && (yaw_radps - 0.1).abs() < 1e-12, "{facts:?}");
    assert_eq!(facts.task, "task velocity of h1");
    assert_eq!(CurveFacts::of(&Config::default()).standing_errors, None);
    let metrics: String = (0..5).map(|step| line("eval/velocity_error", step * 1_000_000, "0.2")).collect();
    let (width, height, with) = image(&metrics, &facts);
    assert_eq!((width, height), (1200, 1580));
    let (.., without) = image(&metrics, &CurveFacts { standing_errors: Some([0.2, 0.0]), ..facts.clone() });
    assert_ne!(with, without, "the line moves with the error");
}

#[test]
fn axes_of_errors_begin_at_zero() {
    let points = [(0.0, 0.3), (1.0, 0.5)];
    let range = value_range(&points, Some(0.7), true);
    assert!(range.start == 0.0 && range.end > 0.7, "{range:?}");
    let free = value_range(&points, None, false);
    assert!(free.start > 0.2 && free.start < 0.3, "{free:?}");
    // A robot may walk backwards.
    assert!(value_range(&[(0.0, -0.4)], None, true).start < -0.4);
}

#[test]
fn resumes_are_where_their_number_grows() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("metrics.jsonl");
    let resumes = [(1, "0"), (2, "0"), (3, "1"), (4, "1"), (5, "3")];
    let metrics = resumes.map(|(step, count)| line("time/resumes", step * 1_000_000, count)).concat();
    fs::write(&path, metrics).unwrap();
    let points = CurvePoints::read(File::open(&path).unwrap(), &[]).unwrap();
    assert_eq!((points.resumes, points.resumed, &*points.run), (vec![2.0, 4.0], 3, "r"));
}

#[test]
fn the_image_depends_on_run_day_and_evaluations_and_on_nothing_else() {
    let training: String = (0..9).map(|step| line(TAGS[1], step * 1_000_000, &format!("{}", step * 2))).collect();
    let evaluated = line("eval/distance_mean_m", 4_000_000, "3.0");
    let facts = CurveFacts::default();
    let (width, _, one) = image(&(training.clone() + &evaluated), &facts);
    assert_eq!(one, image(&(training.clone() + &evaluated), &facts).2);
    // Rows that differ: of the line above the panels only, or of the panel only.
    let rows = |other: &str| -> Vec<usize> {
        let (.., other) = image(other, &facts);
        let rows = one.chunks(3 * width as usize).zip(other.chunks(3 * width as usize)).enumerate();
        rows.filter(|(_, (one, other))| one != other).map(|(row, _)| row).collect()
    };
    let header = |changed: &[usize]| !changed.is_empty() && changed.iter().all(|row| *row < 60);
    let all = training.clone() + &evaluated;
    assert!(header(&rows(&all.replace("\"r\"", "\"other\""))));
    assert!(header(&rows(&all.replace(":1.0}", ":86401.0}"))), "the next day");
    assert!(rows(&all.replace(":1.0}", ":2.0}")).is_empty(), "the same day");
    let panel = rows(&training);
    assert!(!panel.is_empty() && panel.iter().all(|row| (440..820).contains(row)), "{panel:?}");
}

#[test]
fn strokes_have_soft_edges() {
    let slope: String = (0..100).map(|step| line(TAGS[0], step * 10_000, &format!("{step}"))).collect();
    let (.., pixels) = image(&slope, &CurveFacts::default());
    // Blue of the curve, and its mixtures with white, which a stroke without soft edges lacks.
    let blues = pixels.as_chunks::<3>().0.iter().copied().filter(|[red, _, blue]| *blue > red.saturating_add(20));
    let (full, soft): (Vec<[u8; 3]>, Vec<[u8; 3]>) = blues.partition(|pixel| *pixel == [31, 119, 180]);
    assert!(full.len() > 500 && soft.len() > full.len() / 4, "{} {}", full.len(), soft.len());
}
