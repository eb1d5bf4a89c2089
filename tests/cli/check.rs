//! `treadmill check`: each thing that can be wrong with a machine or the way to a learner is brought about, and named.

use std::{
    fs,
    net::TcpListener,
    os::unix::fs::PermissionsExt,
    path::Path,
    process::{Command, Output},
    time::Duration,
};

use crate::support::*;
use rcgen::{CertificateParams, DnType, ExtendedKeyUsagePurpose, Issuer, KeyPair};
use serde_json::Value;
use time::OffsetDateTime;
use treadmill_bus::{Bus, BusOptions, ControlServer};
use treadmill_proto::{ControlReply, RunStatus};
use treadmill_runtime::machine;

/// What the check says of one thing: its verdicts, and all that it says.
fn of(output: &Output, name: &str) -> (Vec<String>, String) {
    let told = last_json(output);
    let findings = told["findings"].as_array().expect("findings");
    let named: Vec<&Value> = findings.iter().filter(|finding| finding["name"] == name).collect();
    let verdicts = named.iter().map(|finding| finding["verdict"].as_str().unwrap().to_string()).collect();
    (verdicts, named.iter().map(|finding| finding.to_string()).collect::<Vec<_>>().join("\n"))
}

/// Asserts a problem, with what stands in the words about it, and the exit code.
#[track_caller]
fn assert_problem(output: &Output, name: &str, parts: &[&str]) {
    let (verdicts, words) = of(output, name);
    assert!(verdicts.iter().any(|verdict| verdict == "problem"), "{name}: {words}; {}", stderr(output));
    for part in parts {
        assert!(words.contains(part), "`{part}` is missing in: {words}");
    }
    assert_eq!(output.status.code(), Some(1));
}

#[track_caller]
fn assert_ok(output: &Output, name: &str) {
    let (verdicts, words) = of(output, name);
    assert!(!verdicts.is_empty() && verdicts.iter().all(|verdict| verdict == "ok"), "{name}: {words}");
}

fn check(folder: &Path, args: &[&str]) -> Output {
    run(folder, &[&["check", "--json"], args].concat())
}

/// The check in a shell, after what `before` does there.
fn check_after(folder: &Path, before: &str, args: &str) -> Output {
    let binary = env!("CARGO_BIN_EXE_treadmill");
    let script = format!("{before} exec {binary} check --json {args}");
    Command::new("sh").args(["-c", &script]).current_dir(folder).output().expect("there is a shell")
}

/// The same in namespaces of its own, where that is allowed.
#[allow(clippy::print_stderr, reason = "a test that was left out must say so")]
fn check_apart(folder: &Path, flags: &str, before: &str, args: &str) -> Option<Output> {
    let allowed = Command::new("unshare").args([flags, "true"]).output().is_ok_and(|tried| tried.status.success());
    if !allowed {
        leave_out(&format!("`unshare {flags}` is not allowed here"));
        return None;
    }
    let binary = env!("CARGO_BIN_EXE_treadmill");
    let script = format!("{before} exec {binary} check --json {args}");
    Some(Command::new("unshare").args([flags, "sh", "-c", &script]).current_dir(folder).output().expect("it starts"))
}

#[allow(clippy::print_stderr, reason = "a test that was left out must say so")]
fn leave_out(why: &str) {
    assert!(std::env::var("TREADMILL_STRICT").is_err(), "TREADMILL_STRICT is set, and {why}");
    eprintln!("SKIPPED: {why}");
}

