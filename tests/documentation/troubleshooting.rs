//! Failures caused on purpose: the program's messages are those that the page `troubleshooting` quotes.

use std::{
    collections::BTreeSet,
    fs,
    path::Path,
    process::{Command, Output},
    sync::LazyLock,
};

use treadmill_runtime::{machine, numbers::thousands};

use crate::attacks::{Attacker, corrupted};
use crate::support::*;

/// Headings of the page that are marked as tested, with the lines quoted below each.
static PAGE: LazyLock<Vec<(String, BTreeSet<String>)>> = LazyLock::new(|| {
    let page = page("operations/troubleshooting");
    let mut sections: Vec<(String, BTreeSet<String>)> = Vec::new();
    for section in page.split("\n### ").skip(1).filter_map(|section| section.strip_prefix("● ")) {
        let (heading, rest) = section.split_once('\n').unwrap();
        let quoted = rest.split("```text\n").skip(1).filter_map(|block| block.split("\n```").next());
        sections.push((heading.to_string(), quoted.flat_map(str::lines).map(str::to_string).collect()));
    }
    sections
});

/// Asserts that the page quotes this line below this heading.
fn assert_quoted(heading: &str, line: &str) {
    let (_, quoted) = PAGE.iter().find(|(known, _)| known == heading).unwrap_or_else(|| panic!("no heading {heading}"));
    let line = line.split_once(" WARN ").map_or(line.to_string(), |(_, text)| format!("WARN {text}"));
    assert!(quoted.contains(&line), "the page `troubleshooting` does not quote\n{line}\nbut\n{quoted:#?}");
}

/// Runs a command that fails, and asserts that the page quotes its error.
fn assert_error(heading: &str, folder: &Path, args: &[&str], replaced: &[(&str, &str)]) {
    assert_failed(heading, &run(folder, args), replaced);
}

fn assert_failed(heading: &str, output: &Output, replaced: &[(&str, &str)]) {
    assert!(!output.status.success(), "{heading}: {}", stdout(output));
    let text = stderr(output);
    let error = text.lines().find(|line| line.starts_with("error: ")).unwrap_or_else(|| panic!("no error in {text}"));
    assert_quoted(heading, &with(error, replaced));
}

/// Waits for a line with this part, and asserts that the page quotes it.
fn assert_line(heading: &str, running: &Running, part: &str, replaced: &[(&str, &str)]) {
    assert_quoted(heading, &with(&running.wait_for(part), replaced));
}

/// Compares the log of a rejected connection, without its peer, which not every system knows.
fn assert_rejection(heading: &str, learner: &Running, part: &str, replaced: &[(&str, &str)]) {
    let line = with(&learner.wait_for(part), replaced);
    assert_quoted(heading, line.split(" peer=").next().unwrap());
}

/// Replaces parts that differ in each run with those that the page quotes.
fn with(line: &str, replaced: &[(&str, &str)]) -> String {
    replaced.iter().fold(line.to_string(), |line, (part, quoted)| line.replace(part, quoted))
}

fn start(folder: &Path, args: &[&str]) -> Running {
    let mut command = treadmill(folder);
    command.args(args);
    Running::start(command)
}

/// Returns an endpoint without a listener.
fn unused_endpoint() -> String {
    format!("tcp/127.0.0.1:{}", free_port())
}

/// Endpoint that the page quotes.
const QUOTED_ENDPOINT: &str = "tcp/127.0.0.1:7447";

#[test]
fn a_store_holds_a_run_already() {
    let folder = tempfile::tempdir().unwrap();
    let url = format!("file://{}/store", folder.path().display());
    let train = ["train", "--preset", "smoke", "--steps", "2048", "--actors", "1", "--store", &url, "--run-dir"];
    assert!(run(folder.path(), &[&train[..], &["run"]].concat()).status.success());
    let again = [&train[..], &["again"]].concat();
    assert_error("The store holds a run already", folder.path(), &again, &[(&url, "file:///tmp/walk")]);
}

#[test]
fn every_marked_heading_is_tested_here() {
    assert!(PAGE.len() >= 10);
    for (heading, quoted) in PAGE.iter() {
        let named = include_str!("troubleshooting.rs").contains(&format!("\"{heading}\""));
        assert!(named && !quoted.is_empty(), "{heading}");
    }
}

