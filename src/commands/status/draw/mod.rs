//! Drawing of the dashboard's state.
//!
//! # Layout
//! - [`header`]: name of the run, progress and speed.
//! - [`curves`]: return, distance, velocity and speed over environment steps.
//! - [`actors`]: table of actors.
//! - [`figures`], [`pieces`], [`theme`]: numbers, lines and colours.

mod actors;
mod curves;
mod figures;
mod header;
mod pieces;
#[cfg(test)]
mod tests;
mod theme;

use std::time::Instant;

use ratatui::{
    Frame,
    layout::{Constraint, Layout, Rect},
    text::Line,
    widgets::{Block, Clear, Paragraph, Wrap},
};

pub use self::theme::{is_coloured, remove_colours, replace_unicode};
use self::{
    pieces::Pieces,
    theme::{QUIET, STRONG},
};
use super::{
    fleet::{Fleet, Run},
    keys::HELP,
};
use crate::shared::foreign_text::printable;

/// Smallest terminal that is supported.
const WIDTH_MIN: u16 = 40;
const HEIGHT_MIN: u16 = 10;
/// Smallest terminal with curves.
const CURVES_WIDTH_MIN: u16 = 70;
const CURVES_HEIGHT_MIN: u16 = 18;
const CURVES_HEIGHT_MAX: u16 = 24;
/// Smallest height with a line above the table and one about fragments.
const HEADINGS_HEIGHT_MIN: u16 = 14;
/// Most characters of why no learner answers.
const SILENCE_CHARS_MAX: usize = 2000;
/// Most lines of alarms.
const ALARM_LINES_MAX: u16 = 3;

/// Draws the whole dashboard.
pub fn draw(frame: &mut Frame, fleet: &mut Fleet, now: Instant) {
    let area = frame.area();
    if area.width < WIDTH_MIN || area.height < HEIGHT_MIN {
        let needed =
            format!("This needs {WIDTH_MIN}×{HEIGHT_MIN} characters; here are {}×{}.", area.width, area.height);
        return frame.render_widget(Paragraph::new(needed).wrap(Wrap { trim: true }), area);
    }
    let [body, keys] = Layout::vertical([Constraint::Fill(1), Constraint::Length(1)]).areas(area);
    match fleet.selected() {
        Some((run, which, of)) => {
            let rest = draw_run(frame, body, run, (which, of), fleet.silence.is_some(), now);
            actors::draw(frame, rest, keys, fleet, area.height >= HEADINGS_HEIGHT_MIN);
        }
        None => {
            let text = fleet.silence.as_deref().unwrap_or("asking the learners");
            frame.render_widget(Paragraph::new(printable(text, SILENCE_CHARS_MAX)).wrap(Wrap { trim: true }), body);
        }
    }
    // The range of actors at the right end has priority over the last keys.
    let left = Rect { width: keys.width.saturating_sub(actors::RANGE_WIDTH), ..keys };
    let mut pieces = Pieces::new(left.width);
    for (key, what) in [("q", "quit"), ("?", "help"), ("↑↓", "scroll"), ("s", "order"), ("Tab", "run")] {
        pieces.push(format!("{key} {what}"), QUIET);
    }
    frame.render_widget(pieces.line(), left);
    if fleet.shows_help {
        draw_help(frame, area);
    }
}

/// Draws everything about the run itself, and returns the rest of the area.
fn draw_run(frame: &mut Frame, area: Rect, run: &Run, place: (usize, usize), silent: bool, now: Instant) -> Rect {
    let has_curves = area.width >= CURVES_WIDTH_MIN && area.height + 1 >= CURVES_HEIGHT_MIN;
    let has_fragments = area.height + 1 >= HEADINGS_HEIGHT_MIN;
    let curves_height = if has_curves { ((area.height - 5) / 2).clamp(6, CURVES_HEIGHT_MAX) } else { 1 };
    let alarms = (run.status.alarms.len() as u16).min(ALARM_LINES_MAX).min(area.height / 8);
    let [head, alarm_area, curves_area, fragments, rest] = Layout::vertical([
        Constraint::Length(3),
        Constraint::Length(alarms),
        Constraint::Length(curves_height),
        Constraint::Length(has_fragments.into()),
        Constraint::Fill(1),
    ])
    .areas(area);
    header::draw(frame, head, run, place, silent, now);
    header::alarms(frame, alarm_area, run);
    match has_curves {
        true => curves::draw(frame, curves_area, run),
        false => curves::draw_line(frame, curves_area, run),
    }
    if has_fragments {
        header::fragments(frame, fragments, run);
    }
    rest
}

fn draw_help(frame: &mut Frame, area: Rect) {
    let lines: Vec<Line> = HELP.iter().map(|(keys, what)| Line::from(format!("{keys:<15} {what}"))).collect();
    let height = (lines.len() as u16 + 2).min(area.height);
    let width = WIDTH_MIN.min(area.width);
    let place = Rect { x: area.x + (area.width - width) / 2, y: area.y + (area.height - height) / 2, width, height };
    frame.render_widget(Clear, place);
    frame.render_widget(Paragraph::new(lines).block(Block::bordered().title(Line::styled("keys", STRONG))), place);
}
