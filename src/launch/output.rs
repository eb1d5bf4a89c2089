//! Lines on standard output and standard error, which may be closed: a reader that goes away must not stop training. Also
//! the log's writer, which buffers while a dashboard uses the terminal.

use std::{
    io::{self, IsTerminal, Write},
    sync::Mutex,
};

/// What of the log is kept while it waits.
const HELD_BYTES_MAX: usize = 16 << 10;

/// What was logged since it has to wait; `None` where it need not.
static HELD: Mutex<Option<Vec<u8>>> = Mutex::new(None);

/// A line on standard output.
pub fn say(line: &str) {
    // Whoever closed the pipe does not want to read this.
    let _ = writeln!(std::io::stdout().lock(), "{line}");
}

/// A line on standard error.
pub fn complain(line: &str) {
    // There is no other place to tell of a closed standard error.
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// Lets the log wait, where it goes to a terminal, or lets out what waited.
pub fn hold_log(hold: bool) {
    let mut held = HELD.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    if hold && io::stderr().is_terminal() {
        held.get_or_insert_default();
    } else if let Some(waited) = held.take() {
        let _ = io::stderr().lock().write_all(&waited);
    }
}

/// Where the log is written to: standard error, sooner or later.
pub struct Log;

impl Write for Log {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut *HELD.lock().unwrap_or_else(|poisoned| poisoned.into_inner()) {
            // What comes first is likelier the cause than what comes last.
            Some(held) if held.len() + bytes.len() <= HELD_BYTES_MAX => held.extend_from_slice(bytes),
            Some(_) => {}
            None => io::stderr().lock().write_all(bytes)?,
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        io::stderr().lock().flush()
    }
}
