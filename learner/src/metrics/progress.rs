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
use treadmill_runtime::machine;

use super::table::{render_line, render_table};
use super::{History, Scalars, history::Point, sparkline::sparkline};

/// Between two progress lines in a log file.
const LINE_EVERY: Duration = Duration::from_secs(10);

/// The first picture of learning in a log file; each further one when the run is twice as old, or after the second time.
const PICTURE_AFTER: Duration = Duration::from_secs(10);
const PICTURE_EVERY_MAX: Duration = Duration::from_secs(300);

/// Characters of a curve in one line.
const CURVE_WIDTH: usize = 16;

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
const BAR: &str = "{percent:>3}% [{wide_bar}] {human_pos}/{human_len} steps, {msg}";
/// The same below a picture of learning, once there is one.
const PICTURE_AND_BAR: &str = "{prefix}\n{percent:>3}% [{wide_bar}] {human_pos}/{human_len} steps, {msg}";

/// A progress bar and tables on a terminal, plain lines elsewhere.
pub struct Console {
    out: Box<dyn Write + Send>,
    terminal: bool,
    /// Only on a terminal, and only when asked for.
    bar: Option<ProgressBar>,
    show_progress: bool,
    started: Instant,
    speed: ThroughputMeter,
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
            speed: ThroughputMeter::new(start_steps),
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
                if bar.prefix().is_empty() {
                    style(bar, PICTURE_AND_BAR);
                }
                bar.set_prefix(picture);
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
    style(&bar, BAR);
    bar.set_message("waiting for the first steps");
    bar
}

/// Both templates are constants; were one wrong, what the bar has would do.
fn style(bar: &ProgressBar, template: &str) {
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style.progress_chars("=> "));
    }
}

/// `return 310 ▁▃▆█ 620, distance 0.1 ▁▂▅█ 1.9 m, farthest 1.9 m`; nothing before an episode has ended.
fn picture(history: &History, is_unicode: bool) -> Option<String> {
    let curve = |of: fn(&Point) -> f64, decimals| {
        let values: Vec<f64> = history.points().map(|point| of(&point)).collect();
        let (first, last) = (values.first()?, values.last()?);
        let line = sparkline(&values, CURVE_WIDTH, is_unicode);
        Some(format!("{} {line} {}", rounded(*first, decimals), rounded(*last, decimals)))
    };
    let (returns, distances) = (curve(|point| point.return_mean, 0)?, curve(|point| point.distance_m, 1)?);
    let farthest = history.farthest_m().map(|m| format!(", farthest {} m", rounded(m, 1))).unwrap_or_default();
    Some(format!("return {returns}, distance {distances} m{farthest}"))
}

/// Never `-0.0`.
fn rounded(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let is_zero = text.bytes().all(|byte| matches!(byte, b'-' | b'0' | b'.'));
    if is_zero { text.trim_start_matches('-').to_string() } else { text }
}

/// Steps per second over the last while. Time is given from outside.
#[derive(Debug)]
struct ThroughputMeter {
    start_steps: u64,
    samples: VecDeque<(Duration, u64)>,
}

impl ThroughputMeter {
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
#[path = "progress_tests.rs"]
mod tests;
