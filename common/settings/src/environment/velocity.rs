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

/// Parts into which a range of commands is cut for a mean.
const PARTS: u32 = 16;
/// Yaw rate per error of the heading (1/s).
pub const HEADING_GAIN: f64 = 0.5;

impl VelocityConfig {
    /// Returns the mean commanded speed (m/s): (1 − `standing_share`) · mean of √(x² + y²), with x and y uniform in their
    /// ranges. A robot that only stands has this velocity error.
    #[must_use]
    pub fn mean_speed_mps(&self) -> f64 {
        let speeds = middles(self.lin_vel_x_mps).flat_map(|x| middles(self.lin_vel_y_mps).map(move |y| x.hypot(y)));
        speeds.sum::<f64>() / f64::from(PARTS * PARTS) * (1.0 - self.standing_share)
    }

    /// Returns the mean size of the commanded yaw rate of a robot that only stands (rad/s), which is its yaw rate error:
    /// (1 − `standing_share`) · mean of |w|. With a heading, w is [`HEADING_GAIN`] · e within the range, where the heading's
    /// error e is uniform from −π to π; without one, w is uniform in its range.
    #[must_use]
    pub fn mean_yaw_rate_radps(&self) -> f64 {
        let [low, high] = self.ang_vel_z_radps;
        let mean = |rates: &mut dyn Iterator<Item = f64>| rates.map(f64::abs).sum::<f64>() / f64::from(PARTS);
        let half_turn = std::f64::consts::PI;
        let turned = mean(&mut middles([-half_turn, half_turn]).map(|error| (HEADING_GAIN * error).clamp(low, high)));
        let given = mean(&mut middles(self.ang_vel_z_radps));
        (given + (turned - given) * self.heading_share) * (1.0 - self.standing_share)
    }
}

/// Returns the middles of the parts of a range.
fn middles([low, high]: [f64; 2]) -> impl Iterator<Item = f64> {
    (0..PARTS).map(move |part| low + (high - low) * (f64::from(part) + 0.5) / f64::from(PARTS))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_standing_robot_has_the_mean_of_the_commands_as_its_error() {
        let config = |x, y, yaw, standing_share, heading_share| VelocityConfig {
            lin_vel_x_mps: x,
            lin_vel_y_mps: y,
            ang_vel_z_radps: yaw,
            standing_share,
            heading_share,
            ..VelocityConfig::default()
        };
        let forward = config([0.0, 1.0], [0.0, 0.0], [-0.5, 1.5], 0.2, 0.0);
        assert!((forward.mean_speed_mps() - 0.8 * 0.5).abs() < 1e-12);
        // A quarter of the rates is negative: 1/4 · 0.25 + 3/4 · 0.75 = 0.625.
        assert!((forward.mean_yaw_rate_radps() - 0.8 * 0.625).abs() < 1e-12);
        // The mean distance from the middle of a square of side 2 is (√2 + ln(1 + √2)) / 3 = 0.7652.
        let around = config([-1.0, 1.0], [-1.0, 1.0], [-2.0, 2.0], 0.0, 1.0);
        assert!((around.mean_speed_mps() - 0.7652).abs() < 2e-3, "{}", around.mean_speed_mps());
        // Half of a mean heading error of π/2.
        assert!((around.mean_yaw_rate_radps() - std::f64::consts::FRAC_PI_4).abs() < 1e-12);
    }
}
