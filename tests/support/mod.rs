//! Helpers of the whole-system tests: run the real binary in a temporary folder, read its output, wait for conditions.
#![allow(dead_code, unused_imports, reason = "each test file uses its own part")]

pub mod motion;
mod ports;
mod process;

use std::{
    collections::BTreeMap,
    fmt::Debug,
    fs,
    os::unix::fs::PermissionsExt,
    path::{Path, PathBuf},
    process::{Command, Output, Stdio},
    sync::{
        Arc, Once,
        atomic::{AtomicBool, Ordering},
    },
    thread::JoinHandle,
    time::Duration,
};

use bytes::Bytes;
pub use ports::*;
pub use process::*;
use rcgen::{CertificateParams, DnType, ExtendedKeyUsagePurpose, Issuer, KeyPair};
use serde_json::Value;
use time::OffsetDateTime;
use treadmill_bus::{
    Bus, BusOptions, Credentials, Role,
    actor::{fetch_policy, submit},
    learner::ControlServer,
    workarounds::threads,
};
use treadmill_learner::checkpoint::{TrainingState, load_file};
use treadmill_proto::{ControlReply, PolicyBundle, Receipt, RunStatus};

/// Longest wait for a condition, which only a broken program reaches.
pub const TIMEOUT: Duration = Duration::from_secs(120);

/// More steps than any test waits for.
pub const ENDLESS: &str = "1000000000";

/// Returns the command of the binary under test, to run in `folder`.
pub fn treadmill(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_treadmill"));
    command.current_dir(folder).env_remove("TREADMILL_LOG").stdin(Stdio::null());
    // Output without a locale is ASCII.
    command.env("LC_ALL", "C.UTF-8");
    // The binary sets it itself.
    command.env_remove(threads::VARIABLE);
    command
}

/// Asks until an answer comes: without one, the client does not know the other side yet.
pub async fn until_answered<T, E: Debug, F>(mut ask: impl FnMut() -> F) -> T
where
    F: Future<Output = Result<Option<T>, E>>,
{
    loop {
        if let Some(answer) = ask().await.unwrap() {
            return answer;
        }
        tokio::task::yield_now().await;
    }
}

/// Sends an encoded fragment of the run `run` until a receipt comes.
pub async fn deliver(bus: &Bus, actor: &str, fragment: impl Into<Bytes>) -> Receipt {
    let fragment = fragment.into();
    until_answered(|| submit(bus, "run", actor, fragment.clone(), TIMEOUT, |_| true)).await
}

/// Starts the binary under test in `folder`.
pub fn start(folder: &Path, args: &[&str]) -> Running {
    let mut command = treadmill(folder);
    command.args(args);
    Running::start(command)
}

/// Starts the command of [`endless`] with further arguments.
pub fn start_endless(folder: &Path, run: &Path, command: &str, more: &[&str]) -> Running {
    let mut command = endless(folder, run, command);
    command.args(more);
    Running::start(command)
}

/// Starts a command as it was printed, with the binary under test as `treadmill`.
pub fn start_printed(folder: &Path, command: &str) -> Running {
    let programs = Path::new(env!("CARGO_BIN_EXE_treadmill")).parent().expect("a file's folder").display();
    let mut shell = Command::new("sh");
    shell.args(["-c", &format!("exec {command}")]).current_dir(folder).stdin(Stdio::null());
    shell.env("PATH", format!("{programs}:{}", std::env::var("PATH").unwrap()));
    Running::start(shell)
}

/// Stops a process, and asserts that it succeeds.
pub fn stop(process: Running) {
    process.signal(libc::SIGINT);
    let (status, lines) = process.wait();
    assert!(status.success(), "{lines:#?}");
}

/// Trains a run of the preset `smoke` for 2048 steps.
pub fn trained(folder: &Path, run: &Path) {
    let args = ["train", "--preset", "smoke", "--steps", "2048", "--actors", "1", "--run-dir", run.to_str().unwrap()];
    done(folder, &args);
}

/// Model of a robot with 29 servos, as G1 has.
pub const ROBOT_XML: &str = include_str!("../../actor/humanoid/assets/g1-like-servos.xml");

/// Trains a policy of the velocity task for a few steps: of the robot with this card, whose model is `robot.xml`.
pub fn trained_robot(folder: &Path, run: &Path, card: &str, keys: &[&str]) {
    fs::write(folder.join("robot.xml"), ROBOT_XML).unwrap();
    fs::write(folder.join("robot.toml"), card).unwrap();
    let args = ["train", "--preset", "smoke", "--steps", "512", "--actors", "1", "--model", "robot.toml"];
    let task = ["env.task=velocity", "env.control_step_s=0.02", "env.substeps=5"];
    done(folder, &[&args[..], &set(&task), &set(keys), &["--run-dir", run.to_str().unwrap()]].concat());
}

/// Returns the command `train` or `learner` of a run of the preset `smoke` that trains until it is stopped.
pub fn endless(folder: &Path, run: &Path, command: &str) -> Command {
    let mut started = treadmill(folder);
    started.args([command, "--preset", "smoke", "--steps", ENDLESS, "--run-dir", run.to_str().unwrap()]);
    started
}

