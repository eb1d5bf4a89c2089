//! Pool: actors that belong to no run serve the learners that need them.

use std::path::Path;

use crate::support::*;
use serde_json::Value;

/// Environments of each actor.
const ENVS: u64 = 8;

/// Router, and actors of a pool that dial it.
struct PoolFleet {
    folder: tempfile::TempDir,
    router_at: String,
    /// Folders of certificates of learners, actors and observers, if links are encrypted.
    is_encrypted: bool,
    actors: Vec<Running>,
    _router: Running,
}

impl PoolFleet {
    fn start(protocol: &str, actors: usize) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let [router_at] = free_endpoints(protocol);
        let is_encrypted = protocol == "tls";
        if is_encrypted {
            certs(folder.path(), &["authority", "--bundles", "certs", "--host", "127.0.0.1"]);
        }
        let tls: &[&str] = if is_encrypted { &["--tls", "certs/router"] } else { &[] };
        let router = start(folder.path(), &[&["router", "--listen", &router_at], tls].concat());
        let mut fleet = Self { folder, router_at, is_encrypted, actors: Vec::new(), _router: router };
        for number in 1..=actors {
            let name = format!("act{number}");
            let mut command = treadmill(fleet.folder.path());
            command.args(["actor", "--pool", "--name", &name, "--envs", &ENVS.to_string()]);
            command.args(fleet.joins("actor")).env("TREADMILL_LOG", "info,zenoh=error");
            fleet.actors.push(Running::start(command));
        }
        fleet
    }

    fn at(&self) -> &Path {
        self.folder.path()
    }

    /// Returns the flags with which a role joins the router.
    fn joins(&self, role: &str) -> Vec<String> {
        let tls = self.is_encrypted.then(|| ["--tls".to_string(), format!("certs/{role}")]);
        ["--connect".to_string(), self.router_at.clone()].into_iter().chain(tls.into_iter().flatten()).collect()
    }

    /// Starts or resumes the learner of a run.
    fn learner(&self, run: &str, more: &[&str]) -> Running {
        let listen = if self.is_encrypted { "tls/127.0.0.1:0" } else { "tcp/127.0.0.1:0" };
        let mut command = treadmill(self.at());
        command.args(["learner", "--listen", listen, "--run", run, "--no-page"]).args(self.joins("learner"));
        match self.at().join(run).join("checkpoints/latest.bundle").exists() {
            true => command.args(["--resume", run]),
            false => command.args(["--preset", "smoke", "--run-dir", run, "--steps", ENDLESS]),
        };
        command.args(more);
        Running::start(command)
    }

    fn control(&self, run: &str, command: &[&str]) {
        let mut control = treadmill(self.at());
        control.args(["control", command[0]]).args(self.joins("operator")).args(["--run", run]).args(&command[1..]);
        let output = control.output().unwrap();
        assert!(output.status.success(), "{}", stderr(&output));
    }

    /// Returns the status of each run.
    fn statuses(&self) -> Vec<Value> {
        let mut status = treadmill(self.at());
        let output = status.args(["status", "--json"]).args(self.joins("observer")).output().unwrap();
        stdout(&output).lines().filter_map(|line| serde_json::from_str(line).ok()).collect()
    }

    /// Waits until the runs have so many actors of the pool.
    fn await_actors(&self, wanted: &[(&str, u64)]) -> Vec<Value> {
        await_that(&format!("{wanted:?} of the actors"), || {
            let statuses = self.statuses();
            let has = |run: &str| {
                let status = statuses.iter().find(|status| status["run"] == run)?;
                let alive = status["actors"].as_array()?.iter().filter(|actor| actor["state"] == "alive").count();
                (status["pool"]["actors"].as_u64()? == alive as u64).then_some(alive as u64)
            };
            wanted.iter().all(|(run, actors)| has(run) == Some(*actors)).then_some(statuses)
        })
    }

    /// Waits for further updates of a run.
    fn assert_trains(&self, run: &str) {
        let newest = last_step(&self.at().join(run));
        await_steps(&self.at().join(run), newest + 10 * 512);
    }
}

