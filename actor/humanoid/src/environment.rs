//! One humanoid with its clock: episodes, resets, faults.

mod saved;
mod snapshot;

use rand::{Rng, RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

pub use self::saved::EpisodeState;
pub use self::snapshot::EnvironmentSnapshot;
use crate::config::{CONTROL_STEP_S, EnvironmentConfig};
use crate::error::{InputError, ModelError};
use crate::info::{PerTendon, StepInfo};
use crate::model::{Model, Tendon};
use crate::observation::Observation;
use crate::physics::{JointQuality, Physics};
use crate::randomisation::Disturber;
use crate::task::{self, Step, Transition};

/// A humanoid that is reset, acts, is observed and rewarded.
///
/// The same seed and the same actions give the same observations and rewards, bit for bit, whatever the environment
/// did before: that holds for everything [`EnvironmentConfig::randomisation`] adds, too. It allocates in [`Self::reset`]
/// only.
pub struct Environment {
    config: EnvironmentConfig,
    physics: Physics,
    observation: Observation,
    disturber: Disturber,
    /// Of the episode; none before the first reset.
    seed: Option<u64>,
    nominal_position: Vec<f64>,
    /// Buffers of the reset: positions and velocities with noise.
    start_position: Vec<f64>,
    start_velocity: Vec<f64>,
    controls: Vec<f32>,
    /// Least and greatest control of each motor.
    ranges: Vec<[f32; 2]>,
    /// The last observation handed out, which is handed out again on a fault.
    last_observation: Vec<f32>,
    last_info: StepInfo,
    episode_steps: u32,
    faults: u64,
}

impl Environment {
    /// Builds an environment for a model text (see [`Model::from_mjcf`]); it stands at the nominal pose,
    /// as after a reset without noise.
    ///
    /// # Errors
    /// [`ModelError`] if the model or a setting cannot be simulated.
    pub fn new(config: &EnvironmentConfig, model_xml: &str) -> Result<Self, ModelError> {
        let physics = Physics::new(Model::from_mjcf(model_xml)?, config)?;
        let nominal_position = physics.model().nominal_position();
        let observation = Observation::new(config, physics.model());
        let mut last_observation = vec![0.0; observation.size()];
        observation.write(&physics, &mut last_observation);
        Ok(Self {
            config: config.clone(),
            seed: None,
            disturber: Disturber::new(&config.randomisation, physics.model(), &observation),
            start_position: nominal_position.clone(),
            start_velocity: vec![0.0; physics.model().velocity_size()],
            controls: vec![0.0; physics.model().motors.len()],
            ranges: physics.model().motors.iter().map(|motor| motor.control.map(|end| end as f32)).collect(),
            last_info: standing_info(config, &physics),
            observation,
            nominal_position,
            last_observation,
            physics,
            episode_steps: 0,
            faults: 0,
        })
    }

    /// Length of an observation.
    #[must_use]
    pub fn observation_size(&self) -> usize {
        self.last_observation.len()
    }

    /// Length of an action.
    #[must_use]
    pub fn action_size(&self) -> usize {
        self.controls.len()
    }

    /// Duration of one step (s).
    #[must_use]
    pub fn control_step_s(&self) -> f64 {
        CONTROL_STEP_S
    }

    /// Least and greatest value of each entry of an action, which is clamped to them (units of control).
    #[must_use]
    pub fn action_ranges(&self) -> &[[f32; 2]] {
        &self.ranges
    }

    /// Writes the action that stands at `share` of each motor's range: −1 is its lower end, 1 its upper one. Shares
    /// beyond are clamped.
    ///
    /// # Panics
    /// If a slice does not have length [`Self::action_size`].
    pub fn action_from_shares(&self, shares: &[f32], action: &mut [f32]) {
        assert_eq!(shares.len(), self.ranges.len(), "there must be one share per motor");
        assert_eq!(action.len(), self.ranges.len(), "action has the wrong length");
        for (action, (share, [low, high])) in action.iter_mut().zip(shares.iter().zip(&self.ranges)) {
            let (centre, half) = (f32::midpoint(*low, *high), high / 2.0 - low / 2.0);
            *action = (centre + share.clamp(-1.0, 1.0) * half).clamp(*low, *high);
        }
    }

    /// Starts a new episode of which everything random comes from `seed`, and writes its first observation.
    ///
    /// # Panics
    /// If `observation` does not have length [`Self::observation_size`].
    pub fn reset(&mut self, seed: u64, observation: &mut [f32]) {
        self.try_reset(seed, observation).unwrap_or_else(|why| panic!("{why}"));
    }

    /// As [`Self::reset`], for buffers from outside.
    ///
    /// # Errors
    /// [`InputError`] if `observation` has the wrong length; nothing has happened then.
    pub fn try_reset(&mut self, seed: u64, observation: &mut [f32]) -> Result<(), InputError> {
        self.check_observation(observation)?;
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let scale = self.config.reset_noise_scale;
        for (start, nominal) in self.start_position.iter_mut().zip(&self.nominal_position) {
            *start = nominal + symmetric(&mut random, scale);
        }
        for start in &mut self.start_velocity {
            *start = symmetric(&mut random, scale);
        }
        self.seed = Some(seed);
        self.disturber.begin_episode(seed, &mut self.physics);
        // The noisy quaternion is made a unit again where the bodies are placed.
        self.physics.set_state(&self.start_position, &self.start_velocity);
        self.episode_steps = 0;
        self.last_info = standing_info(&self.config, &self.physics);
        self.record(observation);
        Ok(())
    }

    /// Acts for one control step and writes what is seen afterwards.
    ///
    /// `action` has one control per motor, in actuator order, and is clamped to [`Self::action_ranges`].
    /// If the action or the physics is not finite the step is a fault: terminated, reward 0, and the observation
    /// and `info` are those of the step before. So is every further step until [`Self::reset`].
    /// Where actions are delayed or disturbed on their way to the motors, the step is charged for the action given here.
    ///
    /// # Panics
    /// If `action` or `observation` has the wrong length.
    pub fn step(&mut self, action: &[f32], observation: &mut [f32]) -> Step {
        self.check_lengths(action, observation).unwrap_or_else(|why| panic!("{why}"));
        self.advance(action, observation)
    }

    /// As [`Self::step`], for actions from outside: one that is not finite is refused, and ends no episode.
    ///
    /// # Errors
    /// [`InputError`] if `action` or `observation` has the wrong length, or an entry of `action` is not finite; nothing
    /// has happened then.
    pub fn try_step(&mut self, action: &[f32], observation: &mut [f32]) -> Result<Step, InputError> {
        self.check_lengths(action, observation)?;
        InputError::check_finite("action", action)?;
        Ok(self.advance(action, observation))
    }

    /// One control step with slices of the right lengths.
    fn advance(&mut self, action: &[f32], observation: &mut [f32]) -> Step {
        for (control, (action, [low, high])) in self.controls.iter_mut().zip(action.iter().zip(&self.ranges)) {
            *control = action.clamp(*low, *high);
        }
        if let Some(velocity_mps) = self.disturber.due_push() {
            self.physics.push(velocity_mps);
        }
        let before = self.physics.centre_of_mass();
        self.episode_steps = self.episode_steps.saturating_add(1);
        // An action that is not finite is physics' to refuse: it must not be clamped, or be lost in a delay.
        let is_finite = action.iter().all(|control| control.is_finite());
        let acting = if is_finite { self.disturber.act(&self.controls) } else { action };
        if self.physics.step_only(acting).is_err() {
            return self.fault(observation);
        }
        let after = self.physics.centre_of_mass();
        let position = self.physics.position();
        let step = task::judge(
            &self.config,
            &Transition {
                centre_before_m: [before.x, before.y],
                centre_after_m: [after.x, after.y],
                torso_m: [position[0], position[1], position[2]],
                controls: &self.controls,
                squared_contact_wrenches: self.physics.squared_contact_wrenches(),
                tendon_length_rad: over_tendons(&self.physics, self.physics.joint_angles()),
                tendon_velocity_radps: over_tendons(&self.physics, self.physics.joint_rates()),
                episode_steps: self.episode_steps,
            },
        );
        self.last_info = step.info;
        self.record(observation);
        step
    }

    /// Writes what is seen now, without sensor noise, whichever way the body got into its state.
    ///
    /// # Errors
    /// [`InputError`] if `observation` has the wrong length.
    pub fn observe(&self, observation: &mut [f32]) -> Result<(), InputError> {
        self.check_observation(observation)?;
        self.observation.write(&self.physics, observation);
        Ok(())
    }

    /// Of what an observation consists.
    #[must_use]
    pub fn observation(&self) -> &Observation {
        &self.observation
    }

    /// What was last told: by the last step, or by the last reset if there was none since. See
    /// [`StepInfo::entries`] for Gymnasium's names.
    #[must_use]
    pub fn info(&self) -> &StepInfo {
        &self.last_info
    }

    /// The settings.
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

    fn record(&mut self, observation: &mut [f32]) {
        self.observation.write(&self.physics, observation);
        self.disturber.corrupt(observation);
        self.last_observation.copy_from_slice(observation);
    }

    fn fault(&mut self, observation: &mut [f32]) -> Step {
        self.faults += 1;
        observation.copy_from_slice(&self.last_observation);
        Step { reward: 0.0, terminated: true, truncated: false, fault: true, info: self.last_info }
    }

    /// How many steps ended in a fault since the environment was built.
    #[must_use]
    pub fn fault_count(&self) -> u64 {
        self.faults
    }

    /// The simulated body.
    #[must_use]
    pub fn physics(&self) -> &Physics {
        &self.physics
    }

    /// The simulated body, to be stepped without task and observation or set to a state of choice.
    #[must_use]
    pub fn physics_mut(&mut self) -> &mut Physics {
        &mut self.physics
    }

    /// How well the joints hold after the last step.
    #[must_use]
    pub fn joint_quality(&self) -> JointQuality {
        self.physics.joint_quality()
    }
}

/// A number from [−scale, scale).
fn symmetric(random: &mut impl Rng, scale: f64) -> f64 {
    (2.0 * random.random::<f64>() - 1.0) * scale
}

fn over_tendons(physics: &Physics, hinges: &[f64]) -> PerTendon {
    physics.model().tendons.iter().map(|tendon: &Tendon| tendon.sum_over(hinges)).collect()
}

/// What is known of an episode before its first step.
fn standing_info(config: &EnvironmentConfig, physics: &Physics) -> StepInfo {
    let (position, centre) = (physics.position(), physics.centre_of_mass());
    let [x_m, y_m] = task::place_m(config.task, [position[0], position[1]], [centre.x, centre.y]);
    StepInfo {
        x_position_m: x_m,
        y_position_m: y_m,
        distance_from_origin_m: x_m.hypot(y_m),
        torso_height_m: position[2],
        tendon_length_rad: over_tendons(physics, physics.joint_angles()),
        tendon_velocity_radps: over_tendons(physics, physics.joint_rates()),
        ..StepInfo::default()
    }
}
