//! Line of text pieces; a piece that does not fit is omitted as a whole.

use ratatui::{
    style::Style,
    text::{Line, Span},
};

/// Separator of two pieces.
const GAP: &str = "  ";

/// Pieces of one line, the most important first.
#[derive(Debug)]
pub struct Pieces {
    line: Line<'static>,
    width_left: usize,
}

impl Pieces {
    /// Creates an empty line of this width.
    pub fn new(width: u16) -> Self {
        Self { line: Line::default(), width_left: width.into() }
    }

    /// Adds a piece if it fits.
    pub fn push(&mut self, text: impl Into<String>, style: Style) {
        let gap = (!self.line.spans.is_empty()).then_some(Span::raw(GAP));
        let piece = Span::styled(text.into(), style);
        let needed = piece.width() + gap.as_ref().map_or(0, Span::width);
        if piece.width() > 0 && needed <= self.width_left {
            self.width_left -= needed;
            self.line.spans.extend(gap.into_iter().chain([piece]));
        }
    }

    /// Returns the line.
    pub fn line(self) -> Line<'static> {
        self.line
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_whole_or_omitted() {
        let mut pieces = Pieces::new(12);
        pieces.push("walk-1", Style::new());
        pieces.push("too long", Style::new());
        pieces.push("4 %", Style::new());
        assert_eq!(pieces.line().to_string(), "walk-1  4 %");
    }
}
