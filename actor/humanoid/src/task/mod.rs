//! Tasks: what the policy observes, what it is rewarded for, and when an episode ends.
//!
//! [`Environment`](crate::Environment) owns time, physics and randomisation. A [`Task`] turns named quantities of
//! [`Physics`] into observations and rewards.
//!
//! # Layout
//! - `humanoid`: Gymnasium's Humanoid-v5 and -v4.
//! - [`motion`]: imitation of motions.
//! - `registry`: builds the task that a configuration selects, also those of the program that uses this crate.
//! - [`term`]: tables of observations.
//! - [`velocity`]: walking at commanded velocities.

mod humanoid;
pub mod motion;
mod registry;
pub mod term;
pub mod velocity;

use std::any::Any;

use nalgebra::Point3;

pub use self::humanoid::{HumanoidTask, contact_cost, is_healthy};
pub use self::registry::{TaskBuilder, TaskRegistry};
use crate::error::StateError;
use crate::model::mirror::{Mirror, SignedPermutation};
use crate::model::{Model, Robot};
pub use crate::observation::ObservationTerm;
use crate::physics::Physics;
use crate::randomisation::SensorNoise;

/// Share of a hinge's range, from its middle, beyond which it is near its limit.
const SOFT_LIMIT_SHARE: f64 = 0.9;

/// A control step that the physics has simulated.
#[derive(Clone, Copy)]
pub struct Step<'a> {
    /// Robot after the step.
    pub physics: &'a Physics,
    /// Action as given, or as [`Task::change_action`] changed it; one control per motor.
    pub action: &'a [f32],
    /// Centre of mass of the whole robot before the step (m, world frame).
    pub centre_before_m: Point3<f64>,
}

/// State in which an episode begins.
pub struct EpisodeStart<'a> {
    /// Position vector, see [`Physics::position`]; its quaternion need not be normalised.
    pub position: &'a mut [f64],
    /// Velocity vector, see [`Physics::velocity`].
    pub velocity: &'a mut [f64],
}

/// Reward of a control step, and whether the task ends the episode.
#[derive(Clone, Copy, Debug)]
pub struct StepEvaluation {
    /// Reward of the step.
    pub reward: f32,
    /// Whether the task ends the episode: the value of its last state is 0.
    pub terminated: bool,
    /// Whether the task ends the episode as a time limit does: its last state keeps its value.
    pub truncated: bool,
}

/// How hard an episode is, where the task adapts that.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difficulty {
    /// Kind of the ground, of those in the configuration.
    pub ground_kind: Option<u32>,
    /// Level of the ground's difficulty, from 0.
    pub ground_level: Option<f64>,
    /// Factor on the ranges of commands.
    pub command_factor: Option<f64>,
    /// Control step, counted over all motions, at which it failed to imitate them.
    pub failed_step: Option<u32>,
}

/// Curricula that environments of a run have reached lately.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reached<'a> {
    /// Kinds of ground of the last episodes.
    pub ground_kinds: &'a [u32],
    /// Level of each.
    pub ground_levels: &'a [u32],
    /// Factors on the ranges of commands.
    pub command_factors: &'a [f32],
    /// Control steps, counted over all motions, at which episodes failed to imitate them.
    pub failed_steps: &'a [u32],
}

/// Result of one control step.
#[derive(Clone, Copy, Debug)]
pub struct StepOutcome {
    /// Reward of the step.
    pub reward: f32,
    /// Whether the task ended the episode: the value of its last state is 0.
    pub terminated: bool,
    /// Whether a limit of time or place ended the episode: its last state keeps its value. Never together with `terminated`.
    pub truncated: bool,
    /// Whether the physics or the action was not finite; implies `terminated`.
    pub fault: bool,
}

/// What a robot must do.
///
/// For each episode the environment calls [`Self::start`], [`Self::begin`] and [`Self::observe`], and then for each
/// control step [`Self::evaluate`] and [`Self::observe`]. The same calls must give the same results, bit for bit:
/// random numbers come from the seed of the episode only.
pub trait Task: Any + Send + Sync {
    /// Returns the terms of an observation, in order and without gaps.
    fn terms(&self) -> &[ObservationTerm];

