//! Motion task: the robot imitates motions.
//!
//! For robots with a card, see [`crate::card`]: actions are targets of servos around the default pose. Observation, reward
//! and ends are those of mjlab's tracking task, with its names.
//!
//! # Layout
//! - `links`: what is compared.
//! - `reference`: the motions, control step by control step.
//! - `observation`: what policy and critic see.
//! - `rewards`: the reward's terms, and ends.
//! - `start`: where episodes begin.

mod links;
mod observation;
mod reference;
mod rewards;
mod start;

use std::ops::Range;
use std::sync::Arc;

use rand::RngExt;

pub use self::links::Compared;
pub use self::observation::MOTION_OBSERVATION;
use self::observation::MotionView;
use self::reference::Reference;
pub use self::rewards::MotionErrors;
use self::rewards::MotionStep;
use super::term::Layout;
use super::velocity::ACTION_MAX;
use super::{Difficulty, EpisodeStart, ObservationTerm, Reached, Step, StepEvaluation, Task, servos};
use crate::config::{EnvironmentConfig, MOTION_TERMS, MotionConfig, MotionRewards};
use crate::error::{ModelError, StateError};
use crate::model::mirror::{Mirror, SignedPermutation};
use crate::physics::{LinkMotion, Physics};
use crate::randomisation::{SensorNoise, stream};

/// Numbers of the state beside actions: steps, step of the motion, whether it failed, where it failed last and where the
/// episode began.
const SAVED: usize = 5;
/// Greatest tilt of the anchor against the base in the default pose with which observations have a mirror image (rad).
const TURNED_MAX_RAD: f64 = 1e-3;

/// Task of imitating motions.
pub struct MotionTask {
    config: MotionConfig,
    reference: Arc<Reference>,
    layout: Layout<MotionTask>,
    encoder_bias_rad: f64,
    in_training: bool,
    /// For each motor: hinge, default control and control per unit of action.
    motors: Vec<(usize, f64, f64)>,
    /// Inverse of the orientation of each compared link in the frame of the anchor in the default pose, so that what the
    /// critic sees of two sides are mirror images.
    default_turns: Vec<nalgebra::UnitQuaternion<f64>>,
    /// Whether the anchor is not turned against the base in the default pose, apart from a turn about y.
    has_mirror: bool,
    /// Errors of the encoders in this episode (rad).
    encoder_errors_rad: Vec<f64>,
    /// Control step of the motions that the policy sees, and that the next control step is to reach.
    step: usize,
    /// Control step at which this environment failed last, until it has come past it.
    failed: Option<usize>,
    /// Control step at which the present episode failed, which the learner counts.
    failed_now: Option<usize>,
    /// Motion with which episodes outside of training begin.
    chosen: usize,
    /// Control step at which the episode began.
    began: usize,
    episode_steps: u32,
    actions: Vec<f64>,
    actions_before: Vec<f64>,
    errors: MotionErrors,
    /// Terms of the last step's reward, without weights; 0 before the first step.
    rewarded: [f64; MOTION_TERMS],
}

impl MotionTask {
    /// Returns the task for a simulation in the default pose.
    ///
    /// # Errors
    /// [`ModelError`] if the robot has no card, or the model no motion.
    pub fn new(config: &EnvironmentConfig, physics: &Physics) -> Result<Self, ModelError> {
        let model = physics.model();
        let Some(robot) = &model.robot else {
            return Err(ModelError::Task(
                "the motion task needs a robot card, with servos: name one by env.robot, or give your own as --model \
                 CARD.toml; `treadmill robot FILE` drafts it"
                    .to_owned(),
            ));
        };
        let motors = servos(model, robot);
        let reference = Reference::shared(config, physics)?;
        let anchor = physics.link_pose(reference.compared.anchor).rotation;
        let in_anchor = |link: &usize| anchor.inverse() * physics.link_pose(*link).rotation;
        let turned = physics.body_motion(0).pose.rotation.inverse() * anchor;
        Ok(Self {
            layout: observation::layout(config, &reference.compared, motors.len()),
            config: config.motion.clone(),
            encoder_bias_rad: config.randomisation.encoder_bias_rad,
            in_training: config.has_curricula,
            default_turns: reference.compared.links.iter().map(|link| in_anchor(link).inverse()).collect(),
            has_mirror: (turned * nalgebra::Vector3::y() - nalgebra::Vector3::y()).norm() < TURNED_MAX_RAD,
            encoder_errors_rad: vec![0.0; model.hinges.len()],
            step: reference.motions[0].start + 1,
            failed: None,
            failed_now: None,
            chosen: 0,
            began: reference.motions[0].start,
            episode_steps: 0,
            actions: vec![0.0; motors.len()],
            actions_before: vec![0.0; motors.len()],
            errors: MotionErrors::default(),
            rewarded: [0.0; MOTION_TERMS],
            motors,
            reference,
        })
    }

