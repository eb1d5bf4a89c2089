//! `treadmill check`: every problem of a machine or of the route to a learner that it can report, caused on purpose.

use std::{
    fs,
    net::TcpListener,
    os::unix::fs::PermissionsExt,
    path::Path,
    process::{Command, Output},
};

use crate::support::*;
use serde_json::Value;
use treadmill_bus::{Bus, BusOptions, Role};
use treadmill_proto::RunStatus;
use treadmill_runtime::machine;

/// Returns the verdicts of the findings with this name, and their whole text.
fn of(output: &Output, name: &str) -> (Vec<String>, String) {
    let report = last_json(output);
    let findings = report["findings"].as_array().expect("findings");
    let named: Vec<&Value> = findings.iter().filter(|finding| finding["name"] == name).collect();
    let verdicts = named.iter().map(|finding| finding["verdict"].as_str().unwrap().to_string()).collect();
    (verdicts, named.iter().map(|finding| finding.to_string()).collect::<Vec<_>>().join("\n"))
}

/// Asserts a problem, parts of its text, and the exit code.
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

/// Runs the check in a shell after the commands of `before`. `wrapper` starts the shell.
fn check_after(folder: &Path, wrapper: &[&str], before: &str, args: &str) -> Output {
    let script = format!("{before} exec {} check --json {args}", env!("CARGO_BIN_EXE_treadmill"));
    let words = [wrapper, &["sh", "-c", &script]].concat();
    Command::new(words[0]).args(&words[1..]).current_dir(folder).output().expect("a shell")
}

