//! Shared by the viewer's tests: its binary and a browser.
#![allow(dead_code, reason = "each test file uses its own part")]

pub mod browser;
pub mod picture;
#[path = "../../../tests/support/process.rs"]
mod process;

use std::{
    path::{Path, PathBuf},
    process::{Command, Stdio},
    time::Duration,
};

pub use process::*;

/// Nothing in these tests takes this long unless it is broken; a browser without a GPU takes a while for its first picture.
pub const TIMEOUT: Duration = Duration::from_secs(300);

/// Returns the root of the repository.
pub fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// Returns the path of the included policy.
pub fn policy() -> PathBuf {
    root().join("docs/results/policy.safetensors")
}

/// Returns a command that runs the viewer.
pub fn viewer(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_treadmill-watch"));
    command.current_dir(folder).env_remove("TREADMILL_LOG").stdin(Stdio::null());
    command
}

/// Returns a command that runs the trainer of the same build; skips the test if it is not built.
pub fn treadmill(folder: &Path) -> Option<Command> {
    let program = Path::new(env!("CARGO_BIN_EXE_treadmill-watch")).with_file_name("treadmill");
    if !program.is_file() {
        skip("build the trainer first: cargo build --release");
        return None;
    }
    let mut command = Command::new(program);
    command.current_dir(folder).env_remove("TREADMILL_LOG").stdin(Stdio::null());
    Some(command)
}
