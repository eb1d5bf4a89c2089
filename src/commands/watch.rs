//! `treadmill watch`: starts the viewer, a program of its own so that building the trainer does not build it.

use std::{env, io::ErrorKind, os::unix::process::CommandExt, path::PathBuf, process::Command};

use anyhow::Context;

/// Program of the viewer.
const PROGRAM: &str = "treadmill-watch";

/// Replaces this process by the viewer with the same arguments; returns only if the viewer cannot be started.
pub fn run() -> anyhow::Result<()> {
    let beside = env::current_exe().ok().map(|own| own.with_file_name(PROGRAM)).filter(|path| path.is_file());
    let program = beside.unwrap_or_else(|| PathBuf::from(PROGRAM));
    // Skips `treadmill watch`.
    let why = Command::new(&program).args(env::args_os().skip(2)).exec();
    if why.kind() == ErrorKind::NotFound {
        anyhow::bail!(
            "the viewer `{PROGRAM}` is neither beside this program nor on the PATH; build it with `cargo build --release -p \
             {PROGRAM}`"
        );
    }
    Err(why).with_context(|| format!("the viewer `{}` cannot be started", program.display()))
}
