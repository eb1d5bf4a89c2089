//! Whether a robot can come to rest without a step.
//!
//! The *capture point* is where the robot would have to put a foot to come to rest above it: `c + v √(h ÷ g)`, with the
//! place `c` and the velocity `v` of its centre of mass along the ground and its height `h` above it (the linear inverted
//! pendulum of Pratt et al. 2006, "Capture Point: A Step toward Humanoid Push Recovery"). As long as that point is between
//! its feet, the feet can stay where they are.

use nalgebra::Vector2;

use super::feet::{FEET, Foot};
use super::rewards::BaseMotion;
use crate::config::VelocityConfig;
use crate::physics::Physics;
use crate::randomisation::{stream, uniform};

/// Acceleration of gravity (m/s²).
const GRAVITY_MPS2: f64 = 9.81;

/// Shares of the bounds of [`Calm`], one of which holds for an episode of training. With bounds that never change, policies
/// learn to rest just within them, and fall beside them.
const SHARES_IN_TRAINING: [f64; 2] = [0.5, 1.5];

/// When a robot whose gait rests is calm, by what its inertial sensor measures. A push, or a stop that tips it over, wakes
/// its gait: from a rest, policies hardly learn to step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Calm {
    /// Largest angular velocity of the base (rad/s).
    pub rate_radps: f64,
    /// Time at rest after which its steps have died away (s).
    pub settled_s: f64,
    /// Largest angular velocity from then on (rad/s).
    pub settled_rate_radps: f64,
}

impl Calm {
    /// Returns the bounds for a gait, whose period is the robot's unit of time.
    #[must_use]
    pub fn of(config: &VelocityConfig) -> Self {
        let per_period = |turn_rad: f64| turn_rad / config.gait_period_s;
        Self { rate_radps: per_period(1.6), settled_s: config.gait_period_s, settled_rate_radps: per_period(0.24) }
    }

    /// Returns the bounds in an episode of training with this seed.
    pub fn in_training(self, seed: u64) -> Self {
        let share = uniform(&mut stream(seed, "calm"), SHARES_IN_TRAINING);
        let [rate_radps, settled_rate_radps] = [self.rate_radps, self.settled_rate_radps].map(|bound| share * bound);
        Self { rate_radps, settled_rate_radps, ..self }
    }

    /// Returns whether a robot is disturbed after so long at rest.
    pub fn is_disturbed(&self, base: &BaseMotion, rested_s: f64) -> bool {
        let rate_radps = if rested_s < self.settled_s { self.rate_radps } else { self.settled_rate_radps };
        base.angular_radps.norm() > rate_radps
    }
}

/// How long a robot has been asked to stand.
#[derive(Clone, Copy, Debug, Default)]
pub struct Standing {
    /// Observations since then, or since the last disturbance at rest, with the present one.
    pub steps: u32,
}

impl Standing {
    /// Returns the time with another observation.
    pub fn after(self, stands: bool, is_disturbed: bool) -> Self {
        let steps = if is_disturbed { 0 } else { self.steps };
        Self { steps: if stands { steps.saturating_add(1) } else { 0 } }
    }

    /// Returns how long its gait has rested (s); `None` if it does not.
    pub fn rested_s(self, config: &VelocityConfig, step_s: f64) -> Option<f64> {
        let rested_s = f64::from(self.steps.checked_sub(1)?) * step_s - config.gait_rests_after_s;
        (config.gait_rests && rested_s >= 0.0).then_some(rested_s)
    }
}

