//! Writes the ledger as a file: the account of every actor process, as of the last checkpoint.

use std::{fmt::Write, io, path::Path};

use serde_json::json;
use treadmill_runtime::atomic_file;

use super::{ActorProcess, Ledger};

/// Replaces the file: one line for each process.
pub fn write(path: &Path, ledger: &Ledger) -> io::Result<()> {
    let mut lines = String::new();
    for ActorProcess { actor, incarnation, through, newest, missing, account } in ledger.processes() {
        let line = json!({
            "actor": actor,
            // As text: readers that take every number for a double would lose its last digits.
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
