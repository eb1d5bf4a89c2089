//! Velocity task: the robot follows commanded velocities on its feet.
//!
//! For robots with a card, see [`crate::card`]: actions are targets of servos around the default pose. Names of terms are those
//! of Isaac Lab and mjlab.
//!
//! # Layout
//! - `command`: the schedule of commands.
//! - `feet`: feet and gait.
//! - `mirror`: mirror image of an observation.
//! - `rewards`: the reward's terms.

mod command;
mod feet;
mod mirror;
mod rewards;

use nalgebra::Vector3;
use rand::RngExt;

use self::command::Drawn;
pub use self::command::{Command, HEADING_GAIN, STANDING_COMMAND};
pub use self::feet::{FEET, Foot, Stride, stride};
pub use self::rewards::{BaseMotion, Body, HingeMotion, terms};
use super::{Evaluation, ObservationTerm, Step, Task};
use crate::config::{EnvironmentConfig, VelocityConfig, VelocityRewards};
use crate::error::{ModelError, StateError};
use crate::info::StepInfo;
use crate::model::Model;
use crate::model::mirror::{Mirror, SignedPermutation};
use crate::physics::Physics;
use crate::randomisation::{SensorNoise, stream};

/// Largest action, in units of [`crate::card::HingeControl::action_scale_rad`].
pub const ACTION_MAX: f64 = 4.0;
/// Axes whose part along the base's left exceeds this swing a leg forwards, not sideways.
const LATERAL_AXIS: f64 = 0.8;
/// Weight of hinges that swing the legs forwards in the term `pose`.
const SWING_POSE_WEIGHT: f64 = 0.1;
/// Numbers of [`Task::save`] that do not depend on the robot: command number and steps, control steps of the episode, and
/// five numbers of each foot.
const SAVED: usize = 3 + 5 * FEET;

/// Task of following velocity commands.
pub struct VelocityTask {
    config: VelocityConfig,
    step_s: f64,
    encoder_bias_rad: f64,
    terms: Vec<ObservationTerm>,
    body: Body,
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
    /// Command of the last observation, for which the next step is rewarded.
    observed: Command,
    command_changes: u32,
    episode_steps: u32,
    actions: Vec<f64>,
    actions_before: Vec<f64>,
    rates_before_radps: Vec<f64>,
    feet: [Foot; FEET],
    /// Observations of the policy, the oldest first, `[history][row]`.
    past: Vec<f32>,
    /// Control step of the newest of them; none before the first.
    observed_step: Option<u32>,
    terms_of_reward: VelocityRewards,
}

impl VelocityTask {
    /// Returns the task for a simulation in the default pose.
    ///
    /// # Errors
    /// [`ModelError`] if the robot has no card with two feet.
    pub fn new(velocity: &VelocityConfig, config: &EnvironmentConfig, physics: &Physics) -> Result<Self, ModelError> {
        velocity.check()?;
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
        let motors: Vec<(usize, f64, f64)> = model
            .motors
            .iter()
            .map(|motor| (motor.hinge, default[7 + motor.hinge], robot.hinges[motor.hinge].action_scale_rad))
            .collect();
        let body =
            Body { default_rad: default[7..].to_vec(), pose_weights: pose_weights(physics), height_m: default[2] };
        let standing = |foot: usize| Foot::now(physics, feet_links[foot], 0.0).lift_m;
        let terms = observation_terms(velocity, motors.len());
        let of_policy = terms.iter().filter(|term| !term.is_privileged).map(|term| term.range.len()).sum();
        Ok(Self {
            feet_standing_m: std::array::from_fn(standing),
            actions: vec![0.0; motors.len()],
            actions_before: vec![0.0; motors.len()],
            encoder_errors_rad: vec![0.0; model.hinges.len()],
            encoder_bias_rad: config.randomisation.encoder_bias_rad,
            rates_before_radps: vec![0.0; model.hinges.len()],
            past: vec![0.0; of_policy],
            observed_step: None,
            config: velocity.clone(),
            step_s: config.control_step_s,
            terms,
            body,
            feet_links,
            motors,
            steered: None,
            seed: 0,
            drawn_index: 0,
            drawn: Drawn::default(),
            drawn_left_steps: 0,
            command: Command::default(),
            observed: Command::default(),
            command_changes: 0,
            episode_steps: 0,
            feet: [Foot::default(); FEET],
            terms_of_reward: VelocityRewards::default(),
        })
    }

