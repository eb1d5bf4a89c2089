//! Settings of the velocity task.

use super::refuse;
use crate::error::ModelError;

/// Most observations of the past in one observation.
pub const HISTORY_MAX: u32 = 16;

/// Settings of [`crate::task::velocity::VelocityTask`].
#[derive(Clone, Debug, PartialEq)]
pub struct VelocityConfig {
    /// Smallest and largest commanded forward velocity (m/s).
    pub lin_vel_x_mps: [f64; 2],
    /// Smallest and largest commanded velocity to the left (m/s).
    pub lin_vel_y_mps: [f64; 2],
    /// Smallest and largest commanded yaw rate, to the left (rad/s).
    pub ang_vel_z_radps: [f64; 2],
    /// Shortest and longest time for which a command holds (s).
    pub resampling_s: [f64; 2],
    /// Share of the commands that say: stand.
    pub standing_share: f64,
    /// Share of the commands that give a heading, from whose error the yaw rate follows, instead of a yaw rate.
    pub heading_share: f64,
    /// Duration of one step of both feet (s).
    pub gait_period_s: f64,
    /// Share of the gait period for which a foot stands.
    pub stance_share: f64,
    /// Height to which a swinging foot is lifted above the highest ground within its reach (m).
    pub swing_height_m: f64,
    /// Squared error of a velocity (m²/s² or rad²/s²) at which its tracking reward falls to 1/e.
    pub tracking_variance: f64,
    /// Share of the standing height below which the robot has fallen.
    pub fall_height_share: f64,
    /// Tilt of the base above which the robot has fallen (rad).
    pub fall_tilt_rad: f64,
    /// Number of observations, the present one included, that the policy sees together.
    pub history: u32,
    /// Whether the policy sees the heights of the ground around it.
    pub height_scan: bool,
    /// Whether the ranges of commands begin at 0.4 of their size and grow with the environment's success.
    pub command_curriculum: bool,
    /// Weights of the reward's terms, per control step.
    pub rewards: VelocityRewards,
}

impl Default for VelocityConfig {
    fn default() -> Self {
        Self {
            lin_vel_x_mps: [-0.5, 1.0],
            lin_vel_y_mps: [-0.3, 0.3],
            ang_vel_z_radps: [-0.5, 0.5],
            resampling_s: [3.0, 8.0],
            standing_share: 0.1,
            heading_share: 0.0,
            gait_period_s: 0.8,
            stance_share: 0.6,
            swing_height_m: 0.08,
            tracking_variance: 0.1,
            fall_height_share: 0.6,
            fall_tilt_rad: 1.0,
            history: 1,
            height_scan: false,
            command_curriculum: false,
            rewards: VelocityRewards::default(),
        }
    }
}

