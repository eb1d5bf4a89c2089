//! Mistakes and mishaps, caused on purpose: what is told of each is what the page `troubleshooting` quotes.

use std::{
    collections::BTreeSet,
    fs,
    net::TcpListener,
    path::Path,
    process::{Command, Output},
    sync::LazyLock,
};

use crate::attacks::{Attacker, spoilt};
use crate::support::*;

/// The page's headings that are marked as tested, with the lines that are quoted below each.
static PAGE: LazyLock<Vec<(String, BTreeSet<String>)>> = LazyLock::new(|| {
    let page = page("operations/troubleshooting");
    let mut told: Vec<(String, BTreeSet<String>)> = Vec::new();
    for section in page.split("\n### ").skip(1).filter_map(|section| section.strip_prefix("● ")) {
        let (heading, rest) = section.split_once('\n').unwrap();
        let quoted = rest.split("```text\n").skip(1).filter_map(|block| block.split("\n```").next());
        told.push((heading.to_string(), quoted.flat_map(str::lines).map(str::to_string).collect()));
    }
    told
});

/// Asserts that the page quotes this line below this heading.
fn is_quoted(heading: &str, line: &str) {
    let (_, quoted) = PAGE.iter().find(|(known, _)| known == heading).unwrap_or_else(|| panic!("no heading {heading}"));
    let line = line.split_once(" WARN ").map_or(line.to_string(), |(_, text)| format!("WARN {text}"));
    assert!(quoted.contains(&line), "the page `troubleshooting` does not quote\n{line}\nbut\n{quoted:#?}");
}

/// Runs to an error, and asserts that the page quotes it.
fn fails(heading: &str, folder: &Path, args: &[&str], replaced: &[(&str, &str)]) {
    has_failed(heading, &run(folder, args), replaced);
}

fn has_failed(heading: &str, output: &Output, replaced: &[(&str, &str)]) {
    assert!(!output.status.success(), "{heading}: {}", stdout(output));
    let text = stderr(output);
    let error = text.lines().find(|line| line.starts_with("error: ")).unwrap_or_else(|| panic!("no error in {text}"));
    is_quoted(heading, &with(error, replaced));
}

/// Waits for a line with this part, and asserts that the page quotes it.
fn tells(heading: &str, running: &Running, part: &str, replaced: &[(&str, &str)]) {
    is_quoted(heading, &with(&running.wait_for(part), replaced));
}

fn with(line: &str, replaced: &[(&str, &str)]) -> String {
    replaced.iter().fold(line.to_string(), |line, (is, quoted)| line.replace(is, quoted))
}

fn start(folder: &Path, args: &[&str]) -> Running {
    let mut command = treadmill(folder);
    command.args(args);
    Running::start(command)
}

/// An endpoint without a listener.
fn deserted() -> String {
    format!("tcp/{}", TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap())
}

const USUAL: &str = "tcp/127.0.0.1:7447";
const ENDLESS: &str = "1000000000";

#[test]
fn every_message_that_is_marked_is_caused_here() {
    assert!(PAGE.len() >= 10);
    for (heading, quoted) in PAGE.iter() {
        let named = include_str!("troubleshooting.rs").contains(&format!("\"{heading}\""));
        assert!(named && !quoted.is_empty(), "{heading}");
    }
}

#[test]
fn nobody_answers() {
    let (folder, _) = folders();
    let endpoint = deserted();
    let replaced = [(&endpoint[..], USUAL)];
    let actor = start(folder.path(), &["actor", "--connect", &endpoint]);
    fails("Asking a learner that is not up", folder.path(), &["status", "--connect", &endpoint], &replaced);
    tells("An actor that waits for its learner", &actor, "nobody answers", &replaced);
    fails("There is no such run", folder.path(), &["status", "nowhere"], &[]);
}

#[test]
fn another_run_is_there_and_somebody_sends_nonsense() {
    let (folder, run) = folders();
    let learner =
        start(folder.path(), &["learner", "--preset", "smoke", "--run-dir", "run", "--listen", "tcp/127.0.0.1:0"]);
    let endpoint = endpoint(&run);
    let replaced = [(&endpoint[..], USUAL)];
    let heading = "The name of the run is wrong";
    let lost = start(folder.path(), &["actor", "--connect", &endpoint, "--run", "wlk", "--envs", "4"]);
    tells(heading, &lost, "no learner answers", &replaced);
    fails(heading, folder.path(), &["status", "--connect", &endpoint, "--run", "wlk"], &replaced);
    fails("The port is in use", folder.path(), &["learner", "--preset", "smoke", "--listen", &endpoint], &replaced);

    let liar = Attacker::join(&endpoint, "run", None, crate::attacks::PATIENCE).unwrap();
    let nonsense = spoilt(&liar.policy(), "liar", f32::NAN);
    for _ in 0..8 {
        liar.send("liar", nonsense.clone());
    }
    let heading = "An actor is in quarantine";
    tells(heading, &learner, "was refused", &[]);
    tells(heading, &learner, "quarantine", &[]);
}

