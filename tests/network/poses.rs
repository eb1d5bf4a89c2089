//! Poses of an actor: made and sent only while an observer subscribes.

use crate::support::*;
use treadmill_actor::poses::is_shown;
use treadmill_bus::{
    Bus,
    actor::PosePublisher,
    observer::{Feed, Message, observe},
};
use treadmill_humanoid::Model;
use treadmill_proto::Pose;

/// Capacity of a subscriber that loses nothing on a slow machine.
const RING: usize = 4096;
/// Control step of the task (s).
const CONTROL_STEP_S: f64 = 0.015;

fn next(feed: &Feed) -> Pose {
    let Message { key, payload } = feed.next(TIMEOUT).expect("a pose");
    let pose = Pose::decode_checked(&payload).unwrap();
    assert_eq!(key, format!("treadmill/run/poses/{}", pose.actor));
    pose
}

#[test]
fn observers_see_episodes_from_their_start() {
    let (folder, run) = folders();
    let _learner = start_endless(folder.path(), &run, "learner", &["--listen", "tcp/127.0.0.1:0"]);
    let _actor = start(folder.path(), &["actor", "--connect", &endpoint(&run), "--envs", "4", "--name", "legs"]);
    await_steps(&run, 4096);
    let bus = join(&run);
    let bundle = tokio::runtime::Runtime::new().unwrap().block_on(policy(&bus));
    let model = Model::from_mjcf(&bundle.model_xml).unwrap();
    let feed = observe(&bus, "treadmill/run/poses/*", RING).unwrap();
    // The actor has simulated many episodes; its poses begin with the start of one, because it sent none before.
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
            // A full link may drop some.
            assert!(pose.step > last.step && is_shown(pose.step, CONTROL_STEP_S), "{} after {}", pose.step, last.step);
        } else {
            assert!(pose.episode > last.episode);
            assert_eq!(pose.step, 0);
            episodes += 1;
        }
        last = pose;
    }
    assert!(episodes > 0, "a body that has learnt nothing falls within 3 s");
}

#[test]
fn an_actor_knows_whether_it_is_watched() {
    let (router, endpoints) = open_router(&[]);
    let (actor, viewer) = (open_client(&endpoints), open_client(&endpoints));
    let publisher = PosePublisher::open(&actor, "run", "legs").unwrap();
    let other = PosePublisher::open(&actor, "run", "arms").unwrap();
    let watched = publisher.watched();
    assert!(!watched.now());
    let feed = observe(&viewer, "treadmill/run/poses/legs", RING).unwrap();
    await_that("an observer", || watched.now().then_some(()));
    assert!(!other.watched().now(), "the other one is not watched");
    publisher.publish(b"a pose".to_vec());
    assert_eq!(feed.next(TIMEOUT).expect("the pose").payload, b"a pose");
    drop(feed);
    await_that("no observer", || (!watched.now()).then_some(()));
    [viewer, actor, router].iter().for_each(Bus::close);
}