/// Makes clients in this process use one thread, as Treadmill's own do over TLS: otherwise a flood can corrupt the
/// memory of its sender, which is this process (`common/bus/src/workarounds/threads.rs`). Must be called before the
/// first client opens.
pub fn bus_on_one_thread() {
    static SET: Once = Once::new();
    SET.call_once(|| {
        if let Some((name, value)) = threads::wanted(true, Role::Actor) {
            // SAFETY: these tests access the environment only through Rust's functions, which lock it.
            unsafe { std::env::set_var(name, value) };
        }
    });
}

/// Runs the binary to its end.
pub fn run(folder: &Path, args: &[&str]) -> Output {
    treadmill(folder).args(args).output().expect("the binary starts")
}

/// Returns the flags that set configuration keys, each as `key=value`.
pub fn set<'a>(pairs: &[&'a str]) -> Vec<&'a str> {
    pairs.iter().flat_map(|pair| ["--set", pair]).collect()
}

/// Runs the binary to its end, and asserts that it succeeds.
#[track_caller]
pub fn done(folder: &Path, args: &[&str]) -> Output {
    let output = run(folder, args);
    assert!(output.status.success(), "{args:?}: {}", stderr(&output));
    output
}

/// Runs `treadmill certs`.
pub fn certs(folder: &Path, args: &[&str]) {
    done(folder, &[&["certs"], args].concat());
}

/// Issues a client's certificate by the authority in `certs` into `out`, valid between these days from now.
pub fn issue(role: Role, certs: &Path, out: &Path, [from, until]: [i64; 2]) {
    let read = |name: &str| fs::read_to_string(certs.join(name)).unwrap();
    let authority = Issuer::from_ca_cert_pem(&read("ca.crt"), KeyPair::from_pem(&read("ca.key")).unwrap()).unwrap();
    let mut params = CertificateParams::default();
    params.distinguished_name.push(DnType::CommonName, role.common_name());
    params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ClientAuth];
    params.not_before = OffsetDateTime::now_utc() + time::Duration::days(from);
    params.not_after = OffsetDateTime::now_utc() + time::Duration::days(until);
    let pair = KeyPair::generate().unwrap();
    let [certificate, key] = Credentials { folder: out.to_path_buf(), role }.files();
    fs::write(certificate, params.signed_by(&pair, &authority).unwrap().pem()).unwrap();
    fs::write(&key, pair.serialize_pem()).unwrap();
    fs::set_permissions(&key, fs::Permissions::from_mode(0o600)).unwrap();
}

/// Opens a router's session that listens, and returns its endpoints.
pub fn open_router(connect: &[String]) -> (Bus, Vec<String>) {
    let listen = vec!["tcp/127.0.0.1:0".to_string()];
    Bus::open_router(&BusOptions { listen, connect: connect.to_vec(), ..BusOptions::default() }).unwrap()
}

/// Opens a client's session that dials these endpoints.
pub fn open_client(connect: &[String]) -> Bus {
    Bus::open_client(&BusOptions { connect: connect.to_vec(), ..BusOptions::default() }).unwrap()
}

/// Joins the bus of a run.
pub fn join(run: &Path) -> Bus {
    open_client(&[endpoint(run)])
}

/// Joins the bus of a run with the certificate of a role in `folder/certs`.
pub fn join_as(role: Role, folder: &Path, run: &Path) -> Bus {
    let credentials = Some(Credentials { folder: folder.join("certs"), role });
    Bus::open_client(&BusOptions { connect: vec![endpoint(run)], credentials, ..BusOptions::default() }).unwrap()
}

/// Learner that only answers questions about its status, until it is dropped.
pub struct StatusServer {
    is_over: Arc<AtomicBool>,
    answering: Option<JoinHandle<()>>,
}

impl StatusServer {
    pub fn start(bus: &Bus, status: RunStatus) -> Self {
        let server = ControlServer::open(bus, &status.run).unwrap();
        let is_over = Arc::new(AtomicBool::new(false));
        let ended = is_over.clone();
        let reply = ControlReply { done: true, text: String::new(), status: Some(status.clone()) };
        let answering = std::thread::spawn(move || {
            while !ended.load(Ordering::Relaxed) {
                if let Some(inquiry) = server.next(Duration::from_millis(100)) {
                    inquiry.answer(&status.run, &reply);
                }
            }
        });
        Self { is_over, answering: Some(answering) }
    }
}

impl Drop for StatusServer {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Relaxed);
        let _ = self.answering.take().map(JoinHandle::join);
    }
}

/// Waits for the newest policy of the run `run`.
pub async fn policy(bus: &Bus) -> PolicyBundle {
    until_answered(|| fetch_policy(bus, Some("run"), TIMEOUT)).await
}

/// Returns standard output as text.
pub fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Returns standard error as text.
pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Returns the JSON object on the last line of standard output.
pub fn last_json(output: &Output) -> Value {
    let text = stdout(output);
    let line = text.trim_end().lines().last().unwrap_or_default();
    serde_json::from_str(line).unwrap_or_else(|why| panic!("{why} in `{line}`; standard error: {}", stderr(output)))
}