    /// Returns the differences between the robot and the motion after the last control step; 0 before the first.
    #[must_use]
    pub fn errors(&self) -> &MotionErrors {
        &self.errors
    }

    /// Returns the index of the motion in [`crate::Model::motions`].
    #[must_use]
    pub fn motion(&self) -> usize {
        self.reference.motions.iter().position(|motion| motion.contains(&self.step)).unwrap_or_default()
    }

    /// Returns the name of the motion, the time in it (s) and its duration (s).
    #[must_use]
    pub fn place(&self, physics: &Physics) -> (String, f64, f64) {
        let step_s = physics.settings().control_step_s;
        let number = self.motion();
        let motion = &self.reference.motions[number];
        let seconds = |steps: usize| steps as f64 * step_s;
        let name = physics.model().motions[number].name.clone();
        (name, seconds(self.step - motion.start), seconds(motion.len() - 1))
    }

    /// Returns the position vector of the motion that the next control step is to reach.
    #[must_use]
    pub fn wanted_position(&self) -> &[f64] {
        &self.reference.positions[self.step]
    }

    /// Returns what is compared.
    #[must_use]
    pub fn compared(&self) -> &Compared {
        &self.reference.compared
    }

    /// Returns the control steps of each motion, in the order of [`crate::Model::motions`].
    #[must_use]
    pub fn motions(&self) -> &[Range<usize>] {
        &self.reference.motions
    }

    /// Returns position and velocity vector of the motions at a control step, and the compared links.
    ///
    /// # Panics
    /// If there is no such control step.
    pub fn at(&self, step: usize) -> (&[f64], &[f64], impl Iterator<Item = LinkMotion>) {
        (&self.reference.positions[step], &self.reference.velocities[step], self.reference.links(step))
    }

    /// Returns the steps of the motion after the present one that the policy sees.
    fn further_steps(&self) -> impl Iterator<Item = usize> {
        let last = self.reference.motion_of(self.step).end - 1;
        (1..=self.config.future_steps as usize).map(move |further| (self.step + further).min(last))
    }
}

impl Task for MotionTask {
    fn terms(&self) -> &[ObservationTerm] {
        &self.layout.terms
    }

    fn start(&mut self, seed: u64, _: &Physics, start: EpisodeStart<'_>) {
        self.begin_motion(seed, start);
    }

    fn choose_start(&mut self, number: u64) {
        self.chosen = (number % self.reference.motions.len() as u64) as usize;
    }

    fn stays_above_ground(&self) -> bool {
        true
    }

    fn begin(&mut self, seed: u64, _: &Physics) {
        let mut encoders = stream(seed, "encoders");
        let bias_rad = self.encoder_bias_rad;
        self.encoder_errors_rad.fill_with(|| (2.0 * encoders.random::<f64>() - 1.0) * bias_rad);
        self.episode_steps = 0;
        self.failed_now = None;
        self.actions.fill(0.0);
        self.actions_before.fill(0.0);
        self.errors = MotionErrors::default();
        self.rewarded = [0.0; MOTION_TERMS];
    }

