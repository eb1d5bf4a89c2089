//! `treadmill watch`: hands over to the viewer, which is a program of its own, so that building the trainer does not build it.

use std::{ffi::OsString, io::ErrorKind, os::unix::process::CommandExt, path::PathBuf, process::Command};

use anyhow::Context;
use clap::Args;

/// The viewer.
const PROGRAM: &str = "treadmill-watch";

/// Flags of `watch`.
#[derive(Args)]
#[command(disable_help_flag = true)]
pub struct WatchArgs {
    /// A run's folder, its name below runs/, a bundle file, or what `export` wrote; --help has the viewer's flags.
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "RUN")]
    args: Vec<OsString>,
}

/// The viewer takes this process's place, with its terminal and its signals; comes back only where it cannot be started.
pub fn run(args: &WatchArgs) -> anyhow::Result<()> {
    let beside = std::env::current_exe().ok().map(|own| own.with_file_name(PROGRAM)).filter(|path| path.is_file());
    let program = beside.unwrap_or_else(|| PathBuf::from(PROGRAM));
    let why = Command::new(&program).args(&args.args).exec();
    if why.kind() == ErrorKind::NotFound {
        anyhow::bail!(
            "the viewer `{PROGRAM}` is neither beside this program nor on the PATH; build it with `cargo build --release -p \
             {PROGRAM}`"
        );
    }
    Err(why).with_context(|| format!("the viewer `{}` cannot be started", program.display()))
}