/// Returns the JSON objects of a file, one per line.
pub fn json_lines(file: &Path) -> Vec<Value> {
    fs::read_to_string(file).unwrap().lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// Returns the rows of a table, each by the names of its columns.
pub fn csv_rows(file: &Path) -> Vec<BTreeMap<String, String>> {
    let text = fs::read_to_string(file).unwrap();
    let names: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let cells = |line: &str| names.iter().map(ToString::to_string).zip(line.split(',').map(str::to_string)).collect();
    text.lines().skip(1).map(cells).collect()
}

/// Returns the numbers of a JSON list.
pub fn numbers(list: &Value) -> Vec<f64> {
    list.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

/// Writes a program that anyone may run.
pub fn install(program: &Path, text: &str) {
    fs::write(program, text).unwrap();
    fs::set_permissions(program, fs::Permissions::from_mode(0o755)).unwrap();
}

/// Returns the latest checkpoint of a run.
pub fn latest(run: &Path) -> TrainingState {
    load_file(&run.join("checkpoints/latest.bundle")).unwrap()
}

/// Asserts an exit code and parts of standard error.
pub fn assert_refused(output: &Output, code: i32, parts: &[&str]) {
    let text = stderr(output);
    assert_eq!(output.status.code(), Some(code), "{text}");
    for part in parts {
        assert!(text.contains(part), "`{part}` is missing in: {text}");
    }
    assert!(!text.contains("panicked"), "{text}");
}

/// Runs the binary, and asserts that it refuses its arguments with exit code 2 and these parts of standard error.
#[track_caller]
pub fn assert_usage(folder: &Path, args: &[&str], parts: &[&str]) {
    assert_refused(&run(folder, args), 2, parts);
}

/// Returns the child processes of `parent` whose command line contains `part`.
pub fn children(parent: u32, part: &str) -> Vec<u32> {
    fs::read_dir("/proc")
        .expect("these tests run on Linux")
        .flatten()
        .filter_map(|entry| entry.file_name().to_string_lossy().parse::<u32>().ok())
        .filter(|pid| {
            let command = fs::read_to_string(format!("/proc/{pid}/cmdline")).unwrap_or_default();
            stat(*pid).is_some_and(|(is_zombie, of)| !is_zombie && of == parent) && command.contains(part)
        })
        .collect()
}

/// Returns whether a process exists and is not a zombie.
pub fn is_running(pid: u32) -> bool {
    stat(pid).is_some_and(|(is_zombie, _)| !is_zombie)
}

/// Returns whether a process is a zombie, and its parent.
fn stat(pid: u32) -> Option<(bool, u32)> {
    let text = fs::read_to_string(format!("/proc/{pid}/stat")).ok()?;
    let mut after_name = text.rsplit(')').next()?.split_whitespace();
    Some((after_name.next()? == "Z", after_name.next()?.parse().ok()?))
}

/// Returns every logged metric of a run as (tag, step, value).
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

/// Returns the highest step of a run's metrics, or 0.
pub fn last_step(run: &Path) -> u64 {
    metrics(run).iter().map(|(_, step, _)| *step).max().unwrap_or(0)
}

/// Returns the last value of a tag.
pub fn last_value(run: &Path, tag: &str) -> Option<f64> {
    metrics(run).into_iter().rev().find(|(name, ..)| name == tag).map(|(.., value)| value)
}

/// Waits until a run has learnt from at least `steps` steps.
pub fn await_steps(run: &Path, steps: u64) {
    await_that(&format!("{steps} steps in {}", run.display()), || {
        metrics(run).last().filter(|(_, step, _)| *step >= steps).map(drop)
    });
}

/// Waits for the endpoint in a run folder.
pub fn endpoint(run: &Path) -> String {
    await_that("the endpoint", || fs::read_to_string(run.join("endpoint.txt")).ok().filter(|text| text.ends_with('\n')))
        .trim()
        .to_string()
}

/// Returns a temporary folder and the path of a run folder in it.
pub fn folders() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let run = folder.path().join("run");
    (folder, run)
}

/// Returns the text of a page below `docs/`, by its path without `.md`.
pub fn page(path: &str) -> String {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs").join(path).with_extension("md");
    fs::read_to_string(&file).unwrap_or_else(|why| panic!("{}: {why}", file.display()))
}

/// Returns the Python of TREADMILL_PYTHON if it has these modules. Otherwise skips the test.
pub fn python_with(modules: &str) -> Option<Command> {
    let Ok(python) = std::env::var("TREADMILL_PYTHON") else {
        skip(&format!("set TREADMILL_PYTHON to a Python that has {modules}"));
        return None;
    };
    let import = format!("import {modules}");
    if !Command::new(&python).args(["-c", &import]).output().expect("Python starts").status.success() {
        skip(&format!("{python} lacks one of {modules}"));
        return None;
    }
    Some(Command::new(python))
}
