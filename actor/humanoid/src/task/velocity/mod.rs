//! Velocity task: the robot follows commanded velocities on its feet.
//!
//! For robots with a card, see [`crate::card`]: actions are targets of servos around the default pose. Names of terms
//! are those of Isaac Lab and mjlab.
//!
//! # Layout
//! - `command`: the schedule of commands.
//! - `curriculum`: difficulty of ground and commands.
//! - `feet`: feet and gait.
//! - `observation`: what policy and critic see.
//! - `rewards`: the reward's terms.
//! - `saved`: the task's state as numbers.
//! - `scan`: the ground around the base.
//! - `standing`: when the gait rests, and what wakes it.

mod command;
mod curriculum;
mod feet;
mod observation;
mod rewards;
mod saved;
mod scan;
mod standing;

use std::f64::consts::FRAC_PI_2;

use rand::RngExt;

use self::command::Drawn;
pub use self::command::{Command, STANDING_COMMAND};
use self::curriculum::Curriculum;
pub use self::feet::{FEET, Foot, Stride, stride};
pub use self::observation::TERMS;
use self::observation::VelocityView;
use self::rewards::pose_weights;
pub use self::rewards::{BaseMotion, HingeMotion, RobotStep, Stance};
pub use self::scan::{SCAN_GRID, SCAN_MAX_M, SCAN_SPACING_M};
use self::scan::{SCAN_POINTS, ground_around};
pub use self::standing::Calm;
use self::standing::Standing;
use super::term::Layout;
use super::{Difficulty, EpisodeStart, ObservationTerm, Reached, Step, StepEvaluation, Task, servos};
pub use crate::config::HEADING_GAIN;
use crate::config::{EnvironmentConfig, GroundConfig, REWARD_TERMS, RewardFunctions, RewardsConfig, VelocityConfig};
use crate::error::{ModelError, StateError};
use crate::model::mirror::{Mirror, SignedPermutation};
use crate::physics::Physics;
use crate::randomisation::{SensorNoise, stream, uniform};

/// Largest action, in units of [`crate::model::HingeControl::action_scale_rad`].
pub const ACTION_MAX: f64 = 4.0;
/// Largest distance of a start from the middle of its tile, along x and along y (m).
const START_M: f64 = 0.5;

/// Task of following velocity commands.
pub struct VelocityTask {
    config: VelocityConfig,
    weights: RewardsConfig,
    /// The settings with the present ranges of commands.
    commanded: VelocityConfig,
    /// Generated ground, if there is one.
    ground: Option<GroundConfig>,
    curriculum: Option<Curriculum>,
    max_episode_steps: u32,
    step_s: f64,
    encoder_bias_rad: f64,
    layout: Layout<VelocityTask>,
    body: Stance,
    /// Links of the left and the right foot, and their heights in the default pose (m).
    feet_links: [usize; FEET],
    feet_standing_m: [f64; FEET],
    /// For each motor: hinge, default control and control per unit of action.
    motors: Vec<(usize, f64, f64)>,
    /// Command that replaces the schedule.
    steered: Option<Command>,
    seed: u64,
    /// Errors of the encoders in this episode (rad).
    encoder_errors_rad: Vec<f64>,
    drawn_index: u32,
    drawn: Drawn,
    drawn_left_steps: u32,
    command: Command,
    standing: Standing,
    in_training: bool,
    /// Command of the last observation, for which the next step is rewarded, and whether the gait rested.
    observed: (Command, bool),
    command_changes: u32,
    episode_steps: u32,
    actions: Vec<f64>,
    actions_before: Vec<f64>,
    rates_before_radps: Vec<f64>,
    feet: [Foot; FEET],
    /// Terms of the last step's reward, without weights; 0 before the first step.
    rewarded: [f64; REWARD_TERMS],
    /// Observations of the policy, the oldest first, `[history][row]`.
    past: Vec<f32>,
    /// Control step of the newest of them; none before the first.
    observed_step: Option<u32>,
}