    /// Returns the terms of the last step's reward, without their weights.
    #[must_use]
    pub fn terms_of_reward(&self) -> &VelocityRewards {
        &self.terms_of_reward
    }

    fn base(physics: &Physics) -> BaseMotion {
        let position = physics.position();
        BaseMotion::new(position, physics.velocity(), physics.ground_height_m(position[0], position[1]))
    }

    fn draw(&mut self, index: u32) {
        self.drawn_index = index;
        self.drawn = Drawn::new(&self.config, self.step_s, self.seed, index);
        self.drawn_left_steps = self.drawn.steps;
    }

    fn time_s(&self) -> f64 {
        f64::from(self.episode_steps) * self.step_s
    }

    fn info(&self, physics: &Physics, centre_velocity_mps: [f64; 2], reward: f64) -> StepInfo {
        let position = physics.position();
        StepInfo {
            x_position_m: position[0],
            y_position_m: position[1],
            distance_from_origin_m: position[0].hypot(position[1]),
            x_velocity_mps: centre_velocity_mps[0],
            y_velocity_mps: centre_velocity_mps[1],
            reward_forward: reward,
            torso_height_m: physics.torso_height_m(),
            ..StepInfo::default()
        }
    }

    /// Writes what the policy observes now.
    fn write_row(&self, physics: &Physics, noise: &mut SensorNoise, row: &mut [f32]) {
        let base = Self::base(physics);
        let mut numbers = row.iter_mut();
        let mut write = |number: f64| *numbers.next().expect("the terms fill the row") = number as f32;
        base.angular_radps.iter().for_each(|rate| write(rate + noise.velocity()));
        base.gravity.iter().for_each(|part| write(part + noise.position()));
        self.command.numbers().into_iter().for_each(&mut write);
        for (hinge, default_rad, _) in &self.motors {
            let error_rad = self.encoder_errors_rad[*hinge] + noise.position();
            write(physics.joint_angles()[*hinge] - default_rad + error_rad);
        }
        for (hinge, _, _) in &self.motors {
            write(physics.joint_rates()[*hinge] + noise.velocity());
        }
        self.actions.iter().for_each(|action| write(*action));
        let (sin, cos) = match self.command.stands() {
            true => (0.0, 0.0),
            false => (std::f64::consts::TAU * self.time_s() / self.config.gait_period_s).sin_cos(),
        };
        [sin, cos].into_iter().for_each(write);
    }

    /// Writes what only the critic observes.
    fn write_privileged(&self, physics: &Physics, row: &mut [f32]) {
        let base = Self::base(physics);
        let mut numbers = row.iter_mut();
        let mut write = |number: f64| *numbers.next().expect("the terms fill the row") = number as f32;
        base.velocity_mps.iter().for_each(|part| write(*part));
        write(base.height_m);
        self.feet.iter().for_each(|foot| write(f64::from(u8::from(foot.stands))));
        self.feet.iter().for_each(|foot| write(foot.air_s));
        self.feet.iter().for_each(|foot| write(foot.lift_m));
    }
}

impl Task for VelocityTask {
    fn terms(&self) -> &[ObservationTerm] {
        &self.terms
    }

