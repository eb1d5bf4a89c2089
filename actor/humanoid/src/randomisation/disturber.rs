//! Randomisation at work: what one episode's body is, and what happens to its actions and observations.

use std::f64::consts::TAU;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use rand::{Rng, RngExt};
use rand_distr::{Distribution, StandardNormal};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::{Randomisation, stream};
use crate::config::CONTROL_STEP_S;
use crate::model::Model;
use crate::observation::Observation;
use crate::physics::{Physics, Variation};

/// Where the torso's quaternion stands in an observation, counted from the height; hinge angles and then velocities
/// follow.
const QUATERNION: std::ops::Range<usize> = 1..5;

/// Disturbs one environment; does nothing at all, and draws nothing, where nothing is randomised.
///
/// It allocates only when it is made.
#[derive(Clone)]
pub(crate) struct Disturber {
    settings: Randomisation,
    is_on: bool,
    variation: Variation,
    /// Where an observation has the height of the torso.
    height_at: usize,
    /// Entries of an observation from there on that are positions; as many velocities as the model has follow them.
    positions: usize,
    velocities: usize,
    /// Half of each motor's range of controls.
    half_ranges: Vec<f64>,
    /// The last actions, `[delay + 1][motor]`, as a ring.
    past: Vec<f32>,
    /// Place of the newest action in `past`.
    newest: usize,
    delay_steps: usize,
    acting: Vec<f32>,
    steps_to_push: u32,
    sensors: Xoshiro256PlusPlus,
    motors: Xoshiro256PlusPlus,
    pushes: Xoshiro256PlusPlus,
}

impl Disturber {
    /// One for a model and what is observed of it, with ranges that are checked; [`Self::begin_episode`] comes before
    /// anything else.
    pub(crate) fn new(settings: &Randomisation, model: &Model, observation: &Observation) -> Self {
        let slots = settings.action_delay_steps[1] as usize + 1;
        Self {
            is_on: settings.is_on(),
            settings: settings.clone(),
            variation: Variation::none(model),
            height_at: observation.height_at(),
            positions: model.position_size() - 2,
            velocities: model.velocity_size(),
            half_ranges: model.motors.iter().map(|motor| motor.control[1] / 2.0 - motor.control[0] / 2.0).collect(),
            past: vec![0.0; slots * model.motors.len()],
            newest: 0,
            delay_steps: 0,
            acting: vec![0.0; model.motors.len()],
            steps_to_push: 0,
            sensors: stream(0, "sensors"),
            motors: stream(0, "motors"),
            pushes: stream(0, "pushes"),
        }
    }

    /// Draws an episode from its seed. The body's figures take effect when the body is placed.
    pub(crate) fn begin_episode(&mut self, seed: u64, physics: &mut Physics) {
        if !self.is_on {
            return;
        }
        let (settings, body) = (&self.settings, &mut self.variation);
        uniform_each(seed, "mass", settings.mass_scale, &mut body.mass_scale);
        uniform_each(seed, "motor", settings.motor_scale, &mut body.motor_scale);
        uniform_each(seed, "damping", settings.damping_scale, &mut body.damping_scale);
        uniform_each(seed, "armature", settings.armature_scale, &mut body.armature_scale);
        body.floor_friction_scale = uniform(&mut stream(seed, "floor-friction"), settings.floor_friction_scale);
        body.gravity_scale = uniform(&mut stream(seed, "gravity"), settings.gravity_scale);
        physics.set_variation(body);

        let [delay_min, delay_max] = settings.action_delay_steps;
        self.delay_steps = stream(seed, "delay").random_range(delay_min..=delay_max) as usize;
        self.past.fill(0.0);
        self.newest = 0;
        self.sensors = stream(seed, "sensors");
        self.motors = stream(seed, "motors");
        self.pushes = stream(seed, "pushes");
        self.schedule_push();
    }

    /// Numbers that [`Self::progress`] tells of past actions.
    pub(crate) fn past_size(&self) -> usize {
        self.past.len()
    }

    /// What has changed since the episode began: the past actions with the newest last, steps to the next push, and
    /// the streams of sensors, motors and pushes.
    pub(crate) fn progress(&self) -> (Vec<f32>, u32, [Xoshiro256PlusPlus; 3]) {
        let oldest = (self.newest + 1) * self.acting.len();
        let past = [&self.past[oldest..], &self.past[..oldest]].concat();
        (past, self.steps_to_push, [self.sensors.clone(), self.motors.clone(), self.pushes.clone()])
    }

