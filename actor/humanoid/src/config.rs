//! What can be set about the environment, with the figures of Humanoid-v5 as defaults.
//!
//! Weights, ranges and flags carry the names of the arguments of Gymnasium's environments.

use crate::error::ModelError;
use crate::randomisation::Randomisation;

/// Duration of one control step (s): one action, one observation, one reward.
pub const CONTROL_STEP_S: f64 = 0.015;

/// Whose rewards and info: see [`crate::task`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Task {
    /// Gymnasium's Humanoid-v5.
    #[default]
    HumanoidV5,
    /// Gymnasium's Humanoid-v4: no cost of contact, and the reward for health also on the step that ends an episode.
    HumanoidV4,
}

/// Which numbers the policy sees: see [`crate::observation`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ObservationKind {
    /// Positions and velocities only.
    #[default]
    Compact,
    /// As Gymnasium's Humanoid-v5.
    GymnasiumV5,
    /// As Gymnasium's Humanoid-v4.
    GymnasiumV4,
}

/// Settings of one humanoid environment: task, weights and limits, observation, and how finely physics is stepped.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentConfig {
    /// Whose rewards and info.
    pub task: Task,
    /// Reward per m/s of forward speed of the centre of mass.
    pub forward_reward_weight: f64,
    /// Cost per unit of the sum of squared controls.
    pub ctrl_cost_weight: f64,
    /// Cost per unit of the sum of squared contact forces (N²) and moments ((N·m)²). Humanoid-v4 has no such cost.
    pub contact_cost_weight: f64,
    /// The contact cost of a step is brought into this range, lowest and highest; −∞ and ∞ are allowed.
    pub contact_cost_range: [f64; 2],
    /// Reward of each step that ends with a healthy posture.
    pub healthy_reward: f64,
    /// Whether leaving the healthy range ends the episode.
    pub terminate_when_unhealthy: bool,
    /// A torso is healthy while its height (m) lies strictly between these two.
    pub healthy_z_range: [f64; 2],
    /// Every position and velocity starts within ± this of its nominal value (m, rad, m/s, rad/s).
    pub reset_noise_scale: f64,
    /// Which numbers the policy sees.
    pub observation: ObservationKind,
    /// Whether the observation leaves out x and y of the torso.
    pub exclude_current_positions_from_observation: bool,
    /// Whether [`ObservationKind::GymnasiumV5`] has the links' inertias.
    pub include_cinert_in_observation: bool,
    /// Whether [`ObservationKind::GymnasiumV5`] has the links' velocities.
    pub include_cvel_in_observation: bool,
    /// Whether [`ObservationKind::GymnasiumV5`] has the motors' torques.
    pub include_qfrc_actuator_in_observation: bool,
    /// Whether [`ObservationKind::GymnasiumV5`] has the contact forces.
    pub include_cfrc_ext_in_observation: bool,
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
            task: Task::HumanoidV5,
            forward_reward_weight: 1.25,
            ctrl_cost_weight: 0.1,
            contact_cost_weight: 5e-7,
            contact_cost_range: [f64::NEG_INFINITY, 10.0],
            healthy_reward: 5.0,
            terminate_when_unhealthy: true,
            healthy_z_range: [1.0, 2.0],
            reset_noise_scale: 0.01,
            observation: ObservationKind::Compact,
            exclude_current_positions_from_observation: true,
            include_cinert_in_observation: true,
            include_cvel_in_observation: true,
            include_qfrc_actuator_in_observation: true,
            include_cfrc_ext_in_observation: true,
            max_episode_steps: 1000,
            substeps: 2,
            solver_iterations: 1,
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
        let refuse = |setting, value: &dyn std::fmt::Debug, expected| {
            Err(ModelError::Setting { setting, value: format!("{value:?}"), expected })
        };
        for (setting, value) in [("substeps", self.substeps), ("solver_iterations", self.solver_iterations)] {
            if !(1..=REPEATS_MAX).contains(&value) {
                return refuse(setting, &value, "between 1 and 1000");
            }
        }
        for (setting, value) in [
            ("forward_reward_weight", self.forward_reward_weight),
            ("ctrl_cost_weight", self.ctrl_cost_weight),
            ("contact_cost_weight", self.contact_cost_weight),
            ("healthy_reward", self.healthy_reward),
        ] {
            if !value.is_finite() {
                return refuse(setting, &value, "finite");
            }
        }
        // A cost that is infinite whatever happens would make every reward so.
        let [low, high] = self.contact_cost_range;
        if low.is_nan() || high.is_nan() || low > high || low == f64::INFINITY || high == f64::NEG_INFINITY {
            return refuse(
                "contact_cost_range",
                &self.contact_cost_range,
                "[lowest, highest], the first below ∞ and not above the second, the second above −∞",
            );
        }
        let [low, high] = self.healthy_z_range;
        if low.is_nan() || high.is_nan() || low >= high {
            return refuse("healthy_z_range", &self.healthy_z_range, "[lowest, highest], the first below the second");
        }
        if !(0.0..=1.0).contains(&self.reset_noise_scale) {
            return refuse("reset_noise_scale", &self.reset_noise_scale, "between 0 and 1");
        }
        if self.observation == ObservationKind::GymnasiumV4 {
            for (setting, included) in self.inclusions() {
                if !included {
                    return refuse(setting, &false, "true, since Humanoid-v4's observation leaves nothing out");
                }
            }
        }
        self.randomisation.check()
    }

    /// The first setting that is not the same in another configuration: its name, its value here and its value there.
    pub(crate) fn difference(&self, other: &Self) -> Option<(&'static str, String, String)> {
        // Naming all fields makes the compiler ask for new ones here.
        macro_rules! compare {
            ($($field:ident),* $(,)?) => {{
                let Self { $($field),* } = self;
                $(if *$field != other.$field {
                    return Some((stringify!($field), format!("{:?}", $field), format!("{:?}", other.$field)));
                })*
                None
            }};
        }
        compare!(
            task,
            forward_reward_weight,
            ctrl_cost_weight,
            contact_cost_weight,
            contact_cost_range,
            healthy_reward,
            terminate_when_unhealthy,
            healthy_z_range,
            reset_noise_scale,
            observation,
            exclude_current_positions_from_observation,
            include_cinert_in_observation,
            include_cvel_in_observation,
            include_qfrc_actuator_in_observation,
            include_cfrc_ext_in_observation,
            max_episode_steps,
            substeps,
            solver_iterations,
            self_collision,
            randomisation,
        )
    }

    /// The flags of the blocks that can be left out.
    fn inclusions(&self) -> [(&'static str, bool); 4] {
        [
            ("include_cinert_in_observation", self.include_cinert_in_observation),
            ("include_cvel_in_observation", self.include_cvel_in_observation),
            ("include_qfrc_actuator_in_observation", self.include_qfrc_actuator_in_observation),
            ("include_cfrc_ext_in_observation", self.include_cfrc_ext_in_observation),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_are_accepted_and_each_nonsense_is_named() {
        assert!(EnvironmentConfig::default().check().is_ok());
        type Spoil = fn(&mut EnvironmentConfig);
        let broken: [(&str, Spoil); 11] = [
            ("substeps", |c| c.substeps = 0),
            ("solver_iterations", |c| c.solver_iterations = 0),
            ("healthy_reward", |c| c.healthy_reward = f64::NAN),
            ("healthy_z_range", |c| c.healthy_z_range = [2.0, 2.0]),
            ("healthy_z_range", |c| c.healthy_z_range = [f64::NAN, 2.0]),
            ("contact_cost_range", |c| c.contact_cost_range = [1.0, 0.5]),
            ("contact_cost_range", |c| c.contact_cost_range = [0.0, f64::NAN]),
            ("contact_cost_range", |c| c.contact_cost_range = [f64::NEG_INFINITY; 2]),
            ("contact_cost_range", |c| c.contact_cost_range = [f64::INFINITY; 2]),
            ("reset_noise_scale", |c| c.reset_noise_scale = -0.01),
            ("include_cvel_in_observation", |c| {
                c.observation = ObservationKind::GymnasiumV4;
                c.include_cvel_in_observation = false;
            }),
        ];
        for (name, spoil) in broken {
            let mut config = EnvironmentConfig::default();
            spoil(&mut config);
            let error = config.check().expect_err(name).to_string();
            assert!(error.contains(name), "{error}");
        }
    }

    #[test]
    fn ranges_may_be_open() {
        let open = [f64::NEG_INFINITY, f64::INFINITY];
        let config =
            EnvironmentConfig { contact_cost_range: open, healthy_z_range: open, ..EnvironmentConfig::default() };
        assert!(config.check().is_ok());
    }
}
