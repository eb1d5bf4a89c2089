//! Policies through routers: the learner sends each version once to a router, and all actors behind it get it.

use std::{collections::BTreeMap, path::Path};

use bytes::Bytes;
use treadmill_bus::{
    Bus,
    actor::{FetchedPolicy, fetch_newer_policy, fetch_policy},
    learner::{Alive, PolicyServer, PublishedPolicy, ServedPolicies},
};
use treadmill_proto::{PolicyBundle, PolicyRequest, PolicyVersion};
use treadmill_runtime::seeds;

use crate::support::*;

/// Clients behind the last router.
const CLIENTS: usize = 8;
/// Larger than a piece, so that several are needed.
const WEIGHTS: usize = 200_000;

/// Returns a bundle of one observation and one action: whole, and for actors. Its weights are no network.
pub fn bundle(number: u64) -> [PolicyBundle; 2] {
    [2 * WEIGHTS, WEIGHTS].map(|length| {
        let weights = Bytes::from(vec![number as u8; length]);
        PolicyBundle {
            run: "run".into(),
            version: PolicyVersion::new(7, number),
            observation_size: 1,
            action_size: 1,
            hidden: vec![1],
            checksum: seeds::checksum(&[&weights]),
            weights,
            observation_mean: vec![0.0],
            observation_inverse_std: vec![1.0],
            observation_clip: 10.0,
            config_hash: 9,
            config_toml: "[run]".into(),
            model_xml: "<mujoco/>".into(),
            ..PolicyBundle::default()
        }
    })
}

fn published(number: u64) -> PublishedPolicy {
    let [whole, for_actors] = bundle(number);
    PublishedPolicy::new(&whole, &for_actors).unwrap()
}

fn router(folder: &Path, listen: &str, connect: &str, more: &[&str]) -> Running {
    let router = start(folder, &[&["router", "--listen", listen, "--connect", connect], more].concat());
    router.wait_for("listening");
    router
}

/// Fetches the announced version `number` with every client at once, as actors do that have the version before.
async fn fetch_with_all(clients: &[Bus], number: u64) {
    let mut fetches = tokio::task::JoinSet::new();
    for bus in clients {
        let bus = bus.clone();
        fetches.spawn(async move {
            let announced = Some(PolicyVersion::new(7, number));
            let known = Some(PolicyVersion::new(7, number - 1));
            let request = PolicyRequest { known, announced, config_hash: 9, offset: 0 };
            let fetched = until_answered(|| fetch_newer_policy(&bus, "run", &request, TIMEOUT)).await;
            let [_, for_actors] = bundle(number);
            assert_eq!(fetched, FetchedPolicy::Newer(Box::new(for_actors.without_config())));
        });
    }
    while let Some(fetched) = fetches.join_next().await {
        fetched.unwrap();
    }
}

/// Returns how many policies the learner sent since `before`.
fn sent_since(server: &PolicyServer, before: ServedPolicies) -> u64 {
    server.served().policies - before.policies
}

#[tokio::test(flavor = "multi_thread")]
async fn a_router_fetches_each_version_once_for_all_actors_behind_it() {
    let (folder, _) = folders();
    let (learner, endpoints) = open_router(&[]);
    let server = PolicyServer::open(&learner, published(1)).unwrap();
    // The actors' router is behind another one.
    let [outer_at, inner_at] = free_endpoints("tcp");
    let _outer = router(folder.path(), &outer_at, &endpoints[0], &[]);
    let inner = router(folder.path(), &inner_at, &outer_at, &[]);
    let clients: Vec<Bus> = (0..CLIENTS).map(|_| open_client(std::slice::from_ref(&inner_at))).collect();
    for client in &clients {
        assert_eq!(policy(client).await, bundle(1)[1], "with configuration and model, without the critic");
    }
    for number in 2..6 {
        let before = server.served();
        server.publish(published(number));
        fetch_with_all(&clients, number).await;
        assert_eq!(sent_since(&server, before), 1, "version {number}");
        let bytes = server.served().bytes - before.bytes;
        assert!(bytes < 2 * WEIGHTS as u64, "{bytes} bytes for {CLIENTS} actors");
    }
    // Actors that poll get a short answer, wherever it comes from.
    let before = server.served();
    for client in &clients {
        let request = PolicyRequest { known: Some(PolicyVersion::new(7, 5)), ..Default::default() };
        let polled = fetch_newer_policy(client, "run", &request, TIMEOUT).await.unwrap();
        assert_eq!(polled, Some(FetchedPolicy::Unchanged));
    }
    assert_eq!(sent_since(&server, before), 0);

    // A new router knows nothing. Meanwhile the learner announces a version that no client receives.
    inner.signal(libc::SIGKILL);
    inner.wait();
    server.publish(published(6));
    let inner = router(folder.path(), &inner_at, &outer_at, &[]);
    fetch_with_all(&clients, 6).await;
    let before = server.served();
    server.publish(published(7));
    fetch_with_all(&clients, 7).await;
    assert_eq!(sent_since(&server, before), 1);
    clients.iter().for_each(Bus::close);
    drop((server, inner));
    learner.close();
}

