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
    pieces: Vec<Span<'static>>,
    width_left: usize,
}

impl Pieces {
    /// Creates an empty line of this width.
    pub fn new(width: u16) -> Self {
        Self { pieces: Vec::new(), width_left: width.into() }
    }

    /// Adds a piece if it fits, and returns the columns left.
    pub fn push(&mut self, text: impl Into<String>, style: Style) -> usize {
        let piece = Span::styled(text.into(), style);
        let needed = piece.width() + if self.pieces.is_empty() { 0 } else { GAP.len() };
        if piece.width() > 0 && needed <= self.width_left {
            self.width_left -= needed;
            self.pieces.push(piece);
        }
        self.width_left
    }

    /// Returns the line.
    pub fn line(self) -> Line<'static> {
        let mut spans = Vec::with_capacity(self.pieces.len() * 2);
        for piece in self.pieces {
            if !spans.is_empty() {
                spans.push(Span::raw(GAP));
            }
            spans.push(piece);
        }
        Line::from(spans)
    }

    /// Returns the line with as many pieces as fit into `width`.
    pub fn fitted(self, width: u16) -> Line<'static> {
        let mut fitted = Self::new(width);
        for piece in self.pieces {
            let style = piece.style;
            fitted.push(piece.content, style);
        }
        fitted.line()
    }
}

/// Shortens a name to `width` columns in its middle, because names differ at their ends.
pub fn shorten(name: &str, width: usize) -> String {
    if Span::raw(name).width() <= width {
        return name.to_string();
    }
    let mut kept: Vec<char> = name.chars().collect();
    loop {
        if kept.is_empty() {
            return String::new();
        }
        let middle = kept.len() / 2;
        kept.remove(middle);
        let (front, back) = kept.split_at(middle);
        let short: String = front.iter().chain(['…'].iter()).chain(back).collect();
        if Span::raw(&short).width() <= width {
            return short;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_whole_or_omitted_and_names_keep_their_ends() {
        let mut pieces = Pieces::new(12);
        pieces.push("walk-1", Style::new());
        assert_eq!(pieces.push("too long", Style::new()), 6);
        assert_eq!(pieces.push("4 %", Style::new()), 1);
        assert_eq!(pieces.line().to_string(), "walk-1  4 %");
        assert_eq!(shorten("actor-0", 7), "actor-0");
        assert_eq!(shorten("actor-0123456789", 9), "acto…6789");
        // Each of these takes two columns.
        assert_eq!(shorten("日本語の名前", 7), "日本…前");
        assert_eq!([shorten("abc", 1), shorten("abc", 0)], ["…", ""]);
    }
}
