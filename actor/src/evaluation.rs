//! Episodes without learning, and their statistics.
//!
//! # Layout
//! - [`tracking`]: how well a robot follows its commands.
//! - [`imitation`]: how well it imitates a motion.

pub mod imitation;
pub mod tracking;

use std::ops::ControlFlow;

use treadmill_humanoid::Environment;
use treadmill_runtime::seeds;

use self::imitation::{Imitation, Imitator};
use self::tracking::{Tracker, Tracking, TrackingSample};
use crate::{ActorError, agent::Agent};

/// Result of one finished episode.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EpisodeResult {
    /// Sum of rewards.
    pub return_sum: f64,
    /// Control steps.
    pub length: u32,
    /// Forward distance (m).
    pub distance_m: f64,
    /// Distance over time (m/s).
    pub velocity_mps: f64,
    /// Whether it ended with a fall.
    pub fell: bool,
    /// Whether the physics failed.
    pub fault: bool,
    /// How well it followed its commands; none for tasks without commands.
    pub tracking: Option<Tracking>,
    /// How well it imitated its motion; none for tasks without motions.
    pub imitation: Option<Imitation>,
}

/// Joint limit violations over every step of every episode.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointReport {
    /// 99.9th percentile of the overshoot beyond a limit (rad).
    pub overshoot_p999_rad: f64,
    /// Largest overshoot (rad).
    pub overshoot_max_rad: f64,
}

/// What the agent faced at the beginning of a step, and what it chose.
#[derive(Clone, Copy)]
pub struct StepStart<'a> {
    /// Observation.
    pub observation: &'a [f32],
    /// Action: −1 is the lower end of a motor's range, 1 the upper one.
    pub action: &'a [f32],
    /// Position vector, see [`Physics::position`].
    pub position: &'a [f64],
    /// Velocity vector, see [`Physics::velocity`].
    pub velocity: &'a [f64],
    /// Command in the observation, see [`treadmill_humanoid::Task::command`].
    pub command: Option<[f64; 3]>,
}

/// One step of an episode, passed to the callback of [`evaluate`].
#[derive(Clone, Copy)]
pub struct EvaluationStep<'a> {
    /// Episode, counted from 1.
    pub episode: u32,
    /// Step within the episode, counted from 1.
    pub step: u32,
    /// Beginning of the step.
    pub start: StepStart<'a>,
    /// Reward of the step.
    pub reward: f32,
    /// Sum of rewards so far.
    pub total: f64,
    /// Environment after the step.
    pub environment: &'a Environment,
    /// Result of the episode, after its last step.
    pub ended: Option<EpisodeResult>,
}

/// Results of an evaluation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Evaluation {
    /// Every episode.
    pub episodes: Vec<EpisodeResult>,
    /// Joint limit violations.
    pub joints: JointReport,
}

impl Evaluation {
    /// Returns the mean of a value over episodes.
    pub fn mean(&self, value: impl Fn(&EpisodeResult) -> f64) -> f64 {
        self.episodes.iter().map(value).sum::<f64>() / self.episodes.len().max(1) as f64
    }

    /// Returns the population standard deviation of the return.
    pub fn return_std(&self) -> f64 {
        let mean = self.mean(|episode| episode.return_sum);
        self.mean(|episode| (episode.return_sum - mean).powi(2)).sqrt()
    }

    /// Returns total distance over total time, so that a short fall weighs less than a long walk.
    pub fn velocity_mean_mps(&self, control_step_s: f64) -> f64 {
        let time_s = self.episodes.iter().map(|episode| f64::from(episode.length)).sum::<f64>() * control_step_s;
        self.episodes.iter().map(|episode| episode.distance_m).sum::<f64>() / time_s.max(1e-9)
    }

    /// Returns the number of episodes that ended with a fall.
    pub fn falls(&self) -> usize {
        self.episodes.iter().filter(|episode| episode.fell).count()
    }

    /// Returns how well motions were imitated in all episodes; `None` for tasks without motions.
    pub fn imitation(&self) -> Option<Imitation> {
        self.episodes.iter().filter_map(|episode| episode.imitation).reduce(Imitation::with)
    }

    /// Returns how well commands were followed in all episodes; `None` for tasks without commands.
    pub fn tracking(&self) -> Option<Tracking> {
        self.episodes.iter().filter_map(|episode| episode.tracking).reduce(Tracking::with)
    }
}

/// Plays `episodes` episodes, several of them with the beginnings of the task in turn, and calls `on_step` after every step,
/// which may end the evaluation.
pub fn evaluate(
    environment: &mut Environment,
    agent: &mut dyn Agent,
    episodes: u32,
    seed: u64,
    on_step: impl FnMut(EvaluationStep) -> ControlFlow<()>,
) -> Result<Evaluation, ActorError> {
    evaluate_commanded(environment, agent, episodes, seed, None, on_step)
}

