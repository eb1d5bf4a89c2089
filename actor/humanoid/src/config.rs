//! Settings of the environment, its physics and its randomisation; defaults are those of Humanoid-v5.
//!
//! Weights, ranges and flags carry the names of the arguments of Gymnasium's environments.

mod ground;
mod velocity;

use std::{fmt::Debug, ops::RangeInclusive};

use crate::error::ModelError;

pub use self::ground::{GroundKind, GroundSettings, StartLevel};
pub use self::velocity::{HISTORY_MAX, VelocityConfig, VelocityRewards};

/// Accepted durations of a control step (s).
const CONTROL_STEPS_S: RangeInclusive<f64> = 0.001..=0.1;

/// Version of the simulation. Raised whenever the same state, action and settings give another next state, observation,
/// reward or end of an episode. `tests/environment/physics_version.rs` holds it to that.
pub const PHYSICS_VERSION: u32 = 6;

/// How far outside its range a hinge may be set (rad). In the nominal pose of Humanoid-v5 the knees are 2° beyond the end
/// of their range, and limits are soft.
pub const HINGE_TOLERANCE_RAD: f64 = 0.1;

/// Gymnasium task that determines rewards and info.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RewardTask {
    /// Humanoid-v5.
    #[default]
    HumanoidV5,
    /// Humanoid-v4: no contact cost, and the reward for health also on the step that ends an episode.
    HumanoidV4,
}

/// Selection of numbers that the policy observes.
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

/// Settings of one humanoid environment: task, weights and limits, observation, physics and randomisation.
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentConfig {
    /// Task that determines rewards and info.
    pub task: RewardTask,
    /// Name of a task that the program defines itself, which replaces `task`; empty means none. See
    /// [`crate::task::register_own_tasks`].
    pub own_task: String,
    /// Reward per m/s of forward speed of the centre of mass.
    pub forward_reward_weight: f64,
    /// Cost per unit of the sum of squared entries of the action; see [`crate::task::control_cost`].
    pub ctrl_cost_weight: f64,
    /// Cost per unit of the sum of squared contact forces (N²) and moments ((N·m)²). Humanoid-v4 has no such cost.
    pub contact_cost_weight: f64,
    /// Lower and upper bound to which a step's contact cost is clamped; −∞ and ∞ are allowed.
    pub contact_cost_range: [f64; 2],
    /// Reward of each step that ends with a healthy posture.
    pub healthy_reward: f64,
    /// Whether leaving the healthy range ends the episode.
    pub terminate_when_unhealthy: bool,
    /// Healthy torso heights (m) lie strictly between these two.
    pub healthy_z_range: [f64; 2],
    /// Every position and velocity starts within ± this of its nominal value (m, rad, m/s, rad/s).
    pub reset_noise_scale: f64,
    /// Selection of numbers that the policy observes.
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
    /// Name of the model's keyframe at which episodes start; empty means the nominal pose.
    pub keyframe: String,
    /// See [`PhysicsSettings::control_step_s`].
    pub control_step_s: f64,
    /// See [`PhysicsSettings::substeps`].
    pub substeps: u32,
    /// See [`PhysicsSettings::self_collision`].
    pub self_collision: bool,
    /// Settings of the velocity task, which replaces `task`; see [`crate::task::velocity`].
    pub velocity: Option<VelocityConfig>,
    /// Ground that replaces the model's; by default none.
    pub ground: GroundSettings,
    /// Randomisation of each episode; off by default.
    pub randomisation: Randomisation,
}

impl Default for EnvironmentConfig {
    fn default() -> Self {
        let PhysicsSettings { control_step_s, substeps, self_collision } = PhysicsSettings::default();
        Self {
            task: RewardTask::HumanoidV5,
            own_task: String::new(),
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
            keyframe: String::new(),
            control_step_s,
            substeps,
            self_collision,
            velocity: None,
            ground: GroundSettings::default(),
            randomisation: Randomisation::default(),
        }
    }
}

/// Settings that the motion depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhysicsSettings {
    /// Duration of one control step (s), 0.001 to 0.1: one action, one observation, one reward.
    pub control_step_s: f64,
    /// Physics steps per control step, 1 to 1000.
    pub substeps: u32,
    /// Whether bodies that are not neighbours in the tree collide with each other.
    pub self_collision: bool,
}

