//! Output of the console.

use std::sync::{Arc, Mutex};

use super::*;

#[derive(Clone, Default)]
struct Captured(Arc<Mutex<Vec<u8>>>);

impl Write for Captured {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap().write(bytes)
    }
    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Captured {
    fn text(&self) -> String {
        String::from_utf8(self.0.lock().unwrap().clone()).unwrap()
    }
}

fn seconds(seconds: u64) -> Duration {
    Duration::from_secs(seconds)
}

fn options(show_progress: bool, log_metrics: bool) -> ConsoleOptions {
    ConsoleOptions { show_progress, log_metrics, actor_command: None }
}

fn console(captured: &Captured, total_steps: u64, start_steps: u64, options: ConsoleOptions) -> Console {
    Console::writing_to(Box::new(captured.clone()), total_steps, start_steps, options)
}

#[test]
fn a_log_file_gets_a_short_line_after_the_first_update_and_every_ten_seconds() {
    let captured = Captured::default();
    let mut console = console(&captured, 10_000, 1_000, options(true, false));
    let scalars = [
        ("time/fps", 100.0),
        ("rollout/ep_rew_mean", 412.3),
        ("rollout/ep_len_mean", 85.2),
        ("rollout/distance_mean_m", -0.04),
        ("rollout/fall_fraction", 0.254),
        ("rollout/used_share", 0.996),
    ];
    let scalars = scalars.map(|(tag, value)| (tag.to_string(), value));
    for second in 1..=20 {
        console.progress_at(1_000 + 100 * second, &scalars, &History::default(), seconds(second));
        console.table(&scalars);
    }
    assert_eq!(
        captured.text(),
        "1,100 of 10,000 steps (11.0 %), 100 steps/s, 1m 29s left; return 412, length 85, distance 0.0 m, falls 25 %, used 100 %\n\
         2,100 of 10,000 steps (21.0 %), 100 steps/s, 1m 19s left; return 412, length 85, distance 0.0 m, falls 25 %, used 100 %\n"
    );
}

#[test]
fn a_line_of_large_numbers_has_at_most_160_characters() {
    let tags = ["rollout/ep_rew_mean", "rollout/ep_len_mean", "rollout/distance_mean_m", "rollout/used_share"];
    let scalars = tags.map(|tag| (tag.to_string(), -123_456.7));
    let speed = speed_and_remaining(1_234_567.0, 1 << 40);
    let line = line(123_456_789_012, 999_999_999_999, &speed, &scalars, &History::default());
    assert!(line.chars().count() <= 160, "{line}");
}

#[test]
fn all_metrics_are_shown_only_on_request() {
    let captured = Captured::default();
    let mut console = console(&captured, 0, 0, options(false, true));
    console.progress_at(500, &[], &History::default(), seconds(60));
    console.table(&[("train/value_loss".to_string(), f64::NAN)]);
    console.finish(&History::default());
    assert_eq!(captured.text(), "steps=500 train/value_loss=nan\n");
}

#[test]
fn finish_writes_once_even_without_progress() {
    let captured = Captured::default();
    let mut console = console(&captured, 0, 7, options(true, false));
    console.finish(&History::default());
    console.finish(&History::default());
    let text = captured.text();
    assert!(text.starts_with("steps 7 of 0, ") && text.ends_with(" at 0 steps/s\n"), "{text}");
    assert_eq!(text.lines().count(), 1);
}

#[test]
fn curves_appear_at_the_end_with_first_last_and_best() {
    let captured = Captured::default();
    let mut console = console(&captured, 10_000, 0, options(true, false));
    console.is_unicode = false;
    let mut history = History::default();
    for value in [10.0, 80.0, 40.0] {
        history.add(Some(value), Some(0.5), None);
    }
    console.finish(&history);
    let text = captured.text();
    assert!(text.ends_with(": return 10 > 40 (best 80) _#-, distance 0.5 > 0.5 m ___\n"), "{text}");
}

#[test]
fn a_wait_is_reported_less_and_less_often() {
    let captured = Captured::default();
    let options = ConsoleOptions { actor_command: Some("treadmill actor".to_string()), ..options(true, false) };
    let mut console = console(&captured, 10_000, 0, options);
    (0..=20).for_each(|second| console.show_wait(seconds(second), 0));
    console.progress_at(100, &[], &History::default(), seconds(21));
    (0..=40).for_each(|second| console.show_wait(seconds(second), 2));
    console.progress_at(200, &[], &History::default(), seconds(65));
    (0..=2).for_each(|second| console.show_wait(seconds(second), 0));
    let no_actor =
        |time: &str| format!("waiting for experience for {time}: no actor is connected; start one: treadmill actor\n");
    let simulating = "waiting for experience for 30s: 2 actors are simulating\n";
    let waited: String = ["2s", "4s", "8s", "16s"].into_iter().map(no_actor).collect();
    let text: String =
        captured.text().lines().filter(|line| line.starts_with("waiting")).map(|line| format!("{line}\n")).collect();
    assert_eq!(text, waited + simulating + &no_actor("2s"));
}

#[test]
fn rounding_never_gives_negative_zero() {
    assert_eq!([-0.02, -0.06, 0.04, 12.34].map(|value| rounded(value, 1)), ["0.0", "-0.1", "0.0", "12.3"]);
}

#[test]
fn a_closed_pipe_is_ignored() {
    struct Closed;
    impl Write for Closed {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::ErrorKind::BrokenPipe.into())
        }
        fn flush(&mut self) -> io::Result<()> {
            Err(io::ErrorKind::BrokenPipe.into())
        }
    }
    let mut console = Console::writing_to(Box::new(Closed), 10, 0, options(true, true));
    console.progress_at(5, &[], &History::default(), seconds(60));
    console.table(&[]);
    console.finish(&History::default());
}

#[test]
fn durations_are_formatted_with_two_units() {
    assert_eq!([5, 245, 11_040, 183_600].map(clock), ["5s", "4m 05s", "3h 04m", "2d 03h"]);
    assert_eq!(speed_and_remaining(0.0, 5), "0 steps/s");
    assert_eq!(speed_and_remaining(f64::MIN_POSITIVE, u64::MAX).split(", ").count(), 2);
}

#[test]
fn errors_stand_for_distances_where_the_task_has_commands() {
    let scalars = [("rollout/ep_rew_mean", 412.3), ("rollout/distance_mean_m", 5.0), ("rollout/fall_fraction", 0.9)];
    let scalars = scalars.map(|(tag, value)| (tag.to_string(), value));
    let mut history = History::default();
    history.figures = RunFigures::Tracking;
    history.add(Some(412.3), Some(5.0), None);
    let text = |history: &History| line(1, 2, "1 steps/s", &scalars, history);
    assert_eq!(text(&history), "1 of 2 steps (50.0 %), 1 steps/s; return 412, falls 90 %");
    assert!(!sparklines(&history, true).unwrap().contains("distance"));
    history.note_tracking(Some(0.123), Some(0.2));
    assert!(text(&history).contains("return 412, errors 0.12 m/s and 0.20 rad/s, falls 90 %"), "{}", text(&history));
    assert!(sparklines(&history, true).unwrap().ends_with("errors 0.12 m/s and 0.20 rad/s"));
}
