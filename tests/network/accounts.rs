//! Accounting under failures: whichever process dies or freezes, every produced fragment is learnt from once or dropped
//! by rule, and training continues. The tests compare the final counts of actors with the learner's accounts.

use std::{fs, path::Path};

use crate::support::*;
use serde_json::Value;
use treadmill_learner::checkpoint::load_file;

/// Part of the message of an actor that gets no answer.
const UNANSWERED: &str = "no learner answers; keeping";

/// Learner, router, and two actors that reach the learner only through the router.
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
        let [learner_at, router_at] = free_endpoints("tcp");
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

    /// Waits for ten further updates.
    fn assert_trains(&self) {
        let newest = metrics(&self.run).last().map_or(0, |(_, step, _)| *step);
        await_steps(&self.run, newest + 10 * 512);
    }

    /// Stops all processes and compares their counts.
    fn compare(mut self) {
        let learner = self.learner.take().unwrap();
        learner.signal(libc::SIGINT);
        assert!(learner.wait().0.success());
        let actors: Vec<Value> = self.actors.drain(..).map(stop_actor).collect();
        let accounts = accounts(&self.run);
        for actor in &actors {
            let account = accounts.iter().find(|account| account["incarnation"] == actor["incarnation"]);
            compare_one(actor, account.unwrap_or_else(|| panic!("{actor} in {accounts:?}")));
        }
        // Two independent counts: of validated fragments, and of transitions learnt from.
        let accepted: u64 = accounts.iter().map(|account| number(account, "env_steps")).sum();
        let state = load_file(&self.run.join("checkpoints/latest.bundle")).unwrap();
        assert_eq!(state.counters.env_steps, accepted);
        assert_eq!(state.fragment_counts.malformed, 0);
    }
}

/// Stops an actor and returns the JSON object that it prints.
fn stop_actor(actor: Running) -> Value {
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
    let (sent, known) = (|key| number(actor, key), |key| number(account, key));
    let both = format!("{actor}\n{account}");
    assert_eq!(sent("produced"), sent("accepted") + sent("dropped_by_rule") + sent("in_flight"), "{both}");
    assert!(sent("accepted") > 0, "{both}");
    let dropped = known("too_old") + known("vanished") + known("unseen");
    // Settled fragments are in the account. Those that a learner dropped after its last checkpoint only the actor counts.
    let unsaved = sent("dropped_by_rule").saturating_sub(dropped);
    assert!(sent("settled_through") <= known("through") + unsaved, "{both}");
    // Durable fragments are in the account, and the account has no more than were sent.
    assert!(sent("accepted") - sent("awaiting_durability") <= known("accepted"), "{both}");
    assert!(known("accepted") <= sent("accepted") + sent("in_flight"), "{both}");
    // The actor counts every dropped fragment.
    assert!(dropped <= sent("dropped_by_rule") + sent("in_flight"), "{both}");
}

#[test]
fn actors_continue_after_a_frozen_learner() {
    let fleet = Fleet::start();
    let learner = fleet.learner.as_ref().unwrap();
    learner.signal(libc::SIGSTOP);
    fleet.actors.iter().for_each(|actor| drop(actor.wait_for(UNANSWERED)));
    learner.signal(libc::SIGCONT);
    fleet.assert_trains();
    fleet.compare();
}

#[test]
fn actors_continue_after_a_killed_router() {
    let mut fleet = Fleet::start();
    fleet.router = None;
    fleet.actors.iter().for_each(|actor| drop(actor.wait_for(UNANSWERED)));
    fleet.start_router();
    fleet.assert_trains();
    fleet.compare();
}

#[test]
fn actors_continue_after_a_killed_learner_behind_a_router() {
    let mut fleet = Fleet::start();
    fleet.learner = None;
    fleet.actors.iter().for_each(|actor| drop(actor.wait_for(UNANSWERED)));
    fleet.start_learner();
    fleet.assert_trains();
    fleet.compare();
}

#[test]
fn a_fleet_restarts_after_all_processes_are_killed() {
    let mut fleet = Fleet::start();
    fleet.learner = None;
    fleet.router = None;
    fleet.actors.clear();
    fleet.start_actors();
    fleet.start_router();
    fleet.start_learner();
    fleet.assert_trains();
    fleet.compare();
}
