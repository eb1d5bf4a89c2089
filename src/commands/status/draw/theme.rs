//! Colours, or none of them.

use ratatui::style::{Color, Modifier, Style};

/// How things are set off. Without colours, by weight alone.
#[derive(Clone, Copy, Debug)]
pub struct Theme {
    coloured: bool,
}

impl Theme {
    /// With or without colours.
    pub fn new(coloured: bool) -> Self {
        Self { coloured }
    }

    /// Without colours where `NO_COLOR` says so (<https://no-color.org>).
    pub fn of_environment() -> Self {
        Self::new(std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty()))
    }

    /// Of names and headings.
    pub fn strong(&self) -> Style {
        Style::new().add_modifier(Modifier::BOLD)
    }

    /// Of what explains.
    pub fn quiet(&self) -> Style {
        Style::new().add_modifier(Modifier::DIM)
    }

    /// Of what goes well.
    pub fn good(&self) -> Style {
        self.colour(Color::Green)
    }

    /// Of what should be looked at.
    pub fn warning(&self) -> Style {
        self.colour(Color::Yellow).add_modifier(Modifier::BOLD)
    }

    /// Of what is shut out or gone.
    pub fn bad(&self) -> Style {
        self.colour(Color::Red).add_modifier(Modifier::BOLD)
    }

    /// Of curves and bars.
    pub fn curve(&self) -> Style {
        self.colour(Color::Cyan)
    }

    fn colour(&self, colour: Color) -> Style {
        if self.coloured { Style::new().fg(colour) } else { Style::new() }
    }
}
