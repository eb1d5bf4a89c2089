//! Settings of the randomisation of episodes.

use crate::{is_range, section};

section! {
    /// Randomisation of training episodes, so that the policy does not depend on exact values. A range is [smallest,
    /// largest]; by default nothing is randomised.
    RandomisationConfig as "randomisation" {
        /// Factor on the mass and inertia of each body.
        mass_scale: [f64; 2] = [1.0, 1.0], "[smallest, largest], 0.1 to 10" => |v| is_range(v, 0.1, 10.0);
        /// Factor on the friction coefficients of the floor and between limbs.
        floor_friction_scale: [f64; 2] = [1.0, 1.0], "[smallest, largest], 0 to 10" => |v| is_range(v, 0.0, 10.0);
        /// Factor on the torque of each motor.
        motor_scale: [f64; 2] = [1.0, 1.0], "[smallest, largest], 0 to 10" => |v| is_range(v, 0.0, 10.0);
        /// Factor on the stiffness (kp) of each servo.
        kp_scale: [f64; 2] = [1.0, 1.0], "[smallest, largest], 0 to 10" => |v| is_range(v, 0.0, 10.0);
        /// Factor on the damping (kd) of each servo.
        kd_scale: [f64; 2] = [1.0, 1.0], "[smallest, largest], 0 to 10" => |v| is_range(v, 0.0, 10.0);
        /// Largest offset of the root body's centre of mass along each of its axes (m).
        com_offset_m: f64 = 0.0, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Factor on the viscous friction of each hinge.
        damping_scale: [f64; 2] = [1.0, 1.0], "[smallest, largest], 0 to 10" => |v| is_range(v, 0.0, 10.0);
        /// Factor on the rotor inertia of each hinge.
        armature_scale: [f64; 2] = [1.0, 1.0], "[smallest, largest], 0 to 10" => |v| is_range(v, 0.0, 10.0);
        /// Factor on gravity.
        gravity_scale: [f64; 2] = [1.0, 1.0], "[smallest, largest], 0 to 10" => |v| is_range(v, 0.0, 10.0);
        /// Standard deviation of the noise on observed height (m), orientation (rad about each axis) and hinge angles (rad).
        /// All that is observed is computed from the noisy numbers.
        sensor_noise_position: f64 = 0.0, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Standard deviation of the noise on observed velocities (m/s, rad/s), likewise.
        sensor_noise_velocity: f64 = 0.0, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Largest constant error of each encoder in an episode (rad), which the velocity task observes.
        encoder_bias_rad: f64 = 0.0, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Standard deviation of the noise on each control, as a fraction of the largest control.
        control_noise: f64 = 0.0, "0 to 1" => |v| (0.0..=1.0).contains(v);
        /// Control steps until an action reaches the motors; constant during an episode.
        action_delay_steps: [u32; 2] = [0, 0], "[smallest, largest], 0 to 3"
            => |v| v[0] <= v[1] && v[1] <= RandomisationConfig::DELAY_MAX_STEPS;
        /// Seconds between two pushes, and before the first of an episode.
        push_interval_s: [f64; 2] = [2.0, 5.0], "[smallest, largest], env.control_step_s to 1000"
            => |v| is_range(v, 0.0, 1000.0);
        /// Velocity in m/s that a push adds to the whole body in a random horizontal direction; 0 disables pushes.
        push_mps: [f64; 2] = [0.0, 0.0], "[smallest, largest], 0 to 10" => |v| is_range(v, 0.0, 10.0);
    }
}

impl RandomisationConfig {
    /// Longest delay of an action (control steps).
    pub const DELAY_MAX_STEPS: u32 = 3;

    /// Returns whether anything is randomised.
    #[must_use]
    pub fn is_on(&self) -> bool {
        let off = Self { push_interval_s: self.push_interval_s, ..Self::default() };
        *self != off
    }

    /// Returns whether observations have noise.
    #[must_use]
    pub fn has_sensor_noise(&self) -> bool {
        self.sensor_noise_position > 0.0 || self.sensor_noise_velocity > 0.0
    }
}
