//! What the user sees while a run trains, all of it on standard output.
//!
//! On a terminal: a progress bar, with tables and messages above it. Anywhere else, as in a log file: plain lines
//! without a single escape code. A closed pipe or a full disk behind standard output never stops a training run, so
//! whatever writing here fails is passed over.

use std::collections::VecDeque;
use std::io::{self, IsTerminal, Write};
use std::time::{Duration, Instant};

use console::strip_ansi_codes;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use treadmill_common::machine;

use super::table::{format_number, render_line, render_table};
use super::{History, Scalars, history::Point, sparkline::sparkline};

/// Between two progress lines in a log file.
const LINE_EVERY: Duration = Duration::from_secs(10);

/// The first picture of learning in a log file; each further one when the run is twice as old, or after the second time.
const PICTURE_AFTER: Duration = Duration::from_secs(10);
const PICTURE_EVERY_MAX: Duration = Duration::from_secs(300);

/// Characters of a curve in one line.
const CURVE_WIDTH: usize = 24;

/// Waiting for experience is worth a word after this; while a run learns, only after the second time.
const WAITING_AFTER: Duration = Duration::from_secs(2);
const WAITING_LONG: Duration = Duration::from_secs(30);

/// How far the speed looks back: long enough for several updates, short enough to follow actors that come and go.
const SPEED_WINDOW: Duration = Duration::from_secs(60);

/// Between two measurements that are kept.
const SPEED_EVERY: Duration = Duration::from_secs(2);

/// Measurements kept: those in the window, the one at its edge, and the newest one.
const SPEED_SAMPLES_MAX: usize = 32;

/// The bar on a terminal. No colours, so `NO_COLOR` has nothing to switch off.
const BAR: &str = "{prefix}{percent:>3}% [{wide_bar}] {human_pos}/{human_len} steps, {msg}";

/// A progress bar and tables on a terminal, plain lines elsewhere.
pub struct Console {
    out: Box<dyn Write + Send>,
    terminal: bool,
    /// Only on a terminal, and only when asked for.
    bar: Option<ProgressBar>,
    show_progress: bool,
    started: Instant,
    speed: Speed,
    total_steps: u64,
    env_steps: u64,
    line_at: Duration,
    picture_at: Duration,
    /// How long the batch of the moment was waited for when that was last said.
    waited: Duration,
    is_unicode: bool,
    finished: bool,
}

impl Console {
    /// A console for a run that goes from `start_steps` (after a resume more than 0) to `total_steps`. Without
    /// `show_progress` there is no bar and no line about progress; tables and messages stay.
    pub fn new(total_steps: u64, start_steps: u64, show_progress: bool) -> Self {
        let terminal = io::stdout().is_terminal() && std::env::var_os("TERM").is_none_or(|term| term != "dumb");
        let mut console = Self::writing_to(Box::new(io::stdout()), total_steps, start_steps, show_progress);
        console.terminal = terminal;
        console.bar = (terminal && show_progress).then(|| bar(total_steps, start_steps));
        console
    }

    /// The run goes to another number of steps than it began with.
    pub fn set_steps(&mut self, total_steps: u64) {
        self.total_steps = total_steps;
        if let Some(bar) = &self.bar {
            bar.set_length(total_steps);
        }
    }

    /// Plain lines into `out`.
    fn writing_to(out: Box<dyn Write + Send>, total_steps: u64, start_steps: u64, show_progress: bool) -> Self {
        Self {
            out,
            terminal: false,
            bar: None,
            show_progress,
            started: Instant::now(),
            speed: Speed::new(start_steps),
            total_steps,
            env_steps: start_steps,
            line_at: LINE_EVERY,
            picture_at: PICTURE_AFTER,
            waited: Duration::ZERO,
            is_unicode: machine::is_utf8_locale(),
            finished: false,
        }
    }