/// Declares the weights of the reward's terms with their names, once.
macro_rules! rewards {
    ($( $(#[doc = $doc:literal])* $name:ident: $weight:expr, )*) => {
        /// Weights of the reward's terms. The reward of a control step is the sum of weight × term.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct VelocityRewards {
            $( $(#[doc = $doc])* pub $name: f64, )*
        }

        impl Default for VelocityRewards {
            fn default() -> Self {
                Self { $( $name: $weight, )* }
            }
        }

        impl VelocityRewards {
            /// Returns the names and weights, in order.
            #[must_use]
            pub fn entries(&self) -> Vec<(&'static str, f64)> {
                vec![ $( (stringify!($name), self.$name), )* ]
            }

            /// Calls `each` with the name of each term that has a weight, and weight × term.
            pub fn weigh(&self, terms: &Self, each: &mut dyn FnMut(&'static str, f64)) {
                $( if self.$name != 0.0 { each(stringify!($name), self.$name * terms.$name); } )*
            }

            /// Returns Σ weight × term.
            #[must_use]
            pub fn total(&self, terms: &Self) -> f64 {
                0.0 $( + self.$name * terms.$name )*
            }
        }
    };
}

rewards! {
    /// exp(−e² ÷ variance), e the error of the horizontal velocity in the heading frame (m/s).
    track_linear_velocity: 2.0,
    /// The same of the yaw rate (rad/s).
    track_yaw_rate: 1.5,
    /// 1 in each step that is no fall.
    alive: 0.3,
    /// Squared horizontal part of gravity's direction in the base frame.
    upright: -2.0,
    /// Squared difference from the standing height (m²).
    base_height: -20.0,
    /// Squared vertical velocity of the base (m²/s²).
    vertical_velocity: -0.5,
    /// Squared roll and pitch rates of the base (rad²/s²).
    roll_pitch_rate: -0.05,
    /// Share of the feet that stand or swing as the gait says, less the share of the others.
    gait: 2.0,
    /// Time in the air beyond 0.4 s, at each landing of a foot (s).
    feet_air_time: 0.0,
    /// Squared difference of the swinging feet's heights from the gait's (m²); on generated ground only of feet that
    /// are lower.
    feet_clearance: -300.0,
    /// Squared horizontal velocity of the feet that stand (m²/s²).
    feet_slip: -0.5,
    /// Greatest downward velocity of a foot at its landing, squared (m²/s²).
    landing: 0.0,
    /// Squared difference of the hinges from the default pose (rad²); hinges that swing the legs forwards count a tenth.
    pose: -0.5,
    /// Squared change of the action from step to step, in units of the action.
    action_rate: -0.01,
    /// Squared torques (N²m²).
    joint_torque: -1e-5,
    /// Squared accelerations of the hinges (rad²/s⁴).
    joint_acceleration: -2.5e-7,
    /// Angle beyond nine tenths of the hinges' ranges (rad).
    joint_limits: -5.0,
}

impl VelocityConfig {
    /// Returns these settings with the ranges of commands times a factor.
    pub(crate) fn with_commands_times(&self, factor: f64) -> Self {
        let times = |range: [f64; 2]| range.map(|end| factor * end);
        Self {
            lin_vel_x_mps: times(self.lin_vel_x_mps),
            lin_vel_y_mps: times(self.lin_vel_y_mps),
            ang_vel_z_radps: times(self.ang_vel_z_radps),
            ..self.clone()
        }
    }

    /// Rejects ranges that are empty or beyond what the task can command.
    pub(crate) fn check(&self) -> Result<(), ModelError> {
        for (setting, [low, high], [min, max], expected) in [
            ("velocity.lin_vel_x_mps", self.lin_vel_x_mps, [-5.0, 5.0], "[smallest, largest], -5 to 5"),
            ("velocity.lin_vel_y_mps", self.lin_vel_y_mps, [-5.0, 5.0], "[smallest, largest], -5 to 5"),
            ("velocity.ang_vel_z_radps", self.ang_vel_z_radps, [-5.0, 5.0], "[smallest, largest], -5 to 5"),
            ("velocity.resampling_s", self.resampling_s, [0.1, 1000.0], "[shortest, longest], 0.1 to 1000"),
        ] {
            if !(min <= low && low <= high && high <= max) {
                return refuse(setting, &[low, high], expected);
            }
        }
        for (setting, value, [min, max], expected) in [
            ("velocity.standing_share", self.standing_share, [0.0, 1.0], "0 to 1"),
            ("velocity.heading_share", self.heading_share, [0.0, 1.0], "0 to 1"),
            ("velocity.gait_period_s", self.gait_period_s, [0.1, 10.0], "0.1 to 10"),
            ("velocity.stance_share", self.stance_share, [0.05, 0.95], "0.05 to 0.95"),
            ("velocity.swing_height_m", self.swing_height_m, [0.0, 1.0], "0 to 1"),
            ("velocity.tracking_variance", self.tracking_variance, [1e-4, 100.0], "0.0001 to 100"),
            ("velocity.fall_height_share", self.fall_height_share, [0.0, 0.95], "0 to 0.95"),
            ("velocity.fall_tilt_rad", self.fall_tilt_rad, [0.1, 3.2], "0.1 to 3.2"),
        ] {
            if !(min..=max).contains(&value) {
                return refuse(setting, &value, expected);
            }
        }
        if !(1..=HISTORY_MAX).contains(&self.history) {
            return refuse("velocity.history", &self.history, "1 to 16");
        }
        match self.rewards.entries().into_iter().find(|(_, weight)| !weight.is_finite()) {
            Some((_, weight)) => refuse("rewards", &weight, "finite"),
            None => Ok(()),
        }
    }
}
