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

/// Acceleration of gravity (m/s²).
const GRAVITY_MPS2: f64 = 9.81;

/// Horizontal part of gravity's direction in the frame of the base, below which a robot at rest is calm.
pub const CALM_TILT: f64 = 0.2;
/// Angular velocity of the base below which it is calm (rad/s).
pub const CALM_RATE_RADPS: f64 = 1.5;

/// Share of both that disturbs a robot in training. Those that trained with all of it rested less upright, and fell 20 times
/// of 100 instead of once.
const SHARE_IN_TRAINING: f64 = 0.6;

/// How long a robot has been asked to stand, in observations with the last one.
#[derive(Clone, Copy, Debug, Default)]
pub struct Standing {
    /// Since the command says so.
    pub steps: u32,
    /// Since then, and since the last disturbance at rest.
    pub undisturbed_steps: u32,
}

impl Standing {
    /// Returns the times with another observation.
    pub fn after(self, stands: bool, is_disturbed: bool) -> Self {
        let next = |steps: u32| if stands { steps.saturating_add(1) } else { 0 };
        let undisturbed = if is_disturbed { 0 } else { self.undisturbed_steps };
        Self { steps: next(self.steps), undisturbed_steps: next(undisturbed) }
    }

    /// Returns whether the robot should rest by now.
    pub fn is_to_rest(&self, config: &VelocityConfig, step_s: f64) -> bool {
        let stood_s = f64::from(self.steps.saturating_sub(1)) * step_s;
        config.gait_rests && self.steps > 0 && stood_s >= config.gait_rests_after_s
    }

    /// Returns whether its gait rests: it should, and the robot is not disturbed.
    pub fn rests(&self, config: &VelocityConfig, step_s: f64) -> bool {
        Self { steps: self.undisturbed_steps, ..*self }.is_to_rest(config, step_s)
    }
}

/// Returns whether a robot is disturbed by what its inertial sensor measures. A push, or a stop that tips it over, wakes its
/// gait: from a rest, policies hardly learn to step.
pub fn is_disturbed(base: &BaseMotion, in_training: bool) -> bool {
    let share = if in_training { SHARE_IN_TRAINING } else { 1.0 };
    base.gravity.xy().norm() > share * CALM_TILT || base.angular_radps.norm() > share * CALM_RATE_RADPS
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
        let stood = Standing { steps: 7, undisturbed_steps: 4 };
        let times = |standing: Standing| (standing.steps, standing.undisturbed_steps);
        assert_eq!(times(stood.after(true, false)), (8, 5));
        assert_eq!(times(stood.after(true, true)), (8, 1));
        assert_eq!(times(stood.after(false, false)), (0, 0));
        let upright = BaseMotion::new(&[0.0, 0.0, 0.8, 1.0, 0.0, 0.0, 0.0], &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0], 0.0);
        // 1 rad/s is more than 0.6 · 1.5 rad/s.
        assert!(is_disturbed(&upright, true) && !is_disturbed(&upright, false));
        let half = 0.3_f64.asin() / 2.0;
        let tilted = BaseMotion::new(&[0.0, 0.0, 0.8, half.cos(), half.sin(), 0.0, 0.0], &[0.0; 6], 0.0);
        assert!(is_disturbed(&tilted, false));
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
