//! No learner answers: every command finds the cause, and ends with the command that examines everything.

use std::path::Path;

use crate::support::*;

/// Asserts that a client reports `parts` and ends with `treadmill check` and `flags`.
#[track_caller]
fn assert_cause(folder: &Path, args: &[&str], parts: &[&str], flags: &str) {
    let output = run(folder, args);
    assert_refused(&output, 1, parts);
    let text = stderr(&output);
    assert_eq!(text.lines().last().map(str::trim), Some(&format!("treadmill check {flags}")[..]), "{text}");
    assert!(!text.contains(".cargo") && !text.contains(".rs:"), "{text}");
}

fn learner(folder: &Path, flags: &[&str]) -> Running {
    start(folder, &[&["learner", "--preset", "smoke", "--run-dir", "run", "--run", "walk"], flags].concat())
}

#[test]
fn a_closed_port_and_an_unknown_host_are_named() {
    let (folder, _) = folders();
    let folder = folder.path();
    let port = free_port();
    let flags = format!("--connect tcp/127.0.0.1:{port}");
    for command in [&["status"][..], &["control", "pause"]] {
        let args = [command, &["--connect", &flags[10..]]].concat();
        assert_cause(folder, &args, &["no process listens at", "start the learner"], &flags);
    }
    let flags = "--connect tcp/no-such-host.invalid:1 --insecure";
    let args = ["status", "--connect", "tcp/no-such-host.invalid:1", "--insecure"];
    assert_cause(folder, &args, &["the host of tcp/no-such-host.invalid:1 is unknown", "getent hosts"], flags);
    for client in ["actor", "evaluator"] {
        let line = start(folder, &[client, "--run", "walk", "--connect", &format!("tcp/127.0.0.1:{port}")])
            .wait_for("no answer; retrying");
        for part in ["cause=no process listens", "start the learner", "treadmill check --connect", " --run walk"] {
            assert!(line.contains(part), "`{part}` is missing in: {line}");
        }
    }
}

#[test]
fn encryption_without_certificates_is_refused_on_both_sides() {
    let (folder, _) = folders();
    let folder = folder.path();
    let missing = ["tls/127.0.0.1:0", "--tls is missing", "treadmill certs DIR"];
    assert_refused(&run(folder, &["learner", "--preset", "smoke", "--listen", "tls/127.0.0.1:0"]), 2, &missing);
    for client in [&["actor"][..], &["evaluator"], &["status"], &["control", "pause"], &["check"]] {
        assert_refused(&run(folder, &[client, &["--connect", "tls/127.0.0.1:0"]].concat()), 2, &missing);
    }
    assert!(!folder.join("runs").exists(), "nothing is left behind");
}

#[test]
fn other_certificates_and_plain_text_are_recognised() {
    let (folder, path) = folders();
    let folder = folder.path();
    certs(folder, &["certs"]);
    certs(folder, &["others"]);
    let _learner = learner(folder, &["--listen", "tls/127.0.0.1:0", "--tls", "certs"]);
    let endpoint = endpoint(&path);
    let others = folder.join("others").canonicalize().unwrap();
    let flags = format!("--connect {endpoint} --tls {}", others.display());
    let args = ["status", "--connect", &endpoint, "--tls", "others"];
    assert_cause(folder, &args, &["127.0.0.1's certificate is refused: it is of another authority"], &flags);
    let plain = endpoint.replace("tls/", "tcp/");
    let flags = format!("--connect {plain}");
    let args = ["status", "--connect", &plain];
    assert_cause(folder, &args, &[&format!("{plain} speaks TLS"), &format!("dial {endpoint}")], &flags);
    // An actor learns the same.
    start(folder, &["actor", "--connect", &endpoint, "--tls", "others"]).wait_for("it is of another authority");
    let certs = folder.join("certs").canonicalize().unwrap();
    for client in ["actor", "evaluator"] {
        let line = start(folder, &[client, "--connect", &endpoint, "--tls", "certs", "--run", "wlak"])
            .wait_for("no learner answers; retrying");
        assert!(line.contains("did you mean `walk`?") && line.contains(certs.to_str().unwrap()), "{line}");
    }
}

#[test]
fn a_misspelled_run_gets_the_nearest_name() {
    let (folder, path) = folders();
    let folder = folder.path();
    let _learner = learner(folder, &["--listen", "tcp/127.0.0.1:0"]);
    let endpoint = endpoint(&path);
    let flags = format!("--connect {endpoint} --run wlak");
    for command in [&["status"][..], &["control", "pause"]] {
        let args = [command, &["--connect", &endpoint, "--run", "wlak"]].concat();
        assert_cause(folder, &args, &["no learner trains a run `wlak`", "did you mean `walk`?"], &flags);
    }
    let line =
        start(folder, &["actor", "--connect", &endpoint, "--run", "wlak"]).wait_for("no learner answers; retrying");
    assert!(line.contains("did you mean `walk`?"), "{line}");
    start(folder, &["status", "--watch", "--connect", &endpoint, "--run", "wlak"]).wait_for("did you mean `walk`?");
}

#[test]
fn a_run_without_actors_says_how_to_start_one() {
    let (folder, path) = folders();
    let _learner = learner(folder.path(), &["--listen", "tcp/127.0.0.1:0"]);
    let command = format!("no actor is connected; start one: treadmill actor --connect {} --run walk", endpoint(&path));
    let text = stdout(&run(folder.path(), &["status", "run"]));
    assert!(text.contains(&format!("ALARM      {command}")) && text.contains(", 0 per second"), "{text}");
    assert_eq!(last_json(&run(folder.path(), &["status", "run", "--json"]))["alarms"][0], command);
}

#[test]
fn following_waits_for_a_run_and_ends_with_its_results() {
    let (folder, _) = folders();
    let following = start(folder.path(), &["status", "run", "--watch"]);
    following.wait_for("waiting: there is no run at `run`");
    let training =
        start(folder.path(), &["train", "--preset", "smoke", "--steps", ENDLESS, "--run-dir", "run", "--no-progress"]);
    let line = following.wait_for("run `run` trains: ");
    assert!(line.chars().count() <= 160 && line.contains(" steps/s, actors: "), "{line}");
    stop(training);
    following.wait_for("run `run` is stopped: no process trains it");
    assert!(following.wait().0.success());
}
