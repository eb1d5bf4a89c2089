//! A learner that steps down, beside its successor.

use std::{sync::Arc, time::Duration};

use bytes::Bytes;
use treadmill_actor::{delivery::Uploader, policy_fetcher::PolicyFetcher};
use treadmill_bus::{
    Bus,
    actor::submit,
    learner::{Admission, RolloutCopies, RolloutIntake},
    observer::{command, newest_of_each_run, statuses},
};
use treadmill_policy::{NetworkShape, actor_to_safetensors};
use treadmill_proto::{Command, ControlRequest, Outcome, PolicyBundle, PolicyVersion, Receipt, RunStatus};
use treadmill_runtime::seeds;

use crate::{policies, support::*};

/// Waits until a learner on this host answers.
async fn await_answer(bus: &Bus, host: &str) {
    for _ in 0..20 {
        let replies = statuses(bus, Some("run"), Duration::from_secs(1)).await.unwrap();
        if replies.iter().any(|reply| reply.status.as_ref().is_some_and(|status| status.host == host)) {
            return;
        }
        tokio::time::sleep(Duration::from_millis(100)).await;
    }
    panic!("no answer from {host}");
}

#[tokio::test(flavor = "multi_thread")]
async fn routers_that_join_after_a_learner_stepped_down_find_its_successor() {
    let on = |host: &str| RunStatus { run: "run".to_string(), host: host.to_string(), ..RunStatus::default() };
    let (successor, endpoints) = open_router(&[]);
    let (overtaken, _) = open_router(&endpoints);
    let before = StatusServer::start(&overtaken, on("overtaken"));
    await_answer(&successor, "overtaken").await;
    let leading = StatusServer::start(&successor, on("successor"));
    drop(before);
    overtaken.close();
    let (late, _) = open_router(&endpoints);
    await_answer(&late, "successor").await;
    drop(leading);
    [late, successor].iter().for_each(Bus::close);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_learner_that_was_overtaken_hides_no_answer_of_its_successor() {
    let of_epoch = |epoch| {
        let version = Some(PolicyVersion { epoch, ..PolicyVersion::default() });
        RunStatus { run: "run".to_string(), version, ..RunStatus::default() }
    };
    let (router, endpoints) = open_router(&[]);
    let (beside, _) = open_router(&endpoints);
    let servers = [(&router, 7), (&beside, 8)].map(|(bus, epoch)| StatusServer::start(bus, of_epoch(epoch)));
    let (client, _) = open_router(&endpoints);
    let epoch = |status: &RunStatus| status.version.unwrap().epoch;
    let mut epochs = Vec::new();
    for _ in 0..20 {
        let replies = statuses(&client, Some("run"), TIMEOUT).await.unwrap();
        assert!(newest_of_each_run(replies.clone()).len() <= 1);
        epochs = replies.iter().filter_map(|reply| reply.status.as_ref()).map(epoch).collect();
        if epochs.len() > 1 {
            break;
        }
        tokio::time::sleep(Duration::from_millis(100)).await;
    }
    epochs.sort_unstable();
    assert_eq!(epochs, [7, 8]);
    let reply = command(&client, "run", &ControlRequest::plain(Command::Pause), TIMEOUT).await.unwrap().unwrap();
    assert_eq!(epoch(&reply.status.unwrap()), 8);
    drop(servers);
    [client, beside, router].iter().for_each(Bus::close);
}

/// Learner that takes fragments.
fn intake(bus: &Bus) -> RolloutIntake {
    let copies = RolloutCopies::open(bus, "run").unwrap();
    RolloutIntake::open(bus, "run", 4, Arc::new(Admission::new(8, 4)), &copies).unwrap()
}

fn receipt(outcome: Outcome, epoch: u64) -> Receipt {
    let version = PolicyVersion { epoch, ..PolicyVersion::default() };
    Receipt { outcome, reason: String::new(), version, durable_through: 0, fragment_steps: 0 }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_fragment_is_settled_by_the_successor_of_a_learner_that_is_silent_or_refuses() {
    let (successor, endpoints) = open_router(&[]);
    let (overtaken, _) = open_router(&endpoints);
    let (leading, before) = (intake(&successor), intake(&overtaken));
    let (actor, _) = open_router(&endpoints);
    // Both get each fragment from the time when the actor's router knows both.
    let mut sent = 0;
    let mut next = || {
        sent += 1;
        let (actor, fragment) = (actor.clone(), Bytes::from(vec![sent]));
        let settles = |receipt: &Receipt| receipt.version.epoch == 2 && receipt.outcome == Outcome::Accepted;
        tokio::spawn(async move { submit(&actor, "run", "one", fragment, TIMEOUT, settles).await.unwrap() })
    };
    let silent = loop {
        let settled = next();
        let of_both = [&leading, &before].map(|intake| intake.next(Duration::from_secs(1)));
        if let [Some(first), Some(mut second)] = of_both {
            second.take();
            first.answer(&receipt(Outcome::Accepted, 2));
            let settled = settled.await.unwrap().expect("a receipt, though the other learner is silent");
            assert_eq!((settled.outcome, settled.version.epoch), (Outcome::Accepted, 2));
            break second;
        }
    };
    let settled = next();
    let (first, second) = (leading.next(TIMEOUT).unwrap(), before.next(TIMEOUT).unwrap());
    second.answer(&receipt(Outcome::Busy, 1));
    first.answer(&receipt(Outcome::Accepted, 2));
    assert_eq!(settled.await.unwrap().expect("a receipt").outcome, Outcome::Accepted);
    drop(silent);
    [actor, overtaken, successor].iter().for_each(Bus::close);
}

/// Policy of the smallest network, which an actor can load.
fn bundle() -> PolicyBundle {
    let shape = NetworkShape { observation: 1, action: 1, hidden: vec![1], privileged: 0 };
    let weights: Bytes = actor_to_safetensors(&shape, &vec![0.0; shape.parameter_count()]).into();
    let [_, for_actors] = policies::bundle(1);
    PolicyBundle { checksum: seeds::checksum(&[&weights]), weights, ..for_actors }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_fragment_is_sent_again_as_soon_as_another_learner_leads() {
    let (learner, endpoints) = open_router(&[]);
    let (actor, _) = open_router(&endpoints);
    let intake = intake(&learner);
    let policies = Arc::new(PolicyFetcher::new(actor.clone(), Some("run".into()), &bundle(), Arc::default()).unwrap());
    let an_hour = Duration::from_secs(3600);
    let uploader = Uploader::new(actor.clone(), "run", "one", an_hour, policies.clone(), 1);
    let fragment = uploader.produced(1, Bytes::from_static(b"fragment"));
    let delivered = tokio::spawn(async move { uploader.deliver(fragment).await.map(|_| uploader.counts()) });
    let mut unanswered = intake.next(TIMEOUT).expect("the fragment");
    unanswered.take();
    assert!(policies.admits(PolicyVersion { epoch: 2, ..PolicyVersion::default() }));
    intake.next(TIMEOUT).expect("the fragment again").answer(&receipt(Outcome::Accepted, 2));
    let counts = delivered.await.unwrap().unwrap();
    // Once more for each attempt before the actor knew a way to the learner.
    assert!(counts.accepted == 1 && counts.resent >= 1, "{counts:?}");
    drop(unanswered);
    [actor, learner].iter().for_each(Bus::close);
}
