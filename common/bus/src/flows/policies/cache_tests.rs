//! The cache without a bus: requests are numbers.

use super::{super::pieces::tests::bundle, *};

const OLD: PolicyVersion = PolicyVersion::new(7, 3);
const NEW: PolicyVersion = PolicyVersion::new(7, 4);
const JOINING: PolicyRequest = PolicyRequest { known: None, announced: None, config_hash: 0, offset: 0 };

fn newer(version: PolicyVersion) -> Option<FetchedPolicy> {
    Some(FetchedPolicy::Newer(Box::new(bundle(version))))
}

fn announcement(version: PolicyVersion) -> PolicyAnnouncement {
    PolicyAnnouncement { version, checksum: 1, actor_checksum: bundle(version).checksum }
}

/// Returns the answered requests and their versions.
fn answers(steps: &Steps<u32>) -> Vec<(u32, PolicyVersion)> {
    steps.answers.iter().map(|(waiter, policy)| (*waiter, policy.version)).collect()
}

/// Returns a cache with the old version of run `walk`.
fn warm(now: Instant) -> CachedRuns<u32> {
    let mut runs = CachedRuns::default();
    let steps = runs.request("walk", &JOINING, 0, now);
    let fetch = steps.fetch.expect("nothing is cached");
    assert_eq!(
        (fetch.request, fetch.delay),
        (JOINING, Duration::ZERO),
        "a router fetches configuration and model, too"
    );
    assert_eq!(answers(&runs.fetched("walk", newer(OLD), now)), [(0, OLD)]);
    runs
}

#[test]
fn one_fetch_answers_all_requests() {
    let (mut runs, now) = (CachedRuns::default(), Instant::now());
    let fetches = (0..8).filter(|waiter| runs.request("walk", &JOINING, *waiter, now).fetch.is_some()).count();
    assert_eq!(fetches, 1);
    let answered: Vec<_> = (0..8).map(|waiter| (waiter, OLD)).collect();
    assert_eq!(answers(&runs.fetched("walk", newer(OLD), now)), answered);
    let later = runs.request("walk", &JOINING, 8, now);
    assert_eq!((answers(&later), later.fetch), (vec![(8, OLD)], None));
}

#[test]
fn an_announced_version_is_fetched_and_the_old_one_is_not_served_any_more() {
    let now = Instant::now();
    let mut runs = warm(now);
    let fetch = runs.announce("walk", announcement(NEW), now).fetch.expect("a newer version");
    assert_eq!((fetch.request.known, fetch.request.config_hash), (Some(OLD), 9), "it needs no configuration");
    let waiting = runs.request("walk", &JOINING, 1, now);
    assert_eq!((answers(&waiting), waiting.fetch), (vec![], None));
    // The learner sends no configuration, and the cache adds it for actors that join.
    let update = FetchedPolicy::Newer(Box::new(bundle(NEW).without_config()));
    let steps = runs.fetched("walk", Some(update), now);
    assert_eq!(answers(&steps), [(1, NEW)]);
    assert_eq!(PolicyBundle::decode(steps.answers[0].1.for_joining.clone()).unwrap(), bundle(NEW));
    assert_eq!(runs.announce("walk", announcement(NEW), now).fetch, None, "an announcement may come again");
}

#[test]
fn a_version_announced_during_a_fetch_is_fetched_before_requests_are_answered() {
    let now = Instant::now();
    let mut runs = CachedRuns::default();
    assert!(runs.request("walk", &JOINING, 0, now).fetch.is_some());
    assert_eq!(runs.announce("walk", announcement(NEW), now).fetch, None, "one at a time");
    let steps = runs.fetched("walk", newer(OLD), now);
    assert_eq!((answers(&steps), steps.fetch.unwrap().request.known), (vec![], Some(OLD)));
    assert_eq!(answers(&runs.fetched("walk", newer(NEW), now)), [(0, NEW)]);
}

#[test]
fn waiting_requests_are_answered_even_if_versions_are_announced_faster_than_fetched() {
    let now = Instant::now();
    let mut runs = warm(now);
    let version = |number| PolicyVersion { number, ..OLD };
    assert!(runs.announce("walk", announcement(version(10)), now).fetch.is_some());
    runs.request("walk", &JOINING, 1, now);
    let mut fetches = 1;
    for number in 10.. {
        runs.announce("walk", announcement(version(number + 1)), now);
        let steps = runs.fetched("walk", newer(version(number)), now);
        if steps.fetch.is_none() {
            assert_eq!(answers(&steps), [(1, version(number))]);
            break;
        }
        fetches += 1;
    }
    assert_eq!(fetches, FETCHES_MAX);
    assert!(runs.request("walk", &JOINING, 2, now).fetch.is_some(), "the last announcement still counts");
}

#[test]
fn a_requester_that_heard_of_another_version_makes_the_cache_ask_once() {
    let now = Instant::now();
    let mut runs = warm(now);
    let request = PolicyRequest { known: Some(OLD), announced: Some(NEW), ..JOINING };
    let fetch = runs.request("walk", &request, 1, now).fetch.expect("it may be newer");
    assert_eq!(fetch.delay, ASK_INTERVAL, "claims do not make the cache ask all the time");
    assert_eq!(answers(&runs.fetched("walk", Some(FetchedPolicy::Unchanged), now)), [(1, OLD)], "a false claim");
}

