//! Progress of a run on standard output.
//!
//! On a terminal: a progress bar, and above it tables of the most important metrics. Elsewhere, such as in a log file: short
//! lines without escape codes. Write errors are ignored, so that a closed pipe or a full disk does not stop training.

use std::io::{self, IsTerminal, Write};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use treadmill_runtime::{machine, numbers::thousands};

use super::table::{important, render_line, render_table};
use super::{History, RunFigures, Scalars, history::Point, sparkline::sparkline};

/// Interval between two progress lines in a log file.
const LINE_EVERY: Duration = Duration::from_secs(10);

/// Interval between two tables on a terminal.
const TABLE_EVERY: Duration = Duration::from_secs(15);

/// Width of a sparkline in characters.
const SPARKLINE_WIDTH: usize = 16;

/// Shortest wait for experience that is reported before the first update, or if no actor is connected.
const FIRST_WAIT_MIN: Duration = Duration::from_secs(2);
/// Shortest wait that is reported afterwards.
const WAIT_MIN: Duration = Duration::from_secs(30);

/// Bar on a terminal, without colours.
const BAR: &str = "{percent:>3}% [{wide_bar}] {human_pos}/{human_len} steps, {msg}";
/// Bar below a sparkline.
const SPARKLINE_AND_BAR: &str = "{prefix}\n{percent:>3}% [{wide_bar}] {human_pos}/{human_len} steps, {msg}";

/// What a console shows.
#[derive(Clone, Debug, Default)]
pub struct ConsoleOptions {
    /// Whether it shows progress; otherwise only what `log_metrics` asks for.
    pub show_progress: bool,
    /// Whether it shows all metrics, every `learner.table_every_updates` updates.
    pub log_metrics: bool,
    /// Command that starts an actor, where the user starts them.
    pub actor_command: Option<String>,
}

/// Progress bar and tables on a terminal, plain lines elsewhere.
pub struct Console {
    out: Box<dyn Write + Send>,
    is_terminal: bool,
    /// Only on a terminal, and only with `show_progress`.
    bar: Option<ProgressBar>,
    options: ConsoleOptions,
    started: Instant,
    start_steps: u64,
    total_steps: u64,
    env_steps: u64,
    /// Time of the next line or table.
    due: Duration,
    /// Wait for the current batch when it was last reported.
    waited: Duration,
    is_unicode: bool,
    finished: bool,
}

impl Console {
    /// Console for a run from `start_steps` (more than 0 after a resume) to `total_steps`.
    pub fn new(total_steps: u64, start_steps: u64, options: ConsoleOptions) -> Self {
        let is_terminal = io::stdout().is_terminal() && std::env::var_os("TERM").is_none_or(|term| term != "dumb");
        let mut console = Self::writing_to(Box::new(io::stdout()), total_steps, start_steps, options);
        console.is_terminal = is_terminal;
        if is_terminal && console.options.show_progress {
            console.bar = Some(new_bar(total_steps, start_steps));
            console.due = TABLE_EVERY;
        }
        console
    }

    /// Changes the run's number of steps.
    pub fn set_steps(&mut self, total_steps: u64) {
        self.total_steps = total_steps;
        if let Some(bar) = &self.bar {
            bar.set_length(total_steps);
        }
    }

    /// Console that writes plain lines to `out`.
    fn writing_to(out: Box<dyn Write + Send>, total_steps: u64, start_steps: u64, options: ConsoleOptions) -> Self {
        Self {
            out,
            is_terminal: false,
            bar: None,
            options,
            started: Instant::now(),
            start_steps,
            total_steps,
            env_steps: start_steps,
            due: Duration::ZERO,
            waited: Duration::ZERO,
            is_unicode: machine::is_utf8_locale(),
            finished: false,
        }
    }

    /// Shows an update: on a terminal the bar with sparklines, at intervals a table; elsewhere a line after the first
    /// update, then at intervals.
    pub fn progress(&mut self, env_steps: u64, scalars: &Scalars, history: &History) {
        self.progress_at(env_steps, scalars, history, self.started.elapsed());
    }

