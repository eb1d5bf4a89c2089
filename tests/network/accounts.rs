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
        let run = self.run.to_str().unwrap();
        let begins: &[&str] = match self.run.join("checkpoints/latest.bundle").exists() {
            true => &["--resume", run],
            false => &["--preset", "smoke", "--run-dir", run],
        };
        let args = ["learner", "--steps", ENDLESS, "--listen", &self.learner_at];
        self.learner = Some(start(self.folder.path(), &[&args, begins].concat()));
    }

    fn start_router(&mut self) {
        self.router =
            Some(start(self.folder.path(), &["router", "--listen", &self.router_at, "--connect", &self.learner_at]));
    }

    fn start_actors(&mut self) {
        for name in ["a", "b"] {
            let args = ["actor", "--connect", &self.router_at, "--envs", "4", "--name", name, "--json"];
            self.actors.push(start(self.folder.path(), &args));
        }
    }

    /// Waits for ten further updates.
    fn assert_trains(&self) {
        let newest = metrics(&self.run).last().map_or(0, |(_, step, _)| *step);
        await_steps(&self.run, newest + 10 * 512);
    }

    /// Stops all processes and compares their counts.
    fn compare(mut self) {
        stop(self.learner.take().unwrap());
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

/// Starts a fleet, breaks it by `fail`, and asserts that its actors notice, and that it trains on once it is mended.
fn assert_survives(fail: impl Fn(&mut Fleet), mend: impl Fn(&mut Fleet)) {
    let mut fleet = Fleet::start();
    fail(&mut fleet);
    fleet.actors.iter().for_each(|actor| drop(actor.wait_for(UNANSWERED)));
    mend(&mut fleet);
    fleet.assert_trains();
    fleet.compare();
}

#[test]
fn actors_continue_after_a_frozen_learner() {
    let signal = |fleet: &Fleet, signal| fleet.learner.as_ref().unwrap().signal(signal);
    assert_survives(|fleet| signal(fleet, libc::SIGSTOP), |fleet| signal(fleet, libc::SIGCONT));
}

#[test]
fn actors_continue_after_a_killed_router() {
    assert_survives(|fleet| fleet.router = None, Fleet::start_router);
}

#[test]
fn actors_continue_after_a_killed_learner_behind_a_router() {
    assert_survives(|fleet| fleet.learner = None, Fleet::start_learner);
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
