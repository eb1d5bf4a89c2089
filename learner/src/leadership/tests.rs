//! Leaders and followers with a store in memory.

use std::time::{Duration, Instant};

use treadmill_runtime::seeds;
use treadmill_store::{
    Store, StoreError,
    simulated::{Fault, SimulatedObjects},
};

use super::{
    Leadership, LeadershipError, MANIFEST, Manifest, Status,
    follower::{LeaderSight, LoadedState, Sight, StateFollower, newest_state},
    read_manifest,
};
use crate::checkpoint::Counters;

const GONE: Sight = Sight { leader: LeaderSight::Absent, actors: true };

fn counters(updates: u64) -> Counters {
    Counters { updates, ..Counters::default() }
}

fn lead(store: &Store) -> Leadership {
    Leadership::simulated(store, read_manifest(store).unwrap().as_ref(), seeds::unique())
}

/// Returns a store in memory with the objects in it, and a learner that has begun a run there.
fn begun() -> (SimulatedObjects, Store, Leadership) {
    let objects = SimulatedObjects::default();
    let store = Store::simulated(&objects);
    let mut leader = lead(&store);
    leader.save("walk", &counters(0), b"zero").unwrap();
    (objects, store, leader)
}

/// Returns a clock that shows so many milliseconds since now.
fn clock() -> impl Fn(u64) -> Instant {
    let begun = Instant::now();
    move |ms| begun + Duration::from_millis(ms)
}

/// The same with the thread that removes old states.
fn prepare(store: &Store) -> Leadership {
    Leadership::prepare(store, read_manifest(store).unwrap().as_ref()).unwrap()
}

fn manifest(store: &Store) -> Manifest {
    read_manifest(store).unwrap().unwrap().0
}

#[test]
fn an_overtaken_leader_cannot_save_any_more() {
    let (_, store, mut first) = begun();
    first.save("walk", &counters(1), b"one").unwrap();
    let mut second = lead(&store);
    first.save("walk", &counters(2), b"two").unwrap();
    assert!(
        matches!(second.save("walk", &counters(1), b"late"), Err(LeadershipError::Overtaken { .. })),
        "the first went on"
    );
    let mut third = lead(&store);
    third.save("walk", &counters(2), b"two again").unwrap();
    assert!(third.epoch() > first.epoch());
    let why = first.save("walk", &counters(3), b"three").unwrap_err().to_string();
    assert!(why.contains(&format!("epoch {}", third.epoch())), "{why}");
    assert_eq!(manifest(&store).epoch, third.epoch());
    assert_eq!(store.get(&manifest(&store).state).unwrap().0, b"two again");
}

#[test]
fn a_save_whose_answer_was_lost_counts_once() {
    let (objects, store, mut leader) = begun();
    // The state arrives, the manifest too, and only its answer is lost.
    objects.set_faults([None, Some(Fault::AnswerLost)]);
    leader.save("walk", &counters(1), b"one").unwrap();
    // Neither the answer arrives nor can the manifest be read: the same call again finds its own write.
    objects.set_faults([None, Some(Fault::AnswerLost), Some(Fault::Lost)]);
    assert!(matches!(leader.save("walk", &counters(2), b"two"), Err(LeadershipError::Store(_))));
    leader.save("walk", &counters(2), b"two").unwrap();
    assert_eq!(manifest(&store).updates, 2);
    leader.save("walk", &counters(3), b"three").unwrap();
    assert_eq!(manifest(&store).updates, 3);
    // The call after that is another one.
    objects.set_faults([None, Some(Fault::AnswerLost), Some(Fault::Lost)]);
    assert!(matches!(leader.save("walk", &counters(4), b"four"), Err(LeadershipError::Store(_))));
    leader.save("walk", &counters(5), b"five").unwrap();
    assert_eq!(store.get(&manifest(&store).state).unwrap().0, b"five");
}

#[test]
fn a_store_that_is_down_is_no_loss_of_leadership() {
    let (objects, store, mut leader) = begun();
    objects.set_down(true);
    assert!(matches!(leader.save("walk", &counters(1), b"one"), Err(LeadershipError::Store(_))));
    objects.set_down(false);
    leader.save("walk", &counters(1), b"one").unwrap();
    assert_eq!(manifest(&store).updates, 1);
}

#[test]
fn old_states_are_removed() {
    let store = Store::simulated(&SimulatedObjects::default());
    let mut first = prepare(&store);
    for updates in 0..20 {
        first.save("walk", &counters(updates), b"state").unwrap();
    }
    drop(first);
    let mut second = prepare(&store);
    second.save("walk", &counters(20), b"state").unwrap();
    second.save("walk", &counters(21), b"state").unwrap();
    // The thread removes what is to be removed before it ends.
    drop(second);
    let left = store.list("states").unwrap();
    assert!((1..=4).contains(&left.len()), "{left:?}");
    assert!(store.get(&manifest(&store).state).is_ok());
}

