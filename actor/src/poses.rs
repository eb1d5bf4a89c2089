//! Poses for observers: whole episodes of an actor's first environment, in real time.
//!
//! Simulation is faster than real time. The sampler records an episode from its start, [`publish`] sends it pose by pose in
//! real time, and the sampler then records the next episode that begins. Without observers, a step costs one read of a flag.

use std::time::Duration;

use tokio::{sync::mpsc, time::MissedTickBehavior};
use treadmill_bus::actor::{PosePublisher, Watched};
use treadmill_humanoid::{Environment, Physics, StepInfo, physics::BodyMotion, task::velocity::BaseMotion};
use treadmill_proto::{PolicyVersion, Pose, pose::BODY_NUMBERS};

use crate::{environments::Environments, identity::ActorIdentity};

/// Most poses per second.
const RATE_HZ: f64 = 30.0;
/// Bound of the queue: an episode of 15 s. Of a longer one, only the beginning is shown.
const QUEUED_POSES_MAX: usize = 512;

/// Whether the pose after this many control steps is shown: 30 of those of a second, or all if there are fewer. Where a
/// second's steps are no multiple of 30, the steps between two poses alternate.
#[must_use]
pub fn is_shown(step: u32, control_step_s: f64) -> bool {
    // A step that ends an interval may be rounded to either side.
    let intervals = |step: u32| (f64::from(step) * control_step_s * RATE_HZ + 1e-6).floor();
    step == 0 || intervals(step) > intervals(step - 1)
}

/// Records poses of the first environment, on the physics thread.
pub struct PoseSampler {
    watched: Watched,
    queue: mpsc::Sender<Pose>,
    identity: ActorIdentity,
    /// Episode that is being recorded.
    episode: Option<u64>,
}

impl PoseSampler {
    /// Creates a sampler and the queue of its poses.
    #[must_use]
    pub fn new(watched: Watched, identity: ActorIdentity) -> (Self, mpsc::Receiver<Pose>) {
        let (queue, poses) = mpsc::channel(QUEUED_POSES_MAX);
        (Self { watched, queue, identity, episode: None }, poses)
    }

    /// Records the pose after a step, if one is due.
    pub fn sample(&mut self, environments: &Environments, version: PolicyVersion) {
        if !self.watched.now() {
            self.episode = None;
            return;
        }
        let Some(first) = environments.first() else { return };
        if self.episode != Some(first.episode) {
            let is_queue_empty = self.queue.capacity() == self.queue.max_capacity();
            self.episode = (first.step == 0 && is_queue_empty).then_some(first.episode);
        }
        if self.episode.is_none() || !is_shown(first.step, first.environment.control_step_s()) {
            return;
        }
        let physics = first.environment.physics();
        let pose = Pose {
            run: self.identity.run.clone(),
            actor: self.identity.actor.clone(),
            actor_incarnation: self.identity.incarnation,
            version: Some(version),
            config_hash: self.identity.config_hash,
            episode: first.episode,
            step: first.step,
            time_s: f64::from(first.step) * first.environment.control_step_s(),
            distance_m: (physics.position()[0] - first.start_x_m) as f32,
            ..body_pose(first.environment, first.environment.task().command())
        };
        // The queue is full, or its receiver is gone: drop the rest of the episode.
        if self.queue.try_send(pose).is_err() {
            self.episode = None;
        }
    }
}

/// Publishes recorded poses in real time.
pub async fn publish(mut poses: mpsc::Receiver<Pose>, publisher: PosePublisher, control_step_s: f64) {
    let watched = publisher.watched();
    let mut due = tokio::time::interval(Duration::from_secs_f64(control_step_s.max(1.0 / RATE_HZ)));
    due.set_missed_tick_behavior(MissedTickBehavior::Delay);
    while let Some(pose) = poses.recv().await {
        // Without observers the queue is drained, so that the next observer does not get old poses.
        if !watched.now() {
            continue;
        }
        due.tick().await;
        match pose.to_bytes() {
            Ok(bytes) => publisher.publish(bytes),
            Err(error) => tracing::debug!(%error, "pose not published"),
        }
    }
}

