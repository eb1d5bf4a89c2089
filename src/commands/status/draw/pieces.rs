//! A line of pieces: what does not fit is left out whole, and nothing is cut in the middle.

use ratatui::{
    style::Style,
    text::{Line, Span},
};

/// Between two pieces.
const GAP: &str = "  ";

/// Pieces that are put side by side, the most important first.
#[derive(Debug)]
pub struct Pieces {
    pieces: Vec<Span<'static>>,
    width_left: usize,
}

impl Pieces {
    /// An empty line of this width.
    pub fn new(width: u16) -> Self {
        Self { pieces: Vec::new(), width_left: width.into() }
    }

    /// Adds a piece if it fits; columns that are left after it.
    pub fn push(&mut self, text: impl Into<String>, style: Style) -> usize {
        let piece = Span::styled(text.into(), style);
        let needed = piece.width() + if self.pieces.is_empty() { 0 } else { GAP.len() };
        if piece.width() > 0 && needed <= self.width_left {
            self.width_left -= needed;
            self.pieces.push(piece);
        }
        self.width_left
    }

    /// The line.
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

    /// The line, of as many pieces as fit into less.
    pub fn fitted(self, width: u16) -> Line<'static> {
        let mut fitted = Self::new(width);
        for piece in self.pieces {
            let style = piece.style;
            fitted.push(piece.content, style);
        }
        fitted.line()
    }
}

/// A name in at most `width` columns: what is left out is in the middle, because names differ at their ends.
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
    fn pieces_are_whole_or_left_out_and_names_keep_their_ends() {
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
