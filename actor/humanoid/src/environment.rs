//! One humanoid's episodes: reset, step, observation, faults.

mod saved;
mod start;
mod vector;

use std::any::Any;

use nalgebra::Point3;
use rand::{Rng, RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

pub use self::saved::EpisodeState;
use self::start::start;
pub use self::vector::{EnvironmentPass, Slot, VectorEnvironment};
use crate::clearance;
use crate::config::{ChosenTask, EnvironmentConfig};
use crate::error::{InputError, ModelError};
use crate::info::StepInfo;
use crate::model::Model;
use crate::physics::Physics;
use crate::randomisation::{Randomiser, SensorNoise};
use crate::task::{EpisodeStart, HumanoidTask, ObservationTerm, Reached, Step, StepOutcome, Task, TaskRegistry};
use crate::terrain;

/// Reinforcement-learning environment of one humanoid.
///
/// The same seed and actions give the same observations and rewards, bit for bit, regardless of earlier episodes. That
/// includes [`EnvironmentConfig::randomisation`], but no curriculum, see [`Task::start`]. [`Self::step`] does not allocate.
pub struct Environment {
    config: EnvironmentConfig,
    physics: Physics,
    task: Box<dyn Task>,
    randomiser: Randomiser,
    /// Seed of the episode; none before the first reset.
    seed: Option<u64>,
    /// State at which episodes start, without noise.
    nominal_position: Vec<f64>,
    nominal_velocity: Vec<f64>,
    /// Height of its lowest part above the ground (m), if episodes start with that, see [`Task::starts_on_ground`].
    nominal_clearance_m: Option<f64>,
    /// Buffers of the reset: position and velocity vectors with noise.
    start_position: Vec<f64>,
    start_velocity: Vec<f64>,
    controls: Vec<f32>,
    /// Action of the step, as given.
    action: Vec<f32>,
    /// Centre of mass before the step (m).
    centre_before: Point3<f64>,
    /// Lowest and highest control of each motor.
    action_ranges: Vec<[f32; 2]>,
    /// Last observation; a fault returns it again.
    last_observation: Vec<f32>,
    /// Info of the last sound step or reset, if the task is one of Gymnasium's.
    last_info: Option<StepInfo>,
    episode_steps: u32,
    was_pushed: bool,
}

impl Environment {
    /// Builds an environment with a built-in task for a model text (see [`Model::from_mjcf`]), in the nominal pose.
    ///
    /// # Errors
    /// [`ModelError`] if the model or a setting cannot be simulated.
    pub fn new(config: &EnvironmentConfig, model_xml: &str) -> Result<Self, ModelError> {
        Self::with_tasks(config, model_xml, &TaskRegistry::default())
    }

    /// As [`Self::new`], also for the tasks of a program.
    ///
    /// # Errors
    /// [`ModelError`] if the model or a setting cannot be simulated, or there is no such task.
    pub fn with_tasks(config: &EnvironmentConfig, model_xml: &str, tasks: &TaskRegistry) -> Result<Self, ModelError> {
        let mut model = Model::from_mjcf(model_xml)?;
        config.check()?;
        if !config.ground.kinds.is_empty() {
            model.ground.height_field = Some(terrain::generated(&config.ground)?);
        }
        let (nominal_position, nominal_velocity) = start(&model, &config.env.keyframe)?;
        let mut physics = Physics::new(model, config)?;
        physics.set_state(&nominal_position, &nominal_velocity);
        let action_size = physics.model().motors.len();
        let mut task = tasks.build(config, &physics)?;
        let mut last_observation = vec![0.0; task.terms().last().map_or(0, |term| term.range.end)];
        // The default pose stands on ground at height 0, not on the middle of the generated ground.
        let is_generated = !config.ground.kinds.is_empty();
        let ground_m = |x_m, y_m| if is_generated { 0.0 } else { physics.ground_height_m(x_m, y_m) };
        let nominal_clearance_m = clearance::of_robot_m(&physics, ground_m).filter(|_| task.starts_on_ground());
        task.begin(0, &physics);
        task.observe(&physics, &mut SensorNoise::none(), &mut last_observation);
        let mut config = config.clone();
        if config.env.chosen_task() == ChosenTask::Motion && !config.has_curricula {
            // An episode outside of training ends with its motion.
            config.env.max_episode_steps = 0;
        }
        Ok(Self {
            seed: None,
            randomiser: Randomiser::new(&config, physics.model()),
            start_position: nominal_position.clone(),
            start_velocity: vec![0.0; physics.model().velocity_size()],
            controls: vec![0.0; action_size],
            action_ranges: physics.model().motors.iter().map(|motor| motor.control.map(|end| end as f32)).collect(),
            last_info: gymnasium_info(&*task),
            config,
            task,
            nominal_position,
            nominal_velocity,
            nominal_clearance_m,
            last_observation,
            physics,
            action: vec![0.0; action_size],
            centre_before: Point3::origin(),
            episode_steps: 0,
            was_pushed: false,
        })
    }

    /// Returns the length of an observation.
    #[must_use]
    pub fn observation_size(&self) -> usize {
        self.last_observation.len()
    }

    /// Returns the length of an action.
    #[must_use]
    pub fn action_size(&self) -> usize {
        self.controls.len()
    }

    /// Returns the duration of one step (s).
    #[must_use]
    pub fn control_step_s(&self) -> f64 {
        self.config.env.control_step_s
    }

    /// Returns the duration of the longest episode (s); infinite if none ends by time.
    #[must_use]
    pub fn episode_s(&self) -> f64 {
        match self.config.env.max_episode_steps {
            0 => f64::INFINITY,
            steps => f64::from(steps) * self.control_step_s(),
        }
    }

    /// Returns the lowest and highest control of each motor (units of control); motors receive actions clamped to them.
    #[must_use]
    pub fn action_ranges(&self) -> &[[f32; 2]] {
        &self.action_ranges
    }

    /// Maps shares of each motor's control range to an action: −1 is the lower end, 1 the upper one. Clamps the shares.
    ///
    /// # Panics
    /// If a slice does not have length [`Self::action_size`].
    pub fn action_from_shares(&self, shares: &[f32], action: &mut [f32]) {
        assert_eq!(shares.len(), self.action_ranges.len(), "there must be one share per motor");
        assert_eq!(action.len(), self.action_ranges.len(), "action has the wrong length");
        for (action, (share, [low, high])) in action.iter_mut().zip(shares.iter().zip(&self.action_ranges)) {
            let (centre, half) = (f32::midpoint(*low, *high), high / 2.0 - low / 2.0);
            *action = (centre + share.clamp(-1.0, 1.0) * half).clamp(*low, *high);
        }
    }

    /// Starts a new episode and writes its first observation; `seed` determines all its random numbers.
    ///
    /// # Panics
    /// If `observation` does not have length [`Self::observation_size`].
    pub fn reset(&mut self, seed: u64, observation: &mut [f32]) {
        self.check_observation(observation).unwrap_or_else(|why| panic!("{why}"));
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let scale = self.config.env.reset_noise_scale;
        for (start, nominal) in self.start_position.iter_mut().zip(&self.nominal_position) {
            *start = nominal + uniform_noise(&mut random, scale);
        }
        for (start, nominal) in self.start_velocity.iter_mut().zip(&self.nominal_velocity) {
            *start = nominal + uniform_noise(&mut random, scale);
        }
        let start = EpisodeStart { position: &mut self.start_position, velocity: &mut self.start_velocity };
        self.task.start(seed, &self.physics, start);
        self.seed = Some(seed);
        self.randomiser.begin_episode(seed, &mut self.physics);
        // `set_state` normalises the noisy quaternion.
        self.physics.set_state(&self.start_position, &self.start_velocity);
        let stays_above = self.task.stays_above_ground().then_some(0.0);
        if let Some(nominal_m) = self.nominal_clearance_m.or(stays_above) {
            let ground_m = |x_m, y_m| self.physics.ground_height_m(x_m, y_m);
            let clearance_m = clearance::of_robot_m(&self.physics, ground_m).unwrap_or(nominal_m);
            let lift_m = nominal_m - clearance_m;
            self.start_position[2] += if stays_above.is_some() { lift_m.max(0.0) } else { lift_m };
            self.physics.set_state(&self.start_position, &self.start_velocity);
        }
        self.episode_steps = 0;
        self.was_pushed = false;
        self.task.begin(seed, &self.physics);
        self.last_info = gymnasium_info(&*self.task);
        self.task.observe(&self.physics, self.randomiser.sensors(), observation);
        self.last_observation.copy_from_slice(observation);
    }

    /// Simulates one control step and writes the observation after it.
    ///
    /// `action` has one control per motor, in actuator order. The motors receive it clamped to [`Self::action_ranges`], and
    /// perhaps delayed or disturbed by randomisation; the control cost is always that of `action` as given.
    ///
    /// If the action, the physics, the reward or an entry of the observation is not finite, the step is a fault:
    /// terminated, reward 0, observation and `info` as before. Every further step until [`Self::reset`] is a fault too.
    ///
    /// # Panics
    /// If `action` or `observation` has the wrong length.
    pub fn step(&mut self, action: &[f32], observation: &mut [f32]) -> StepOutcome {
        self.check_lengths(action, observation).unwrap_or_else(|why| panic!("{why}"));
        self.advance(action, observation)
    }

    /// As [`Self::step`], for actions from outside: a non-finite action is an error and does not end the episode.
    ///
    /// # Errors
    /// [`InputError`] if `action` or `observation` has the wrong length, or an entry of `action` is not finite; the episode
    /// is then unchanged.
    pub fn try_step(&mut self, action: &[f32], observation: &mut [f32]) -> Result<StepOutcome, InputError> {
        self.check_lengths(action, observation)?;
        InputError::check_finite("action", action)?;
        Ok(self.advance(action, observation))
    }

    /// Simulates one control step; the slices have the right lengths.
    fn advance(&mut self, action: &[f32], observation: &mut [f32]) -> StepOutcome {
        self.begin_step(action);
        Self::step_together(&mut std::iter::once(&mut *self));
        self.finish_step(observation)
    }

    /// Sets the action of the next step; [`Self::step_together`] and [`Self::finish_step`] must follow. The three do what
    /// [`Self::step`] does, for several environments at once.
    ///
    /// # Panics
    /// If `action` has the wrong length.
    pub fn begin_step(&mut self, action: &[f32]) {
        assert_eq!(action.len(), self.controls.len(), "action has the wrong length");
        self.action.copy_from_slice(action);
        self.task.change_action(&mut self.action);
        for (control, (action, [low, high])) in
            self.controls.iter_mut().zip(self.action.iter().zip(&self.action_ranges))
        {
            *control = action.clamp(*low, *high);
        }
        let push_mps = self.randomiser.due_push();
        self.was_pushed = push_mps.is_some();
        if let Some(velocity_mps) = push_mps {
            self.physics.push(velocity_mps);
        }
        self.centre_before = self.physics.centre_of_mass();
        self.episode_steps = self.episode_steps.saturating_add(1);
        // Physics rejects a non-finite action, which neither clamping nor a delay may hide.
        let is_finite = action.iter().all(|control| control.is_finite());
        let controls = if is_finite { self.randomiser.controls_reaching_motors(&self.controls) } else { action };
        // A fault shows when the step ends.
        let _ = self.physics.set_controls(controls);
    }

    /// Simulates the begun step of several environments with the same model and settings. The result of each is the
    /// same, bit for bit, as if it had stepped alone; the machine simulates [`crate::worlds_per_pass`] of them at once.
    pub fn step_together(environments: &mut dyn Iterator<Item = &mut Self>) {
        Physics::step_together(&mut environments.map(|environment| &mut environment.physics));
    }

    /// Writes the observation after a step and returns its outcome.
    ///
    /// # Panics
    /// If `observation` has the wrong length.
    pub fn finish_step(&mut self, observation: &mut [f32]) -> StepOutcome {
        if self.physics.check_step().is_err() {
            return self.fault(observation);
        }
        let step = Step { physics: &self.physics, action: &self.action, centre_before_m: self.centre_before };
        let mut evaluated = self.task.evaluate(&step);
        evaluated.truncated |= !evaluated.terminated && self.physics.is_at_edge();
        let step = evaluated.at(self.episode_steps, self.config.env.max_episode_steps);
        self.task.observe(&self.physics, self.randomiser.sensors(), observation);
        if !(step.reward.is_finite() && observation.iter().all(|number| number.is_finite())) {
            self.physics.declare_faulty();
            return self.fault(observation);
        }
        self.last_observation.copy_from_slice(observation);
        self.last_info = gymnasium_info(&*self.task);
        step
    }

    /// Writes an observation of the present state, without sensor noise.
    ///
    /// # Errors
    /// [`InputError`] if `observation` has the wrong length.
    pub fn observe(&mut self, observation: &mut [f32]) -> Result<(), InputError> {
        self.check_observation(observation)?;
        self.task.observe(&self.physics, &mut SensorNoise::none(), observation);
        Ok(())
    }

    /// Returns the position vector at which episodes start, without noise.
    #[must_use]
    pub fn nominal_position(&self) -> &[f64] {
        &self.nominal_position
    }

    /// Returns the terms of an observation, in order.
    #[must_use]
    pub fn terms(&self) -> &[ObservationTerm] {
        self.task.terms()
    }

    /// Returns the length of the end of an observation that only the critic sees, in training.
    #[must_use]
    pub fn privileged_size(&self) -> usize {
        self.terms().iter().filter(|term| term.is_privileged).map(|term| term.range.len()).sum()
    }

    /// Returns the task.
    #[must_use]
    pub fn task(&self) -> &dyn Task {
        &*self.task
    }

    /// Begins with curricula that other environments have reached, see [`Task::adopt_curricula`]; call [`Self::reset`] next.
    pub fn adopt_curricula(&mut self, reached: &Reached<'_>, seed: u64) {
        self.task.adopt_curricula(reached, seed);
    }

    /// Chooses which of several beginnings the next episodes have, see [`Task::choose_start`]; call [`Self::reset`] next.
    pub fn choose_start(&mut self, number: u64) {
        self.task.choose_start(number);
    }

    /// Replaces the task's commands, see [`Task::steer`].
    pub fn steer(&mut self, command: Option<[f64; 3]>) -> bool {
        self.task.steer(command)
    }

    /// Returns the info of the last step or reset; `None` for tasks other than Gymnasium's.
    #[must_use]
    pub fn info(&self) -> Option<&StepInfo> {
        self.last_info.as_ref()
    }

    /// Truncates episodes after this many control steps; 0 means never.
    #[must_use]
    pub fn with_max_episode_steps(mut self, max_episode_steps: u32) -> Self {
        self.config.env.max_episode_steps = max_episode_steps;
        self
    }

    /// Returns whether a push of the randomisation began the last step; false before the first step of an episode.
    #[must_use]
    pub fn was_pushed(&self) -> bool {
        self.was_pushed
    }

    /// Returns the settings.
    #[must_use]
    pub fn config(&self) -> &EnvironmentConfig {
        &self.config
    }

    fn check_lengths(&self, action: &[f32], observation: &[f32]) -> Result<(), InputError> {
        InputError::check_length("action", action.len(), self.controls.len())?;
        self.check_observation(observation)
    }

    fn check_observation(&self, observation: &[f32]) -> Result<(), InputError> {
        InputError::check_length("observation buffer", observation.len(), self.observation_size())
    }

    fn fault(&self, observation: &mut [f32]) -> StepOutcome {
        observation.copy_from_slice(&self.last_observation);
        StepOutcome { reward: 0.0, terminated: true, truncated: false, fault: true }
    }

    /// Returns the simulation.
    #[must_use]
    pub fn physics(&self) -> &Physics {
        &self.physics
    }

    /// Returns the simulation, mutable, to step it without task and observation or to set its state.
    #[must_use]
    pub fn physics_mut(&mut self) -> &mut Physics {
        &mut self.physics
    }
}

/// Returns the info of a task of Gymnasium's.
fn gymnasium_info(task: &dyn Task) -> Option<StepInfo> {
    let task: &dyn Any = task;
    task.downcast_ref().map(HumanoidTask::info)
}

/// Draws a number from [−scale, scale).
fn uniform_noise(random: &mut impl Rng, scale: f64) -> f64 {
    (2.0 * random.random::<f64>() - 1.0) * scale
}