#[test]
fn actors_of_a_pool_go_where_a_run_needs_them_over_tls() {
    let fleet = PoolFleet::start("tls", 3);
    let first = fleet.learner("first", &["--set", "run.share=2"]);
    fleet.await_actors(&[("first", 3)]);
    let second = fleet.learner("second", &[]);
    let statuses = fleet.await_actors(&[("first", 2), ("second", 1)]);
    let pool = &statuses[1]["pool"];
    assert_eq!(
        [&pool["pool_actors"], &pool["pool_envs"], &pool["envs"], &pool["envs_target"]].map(|v| v.as_u64().unwrap()),
        [3, 3 * ENVS, ENVS, ENVS]
    );
    fleet.assert_trains("first");
    fleet.assert_trains("second");
    // Killed: nothing announces that.
    first.signal(libc::SIGKILL);
    fleet.await_actors(&[("second", 3)]);
    fleet.assert_trains("second");
    let _first = fleet.learner("first", &[]);
    fleet.await_actors(&[("first", 2), ("second", 1)]);
    fleet.assert_trains("first");
    // Ends by itself.
    stop(second);
    fleet.await_actors(&[("first", 3)]);
    let text = stdout(&run_with(&fleet, &["status"]));
    assert!(text.contains("pool: 3 actors with 24 environments, 0 without a run"), "{text}");
}

fn run_with(fleet: &PoolFleet, args: &[&str]) -> std::process::Output {
    let mut command = treadmill(fleet.at());
    command.args(args).args(fleet.joins("observer")).output().unwrap()
}

/// Fragments of an actor process in one run, as it counted them when it left: run, incarnation and number.
fn memberships(lines: &[String]) -> Vec<(String, String, u64)> {
    let value = |line: &str, name: &str, ends: &[char]| {
        line.split_once(name).map(|(_, rest)| rest.split(ends).next().unwrap_or_default().to_string())
    };
    let left = lines.iter().filter(|line| line.contains("left the run "));
    left.map(|line| {
        let produced = value(line, "produced: ", &[',']).unwrap().parse().unwrap();
        (value(line, "run=", &[' ']).unwrap(), value(line, "incarnation: ", &[',']).unwrap(), produced)
    })
    .collect()
}

#[test]
fn nothing_that_was_simulated_is_lost_when_actors_move() {
    let mut fleet = PoolFleet::start("tcp", 4);
    let sync = ["--set", "learner.mode=\"sync\""];
    let paused = fleet.learner("paused", &sync);
    let other = fleet.learner("other", &[]);
    fleet.await_actors(&[("paused", 2), ("other", 2)]);
    fleet.assert_trains("paused");
    fleet.control("paused", &["pause"]);
    fleet.await_actors(&[("paused", 0), ("other", 4)]);
    fleet.assert_trains("other");
    fleet.control("paused", &["resume"]);
    fleet.await_actors(&[("paused", 2), ("other", 2)]);
    fleet.control("other", &["set", "run.share", "3"]);
    fleet.await_actors(&[("paused", 1), ("other", 3)]);
    fleet.assert_trains("paused");
    let mut left = Vec::new();
    for actor in fleet.actors.drain(..) {
        actor.signal(libc::SIGTERM);
        let (status, lines) = actor.wait();
        assert!(status.success(), "{lines:#?}");
        assert!(!lines.iter().any(|line| line.contains("MatchingListener")), "{lines:#?}");
        // The last membership ended with the process, in the middle of a fragment.
        left.extend(memberships(&lines).into_iter().rev().skip(1));
    }
    stop(paused);
    stop(other);
    assert!(left.len() >= 4, "{left:?}");
    for (run, incarnation, produced) in left {
        let accounts = std::fs::read_to_string(fleet.folder.path().join(&run).join("accounts.jsonl")).unwrap();
        let mut of_all = accounts.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
        let account = of_all.rfind(|account| account["incarnation"] == incarnation);
        let account = account.unwrap_or_else(|| panic!("{incarnation} is not in {accounts}"));
        let [accepted, too_old] = ["accepted", "too_old"].map(|name| account[name].as_u64().unwrap());
        assert_eq!((accepted + too_old, account["missing"].as_u64()), (produced, Some(0)), "{run}: {account}");
        if run == "paused" {
            // It may have come while the learner updated the policy that it fetched.
            assert!(too_old <= 1, "in lock-step with the learner, the rest is of the newest policy: {account}");
        }
    }
}

