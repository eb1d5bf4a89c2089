//! Learners that share a store: behind a router with TLS as under Compose, and begun at the same time.

use std::path::Path;

use crate::{support::*, takeover};

fn learner(folder: &Path, name: &str, more: &[&str]) -> Running {
    Running::start(takeover::learner(folder, &takeover::url_in(folder), name, more))
}

#[test]
fn actors_that_know_only_a_router_go_on_with_the_standby_over_tls() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    certs(at, &["authority", "--bundles", "certs", "--host", "127.0.0.1"]);
    let [leading, following, routing] = &free_endpoints("tls");
    let new = ["--preset", "smoke", "--steps", ENDLESS, "--run", "walk"];
    let to_leader = ["--listen", leading, "--tls", "certs/learner"];
    let leader = learner(at, "first", &[&to_leader[..], &new].concat());
    let _router = start(at, &["router", "--listen", routing, "--connect", leading, "--tls", "certs/router"]);
    await_that("the first manifest", || at.join("first/metrics.jsonl").exists().then_some(()));
    let to_standby = ["--standby", "--listen", following, "--connect", routing, "--tls", "certs/standby"];
    let standby = learner(at, "second", &to_standby);
    let _actor = start(at, &["actor", "--envs", "8", "--connect", routing, "--tls", "certs/actor"]);
    await_steps(&at.join("first"), 4096);
    standby.wait_for("run `walk` is at");
    leader.signal(libc::SIGKILL);
    standby.wait_for("taking over");
    await_steps(&at.join("second"), last_step(&at.join("first")) + 2048);
}

#[test]
fn an_actor_that_dials_a_standby_over_tls_moves_to_the_leader_and_back() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    certs(at, &["authority", "--bundles", "certs", "--host", "127.0.0.1"]);
    let [leading, following] = &free_endpoints("tls");
    let new = ["--preset", "smoke", "--steps", ENDLESS, "--run", "walk"];
    let to_leader = ["--listen", leading, "--tls", "certs/learner", "--resume-or-start"];
    let leader = learner(at, "first", &[&to_leader[..], &new].concat());
    await_that("the first manifest", || at.join("first/metrics.jsonl").exists().then_some(()));
    let to_standby = ["--standby", "--listen", following, "--connect", leading, "--tls", "certs/standby"];
    let standby = learner(at, "second", &to_standby);
    standby.wait_for("run `walk` is at");
    let endpoints = ["--connect", following, "--connect", leading, "--tls", "certs/actor"];
    let actor = start(at, &[&["actor", "--envs", "8"][..], &endpoints].concat());
    actor.wait_for("the endpoint is a standby's");
    await_steps(&at.join("first"), 4096);
    // The other one leads then, and the first one follows on the same endpoint.
    leader.signal(libc::SIGSTOP);
    standby.wait_for("taking over");
    await_steps(&at.join("second"), last_step(&at.join("first")) + 2048);
    leader.signal(libc::SIGCONT);
    leader.wait_for("following it from now on");
    standby.signal(libc::SIGTERM);
    leader.wait_for("taking over");
    await_steps(&at.join("first"), last_step(&at.join("second")) + 2048);
}

#[test]
fn of_learners_that_begin_a_run_at_the_same_time_one_leads_and_the_others_follow() {
    const NAMES: [&str; 3] = ["a", "b", "c"];
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let [routing] = &free_endpoints("tcp");
    let new = ["--preset", "smoke", "--steps", ENDLESS, "--run", "walk", "--resume-or-start"];
    let joined = ["--listen", "tcp/127.0.0.1:0", "--connect", routing];
    let learners = NAMES.map(|name| learner(at, name, &[&joined[..], &new].concat()));
    let _router = start(at, &["router", "--listen", routing]);
    let _actor = start(at, &["actor", "--envs", "8", "--connect", routing]);
    let leading = await_that("one that trains", || NAMES.iter().position(|name| last_step(&at.join(name)) > 4096));
    for (index, learner) in learners.iter().enumerate().filter(|(index, _)| *index != leading) {
        learner.wait_for("run `walk` is at");
        assert_eq!(last_step(&at.join(NAMES[index])), 0, "two learners train");
    }
    takeover::stop_run(at, NAMES[leading]);
    for learner in learners {
        let (status, lines) = learner.wait();
        assert!(status.success(), "{lines:#?}");
    }
}