impl Default for PhysicsSettings {
    fn default() -> Self {
        Self { control_step_s: 0.015, substeps: 4, self_collision: true }
    }
}

impl From<&EnvironmentConfig> for PhysicsSettings {
    fn from(config: &EnvironmentConfig) -> Self {
        let EnvironmentConfig { control_step_s, substeps, self_collision, .. } = *config;
        Self { control_step_s, substeps, self_collision }
    }
}

/// Randomisation of each episode: `[smallest, largest]` of uniform distributions, and noise. Off by default.
#[derive(Clone, Debug, PartialEq)]
pub struct Randomisation {
    /// Factor on the mass and inertia of each body.
    pub mass_scale: [f64; 2],
    /// Factor on the friction coefficient of the floor.
    pub floor_friction_scale: [f64; 2],
    /// Factor on the torque of each motor.
    pub motor_scale: [f64; 2],
    /// Factor on the stiffness of each servo.
    pub kp_scale: [f64; 2],
    /// Factor on the damping of each servo.
    pub kd_scale: [f64; 2],
    /// Largest offset of the root body's centre of mass along each of its axes (m).
    pub com_offset_m: f64,
    /// Factor on the viscous friction of each hinge.
    pub damping_scale: [f64; 2],
    /// Factor on the rotor inertia of each hinge.
    pub armature_scale: [f64; 2],
    /// Factor on gravity.
    pub gravity_scale: [f64; 2],
    /// Standard deviation of the noise on observed height (m), orientation (rad about each axis) and hinge angles (rad). All
    /// other blocks of an observation are computed from the noisy state.
    pub sensor_noise_position: f64,
    /// Standard deviation of the noise on observed velocities (m/s, rad/s).
    pub sensor_noise_velocity: f64,
    /// Largest constant error of each encoder in an episode (rad); only the velocity task observes with it.
    pub encoder_bias_rad: f64,
    /// Standard deviation of the noise on each control, as a share of the largest control.
    pub control_noise: f64,
    /// Control steps after which an action reaches the motors; constant throughout an episode.
    pub action_delay_steps: [u32; 2],
    /// Time from one push to the next, and from the start to the first (s).
    pub push_interval_s: [f64; 2],
    /// Velocity that a push adds to the whole humanoid, in any horizontal direction (m/s); 0 means no pushes.
    pub push_mps: [f64; 2],
}

impl Default for Randomisation {
    fn default() -> Self {
        const SAME: [f64; 2] = [1.0, 1.0];
        Self {
            mass_scale: SAME,
            floor_friction_scale: SAME,
            motor_scale: SAME,
            kp_scale: SAME,
            kd_scale: SAME,
            com_offset_m: 0.0,
            damping_scale: SAME,
            armature_scale: SAME,
            gravity_scale: SAME,
            sensor_noise_position: 0.0,
            sensor_noise_velocity: 0.0,
            encoder_bias_rad: 0.0,
            control_noise: 0.0,
            action_delay_steps: [0, 0],
            push_interval_s: [2.0, 5.0],
            push_mps: [0.0, 0.0],
        }
    }
}

/// Returns the first field that differs: name, left value, right value. A list that lacks a field does not compile.
macro_rules! first_difference {
    ($type:ident, $left:expr, $right:expr, [$($field:ident),* $(,)?]) => {{
        let $type { $($field),* } = $left;
        $(if *$field != $right.$field {
            return Some((stringify!($field), format!("{:?}", $field), format!("{:?}", $right.$field)));
        })*
        None
    }};
}

fn refuse(setting: &'static str, value: &dyn Debug, expected: &'static str) -> Result<(), ModelError> {
    Err(ModelError::Setting { setting, value: format!("{value:?}"), expected })
}