#[test]
fn an_actor_of_a_pool_without_a_run_waits_for_one() {
    let mut fleet = PoolFleet::start("tcp", 1);
    let small = fleet.learner("small", &["--set", "run.envs_max=7"]);
    await_that("the actor in the pool", || {
        fleet.statuses().iter().any(|status| status["pool"]["pool_actors"] == 1).then_some(())
    });
    fleet.await_actors(&[("small", 0)]);
    fleet.control("small", &["set", "run.envs_max", "8"]);
    fleet.await_actors(&[("small", 1)]);
    fleet.control("small", &["set", "run.share", "0"]);
    stop(small);
    stop(fleet.actors.remove(0));
}

#[test]
fn a_certificate_of_a_pool_admits_to_the_runs_that_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let [routing] = &free_endpoints("tls");
    certs(at, &["certs", "--host", "127.0.0.1", "--pool", "lab", "--pool", "other", "--bundles", "machines"]);
    let _router = start(
        at,
        &[
            "router",
            "--listen",
            routing,
            "--tls",
            "certs",
            "--admit",
            "lab=open",
            "--admit",
            "lab=seeds-*",
            "--admit",
            "all=*",
        ],
    );
    let joins = ["--connect", routing, "--tls", "certs"];
    let learner = |run: &str, more: &[&str]| {
        let own = ["learner", "--listen", "tls/127.0.0.1:0", "--run", run, "--run-dir", run, "--no-page"];
        let run = ["--preset", "smoke", "--steps", ENDLESS];
        start(at, &[&own[..], &run, &joins, more].concat())
    };
    // The closed one has the larger share of the pool, which its rules do not admit.
    let _closed = learner("closed", &["--set", "run.share=99"]);
    let open = learner("seeds-1", &[]);
    let statuses = || {
        let mut asked = treadmill(at);
        let output = asked.args(["status", "--json"]).args(joins).output().unwrap();
        stdout(&output).lines().filter_map(|line| serde_json::from_str(line).ok()).collect::<Vec<Value>>()
    };
    await_that("both learners", || (statuses().len() == 2).then_some(()));
    let actor = |pool: &str| {
        let tls = format!("machines/pools/{pool}");
        let mut command = treadmill(at);
        command.args(["actor", "--pool", "--envs", "8", "--name", pool, "--connect", routing, "--tls", &tls]);
        Running::start(command)
    };
    let lab = actor("lab");
    lab.wait_for("joined run `seeds-1`");
    await_steps(&at.join("seeds-1"), 2048);
    // A certificate of the same authority that no rule names does nothing.
    let _other = actor("other");
    let found = await_that("both learners", || {
        // The first status of a learner says nothing of the pool.
        Some(statuses()).filter(|found| found.iter().filter(|status| status["pool"].is_object()).count() == 2)
    });
    let of_pool = |run: &str| {
        let pool = &found.iter().find(|status| status["run"] == run).unwrap()["pool"];
        (pool["actors"].as_u64().unwrap(), pool["pool_actors"].as_u64().unwrap())
    };
    assert_eq!((of_pool("closed"), of_pool("seeds-1")), ((0, 1), (1, 1)));
    assert_eq!(last_step(&at.join("closed")), 0);
    stop(open);
    assert_usage(at, &["router", "--admit", "lab=walk"], &["--admit", "--tls"]);
    assert_usage(at, &["router", "--admit", "lab"], &["POOL=RUN"]);
    assert_usage(at, &["certs", "certs", "--pool", "La/b"], &["--pool"]);
}