#[test]
fn a_follower_takes_over_only_from_a_leader_that_is_gone() {
    let store = Store::simulated(&SimulatedObjects::default());
    let (mut follower, at) = (StateFollower::new(&store), clock());
    follower.refresh(at(0)).unwrap();
    assert!(follower.loaded().is_none() && !follower.is_due(GONE, at(9000)), "there is no run yet");
    let mut leader = lead(&store);
    leader.save("walk", &counters(0), b"zero").unwrap();
    follower.refresh(at(10_000)).unwrap();
    assert_eq!(follower.loaded().unwrap().state, b"zero"[..]);
    let present = Sight { leader: LeaderSight::Answers, ..GONE };
    assert!(!follower.is_due(present, at(60_000)), "the leader waits");
    assert!(!follower.is_due(GONE, at(60_000)) && !follower.is_due(GONE, at(60_900)));
    leader.save("walk", &counters(1), b"one").unwrap();
    follower.refresh(at(61_100)).unwrap();
    assert!(!follower.is_due(GONE, at(61_100)), "the leader trains, only this follower cannot see it");
    assert!(!follower.is_due(GONE, at(62_000)));
    assert!(follower.is_due(GONE, at(62_100)));
    assert_eq!(follower.loaded().unwrap().manifest.updates, 1);
    let alone = Sight { leader: LeaderSight::Absent, actors: false };
    assert!(!follower.is_due(alone, at(62_100)), "an interval was 51 s, so the longest patience counts");
    assert!(!follower.is_due(alone, at(92_000)) && follower.is_due(alone, at(92_100)));
    // A token that routers repeat, of a leader that does not answer.
    leader.save("walk", &counters(2), b"two").unwrap();
    follower.refresh(at(93_000)).unwrap();
    let silent = Sight { leader: LeaderSight::Silent, actors: true };
    assert!(!follower.is_due(silent, at(93_000)) && !follower.is_due(silent, at(96_900)));
    assert!(follower.is_due(silent, at(97_000)));
}

#[test]
fn a_follower_takes_over_from_a_leader_that_cannot_save() {
    let (objects, store, mut leader) = begun();
    let (mut follower, at) = (StateFollower::new(&store), clock());
    let (answers, stalled) =
        (Sight { leader: LeaderSight::Answers, ..GONE }, Sight { leader: LeaderSight::Stalled, ..GONE });
    follower.refresh(at(0)).unwrap();
    assert!(!follower.is_due(stalled, at(0)) && !follower.is_due(stalled, at(2900)));
    assert!(!follower.is_due(answers, at(3000)) && !follower.is_due(stalled, at(4000)), "one write took long");
    leader.save("walk", &counters(1), b"one").unwrap();
    follower.refresh(at(6900)).unwrap();
    assert!(!follower.is_due(stalled, at(7000)), "it has saved again");
    assert!(!follower.is_due(stalled, at(9900)) && follower.is_due(stalled, at(10_000)));
    assert_eq!(store.list("states").unwrap().len(), 2);
    assert!(follower.try_write() && store.list("states").unwrap().len() == 2, "the trial leaves nothing");
    objects.set_down(true);
    assert!(!follower.try_write(), "the follower could not save either");
}

#[test]
fn a_follower_forgets_what_it_saw_before_it_was_cut_off() {
    let (objects, store, _) = begun();
    let (mut follower, at) = (StateFollower::new(&store), clock());
    follower.refresh(at(0)).unwrap();
    let (answers, silent) =
        (Sight { leader: LeaderSight::Answers, ..GONE }, Sight { leader: LeaderSight::Silent, ..GONE });
    let alone = Sight { actors: false, ..GONE };
    assert!(!follower.is_due(answers, at(0)));
    assert!(!follower.is_due(silent, at(1000)) && !follower.is_due(silent, at(2500)), "it is busy");
    assert!(!follower.is_due(GONE, at(3000)), "one look without its token");
    assert!(!follower.is_due(alone, at(3500)) && !follower.is_due(alone, at(8000)), "cut off from the bus");
    assert!(!follower.is_due(GONE, at(8500)), "just back");
    objects.set_down(true);
    assert!(follower.refresh(at(9000)).is_err());
    objects.set_down(false);
    follower.refresh(at(20_000)).unwrap();
    assert!(!follower.is_due(GONE, at(20_000)), "cut off from the store");
    assert!(!follower.is_due(GONE, at(20_900)) && follower.is_due(GONE, at(21_000)));
}