#[test]
fn it_cannot_begin() {
    let (folder, _) = folders();
    let folder = folder.path();
    let learner = |args: &[&'static str]| [&["learner", "--preset", "smoke", "--run-dir", "other"], args].concat();
    let args = learner(&["--listen", "tcp/0.0.0.0:7447"]);
    fails("Plain text beyond this machine", folder, &args, &[]);
    let args = learner(&["--listen", "tls/0.0.0.0:7447", "--tls", "certs"]);
    let place = folder.canonicalize().unwrap();
    fails("Certificates are missing", folder, &args, &[(place.to_str().unwrap(), "FOLDER")]);
    let heading = "A key, a value or a preset that does not exist";
    fails(heading, folder, &learner(&["--set", "ppo.epoch=3"]), &[]);
    fails(heading, folder, &learner(&["--set", "ppo.epochs=0"]), &[]);
    fails(heading, folder, &["train", "--preset", "stroll"], &[]);
    if cfg!(not(feature = "cuda")) {
        fails("No GPU in this build", folder, &learner(&["--device", "cuda"]), &[]);
    }
    fs::write(folder.join("robot.xml"), "robot").unwrap();
    fails("A model that cannot be read", folder, &learner(&["--model", "robot.xml"]), &[]);
    fails("An actor of another task", folder, &["train", "--task", "external"], &[]);
    let script = format!("ulimit -n 40 && exec {} train --run-dir other", env!("CARGO_BIN_EXE_treadmill"));
    let output = Command::new("sh").args(["-c", &script]).current_dir(folder).output().expect("there is a shell");
    has_failed("Too few files may be open", &output, &[]);
    assert!(!folder.join("other").exists(), "nothing is left behind");
}

#[test]
fn it_stops_or_cannot_go_on() {
    let (folder, run) = folders();
    let folder = folder.path();
    let train = ["train", "--preset", "smoke", "--run-dir", "run", "--no-progress"];
    assert!(crate::support::run(folder, &train).status.success());
    fails("The folder holds another run", folder, &train, &[]);
    let args = ["train", "--resume", "run", "--set", "ppo.epochs=2"];
    fails("A resumed run is given another configuration", folder, &args, &[]);

    let checkpoint = |name: &str| run.join("checkpoints").join(name);
    let sound = fs::read(checkpoint("latest.bundle")).unwrap();
    let mut old = sound.clone();
    old[8] = 2;
    fs::write(checkpoint("latest.bundle"), old).unwrap();
    fails("The checkpoint is of another version", folder, &["train", "--resume", "run"], &[]);
    let heading = "A checkpoint is damaged";
    fs::write(checkpoint("latest.bundle"), "garbage").unwrap();
    let exported = crate::support::run(folder, &["export", "run", "--safetensors", "policy"]);
    let text = stderr(&exported);
    assert!(exported.status.success(), "{text}");
    let warning = text.lines().find(|line| line.contains("WARN")).expect("a warning");
    // The best policy may be that of any evaluation.
    let (before, updates) = warning.rsplit_once("after ").expect("the number of updates");
    is_quoted(heading, &format!("{before}after 16 {}", updates.split_once(' ').unwrap().1));
    for bundle in ["latest.bundle", "best.bundle"] {
        fs::write(checkpoint(bundle), "x").unwrap();
    }
    fails(heading, folder, &["train", "--resume", "run"], &[]);
}

#[test]
fn an_actor_dies_and_a_key_is_fixed() {
    let (folder, run) = folders();
    let args = ["train", "--preset", "smoke", "--steps", ENDLESS, "--run-dir", "run", "--no-progress"];
    let training = start(folder.path(), &args);
    await_steps(&run, 512);
    let args = ["control", "set", "rollout.envs", "3", "run"];
    fails("A key that cannot be changed while the run goes on", folder.path(), &args, &[]);
    let victim = await_that("an actor", || children(training.pid(), "actor-1").pop());
    send_signal(victim, libc::SIGKILL);
    tells("An actor process dies", &training, "starting it again", &[]);
}

#[test]
fn somebody_is_turned_away() {
    let (folder, run) = folders();
    let folder = folder.path();
    for authority in ["certs", "others"] {
        assert!(crate::support::run(folder, &["certs", authority]).status.success());
    }
    let listen = ["--listen", "tls/127.0.0.1:0", "--tls", "certs"];
    let learner = start(folder, &[&["learner", "--preset", "smoke", "--run-dir", "run"][..], &listen].concat());
    let endpoint = endpoint(&run);
    let stranger = start(folder, &["actor", "--tls", "others", "--connect", &endpoint]);
    tells("A certificate of another authority", &learner, "a connection was refused", &[]);
    drop(stranger);
    let _plain = start(folder, &["actor", "--connect", &endpoint.replace("tls/", "tcp/")]);
    tells("Plain text where TLS is spoken", &learner, "does not speak TLS", &[]);

    // What an observer's machine has, who would call itself an operator.
    fs::create_dir(folder.join("theirs")).unwrap();
    for (from, to) in [("ca.crt", "ca.crt"), ("observer.crt", "operator.crt"), ("observer.key", "operator.key")] {
        fs::copy(folder.join("certs").join(from), folder.join("theirs").join(to)).unwrap();
    }
    let args = ["control", "pause", "run", "--run", "run", "--tls", "theirs"];
    fails("The learner takes no command", folder, &args, &[]);
}