/// As [`evaluate`]; with `command_at`, each episode follows the command that it returns for the time since the start (s).
pub fn evaluate_commanded(
    environment: &mut Environment,
    agent: &mut dyn Agent,
    episodes: u32,
    seed: u64,
    command_at: Option<&dyn Fn(f64) -> [f64; 3]>,
    mut on_step: impl FnMut(EvaluationStep) -> ControlFlow<()>,
) -> Result<Evaluation, ActorError> {
    let control_step_s = environment.control_step_s();
    let mut observation = vec![0.0; environment.observation_size()];
    let mut action = vec![0.0; environment.action_size()];
    let mut control = action.clone();
    let mut observed = observation.clone();
    let (mut position, mut velocity) = (Vec::new(), Vec::new());
    let mut overshoots = Vec::new();
    let mut results = Vec::new();
    'evaluation: for episode in 0..episodes {
        if episodes > 1 {
            environment.choose_start(episode.into());
        }
        if let Some(command_at) = command_at {
            environment.steer(Some(command_at(0.0)));
        }
        environment.reset(seeds::derive(seed, "evaluation", &[episode.into()]), &mut observation);
        let start_x_m = environment.physics().position()[0];
        let mut result = EpisodeResult::default();
        let mut tracker = environment.task().command().map(|_| Tracker::new(control_step_s));
        let mut imitator = Imitator::of(environment);
        let mut changes = None;
        loop {
            agent.act(&observation, &mut action)?;
            observed.copy_from_slice(&observation);
            position.clear();
            position.extend_from_slice(environment.physics().position());
            velocity.clear();
            velocity.extend_from_slice(environment.physics().velocity());
            let command = environment.task().command();
            let changes_now = Some(environment.task().command_changes());
            let is_new_command = std::mem::replace(&mut changes, changes_now) != changes_now;
            if let Some(command_at) = command_at {
                // The observation after this step shows it.
                environment.steer(Some(command_at(f64::from(result.length + 1) * control_step_s)));
            }
            environment.action_from_shares(&action, &mut control);
            let step = environment.step(&control, &mut observation);
            result.length += 1;
            result.fault = step.fault;
            if !step.fault {
                agent.rewarded(step.reward);
                result.return_sum += f64::from(step.reward);
                result.distance_m = environment.physics().position()[0] - start_x_m;
                overshoots.push(environment.physics().limit_overshoot_rad());
                if let (Some(tracker), Some(command)) = (&mut tracker, command) {
                    let sample = TrackingSample::of(environment.physics(), [position[0], position[1]]);
                    let is_pushed = environment.was_pushed();
                    tracker.record(&TrackingSample { command, is_new_command, is_pushed, ..sample });
                }
            }
            if let Some(imitator) = imitator.as_mut().filter(|_| !step.fault) {
                imitator.record(environment);
            }
            let has_ended = step.terminated || step.truncated;
            if has_ended {
                result.fell = step.terminated && !step.fault;
                result.velocity_mps = result.distance_m / (f64::from(result.length) * control_step_s);
                result.tracking = tracker.as_ref().map(Tracker::sums);
                result.imitation = imitator.take().map(|imitator| imitator.end(step.terminated));
                agent.episode_ended();
                results.push(result);
            }
            let flow = on_step(EvaluationStep {
                episode: episode + 1,
                step: result.length,
                start: StepStart {
                    observation: &observed,
                    action: &action,
                    position: &position,
                    velocity: &velocity,
                    command,
                },
                reward: step.reward,
                total: result.return_sum,
                environment,
                ended: has_ended.then_some(result),
            });
            if flow.is_break() {
                break 'evaluation;
            }
            if has_ended {
                break;
            }
        }
    }
    if command_at.is_some() {
        environment.steer(None);
    }
    Ok(Evaluation { episodes: results, joints: joint_report(&mut overshoots) })
}

fn joint_report(overshoots: &mut [f64]) -> JointReport {
    JointReport { overshoot_p999_rad: percentile(overshoots, 0.999), overshoot_max_rad: percentile(overshoots, 1.0) }
}

/// Returns a percentile by nearest rank; 0 without samples.
fn percentile(samples: &mut [f64], share: f64) -> f64 {
    samples.sort_by(f64::total_cmp);
    let rank = (share * samples.len() as f64).ceil() as usize;
    samples.get(rank.saturating_sub(1)).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_use_the_nearest_rank() {
        let mut samples: Vec<f64> = (1..=1000).rev().map(f64::from).collect();
        assert_eq!(percentile(&mut samples, 0.999), 999.0);
        assert_eq!(percentile(&mut samples, 1.0), 1000.0);
        assert_eq!(percentile(&mut [], 0.5), 0.0);
    }

    #[test]
    fn means_match_a_hand_computation() {
        let result =
            |return_sum, length, distance_m| EpisodeResult { return_sum, length, distance_m, ..Default::default() };
        let evaluation = Evaluation {
            episodes: vec![result(10.0, 100, 3.0), result(30.0, 300, 1.0)],
            joints: JointReport::default(),
        };
        assert_eq!(evaluation.mean(|episode| episode.return_sum), 20.0);
        assert_eq!(evaluation.return_std(), 10.0);
        // 4 m in 400 steps of 15 ms.
        assert!((evaluation.velocity_mean_mps(0.015) - 4.0 / 6.0).abs() < 1e-12);
    }
}
