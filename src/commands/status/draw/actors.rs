//! Table of actors, with as many rows and columns as fit.

use ratatui::{
    Frame,
    layout::{Constraint, Layout, Rect},
    style::Style,
    text::{Line, Span},
    widgets::{Paragraph, Row, Table},
};
use treadmill_proto::{ActorStats, ActorStatus};

use super::{
    figures::{UNKNOWN, duration, number, plain, short},
    pieces::Pieces,
    theme::{BAD, GOOD, QUIET, STRONG, WARNING},
};
use crate::{
    commands::status::{
        fleet::Fleet,
        plain::{fleet_rate, state},
    },
    shared::foreign_text::shorten,
};

/// Columns at the right end of the last line for the range of actors shown.
pub const RANGE_WIDTH: u16 = 20;
/// Columns that a long name gets before other columns.
const NAME_WIDTH: u16 = 20;

/// Column beside the name.
struct Column {
    title: &'static str,
    width: u16,
    text: fn(&ActorStatus) -> String,
}

fn stats(actor: &ActorStatus, text: impl FnOnce(&ActorStats) -> String) -> Option<String> {
    actor.stats.as_ref().map(text)
}

fn or_unknown(text: Option<String>) -> String {
    text.filter(|text| !text.is_empty()).unwrap_or_else(|| UNKNOWN.to_string())
}

/// Columns from left to right, the most important first.
const COLUMNS: [Column; 11] = [
    Column { title: "state", width: 11, text: |a| state(a).to_string() },
    Column { title: "steps/s", width: 7, text: |a| or_unknown(stats(a, |s| number(s.env_steps_per_s))) },
    Column { title: "lag", width: 5, text: |a| or_unknown(a.lag_versions.map(short)) },
    Column { title: "contact", width: 7, text: |a| or_unknown(a.since_contact_s.map(duration)) },
    Column { title: "host", width: 14, text: |a| or_unknown(stats(a, |s| shorten(&plain(&s.host), 14))) },
    Column {
        title: "policy",
        width: 6,
        text: |a| or_unknown(a.stats.as_ref().and_then(|s| s.version).map(|version| short(version.number))),
    },
    Column { title: "version", width: 8, text: |a| or_unknown(stats(a, |s| shorten(&plain(&s.program_version), 8))) },
    Column { title: "envs", width: 5, text: |a| or_unknown(stats(a, |s| short(s.envs.into()))) },
    Column { title: "dropped", width: 7, text: |a| or_unknown(stats(a, |s| short(s.dropped_by_rule))) },
    Column { title: "resent", width: 6, text: |a| or_unknown(stats(a, |s| short(s.resent))) },
    Column { title: "MB", width: 7, text: |a| or_unknown(stats(a, |s| number(s.resident_bytes as f64 / 1e6))) },
];

/// Returns the columns that fit beside a name of this width.
fn fitting(width: u16, name_width: u16) -> &'static [Column] {
    let mut width_left = width.saturating_sub(name_width);
    let fits = |column: &&Column| {
        let left = width_left.checked_sub(column.width + 1);
        width_left = left.unwrap_or(0);
        left.is_some()
    };
    &COLUMNS[..COLUMNS.iter().take_while(fits).count()]
}

/// Draws the table, and the range of actors shown in `keys`.
pub fn draw(frame: &mut Frame, area: Rect, keys: Rect, fleet: &mut Fleet, has_heading: bool) {
    let [heading, table] = Layout::vertical([Constraint::Length(has_heading.into()), Constraint::Fill(1)]).areas(area);
    let visible_rows = usize::from(table.height.saturating_sub(1));
    let first = fleet.show(visible_rows);
    let actors = fleet.actors();
    let Some((run, ..)) = fleet.selected() else { return };
    if has_heading {
        let alive = actors.iter().filter(|actor| actor.alive).count();
        let quarantined = actors.iter().filter(|actor| actor.quarantined).count();
        let mut pieces = Pieces::new(heading.width);
        pieces.push(format!("actors {alive} alive"), STRONG);
        pieces.push(format!("{} steps/s together", number(fleet_rate(&run.status))), QUIET);
        if quarantined > 0 {
            pieces.push(format!("{quarantined} in quarantine"), BAD);
        }
        pieces.push(format!("by {}", fleet.order_name()), QUIET);
        frame.render_widget(pieces.line(), heading);
    }
    if actors.is_empty() {
        return frame.render_widget(Paragraph::new("no actors yet").style(QUIET), table);
    }
    let shown = &actors[first..actors.len().min(first + visible_rows)];
    let longest = shown.iter().map(|actor| actor.name.chars().count()).max().unwrap_or_default();
    let longest = u16::try_from(longest).unwrap_or(u16::MAX).max(4);
    let columns = fitting(table.width, longest.min(NAME_WIDTH).min(table.width / 3));
    let others: u16 = columns.iter().map(|column| column.width + 1).sum();
    let name_width = longest.min(table.width.saturating_sub(others));
    let widths = std::iter::once(name_width).chain(columns.iter().map(|column| column.width)).map(Constraint::Length);
    let titles = std::iter::once(Line::from("name"))
        .chain(columns.iter().map(|column| aligned(column, column.title.to_string(), Style::new())));
    let rows = shown.iter().map(|actor| {
        let name = Line::from(shorten(&actor.name, name_width.into()));
        let cells = columns.iter().map(|column| aligned(column, (column.text)(actor), style(actor, column)));
        Row::new(std::iter::once(name).chain(cells))
    });
    let rows: Vec<Row> = rows.collect();
    frame.render_widget(Table::new(rows, widths).header(Row::new(titles).style(QUIET)).column_spacing(1), table);
    let range = format!(
        "{}–{} of {}",
        short(first as u64 + 1),
        short((first + shown.len()) as u64),
        short(actors.len() as u64)
    );
    frame.render_widget(Line::styled(range, QUIET).right_aligned(), keys);
}

/// Aligns numbers to the right and words to the left.
fn aligned(column: &Column, text: String, style: Style) -> Line<'static> {
    let line = Line::from(Span::styled(text, style));
    if matches!(column.title, "host" | "version" | "state") { line } else { line.right_aligned() }
}

fn style(actor: &ActorStatus, column: &Column) -> Style {
    match (column.title, actor.quarantined, actor.alive) {
        ("state", true, _) => BAD,
        ("state", false, true) => GOOD,
        ("state", false, false) => WARNING,
        _ => Style::new(),
    }
}
