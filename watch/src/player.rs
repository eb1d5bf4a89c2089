//! A saved policy that plays episodes here, as `eval` does: by its mean action, without randomisation.

use treadmill_actor::{
    agent::PolicyAgent,
    evaluation::{EvaluationStep, evaluate},
    poses,
};
use treadmill_config::RandomisationConfig;
use treadmill_humanoid::{CONTROL_STEP_S, Environment, Model};
use treadmill_learner::checkpoint::Which;
use treadmill_proto::Pose;
use treadmill_rl::shared::saved_policy;

/// A policy and its environment.
pub struct Player {
    environment: Environment,
    agent: PolicyAgent,
}

impl Player {
    /// What RUN names.
    pub fn load(run: &str, which: Option<Which>) -> anyhow::Result<Self> {
        let policy = saved_policy::load(run, which.unwrap_or(Which::BestOrLatest))?;
        let mut config = saved_policy::trained_under(&policy);
        config.randomisation = RandomisationConfig::default();
        let environment = saved_policy::environment(run, &policy, &config)?;
        Ok(Self { environment, agent: PolicyAgent::new(&policy)? })
    }

    /// The robot.
    pub fn model(&self) -> Model {
        self.environment.physics().model().clone()
    }

    /// Plays, and hands every step to `show`, until that wants no more.
    pub fn play(
        &mut self,
        episodes: u32,
        seed: u64,
        mut show: impl FnMut(&Pose) -> anyhow::Result<bool>,
    ) -> anyhow::Result<()> {
        let mut start_x_m = 0.0;
        // One after the other, so that it can end in between: seeds depend on an episode's number alone.
        let mut shown = Ok(true);
        evaluate(&mut self.environment, &mut self.agent, episodes, seed, |told| {
            if told.step == 1 {
                start_x_m = told.physics.position()[0];
            }
            if matches!(shown, Ok(true)) {
                shown = show(&pose(&told, start_x_m));
            }
        })?;
        shown.map(drop)
    }
}

fn pose(told: &EvaluationStep, start_x_m: f64) -> Pose {
    Pose {
        episode: told.episode.into(),
        step: told.step,
        time_s: f64::from(told.step) * CONTROL_STEP_S,
        distance_m: (told.physics.position()[0] - start_x_m) as f32,
        ..poses::body_pose(told.physics, told.info)
    }
}