    /// Where the run is now; shown with the speed, the time left, and now and then a picture of how it learns.
    pub fn progress(&mut self, env_steps: u64, history: &History) {
        self.progress_at(env_steps, history, self.started.elapsed());
    }

    fn progress_at(&mut self, env_steps: u64, history: &History, elapsed: Duration) {
        self.waited = Duration::ZERO;
        self.env_steps = env_steps;
        self.speed.observe(elapsed, env_steps);
        let pace = pace(self.speed.steps_per_s(), self.total_steps.saturating_sub(env_steps));
        if let Some(bar) = &self.bar {
            bar.set_position(env_steps);
            bar.set_message(pace);
            if let Some(picture) = picture(history, self.is_unicode) {
                bar.set_prefix(picture + "\n");
            }
        } else if self.show_progress && !self.terminal && elapsed >= self.line_at {
            self.line_at = elapsed + LINE_EVERY;
            let percent = env_steps as f64 / self.total_steps.max(1) as f64 * 100.0;
            self.write(&format!("steps={env_steps} of {} ({percent:.1}%), {pace}\n", self.total_steps));
        }
        if !self.terminal && elapsed >= self.picture_at {
            self.picture_at = elapsed + elapsed.min(PICTURE_EVERY_MAX);
            self.show(history, elapsed);
        }
    }

    /// A line with a picture of how the run learns, where there is anything to show.
    fn show(&mut self, history: &History, elapsed: Duration) {
        if let Some(picture) = picture(history, self.is_unicode).filter(|_| self.show_progress) {
            self.write(&format!("after {}: {picture}\n", clock(elapsed.as_secs())));
        }
    }

    /// Says that experience is waited for, where that takes long, and then less and less often.
    pub fn waiting(&mut self, waited: Duration, actors: usize) {
        let patience = if self.speed.is_begun() { WAITING_LONG } else { WAITING_AFTER };
        if waited < patience.max(self.waited * 2) || !self.show_progress {
            return;
        }
        self.waited = waited;
        let who = match actors {
            0 => "no actor is there yet or any more".to_string(),
            1 => "1 actor is there and simulates".to_string(),
            actors => format!("{actors} actors are there and simulate"),
        };
        let message = format!("waiting for experience since {}: {who}", clock(waited.as_secs()));
        match &self.bar {
            Some(bar) => bar.set_message(message),
            None => self.write(&format!("{message}\n")),
        }
    }

    /// All scalars of one step: a boxed table on a terminal, elsewhere one line `steps=… tag=value …`.
    pub fn table(&mut self, scalars: &Scalars) {
        let text = if self.terminal { render_table(scalars) } else { render_line(self.env_steps, scalars) + "\n" };
        self.write(&text);
    }

    /// A message above the bar, elsewhere a plain line. Escape codes and other control characters in it are taken
    /// out: a message may quote what came over the network.
    pub fn line(&mut self, message: &str) {
        let shown = |c: &char| !c.is_control() || matches!(c, '\n' | '\t');
        let message: String = strip_ansi_codes(message).chars().filter(shown).collect();
        self.write(&format!("{message}\n"));
    }

    /// Takes the bar away and says how far the run came and how fast it was from start to end, with a last picture. Only the
    /// first call does anything.
    pub fn finish(&mut self, history: &History) {
        if std::mem::replace(&mut self.finished, true) {
            return;
        }
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
        if self.show_progress {
            let elapsed = self.started.elapsed();
            let steps = self.env_steps.saturating_sub(self.speed.start_steps);
            let speed = steps as f64 / elapsed.as_secs_f64().max(f64::MIN_POSITIVE);
            let (now, total) = (self.env_steps, self.total_steps);
            self.write(&format!("steps={now} of {total}, {} at {speed:.0} steps/s\n", clock(elapsed.as_secs())));
            self.show(history, elapsed);
        }
    }

    fn write(&mut self, text: &str) {
        let out = &mut self.out;
        let mut write = || {
            let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
        };
        match &self.bar {
            Some(bar) => bar.suspend(write),
            None => write(),
        }
    }
}