    fn begin(&mut self, seed: u64, physics: &Physics) -> StepInfo {
        self.seed = seed;
        let mut encoders = stream(seed, "encoders");
        let bias_rad = self.encoder_bias_rad;
        self.encoder_errors_rad.fill_with(|| (2.0 * encoders.random::<f64>() - 1.0) * bias_rad);
        self.draw(0);
        self.command = self.steered.unwrap_or_else(|| self.drawn.at(&self.config, Self::base(physics).heading_rad));
        self.episode_steps = 0;
        self.actions.fill(0.0);
        self.actions_before.fill(0.0);
        self.rates_before_radps.copy_from_slice(physics.joint_rates());
        self.feet = std::array::from_fn(|foot| Foot::now(physics, self.feet_links[foot], self.feet_standing_m[foot]));
        self.past.fill(0.0);
        self.observed_step = None;
        self.terms_of_reward = VelocityRewards::default();
        self.info(physics, [0.0; 2], 0.0)
    }

    fn evaluate(&mut self, step: &Step<'_>) -> Evaluation {
        let physics = step.physics;
        self.episode_steps = self.episode_steps.saturating_add(1);
        self.actions_before.copy_from_slice(&self.actions);
        for ((action, given), (_, default, scale)) in self.actions.iter_mut().zip(step.action).zip(&self.motors) {
            *action = ((f64::from(*given) - default) / scale).clamp(-ACTION_MAX, ACTION_MAX);
        }
        for (foot, before) in self.feet.iter_mut().enumerate() {
            *before = before.after(physics, self.feet_links[foot], self.feet_standing_m[foot], self.step_s);
        }
        let base = Self::base(physics);
        let hinges = HingeMotion {
            angles_rad: physics.joint_angles(),
            rates_radps: physics.joint_rates(),
            rates_before_radps: &self.rates_before_radps,
            torques_nm: physics.joint_torques_nm(),
            actions: [&self.actions, &self.actions_before],
        };
        let (config, time_s, step_s) = (&self.config, self.time_s(), self.step_s);
        let mut terms =
            terms(config, physics.model(), &self.body, &self.observed, &base, &self.feet, &hinges, time_s, step_s);
        let has_fallen =
            base.height_m < config.fall_height_share * self.body.height_m || base.tilt_rad() > config.fall_tilt_rad;
        terms.alive = f64::from(u8::from(!has_fallen));
        let reward = config.rewards.total(&terms);
        self.terms_of_reward = terms;
        self.rates_before_radps.copy_from_slice(physics.joint_rates());

        self.drawn_left_steps -= 1;
        if self.drawn_left_steps == 0 {
            self.draw(self.drawn_index + 1);
            self.command_changes += u32::from(self.steered.is_none());
        }
        self.command = self.steered.unwrap_or_else(|| self.drawn.at(&self.config, base.heading_rad));
        let velocity = (physics.centre_of_mass() - step.centre_before_m) / step_s;
        let info = self.info(physics, [velocity.x, velocity.y], reward);
        Evaluation { reward: reward as f32, terminated: has_fallen, info }
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
        }
        self.observed = self.command;
        self.write_row(physics, noise, &mut seen[newest..]);
        if self.observed_step.is_none() {
            for row in 0..self.config.history as usize - 1 {
                seen.copy_within(newest.., row * width);
            }
        }
        if !is_again {
            self.past.copy_from_slice(seen);
            self.observed_step = Some(self.episode_steps);
        }
        self.write_privileged(physics, hidden);
    }

    fn command(&self) -> Option<[f64; 3]> {
        Some(self.command.numbers())
    }

    fn command_changes(&self) -> u32 {
        self.command_changes
    }

    fn steer(&mut self, command: Option<[f64; 3]>) -> bool {
        self.steered = command.map(|[lin_vel_x_mps, lin_vel_y_mps, ang_vel_z_radps]| Command {
            lin_vel_x_mps,
            lin_vel_y_mps,
            ang_vel_z_radps,
        });
        if let Some(command) = self.steered {
            self.command_changes += u32::from(command != self.command);
            self.command = command;
        }
        true
    }

    fn mirrored(&self, robot: &Mirror) -> Option<SignedPermutation> {
        Some(mirror::reflection(&self.terms, robot))
    }

    fn save(&self) -> Vec<f64> {
        let mut numbers =
            vec![f64::from(self.drawn_index), f64::from(self.drawn_left_steps), f64::from(self.episode_steps)];
        for foot in &self.feet {
            numbers.push(f64::from(u8::from(foot.stands)));
            numbers.push(foot.air_s);
            numbers.extend(foot.velocity_mps.iter());
        }
        numbers.extend(&self.actions);
        numbers.extend(&self.rates_before_radps);
        numbers.extend(self.command.numbers());
        numbers.extend(self.past.iter().map(|number| f64::from(*number)));
        numbers
    }

    fn restore(&mut self, numbers: &[f64]) -> Result<(), StateError> {
        let (actions, hinges) = (self.actions.len(), self.rates_before_radps.len());
        let expected = SAVED + actions + hinges + 3 + self.past.len();
        if numbers.len() != expected {
            return Err(StateError::Length { what: "task", found: numbers.len(), expected });
        }
        let count = |number: f64| number as u32;
        self.draw(count(numbers[0]));
        self.drawn_left_steps = count(numbers[1]).clamp(1, self.drawn.steps);
        self.episode_steps = count(numbers[2]);
        for (foot, saved) in self.feet.iter_mut().zip(numbers[3..SAVED].as_chunks::<5>().0) {
            foot.stands = saved[0] != 0.0;
            foot.air_s = saved[1];
            foot.velocity_mps = Vector3::new(saved[2], saved[3], saved[4]);
        }
        let (of_actions, rest) = numbers[SAVED..].split_at(actions);
        let (of_rates, rest) = rest.split_at(hinges);
        let (of_command, of_past) = rest.split_at(3);
        self.actions.copy_from_slice(of_actions);
        self.rates_before_radps.copy_from_slice(of_rates);
        self.command =
            Command { lin_vel_x_mps: of_command[0], lin_vel_y_mps: of_command[1], ang_vel_z_radps: of_command[2] };
        self.observed = self.command;
        self.past.iter_mut().zip(of_past).for_each(|(number, saved)| *number = *saved as f32);
        self.observed_step = Some(self.episode_steps);
        Ok(())
    }
}

