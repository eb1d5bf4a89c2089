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

#[test]
fn a_log_file_gets_plain_lines_and_progress_every_ten_seconds() {
    let captured = Captured::default();
    let mut console = Console::writing_to(Box::new(captured.clone()), 10_000, 1_000, true);
    for second in 1..=20 {
        console.progress_at(1_000 + 100 * second, &History::default(), seconds(second));
    }
    console.table(&[("rollout/ep_rew_mean".to_string(), 1.25)]);
    assert_eq!(
        captured.text(),
        "steps=2000 of 10000 (20.0%), 100 steps/s, 1m 20s left\n\
         steps=3000 of 10000 (30.0%), 100 steps/s, 1m 10s left\n\
         steps=3000 rollout/ep_rew_mean=1.25\n"
    );
}

#[test]
fn without_progress_there_are_only_tables() {
    let captured = Captured::default();
    let mut console = Console::writing_to(Box::new(captured.clone()), 0, 0, false);
    console.progress_at(500, &History::default(), seconds(60));
    console.table(&[("train/loss".to_string(), f64::NAN)]);
    console.finish(&History::default());
    assert_eq!(captured.text(), "steps=500 train/loss=nan\n");
}

#[test]
fn finish_writes_once_even_without_progress() {
    let captured = Captured::default();
    let mut console = Console::writing_to(Box::new(captured.clone()), 0, 7, true);
    console.progress_at(7, &History::default(), Duration::ZERO);
    console.finish(&History::default());
    console.finish(&History::default());
    let text = captured.text();
    assert!(text.starts_with("steps=7 of 0, ") && text.ends_with(" at 0 steps/s\n"), "{text}");
    assert_eq!(text.lines().count(), 1);
}

#[test]
fn sparklines_appear_at_intervals_and_at_the_end() {
    let captured = Captured::default();
    let mut console = Console::writing_to(Box::new(captured.clone()), 10_000, 0, true);
    (console.is_unicode, console.line_at) = (false, seconds(1_000));
    let mut history = History::default();
    for second in 1..=39 {
        history.add(Some(10.0 * second as f64), Some(0.5), None);
        console.progress_at(second, &history, seconds(second));
    }
    let text = captured.text();
    let times: Vec<_> = text.lines().map(|line| line.split(':').next().unwrap()).collect();
    assert_eq!(times, ["after 10s", "after 20s"], "{text}");
    assert!(text.starts_with("after 10s: return 10 _"), "{text}");
    assert!(text.contains("# 100, distance 0.5 __________ 0.5 m, farthest 0.5 m\n"), "{text}");
    console.finish(&history);
    assert!(captured.text().trim_end().ends_with("farthest 0.5 m"), "{}", captured.text());
}

#[test]
fn a_wait_is_reported_less_and_less_often() {
    let captured = Captured::default();
    let mut console = Console::writing_to(Box::new(captured.clone()), 10_000, 0, true);
    (0..=20).for_each(|second| console.show_wait(seconds(second), 0));
    console.progress_at(100, &History::default(), seconds(21));
    (0..=40).for_each(|second| console.show_wait(seconds(second), 2));
    let no_actor = |time: &str| format!("waiting for experience for {time}: no actor is connected\n");
    let simulating = "waiting for experience for 30s: 2 actors are simulating\n";
    let waited: String = ["2s", "4s", "8s", "16s"].into_iter().map(no_actor).collect();
    let text: String =
        captured.text().lines().filter(|line| line.starts_with("waiting")).map(|line| format!("{line}\n")).collect();
    assert_eq!(text, waited + simulating);
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
    let mut console = Console::writing_to(Box::new(Closed), 10, 0, true);
    console.progress_at(5, &History::default(), seconds(60));
    console.table(&[]);
    console.finish(&History::default());
}

#[test]
fn the_speed_is_that_of_its_window() {
    let mut speed = SpeedMeter::new(0);
    assert_eq!(speed.steps_per_s(), None);
    let mut steps = 0;
    for tenth in 1..=6_000u64 {
        // Ten times as fast after five minutes.
        steps += if tenth <= 3_000 { 10 } else { 100 };
        speed.observe(Duration::from_millis(100 * tenth), steps);
        assert!(speed.samples.len() <= SPEED_SAMPLES_MAX);
    }
    assert_eq!(speed.steps_per_s(), Some(1_000.0));
}

#[test]
fn rare_updates_still_have_a_speed() {
    let mut speed = SpeedMeter::new(100);
    speed.observe(seconds(200), 300);
    speed.observe(seconds(400), 700);
    assert_eq!(speed.steps_per_s(), Some(2.0));
    // A clock that stops and decreasing steps are harmless.
    speed.observe(seconds(400), 0);
    assert_eq!(speed.steps_per_s(), Some(0.0));
}

#[test]
fn durations_are_formatted_with_two_units() {
    assert_eq!([5, 245, 11_040, 183_600].map(clock), ["5s", "4m 05s", "3h 04m", "2d 03h"]);
    assert_eq!(speed_and_remaining(None, 5), "0 steps/s");
    assert_eq!(speed_and_remaining(Some(0.0), 5), "0 steps/s");
    assert_eq!(speed_and_remaining(Some(f64::MIN_POSITIVE), u64::MAX).split(", ").count(), 2);
}
