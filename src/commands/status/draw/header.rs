//! Name of the run, progress and speed.

use std::time::{Duration, Instant};

use ratatui::{
    Frame,
    layout::{Constraint, Layout, Rect},
};
use treadmill_proto::{Phase, PoolDemand, RunStatus};

use super::{
    figures::{count, duration, known, number, percent, plain, short},
    pieces::Pieces,
    theme::{BAD, CURVE, GOOD, QUIET, STRONG, WARNING},
};
use crate::{
    commands::status::fleet::Run,
    shared::foreign_text::{printable, shorten},
};

/// Time without an answer after which a run is shown as silent.
const SILENT_AFTER: Duration = Duration::from_secs(6);
/// Width below which words are shortened.
const NARROW: u16 = 60;
/// Most and fewest columns of the progress bar.
const BAR_MAX: usize = 40;
const BAR_MIN: usize = 4;

/// Draws three lines: title, progress and traffic.
pub fn draw(frame: &mut Frame, area: Rect, run: &Run, place: (usize, usize), silent: bool, now: Instant) {
    let [title, progress, traffic] = Layout::vertical([Constraint::Length(1); 3]).areas(area);
    let silent_for = now.saturating_duration_since(run.answered);
    let silent_for = (silent || silent_for >= SILENT_AFTER).then_some(silent_for);
    frame.render_widget(title_line(title.width, run, place, silent_for).line(), title);
    frame.render_widget(progress_line(progress.width, &run.status).line(), progress);
    frame.render_widget(traffic_line(traffic.width, run).line(), traffic);
}

fn title_line(width: u16, run: &Run, place: (usize, usize), silent_for: Option<Duration>) -> Pieces {
    let status = &run.status;
    let mut pieces = Pieces::new(width);
    let (phase, style) = match (silent_for, status.phase()) {
        (Some(silent_for), _) => (format!("learner gone, silent for {}", duration(silent_for.as_secs_f64())), BAD),
        (None, Phase::Paused) => ("paused".to_string(), WARNING),
        (None, Phase::Stopping) => ("stopping".to_string(), WARNING),
        (None, Phase::Training | Phase::Unspecified) => ("training".to_string(), GOOD),
    };
    let width_left = usize::from(width).saturating_sub(phase.chars().count() + 2);
    pieces.push(shorten(&status.run, width_left), STRONG);
    pieces.push(phase, style);
    if place.1 > 1 {
        pieces.push(format!("run {} of {}", place.0, place.1), QUIET);
    }
    pieces.push(format!("on {}", plain(&status.host)), QUIET);
    pieces.push(format!("process {}", status.pid), QUIET);
    pieces.push(format!("version {}", plain(&status.program_version)), QUIET);
    pieces
}

fn progress_line(width: u16, status: &RunStatus) -> Pieces {
    let share = status.env_steps as f64 / status.env_steps_wanted.max(1) as f64;
    let left_s = status.env_steps_wanted.saturating_sub(status.env_steps) as f64 / status.env_steps_per_s;
    let how = if width < NARROW { short } else { count };
    let mut words = vec![percent(share), format!("{} of {}", how(status.env_steps), how(status.env_steps_wanted))];
    if width >= NARROW {
        words[1] += " steps";
        words.push(format!("{} elapsed", duration(status.wall_s)));
    }
    words.push(format!("{} to go", duration(left_s)));
    let needed: usize = words.iter().map(|word| word.chars().count() + 2).sum();
    let bar = usize::from(width).saturating_sub(needed).min(BAR_MAX);
    let mut pieces = Pieces::new(width);
    if bar >= BAR_MIN {
        let done = (share.clamp(0.0, 1.0) * bar as f64).round() as usize;
        pieces.push("█".repeat(done) + &"░".repeat(bar - done), CURVE);
    }
    for word in words {
        pieces.push(word, STRONG);
    }
    pieces
}

fn traffic_line(width: u16, run: &Run) -> Pieces {
    let status = &run.status;
    let fragments = if width < NARROW { "frag" } else { "fragments" };
    let mut pieces = Pieces::new(width);
    pieces.push(format!("{} steps/s", number(status.env_steps_per_s)), STRONG);
    pieces.push(format!("{} {fragments}/s", known(run.fragments.per_s())), STRONG);
    let mb_per_s = (status.accepted_bytes > 0).then(|| run.bytes.per_s()).flatten().map(|bytes| bytes / 1e6);
    pieces.push(format!("{} MB/s", known(mb_per_s)), STRONG);
    pieces.push(format!("{} updates", count(status.updates)), QUIET);
    pieces.push(format!("the last {} ago", duration(status.since_update_s)), QUIET);
    if let Some(share) = status.used_share {
        pieces.push(format!("{} used", percent(share)), STRONG);
    }
    if let Some(share) = status.idle_share {
        pieces.push(format!("{} idle", percent(share)), QUIET);
    }
    if let Some(pool) = status.pool.as_ref().filter(|pool| pool.pool_actors > 0) {
        let PoolDemand { envs, envs_target, pool_envs, share, .. } = pool;
        pieces.push(
            format!("pool: {envs} of {envs_target} envs due, {pool_envs} in all, share {}", number(*share)),
            STRONG,
        );
    }
    pieces.push(format!("learner {} MB", number(status.resident_bytes as f64 / 1e6)), QUIET);
    pieces
}

/// Draws an alarm on each line.
pub fn alarms(frame: &mut Frame, area: Rect, run: &Run) {
    for (alarm, line) in run.status.alarms.iter().zip(area.rows()) {
        let mut pieces = Pieces::new(area.width);
        pieces.push(shorten(&printable(alarm, area.width.into()), area.width.into()), BAD);
        frame.render_widget(pieces.line(), line);
    }
}

/// Draws the mean policy lag, and the counts of fragments by outcome; zeros are omitted.
pub fn fragments(frame: &mut Frame, area: Rect, run: &Run) {
    let status = &run.status;
    let mut pieces = Pieces::new(area.width);
    pieces.push(format!("lag {} mean", number(status.policy_lag_mean)), STRONG);
    pieces.push("fragments", QUIET);
    pieces.push(format!("{} accepted", count(status.accepted)), QUIET);
    for (name, fragments, style) in [
        ("malformed", status.malformed, BAD),
        ("quarantined", status.quarantined, BAD),
        ("too old", status.too_old, WARNING),
        ("vanished", status.vanished, WARNING),
        ("duplicate", status.duplicate, QUIET),
    ] {
        if fragments > 0 {
            pieces.push(format!("{} {name}", count(fragments)), style);
        }
    }
    frame.render_widget(pieces.line(), area);
}