#[test]
fn a_machine_that_is_well_has_no_problem_and_everything_is_said_in_words_too() {
    let (folder, _) = folders();
    let output = check(folder.path(), &["--actors", "1"]);
    assert_eq!(last_json(&output)["problems"], 0, "{}", stdout(&output));
    assert_eq!(output.status.code(), Some(0));
    for name in ["disk", "open files", "clock"] {
        assert_ok(&output, name);
    }
    assert!(of(&output, "learner").0.is_empty(), "no learner was named");
    let output = run(folder.path(), &["check", "--actors", "1"]);
    let text = stdout(&output);
    assert!(text.lines().any(|line| line.starts_with("ok       disk")), "{text}");
    assert!(text.trim_end().lines().last().unwrap().contains("diagnoses"), "{text}");
    assert_refused(&check(folder.path(), &["--connect", "tcp/192.0.2.1:1"]), 2, &["--insecure"]);
}

#[test]
fn a_folder_that_cannot_be_written_to_is_named() {
    let (folder, _) = folders();
    // Not even root can create files there.
    assert_problem(&check(folder.path(), &["--run-dir", "/proc/self/runs"]), "disk", &["/proc/self", "--run-dir"]);
}

#[test]
fn a_disk_that_is_full_or_nearly_is_named() {
    let (folder, _) = folders();
    fs::create_dir(folder.path().join("small")).unwrap();
    let nearly = "mount -t tmpfs -o size=50m none small &&";
    if let Some(output) = check_apart(folder.path(), "-rm", nearly, "--run-dir small/run") {
        assert_problem(&output, "disk", &["52 MB free", "free some space"]);
    }
    let full = "mount -t tmpfs -o size=64k none small && cat /dev/zero > small/fill 2> /dev/null;";
    if let Some(output) = check_apart(folder.path(), "-rm", full, "--run-dir small/run") {
        assert_problem(&output, "disk", &["cannot be written to", "No space left"]);
    }
}

#[test]
fn too_few_open_files_are_named() {
    let (folder, _) = folders();
    assert_problem(&check_after(folder.path(), "ulimit -n 64;", ""), "open files", &["64 at most", "ulimit -Hn 4096"]);
    assert!(of(&check(folder.path(), &["--actors", "100000"]), "open files").1.contains("100000 actors"));
}

#[test]
fn a_clock_that_is_wrong_is_named() {
    let (folder, _) = folders();
    if !Command::new("faketime").arg("--version").output().is_ok_and(|told| told.status.success()) {
        return leave_out("faketime is not installed");
    }
    let binary = env!("CARGO_BIN_EXE_treadmill");
    let args = ["1990-05-01 12:00:00", binary, "check", "--json"];
    let output = Command::new("faketime").args(args).current_dir(folder.path()).output().expect("it starts");
    assert_problem(&output, "clock", &["1990-05-01", "timedatectl"]);
}

#[test]
fn a_port_that_is_taken_is_named() {
    let (folder, _) = folders();
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let endpoint = format!("tcp/{}", taken.local_addr().unwrap());
    assert_problem(&check(folder.path(), &["--listen", &endpoint]), "listen", &[&endpoint, "ss -ltnp"]);
    assert_ok(&check(folder.path(), &["--listen", "tcp/127.0.0.1:0"]), "listen");
    assert_problem(&check(folder.path(), &["--listen", "tcp/0.0.0.0:0"]), "listen", &["--insecure"]);
}

#[test]
fn nobody_and_somebody_else_are_told_apart() {
    let (folder, _) = folders();
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let endpoint = format!("tcp/{}", taken.local_addr().unwrap());
    // The listener accepts links and stays silent.
    let output = check(folder.path(), &["--connect", &endpoint]);
    assert_ok(&output, "route");
    assert_problem(&output, "learner", &["does not speak", "ss -ltnp"]);
    drop(taken);
    let output = check(folder.path(), &["--connect", &endpoint]);
    assert_problem(&output, "route", &["no process listens", "endpoint.txt"]);
    assert!(of(&output, "learner").0.is_empty());
    assert_problem(&check(folder.path(), &["--connect", "tls/127.0.0.1:1"]), "route", &[]);
}

