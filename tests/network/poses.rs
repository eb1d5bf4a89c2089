//! Poses of an actor: made and sent only while an observer is subscribed.

use std::time::Duration;

use crate::support::*;
use treadmill_bus::{Bus, BusOptions, Credentials, Feed, Message, PosePublisher, Role, fetch_policy, observe};
use treadmill_humanoid::Model;
use treadmill_proto::{PolicyBundle, Pose};

/// A subscriber must not lose any to a slow test machine.
const RING: usize = 4096;
/// Of the poses of an actor, every other control step is told.
const STRIDE: u32 = 2;

fn next(feed: &Feed) -> Pose {
    let Message { key, payload } = feed.next(PATIENCE).expect("a pose");
    let pose = Pose::decode_checked(&payload).unwrap();
    assert_eq!(key, format!("treadmill/run/poses/{}", pose.actor));
    pose
}

fn bundle(bus: &Bus) -> PolicyBundle {
    let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build().unwrap();
    await_that("the policy", || runtime.block_on(fetch_policy(bus, Some("run"), PATIENCE)).unwrap())
}

#[test]
fn whoever_watches_sees_episodes_from_their_start() {
    let (folder, run) = folders();
    let mut command = treadmill(folder.path());
    command.args(["learner", "--preset", "smoke", "--steps", "1000000000", "--run-dir", run.to_str().unwrap()]);
    command.args(["--listen", "tcp/127.0.0.1:0"]);
    let _learner = Running::start(command);
    let endpoint = endpoint(&run);
    let mut command = treadmill(folder.path());
    command.args(["actor", "--connect", &endpoint, "--envs", "4", "--name", "legs"]);
    let _actor = Running::start(command);
    await_steps(&run, 4096);
    let bus = Bus::open_client(&BusOptions { connect: vec![endpoint], ..BusOptions::default() }).unwrap();
    let bundle = bundle(&bus);
    let model = Model::from_mjcf(&bundle.model_xml).unwrap();
    let feed = observe(&bus, "treadmill/run/poses/*", RING).unwrap();
    // It has simulated for long, and begins to tell with the start of an episode: nothing was on its way before.
    let mut last = next(&feed);
    assert_eq!(last.step, 0);
    assert!(last.episode > 1);
    let mut episodes = 0;
    for _ in 0..100 {
        let pose = next(&feed);
        assert_eq!((pose.run.as_str(), pose.actor.as_str()), ("run", "legs"));
        assert_eq!((pose.actor_incarnation, pose.config_hash), (last.actor_incarnation, bundle.config_hash));
        assert_eq!(pose.bodies.len(), 7 * model.bodies.len());
        assert_eq!(pose.joint_torques_nm.len(), model.hinges.len());
        if pose.episode == last.episode {
            assert_eq!(pose.step, last.step + STRIDE, "none is left out");
        } else {
            assert!(pose.episode > last.episode);
            assert_eq!(pose.step, 0);
            episodes += 1;
        }
        last = pose;
    }
    assert!(episodes > 0, "a body that has learnt nothing falls within {} steps", 100 * STRIDE);
}

#[test]
fn observers_may_watch_and_actors_may_not() {
    let (folder, run) = folders();
    assert!(self::run(folder.path(), &["certs", "certs"]).status.success());
    let mut command = treadmill(folder.path());
    command.args(["train", "--preset", "smoke", "--steps", "1000000000", "--run-dir", run.to_str().unwrap()]);
    command.args(["--listen", "tls/127.0.0.1:0", "--tls", "certs", "--actors", "1"]);
    let _training = Running::start(command);
    let connect = vec![endpoint(&run)];
    let watch = |role| {
        let credentials = Some(Credentials { folder: folder.path().join("certs"), role });
        let options = BusOptions { connect: connect.clone(), credentials, ..BusOptions::default() };
        let bus = Bus::open_client(&options).unwrap();
        (observe(&bus, "treadmill/run/poses/*", RING).unwrap(), bus)
    };
    let (actors, _actor) = watch(Role::Actor);
    let (observers, _observer) = watch(Role::Observer);
    for _ in 0..10 {
        next(&observers);
    }
    assert_eq!(actors.next(Duration::ZERO), None);
}

#[test]
fn an_actor_knows_whether_anybody_watches_it() {
    let listen = vec!["tcp/127.0.0.1:0".to_string()];
    let (router, endpoints) = Bus::open_router(&BusOptions { listen, ..BusOptions::default() }).unwrap();
    let join = || Bus::open_client(&BusOptions { connect: endpoints.clone(), ..BusOptions::default() }).unwrap();
    let (actor, viewer) = (join(), join());
    let publisher = PosePublisher::open(&actor, "run", "legs").unwrap();
    let other = PosePublisher::open(&actor, "run", "arms").unwrap();
    let watched = publisher.watched();
    assert!(!watched.now());
    let feed = observe(&viewer, "treadmill/run/poses/legs", RING).unwrap();
    await_that("an observer", || watched.now().then_some(()));
    assert!(!other.watched().now(), "the other one is not watched");
    publisher.publish(b"a pose".to_vec());
    assert_eq!(feed.next(PATIENCE).expect("the pose").payload, b"a pose");
    drop(feed);
    await_that("no observer", || (!watched.now()).then_some(()));
    [viewer, actor, router].iter().for_each(Bus::close);
}
