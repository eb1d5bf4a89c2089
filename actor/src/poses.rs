//! What those who watch see of an actor: whole episodes of its first environment, at the pace of the clock.
//!
//! Simulation is faster than the clock. So an episode is recorded from its start, told pose by pose as fast as it would
//! happen, and then the next one that begins is recorded. While nobody watches, a step costs one look at a flag.

use std::time::Duration;

use tokio::{sync::mpsc, time::MissedTickBehavior};
use treadmill_bus::{PosePublisher, Watched};
use treadmill_humanoid::{CONTROL_STEP_S, Physics, StepInfo, physics::BodyMotion};
use treadmill_proto::{PolicyVersion, Pose, pose::BODY_NUMBERS};

use crate::{environments::Environments, rollout::Sender};

/// Control steps from one pose to the next: 33 poses a second, where watchers are promised 60 at most.
pub const STRIDE: u32 = 2;
/// Poses that wait to be told: an episode of 1000 control steps. A longer one is shown for so long.
const TAPE_POSES: usize = 512;

/// Records the first environment, on the physics thread.
pub struct Camera {
    watched: Watched,
    tape: mpsc::Sender<Pose>,
    sender: Sender,
    /// The episode that is being recorded.
    episode: Option<u64>,
}

/// What a camera recorded, on its way to those who watch.
pub type Tape = mpsc::Receiver<Pose>;

impl Camera {
    /// A camera, and what it records.
    #[must_use]
    pub fn new(watched: Watched, sender: Sender) -> (Self, Tape) {
        let (tape, recorded) = mpsc::channel(TAPE_POSES);
        (Self { watched, tape, sender, episode: None }, recorded)
    }

    /// Looks after a step.
    pub fn see(&mut self, environments: &Environments, version: PolicyVersion) {
        if !self.watched.now() {
            self.episode = None;
            return;
        }
        let Some(first) = environments.first() else { return };
        if self.episode != Some(first.episode) {
            let is_told = self.tape.capacity() == self.tape.max_capacity();
            self.episode = (first.step == 0 && is_told).then_some(first.episode);
        }
        if self.episode.is_none() || !first.step.is_multiple_of(STRIDE) {
            return;
        }
        let physics = first.environment.physics();
        let pose = Pose {
            run: self.sender.run.clone(),
            actor: self.sender.actor.clone(),
            actor_incarnation: self.sender.incarnation,
            version: Some(version.into()),
            config_hash: self.sender.config_hash,
            episode: first.episode,
            step: first.step,
            time_s: f64::from(first.step) * CONTROL_STEP_S,
            distance_m: (physics.position()[0] - first.start_x_m) as f32,
            ..of(physics, first.environment.info())
        };
        // An episode that is longer than the tape is left, and so is one that nobody is there any more to be told of.
        if self.tape.try_send(pose).is_err() {
            self.episode = None;
        }
    }
}

/// Tells what a camera records, each pose when its time has come.
pub async fn tell(mut tape: Tape, publisher: PosePublisher) {
    let watched = publisher.watched();
    let mut due = tokio::time::interval(Duration::from_secs_f64(f64::from(STRIDE) * CONTROL_STEP_S));
    due.set_missed_tick_behavior(MissedTickBehavior::Delay);
    while let Some(pose) = tape.recv().await {
        // Whoever comes next shall not see the rest of what others have left.
        if !watched.now() {
            continue;
        }
        due.tick().await;
        match pose.to_bytes() {
            Ok(bytes) => publisher.publish(bytes),
            Err(why) => tracing::debug!("a pose cannot be told: {why}"),
        }
    }
}

/// How a body stands and moves, and what its last step was rewarded with. Names, numbers and times are the caller's to add.
#[must_use]
pub fn of(physics: &Physics, info: &StepInfo) -> Pose {
    Pose {
        bodies: physics.body_motions().iter().flat_map(place).collect(),
        contacts: contacts(physics),
        joint_torques_nm: physics.joint_torques_nm().iter().map(|torque| *torque as f32).collect(),
        reward_survive: info.reward_survive as f32,
        reward_forward: info.reward_forward as f32,
        reward_ctrl: info.reward_ctrl as f32,
        reward_contact: info.reward_contact as f32,
        velocity_mps: info.x_velocity_mps as f32,
        ..Pose::default()
    }
}

fn place(motion: &BodyMotion) -> [f32; BODY_NUMBERS] {
    let (at, turned) = (motion.pose.translation.vector, motion.pose.rotation.quaternion());
    [at.x, at.y, at.z, turned.w, turned.i, turned.j, turned.k].map(|number| number as f32)
}

fn contacts(physics: &Physics) -> Vec<f32> {
    let points = physics.contact_points();
    points
        .flat_map(|point| {
            // The floor feels nothing.
            let sign = if point.links[0].is_none() { -1.0 } else { 1.0 };
            let force_n = point.force_n * sign;
            [point.at_m.x, point.at_m.y, point.at_m.z, force_n.x, force_n.y, force_n.z].map(|number| number as f32)
        })
        .collect()
}
