//! Writes the ledger of the last checkpoint as a file: the account of every actor process.

use std::{fmt::Write, io, path::Path};

use serde_json::json;
use treadmill_experience::ledger::{ActorProcess, Ledger};
use treadmill_runtime::atomic_file;

/// Replaces the file with one line for each process.
pub fn write(path: &Path, ledger: &Ledger) -> io::Result<()> {
    let mut lines = String::new();
    for ActorProcess { actor, incarnation, through, newest, missing, account } in ledger.processes() {
        let line = json!({
            "actor": actor,
            // A string, because readers that parse numbers as doubles would lose its last digits.
            "incarnation": incarnation.to_string(),
            "through": through,
            "newest": newest,
            "missing": missing,
            "accepted": account.accepted,
            "too_old": account.too_old,
            "vanished": account.vanished,
            "unseen": account.unseen,
            "env_steps": account.env_steps,
            "env_steps_dropped": account.env_steps_dropped,
        });
        // Writing to a string does not fail.
        let _ = writeln!(lines, "{line}");
    }
    atomic_file::write(path, lines.as_bytes())
}
