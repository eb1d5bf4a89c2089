//! Policy lag of the last batch.

use ratatui::{
    Frame,
    layout::Rect,
    text::Line,
    widgets::{Bar, BarChart, BarGroup, Block, Paragraph},
};

use super::{
    Theme,
    figures::{number, percent},
    pieces::Pieces,
};
use crate::commands::status::fleet::Run;

/// Labels of the histogram's bins.
const NAMES: [&str; 6] = ["0", "1", "2", "3", "4", "5+"];
/// Characters for shares.
const HEIGHTS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
/// Smallest width with the shares as numbers.
const NUMBERS_WIDTH_MIN: u16 = 78;

/// Draws one line: mean and histogram.
pub fn draw(frame: &mut Frame, area: Rect, run: &Run, theme: &Theme) {
    let mut pieces = Pieces::new(area.width);
    pieces.push(format!("lag {} mean", number(run.lag_mean())), theme.strong());
    match run.lags() {
        Some(lags) if area.width >= NUMBERS_WIDTH_MIN => {
            for (name, share) in NAMES.iter().zip(lags) {
                pieces.push(format!("{name} {}{}", height(share), percent(share).replace(' ', "")), theme.curve());
            }
        }
        Some(lags) => {
            pieces.push(lags.map(height).iter().collect::<String>(), theme.curve());
            pieces.push("0 to 5+ versions", theme.quiet());
        }
        None => {
            pieces.push("versions", theme.quiet());
        }
    }
    frame.render_widget(pieces.line(), area);
}

fn height(share: f64) -> char {
    match share {
        share if share > 0.0 => HEIGHTS[((share * HEIGHTS.len() as f64) as usize).min(HEIGHTS.len() - 1)],
        _ => '·',
    }
}

/// Draws the histogram as a bar chart.
pub fn draw_bars(frame: &mut Frame, area: Rect, run: &Run, theme: &Theme) {
    let block = Block::new().title(Line::styled("lag in versions", theme.strong()));
    let Some(lags) = run.lags() else {
        return frame.render_widget(Paragraph::new("nothing yet").style(theme.quiet()).block(block), area);
    };
    let bars: Vec<Bar> = NAMES
        .iter()
        .zip(lags)
        .map(|(name, share)| {
            Bar::default()
                .value((share * 100.0).round() as u64)
                .label(*name)
                .style(theme.curve())
                .value_style(theme.curve())
        })
        .collect();
    let width = area.width.saturating_sub(NAMES.len() as u16) / NAMES.len() as u16;
    let chart = BarChart::default().block(block).data(BarGroup::default().bars(&bars)).bar_width(width.max(1)).max(100);
    frame.render_widget(chart, area);
}