/// Returns the terms of an observation: those of the policy, each with its history, then those of the critic alone.
fn observation_terms(config: &VelocityConfig, actions: usize) -> Vec<ObservationTerm> {
    let of_policy = [
        ("base_ang_vel", 3),
        ("projected_gravity", 3),
        ("velocity_commands", 3),
        ("joint_pos_rel", actions),
        ("joint_vel_rel", actions),
        ("last_action", actions),
        ("gait_phase", 2),
    ];
    let of_critic =
        [("base_lin_vel", 3), ("base_height", 1), ("feet_contact", FEET), ("feet_air_time", FEET), ("feet_lift", FEET)];
    let history = config.history as usize;
    let rows = (0..history).flat_map(|_| of_policy).map(|(name, size)| (name, size, false));
    let mut end = 0;
    rows.chain(of_critic.map(|(name, size)| (name, size, true)))
        .map(|(name, size, is_privileged)| {
            let start = end;
            end += size;
            ObservationTerm { name: name.to_owned(), range: start..end, is_privileged }
        })
        .collect()
}

/// Returns the weight of each hinge in the term `pose`, for a robot in the default pose.
fn pose_weights(physics: &Physics) -> Vec<f64> {
    let model: &Model = physics.model();
    let base = physics.body_motion(0).pose.rotation;
    let mut weights = vec![1.0; model.hinges.len()];
    for (index, body) in model.bodies.iter().enumerate() {
        let rotation = base.inverse() * physics.body_motion(index).pose.rotation;
        for hinge in body.hinges.clone() {
            if (rotation * model.hinges[hinge].axis).y.abs() > LATERAL_AXIS {
                weights[hinge] = SWING_POSE_WEIGHT;
            }
        }
    }
    weights
}