impl EnvironmentConfig {
    /// Rejects settings that cannot be simulated or make no sense as a task.
    pub(crate) fn check(&self) -> Result<(), ModelError> {
        PhysicsSettings::from(self).check()?;
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
        // A bound that is infinite on the wrong side would make every reward infinite.
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
            for (setting, included) in [
                ("include_cinert_in_observation", self.include_cinert_in_observation),
                ("include_cvel_in_observation", self.include_cvel_in_observation),
                ("include_qfrc_actuator_in_observation", self.include_qfrc_actuator_in_observation),
                ("include_cfrc_ext_in_observation", self.include_cfrc_ext_in_observation),
            ] {
                if !included {
                    return refuse(setting, &false, "true, since Humanoid-v4's observation leaves nothing out");
                }
            }
        }
        self.ground.check(self.velocity.is_some() || !self.own_task.is_empty())?;
        self.randomisation.check(self.control_step_s)
    }

    /// Returns the first setting that differs from another configuration's: name, value here, value there.
    pub(crate) fn difference(&self, other: &Self) -> Option<(&'static str, String, String)> {
        first_difference!(
            EnvironmentConfig,
            self,
            other,
            [
                task,
                own_task,
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
                keyframe,
                control_step_s,
                substeps,
                self_collision,
                velocity,
                ground,
                randomisation,
            ]
        )
    }
}

impl PhysicsSettings {
    /// Rejects durations and counts that cannot be simulated.
    pub(crate) fn check(&self) -> Result<(), ModelError> {
        if !CONTROL_STEPS_S.contains(&self.control_step_s) {
            return refuse("control_step_s", &self.control_step_s, "between 0.001 and 0.1 s");
        }
        if !(1..=1000).contains(&self.substeps) {
            return refuse("substeps", &self.substeps, "between 1 and 1000");
        }
        Ok(())
    }

    /// Returns the first setting that differs from `other`: name, value here, value there.
    pub(crate) fn difference(&self, other: &Self) -> Option<(&'static str, String, String)> {
        first_difference!(PhysicsSettings, self, other, [control_step_s, substeps, self_collision])
    }
}

impl Randomisation {
    /// Longest delay of an action (control steps).
    pub const DELAY_MAX_STEPS: u32 = 3;

    /// Returns whether anything is randomised.
    #[must_use]
    pub fn is_on(&self) -> bool {
        let off = Self { push_interval_s: self.push_interval_s, ..Self::default() };
        *self != off
    }

    /// Returns whether observations have noise.
    pub(crate) fn has_sensor_noise(&self) -> bool {
        self.sensor_noise_position > 0.0 || self.sensor_noise_velocity > 0.0
    }

    /// Rejects ranges that are empty or exceed their bounds, for a duration of the control step (s).
    pub(crate) fn check(&self, control_step_s: f64) -> Result<(), ModelError> {
        let refuse =
            |setting, value: f64, expected| Err(ModelError::Setting { setting, value: value.to_string(), expected });
        let factors = "between 0 and 10, and the first of the range not above the second";
        let delays = self.action_delay_steps.map(f64::from);
        for (setting, [low, high], [min, max], expected) in [
            // A body without mass would have no inertia.
            ("mass_scale", self.mass_scale, [0.1, 10.0], "between 0.1 and 10, the first not above the second"),
            ("floor_friction_scale", self.floor_friction_scale, [0.0, 10.0], factors),
            ("motor_scale", self.motor_scale, [0.0, 10.0], factors),
            ("kp_scale", self.kp_scale, [0.0, 10.0], factors),
            ("kd_scale", self.kd_scale, [0.0, 10.0], factors),
            ("damping_scale", self.damping_scale, [0.0, 10.0], factors),
            ("armature_scale", self.armature_scale, [0.0, 10.0], factors),
            ("gravity_scale", self.gravity_scale, [0.0, 10.0], factors),
            ("action_delay_steps", delays, [0.0, 3.0], "between 0 and 3, the first not above the second"),
            (
                "push_interval_s",
                self.push_interval_s,
                [control_step_s, 1000.0],
                "between one control step (control_step_s) and 1000 s, the first not above the second",
            ),
            ("push_mps", self.push_mps, [0.0, 10.0], factors),
        ] {
            let allowed = min..=max;
            if !allowed.contains(&low) {
                return refuse(setting, low, expected);
            }
            if !allowed.contains(&high) || high < low {
                return refuse(setting, high, expected);
            }
        }
        for (setting, value) in [
            ("sensor_noise_position", self.sensor_noise_position),
            ("sensor_noise_velocity", self.sensor_noise_velocity),
            ("encoder_bias_rad", self.encoder_bias_rad),
            ("com_offset_m", self.com_offset_m),
            ("control_noise", self.control_noise),
        ] {
            if !(0.0..=1.0).contains(&value) {
                return refuse(setting, value, "between 0 and 1");
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
