//! What keys stand for.

use ratatui::crossterm::event::{Event, KeyCode, KeyEventKind, KeyModifiers};

/// Something to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Leave.
    Quit,
    /// Explain the keys, or stop explaining them.
    Help,
    /// Stop explaining them.
    Back,
    /// Look at the next run.
    NextRun,
    /// Look at the one before.
    PreviousRun,
    /// Order the actors by something else.
    Order,
    /// One actor up.
    Up,
    /// One actor down.
    Down,
    /// As many as there is room for.
    PageUp,
    /// As many as there is room for.
    PageDown,
    /// To the first actor.
    First,
    /// To the last actor.
    Last,
}

/// What is to be read beside each key, in the order of the help.
pub const HELP: [(&str, &str); 7] = [
    ("q, Esc, Ctrl-C", "leave; the runs go on"),
    ("Tab, Shift-Tab", "next or previous run"),
    ("↑ ↓, k j", "scroll the actors"),
    ("PgUp PgDn, b f", "a page of them"),
    ("Home End, g G", "the first, the last"),
    ("s", "another order of them"),
    ("?", "these lines, and back"),
];

/// What an event asks for; `helps` while the keys are explained.
pub fn action(event: &Event, helps: bool) -> Option<Action> {
    let Event::Key(key) = event else { return None };
    if key.kind == KeyEventKind::Release {
        return None;
    }
    if key.modifiers.contains(KeyModifiers::CONTROL) {
        return matches!(key.code, KeyCode::Char('c' | 'd')).then_some(Action::Quit);
    }
    match key.code {
        KeyCode::Esc if helps => Some(Action::Back),
        KeyCode::Char('q') | KeyCode::Esc => Some(Action::Quit),
        KeyCode::Char('?' | 'h') => Some(Action::Help),
        KeyCode::Tab => Some(Action::NextRun),
        KeyCode::BackTab => Some(Action::PreviousRun),
        KeyCode::Char('s') => Some(Action::Order),
        KeyCode::Up | KeyCode::Char('k') => Some(Action::Up),
        KeyCode::Down | KeyCode::Char('j') => Some(Action::Down),
        KeyCode::PageUp | KeyCode::Char('b') => Some(Action::PageUp),
        KeyCode::PageDown | KeyCode::Char('f' | ' ') => Some(Action::PageDown),
        KeyCode::Home | KeyCode::Char('g') => Some(Action::First),
        KeyCode::End | KeyCode::Char('G') => Some(Action::Last),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use ratatui::crossterm::event::KeyEvent;

    use super::*;

    fn pressed(code: KeyCode, modifiers: KeyModifiers, helps: bool) -> Option<Action> {
        action(&Event::Key(KeyEvent::new(code, modifiers)), helps)
    }

    #[test]
    fn q_escape_and_ctrl_c_leave() {
        let plain = KeyModifiers::NONE;
        for (code, modifiers) in
            [(KeyCode::Char('q'), plain), (KeyCode::Esc, plain), (KeyCode::Char('c'), KeyModifiers::CONTROL)]
        {
            assert_eq!(pressed(code, modifiers, false), Some(Action::Quit), "{code:?}");
        }
        assert_eq!(pressed(KeyCode::Char('c'), plain, false), None);
        assert_eq!(pressed(KeyCode::Esc, plain, true), Some(Action::Back), "out of the help first");
        assert_eq!(pressed(KeyCode::Char('G'), KeyModifiers::SHIFT, false), Some(Action::Last));
        assert_eq!(action(&Event::Resize(1, 1), false), None);
    }
}