    /// Changes the state in which a new episode starts.
    /// Only here a task may let the episodes before decide, by what [`Self::save`] holds.
    fn start(&mut self, _seed: u64, _physics: &Physics, _start: EpisodeStart<'_>) {}

    /// Chooses, outside of training, which of several beginnings the next episodes have, as which of several motions.
    fn choose_start(&mut self, _number: u64) {}

    /// Returns whether the lowest part of the robot begins each episode as high above the ground as in the default pose. The
    /// noise of the start, see `env.reset_noise_scale`, otherwise lifts robots, or sinks them into the ground, which throws
    /// them up.
    fn starts_on_ground(&self) -> bool {
        false
    }

    /// Returns whether a robot that would begin in the ground is lifted onto it.
    fn stays_above_ground(&self) -> bool {
        false
    }

    /// Begins an episode with the robot in its first state.
    fn begin(&mut self, seed: u64, physics: &Physics);

    /// Changes the action of the next control step, one control per motor, before it is clamped and reaches the motors.
    /// [`Step::action`] is the changed one.
    fn change_action(&self, _action: &mut [f32]) {}

    /// Returns reward and end of a control step.
    fn evaluate(&mut self, step: &Step<'_>) -> StepEvaluation;

    /// Calls `each` with the name and value of each term of the last step's reward; they add up to it. Names are 1 to
    /// 64 of the characters a-z, 0-9 and _, and always the same ones in the same order. A task without them logs only
    /// its reward.
    fn reward_terms(&self, _each: &mut dyn FnMut(&'static str, f64)) {}

    /// Writes an observation of the present state with the noise of the sensors. Should not allocate. A number that is not
    /// finite, here or in the reward, is a fault, as in [`Environment::step`](crate::Environment::step).
    fn observe(&mut self, physics: &Physics, noise: &mut SensorNoise, observation: &mut [f32]);

    /// Returns the velocity that the robot is asked to have, in its heading frame: forward and left (m/s), yaw rate (rad/s);
    /// `None` if the task has no commands.
    fn command(&self) -> Option<[f64; 3]> {
        None
    }

    /// Replaces the task's own commands by one, also in later episodes; `None` ends that. Returns false if the task has no
    /// commands. The reward of a step counts the command that the policy observed before it.
    fn steer(&mut self, _command: Option<[f64; 3]>) -> bool {
        false
    }

    /// Returns the mirror image of an observation, with left and right exchanged, for a robot with this one; `None` if
    /// the task has none.
    fn mirrored(&self, _robot: &Mirror) -> Option<SignedPermutation> {
        None
    }

    /// Returns a count that grows with each command that replaces another one, whether drawn or given by [`Self::steer`]. A
    /// command that changes continuously, such as a yaw rate towards a heading, remains one command.
    fn command_changes(&self) -> u32 {
        0
    }

    /// Returns how hard the present episode is.
    fn difficulty(&self) -> Difficulty {
        Difficulty::default()
    }

    /// Begins with curricula that other environments of the run have reached, instead of with the first ones. Called
    /// before the first episode.
    fn adopt_curricula(&mut self, _reached: &Reached<'_>, _seed: u64) {}

    /// Returns everything that the rest of the episode depends on, apart from seed and physics, as finite numbers.
    /// Their count is the same at all times.
    fn save(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Restores the numbers of [`Self::save`], after [`Self::begin`] with the same seed.
    ///
    /// # Errors
    /// [`StateError`] if the numbers are not those of such a task; the task is then unchanged.
    fn restore(&mut self, numbers: &[f64]) -> Result<(), StateError> {
        match numbers.len() {
            0 => Ok(()),
            found => Err(StateError::Length { what: "task", found, expected: 0 }),
        }
    }
}

/// Returns for each motor of a robot with a card: hinge, default control and control per unit of action.
fn servos(model: &Model, robot: &Robot) -> Vec<(usize, f64, f64)> {
    let servo = |hinge: usize| (hinge, robot.default_position[7 + hinge], robot.hinges[hinge].action_scale_rad);
    model.motors.iter().map(|motor| servo(motor.hinge)).collect()
}

/// Returns the angle beyond nine tenths of the hinges' ranges, summed over the hinges (rad).
fn beyond_soft_limits_rad(model: &Model, angles_rad: &[f64]) -> f64 {
    let hinges = model.hinges.iter().zip(angles_rad);
    hinges
        .map(|(hinge, angle_rad)| {
            let half_rad = SOFT_LIMIT_SHARE * (hinge.max_rad - hinge.min_rad) / 2.0;
            ((angle_rad - hinge.centre_rad()).abs() - half_rad).max(0.0)
        })
        .sum()
}

impl StepEvaluation {
    /// Returns the outcome of control step number `episode_steps` of an episode, which is truncated after
    /// `max_episode_steps`; 0 means never.
    #[must_use]
    pub fn at(self, episode_steps: u32, max_episode_steps: u32) -> StepOutcome {
        let is_out_of_time = max_episode_steps > 0 && episode_steps >= max_episode_steps;
        let Self { reward, terminated, truncated } = self;
        StepOutcome { reward, terminated, truncated: (truncated || is_out_of_time) && !terminated, fault: false }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fall_goes_before_every_limit_and_the_last_step_is_truncated() {
        // Ends by the task, step and greatest number of steps: ends of the outcome.
        for (terminated, truncated, step, steps_max, ends) in [
            (false, true, 1, 10, [false, true]),
            (true, true, 1, 10, [true, false]),
            (false, false, 9, 10, [false, false]),
            (false, false, 10, 10, [false, true]),
            (true, false, 10, 10, [true, false]),
            (false, false, u32::MAX, 0, [false, false]),
        ] {
            let outcome = StepEvaluation { reward: 5.0, terminated, truncated }.at(step, steps_max);
            assert_eq!([outcome.terminated, outcome.truncated], ends, "{terminated} {truncated} {step} of {steps_max}");
            assert!(outcome.reward == 5.0 && !outcome.fault);
        }
    }
}