    fn change_action(&self, action: &mut [f32]) {
        if self.config.residual_action {
            for (target, (hinge, default, _)) in action.iter_mut().zip(&self.motors) {
                *target += (self.reference.positions[self.step][7 + hinge] - default) as f32;
            }
        }
    }

    fn evaluate(&mut self, step: &Step<'_>) -> StepEvaluation {
        self.episode_steps = self.episode_steps.saturating_add(1);
        self.actions_before.copy_from_slice(&self.actions);
        for ((action, given), (_, default, scale)) in self.actions.iter_mut().zip(step.action).zip(&self.motors) {
            *action = ((f64::from(*given) - default) / scale).clamp(-ACTION_MAX, ACTION_MAX);
        }
        let moved = MotionStep {
            config: &self.config,
            physics: step.physics,
            reference: &self.reference,
            step: self.step,
            actions: [&self.actions, &self.actions_before],
        };
        let (terms, has_failed) = (moved.values(), moved.has_failed());
        self.errors = moved.errors();
        let weighted = self.config.weights().into_iter().zip(terms);
        let reward = weighted.fold(0.0, |sum, (weight, term)| sum + weight * term);
        self.rewarded = terms;
        let is_last = self.step + 1 >= self.reference.motion_of(self.step).end;
        self.failed_now = has_failed.then_some(self.step);
        if has_failed {
            self.failed = self.failed_now;
        } else if self.failed.is_some_and(|failed| self.has_passed(failed)) {
            self.failed = None;
        }
        if !is_last {
            self.step += 1;
        }
        StepEvaluation { reward: reward as f32, terminated: has_failed, truncated: is_last && !has_failed }
    }

    fn reward_terms(&self, each: &mut dyn FnMut(&'static str, f64)) {
        let terms = MotionConfig::TERM_NAMES.into_iter().zip(self.config.weights()).zip(self.rewarded);
        terms.filter(|((_, weight), _)| *weight != 0.0).for_each(|((name, weight), term)| each(name, weight * term));
    }

    fn observe(&mut self, physics: &Physics, noise: &mut SensorNoise, observation: &mut [f32]) {
        let (seen, hidden) = observation.split_at_mut(self.layout.of_policy());
        let view = MotionView::new(self, physics);
        self.layout.write(&view, false, noise, seen);
        self.layout.write(&view, true, noise, hidden);
    }

    fn mirrored(&self, robot: &Mirror) -> Option<SignedPermutation> {
        let image = |part| observation::image(part, &self.reference.compared, robot);
        self.layout.mirrored(image).filter(|_| self.has_mirror)
    }

    fn difficulty(&self) -> Difficulty {
        Difficulty { failed_step: self.failed_now.map(|step| step as u32), ..Difficulty::default() }
    }

    fn adopt_curricula(&mut self, reached: &Reached<'_>, seed: u64) {
        let failures = reached.failed_steps;
        if !failures.is_empty() {
            let drawn = failures[stream(seed, "curricula").random_range(0..failures.len())] as usize;
            self.failed = Some(drawn.min(self.reference.positions.len() - 1));
        }
    }

    fn save(&self) -> Vec<f64> {
        let failed = self.failed.map_or([0.0, 0.0], |step| [1.0, step as f64]);
        let numbers =
            [f64::from(self.episode_steps), self.step as f64].into_iter().chain(failed).chain([self.began as f64]);
        numbers.chain(self.actions.iter().copied()).collect()
    }

    fn restore(&mut self, numbers: &[f64]) -> Result<(), StateError> {
        let expected = SAVED + self.actions.len();
        let steps = self.reference.positions.len();
        if numbers.len() != expected {
            return Err(StateError::Length { what: "task", found: numbers.len(), expected });
        }
        let within = |number: f64| (number.max(0.0) as usize).min(steps - 1);
        self.episode_steps = numbers[0] as u32;
        self.step = within(numbers[1]);
        self.failed = (numbers[2] != 0.0).then(|| within(numbers[3]));
        self.began = within(numbers[4]);
        self.actions.copy_from_slice(&numbers[SAVED..]);
        Ok(())
    }
}
