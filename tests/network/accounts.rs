//! Whatever dies or freezes, every fragment that an actor produced is learnt from once or dropped by rule, and training goes
//! on: what actors say at their end is compared with the learner's own account of them.

use std::{fs, net::TcpListener, path::Path};

use crate::support::*;
use serde_json::Value;
use treadmill_learner::checkpoint::load_file;

/// More steps than any of these tests waits for.
const ENDLESS: &str = "1000000000";
/// Part of the message of an actor that gets no answer.
const UNANSWERED: &str = "keeping fragments";

/// A learner, a router and two actors that reach it only through that.
struct Fleet {
    folder: tempfile::TempDir,
    run: std::path::PathBuf,
    learner_at: String,
    router_at: String,
    learner: Option<Running>,
    router: Option<Running>,
    actors: Vec<Running>,
}

impl Fleet {
    fn start() -> Self {
        let (folder, run) = folders();
        // Both are held before either is let go, so that they differ.
        let free = [(); 2].map(|()| TcpListener::bind("127.0.0.1:0").unwrap());
        let [learner_at, router_at] = free.map(|listener| format!("tcp/{}", listener.local_addr().unwrap()));
        let mut fleet = Self { folder, run, learner_at, router_at, learner: None, router: None, actors: Vec::new() };
        fleet.start_learner();
        fleet.start_router();
        fleet.start_actors();
        await_steps(&fleet.run, 2048);
        fleet
    }

    fn start_learner(&mut self) {
        let mut command = treadmill(self.folder.path());
        command.args(["learner", "--steps", ENDLESS, "--listen", &self.learner_at]);
        let run = self.run.to_str().unwrap();
        match self.run.join("checkpoints/latest.bundle").exists() {
            true => command.args(["--resume", run]),
            false => command.args(["--preset", "smoke", "--run-dir", run]),
        };
        self.learner = Some(Running::start(command));
    }

    fn start_router(&mut self) {
        let mut command = treadmill(self.folder.path());
        command.args(["router", "--listen", &self.router_at, "--connect", &self.learner_at]);
        self.router = Some(Running::start(command));
    }

    fn start_actors(&mut self) {
        for name in ["a", "b"] {
            let mut command = treadmill(self.folder.path());
            command.args(["actor", "--connect", &self.router_at, "--envs", "4", "--name", name, "--json"]);
            self.actors.push(Running::start(command));
        }
    }

    /// Waits for so many updates from now on.
    fn go_on(&self) {
        let newest = metrics(&self.run).last().map_or(0, |(_, step, _)| *step);
        await_steps(&self.run, newest + 10 * 512);
    }

    /// Stops everybody, and compares what they say.
    fn compare(mut self) {
        let learner = self.learner.take().unwrap();
        learner.signal(libc::SIGINT);
        assert!(learner.wait().0.success());
        let actors: Vec<Value> = self.actors.drain(..).map(last_words).collect();
        let accounts = accounts(&self.run);
        for actor in &actors {
            let account = accounts.iter().find(|account| account["incarnation"] == actor["incarnation"]);
            compare_one(actor, account.unwrap_or_else(|| panic!("{actor} in {accounts:?}")));
        }
        // Two counts that are made in different places: as fragments are judged, and as they are learnt from.
        let taken: u64 = accounts.iter().map(|account| number(account, "env_steps")).sum();
        let state = load_file(&self.run.join("checkpoints/latest.bundle")).unwrap();
        assert_eq!(state.counters.env_steps, taken);
        assert_eq!(state.fragment_counts.malformed, 0);
    }
}

fn last_words(actor: Running) -> Value {
    actor.signal(libc::SIGTERM);
    let (status, lines) = actor.wait();
    assert!(status.success(), "{lines:?}");
    let line = lines.iter().rev().find(|line| line.starts_with('{')).unwrap_or_else(|| panic!("{lines:?}"));
    serde_json::from_str(line).unwrap()
}

fn accounts(run: &Path) -> Vec<Value> {
    let text = fs::read_to_string(run.join("accounts.jsonl")).unwrap();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn number(object: &Value, key: &str) -> u64 {
    object[key].as_u64().unwrap_or_else(|| panic!("`{key}` in {object}"))
}

fn compare_one(actor: &Value, account: &Value) {
    let (said, known) = (|key| number(actor, key), |key| number(account, key));
    let told = format!("{actor}\n{account}");
    assert_eq!(said("produced"), said("accepted") + said("dropped_by_rule") + said("in_flight"), "{told}");
    assert!(said("accepted") > 0, "{told}");
    let dropped = known("too_old") + known("vanished") + known("unseen");
    // What the actor let go of was dealt with; what a learner dropped after its last checkpoint, only its sender knows of.
    let unsaved = said("dropped_by_rule").saturating_sub(dropped);
    assert!(said("settled_through") <= known("through") + unsaved, "{told}");
    // What it knows to be durable is; what was taken is no more than what it gave.
    assert!(said("accepted") - said("awaiting_durability") <= known("accepted"), "{told}");
    assert!(known("accepted") <= said("accepted") + said("in_flight"), "{told}");
    // The sender knows of each fragment that was dropped.
    assert!(dropped <= said("dropped_by_rule") + said("in_flight"), "{told}");
}

#[test]
fn a_frozen_learner_is_found_again() {
    let fleet = Fleet::start();
    let learner = fleet.learner.as_ref().unwrap();
    learner.signal(libc::SIGSTOP);
    fleet.actors.iter().for_each(|actor| drop(actor.wait_for(UNANSWERED)));
    learner.signal(libc::SIGCONT);
    fleet.go_on();
    fleet.compare();
}

#[test]
fn a_router_that_was_killed_is_found_again() {
    let mut fleet = Fleet::start();
    fleet.router = None;
    fleet.actors.iter().for_each(|actor| drop(actor.wait_for(UNANSWERED)));
    fleet.start_router();
    fleet.go_on();
    fleet.compare();
}

#[test]
fn a_killed_learner_is_resumed_behind_its_router() {
    let mut fleet = Fleet::start();
    fleet.learner = None;
    fleet.actors.iter().for_each(|actor| drop(actor.wait_for(UNANSWERED)));
    fleet.start_learner();
    fleet.go_on();
    fleet.compare();
}

#[test]
fn everything_is_killed_and_started_with_the_learner_last() {
    let mut fleet = Fleet::start();
    fleet.learner = None;
    fleet.router = None;
    fleet.actors.clear();
    fleet.start_actors();
    fleet.start_router();
    fleet.start_learner();
    fleet.go_on();
    fleet.compare();
}
