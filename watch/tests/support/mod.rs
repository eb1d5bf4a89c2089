//! What the viewer's tests share: its real binary, and a real browser.
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

/// The root of the repository.
pub fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// The policy that comes along.
pub fn policy() -> PathBuf {
    root().join("docs/results/policy.safetensors")
}

/// The viewer.
pub fn viewer(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_treadmill-watch"));
    command.current_dir(folder).env_remove("TREADMILL_LOG").stdin(Stdio::null());
    command
}

/// The trainer's binary of the same build, which these tests do not build.
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

/// Says loudly that a test was left out; with TREADMILL_STRICT=yes none may be.
#[allow(clippy::print_stderr, reason = "a test that was left out must say so")]
pub fn skip(why: &str) {
    assert!(std::env::var("TREADMILL_STRICT").as_deref() != Ok("yes"), "{why}");
    eprintln!("SKIPPED: {why}");
}