/// A learner that trains for as long as it is asked to.
fn learner(folder: &Path, run: &Path, more: &[&str]) -> Running {
    let mut command = treadmill(folder);
    command.args(["learner", "--preset", "smoke", "--steps", "1000000000", "--run-dir", run.to_str().unwrap()]);
    command.args(more);
    let learner = Running::start(command);
    learner.wait_for("listening");
    learner
}

#[test]
fn a_learner_answers_by_its_folder_and_another_runs_name_is_corrected() {
    let (folder, run_folder) = folders();
    let _learner = learner(folder.path(), &run_folder, &["--listen", "tcp/127.0.0.1:0", "--run", "walk"]);
    let output = check(folder.path(), &[run_folder.to_str().unwrap()]);
    for name in ["route", "versions", "clock skew"] {
        assert_ok(&output, name);
    }
    let (verdicts, words) = of(&output, "learner");
    assert!(verdicts == ["note"] && words.contains("treadmill actor --run walk"), "no actor yet: {words}");
    let endpoint = endpoint(&run_folder);
    assert_ok(&check(folder.path(), &["--connect", &endpoint, "--run", "walk"]), "versions");
    let output = check(folder.path(), &["--connect", &endpoint, "--run", "stroll"]);
    assert_problem(&output, "learner", &["stroll", "these do: walk", "--run"]);
}

#[test]
fn a_learner_of_another_version_and_another_time_is_told() {
    let (folder, _) = folders();
    let options = BusOptions { listen: vec!["tcp/127.0.0.1:0".to_string()], ..BusOptions::default() };
    let (bus, endpoints) = Bus::open_router(&options).unwrap();
    let desk = ControlServer::open(&bus, "old").unwrap();
    std::thread::spawn(move || {
        loop {
            let Some(inquiry) = desk.next(Duration::from_millis(100)) else { continue };
            let status = RunStatus {
                run: "old".to_string(),
                program_version: "0.0.1".to_string(),
                time_unix_s: machine::time_unix_s() - 3600.0,
                ..RunStatus::default()
            };
            inquiry.answer("old", &ControlReply { done: true, text: String::new(), status: Some(status) });
        }
    });
    let output = check(folder.path(), &["--connect", &endpoints[0]]);
    assert_problem(&output, "versions", &["0.0.1", env!("CARGO_PKG_VERSION"), "same version"]);
    assert_problem(&output, "clock skew", &["behind this one", "NTP"]);
    bus.close();
}

fn certs(folder: &Path, args: &[&str]) {
    let made = run(folder, &[&["certs"], args].concat());
    assert!(made.status.success(), "{}", stderr(&made));
}

/// An observer's certificate by the authority of `certs/`, valid between these days from now.
fn issue_observer(folder: &Path, from_days: i64, until_days: i64) {
    let read = |name: &str| fs::read_to_string(folder.join("certs").join(name)).unwrap();
    let authority = KeyPair::from_pem(&read("ca.key")).unwrap();
    let issuer = Issuer::from_ca_cert_pem(&read("ca.crt"), authority).unwrap();
    let mut params = CertificateParams::new(Vec::new()).unwrap();
    params.distinguished_name.push(DnType::CommonName, "treadmill-observer");
    params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ClientAuth];
    let now = OffsetDateTime::now_utc();
    params.not_before = now + time::Duration::days(from_days);
    params.not_after = now + time::Duration::days(until_days);
    let pair = KeyPair::generate().unwrap();
    fs::write(folder.join("certs/observer.crt"), params.signed_by(&pair, &issuer).unwrap().pem()).unwrap();
    fs::write(folder.join("certs/observer.key"), pair.serialize_pem()).unwrap();
    fs::set_permissions(folder.join("certs/observer.key"), fs::Permissions::from_mode(0o600)).unwrap();
}