impl std::fmt::Debug for Console {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Console").field("terminal", &self.terminal).field("env_steps", &self.env_steps).finish()
    }
}

fn bar(total_steps: u64, start_steps: u64) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(total_steps), ProgressDrawTarget::stdout()).with_position(start_steps);
    // The template is a constant; were it wrong, the default one would do.
    if let Ok(style) = ProgressStyle::with_template(BAR) {
        bar.set_style(style.progress_chars("=> "));
    }
    bar.set_message("waiting for the first steps");
    bar
}

/// `return 310 ▁▃▆█ 620, distance 0.1 ▁▂▅█ 1.9 m, farthest 1.9 m`; nothing before an episode has ended.
fn picture(history: &History, is_unicode: bool) -> Option<String> {
    let curve = |of: fn(&Point) -> f64| {
        let values: Vec<f64> = history.points().map(|point| of(&point)).collect();
        let (first, last) = (values.first()?, values.last()?);
        let line = sparkline(&values, CURVE_WIDTH, is_unicode);
        Some(format!("{} {line} {}", format_number(*first), format_number(*last)))
    };
    let (returns, distances) = (curve(|point| point.return_mean)?, curve(|point| point.distance_m)?);
    let farthest = history.farthest_m().map(|m| format!(", farthest {} m", format_number(m))).unwrap_or_default();
    Some(format!("return {returns}, distance {distances} m{farthest}"))
}

/// Steps per second over the last while. Time is given from outside.
#[derive(Debug)]
struct Speed {
    start_steps: u64,
    samples: VecDeque<(Duration, u64)>,
}

impl Speed {
    fn new(start_steps: u64) -> Self {
        Self { start_steps, samples: VecDeque::from([(Duration::ZERO, start_steps)]) }
    }

    fn observe(&mut self, elapsed: Duration, env_steps: u64) {
        // The newest sample moves along until it is far enough from the one before it.
        if let [.., before, newest] = self.samples.make_contiguous()
            && newest.0.saturating_sub(before.0) < SPEED_EVERY
        {
            *newest = (elapsed, env_steps);
        } else {
            self.samples.push_back((elapsed, env_steps));
        }
        // The sample at the window's edge or beyond stays, so that rare updates have a speed as well.
        let outside = |sample: &(Duration, u64)| elapsed.saturating_sub(sample.0) >= SPEED_WINDOW;
        while self.samples.len() > SPEED_SAMPLES_MAX || (self.samples.len() > 2 && outside(&self.samples[1])) {
            self.samples.pop_front();
        }
    }

    fn is_begun(&self) -> bool {
        self.samples.len() > 1
    }

    /// `None` as long as nothing can be said.
    fn steps_per_s(&self) -> Option<f64> {
        let (first, last) = (self.samples.front()?, self.samples.back()?);
        let seconds = last.0.saturating_sub(first.0).as_secs_f64();
        (seconds > 0.0).then(|| last.1.saturating_sub(first.1) as f64 / seconds)
    }
}

/// `3412 steps/s, 4m 05s left`.
fn pace(steps_per_s: Option<f64>, steps_left: u64) -> String {
    match steps_per_s {
        Some(speed) if speed > 0.0 => {
            format!("{speed:.0} steps/s, {} left", clock((steps_left as f64 / speed).ceil() as u64))
        }
        _ => "0 steps/s".to_string(),
    }
}

/// `5s`, `4m 05s`, `3h 04m`, `2d 03h`.
fn clock(seconds: u64) -> String {
    let (minutes, hours, days) = (seconds / 60, seconds / 3600, seconds / 86_400);
    match (days, hours, minutes) {
        (0, 0, 0) => format!("{seconds}s"),
        (0, 0, _) => format!("{minutes}m {:02}s", seconds % 60),
        (0, _, _) => format!("{hours}h {:02}m", minutes % 60),
        _ => format!("{days}d {:02}h", hours % 24),
    }
}