impl VelocityTask {
    /// Returns the task for a simulation in the default pose.
    ///
    /// # Errors
    /// [`ModelError`] if the robot has no card with two feet.
    pub fn new(config: &EnvironmentConfig, physics: &Physics) -> Result<Self, ModelError> {
        let velocity = &config.velocity;
        let model = physics.model();
        let refuse = |problem: &str| Err(ModelError::Task(format!("the velocity task {problem}")));
        let Some(robot) = &model.robot else {
            return refuse(
                "needs a robot card, with servos and feet: name one by env.robot, or give your own as --model CARD.toml; \
                 `treadmill robot FILE` drafts it",
            );
        };
        let Ok(feet_links) = <[usize; FEET]>::try_from(&robot.feet[..]) else {
            return refuse(&format!(
                "needs two `feet` in the robot card, the left one first; it has {}",
                robot.feet.len()
            ));
        };
        let default = &robot.default_position;
        let motors = servos(model, robot);
        let ground = (!config.ground.kinds.is_empty()).then(|| config.ground.clone());
        let body = Stance {
            default_rad: default[7..].to_vec(),
            pose_weights: pose_weights(physics),
            height_m: default[2],
            may_lift_higher: ground.is_some(),
        };
        let standing = |foot: usize| match &ground {
            None => Foot::now(physics, feet_links[foot], 0.0).lift_m,
            // It starts on ground at height 0.
            Some(_) => Foot::origin_m(physics, feet_links[foot]).z,
        };
        let layout = observation::layout(config, motors.len());
        let mut task = Self {
            feet_standing_m: std::array::from_fn(standing),
            ground,
            curriculum: Curriculum::new(config),
            commanded: velocity.clone(),
            max_episode_steps: config.env.max_episode_steps,
            actions: vec![0.0; motors.len()],
            actions_before: vec![0.0; motors.len()],
            encoder_errors_rad: vec![0.0; model.hinges.len()],
            encoder_bias_rad: config.randomisation.encoder_bias_rad,
            rates_before_radps: vec![0.0; model.hinges.len()],
            past: vec![0.0; layout.of_policy()],
            observed_step: None,
            config: velocity.clone(),
            weights: config.rewards.clone(),
            step_s: config.env.control_step_s,
            layout,
            body,
            feet_links,
            motors,
            steered: None,
            seed: 0,
            drawn_index: 0,
            drawn: Drawn::default(),
            drawn_left_steps: 0,
            command: Command::default(),
            standing: Standing::default(),
            in_training: config.has_curricula,
            observed: (Command::default(), false),
            command_changes: 0,
            episode_steps: 0,
            feet: [Foot::default(); FEET],
            rewarded: [0.0; REWARD_TERMS],
        };
        task.scale_commands();
        Ok(task)
    }

    /// Returns how the base moves, and the heights of the ground around it (m, world); 0 if nothing asks for them.
    fn base(&self, physics: &Physics) -> (BaseMotion, [f64; SCAN_POINTS]) {
        let position = physics.position();
        let mut base = BaseMotion::new(position, physics.velocity(), physics.ground_height_m(position[0], position[1]));
        let mut around_m = [0.0; SCAN_POINTS];
        if self.ground.is_some() || self.config.height_scan {
            around_m = ground_around(physics, [position[0], position[1]], base.heading_rad);
        }
        if self.ground.is_some() {
            // Stairs and gaps just below the base say little about how it stands.
            base.height_m = position[2] - around_m.iter().sum::<f64>() / SCAN_POINTS as f64;
        }
        (base, around_m)
    }

    /// Adopts the curriculum's factor on the ranges of commands.
    fn scale_commands(&mut self) {
        if let Some(curriculum) = &self.curriculum {
            let times = |range: [f64; 2]| range.map(|end| curriculum.factor() * end);
            let VelocityConfig { lin_vel_x_mps, lin_vel_y_mps, ang_vel_z_radps, .. } = self.config;
            self.commanded.lin_vel_x_mps = times(lin_vel_x_mps);
            self.commanded.lin_vel_y_mps = times(lin_vel_y_mps);
            self.commanded.ang_vel_z_radps = times(ang_vel_z_radps);
        }
    }

