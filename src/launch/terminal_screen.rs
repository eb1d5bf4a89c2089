//! Terminal of the dashboard, restored after it, also after a panic.

use std::io::{self, IsTerminal};

use crate::launch::output;
use ratatui::DefaultTerminal;

/// Alternate screen of the terminal.
pub struct TerminalScreen {
    terminal: DefaultTerminal,
}

/// Returns whether standard output is a terminal that can show a dashboard.
pub fn is_there() -> bool {
    io::stdout().is_terminal() && std::env::var_os("TERM").is_none_or(|term| term != "dumb")
}

impl TerminalScreen {
    /// Switches to the alternate screen. A panic restores the terminal before it prints its message.
    pub fn open() -> io::Result<Self> {
        output::hold_log(true);
        let terminal = ratatui::try_init().inspect_err(|_| restore())?;
        Ok(Self { terminal })
    }

    /// Draws a frame; only cells that differ are written.
    pub fn draw(&mut self, draw: impl FnOnce(&mut ratatui::Frame)) -> io::Result<()> {
        self.terminal.draw(draw).map(drop)
    }
}

impl Drop for TerminalScreen {
    fn drop(&mut self) {
        // Fails only if the terminal is gone.
        let _ = self.terminal.show_cursor();
        restore();
    }
}

fn restore() {
    let _ = ratatui::try_restore();
    output::hold_log(false);
}