    fn progress_at(&mut self, env_steps: u64, scalars: &Scalars, history: &History, elapsed: Duration) {
        self.waited = Duration::ZERO;
        self.env_steps = env_steps;
        let steps_per_s = value_of(scalars, "time/fps").unwrap_or(0.0);
        let speed = speed_and_remaining(steps_per_s, self.total_steps.saturating_sub(env_steps));
        if let Some(bar) = &self.bar {
            bar.set_position(env_steps);
            bar.set_message(speed);
            if let Some(sparklines) = sparklines(history, self.is_unicode) {
                if bar.prefix().is_empty() {
                    set_template(bar, SPARKLINE_AND_BAR);
                }
                bar.set_prefix(sparklines);
            }
            if elapsed >= self.due {
                self.due = elapsed + TABLE_EVERY;
                self.write(&render_table(&important(scalars)));
            }
        } else if self.options.show_progress && elapsed >= self.due {
            self.due = elapsed + LINE_EVERY;
            self.write(&(line(env_steps, self.total_steps, &speed, scalars, history) + "\n"));
        }
    }

    /// Writes a line with sparklines, if there are any.
    fn write_sparklines(&mut self, history: &History, elapsed: Duration) {
        if let Some(sparklines) = sparklines(history, self.is_unicode) {
            self.write(&format!("after {}: {sparklines}\n", clock(elapsed.as_secs())));
        }
    }

    /// Reports a long wait for experience, then again each time it has doubled. `actors` are alive.
    pub fn show_wait(&mut self, waited: Duration, actors: usize) {
        let threshold = if actors > 0 && self.env_steps > self.start_steps { WAIT_MIN } else { FIRST_WAIT_MIN };
        if waited < threshold.max(self.waited * 2) || !self.options.show_progress {
            return;
        }
        self.waited = waited;
        let alive = match actors {
            0 => match &self.options.actor_command {
                Some(command) => format!("no actor is connected; start one: {command}"),
                None => "no actor is connected".to_string(),
            },
            1 => "1 actor is simulating".to_string(),
            actors => format!("{actors} actors are simulating"),
        };
        let message = format!("waiting for experience for {}: {alive}", clock(waited.as_secs()));
        match &self.bar {
            Some(bar) => bar.set_message(message),
            None => self.write(&format!("{message}\n")),
        }
    }

    /// Writes all scalars of one update, if the options ask for them: a boxed table on a terminal, elsewhere one line
    /// `steps=… tag=value …`.
    pub fn table(&mut self, scalars: &Scalars) {
        if !self.options.log_metrics {
            return;
        }
        let text = if self.is_terminal { render_table(scalars) } else { render_line(self.env_steps, scalars) + "\n" };
        self.write(&text);
    }

    /// Removes the bar and writes steps, mean speed and the last sparklines. Only the first call has an effect.
    pub fn finish(&mut self, history: &History) {
        if std::mem::replace(&mut self.finished, true) {
            return;
        }
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
        if self.options.show_progress {
            let elapsed = self.started.elapsed();
            let steps = self.env_steps.saturating_sub(self.start_steps);
            let speed = steps as f64 / elapsed.as_secs_f64().max(f64::MIN_POSITIVE);
            let [now, total, speed] = [self.env_steps, self.total_steps, speed as u64].map(thousands);
            self.write(&format!("steps {now} of {total}, {} at {speed} steps/s\n", clock(elapsed.as_secs())));
            self.write_sparklines(history, elapsed);
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

fn new_bar(total_steps: u64, start_steps: u64) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(total_steps), ProgressDrawTarget::stdout()).with_position(start_steps);
    set_template(&bar, BAR);
    bar.set_message("waiting for the first steps");
    bar
}

/// Sets the bar's template. Both templates are constants; with an invalid one the bar would keep its style.
fn set_template(bar: &ProgressBar, template: &str) {
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style.progress_chars("=> "));
    }
}

fn value_of(scalars: &Scalars, tag: &str) -> Option<f64> {
    scalars.iter().find(|(name, _)| name == tag).map(|(_, value)| *value)
}