/// Returns position, motion and reward terms of a body with this command. The caller adds names, numbers and times.
#[must_use]
pub fn body_pose(environment: &Environment, command: Option<[f64; 3]>) -> Pose {
    let physics = environment.physics();
    // The message has Gymnasium's terms of the reward; of another task, the second one holds the whole reward.
    let mut reward = 0.0;
    environment.task().reward_terms(&mut |_, term| reward += term);
    let x_velocity_mps = physics.centre_of_mass_velocity().x;
    let other = StepInfo { reward_forward: reward, x_velocity_mps, ..StepInfo::default() };
    let info = environment.info().copied().unwrap_or(other);
    let narrow = |numbers: [f64; 3]| numbers.map(|number| number as f32).to_vec();
    let all = |numbers: &[f64]| numbers.iter().map(|number| *number as f32).collect();
    Pose {
        command: command.map(narrow).unwrap_or_default(),
        base_velocity: command.map(|_| narrow(heading_velocity(physics))).unwrap_or_default(),
        bodies: bodies(physics),
        contacts: contacts(physics),
        joint_torques_nm: all(physics.joint_torques_nm()),
        joint_angles_rad: all(physics.joint_angles()),
        joint_controls: joint_controls(physics),
        centre_of_mass_m: narrow(physics.centre_of_mass().coords.into()),
        reward_survive: info.reward_survive as f32,
        reward_forward: info.reward_forward as f32,
        reward_ctrl: info.reward_ctrl as f32,
        reward_contact: info.reward_contact as f32,
        velocity_mps: info.x_velocity_mps as f32,
        ..Pose::default()
    }
}

/// Returns the velocity of the base in its heading frame: forward and left (m/s), yaw rate (rad/s).
#[must_use]
pub fn heading_velocity(physics: &Physics) -> [f64; 3] {
    let base = BaseMotion::new(physics.position(), physics.velocity(), 0.0);
    [base.velocity_mps.x, base.velocity_mps.y, base.yaw_rate_radps]
}

/// Returns the target of each hinge's servo (rad), or the control of its motor: of several motors the first one's, without
/// any 0.
fn joint_controls(physics: &Physics) -> Vec<f32> {
    let model = physics.model();
    let mut controls = vec![0.0; model.hinges.len()];
    for (motor, &control) in model.motors.iter().zip(physics.controls()).rev() {
        controls[motor.hinge] = motor.target_rad(f64::from(control)).map_or(control, |target_rad| target_rad as f32);
    }
    controls
}

/// Returns position (m) and quaternion w, x, y, z of each body.
#[must_use]
pub fn bodies(physics: &Physics) -> Vec<f32> {
    physics.body_motions().flat_map(|motion| body_numbers(&motion)).collect()
}

fn body_numbers(motion: &BodyMotion) -> [f32; BODY_NUMBERS] {
    let (position, rotation) = (motion.pose.translation.vector, motion.pose.rotation.quaternion());
    [position.x, position.y, position.z, rotation.w, rotation.i, rotation.j, rotation.k].map(|number| number as f32)
}

fn contacts(physics: &Physics) -> Vec<f32> {
    let points = physics.contact_points();
    points
        .flat_map(|point| {
            // The force acts on the first body; if that is the floor, report the force on the second.
            let sign = if point.links[0].is_none() { -1.0 } else { 1.0 };
            let force_n = point.force_n * sign;
            [point.at_m.x, point.at_m.y, point.at_m.z, force_n.x, force_n.y, force_n.z].map(|number| number as f32)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thirty_poses_of_a_second_are_shown_or_all_of_fewer() {
        for (step_s, expected) in [(0.001, 30), (0.005, 30), (0.01, 30), (0.015, 30), (0.02, 30), (0.04, 25), (0.1, 10)]
        {
            let steps = (10.0_f64 / step_s).round() as u32;
            let shown = (1..=steps).filter(|step| is_shown(*step, step_s)).count();
            assert_eq!(shown, 10 * expected, "{step_s}");
        }
        let shown: Vec<u32> = (1..=10).filter(|step| is_shown(*step, 0.02)).collect();
        assert_eq!(shown, [2, 4, 5, 7, 9, 10]);
    }
}