#[test]
fn no_learner_answers() {
    let (folder, _) = folders();
    let endpoint = unused_endpoint();
    let replaced = [(&endpoint[..], QUOTED_ENDPOINT)];
    let actor = start(folder.path(), &["actor", "--connect", &endpoint]);
    assert_error("Asking a learner that is not up", folder.path(), &["status", "--connect", &endpoint], &replaced);
    assert_line("An actor that waits for its learner", &actor, "no answer; retrying", &replaced);
    assert_error("There is no such run", folder.path(), &["status", "nowhere"], &[]);
}

#[test]
fn another_run_answers_and_an_actor_sends_malformed_fragments() {
    let (folder, run) = folders();
    let learner =
        start(folder.path(), &["learner", "--preset", "smoke", "--run-dir", "run", "--listen", "tcp/127.0.0.1:0"]);
    let endpoint = endpoint(&run);
    let replaced = [(&endpoint[..], QUOTED_ENDPOINT)];
    let heading = "The name of the run is wrong";
    let lost = start(folder.path(), &["actor", "--connect", &endpoint, "--run", "rum", "--envs", "4"]);
    assert_line(heading, &lost, "no learner answers", &replaced);
    assert_error(heading, folder.path(), &["status", "--connect", &endpoint, "--run", "rum"], &replaced);
    assert_error(
        "The port is in use",
        folder.path(),
        &["learner", "--preset", "smoke", "--listen", &endpoint],
        &replaced,
    );

    let liar = Attacker::join(&endpoint, "run", None, crate::attacks::TIMEOUT).unwrap();
    let malformed = corrupted(&liar.policy(), "liar", f32::NAN);
    for _ in 0..8 {
        liar.send("liar", malformed.clone());
    }
    let heading = "An actor is in quarantine";
    assert_line(heading, &learner, "fragment rejected", &[]);
    assert_line(heading, &learner, "sender quarantined", &[]);
}

