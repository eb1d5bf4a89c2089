//! What the whole-system tests share: the real binary in a folder of its own, and ways to wait for what it does.
#![allow(dead_code, reason = "each test file uses its own part")]

mod process;

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output, Stdio},
    sync::Once,
    time::Duration,
};

pub use process::*;
use serde_json::Value;
use treadmill_bus::{BusOptions, Role, workarounds::threads};

/// Nothing in these tests takes this long unless it is broken.
pub const PATIENCE: Duration = Duration::from_secs(120);

/// The binary under test, run in `folder`.
pub fn treadmill(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_treadmill"));
    command.current_dir(folder).env_remove("TREADMILL_LOG").stdin(Stdio::null());
    // It says by itself how its bus is to work.
    command.env_remove(threads::VARIABLE);
    command
}

/// Lets clients that this process opens read and write with one thread, as ours do over TLS: otherwise a flood of messages
/// may break the memory of the sender, which is this process (`common/src/bus/threads.rs`). To be called before the
/// first is opened.
pub fn bus_on_one_thread() {
    static SAID: Once = Once::new();
    SAID.call_once(|| {
        let options = BusOptions { connect: vec!["tls/localhost:1".to_string()], ..BusOptions::default() };
        if let Some((name, value)) = threads::wanted(&options, Role::Actor) {
            // SAFETY: these tests read the environment only by Rust's own functions, which take turns.
            unsafe { std::env::set_var(name, value) };
        }
    });
}

/// Runs to the end.
pub fn run(folder: &Path, args: &[&str]) -> Output {
    treadmill(folder).args(args).output().expect("the binary starts")
}

/// Standard output as text.
pub fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Standard error as text.
pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The JSON object on the last line of standard output.
pub fn last_json(output: &Output) -> Value {
    let text = stdout(output);
    let line = text.trim_end().lines().last().unwrap_or_default();
    serde_json::from_str(line).unwrap_or_else(|why| panic!("{why} in `{line}`; standard error: {}", stderr(output)))
}

/// Asserts an exit code and what standard error says.
pub fn assert_refused(output: &Output, code: i32, parts: &[&str]) {
    let text = stderr(output);
    assert_eq!(output.status.code(), Some(code), "{text}");
    for part in parts {
        assert!(text.contains(part), "`{part}` is missing in: {text}");
    }
    assert!(!text.contains("panicked"), "{text}");
}

/// Child processes of `parent` whose command line contains `part`.
pub fn children(parent: u32, part: &str) -> Vec<u32> {
    fs::read_dir("/proc")
        .expect("these tests run on Linux")
        .flatten()
        .filter_map(|entry| entry.file_name().to_string_lossy().parse::<u32>().ok())
        .filter(|pid| {
            let stat = fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
            let after_name = stat.rsplit(')').next().unwrap_or_default();
            let mut fields = after_name.split_whitespace();
            let state = fields.next();
            let parent_of_it = fields.next().and_then(|field| field.parse::<u32>().ok());
            let command = fs::read_to_string(format!("/proc/{pid}/cmdline")).unwrap_or_default();
            state != Some("Z") && parent_of_it == Some(parent) && command.contains(part)
        })
        .collect()
}

/// Whether a process is there and not a zombie.
pub fn is_running(pid: u32) -> bool {
    let stat = fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
    stat.rsplit(')').next().and_then(|rest| rest.split_whitespace().next()).is_some_and(|state| state != "Z")
}

/// Every metric of a run, as (tag, step, value).
pub fn metrics(run: &Path) -> Vec<(String, u64, f64)> {
    let text = fs::read_to_string(run.join("metrics.jsonl")).unwrap_or_default();
    text.lines()
        .filter_map(|line| serde_json::from_str::<Value>(line).ok())
        .map(|metric| {
            let tag = metric["tag"].as_str().expect("a tag").to_string();
            (tag, metric["step"].as_u64().expect("a step"), metric["value"].as_f64().expect("a value"))
        })
        .collect()
}

/// The last value of one tag.
pub fn last_value(run: &Path, tag: &str) -> Option<f64> {
    metrics(run).into_iter().rev().find(|(name, ..)| name == tag).map(|(.., value)| value)
}

/// Waits until a run has learnt from at least so many steps.
pub fn await_steps(run: &Path, steps: u64) {
    await_that(&format!("{steps} steps in {}", run.display()), || {
        metrics(run).last().filter(|(_, step, _)| *step >= steps).map(drop)
    });
}

/// The endpoint that a learner wrote into its run folder.
pub fn endpoint(run: &Path) -> String {
    await_that("the endpoint", || fs::read_to_string(run.join("endpoint.txt")).ok().filter(|text| text.ends_with('\n')))
        .trim()
        .to_string()
}

/// A folder for one test, and a run's folder inside it.
pub fn folders() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = folder.path().join("run");
    (folder, run)
}

/// Text of a page below `docs/`, by its path without `.md`.
pub fn page(path: &str) -> String {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs").join(path).with_extension("md");
    fs::read_to_string(&file).unwrap_or_else(|why| panic!("{}: {why}", file.display()))
}

/// The Python that TREADMILL_PYTHON names, if it has these modules; without it, tests that need it say so and pass.
#[allow(clippy::print_stderr, reason = "a test that was left out must say so")]
pub fn python_with(modules: &str) -> Option<Command> {
    let Ok(python) = std::env::var("TREADMILL_PYTHON") else {
        eprintln!("SKIPPED: set TREADMILL_PYTHON to a Python that has {modules}");
        return None;
    };
    let import = format!("import {modules}");
    if !Command::new(&python).args(["-c", &import]).output().expect("Python starts").status.success() {
        eprintln!("SKIPPED: {python} lacks one of {modules}");
        return None;
    }
    Some(Command::new(python))
}