    /// Returns the share of the greatest reward for tracking that a step earned.
    fn tracked_share(&self, step: &RobotStep<'_>) -> f64 {
        let RewardsConfig { track_linear_velocity: linear, track_yaw_rate: yaw, .. } = self.weights;
        match linear + yaw {
            sum if sum > 0.0 => (linear * step.track_linear_velocity() + yaw * step.track_yaw_rate()) / sum,
            _ => step.track_linear_velocity(),
        }
    }

    fn draw(&mut self, index: u32) {
        self.drawn_index = index;
        self.drawn = Drawn::new(&self.commanded, self.step_s, self.seed, index);
        self.drawn_left_steps = self.drawn.steps;
    }

    fn time_s(&self) -> f64 {
        f64::from(self.episode_steps) * self.step_s
    }
}

impl Task for VelocityTask {
    fn terms(&self) -> &[ObservationTerm] {
        &self.layout.terms
    }

    fn start(&mut self, seed: u64, physics: &Physics, EpisodeStart { position, .. }: EpisodeStart<'_>) {
        let Some(curriculum) = &mut self.curriculum else { return };
        let mut random = stream(seed, "start");
        let kind = self.ground.as_ref().map_or(0, |ground| random.random_range(0..ground.kinds.len()));
        curriculum.begin_episode(seed, kind);
        let level = curriculum.level();
        self.scale_commands();
        let Some(ground) = &self.ground else { return };
        let middle_m = ground.tile_centre_m(level, kind);
        for (place_m, middle_m) in position.iter_mut().zip(middle_m) {
            *place_m += middle_m + uniform(&mut random, [-START_M, START_M]);
        }
        position[2] += physics.ground_height_m(position[0], position[1]);
        let (sin, cos) = uniform(&mut random, [-FRAC_PI_2, FRAC_PI_2]).sin_cos();
        let [w, x, y, z] = [position[3], position[4], position[5], position[6]];
        position[3..7].copy_from_slice(&[cos * w - sin * z, cos * x - sin * y, cos * y + sin * x, cos * z + sin * w]);
    }

    fn starts_on_ground(&self) -> bool {
        true
    }

    fn begin(&mut self, seed: u64, physics: &Physics) {
        self.seed = seed;
        let mut encoders = stream(seed, "encoders");
        let bias_rad = self.encoder_bias_rad;
        self.encoder_errors_rad.fill_with(|| (2.0 * encoders.random::<f64>() - 1.0) * bias_rad);
        self.draw(0);
        self.command = self.steered.unwrap_or_else(|| self.drawn.at(&self.commanded, self.base(physics).0.heading_rad));
        self.standing = Standing::default();
        self.episode_steps = 0;
        self.actions.fill(0.0);
        self.actions_before.fill(0.0);
        self.rates_before_radps.copy_from_slice(physics.joint_rates());
        self.feet = std::array::from_fn(|foot| Foot::now(physics, self.feet_links[foot], self.feet_standing_m[foot]));
        self.rewarded = [0.0; REWARD_TERMS];
        self.past.fill(0.0);
        self.observed_step = None;
    }

