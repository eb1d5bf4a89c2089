//! Lines on standard output and standard error. A closed stream is ignored, because a reader that goes away must not stop
//! training; other errors of standard output are kept for the end. Also the log's writer, which buffers while a
//! dashboard uses the terminal.

use std::{
    io::{self, IsTerminal, Write},
    sync::{
        Mutex, OnceLock,
        atomic::{AtomicBool, Ordering},
    },
};

/// Most bytes of the log that are buffered.
const HELD_BYTES_MAX: usize = 16 << 10;

/// Log since buffering began; `None` while the log is written directly.
static HELD: Mutex<Option<Vec<u8>>> = Mutex::new(None);

/// Whether the terminal was closed, so that what is printed is lost.
static IS_TERMINAL_GONE: AtomicBool = AtomicBool::new(false);

/// First error of standard output other than a reader that has gone away.
static LOST: OnceLock<io::Error> = OnceLock::new();

/// Prints a line on standard output.
pub fn say(line: &str) {
    say_to_reader(line);
}

/// Prints the result of a measurement as one JSON object, or as lines of text.
pub fn say_result(result: &serde_json::Value, json: bool) {
    if json {
        return say(&result.to_string());
    }
    for (name, value) in result.as_object().into_iter().flatten() {
        let value = value.as_str().map_or_else(|| value.to_string(), str::to_string);
        say(&format!("{name:<24} {value}"));
    }
}

/// Prints a line on standard output. Returns false if it cannot be written.
pub fn say_to_reader(line: &str) -> bool {
    let Err(why) = writeln!(io::stdout().lock(), "{line}") else { return true };
    if why.kind() != io::ErrorKind::BrokenPipe && !IS_TERMINAL_GONE.load(Ordering::Relaxed) {
        let _ = LOST.set(why);
    }
    false
}

/// Returns an error if a line could not be written, as on a full disk.
///
/// # Errors
/// The first one.
pub fn check_written() -> anyhow::Result<()> {
    LOST.get().map_or(Ok(()), |why| Err(anyhow::anyhow!("standard output cannot be written: {why}")))
}

/// Notes that the terminal was closed: what cannot be printed any more is no error.
pub fn terminal_is_gone() {
    IS_TERMINAL_GONE.store(true, Ordering::Relaxed);
}

/// Prints a line on standard error.
pub fn say_error(line: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// Begins or ends buffering the log, if it goes to a terminal; the end writes the buffered part.
pub fn hold_log(hold: bool) {
    let mut held = HELD.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    if hold && io::stderr().is_terminal() {
        held.get_or_insert_default();
    } else if let Some(bytes) = held.take() {
        let _ = io::stderr().lock().write_all(&bytes);
    }
}

/// Writer of the log: standard error, directly or after buffering.
pub struct Log;

impl Write for Log {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut *HELD.lock().unwrap_or_else(|poisoned| poisoned.into_inner()) {
            // The first messages are likelier the cause than the last.
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
