//! Terms of the velocity task's reward and their weights.

use crate::section;

/// Declares each term once: its documentation, name and default weight.
macro_rules! rewards {
    ($( $(#[doc = $doc:literal])+ $name:ident = $weight:expr; )*) => {
        section! {
            /// Weights of the velocity task's reward: the reward of a control step is the sum of weight times term. A weight
            /// of 0 switches a term off.
            RewardsConfig as "rewards" {
                $( $(#[doc = $doc])+ $name: f64 = $weight, "a finite number" => |v| v.is_finite(); )*
            }
        }

        /// Number of terms.
        pub const REWARD_TERMS: usize = [$(stringify!($name)),*].len();

        /// Terms of the reward for a control step, without weights.
        pub trait RewardFunctions {
            $( $(#[doc = $doc])+ fn $name(&self) -> f64; )*

            /// Returns all terms, in the order of [`RewardsConfig::NAMES`].
            fn values(&self) -> [f64; REWARD_TERMS] {
                [$( self.$name() ),*]
            }
        }

        impl RewardsConfig {
            /// Names of the terms, in order.
            pub const NAMES: [&str; REWARD_TERMS] = [$(stringify!($name)),*];

            /// Returns the weights, in order.
            #[must_use]
            pub fn weights(&self) -> [f64; REWARD_TERMS] {
                [$( self.$name ),*]
            }
        }
    };
}

rewards! {
    /// exp(-e²/velocity.tracking_variance) of the error e of the horizontal velocity in the heading frame (m/s).
    track_linear_velocity = 2.0;
    /// exp(-e²/velocity.yaw_tracking_variance) of the error e of the yaw rate (rad/s).
    track_yaw_rate = 1.5;
    /// 1 in each step that is no fall.
    alive = 0.3;
    /// Squared horizontal part of gravity's direction in the frame of the base.
    upright = -2.0;
    /// Squared difference from the standing height (m²).
    base_height = -20.0;
    /// Squared vertical velocity of the base (m²/s²).
    vertical_velocity = -0.5;
    /// Squared roll and pitch rates of the base (rad²/s²).
    roll_pitch_rate = -0.05;
    /// Share of the feet that stand or swing as the gait says, less the share of the others. A robot whose gait rests is to
    /// stand on both.
    gait = 2.0;
    /// Time in the air beyond 0.4 s, at each landing of a foot (s).
    feet_air_time = 0.0;
    /// Squared difference of the swinging feet's heights from the gait's (m²); on generated ground only of feet that are
    /// lower.
    feet_clearance = -300.0;
    /// Squared horizontal velocity of the feet that stand (m²/s²).
    feet_slip = -0.5;
    /// Squared downward velocity of the foot that lands hardest (m²/s²).
    landing = 0.0;
    /// Squared difference of the hinges from the default pose (rad²); hinges that swing the legs forwards count a tenth.
    pose = -0.5;
    /// Squared rates of the hinges (rad²/s²) with `velocity.gait_rests`, while the command says: stand.
    stand_still = -0.02;
    /// Squared change of the action from step to step, in units of the action.
    action_rate = -0.01;
    /// Squared torques (N²m²).
    joint_torque = -1e-5;
    /// Squared accelerations of the hinges (rad²/s⁴).
    joint_acceleration = -2.5e-7;
    /// Angle beyond nine tenths of the hinges' ranges (rad).
    joint_limits = -5.0;
}
