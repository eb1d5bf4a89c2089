//! Styles of the dashboard, and its appearance on simple terminals.

use ratatui::{
    buffer::Buffer,
    style::{Color, Modifier, Style},
};
use treadmill_runtime::words::ascii;

/// Names and headings.
pub const STRONG: Style = Style::new().add_modifier(Modifier::BOLD);
/// Explanations.
pub const QUIET: Style = Style::new().add_modifier(Modifier::DIM);
/// Good states.
pub const GOOD: Style = Style::new().fg(Color::Green);
/// Warnings.
pub const WARNING: Style = Style::new().fg(Color::Yellow).add_modifier(Modifier::BOLD);
/// Bad states.
pub const BAD: Style = Style::new().fg(Color::Red).add_modifier(Modifier::BOLD);
/// Curves and bars.
pub const CURVE: Style = Style::new().fg(Color::Cyan);

/// Returns whether colours are wanted: `NO_COLOR` is not set (<https://no-color.org>).
pub fn is_coloured() -> bool {
    std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}

/// Removes colours, so that only the weight of text differs.
pub fn remove_colours(buffer: &mut Buffer) {
    for cell in &mut buffer.content {
        (cell.fg, cell.bg) = (Color::Reset, Color::Reset);
    }
}

/// Replaces what a terminal without Unicode cannot show.
pub fn replace_unicode(buffer: &mut Buffer) {
    for cell in &mut buffer.content {
        if let Some(shown) = cell.symbol().chars().next().filter(|_| !cell.symbol().is_ascii()) {
            cell.set_char(ascii(shown));
        }
    }
}