#[test]
fn a_cache_that_is_behind_its_requester_asks_and_one_that_is_ahead_does_not() {
    let now = Instant::now();
    let of_term = |version: PolicyVersion| PolicyVersion { epoch: 5, ..version };
    let (old, new) = (of_term(OLD), of_term(NEW));
    let mut runs = CachedRuns::default();
    runs.request("walk", &JOINING, 0, now);
    runs.fetched("walk", newer(old), now);
    let ahead = PolicyRequest { known: Some(new), ..JOINING };
    assert_eq!(answers(&runs.request("walk", &ahead, 1, now)), []);
    assert_eq!(answers(&runs.fetched("walk", newer(new), now)), [(1, new)]);
    let behind = PolicyRequest { announced: Some(old), ..JOINING };
    assert_eq!(answers(&runs.request("walk", &behind, 2, now)), [(2, new)]);
}

#[test]
fn a_restarted_learner_replaces_an_announced_version() {
    let now = Instant::now();
    let mut runs = warm(now);
    runs.announce("walk", announcement(NEW), now);
    runs.fetched("walk", newer(NEW), now);
    // It resumes from an older checkpoint and has announced nothing yet.
    let restarted = PolicyVersion::new(8, 2);
    let request = PolicyRequest { announced: Some(restarted), ..JOINING };
    assert!(runs.request("walk", &request, 1, now).fetch.is_some());
    assert_eq!(answers(&runs.fetched("walk", newer(restarted), now)), [(1, restarted)]);
    let next = runs.request("walk", &JOINING, 2, now);
    assert_eq!((answers(&next), next.fetch), (vec![(2, restarted)], None));
}

#[test]
fn an_overtaken_learner_is_not_listened_to() {
    let (mut runs, now) = (CachedRuns::<u32>::default(), Instant::now());
    let of = |epoch, number| PolicyVersion { epoch, ..PolicyVersion::new(epoch, number) };
    runs.request("walk", &JOINING, 1, now);
    runs.fetched("walk", newer(of(8, 4)), now);
    assert_eq!(runs.announce("walk", announcement(of(7, 5)), now).fetch, None);
    assert!(runs.announce("walk", announcement(of(8, 5)), now).fetch.is_some());
    let steps = runs.fetched("walk", newer(of(7, 5)), now);
    assert!(steps.answers.is_empty());
    assert_eq!(runs.runs["walk"].version(), Some(of(8, 4)));
}

#[test]
fn lost_announcements_are_noticed() {
    let now = Instant::now();
    let mut runs = warm(now);
    assert!(runs.request("walk", &JOINING, 1, now + FRESH).fetch.is_some(), "long not asked");
    let mut runs = warm(now);
    runs.distrust();
    assert!(runs.request("walk", &JOINING, 1, now).fetch.is_some(), "the queue was full");
}

#[test]
fn without_an_answer_requests_are_dropped_and_the_next_one_asks_again() {
    let (mut runs, now) = (CachedRuns::default(), Instant::now());
    assert!(runs.request("walk", &JOINING, 1, now).fetch.is_some());
    assert!(answers(&runs.fetched("walk", None, now)).is_empty());
    assert!(runs.runs.is_empty(), "a run that no learner knows takes no place");
    assert!(runs.request("walk", &JOINING, 2, now).fetch.is_some());
}

#[test]
fn weights_with_another_checksum_are_rejected() {
    let now = Instant::now();
    let damaged = PolicyBundle { checksum: 1, ..bundle(NEW) };
    let mut runs = warm(now);
    runs.announce("walk", announcement(NEW), now);
    runs.request("walk", &JOINING, 1, now);
    assert!(answers(&runs.fetched("walk", Some(FetchedPolicy::Newer(Box::new(damaged))), now)).is_empty());
    // Its own checksum is right, but not the announced one.
    let mut runs = warm(now);
    runs.announce("walk", PolicyAnnouncement { actor_checksum: 2, ..announcement(NEW) }, now);
    runs.request("walk", &JOINING, 1, now);
    assert!(answers(&runs.fetched("walk", newer(NEW), now)).is_empty());
    assert!(runs.request("walk", &JOINING, 2, now).fetch.is_some());
}

#[test]
fn the_number_of_runs_is_limited_and_idle_ones_make_room() {
    let (mut runs, now) = (CachedRuns::default(), Instant::now());
    let run = |number: usize| format!("run-{number}");
    for number in 0..RUNS_MAX {
        assert!(runs.request(&run(number), &JOINING, 0, now).fetch.is_some());
        let named = PolicyBundle { run: run(number), ..bundle(OLD) };
        runs.fetched(&run(number), Some(FetchedPolicy::Newer(Box::new(named))), now);
    }
    let refused = runs.request("another", &JOINING, 1, now);
    assert_eq!((refused.fetch, runs.runs.len()), (None, RUNS_MAX));
    assert!(runs.request("another", &JOINING, 1, now + IDLE).fetch.is_some());
    assert_eq!(runs.runs.len(), 1);
}
