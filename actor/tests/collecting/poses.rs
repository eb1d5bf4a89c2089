//! Poses that a camera records: whole episodes, while an observer is subscribed.

use treadmill_actor::{
    environments::{Environments, SeedSource, Stepped},
    poses::{Camera, STRIDE, Tape},
    rollout::Sender,
};
use treadmill_bus::Watched;
use treadmill_humanoid::{CONTROL_STEP_S, EnvironmentConfig, HUMANOID_XML, Model};
use treadmill_proto::{PolicyVersion, Pose};

const VERSION: PolicyVersion = PolicyVersion { incarnation: 3, number: 4 };
const ENVS: usize = 2;

struct Filmed {
    environments: Environments,
    stepped: Stepped,
    camera: Camera,
    watched: Watched,
    tape: Tape,
}

impl Filmed {
    fn begin(config: &EnvironmentConfig) -> Self {
        let seeds = SeedSource { run_seed: 1, actor: "a".into(), start: 0 };
        let environments = Environments::new(ENVS, config, HUMANOID_XML, seeds).unwrap();
        let watched = Watched::default();
        let sender = Sender { run: "walk".into(), actor: "a".into(), incarnation: 6, config_hash: 5 };
        let (camera, tape) = Camera::new(watched.clone(), sender);
        Self { environments, stepped: Stepped::default(), camera, watched, tape }
    }

    fn step(&mut self, steps: u32) {
        for _ in 0..steps {
            self.environments.step(&[0.0; 17 * ENVS], &mut self.stepped);
            self.camera.see(&self.environments, VERSION);
        }
    }

    fn recorded(&mut self) -> Vec<Pose> {
        std::iter::from_fn(|| self.tape.try_recv().ok()).collect()
    }
}

/// Episode and step of each.
fn moments(poses: &[Pose]) -> Vec<(u64, u32)> {
    poses.iter().map(|pose| (pose.episode, pose.step)).collect()
}

#[test]
fn nothing_is_recorded_while_nobody_watches() {
    let mut filmed = Filmed::begin(&EnvironmentConfig { max_episode_steps: 7, ..EnvironmentConfig::default() });
    filmed.step(20);
    assert!(filmed.recorded().is_empty());
    // An observer that subscribes in the middle of the third episode gets the fourth from its start.
    filmed.watched.set(true);
    filmed.step(7);
    assert_eq!(moments(&filmed.recorded()), [(4, 0), (4, 2), (4, 4), (4, 6)]);
    filmed.watched.set(false);
    filmed.step(20);
    assert!(filmed.recorded().is_empty());
}

#[test]
fn an_episode_is_recorded_whole_and_told_before_the_next_one() {
    let mut filmed = Filmed::begin(&EnvironmentConfig { max_episode_steps: 7, ..EnvironmentConfig::default() });
    filmed.watched.set(true);
    filmed.step(40);
    let whole = |episode| [0, 2, 4, 6].map(|step| (episode, step));
    assert_eq!(moments(&filmed.recorded()), whole(2), "those that began before it was told are left out");
    filmed.step(14);
    assert_eq!(moments(&filmed.recorded()), whole(7));
}

#[test]
fn a_pose_is_the_body_as_the_physics_has_it() {
    let mut filmed = Filmed::begin(&EnvironmentConfig { max_episode_steps: 9, ..EnvironmentConfig::default() });
    filmed.watched.set(true);
    filmed.step(13);
    let poses = filmed.recorded();
    let model = Model::from_mjcf(HUMANOID_XML).unwrap();
    let last = poses.last().unwrap();
    assert_eq!((last.episode, last.step), (2, 4));
    let physics = filmed.environments.first().unwrap().environment.physics();
    assert_eq!(last.bodies.len(), 7 * model.bodies.len());
    assert_eq!(last.joint_torques_nm.len(), model.hinges.len());
    for (numbers, motion) in last.bodies.as_chunks::<7>().0.iter().zip(physics.body_motions()) {
        let at = motion.pose.translation.vector;
        assert_eq!(numbers[..3], [at.x as f32, at.y as f32, at.z as f32]);
        let turned = motion.pose.rotation.quaternion();
        assert_eq!(numbers[3..], [turned.w, turned.i, turned.j, turned.k].map(|part| part as f32));
    }
    assert_eq!((last.time_s, poses[0].distance_m), (4.0 * CONTROL_STEP_S, 0.0));
    assert_eq!(last.reward_survive, 5.0);
    for pose in &poses {
        assert_eq!(Pose::decode_checked(&pose.to_bytes().unwrap()).as_ref(), Ok(pose));
        assert_eq!((pose.version, pose.config_hash), (Some(VERSION.into()), 5));
    }
}

#[test]
fn a_long_episode_does_not_grow_the_tape_without_bound() {
    let config =
        EnvironmentConfig { max_episode_steps: 5000, terminate_when_unhealthy: false, ..EnvironmentConfig::default() };
    let mut filmed = Filmed::begin(&config);
    filmed.step(4999);
    filmed.watched.set(true);
    filmed.step(2000);
    let poses = filmed.recorded();
    assert_eq!(poses.len(), 512);
    assert_eq!(poses.last().unwrap().step, 511 * STRIDE);
    // What was recorded is told now, but this episode was left in its middle.
    filmed.step(100);
    assert!(filmed.recorded().is_empty());
}