#[test]
fn a_healthy_machine_has_no_problems_in_json_and_in_text() {
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
fn an_unwritable_folder_is_reported() {
    let (folder, _) = folders();
    // Not even root can create files in /proc.
    assert_problem(&check(folder.path(), &["--run-dir", "/proc/self/runs"]), "disk", &["/proc/self", "--run-dir"]);
}

#[test]
fn a_full_or_nearly_full_disk_is_reported() {
    let (folder, _) = folders();
    fs::create_dir(folder.path().join("small")).unwrap();
    if !works("unshare", &["-rm", "true"]) {
        return skip("`unshare -rm` is not allowed here");
    }
    let nearly = "mount -t tmpfs -o size=50m none small &&";
    let full = "mount -t tmpfs -o size=64k none small && cat /dev/zero > small/fill 2> /dev/null;";
    for (before, parts) in
        [(nearly, ["52 MB free", "free some space"]), (full, ["cannot be written to", "No space left"])]
    {
        let output = check_after(folder.path(), &["unshare", "-rm"], before, "--run-dir small/run");
        assert_problem(&output, "disk", &parts);
    }
}

#[test]
fn too_few_open_files_are_reported() {
    let (folder, _) = folders();
    assert_problem(
        &check_after(folder.path(), &[], "ulimit -n 64;", ""),
        "open files",
        &["64 at most", "ulimit -Hn 4096"],
    );
    assert!(of(&check(folder.path(), &["--actors", "100000"]), "open files").1.contains("100000 actors"));
}

#[test]
fn a_wrong_clock_is_reported() {
    let (folder, _) = folders();
    if !works("faketime", &["--version"]) {
        return skip("faketime is not installed");
    }
    let output = check_after(folder.path(), &["faketime", "1990-05-01 12:00:00"], "", "");
    assert_problem(&output, "clock", &["1990-05-01", "timedatectl"]);
}

#[test]
fn a_port_in_use_is_reported() {
    let (folder, _) = folders();
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let endpoint = format!("tcp/{}", taken.local_addr().unwrap());
    assert_problem(&check(folder.path(), &["--listen", &endpoint]), "listen", &[&endpoint, "ss -ltnp"]);
    assert_ok(&check(folder.path(), &["--listen", "tcp/127.0.0.1:0"]), "listen");
    assert_problem(&check(folder.path(), &["--listen", "tcp/0.0.0.0:0"]), "listen", &["--insecure"]);
}

#[test]
fn no_listener_and_a_listener_of_another_program_are_distinguished() {
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
    assert_refused(&check(folder.path(), &["--connect", "tls/127.0.0.1:1"]), 2, &["--tls DIR"]);
}

/// Starts a learner.
fn learner(folder: &Path, run: &Path, more: &[&str]) -> Running {
    let mut command = endless(folder, run, "learner");
    command.args(more);
    let learner = Running::start(command);
    learner.wait_for("listening");
    learner
}

#[test]
fn a_learner_is_found_by_its_folder_and_a_wrong_run_name_is_reported() {
    let (folder, run_folder) = folders();
    let _learner = learner(folder.path(), &run_folder, &["--listen", "tcp/127.0.0.1:0", "--run", "walk"]);
    let output = check(folder.path(), &[run_folder.to_str().unwrap()]);
    for name in ["route", "versions", "clock skew"] {
        assert_ok(&output, name);
    }
    let (verdicts, words) = of(&output, "learner");
    let endpoint = endpoint(&run_folder);
    let wanted = format!("start an actor: treadmill actor --connect {endpoint} --run walk");
    assert!(verdicts == ["note"] && words.contains(&wanted), "no actor yet: {words}");
    assert_ok(&check(folder.path(), &["--connect", &endpoint, "--run", "walk"]), "versions");
    let output = check(folder.path(), &["--connect", &endpoint, "--run", "stroll"]);
    assert_problem(&output, "learner", &["no learner trains a run `stroll`", "with --run: walk"]);
}

#[test]
fn a_run_that_no_process_trains_is_reported() {
    let (folder, run_folder) = folders();
    trained(folder.path(), &run_folder);
    let output = check(folder.path(), &[run_folder.to_str().unwrap()]);
    assert_problem(&output, "learner", &["no process trains", "train --resume"]);
}

#[test]
fn a_learner_of_another_version_with_a_wrong_clock_is_reported() {
    let (folder, _) = folders();
    let options = BusOptions { listen: vec!["tcp/127.0.0.1:0".to_string()], ..BusOptions::default() };
    let (bus, endpoints) = Bus::open_router(&options).unwrap();
    let status = RunStatus {
        run: "old".to_string(),
        program_version: "0.0.1".to_string(),
        time_unix_s: machine::time_unix_s() - 3600.0,
        ..RunStatus::default()
    };
    let server = StatusServer::start(&bus, status);
    let output = check(folder.path(), &["--connect", &endpoints[0]]);
    assert_problem(&output, "versions", &["0.0.1", env!("CARGO_PKG_VERSION"), "same version"]);
    assert_problem(&output, "clock skew", &["behind this one", "NTP"]);
    drop(server);
    bus.close();
}

#[test]
fn problems_of_dates_authorities_and_keys_of_certificates_are_reported() {
    let (folder, _) = folders();
    certs(folder.path(), &["certs"]);
    let check_certs = || check(folder.path(), &["--tls", "certs"]);
    assert_ok(&check_certs(), "certificates");
    assert!(of(&check_certs(), "certificates").1.contains("127.0.0.1"), "the hosts of the certificate");
    let own = folder.path().join("certs");
    let issue_observer = |days| issue(Role::Observer, &own, &own, days);
    issue_observer([-30, -3]);
    assert_problem(&check_certs(), "certificates", &["observer", "expired", "--renew"]);
    issue_observer([3, 30]);
    assert_problem(&check_certs(), "certificates", &["observer", "not valid before", "clock"]);
    issue_observer([-30, 3]);
    assert!(of(&check_certs(), "certificates").0.contains(&"note".to_string()), "it expires soon");
    issue_observer([-30, 300]);
    assert_ok(&check_certs(), "certificates");
    let path = |name: &str| own.join(name);
    fs::set_permissions(path("observer.key"), fs::Permissions::from_mode(0o644)).unwrap();
    assert_problem(&check_certs(), "certificates", &["644", "chmod 600"]);
    fs::set_permissions(path("observer.key"), fs::Permissions::from_mode(0o600)).unwrap();
    fs::copy(path("observer.key"), path("operator.key")).unwrap();
    assert_problem(&check_certs(), "certificates", &["operator.key", "does not match"]);
    fs::copy(path("observer.crt"), path("operator.crt")).unwrap();
    assert_problem(&check_certs(), "certificates", &["treadmill-observer", "treadmill-operator"]);
    certs(folder.path(), &["others"]);
    fs::copy(folder.path().join("others/ca.crt"), path("ca.crt")).unwrap();
    assert_problem(&check_certs(), "certificates", &["another authority"]);
    fs::write(path("ca.crt"), "nothing").unwrap();
    assert_problem(&check_certs(), "certificates", &["ca.crt"]);
}

#[test]
fn a_failed_handshake_reports_which_side_does_not_trust_the_other() {
    let (folder, run_folder) = folders();
    certs(folder.path(), &["certs"]);
    certs(folder.path(), &["others"]);
    let _learner = learner(folder.path(), &run_folder, &["--listen", "tls/127.0.0.1:0", "--tls", "certs"]);
    let endpoint = endpoint(&run_folder);
    let check_with = |tls: &str, endpoint: &str| check(folder.path(), &["--connect", endpoint, "--tls", tls]);
    let output = check_with("certs", &endpoint);
    for name in ["certificates", "route", "handshake", "versions", "clock skew"] {
        assert_ok(&output, name);
    }
    assert_problem(&check_with("others", &endpoint), "handshake", &["another authority", "ca.crt"]);
    // No learner listens at this address.
    let elsewhere = endpoint.replace("127.0.0.1", "127.0.0.2");
    assert_problem(&check_with("certs", &elsewhere), "route", &["no process listens"]);
    let named = folder.path().join("named");
    fs::create_dir(&named).unwrap();
    for file in ["ca.crt", "ca.key"] {
        fs::copy(folder.path().join("certs").join(file), named.join(file)).unwrap();
    }
    certs(folder.path(), &["named", "--host", "learner.example"]);
    let renamed = run_folder.with_extension("renamed");
    let _renamed = learner(folder.path(), &renamed, &["--listen", "tls/127.0.0.2:0", "--tls", "named"]);
    let refused = check_with("certs", &self::endpoint(&renamed));
    assert_problem(&refused, "handshake", &["not for this name", "--host NAME"]);
    // This machine trusts the learner's authority, but not the other way round.
    fs::copy(folder.path().join("certs/ca.crt"), folder.path().join("others/ca.crt")).unwrap();
    assert_problem(&check_with("others", &endpoint), "handshake", &["rejects our certificate"]);
    // With an actor's certificate alone, the check still shows that the link works.
    for part in ["learner", "router", "evaluator", "observer", "operator"] {
        fs::remove_file(folder.path().join(format!("certs/{part}.crt"))).unwrap();
    }
    let output = check_with("certs", &endpoint);
    assert_ok(&output, "handshake");
    assert_eq!(of(&output, "learner").0, ["note"], "{}", stdout(&output));
    assert_refused(&check(folder.path(), &["--connect", &endpoint]), 2, &["--tls DIR"]);
}