/// Returns the capture point, relative to the middle of the two feet, in the heading frame: forward and left (m).
pub fn capture_point_m(physics: &Physics, feet_links: [usize; FEET], heading_rad: f64) -> Vector2<f64> {
    let (centre, velocity_mps) = (physics.centre_of_mass(), physics.centre_of_mass_velocity());
    let [left, right] = feet_links.map(|link| Foot::origin_m(physics, link).xy());
    let height_m = (centre.z - physics.ground_height_m(centre.x, centre.y)).max(0.0);
    let point = centre.xy() + velocity_mps.xy() * (height_m / GRAVITY_MPS2).sqrt();
    let (sin, cos) = heading_rad.sin_cos();
    let from_feet = point - nalgebra::center(&left, &right);
    Vector2::new(cos * from_feet.x + sin * from_feet.y, cos * from_feet.y - sin * from_feet.x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::EnvConfig;
    use crate::model::Model;

    /// Two feet of 1 kg, 0.2 m apart, below a base of 8 kg.
    const BIPED: &str = r#"<mujoco><worldbody><geom type="plane" size="5 5 .1"/>
        <body name="base" pos="1 2 .9"><freejoint/><geom type="sphere" size=".1" pos=".05 0 0" mass="8"/>
          <body name="left" pos="0 .1 -.8"><joint name="hip" axis="0 1 0" range="-1 1"/>
            <geom type="sphere" size=".1" mass="1"/></body>
          <body name="right" pos="0 -.1 -.8"><joint axis="0 1 0" range="-1 1"/>
            <geom type="sphere" size=".1" mass="1"/></body>
        </body></worldbody>
        <actuator><motor joint="hip"/></actuator></mujoco>"#;

    #[test]
    fn a_disturbance_begins_the_time_at_rest_anew() {
        let config = VelocityConfig { gait_rests: true, gait_rests_after_s: 0.04, ..VelocityConfig::default() };
        let standing = |steps: u32| Standing { steps };
        assert_eq!(
            [(true, false), (true, true), (false, false)].map(|(s, d)| standing(4).after(s, d).steps),
            [5, 1, 0]
        );
        assert_eq!(
            [0, 2, 3, 5].map(|steps| standing(steps).rested_s(&config, 0.02)),
            [None, None, Some(0.0), Some(0.04)]
        );
        assert_eq!(standing(5).rested_s(&VelocityConfig::default(), 0.02), None);
    }

    #[test]
    fn a_turn_disturbs_and_once_settled_a_slower_one() {
        // A period of 0.8 s: 2 rad/s, and 0.3 rad/s from then on.
        let calm = Calm::of(&VelocityConfig::default());
        let is_disturbed = |rate_radps: f64, rested_s: f64| {
            let velocity = [0.0, 0.0, 0.0, 0.8 * rate_radps, -0.6 * rate_radps, 0.0];
            calm.is_disturbed(&BaseMotion::new(&[0.0, 0.0, 0.8, 1.0, 0.0, 0.0, 0.0], &velocity, 0.0), rested_s)
        };
        assert!(!is_disturbed(1.99, 0.0) && !is_disturbed(1.99, 0.79) && is_disturbed(2.01, 0.79));
        assert!(!is_disturbed(0.29, 0.81) && is_disturbed(0.31, 0.81));
        let shares: Vec<f64> = (0..100).map(|seed| calm.in_training(seed).rate_radps / calm.rate_radps).collect();
        assert!(shares.iter().all(|share| (0.5..=1.5).contains(share)));
        assert!(shares.iter().any(|share| *share < 0.6) && shares.iter().any(|share| *share > 1.4));
        let changed = calm.in_training(3);
        assert!((changed.settled_rate_radps / calm.settled_rate_radps - shares[3]).abs() < 1e-12);
    }

    #[test]
    fn it_is_the_centre_of_mass_plus_its_velocity_by_the_time_of_a_fall() {
        let model = Model::from_mjcf(BIPED).unwrap();
        let feet = ["left", "right"].map(|name| model.links.iter().position(|link| link.name == name).unwrap());
        let mut physics = Physics::new(model, &EnvConfig::default()).unwrap();
        // Turned left by 90°, at 0.3 m/s along the world's y: forwards.
        let half = std::f64::consts::FRAC_PI_4;
        let position = [1.0, 2.0, 0.9, half.cos(), 0.0, 0.0, half.sin(), 0.0, 0.0];
        physics.set_state(&position, &[0.0, 0.3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        // The centre of mass is 8/10 · 0.05 m before the feet, at 0.8 · 0.9 m + 0.2 · 0.1 m.
        let forward_m = 0.04 + 0.3 * (0.74_f64 / 9.81).sqrt();
        let found = capture_point_m(&physics, feet, std::f64::consts::FRAC_PI_2);
        assert!((found - Vector2::new(forward_m, 0.0)).norm() < 1e-6, "{found} instead of {forward_m}");
    }
}