    /// Goes on from such progress, after [`Self::begin_episode`] with the same seed.
    pub(crate) fn go_on(&mut self, past: &[f32], steps_to_push: u32, streams: &[Xoshiro256PlusPlus; 3]) {
        self.past.copy_from_slice(past);
        self.newest = self.settings.action_delay_steps[1] as usize;
        self.steps_to_push = steps_to_push;
        let [sensors, motors, pushes] = streams;
        self.sensors.clone_from(sensors);
        self.motors.clone_from(motors);
        self.pushes.clone_from(pushes);
    }

    fn schedule_push(&mut self) {
        let interval_s = uniform(&mut self.pushes, self.settings.push_interval_s);
        self.steps_to_push = (interval_s / CONTROL_STEP_S).round().max(1.0) as u32;
    }

    /// The velocity (m/s, world frame) that a push adds before this control step, if one is due; called once a step.
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
        // The step that this push precedes is the first of the next interval.
        self.steps_to_push -= 1;
        Some(Vector3::new(speed_mps * cos, speed_mps * sin, 0.0))
    }

    /// What reaches the motors in this control step when the policy says `controls`: an earlier action where there
    /// is delay (none moves the motors before the first arrives), with noise. Called once a step.
    pub(crate) fn act<'a>(&'a mut self, controls: &'a [f32]) -> &'a [f32] {
        let size = controls.len();
        let slots = self.settings.action_delay_steps[1] as usize + 1;
        if slots == 1 && self.settings.control_noise == 0.0 {
            return controls;
        }
        self.newest = (self.newest + 1) % slots;
        self.past[self.newest * size..][..size].copy_from_slice(controls);
        let arriving = (self.newest + slots - self.delay_steps) % slots;
        self.acting.copy_from_slice(&self.past[arriving * size..][..size]);
        if self.settings.control_noise > 0.0 {
            for (control, half_range) in self.acting.iter_mut().zip(&self.half_ranges) {
                let std = self.settings.control_noise * half_range;
                *control += (std * normal(&mut self.motors)) as f32;
            }
        }
        &self.acting
    }

    /// Puts sensor noise on the positions and velocities with which an observation begins, but for x and y. What an
    /// observation holds beyond them is left as it is.
    pub(crate) fn corrupt(&mut self, observation: &mut [f32]) {
        let observation = &mut observation[self.height_at..];
        let std = self.settings.sensor_noise_position;
        if std > 0.0 {
            let height = 0..QUATERNION.start;
            for index in height.chain(QUATERNION.end..self.positions) {
                observation[index] += (std * normal(&mut self.sensors)) as f32;
            }
            let turn = Vector3::from_fn(|_, _| std * normal(&mut self.sensors));
            rotate(&mut observation[QUATERNION], turn);
        }
        let std = self.settings.sensor_noise_velocity;
        if std > 0.0 {
            for entry in &mut observation[self.positions..][..self.velocities] {
                *entry += (std * normal(&mut self.sensors)) as f32;
            }
        }
    }
}

/// Turns a quaternion w, x, y, z by a rotation vector (rad) in the body's own frame; its sign stays near what it was.
fn rotate(entries: &mut [f32], turn_rad: Vector3<f64>) {
    let [w, x, y, z] = [0, 1, 2, 3].map(|index| f64::from(entries[index]));
    let turned = Quaternion::new(w, x, y, z) * UnitQuaternion::from_scaled_axis(turn_rad).into_inner();
    for (entry, part) in entries.iter_mut().zip([turned.w, turned.i, turned.j, turned.k]) {
        *entry = part as f32;
    }
}

/// A number from [low, high].
fn uniform(random: &mut impl Rng, [low, high]: [f64; 2]) -> f64 {
    low + (high - low) * random.random::<f64>()
}

fn uniform_each(seed: u64, name: &str, range: [f64; 2], numbers: &mut [f64]) {
    let mut random = stream(seed, name);
    numbers.fill_with(|| uniform(&mut random, range));
}

fn normal(random: &mut impl Rng) -> f64 {
    StandardNormal.sample(random)
}
