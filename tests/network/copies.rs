//! Copies of accepted fragments: sent only to subscribers of exactly these keys.

use crate::support::*;
use bytes::Bytes;
use treadmill_bus::{learner::RolloutCopies, observer::observe};
use treadmill_proto::Fragment;

/// Capacity of a subscriber that loses nothing on a slow machine.
const RING: usize = 65_536;

#[test]
fn subscribers_of_the_copies_get_them_and_subscribers_of_everything_do_not() {
    let (folder, run) = folders();
    let training = start_endless(folder.path(), &run, "train", &[]);
    let bus = join(&run);
    let everything = observe(&bus, "treadmill/**", RING).unwrap();
    let copies = observe(&bus, "treadmill/run/@rollouts/*", RING).unwrap();
    let mut bytes = 0;
    for _ in 0..20 {
        let copy = copies.next(TIMEOUT).expect("a copy");
        bytes += copy.payload.len();
        let fragment = Fragment::decode(Bytes::from(copy.payload)).unwrap();
        assert_eq!(copy.key, format!("treadmill/run/@rollouts/{}", fragment.actor));
        assert_eq!(fragment.transitions(), 256);
    }
    assert!(bytes > 20 * 256 * 45 * 4);
    stop(training);
    let mut seen = 0;
    while let Some(message) = everything.next(std::time::Duration::ZERO) {
        assert!(!message.key.contains('@'), "{}", message.key);
        seen += 1;
    }
    assert!(seen > 20, "metrics, episodes and statistics of as many updates: {seen}");
}

#[test]
fn copies_are_made_only_while_subscribed() {
    let (router, endpoints) = open_router(&[]);
    let copies = RolloutCopies::open(&router, "run").unwrap();
    let watched = copies.watched();
    let client = open_client(&endpoints);
    let _everything = observe(&client, "treadmill/**", 16).unwrap();
    let other = observe(&client, "treadmill/other-run/@rollouts/*", 16).unwrap();
    assert!(!watched.now());
    let one = observe(&client, "treadmill/run/@rollouts/actor-1", 16).unwrap();
    await_that("a subscriber", || watched.now().then_some(()));
    copies.offer("actor-2", Bytes::from_static(b"unwanted"));
    copies.offer("actor-1", Bytes::from_static(b"a fragment"));
    let message = one.next(TIMEOUT).expect("the copy");
    assert_eq!((&message.key[..], &message.payload[..]), ("treadmill/run/@rollouts/actor-1", &b"a fragment"[..]));
    drop(one);
    await_that("no subscriber", || (!watched.now()).then_some(()));
    // Unread copies do not pile up.
    for _ in 0..1000 {
        copies.offer("actor-1", Bytes::from(vec![0; 1 << 20]));
    }
    assert!(other.next(std::time::Duration::ZERO).is_none());
    client.close();
    router.close();
}
