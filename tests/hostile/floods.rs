//! Hostile clients against a real learner: it keeps running within its memory, quarantines the sender by name, and keeps
//! learning from its good actor.

use std::{
    io::Write,
    net::TcpStream,
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

use crate::attacks::{Attacker, Flood, corrupted, fragment, malformed_fragments};
use crate::support::*;
use treadmill_proto::Outcome;

/// More than the largest messages that are in memory while they are refused.
const GROWTH_BYTES_MAX: u64 = 250 << 20;

/// Learner with one good actor.
pub(crate) struct Fleet {
    pub(crate) learner: Running,
    actor: Running,
    pub(crate) endpoint: String,
    pub(crate) folder: tempfile::TempDir,
    pub(crate) run: PathBuf,
    tls: bool,
}

pub(crate) fn fleet(tls: bool, settings: &[&str]) -> Fleet {
    bus_on_one_thread();
    // Clients of all tests together have more connections than most systems allow a program at first.
    rlimit::increase_nofile_limit(4096).expect("a limit on open files");
    let (folder, run) = folders();
    let listen: &[&str] = match tls {
        true => &["--listen", "tls/127.0.0.1:0", "--tls", "certs"],
        false => &["--listen", "tcp/127.0.0.1:0"],
    };
    if tls {
        certs(folder.path(), &["certs"]);
    }
    let settings: Vec<&str> = settings.iter().flat_map(|setting| ["--set", setting]).collect();
    let learner = start_endless(folder.path(), &run, "learner", &[listen, &settings].concat());
    let endpoint = endpoint(&run);
    let actor = actor(folder.path(), &endpoint, tls, "good");
    await_steps(&run, 1024);
    Fleet { learner, actor, endpoint, folder, run, tls }
}

fn actor(folder: &Path, endpoint: &str, tls: bool, name: &str) -> Running {
    let with_tls: &[&str] = if tls { &["--tls", "certs"] } else { &[] };
    start(folder, &[&["actor", "--connect", endpoint, "--envs", "8", "--name", name], with_tls].concat())
}

impl Fleet {
    pub(crate) fn attacker(&self) -> Attacker {
        self.join_as("actor")
    }

    /// Joins with the certificate of a role, if the fleet has certificates.
    pub(crate) fn join_as(&self, role: &str) -> Attacker {
        let certs = self.certs();
        let tls = self.tls.then_some((certs.as_path(), role));
        Attacker::join(&self.endpoint, "run", tls, TIMEOUT).expect("a session")
    }

    pub(crate) fn certs(&self) -> PathBuf {
        self.folder.path().join("certs")
    }

    fn value(&self, tag: &str) -> f64 {
        last_value(&self.run, tag).expect("a value after every update")
    }

    /// Asserts that the learner keeps learning from the good actor.
    pub(crate) fn assert_trains(&self) {
        let steps = metrics(&self.run).last().unwrap().1;
        await_steps(&self.run, steps + 4096);
        assert!(is_running(self.learner.pid()) && is_running(self.actor.pid()));
    }

    /// Stops the learner and asserts that it did not fail.
    pub(crate) fn end(self) {
        self.actor.signal(libc::SIGTERM);
        self.learner.signal(libc::SIGINT);
        let (status, lines) = self.learner.wait();
        assert!(status.success(), "{lines:#?}");
        assert!(!lines.iter().any(|line| line.contains("panicked")), "{lines:#?}");
    }
}

fn resident_bytes(pid: u32) -> u64 {
    let statm = std::fs::read_to_string(format!("/proc/{pid}/statm")).unwrap();
    statm.split_whitespace().nth(1).unwrap().parse::<u64>().unwrap() * 4096
}

fn assert_quarantine_of_malformed_fragments(tls: bool) {
    let fleet = fleet(tls, &[]);
    let before = resident_bytes(fleet.learner.pid());
    let attacker = fleet.attacker();
    let kinds = malformed_fragments(&attacker.policy());
    for (kind, bytes, reason) in &kinds {
        for _ in 0..8 {
            let receipt = attacker.send(kind, bytes.clone()).expect("an answer");
            assert_eq!(receipt.outcome, Outcome::Malformed, "{kind}: {receipt:?}");
            assert!(receipt.reason.contains(reason), "{kind}: {receipt:?}");
        }
        let receipt = attacker.send(kind, bytes.clone()).expect("an answer");
        assert_eq!(receipt.outcome, Outcome::Quarantined, "{kind}: {receipt:?}");
        fleet.learner.wait_for(&format!("sender quarantined actor={kind}"));
    }
    // Invalid names, one of them as long as a key may be.
    for name in ["Capitals".to_string(), "a".repeat(60_000)] {
        let receipt = attacker.send(&name, vec![1]).expect("an answer");
        assert!(matches!(receipt.outcome, Outcome::Malformed), "{receipt:?}");
    }
    await_that("the count of quarantined senders", || {
        last_value(&fleet.run, "actors/quarantined").filter(|count| *count >= 1.0)
    });
    // Larger than the largest message of the bus: it never arrives.
    assert_eq!(attacker.send("huge", vec![0; 40 << 20]), None);
    assert!(fleet.value("bus/fragments_malformed") >= 8.0 * kinds.len() as f64);
    assert!(fleet.value("bus/fragments_quarantined") >= kinds.len() as f64);
    fleet.assert_trains();
    let after = resident_bytes(fleet.learner.pid());
    assert!(after < before + GROWTH_BYTES_MAX, "{before} bytes before and {after} after");
    fleet.end();
}

#[test]
fn malformed_fragments_are_answered_and_their_sender_is_quarantined() {
    assert_quarantine_of_malformed_fragments(false);
}

#[test]
fn a_certificate_does_not_prevent_quarantine() {
    assert_quarantine_of_malformed_fragments(true);
}

#[test]
fn malformed_fragments_under_a_good_actors_name_do_not_stop_it() {
    let fleet = fleet(true, &[]);
    let attacker = fleet.attacker();
    let nan = corrupted(&attacker.policy(), "good", f32::NAN);
    for _ in 0..8 {
        assert_eq!(attacker.send("good", nan.clone()).unwrap().outcome, Outcome::Malformed);
    }
    assert_eq!(attacker.send("good", nan).unwrap().outcome, Outcome::Quarantined);
    fleet.assert_trains();
    fleet.end();
}

#[test]
fn replayed_fragments_are_not_learnt_from_and_quarantine_their_sender() {
    // With lag allowed, so that the fragment of this test is never too old.
    let fleet = fleet(true, &["learner.mode=async", "learner.max_policy_lag=16"]);
    let attacker = fleet.attacker();
    let accepted = await_that("an accepted fragment", || {
        let fragment = fragment(&attacker.policy(), "replayer", 1).encode().unwrap();
        let outcome = attacker.send("replayer", fragment.clone()).expect("an answer").outcome;
        (outcome == Outcome::Accepted).then_some(fragment)
    });
    let mut duplicates = 0;
    let end = await_that("the quarantine", || match attacker.send("replayer", accepted.clone())?.outcome {
        Outcome::Duplicate => {
            duplicates += 1;
            None
        }
        Outcome::Busy => None,
        other => Some(other),
    });
    assert_eq!(end, Outcome::Quarantined);
    assert!(duplicates > 100, "an honest actor may resend fragments: {duplicates}");
    fleet.learner.wait_for("sender quarantined: too many duplicate or vanished fragments actor=replayer");
    fleet.assert_trains();
    fleet.end();
}

#[test]
fn finite_but_absurd_fragments_end_no_run_and_quarantine_their_sender() {
    let fleet = fleet(false, &["learner.undone_max=1"]);
    let attacker = fleet.attacker();
    let mut sequence = 0;
    await_that("the quarantine of the sender", || {
        sequence += 1;
        let mut absurd = fragment(&attacker.policy(), "absurd", sequence);
        match sequence % 3 {
            0 => absurd.log_probs.fill(-1e30),
            1 => absurd.rewards.fill(3e38),
            _ => absurd.actions.fill(1e30),
        }
        let receipt = attacker.send("absurd", absurd.encode().unwrap())?;
        assert!(!matches!(receipt.outcome, Outcome::Malformed), "{receipt:?}");
        (receipt.outcome == Outcome::Quarantined).then_some(())
    });
    fleet.learner.wait_for("fragment not learnt from actor=absurd");
    fleet.learner.wait_for("sender quarantined: implausible fragments in a row actor=absurd");
    fleet.assert_trains();
    assert_eq!(fleet.value("train/undone_updates"), 0.0);
    fleet.end();
}

/// Sends small messages of every kind at once, as fast as possible.
fn flood(tls: bool) {
    let fleet = fleet(tls, &["eval.every_steps=4096"]);
    let before = resident_bytes(fleet.learner.pid());
    let attackers = Flood::ALL.map(|(name, kind)| (name, kind, fleet.attacker()));
    let bundle = attackers[0].2.policy();
    let until = Instant::now() + Duration::from_secs(3);
    let sent = std::thread::scope(|scope| {
        let threads = attackers.each_ref().map(|(name, kind, attacker)| {
            let bundle = &bundle;
            (*name, scope.spawn(move || attacker.flood(*kind, "good", 200_000, until, bundle)))
        });
        threads.map(|(name, thread)| (name, thread.join().unwrap()))
    });
    assert!(sent.iter().all(|(_, sent)| *sent > 0), "{sent:?}");
    let sent: u64 = sent.iter().map(|(_, sent)| sent).sum();
    assert!(sent > 1000, "{sent}");
    await_that("the count of rejected fragments", || {
        last_value(&fleet.run, "bus/fragments_turned_away").filter(|count| *count > 0.0)
    });
    fleet.assert_trains();
    let after = resident_bytes(fleet.learner.pid());
    assert!(after < before + GROWTH_BYTES_MAX, "{before} bytes before and {after} after {sent} messages");
    // The learner drops statistics of unknown actors.
    assert!(fleet.value("actors/env_steps_per_s") < 1e12);
    // A new actor can still join.
    let newcomer = actor(fleet.folder.path(), &fleet.endpoint, tls, "newcomer");
    await_that("the newcomer is alive", || last_value(&fleet.run, "actors/alive").filter(|alive| *alive == 2.0));
    drop(newcomer);
    fleet.end();
}

#[test]
fn floods_do_not_stop_the_learner() {
    flood(false);
}

#[test]
fn floods_with_a_certificate_do_not_stop_the_learner() {
    flood(true);
}

fn silent_and_malformed_connections(tls: bool) {
    let fleet = fleet(tls, &[]);
    let address = fleet.endpoint.split_once('/').unwrap().1.to_string();
    let mut idle: Vec<TcpStream> = (0..600).filter_map(|_| TcpStream::connect(&address).ok()).collect();
    assert!(idle.len() > 300, "{}", idle.len());
    for (number, stream) in idle.iter_mut().enumerate().take(100) {
        // Frames of the largest length, and noise.
        let byte = if number % 2 == 0 { 0xff } else { number as u8 };
        let _ = stream.write_all(&[byte; 4000]);
    }
    let newcomer = actor(fleet.folder.path(), &fleet.endpoint, tls, "newcomer");
    await_that("the newcomer is alive", || last_value(&fleet.run, "actors/alive").filter(|alive| *alive == 2.0));
    fleet.assert_trains();
    drop((idle, newcomer));
    fleet.end();
}

#[test]
fn silent_and_malformed_connections_do_not_keep_actors_out() {
    silent_and_malformed_connections(false);
}

#[test]
fn silent_and_malformed_connections_do_not_keep_actors_with_a_certificate_out() {
    silent_and_malformed_connections(true);
}
