//! Terminal of the dashboard: taken when it opens, restored however it ends.

use std::io::{self, IsTerminal};

use crate::launch::output;
use ratatui::DefaultTerminal;

/// The whole terminal, on its alternate screen.
pub struct TerminalScreen {
    terminal: DefaultTerminal,
}

/// Whether there is a terminal that a dashboard can be drawn on.
pub fn is_there() -> bool {
    io::stdout().is_terminal() && std::env::var_os("TERM").is_none_or(|term| term != "dumb")
}

impl TerminalScreen {
    /// Takes the terminal. A panic gives it back before it tells what happened.
    pub fn open() -> io::Result<Self> {
        output::hold_log(true);
        let terminal = ratatui::try_init().inspect_err(|_| give_back())?;
        Ok(Self { terminal })
    }

    /// Draws what differs from what is there.
    pub fn draw(&mut self, draw: impl FnOnce(&mut ratatui::Frame)) -> io::Result<()> {
        self.terminal.draw(draw).map(drop)
    }
}

impl Drop for TerminalScreen {
    fn drop(&mut self) {
        // A terminal that is gone needs nothing given back.
        let _ = self.terminal.show_cursor();
        give_back();
    }
}

fn give_back() {
    let _ = ratatui::try_restore();
    output::hold_log(false);
}
