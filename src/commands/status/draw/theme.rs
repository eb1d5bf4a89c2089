//! Colours of the dashboard.

use ratatui::style::{Color, Modifier, Style};

/// Styles of text. Without colours, only the weight differs.
#[derive(Clone, Copy, Debug)]
pub struct Theme {
    coloured: bool,
}

impl Theme {
    /// Creates a theme with or without colours.
    pub fn new(coloured: bool) -> Self {
        Self { coloured }
    }

    /// Creates a theme without colours if `NO_COLOR` is set (<https://no-color.org>).
    pub fn of_environment() -> Self {
        Self::new(std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty()))
    }

    /// Returns the style of names and headings.
    pub fn strong(&self) -> Style {
        Style::new().add_modifier(Modifier::BOLD)
    }

    /// Returns the style of explanations.
    pub fn quiet(&self) -> Style {
        Style::new().add_modifier(Modifier::DIM)
    }

    /// Returns the style of a good state.
    pub fn good(&self) -> Style {
        self.colour(Color::Green)
    }

    /// Returns the style of a warning.
    pub fn warning(&self) -> Style {
        self.colour(Color::Yellow).add_modifier(Modifier::BOLD)
    }

    /// Returns the style of a bad state.
    pub fn bad(&self) -> Style {
        self.colour(Color::Red).add_modifier(Modifier::BOLD)
    }

    /// Returns the style of curves and bars.
    pub fn curve(&self) -> Style {
        self.colour(Color::Cyan)
    }

    fn colour(&self, colour: Color) -> Style {
        if self.coloured { Style::new().fg(colour) } else { Style::new() }
    }
}
