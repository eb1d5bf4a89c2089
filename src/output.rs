//! Standard output that may be closed: a reader that goes away must not stop training.

use std::io::Write;

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
