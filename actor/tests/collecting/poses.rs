//! Pose sampler: records whole episodes while an observer is subscribed.

use tokio::sync::mpsc;
use treadmill_actor::{
    environments::{Environments, StepResults},
    poses::{PoseSampler, body_pose},
};
use treadmill_bus::actor::Watched;
use treadmill_humanoid::{EnvConfig, Environment, EnvironmentConfig, HUMANOID_XML, Model};
use treadmill_proto::{PolicyVersion, Pose};

use crate::{environments, identity, limited};

const VERSION: PolicyVersion = PolicyVersion::new(3, 4);
const ENVS: usize = 2;

struct Recording {
    environments: Environments,
    results: StepResults,
    sampler: PoseSampler,
    watched: Watched,
    poses: mpsc::Receiver<Pose>,
}

impl Recording {
    fn begin(config: &EnvironmentConfig) -> Self {
        let environments = environments(ENVS, config, "a", 0);
        let watched = Watched::default();
        let (sampler, poses) = PoseSampler::new(watched.clone(), identity("a"));
        Self { environments, results: StepResults::default(), sampler, watched, poses }
    }

    fn step(&mut self, steps: u32) {
        for _ in 0..steps {
            self.environments.step(&[0.0; 17 * ENVS], &mut self.results);
            self.sampler.sample(&self.environments, VERSION);
        }
    }

    fn recorded(&mut self) -> Vec<Pose> {
        std::iter::from_fn(|| self.poses.try_recv().ok()).collect()
    }
}

/// Returns episode and step of each pose.
fn moments(poses: &[Pose]) -> Vec<(u64, u32)> {
    poses.iter().map(|pose| (pose.episode, pose.step)).collect()
}

#[test]
fn without_observers_nothing_is_recorded() {
    let mut recording = Recording::begin(&limited(7));
    recording.step(20);
    assert!(recording.recorded().is_empty());
    // An observer that subscribes in the middle of the third episode gets the fourth from its start.
    recording.watched.set(true);
    recording.step(7);
    assert_eq!(moments(&recording.recorded()), [(4, 0), (4, 3), (4, 5)]);
    recording.watched.set(false);
    recording.step(20);
    assert!(recording.recorded().is_empty());
}

#[test]
fn an_episode_is_recorded_whole_and_drained_before_the_next() {
    let mut recording = Recording::begin(&limited(7));
    recording.watched.set(true);
    recording.step(40);
    let whole = |episode| [0, 3, 5].map(|step| (episode, step));
    assert_eq!(moments(&recording.recorded()), whole(2), "episodes that began before the queue was empty are left out");
    recording.step(14);
    assert_eq!(moments(&recording.recorded()), whole(7));
}

#[test]
fn poses_follow_the_control_step() {
    let config =
        EnvironmentConfig::from(EnvConfig { control_step_s: 0.01, max_episode_steps: 7, ..EnvConfig::default() });
    let mut recording = Recording::begin(&config);
    recording.watched.set(true);
    recording.step(14);
    let poses = recording.recorded();
    assert_eq!(moments(&poses), [0, 4].map(|step| (2, step)));
    assert!((poses[1].time_s - 0.04).abs() < 1e-12);
}

#[test]
fn a_pose_repeats_the_state_of_the_physics() {
    let mut recording = Recording::begin(&limited(9));
    recording.watched.set(true);
    recording.step(12);
    let poses = recording.recorded();
    let model = Model::from_mjcf(HUMANOID_XML).unwrap();
    let last = poses.last().unwrap();
    assert_eq!((last.episode, last.step), (2, 3));
    let physics = recording.environments.first().unwrap().environment.physics();
    assert_eq!(last.bodies.len(), 7 * model.bodies.len());
    assert_eq!(last.joint_torques_nm.len(), model.hinges.len());
    for (numbers, motion) in last.bodies.as_chunks::<7>().0.iter().zip(physics.body_motions()) {
        let position = motion.pose.translation.vector;
        assert_eq!(numbers[..3], [position.x as f32, position.y as f32, position.z as f32]);
        let rotation = motion.pose.rotation.quaternion();
        assert_eq!(numbers[3..], [rotation.w, rotation.i, rotation.j, rotation.k].map(|part| part as f32));
    }
    let narrow = |numbers: &[f64]| numbers.iter().map(|number| *number as f32).collect::<Vec<_>>();
    assert_eq!(last.joint_angles_rad, narrow(physics.joint_angles()));
    assert_eq!(last.centre_of_mass_m, narrow(physics.centre_of_mass().coords.as_slice()));
    assert_eq!((last.time_s, poses[0].distance_m), (3.0 * 0.015, 0.0));
    assert_eq!(last.reward_survive, 5.0);
    for pose in &poses {
        assert_eq!(Pose::decode_checked(&pose.to_bytes().unwrap()).as_ref(), Ok(pose));
        assert_eq!((pose.version, pose.config_hash), (Some(VERSION), 5));
    }
}

#[test]
fn a_pose_has_the_control_of_each_hinge() {
    let mut environment = Environment::new(&limited(9), HUMANOID_XML).unwrap();
    let model = environment.physics().model().clone();
    let controls: Vec<f32> = (0..model.motors.len()).map(|motor| 0.01 * motor as f32).collect();
    environment.physics_mut().set_controls(&controls).unwrap();
    let found = body_pose(&environment, None).joint_controls;
    assert_eq!(found.len(), model.hinges.len());
    assert!(model.motors.iter().zip(&controls).all(|(motor, control)| found[motor.hinge] == *control), "{found:?}");
}

#[test]
fn the_queue_of_a_long_episode_is_bounded() {
    let config = EnvironmentConfig::from(EnvConfig {
        max_episode_steps: 5000,
        terminate_when_unhealthy: false,
        ..EnvConfig::default()
    });
    let mut recording = Recording::begin(&config);
    recording.step(4999);
    recording.watched.set(true);
    recording.step(2000);
    let poses = recording.recorded();
    assert_eq!(poses.len(), 512);
    // The first one is of step 0; 30 in a second of 66.7 steps follow: 511 ÷ 0.45 is 1135.6.
    assert_eq!(poses.last().unwrap().step, 1136);
    // The queue is empty again, but the rest of this episode stays dropped.
    recording.step(100);
    assert!(recording.recorded().is_empty());
}
