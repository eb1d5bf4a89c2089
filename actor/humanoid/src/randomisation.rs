//! Randomisation of one episode: variation of the model, sensor and motor noise, action delay, pushes.
//!
//! The episode's seed determines all draws. Each quantity has its own random stream, so switching one on or off does not
//! change the others.

use std::f64::consts::TAU;

use nalgebra::Vector3;
use rand::{Rng, RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;

use crate::config::{EnvironmentConfig, RandomisationConfig};
use crate::model::Model;
use crate::physics::{Physics, Variation};

/// Noise of the sensors throughout an episode.
pub struct SensorNoise {
    position_std: f64,
    velocity_std: f64,
    random: Xoshiro256PlusPlus,
}

impl SensorNoise {
    /// Returns exact sensors.
    #[must_use]
    pub fn none() -> Self {
        Self { position_std: 0.0, velocity_std: 0.0, random: stream(0, "sensors") }
    }

    /// Returns whether the sensors are exact.
    #[must_use]
    pub fn is_off(&self) -> bool {
        !(self.has_positions() || self.has_velocities())
    }

    /// Returns whether positions and angles have noise.
    #[must_use]
    pub fn has_positions(&self) -> bool {
        self.position_std > 0.0
    }

    /// Returns whether velocities have noise.
    #[must_use]
    pub fn has_velocities(&self) -> bool {
        self.velocity_std > 0.0
    }

    /// Draws the error of one position (m) or angle (rad).
    pub fn position(&mut self) -> f64 {
        self.position_std * normal(&mut self.random)
    }

    /// Draws the error of one velocity (m/s or rad/s).
    pub fn velocity(&mut self) -> f64 {
        self.velocity_std * normal(&mut self.random)
    }
}

/// Randomises one environment; draws nothing if nothing is randomised. Only [`Self::new`] allocates.
pub(crate) struct Randomiser {
    settings: RandomisationConfig,
    control_step_s: f64,
    is_on: bool,
    variation: Variation,
    /// Half of each motor's range of controls, and its middle.
    half_ranges: Vec<f64>,
    middles: Vec<f32>,
    /// Ring buffer of the last actions, `[delay + 1][motor]`.
    past: Vec<f32>,
    /// Index of the newest action in `past`.
    newest: usize,
    delay_steps: usize,
    /// Controls that reach the motors.
    delayed: Vec<f32>,
    steps_to_push: u32,
    sensors: SensorNoise,
    motors: Xoshiro256PlusPlus,
    pushes: Xoshiro256PlusPlus,
}

impl Randomiser {
    /// Takes checked settings and a model; [`Self::begin_episode`] must precede all other calls.
    pub(crate) fn new(config: &EnvironmentConfig, model: &Model) -> Self {
        let settings = &config.randomisation;
        let slots = settings.action_delay_steps[1] as usize + 1;
        Self {
            is_on: settings.is_on(),
            settings: settings.clone(),
            control_step_s: config.env.control_step_s,
            variation: Variation::none(model),
            half_ranges: model.motors.iter().map(|motor| motor.control[1] / 2.0 - motor.control[0] / 2.0).collect(),
            middles: model
                .motors
                .iter()
                .map(|motor| f64::midpoint(motor.control[0], motor.control[1]) as f32)
                .collect(),
            past: vec![0.0; slots * model.motors.len()],
            newest: 0,
            delay_steps: 0,
            delayed: vec![0.0; model.motors.len()],
            steps_to_push: 0,
            sensors: SensorNoise {
                position_std: settings.sensor_noise_position,
                velocity_std: settings.sensor_noise_velocity,
                random: stream(0, "sensors"),
            },
            motors: stream(0, "motors"),
            pushes: stream(0, "pushes"),
        }
    }

    /// Draws an episode from its seed. The variation takes effect at the next [`Physics::set_state`].
    pub(crate) fn begin_episode(&mut self, seed: u64, physics: &mut Physics) {
        if !self.is_on {
            return;
        }
        let (settings, variation) = (&self.settings, &mut self.variation);
        uniform_each(seed, "mass", settings.mass_scale, &mut variation.mass_scale);
        uniform_each(seed, "motor", settings.motor_scale, &mut variation.motor_scale);
        uniform_each(seed, "kp", settings.kp_scale, &mut variation.kp_scale);
        uniform_each(seed, "kd", settings.kd_scale, &mut variation.kd_scale);
        let offset_m = settings.com_offset_m;
        uniform_each(seed, "com", [-offset_m, offset_m], variation.root_centre_offset_m.as_mut_slice());
        uniform_each(seed, "damping", settings.damping_scale, &mut variation.damping_scale);
        uniform_each(seed, "armature", settings.armature_scale, &mut variation.armature_scale);
        variation.floor_friction_scale = uniform(&mut stream(seed, "floor-friction"), settings.floor_friction_scale);
        variation.gravity_scale = uniform(&mut stream(seed, "gravity"), settings.gravity_scale);
        physics.set_variation(variation);

        let [delay_min, delay_max] = settings.action_delay_steps;
        self.delay_steps = stream(seed, "delay").random_range(delay_min..=delay_max) as usize;
        self.past.chunks_exact_mut(self.middles.len()).for_each(|action| action.copy_from_slice(&self.middles));
        self.newest = 0;
        self.sensors.random = stream(seed, "sensors");
        self.motors = stream(seed, "motors");
        self.pushes = stream(seed, "pushes");
        self.schedule_push();
    }

    /// Returns the length of the past actions in [`Self::progress`].
    pub(crate) fn past_size(&self) -> usize {
        self.past.len()
    }

    /// Returns what has changed since the episode began: past actions (newest last), steps until the next push, and the
    /// streams of sensors, motors and pushes.
    pub(crate) fn progress(&self) -> (Vec<f32>, u32, [Xoshiro256PlusPlus; 3]) {
        let oldest = (self.newest + 1) * self.delayed.len();
        let past = [&self.past[oldest..], &self.past[..oldest]].concat();
        (past, self.steps_to_push, [self.sensors.random.clone(), self.motors.clone(), self.pushes.clone()])
    }

    /// Restores the state of [`Self::progress`], after [`Self::begin_episode`] with the same seed.
    pub(crate) fn resume(&mut self, past: &[f32], steps_to_push: u32, streams: &[Xoshiro256PlusPlus; 3]) {
        self.past.copy_from_slice(past);
        self.newest = self.settings.action_delay_steps[1] as usize;
        self.steps_to_push = steps_to_push;
        let [sensors, motors, pushes] = streams;
        self.sensors.random.clone_from(sensors);
        self.motors.clone_from(motors);
        self.pushes.clone_from(pushes);
    }

    fn schedule_push(&mut self) {
        let interval_s = uniform(&mut self.pushes, self.settings.push_interval_s);
        self.steps_to_push = (interval_s / self.control_step_s).round().max(1.0) as u32;
    }

    /// Returns the velocity (m/s, world frame) that a push adds before this control step, if one is due. Called once per
    /// step.
    pub(crate) fn due_push(&mut self) -> Option<Vector3<f64>> {
        if self.settings.push_mps[1] <= 0.0 {
            return None;
        }
        if self.steps_to_push > 0 {
            self.steps_to_push -= 1;
            return None;
        }
        let speed_mps = uniform(&mut self.pushes, self.settings.push_mps);
        let (sin, cos) = uniform(&mut self.pushes, [0.0, TAU]).sin_cos();
        self.schedule_push();
        // The step after this push is the first of the next interval.
        self.steps_to_push -= 1;
        Some(Vector3::new(speed_mps * cos, speed_mps * sin, 0.0))
    }

    /// Returns the controls that reach the motors in this control step: the delayed action (middle of the ranges before
    /// the first one arrives), with noise. `controls` is the policy's action of this step. Called once per step.
    pub(crate) fn controls_reaching_motors<'a>(&'a mut self, controls: &'a [f32]) -> &'a [f32] {
        let size = controls.len();
        let slots = self.settings.action_delay_steps[1] as usize + 1;
        if slots == 1 && self.settings.control_noise == 0.0 {
            return controls;
        }
        self.newest = (self.newest + 1) % slots;
        self.past[self.newest * size..][..size].copy_from_slice(controls);
        let arriving = (self.newest + slots - self.delay_steps) % slots;
        self.delayed.copy_from_slice(&self.past[arriving * size..][..size]);
        if self.settings.control_noise > 0.0 {
            for (control, half_range) in self.delayed.iter_mut().zip(&self.half_ranges) {
                let std = self.settings.control_noise * half_range;
                *control += (std * normal(&mut self.motors)) as f32;
            }
        }
        &self.delayed
    }

    /// Returns the noise of the sensors.
    pub(crate) fn sensors(&mut self) -> &mut SensorNoise {
        &mut self.sensors
    }
}

/// Draws a number from [low, high].
pub(crate) fn uniform(random: &mut impl Rng, [low, high]: [f64; 2]) -> f64 {
    low + (high - low) * random.random::<f64>()
}

fn uniform_each(seed: u64, name: &str, range: [f64; 2], numbers: &mut [f64]) {
    let mut random = stream(seed, name);
    numbers.fill_with(|| uniform(&mut random, range));
}

fn normal(random: &mut impl Rng) -> f64 {
    StandardNormal.sample(random)
}

/// Returns the random stream `name` of an episode. The reset's noise uses the seed without a name, so it does not depend on
/// what is randomised.
pub(crate) fn stream(episode_seed: u64, name: &str) -> Xoshiro256PlusPlus {
    // FNV-1a (Fowler, Noll, Vo; 64 bits) distinguishes the names; the generator's seeding mixes the result.
    let hash = name
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
    Xoshiro256PlusPlus::seed_from_u64(episode_seed ^ hash)
}
