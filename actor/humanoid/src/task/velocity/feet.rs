//! Feet: where they are, whether they stand, and what the gait wants of them.

use std::f64::consts::{FRAC_PI_4, PI};

use nalgebra::{Point3, Vector3};

use crate::config::VelocityConfig;
use crate::physics::Physics;

/// Number of feet.
pub const FEET: usize = 2;
/// Vertical contact force above which a foot stands (N).
const STANDING_FORCE_N: f64 = 1.0;
/// Distance from a foot's frame within which its toe or its heel may meet a stair (m).
const REACH_M: f64 = 0.2;

/// A foot after a control step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Foot {
    /// Height of its frame above where it is when the robot stands in the default pose (m).
    pub lift_m: f64,
    /// How much higher the ground within its reach is than below its frame (m); at least 0.
    pub rise_m: f64,
    /// Velocity of its frame (m/s, world frame).
    pub velocity_mps: Vector3<f64>,
    /// Whether the ground carries it.
    pub stands: bool,
    /// Time since it last stood (s); 0 while it stands.
    pub air_s: f64,
    /// Time in the air that ended with this step (s); 0 if it did not land.
    pub landed_after_s: f64,
    /// Downward velocity before it landed in this step (m/s); 0 if it did not land.
    pub landing_mps: f64,
}

impl Foot {
    /// Returns the foot on `link` after a control step of `step_s`, from what it was before.
    pub(super) fn after(self, physics: &Physics, link: usize, standing_m: f64, step_s: f64) -> Self {
        let sensed = Self::now(physics, link, standing_m);
        let lands = sensed.stands && !self.stands;
        Self {
            air_s: if sensed.stands { 0.0 } else { self.air_s + step_s },
            landed_after_s: if lands { self.air_s } else { 0.0 },
            landing_mps: if lands { (-self.velocity_mps.z).max(0.0) } else { 0.0 },
            ..sensed
        }
    }

    /// Returns where the frame of a foot is (m, world).
    pub(super) fn origin_m(physics: &Physics, link: usize) -> Point3<f64> {
        Point3::from(physics.link_pose(link).translation.vector)
    }

    /// Returns the foot on `link` without a past.
    #[must_use]
    pub fn now(physics: &Physics, link: usize, standing_m: f64) -> Self {
        let moved = physics.link_motion(link);
        let origin = Point3::from(moved.pose.translation.vector);
        let ground_m = physics.ground_height_m(origin.x, origin.y);
        Self {
            lift_m: origin.z - ground_m - standing_m,
            rise_m: (highest_within_reach_m(physics, &origin) - ground_m).max(0.0),
            velocity_mps: moved.linear_mps,
            stands: physics.contact_wrench(link).0.z > STANDING_FORCE_N,
            ..Self::default()
        }
    }
}

/// Returns the height of the highest of eight places on the ground around a foot (m, world).
fn highest_within_reach_m(physics: &Physics, origin: &Point3<f64>) -> f64 {
    let places = (0..8).map(|place| (FRAC_PI_4 * f64::from(place)).sin_cos());
    places
        .map(|(sin, cos)| physics.ground_height_m(origin.x + REACH_M * cos, origin.y + REACH_M * sin))
        .fold(f64::NEG_INFINITY, f64::max)
}

/// What the gait wants of a foot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stride {
    /// Whether the foot must stand.
    pub stands: bool,
    /// Height to which it must be lifted (m).
    pub lift_m: f64,
}

/// Returns what the gait wants of foot number `foot`, `time_s` after the episode's start: the feet alternate, each
/// stands for [`VelocityConfig::stance_share`] of the period and then is lifted along half a period of a squared sine,
/// in its middle by [`VelocityConfig::swing_height_m`] over ground that rises by `rise_m` within its reach.
#[must_use]
pub fn stride(config: &VelocityConfig, time_s: f64, foot: usize, rise_m: f64) -> Stride {
    let phase = (time_s / config.gait_period_s + 0.5 * foot as f64).fract();
    let swing = (phase - config.stance_share) / (1.0 - config.stance_share);
    match swing < 0.0 {
        true => Stride { stands: true, lift_m: 0.0 },
        false => Stride { stands: false, lift_m: (config.swing_height_m + rise_m) * (PI * swing).sin().powi(2) },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_feet_alternate_and_are_highest_in_the_middle_of_their_swing() {
        let config = VelocityConfig { gait_period_s: 1.0, stance_share: 0.6, ..VelocityConfig::default() };
        assert_eq!(stride(&config, 0.3, 0, 0.2), Stride { stands: true, lift_m: 0.0 });
        let swing = stride(&config, 2.8, 0, 0.0);
        assert!(!swing.stands && (swing.lift_m - config.swing_height_m).abs() < 1e-9, "{swing:?}");
        assert!((stride(&config, 2.7, 0, 0.0).lift_m - config.swing_height_m / 2.0).abs() < 1e-9);
        assert!((stride(&config, 2.7, 0, 0.1).lift_m - (config.swing_height_m + 0.1) / 2.0).abs() < 1e-9);
        assert_eq!(stride(&config, 0.3, 1, 0.0), stride(&config, 0.8, 0, 0.0));
    }
}