#[test]
fn certificates_are_judged_by_their_days_their_authority_and_their_keys() {
    let (folder, _) = folders();
    certs(folder.path(), &["certs"]);
    let look = || check(folder.path(), &["--tls", "certs"]);
    assert_ok(&look(), "certificates");
    assert!(of(&look(), "certificates").1.contains("127.0.0.1"), "it says for which hosts");
    issue_observer(folder.path(), -30, -3);
    assert_problem(&look(), "certificates", &["observer", "expired", "--renew"]);
    issue_observer(folder.path(), 3, 30);
    assert_problem(&look(), "certificates", &["observer", "not valid before", "clock"]);
    issue_observer(folder.path(), -30, 3);
    assert!(of(&look(), "certificates").0.contains(&"note".to_string()), "soon over");
    issue_observer(folder.path(), -30, 300);
    assert_ok(&look(), "certificates");
    let path = |name: &str| folder.path().join("certs").join(name);
    fs::set_permissions(path("observer.key"), fs::Permissions::from_mode(0o644)).unwrap();
    assert_problem(&look(), "certificates", &["644", "chmod 600"]);
    fs::set_permissions(path("observer.key"), fs::Permissions::from_mode(0o600)).unwrap();
    fs::copy(path("observer.key"), path("operator.key")).unwrap();
    assert_problem(&look(), "certificates", &["operator.key", "does not match"]);
    fs::copy(path("observer.crt"), path("operator.crt")).unwrap();
    assert_problem(&look(), "certificates", &["treadmill-observer", "treadmill-operator"]);
    certs(folder.path(), &["others"]);
    fs::copy(folder.path().join("others/ca.crt"), path("ca.crt")).unwrap();
    assert_problem(&look(), "certificates", &["another authority"]);
    fs::write(path("ca.crt"), "nothing").unwrap();
    assert_problem(&look(), "certificates", &["ca.crt"]);
}

#[test]
fn a_handshake_says_which_side_does_not_trust_which() {
    let (folder, run_folder) = folders();
    certs(folder.path(), &["certs"]);
    certs(folder.path(), &["others"]);
    let _learner = learner(folder.path(), &run_folder, &["--listen", "tls/127.0.0.1:0", "--tls", "certs"]);
    let endpoint = endpoint(&run_folder);
    let look = |tls: &str, endpoint: &str| check(folder.path(), &["--connect", endpoint, "--tls", tls]);
    let output = look("certs", &endpoint);
    for name in ["certificates", "route", "handshake", "versions", "clock skew"] {
        assert_ok(&output, name);
    }
    assert_problem(&look("others", &endpoint), "handshake", &["another authority", "ca.crt"]);
    // Its certificate names no such host.
    let elsewhere = endpoint.replace("127.0.0.1", "127.0.0.2");
    assert_problem(&look("certs", &elsewhere), "route", &["no process listens"]);
    certs(folder.path(), &["certs", "--renew", "--host", "learner.example"]);
    let renamed = run_folder.with_extension("renamed");
    let _renamed = learner(folder.path(), &renamed, &["--listen", "tls/127.0.0.1:0", "--tls", "certs"]);
    let refused = look("certs", &self::endpoint(&renamed));
    assert_problem(&refused, "handshake", &["not for this name", "--host NAME"]);
    // Ours are of another authority than the learner trusts, and we trust the learner's.
    fs::copy(folder.path().join("certs/ca.crt"), folder.path().join("others/ca.crt")).unwrap();
    assert_problem(&look("others", &endpoint), "handshake", &["rejects our certificate"]);
    // With an actor's certificate alone, the check still shows that the link works.
    for part in ["learner", "router", "evaluator", "observer", "operator"] {
        fs::remove_file(folder.path().join(format!("certs/{part}.crt"))).unwrap();
    }
    let output = look("certs", &endpoint);
    assert_ok(&output, "handshake");
    assert_eq!(of(&output, "learner").0, ["note"], "{}", stdout(&output));
    let output = check(folder.path(), &["--connect", &endpoint]);
    assert_problem(&output, "route", &["--tls DIR"]);
}