#[cfg(test)]
mod tests {
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
    fn a_log_file_gets_plain_lines_at_most_one_on_progress_in_ten_seconds() {
        let captured = Captured::default();
        let mut console = Console::writing_to(Box::new(captured.clone()), 10_000, 1_000, true);
        console.line("\u{1b}[31mactor a-0\u{1b}[0m\u{9b}2J\r\u{7} joined\u{1b}");
        for second in 1..=20 {
            console.progress_at(1_000 + 100 * second, &History::default(), seconds(second));
        }
        console.table(&[("rollout/ep_rew_mean".to_string(), 1.25)]);
        assert_eq!(
            captured.text(),
            "actor a-0 joined\n\
             steps=2000 of 10000 (20.0%), 100 steps/s, 1m 20s left\n\
             steps=3000 of 10000 (30.0%), 100 steps/s, 1m 10s left\n\
             steps=3000 rollout/ep_rew_mean=1.25\n"
        );
    }

    #[test]
    fn without_progress_tables_and_messages_stay() {
        let captured = Captured::default();
        let mut console = Console::writing_to(Box::new(captured.clone()), 0, 0, false);
        console.progress_at(500, &History::default(), seconds(60));
        console.table(&[("train/loss".to_string(), f64::NAN)]);
        console.line("done");
        console.finish(&History::default());
        assert_eq!(captured.text(), "steps=500 train/loss=nan\ndone\n");
    }

    #[test]
    fn a_run_is_finished_once_and_may_have_gone_nowhere() {
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
    fn learning_is_pictured_now_and_then_and_at_the_end() {
        let captured = Captured::default();
        let mut console = Console::writing_to(Box::new(captured.clone()), 10_000, 0, true);
        (console.is_unicode, console.line_at) = (false, seconds(1_000));
        let mut history = History::default();
        for second in 1..=39 {
            history.take(Some(10.0 * second as f64), Some(0.5), None);
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
    fn waiting_is_told_less_and_less_often() {
        let captured = Captured::default();
        let mut console = Console::writing_to(Box::new(captured.clone()), 10_000, 0, true);
        (0..=20).for_each(|second| console.waiting(seconds(second), 0));
        console.progress_at(100, &History::default(), seconds(21));
        (0..=40).for_each(|second| console.waiting(seconds(second), 2));
        let no_actor = |since: &str| format!("waiting for experience since {since}: no actor is there yet or any more\n");
        let simulating = "waiting for experience since 30s: 2 actors are there and simulate\n";
        let waited: String = ["2s", "4s", "8s", "16s"].into_iter().map(no_actor).collect();
        let text: String = captured.text().lines().filter(|line| line.starts_with("waiting")).map(|line| format!("{line}\n")).collect();
        assert_eq!(text, waited + simulating);
    }

    #[test]
    fn a_closed_pipe_stops_nothing() {
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
        console.line("a message");
        console.finish(&History::default());
    }

    #[test]
    fn the_speed_looks_back_over_its_window_only() {
        let mut speed = Speed::new(0);
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
        let mut speed = Speed::new(100);
        speed.observe(seconds(200), 300);
        speed.observe(seconds(400), 700);
        assert_eq!(speed.steps_per_s(), Some(2.0));
        // A clock that stands still and steps that go back do no harm.
        speed.observe(seconds(400), 0);
        assert_eq!(speed.steps_per_s(), Some(0.0));
    }

    #[test]
    fn times_read_well() {
        assert_eq!([5, 245, 11_040, 183_600].map(clock), ["5s", "4m 05s", "3h 04m", "2d 03h"]);
        assert_eq!(pace(None, 5), "0 steps/s");
        assert_eq!(pace(Some(0.0), 5), "0 steps/s");
        assert_eq!(pace(Some(f64::MIN_POSITIVE), u64::MAX).split(", ").count(), 2);
    }
}
