//! Episodes of a saved policy, played as by `eval`: with its mean action, without randomisation.

use std::ops::ControlFlow;

use treadmill_actor::{
    agent::PolicyAgent,
    evaluation::{EvaluationStep, evaluate},
    poses,
};
use treadmill_config::RandomisationConfig;
use treadmill_humanoid::{Environment, Model};
use treadmill_learner::checkpoint::Which;
use treadmill_proto::Pose;
use treadmill_rl::shared::saved_policy;

/// A policy and its environment.
pub struct Player {
    environment: Environment,
    agent: PolicyAgent,
}

impl Player {
    /// Loads the policy that RUN names.
    pub fn load(run: &str, which: Option<Which>) -> anyhow::Result<Self> {
        let policy = saved_policy::load(run, which)?.policy;
        let mut config = policy.config();
        config.randomisation = RandomisationConfig::default();
        let environment = saved_policy::environment(run, &policy, &config)?;
        Ok(Self { environment, agent: PolicyAgent::new(&policy)? })
    }

    /// Returns the robot's model.
    pub fn model(&self) -> Model {
        self.environment.physics().model().clone()
    }

    /// Returns the duration of a control step (s).
    pub fn control_step_s(&self) -> f64 {
        self.environment.control_step_s()
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
                start_x_m = step.physics.position()[0];
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
        distance_m: (step.physics.position()[0] - start_x_m) as f32,
        ..poses::body_pose(step.physics, step.info)
    }
}