#[test]
fn commands_cannot_start() {
    let (folder, _) = folders();
    let folder = folder.path();
    let learner = |args: &[&'static str]| [&["learner", "--preset", "smoke", "--run-dir", "other"], args].concat();
    let args = learner(&["--listen", "tcp/0.0.0.0:7447"]);
    assert_error("Plain text beyond this machine", folder, &args, &[]);
    let args = learner(&["--listen", "tls/0.0.0.0:7447", "--tls", "certs"]);
    let place = folder.canonicalize().unwrap();
    assert_error("Certificates are missing", folder, &args, &[(place.to_str().unwrap(), "FOLDER")]);
    let heading = "A key, a value or a preset that does not exist";
    assert_error(heading, folder, &learner(&["--set", "ppo.epoch=3"]), &[]);
    assert_error(heading, folder, &learner(&["--set", "ppo.epochs=0"]), &[]);
    assert_error(heading, folder, &["train", "--preset", "stroll"], &[]);
    if !Path::new("/dev/nvidiactl").exists() {
        assert_error("No GPU", folder, &learner(&["--device", "cuda"]), &[]);
    }
    fs::write(folder.join("robot.xml"), "robot").unwrap();
    assert_error("A model that cannot be read", folder, &learner(&["--model", "robot.xml"]), &[]);
    assert_error("An actor of another task", folder, &["train", "--task", "external"], &[]);
    let script = format!("ulimit -n 40 && exec {} train --run-dir other", env!("CARGO_BIN_EXE_treadmill"));
    let output = Command::new("sh").args(["-c", &script]).current_dir(folder).output().expect("a shell");
    assert_failed("Too few files may be open", &output, &[]);
    assert!(!folder.join("other").exists(), "no folder is left behind");
}

#[test]
fn runs_cannot_be_resumed() {
    let (folder, run) = folders();
    let folder = folder.path();
    let train = ["train", "--preset", "smoke", "--run-dir", "run", "--no-progress"];
    assert!(crate::support::run(folder, &train).status.success());
    assert_error("The folder holds another run", folder, &train, &[]);
    let args = ["train", "--resume", "run", "--set", "ppo.epochs=3"];
    assert_error("A resumed run is given another configuration", folder, &args, &[]);

    let args = ["train", "--resume", "run", "--steps", "4096"];
    // The last batch may be larger than needed.
    let reached = last_value(&run, "time/total_timesteps").unwrap() as u64;
    let [is_at, further] = [thousands(reached), (2 * reached).to_string()];
    assert_error("The run has its steps already", folder, &args, &[(&is_at, "8,192"), (&further, "16384")]);
    let training = start(folder, &["train", "--resume", "run", "--steps", ENDLESS, "--no-progress"]);
    await_steps(&run, 9000);
    let (pid, host, at) = (format!("process {}", training.pid()), machine::host_name(), endpoint(&run));
    let host = format!("host {host},");
    let replaced = [(pid.as_str(), "process PID"), (host.as_str(), "host HOST,"), (at.as_str(), "ENDPOINT")];
    assert_error("Another process trains the run", folder, &["train", "--resume", "run"], &replaced);
    training.signal(libc::SIGINT);
    training.wait();

    let checkpoint = |name: &str| run.join("checkpoints").join(name);
    let valid = fs::read(checkpoint("latest.bundle")).unwrap();
    let mut old = valid.clone();
    old[8] = 2;
    fs::write(checkpoint("latest.bundle"), old).unwrap();
    assert_error("The checkpoint is of another version", folder, &["train", "--resume", "run"], &[]);
    let heading = "A checkpoint is damaged";
    fs::write(checkpoint("latest.bundle"), "garbage").unwrap();
    let exported = crate::support::run(folder, &["export", "run", "--checkpoint", "latest", "--safetensors", "policy"]);
    let text = stderr(&exported);
    assert!(exported.status.success(), "{text}");
    let warning = text.lines().find(|line| line.contains("WARN")).expect("a warning");
    // The best policy may be that of any evaluation.
    let (before, _) = warning.rsplit_once("updates=").expect("the number of updates");
    assert_quoted(heading, &format!("{before}updates=16"));
    for bundle in ["latest.bundle", "best.bundle"] {
        fs::write(checkpoint(bundle), "x").unwrap();
    }
    assert_error(heading, folder, &["train", "--resume", "run"], &[]);
}

#[test]
fn an_actor_dies_and_a_key_cannot_be_changed() {
    let (folder, run) = folders();
    let args = ["train", "--preset", "smoke", "--steps", ENDLESS, "--run-dir", "run", "--no-progress"];
    let training = start(folder.path(), &args);
    await_steps(&run, 512);
    let args = ["control", "set", "rollout.envs", "3", "run"];
    assert_error("A key that cannot be changed while the run goes on", folder.path(), &args, &[]);
    let victim = await_that("an actor", || children(training.pid(), "actor-1").pop());
    send_signal(victim, libc::SIGKILL);
    assert_line("An actor process dies", &training, "starting it again", &[]);
}

#[test]
fn clients_without_the_right_certificate_are_refused() {
    let (folder, run) = folders();
    let folder = folder.path();
    for authority in ["certs", "others"] {
        assert!(crate::support::run(folder, &["certs", authority]).status.success());
    }
    let listen = ["--listen", "tls/127.0.0.1:0", "--tls", "certs"];
    let learner = start(folder, &[&["learner", "--preset", "smoke", "--run-dir", "run"][..], &listen].concat());
    let endpoint = endpoint(&run);
    let stranger = start(folder, &["actor", "--tls", "others", "--connect", &endpoint]);
    assert_rejection("A certificate of another authority", &learner, "connection rejected", &[]);
    drop(stranger);
    let _plain = start(folder, &["actor", "--connect", &endpoint.replace("tls/", "tcp/")]);
    // Plain text begins with its length, which a short ID of the session makes the number of a handshake.
    let short_id = [("UnknownProtocolVersion", "InvalidContentType")];
    assert_rejection("Plain text where TLS is spoken", &learner, "does not speak TLS", &short_id);

    // An observer's certificate under an operator's file names.
    fs::create_dir(folder.join("theirs")).unwrap();
    for (from, to) in [("ca.crt", "ca.crt"), ("observer.crt", "operator.crt"), ("observer.key", "operator.key")] {
        fs::copy(folder.join("certs").join(from), folder.join("theirs").join(to)).unwrap();
    }
    let args = ["control", "pause", "run", "--run", "run", "--tls", "theirs"];
    let place = folder.join("theirs").canonicalize().unwrap();
    assert_error("The learner takes no command", folder, &args, &[(place.to_str().unwrap(), "FOLDER")]);
}