#[test]
fn a_state_that_is_written_again_is_read_again() {
    let store = Store::simulated(&SimulatedObjects::default());
    let (mut leader, mut follower) = (lead(&store), StateFollower::new(&store));
    for state in ["one", "one with another setting"] {
        leader.save("walk", &counters(1), state.as_bytes()).unwrap();
        follower.refresh(Instant::now()).unwrap();
        assert_eq!(follower.loaded().unwrap().state, state);
    }
}

#[test]
fn a_state_that_stays_missing_is_an_error() {
    let (_, store, mut leader) = begun();
    store.delete(&manifest(&store).state).unwrap();
    let mut follower = StateFollower::new(&store);
    follower.refresh(Instant::now()).unwrap();
    assert!(follower.loaded().is_none(), "its leader may have saved a newer one");
    let why = follower.refresh(Instant::now()).unwrap_err();
    assert!(matches!(&why, LeadershipError::Store(StoreError::Missing { .. })), "{why}");
    leader.save("walk", &counters(1), b"one").unwrap();
    follower.refresh(Instant::now()).unwrap();
    assert_eq!(follower.loaded().unwrap().state, b"one"[..]);
}

#[test]
fn the_end_is_written_once_the_store_answers_again() {
    let (objects, store, mut leader) = begun();
    // The write and the look at the manifest after it.
    objects.set_faults([Some(Fault::Lost); 2]);
    assert!(matches!(leader.end(Status::Released, Duration::ZERO), Err(LeadershipError::Store(_))));
    objects.set_faults([Some(Fault::Lost); 2]);
    leader.end(Status::Stopped, Duration::from_secs(3600)).unwrap();
    assert_eq!(manifest(&store).status, Status::Stopped);
}

#[test]
fn a_learner_that_was_overtaken_finds_out() {
    let (_, store, first) = begun();
    first.confirm().unwrap();
    lead(&store).save("walk", &counters(0), b"zero").unwrap();
    assert!(matches!(first.confirm(), Err(LeadershipError::Overtaken { .. })));
}

#[test]
fn a_state_that_cannot_be_removed_does_not_keep_others() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(&format!("file://{}", folder.path().display())).unwrap();
    // A folder is no object.
    std::fs::create_dir_all(folder.path().join("states/0-backup")).unwrap();
    let mut leader = prepare(&store);
    for updates in 0..20 {
        leader.save("walk", &counters(updates), b"state").unwrap();
    }
    drop(leader);
    let left = store.list("states").unwrap();
    assert!((2..=5).contains(&left.len()), "{left:?}");
}

#[test]
fn the_end_of_a_leadership_decides_what_follows() {
    let store = Store::simulated(&SimulatedObjects::default());
    for (status, is_due) in [(Status::Released, true), (Status::Stopped, false), (Status::Finished, false)] {
        let mut leader = lead(&store);
        leader.save("walk", &counters(0), b"zero").unwrap();
        leader.end(status, Duration::ZERO).unwrap();
        let mut follower = StateFollower::new(&store);
        follower.refresh(Instant::now()).unwrap();
        assert_eq!(follower.is_due(GONE, Instant::now()), is_due, "{status:?}");
    }
}

#[test]
fn a_damaged_manifest_is_refused_with_its_field() {
    let (_, store, _) = begun();
    let sound = String::from_utf8(store.get(MANIFEST).unwrap().0).unwrap();
    for (from, to, wanted) in [
        ("\"format\": 1", "\"format\": 2", "`format` is 2"),
        ("\"walk\"", "\"a/b\"", "run"),
        ("states/", "../", "`state`"),
        ("states/", "states/x/", "`state`"),
        ("\"epoch\"", "\"epoc\"", "epoch"),
        ("}", "", "EOF"),
    ] {
        assert!(sound.contains(from), "{sound}");
        store.put(MANIFEST, sound.replace(from, to).as_bytes()).unwrap();
        let why = read_manifest(&store).unwrap_err().to_string();
        assert!(why.contains(wanted), "{to}: {why}");
    }
}

#[test]
fn the_newest_state_is_read_while_its_leader_removes_old_ones() {
    let store = Store::simulated(&SimulatedObjects::default());
    assert!(newest_state(&store).unwrap().is_none());
    let mut leader = prepare(&store);
    leader.save("walk", &counters(0), b"0").unwrap();
    std::thread::scope(|scope| {
        let saving = scope.spawn(move || {
            (1..2000u64)
                .for_each(|updates| leader.save("walk", &counters(updates), updates.to_string().as_bytes()).unwrap());
        });
        while !saving.is_finished() {
            let LoadedState { manifest, state, .. } = newest_state(&store).unwrap().expect("a state");
            assert_eq!(state, manifest.updates.to_string());
        }
    });
    store.delete(&manifest(&store).state).unwrap();
    assert!(matches!(newest_state(&store), Err(LeadershipError::Store(StoreError::Missing { .. }))));
}
