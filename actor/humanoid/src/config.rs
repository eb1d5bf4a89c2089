//! What can be set about the environment, with the figures of Humanoid-v5 as defaults.

use crate::error::ModelError;
use crate::randomisation::Randomisation;

/// Duration of one control step (s): one action, one observation, one reward.
pub const CONTROL_STEP_S: f64 = 0.015;

/// Settings of one humanoid environment: task weights and limits, and how finely physics is stepped.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentConfig {
    /// Reward per m/s of forward speed of the centre of mass.
    pub forward_reward_weight: f64,
    /// Cost per unit of the sum of squared controls.
    pub ctrl_cost_weight: f64,
    /// Cost per unit of the sum of squared contact forces (N²) and moments ((N·m)²).
    pub contact_cost_weight: f64,
    /// The contact cost of a step is never larger than this.
    pub contact_cost_max: f64,
    /// Reward of each step that ends with a healthy posture.
    pub healthy_reward: f64,
    /// Whether leaving the healthy range ends the episode.
    pub terminate_when_unhealthy: bool,
    /// A torso at or below this height (m) is unhealthy.
    pub healthy_z_min_m: f64,
    /// A torso at or above this height (m) is unhealthy.
    pub healthy_z_max_m: f64,
    /// Every position and velocity starts within ± this of its nominal value (m, rad, m/s, rad/s).
    pub reset_noise_scale: f64,
    /// An episode is truncated after this many control steps; 0 means never.
    pub max_episode_steps: u32,
    /// Physics steps per control step, at least 1.
    pub substeps: u32,
    /// Iterations of Rapier's constraint solver per physics step, at least 1; its result is then refined in joint coordinates.
    pub solver_iterations: u32,
    /// Whether parts of the body that are not neighbours collide with each other.
    pub self_collision: bool,
    /// What differs from episode to episode beside the start; nothing by default.
    pub randomisation: Randomisation,
}

impl Default for EnvironmentConfig {
    fn default() -> Self {
        Self {
            forward_reward_weight: 1.25,
            ctrl_cost_weight: 0.1,
            contact_cost_weight: 5e-7,
            contact_cost_max: 10.0,
            healthy_reward: 5.0,
            terminate_when_unhealthy: true,
            healthy_z_min_m: 1.0,
            healthy_z_max_m: 2.0,
            reset_noise_scale: 0.01,
            max_episode_steps: 1000,
            substeps: 2,
            solver_iterations: 2,
            self_collision: true,
            randomisation: Randomisation::default(),
        }
    }
}

/// More physics steps or solver passes than this are a slip of the pen.
const REPEATS_MAX: u32 = 1000;

impl EnvironmentConfig {
    /// Refuses settings that cannot be simulated or make no sense as a task.
    pub(crate) fn check(&self) -> Result<(), ModelError> {
        let refuse = |setting, value, expected| Err(ModelError::Setting { setting, value, expected });
        for (setting, value) in [("substeps", self.substeps), ("solver_iterations", self.solver_iterations)] {
            if !(1..=REPEATS_MAX).contains(&value) {
                return refuse(setting, f64::from(value), "between 1 and 1000");
            }
        }
        for (setting, value) in [
            ("forward_reward_weight", self.forward_reward_weight),
            ("ctrl_cost_weight", self.ctrl_cost_weight),
            ("contact_cost_weight", self.contact_cost_weight),
            ("healthy_reward", self.healthy_reward),
            ("healthy_z_max_m", self.healthy_z_max_m),
        ] {
            if !value.is_finite() {
                return refuse(setting, value, "finite");
            }
        }
        if self.contact_cost_max.is_nan() || self.contact_cost_max < 0.0 {
            return refuse("contact_cost_max", self.contact_cost_max, "not negative");
        }
        if self.healthy_z_min_m.is_nan() || self.healthy_z_min_m >= self.healthy_z_max_m {
            return refuse("healthy_z_min_m", self.healthy_z_min_m, "below healthy_z_max_m");
        }
        if !(0.0..=1.0).contains(&self.reset_noise_scale) {
            return refuse("reset_noise_scale", self.reset_noise_scale, "between 0 and 1");
        }
        self.randomisation.check()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_are_accepted_and_each_nonsense_is_named() {
        assert!(EnvironmentConfig::default().check().is_ok());
        type Spoil = fn(&mut EnvironmentConfig);
        let broken: [(&str, Spoil); 6] = [
            ("substeps", |c| c.substeps = 0),
            ("solver_iterations", |c| c.solver_iterations = 0),
            ("healthy_reward", |c| c.healthy_reward = f64::NAN),
            ("healthy_z_min_m", |c| c.healthy_z_min_m = 2.0),
            ("contact_cost_max", |c| c.contact_cost_max = -1.0),
            ("reset_noise_scale", |c| c.reset_noise_scale = -0.01),
        ];
        for (name, spoil) in broken {
            let mut config = EnvironmentConfig::default();
            spoil(&mut config);
            let error = config.check().expect_err(name).to_string();
            assert!(error.contains(name), "{error}");
        }
    }
}
