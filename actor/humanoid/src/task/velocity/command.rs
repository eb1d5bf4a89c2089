//! Commands: what the robot is asked to do, and for how long.

use rand::RngExt;

use crate::config::{HEADING_GAIN, VelocityConfig};
use crate::randomisation::{stream, uniform};

/// Norm of the three numbers of a command (m/s, m/s and rad/s) below which it says: stand. Unitree's unitree_rl_mjlab feeds
/// the gait's phase (0, 0) below the same norm.
pub const STANDING_COMMAND: f64 = 0.1;

/// Velocity that the robot is asked to have, in its heading frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Command {
    /// Forward velocity (m/s).
    pub lin_vel_x_mps: f64,
    /// Velocity to the left (m/s).
    pub lin_vel_y_mps: f64,
    /// Yaw rate, to the left (rad/s).
    pub ang_vel_z_radps: f64,
}

impl Command {
    /// Returns whether the robot is asked to stand.
    #[must_use]
    pub fn stands(&self) -> bool {
        self.lin_vel_x_mps.hypot(self.lin_vel_y_mps).hypot(self.ang_vel_z_radps) < STANDING_COMMAND
    }

    /// Returns the command of these numbers, see [`Self::numbers`].
    #[must_use]
    pub fn from_numbers([lin_vel_x_mps, lin_vel_y_mps, ang_vel_z_radps]: [f64; 3]) -> Self {
        Self { lin_vel_x_mps, lin_vel_y_mps, ang_vel_z_radps }
    }

    /// Returns forward velocity, velocity to the left and yaw rate.
    #[must_use]
    pub fn numbers(&self) -> [f64; 3] {
        [self.lin_vel_x_mps, self.lin_vel_y_mps, self.ang_vel_z_radps]
    }
}

/// Command of an episode's schedule, of which seed and number alone decide.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Drawn {
    /// Velocity; its yaw rate is not used with a heading.
    pub command: Command,
    /// Heading to turn to (rad, world frame).
    pub heading_rad: Option<f64>,
    /// Control steps for which it holds.
    pub steps: u32,
}

impl Drawn {
    /// Draws command number `index` of an episode.
    pub(super) fn new(config: &VelocityConfig, control_step_s: f64, seed: u64, index: u32) -> Self {
        // Odd multiples of a large odd number differ in all bits.
        let mut random = stream(seed ^ u64::from(index).wrapping_mul(0x9e37_79b9_7f4a_7c15), "commands");
        let steps = (uniform(&mut random, config.resampling_s) / control_step_s).round().max(1.0) as u32;
        let stands = random.random::<f64>() < config.standing_share;
        let has_heading = random.random::<f64>() < config.heading_share;
        let mut within = |range| uniform(&mut random, range);
        let command = Command {
            lin_vel_x_mps: within(config.lin_vel_x_mps),
            lin_vel_y_mps: within(config.lin_vel_y_mps),
            ang_vel_z_radps: within(config.ang_vel_z_radps),
        };
        let heading_rad = within([-std::f64::consts::PI, std::f64::consts::PI]);
        match stands {
            true => Self { command: Command::default(), heading_rad: None, steps },
            false => Self { command, heading_rad: has_heading.then_some(heading_rad), steps },
        }
    }

    /// Returns the command to a robot with this heading (rad).
    pub(super) fn at(&self, config: &VelocityConfig, heading_rad: f64) -> Command {
        let Some(wanted_rad) = self.heading_rad else { return self.command };
        let (sin, cos) = (wanted_rad - heading_rad).sin_cos();
        let [low, high] = config.ang_vel_z_radps;
        Command { ang_vel_z_radps: (HEADING_GAIN * sin.atan2(cos)).clamp(low, high), ..self.command }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_stay_within_their_ranges_and_some_stand() {
        let config = VelocityConfig { heading_share: 0.3, ..VelocityConfig::default() };
        let drawn: Vec<Drawn> = (0..2000).map(|index| Drawn::new(&config, 0.02, 7, index)).collect();
        let standing = drawn.iter().filter(|drawn| drawn.command == Command::default()).count();
        assert!((140..260).contains(&standing), "{standing} of 2000 stand");
        let headings = drawn.iter().filter(|drawn| drawn.heading_rad.is_some()).count();
        assert!((450..630).contains(&headings), "{headings} of 2000 have a heading");
        for drawn in &drawn {
            let [x, y, yaw] = drawn.command.numbers();
            assert!((-0.5..=1.0).contains(&x) && (-0.3..=0.3).contains(&y) && (-0.5..=0.5).contains(&yaw), "{drawn:?}");
            assert!((150..=400).contains(&drawn.steps), "{drawn:?}");
        }
        assert_eq!(Drawn::new(&config, 0.02, 7, 3), drawn[3], "the same number gives the same command");
        assert_ne!(Drawn::new(&config, 0.02, 8, 3), drawn[3]);
    }

    #[test]
    fn a_command_says_stand_below_a_norm_of_a_tenth() {
        let stands = |x: f64, y, yaw| Command { lin_vel_x_mps: x, lin_vel_y_mps: y, ang_vel_z_radps: yaw }.stands();
        // √(0.05² + 0.05² + 0.07²) = 0.0995.
        assert!(stands(0.0, 0.0, 0.0) && stands(-0.05, 0.05, -0.07) && stands(0.0, 0.0, 0.0999));
        assert!(!stands(0.1, 0.0, 0.0) && !stands(0.06, 0.06, 0.06) && !stands(0.0, 0.0, -0.1));
    }

    #[test]
    fn a_heading_is_reached_the_short_way_round() {
        let config = VelocityConfig::default();
        let towards = |heading_rad| Drawn { heading_rad: Some(heading_rad), ..Drawn::default() };
        let rate = |drawn: Drawn, now_rad| drawn.at(&config, now_rad).ang_vel_z_radps;
        assert!((rate(towards(0.6), 0.2) - 0.2).abs() < 1e-12);
        assert!((rate(towards(-3.0), 3.0) - 0.5 * (2.0 * std::f64::consts::PI - 6.0)).abs() < 1e-12);
        assert_eq!(rate(towards(-2.0), 0.0), -0.5, "limited by the range");
    }
}
