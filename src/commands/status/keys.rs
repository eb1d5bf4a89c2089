//! Keys of the dashboard and their actions.

use ratatui::crossterm::event::{Event, KeyCode, KeyEventKind, KeyModifiers};

/// What a key does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeyAction {
    /// Quits.
    Quit,
    /// Shows or hides the help.
    Help,
    /// Hides the help.
    Back,
    /// Selects the next run.
    NextRun,
    /// Selects the previous run.
    PreviousRun,
    /// Changes the order of the actors.
    Order,
    /// Scrolls up by one actor.
    Up,
    /// Scrolls down by one actor.
    Down,
    /// Scrolls up by one page.
    PageUp,
    /// Scrolls down by one page.
    PageDown,
    /// Scrolls to the first actor.
    First,
    /// Scrolls to the last actor.
    Last,
}

/// Lines of the help: keys and their effect.
pub const HELP: [(&str, &str); 7] = [
    ("q, Esc, Ctrl-C", "quit; runs continue"),
    ("Tab, Shift-Tab", "next or previous run"),
    ("↑ ↓, k j", "scroll the actors"),
    ("PgUp PgDn, b f", "scroll by a page"),
    ("Home End, g G", "first or last actor"),
    ("s", "change the order"),
    ("?", "show or hide this help"),
];

/// Returns the action of an event; `shows_help` is true while the help is shown.
pub fn action(event: &Event, shows_help: bool) -> Option<KeyAction> {
    let Event::Key(key) = event else { return None };
    if key.kind == KeyEventKind::Release {
        return None;
    }
    if key.modifiers.contains(KeyModifiers::CONTROL) {
        return matches!(key.code, KeyCode::Char('c' | 'd')).then_some(KeyAction::Quit);
    }
    match key.code {
        KeyCode::Esc if shows_help => Some(KeyAction::Back),
        KeyCode::Char('q') | KeyCode::Esc => Some(KeyAction::Quit),
        KeyCode::Char('?' | 'h') => Some(KeyAction::Help),
        KeyCode::Tab => Some(KeyAction::NextRun),
        KeyCode::BackTab => Some(KeyAction::PreviousRun),
        KeyCode::Char('s') => Some(KeyAction::Order),
        KeyCode::Up | KeyCode::Char('k') => Some(KeyAction::Up),
        KeyCode::Down | KeyCode::Char('j') => Some(KeyAction::Down),
        KeyCode::PageUp | KeyCode::Char('b') => Some(KeyAction::PageUp),
        KeyCode::PageDown | KeyCode::Char('f' | ' ') => Some(KeyAction::PageDown),
        KeyCode::Home | KeyCode::Char('g') => Some(KeyAction::First),
        KeyCode::End | KeyCode::Char('G') => Some(KeyAction::Last),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use ratatui::crossterm::event::KeyEvent;

    use super::*;

    fn pressed(code: KeyCode, modifiers: KeyModifiers, shows_help: bool) -> Option<KeyAction> {
        action(&Event::Key(KeyEvent::new(code, modifiers)), shows_help)
    }

    #[test]
    fn q_escape_and_ctrl_c_quit() {
        let plain = KeyModifiers::NONE;
        for (code, modifiers) in
            [(KeyCode::Char('q'), plain), (KeyCode::Esc, plain), (KeyCode::Char('c'), KeyModifiers::CONTROL)]
        {
            assert_eq!(pressed(code, modifiers, false), Some(KeyAction::Quit), "{code:?}");
        }
        assert_eq!(pressed(KeyCode::Char('c'), plain, false), None);
        assert_eq!(pressed(KeyCode::Esc, plain, true), Some(KeyAction::Back), "Esc first closes the help");
        assert_eq!(pressed(KeyCode::Char('G'), KeyModifiers::SHIFT, false), Some(KeyAction::Last));
        assert_eq!(action(&Event::Resize(1, 1), false), None);
    }
}
