//! What differs from episode to episode, so that a policy comes to depend on none of it: the body's figures, the
//! floor, what sensors and motors do, and pushes.
//!
//! Everything is drawn from the episode's seed, each quantity from a stream of its own: switching one on or off
//! changes no other, and no episode knows of the one before.

mod disturber;

use rand::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

pub(crate) use self::disturber::Disturber;
use crate::config::CONTROL_STEP_S;
use crate::error::ModelError;

/// Ranges are smallest and largest value, equally likely in between; by default nothing is randomised.
#[derive(Clone, Debug, PartialEq)]
pub struct Randomisation {
    /// Factor on the mass and inertia of each body.
    pub mass_scale: [f64; 2],
    /// Factor on the friction coefficient of the floor.
    pub floor_friction_scale: [f64; 2],
    /// Factor on the torque of each motor.
    pub motor_scale: [f64; 2],
    /// Factor on the viscous friction of each hinge.
    pub damping_scale: [f64; 2],
    /// Factor on the rotor inertia of each hinge.
    pub armature_scale: [f64; 2],
    /// Factor on gravity.
    pub gravity_scale: [f64; 2],
    /// Standard deviation of the noise on observed height (m), orientation (rad about each axis) and hinge angles (rad).
    pub sensor_noise_position: f64,
    /// Standard deviation of the noise on observed velocities (m/s, rad/s).
    pub sensor_noise_velocity: f64,
    /// Standard deviation of the noise on each control, as a share of the largest control.
    pub control_noise: f64,
    /// Control steps after which an action reaches the motors, the same throughout an episode.
    pub action_delay_steps: [u32; 2],
    /// Time from one push to the next, and from the start to the first (s).
    pub push_interval_s: [f64; 2],
    /// Velocity that a push adds to the whole body, in any horizontal direction (m/s); 0 means no pushes.
    pub push_mps: [f64; 2],
}

impl Default for Randomisation {
    fn default() -> Self {
        const SAME: [f64; 2] = [1.0, 1.0];
        Self {
            mass_scale: SAME,
            floor_friction_scale: SAME,
            motor_scale: SAME,
            damping_scale: SAME,
            armature_scale: SAME,
            gravity_scale: SAME,
            sensor_noise_position: 0.0,
            sensor_noise_velocity: 0.0,
            control_noise: 0.0,
            action_delay_steps: [0, 0],
            push_interval_s: [2.0, 5.0],
            push_mps: [0.0, 0.0],
        }
    }
}

impl Randomisation {
    /// Longest delay of an action (control steps).
    pub const DELAY_MAX_STEPS: u32 = 3;

    /// Whether anything is randomised.
    #[must_use]
    pub fn is_on(&self) -> bool {
        let off = Self { push_interval_s: self.push_interval_s, ..Self::default() };
        *self != off
    }

    /// Refuses ranges that are none or reach too far.
    pub(crate) fn check(&self) -> Result<(), ModelError> {
        let refuse =
            |setting, value: f64, expected| Err(ModelError::Setting { setting, value: value.to_string(), expected });
        let factors = "between 0 and 10, and the first of the range not above the second";
        let delays = self.action_delay_steps.map(f64::from);
        for (setting, [low, high], [min, max], expected) in [
            // A body without mass would be held by nothing.
            ("mass_scale", self.mass_scale, [0.1, 10.0], "between 0.1 and 10, the first not above the second"),
            ("floor_friction_scale", self.floor_friction_scale, [0.0, 10.0], factors),
            ("motor_scale", self.motor_scale, [0.0, 10.0], factors),
            ("damping_scale", self.damping_scale, [0.0, 10.0], factors),
            ("armature_scale", self.armature_scale, [0.0, 10.0], factors),
            ("gravity_scale", self.gravity_scale, [0.0, 10.0], factors),
            ("action_delay_steps", delays, [0.0, 3.0], "between 0 and 3, the first not above the second"),
            (
                "push_interval_s",
                self.push_interval_s,
                [CONTROL_STEP_S, 1000.0],
                "between one control step and 1000 s, the first not above the second",
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
            ("control_noise", self.control_noise),
        ] {
            if !(0.0..=1.0).contains(&value) {
                return refuse(setting, value, "between 0 and 1");
            }
        }
        Ok(())
    }
}

/// The stream `name` of an episode. The noise of the reset is the one without a name: it stays the same whatever is
/// randomised.
fn stream(episode_seed: u64, name: &str) -> Xoshiro256PlusPlus {
    // FNV-1a (Fowler, Noll, Vo; 64 bits) tells the names apart; the generator's own start-up mixes the sum.
    let hash = name
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
    Xoshiro256PlusPlus::seed_from_u64(episode_seed ^ hash)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_on_by_default_and_each_range_switches_it_on() {
        assert!(!Randomisation::default().is_on());
        assert!(Randomisation::default().check().is_ok());
        assert!(!Randomisation { push_interval_s: [1.0, 1.0], ..Randomisation::default() }.is_on());
        type Change = fn(&mut Randomisation);
        let changes: [Change; 11] = [
            |r| r.mass_scale = [0.9, 1.1],
            |r| r.floor_friction_scale = [0.0, 1.0],
            |r| r.motor_scale = [1.0, 1.2],
            |r| r.damping_scale = [2.0, 2.0],
            |r| r.armature_scale = [0.5, 1.0],
            |r| r.gravity_scale = [0.9, 1.0],
            |r| r.sensor_noise_position = 0.01,
            |r| r.sensor_noise_velocity = 0.01,
            |r| r.control_noise = 0.1,
            |r| r.action_delay_steps = [0, 3],
            |r| r.push_mps = [0.0, 0.5],
        ];
        for (index, change) in changes.into_iter().enumerate() {
            let mut settings = Randomisation::default();
            change(&mut settings);
            assert!(settings.is_on() && settings.check().is_ok(), "change {index}");
        }
    }

    #[test]
    fn ranges_that_are_none_are_refused_by_name() {
        type Spoil = fn(&mut Randomisation);
        let broken: [(&str, Spoil); 9] = [
            ("mass_scale", |r| r.mass_scale = [0.0, 1.0]),
            ("floor_friction_scale", |r| r.floor_friction_scale = [1.5, 0.5]),
            ("motor_scale", |r| r.motor_scale = [1.0, f64::NAN]),
            ("gravity_scale", |r| r.gravity_scale = [f64::NEG_INFINITY, 1.0]),
            ("sensor_noise_velocity", |r| r.sensor_noise_velocity = -0.1),
            ("control_noise", |r| r.control_noise = f64::NAN),
            ("action_delay_steps", |r| r.action_delay_steps = [0, Randomisation::DELAY_MAX_STEPS + 1]),
            ("push_interval_s", |r| r.push_interval_s = [0.0, 1.0]),
            ("push_mps", |r| r.push_mps = [0.0, 11.0]),
        ];
        for (name, spoil) in broken {
            let mut settings = Randomisation::default();
            spoil(&mut settings);
            let error = settings.check().expect_err(name).to_string();
            assert!(error.contains(name), "{error}");
        }
    }
}