#[tokio::test(flavor = "multi_thread")]
async fn an_actor_of_the_learner_gets_a_version_once() {
    let (learner, connect) = open_router(&[]);
    let server = PolicyServer::open(&learner, published(1)).unwrap();
    let client = open_client(&connect);
    assert_eq!(policy(&client).await, bundle(1)[1]);
    assert_eq!(fetch_policy(&client, None, TIMEOUT).await.unwrap(), None, "no learner holds a token");
    let _token = Alive::watch(&learner, "run").unwrap();
    assert_eq!(until_answered(|| fetch_policy(&client, None, TIMEOUT)).await, bundle(1)[1]);
    let before = server.served();
    server.publish(published(2));
    fetch_with_all(std::slice::from_ref(&client), 2).await;
    let current = PolicyRequest { known: Some(bundle(2)[0].version), ..PolicyRequest::default() };
    let polled = fetch_newer_policy(&client, "run", &current, TIMEOUT).await.unwrap();
    assert_eq!(polled, Some(FetchedPolicy::Unchanged));
    let after = server.served();
    assert_eq!((sent_since(&server, before), after.unchanged - before.unchanged), (1, 1));
    client.close();
    learner.close();
}

fn assert_one_policy_per_version(tls: bool) {
    let (folder, run) = folders();
    certs(folder.path(), &["certs"]);
    let (scheme, with_tls) = if tls { ("tls", &["--tls", "certs"][..]) } else { ("tcp", &[][..]) };
    let mut command = endless(folder.path(), &run, "learner");
    command.args(["--listen", &format!("{scheme}/127.0.0.1:0")]).args(with_tls);
    command.env("TREADMILL_LOG", "warn,zenoh=off,treadmill_bus=debug");
    let learner = Running::start(command);
    let [router_at] = free_endpoints(scheme);
    let router = router(folder.path(), &router_at, &endpoint(&run), with_tls);
    let actors: Vec<Running> = (0..CLIENTS)
        .map(|number| {
            let name = format!("a{number}");
            let args = ["actor", "--connect", &router_at, "--run", "run", "--envs", "2", "--name", &name];
            start(folder.path(), &[&args, with_tls].concat())
        })
        .collect();
    await_that("all actors", || last_value(&run, "actors/alive").filter(|alive| *alive == CLIENTS as f64));
    let joined = metrics(&run).iter().filter(|(tag, ..)| tag == "train/n_updates").count() as u64;
    let steps = metrics(&run).last().unwrap().1;
    await_steps(&run, steps + 16_384);
    actors.iter().for_each(|actor| actor.signal(libc::SIGTERM));
    learner.signal(libc::SIGINT);
    let (status, lines) = learner.wait();
    assert!(status.success(), "{lines:#?}");
    let mut served: BTreeMap<u64, u32> = BTreeMap::new();
    for line in lines.iter().filter(|line| line.contains("policy served")) {
        let version = line.split("version=").nth(1).and_then(|rest| rest.split_whitespace().next());
        *served.entry(version.unwrap().parse().unwrap()).or_default() += 1;
    }
    let after_joining: Vec<_> = served.range(joined + 2..).collect();
    assert!(after_joining.len() > 4, "{served:?}");
    assert!(after_joining.iter().all(|(_, count)| **count == 1), "{served:?}");
    drop((actors, router));
}

#[test]
fn a_learner_sends_a_version_once_to_the_router_of_eight_actors() {
    assert_one_policy_per_version(false);
}

#[test]
fn access_rules_let_a_router_answer_for_the_learner() {
    assert_one_policy_per_version(true);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_router_to_which_a_learners_answers_do_not_come_starts_anew() {
    let (folder, _) = folders();
    let (learner, connect) = open_router(&[]);
    let _token = Alive::watch(&learner, "run").unwrap();
    let [router_at] = free_endpoints("tcp");
    let router = router(folder.path(), &router_at, &connect[0], &[]);
    let client = tokio::task::spawn_blocking(move || open_client(&[router_at])).await.unwrap();
    let asking = tokio::spawn({
        let client = client.clone();
        async move { policy(&client).await }
    });
    let line = tokio::task::spawn_blocking(move || (router.wait_for("starting anew"), router));
    let (line, _router) = line.await.unwrap();
    assert!(line.contains("run=\"run\""), "{line}");
    let _server = PolicyServer::open(&learner, published(1)).unwrap();
    assert_eq!(asking.await.unwrap().version, PolicyVersion::new(7, 1), "the client is behind the router again");
    client.close();
    learner.close();
}