    fn evaluate(&mut self, step: &Step<'_>) -> StepEvaluation {
        let physics = step.physics;
        self.episode_steps = self.episode_steps.saturating_add(1);
        self.actions_before.copy_from_slice(&self.actions);
        for ((action, given), (_, default, scale)) in self.actions.iter_mut().zip(step.action).zip(&self.motors) {
            *action = ((f64::from(*given) - default) / scale).clamp(-ACTION_MAX, ACTION_MAX);
        }
        for (foot, before) in self.feet.iter_mut().enumerate() {
            *before = before.after(physics, self.feet_links[foot], self.feet_standing_m[foot], self.step_s);
        }
        let (base, _) = self.base(physics);
        let hinges = HingeMotion {
            angles_rad: physics.joint_angles(),
            rates_radps: physics.joint_rates(),
            rates_before_radps: &self.rates_before_radps,
            torques_nm: physics.joint_torques_nm(),
            actions: [&self.actions, &self.actions_before],
        };
        let (config, step_s, (command, rests)) = (&self.config, self.step_s, self.observed);
        let has_fallen =
            base.height_m < config.fall_height_share * self.body.height_m || base.tilt_rad() > config.fall_tilt_rad;
        let moved = RobotStep {
            config,
            model: physics.model(),
            body: &self.body,
            command,
            rests,
            base,
            feet: &self.feet,
            hinges,
            time_s: self.time_s(),
            step_s,
            has_fallen,
        };
        let tracked = self.tracked_share(&moved);
        let terms = moved.values();
        let weighted = self.weights.weights().into_iter().zip(terms);
        let reward = weighted.fold(0.0, |sum, (weight, term)| sum + weight * term);
        self.rewarded = terms;
        let truncated = !has_fallen && physics.is_at_edge();
        let is_last = truncated || self.max_episode_steps > 0 && self.episode_steps >= self.max_episode_steps;
        if let Some(curriculum) = &mut self.curriculum {
            let velocity_mps = [base.velocity_mps.x, base.velocity_mps.y];
            curriculum.count(&command, velocity_mps, tracked, step_s, [has_fallen, is_last]);
        }
        self.rates_before_radps.copy_from_slice(physics.joint_rates());

        self.drawn_left_steps -= 1;
        if self.drawn_left_steps == 0 {
            self.draw(self.drawn_index + 1);
            self.command_changes += u32::from(self.steered.is_none());
        }
        self.command = self.steered.unwrap_or_else(|| self.drawn.at(&self.commanded, base.heading_rad));
        StepEvaluation { reward: reward as f32, terminated: has_fallen, truncated }
    }

    fn reward_terms(&self, each: &mut dyn FnMut(&'static str, f64)) {
        let terms = RewardsConfig::NAMES.into_iter().zip(self.weights.weights()).zip(self.rewarded);
        terms.filter(|((_, weight), _)| *weight != 0.0).for_each(|((name, weight), term)| each(name, weight * term));
    }

    fn observe(&mut self, physics: &Physics, noise: &mut SensorNoise, observation: &mut [f32]) {
        let of_policy = self.past.len();
        let (seen, hidden) = observation.split_at_mut(of_policy);
        let width = of_policy / self.config.history as usize;
        let newest = of_policy - width;
        let is_again = self.observed_step == Some(self.episode_steps);
        seen.copy_from_slice(&self.past);
        if !is_again {
            seen.rotate_left(width);
            self.standing = self.standing.after(self.command.stands(), self.is_disturbed(physics));
        }
        self.observed = (self.command, self.rested_s().is_some());
        let view = VelocityView::new(self, physics);
        self.layout.write(&view, false, noise, &mut seen[newest..]);
        self.layout.write(&view, true, noise, hidden);
        if self.observed_step.is_none() {
            for row in 0..self.config.history as usize - 1 {
                seen.copy_within(newest.., row * width);
            }
        }
        if !is_again {
            self.past.copy_from_slice(seen);
            self.observed_step = Some(self.episode_steps);
        }
    }

    fn command(&self) -> Option<[f64; 3]> {
        Some(self.command.numbers())
    }

    fn command_changes(&self) -> u32 {
        self.command_changes
    }

    fn steer(&mut self, command: Option<[f64; 3]>) -> bool {
        self.steered = command.map(Command::from_numbers);
        if let Some(command) = self.steered {
            self.command_changes += u32::from(command != self.command);
            self.command = command;
        }
        true
    }

    fn mirrored(&self, robot: &Mirror) -> Option<SignedPermutation> {
        self.layout.mirrored(|part| Some(observation::image(part, robot)))
    }

    fn difficulty(&self) -> Difficulty {
        self.curriculum.as_ref().map(Curriculum::difficulty).unwrap_or_default()
    }

    fn adopt_curricula(&mut self, reached: &Reached<'_>, seed: u64) {
        if let Some(curriculum) = &mut self.curriculum {
            curriculum.adopt(reached, seed);
            self.scale_commands();
        }
    }

    fn save(&self) -> Vec<f64> {
        self.saved_numbers()
    }

    fn restore(&mut self, numbers: &[f64]) -> Result<(), StateError> {
        self.restore_numbers(numbers)
    }
}