/// Returns `155,648 of 8,000,000 steps (1.9 %), 7,412 steps/s, 17m 38s left; return 412, length 85, …`.
fn line(env_steps: u64, total_steps: u64, speed: &str, scalars: &Scalars, history: &History) -> String {
    let percent = env_steps as f64 / total_steps.max(1) as f64 * 100.0;
    let known = |tag| value_of(scalars, tag);
    let parts = [
        known("rollout/ep_rew_mean").map(|value| format!("return {}", rounded(value, 0))),
        known("rollout/ep_len_mean").map(|value| format!("length {}", rounded(value, 0))),
        match history.figures {
            RunFigures::Tracking => obeyed(history),
            RunFigures::Imitation => history.imitated.map(imitation),
            RunFigures::Distance => {
                known("rollout/distance_mean_m").map(|value| format!("distance {} m", rounded(value, 1)))
            }
        },
        known("rollout/fall_fraction").map(|share| format!("falls {} %", rounded(100.0 * share, 0))),
        known("rollout/used_share").map(|value| format!("used {} %", rounded(100.0 * value, 0))),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    let separator = if parts.is_empty() { "" } else { "; " };
    let (now, total) = (thousands(env_steps), thousands(total_steps));
    format!("{now} of {total} steps ({percent:.1} %), {speed}{separator}{}", parts.join(", "))
}

/// Returns the errors of the last evaluation; `None` before the first one.
fn obeyed(history: &History) -> Option<String> {
    let [velocity, yaw_rate] = history.tracking_errors?;
    Some(format!("errors {} m/s and {} rad/s", rounded(velocity, 2), rounded(yaw_rate, 2)))
}

/// Describes how a motion was done: the share that was done, and the mean error of the links (m).
pub fn imitation([done_share, body_error_m]: [f64; 2]) -> String {
    let (done, error_cm) = (rounded(100.0 * done_share, 0), rounded(100.0 * body_error_m, 1));
    format!("{done} % of the motion done, links off by {error_cm} cm")
}

/// Returns `return 310 → 620 (best 640) ▁▃▆█, distance 0.1 → 1.9 m ▁▂▅█`, or `None` before an episode ends. Where the task
/// has commands or motions, the errors of the last evaluation stand for the distance.
fn sparklines(history: &History, is_unicode: bool) -> Option<String> {
    let arrow = if is_unicode { '→' } else { '>' };
    let curve = |of: fn(&Point) -> f64, best: Option<f64>, decimals, unit: &str| {
        let values: Vec<f64> = history.points().map(|point| of(&point)).collect();
        let best = best.unwrap_or_else(|| values.iter().copied().fold(f64::NEG_INFINITY, f64::max));
        let [first, now, best] = [*values.first()?, *values.last()?, best].map(|value| rounded(value, decimals));
        let best = if best == now { String::new() } else { format!(" (best {best})") };
        Some(format!("{first} {arrow} {now}{unit}{best} {}", sparkline(&values, SPARKLINE_WIDTH, is_unicode)))
    };
    let returns = curve(|point| point.return_mean, None, 0, "")?;
    let moved = match history.figures {
        RunFigures::Tracking => obeyed(history),
        RunFigures::Imitation => history.imitated.map(imitation),
        RunFigures::Distance => {
            Some(format!("distance {}", curve(|point| point.distance_m, history.best_m(), 1, " m")?))
        }
    };
    Some(std::iter::once(format!("return {returns}")).chain(moved).collect::<Vec<_>>().join(", "))
}

/// Rounds to `decimals`, without negative zero.
fn rounded(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let is_zero = text.bytes().all(|byte| matches!(byte, b'-' | b'0' | b'.'));
    if is_zero { text.trim_start_matches('-').to_string() } else { text }
}

/// Returns text such as `3,412 steps/s, 4m 05s left`.
fn speed_and_remaining(steps_per_s: f64, steps_left: u64) -> String {
    if steps_per_s <= 0.0 {
        return "0 steps/s".to_string();
    }
    let left = clock((steps_left as f64 / steps_per_s).ceil() as u64);
    format!("{} steps/s, {left} left", thousands(steps_per_s.round() as u64))
}

/// Returns text such as `5s`, `4m 05s`, `3h 04m` or `2d 03h`.
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
