//! What the terminal shows of progress and curves.

use std::io::IsTerminal;

use treadmill_runtime::machine;

use super::finding::Finding;

const NAME: &str = "terminal";

/// Of standard output.
pub fn diagnose() -> Finding {
    let is_dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
    assess(std::io::stdout().is_terminal() && !is_dumb, machine::is_utf8_locale())
}

fn assess(is_terminal: bool, is_utf8: bool) -> Finding {
    match (is_terminal, is_utf8) {
        (true, true) => Finding::ok(NAME, "a bar, tables and curves"),
        (false, true) => Finding::ok(NAME, "none here: `train` prints plain lines"),
        (_, false) => Finding::note(
            NAME,
            "the locale is not UTF-8: curves are drawn in ASCII",
            "nothing, or say what the terminal can: export LANG=C.UTF-8",
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::check::finding::Severity;

    #[test]
    fn ascii_is_noted() {
        assert_eq!(assess(true, true).severity, Severity::Ok);
        assert!(assess(false, true).seen.contains("plain lines"));
        assert!(assess(true, false).remedy.unwrap().contains("C.UTF-8"));
    }
}
