//! A learner that steps down, beside its successor.

use std::time::Duration;

use treadmill_bus::{Bus, BusOptions, statuses};
use treadmill_proto::RunStatus;

use crate::support::*;

fn open(connect: &[String]) -> (Bus, Vec<String>) {
    let listen = vec!["tcp/127.0.0.1:0".to_string()];
    Bus::open_router(&BusOptions { listen, connect: connect.to_vec(), ..BusOptions::default() }).unwrap()
}

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
    let (successor, endpoints) = open(&[]);
    let (overtaken, _) = open(&endpoints);
    let before = StatusServer::start(&overtaken, on("overtaken"));
    await_answer(&successor, "overtaken").await;
    let leading = StatusServer::start(&successor, on("successor"));
    drop(before);
    overtaken.close();
    let (late, _) = open(&endpoints);
    await_answer(&late, "successor").await;
    drop(leading);
    [late, successor].iter().for_each(Bus::close);
}
