//! Episodes of a saved policy, played as by `eval`: with its mean action, without randomisation; or steered.

use std::{
    ops::ControlFlow,
    thread,
    time::{Duration, Instant},
};

use treadmill_actor::{
    agent::{Agent, PolicyAgent},
    evaluation::{EvaluationStep, evaluate},
    poses,
};
use treadmill_config::{RandomisationConfig, VelocityConfig};
use treadmill_humanoid::{Environment, Model, TaskRegistry};
use treadmill_learner::checkpoint::CheckpointChoice;
use treadmill_proto::Pose;
use treadmill_rl::{
    launch::{exit_code::Usage, output::say},
    shared::saved_policy::{self, SavedPolicy},
};

use crate::steering::{KEYS, Steering};

/// Most time by which a steered robot may be late and still catch up.
const LATE_MAX: Duration = Duration::from_millis(100);

/// A policy and its environment.
pub struct Player {
    environment: Environment,
    agent: PolicyAgent,
    /// Ranges of commands.
    velocity: VelocityConfig,
}

impl Player {
    /// Loads the policy that RUN names.
    pub fn load(run: &str, which: Option<CheckpointChoice>) -> anyhow::Result<Self> {
        let SavedPolicy { policy, mut config, .. } = saved_policy::load(run, which)?;
        config.randomisation = RandomisationConfig::default();
        let environment = saved_policy::environment(&TaskRegistry::default(), run, &policy, &config)?;
        Ok(Self { environment, agent: PolicyAgent::new(&policy)?, velocity: config.velocity })
    }

    /// Returns the robot's model.
    pub fn model(&self) -> Model {
        self.environment.physics().model().clone()
    }

    /// Returns the duration of a control step (s).
    pub fn control_step_s(&self) -> f64 {
        self.environment.control_step_s()
    }

    /// Returns whether the task has commands.
    pub fn has_commands(&self) -> bool {
        self.environment.task().command().is_some()
    }

    /// Plays in real time under the commands of the keyboard, until the key that ends or `show` returns false. A new
    /// episode begins where one ends.
    pub fn steer(
        &mut self,
        seed: u64,
        speed: f64,
        mut show: impl FnMut(&Pose) -> anyhow::Result<bool>,
    ) -> anyhow::Result<()> {
        if !self.has_commands() {
            let why =
                "--steer: this policy's task has no commands; steer one of a robot with a card, as of --preset g1";
            return Err(Usage(why.to_owned()).into());
        }
        say(KEYS);
        let mut steering = Steering::begin(&self.velocity)?;
        let mut observation = vec![0.0; self.environment.observation_size()];
        let mut action = vec![0.0; self.environment.action_size()];
        let mut control = action.clone();
        let step_s = self.control_step_s();
        let (mut due, step_duration) = (Instant::now(), Duration::from_secs_f64(step_s / speed));
        for episode in 1.. {
            self.environment.steer(Some([0.0; 3]));
            self.environment.reset(seed.wrapping_add(episode), &mut observation);
            let start_x_m = self.environment.physics().position()[0];
            for step in 1.. {
                let Some(command) = steering.command() else { return Ok(()) };
                self.environment.steer(Some(command));
                self.environment.observe(&mut observation)?;
                self.agent.act(&observation, &mut action)?;
                self.environment.action_from_shares(&action, &mut control);
                let outcome = self.environment.step(&control, &mut observation);
                let physics = self.environment.physics();
                steering.show(poses::heading_velocity(physics));
                let pose = Pose {
                    episode,
                    step,
                    time_s: f64::from(step) * step_s,
                    distance_m: (physics.position()[0] - start_x_m) as f32,
                    ..poses::body_pose(&self.environment, Some(command))
                };
                if !show(&pose)? {
                    return Ok(());
                }
                due += step_duration;
                // After a stall it goes on from now: lost time played fast could not be steered.
                due = due.max(Instant::now().checked_sub(LATE_MAX).unwrap_or(due));
                thread::sleep(due.saturating_duration_since(Instant::now()));
                if outcome.terminated || outcome.truncated {
                    break;
                }
            }
        }
        Ok(())
    }

    /// Plays episodes and passes the pose of each step to `show`, until it returns false or an error.
    pub fn play(
        &mut self,
        episodes: u32,
        seed: u64,
        mut show: impl FnMut(&Pose) -> anyhow::Result<bool>,
    ) -> anyhow::Result<()> {
        let (mut start_x_m, control_step_s) = (0.0, self.control_step_s());
        let mut shown = Ok(true);
        evaluate(&mut self.environment, &mut self.agent, episodes, seed, |step| {
            if step.step == 1 {
                start_x_m = step.environment.physics().position()[0];
            }
            shown = show(&pose(&step, start_x_m, control_step_s));
            if matches!(shown, Ok(true)) { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        })?;
        shown.map(drop)
    }
}

fn pose(step: &EvaluationStep, start_x_m: f64, control_step_s: f64) -> Pose {
    Pose {
        episode: step.episode.into(),
        step: step.step,
        time_s: f64::from(step.step) * control_step_s,
        distance_m: (step.environment.physics().position()[0] - start_x_m) as f32,
        ..poses::body_pose(step.environment, step.start.command)
    }
}
