//! Settings of the velocity task: commands, gait and falls.

use crate::{is_range, section};

section! {
    /// Commands, gait and falls of the velocity task; see docs/guide/your-robot.md.
    VelocityConfig as "velocity" {
        /// Smallest and largest commanded forward velocity in m/s.
        lin_vel_x_mps: [f64; 2] = [-0.5, 1.0], "[smallest, largest], -5 to 5" => |v| is_range(v, -5.0, 5.0);
        /// Smallest and largest commanded velocity to the left in m/s.
        lin_vel_y_mps: [f64; 2] = [-0.3, 0.3], "[smallest, largest], -5 to 5" => |v| is_range(v, -5.0, 5.0);
        /// Smallest and largest commanded yaw rate, to the left, in rad/s.
        ang_vel_z_radps: [f64; 2] = [-0.5, 0.5], "[smallest, largest], -5 to 5" => |v| is_range(v, -5.0, 5.0);
        /// Shortest and longest time for which a command holds, in seconds.
        resampling_s: [f64; 2] = [3.0, 8.0], "[shortest, longest], 0.1 to 1000" => |v| is_range(v, 0.1, 1000.0);
        /// Share of the commands that say: stand.
        standing_share: f64 = 0.1, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Share of the commands that give a heading, from whose error the yaw rate follows, instead of a yaw rate.
        heading_share: f64 = 0.0, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Duration of one step of both feet in seconds.
        gait_period_s: f64 = 0.8, "0.1 to 10" => |v| (0.1..=10.0).contains(v);
        /// Share of the gait period for which a foot stands.
        stance_share: f64 = 0.6, "0.05 to 0.95" => |v| (0.05..=0.95).contains(v);
        /// Whether the gait rests while the command says: stand. The policy then sees the phase (0, 0). Robots stand still
        /// so, and fall more often when they are pushed.
        gait_rests: bool = false, "true or false" => |_| true;
        /// Time after a command to stand for which the phase goes on before the gait rests, in seconds. It goes on for as
        /// long when the base turns at rest, as after a push. 0 means at once and whatever happens, as in unitree_rl_mjlab.
        gait_rests_after_s: f64 = 1.0, "0 to 10" => |v| (0.0..=10.0).contains(v);
        /// Height to which a swinging foot is lifted, in metres, above the highest ground within 0.2 m of it.
        swing_height_m: f64 = 0.08, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Squared error of the horizontal velocity at which its tracking reward falls to 1/e (m²/s²).
        tracking_variance: f64 = 0.1, "0.0001 to 100" => |v| (1e-4..=100.0).contains(v);
        /// The same of the yaw rate (rad²/s²).
        yaw_tracking_variance: f64 = 0.1, "0.0001 to 100" => |v| (1e-4..=100.0).contains(v);
        /// Share of the standing height below which the robot has fallen.
        fall_height_share: f64 = 0.6, "0 to 0.95" => |v| (0.0..=0.95).contains(v);
        /// Tilt of the base above which the robot has fallen, in rad.
        fall_tilt_rad: f64 = 1.0, "0.1 to 3.2" => |v| (0.1..=3.2).contains(v);
        /// Number of observations, the present one included, that the policy sees together.
        history: u32 = 1, "1 to 16" => |v| (1..=16).contains(v);
        /// Whether the policy sees the heights of the ground around it: 11 x 7 points, 0.1 m apart, in its heading frame.
        height_scan: bool = false, "true or false" => |_| true;
        /// Whether the ranges of commands begin at 0.4 of their size in training, and grow with each environment's success.
        command_curriculum: bool = false, "true or false" => |_| true;
    }
}
