//! Episodes without learning, and their statistics.

use std::ops::ControlFlow;

use treadmill_humanoid::{Environment, Physics, StepInfo};
use treadmill_runtime::seeds;

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
}

/// Joint limit violations over every step of every episode.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointReport {
    /// 99.9th percentile of the overshoot beyond a limit (rad).
    pub overshoot_p999_rad: f64,
    /// Largest overshoot (rad).
    pub overshoot_max_rad: f64,
}

/// One step of an episode, passed to the callback of [`evaluate`].
#[derive(Clone, Copy)]
pub struct EvaluationStep<'a> {
    /// Episode, counted from 1.
    pub episode: u32,
    /// Step within the episode, counted from 1.
    pub step: u32,
    /// Reward of the step.
    pub reward: f32,
    /// Sum of rewards so far.
    pub total: f64,
    /// Details of the step.
    pub info: &'a StepInfo,
    /// Body after the step.
    pub physics: &'a Physics,
    /// Velocity that the task asks for, see [`treadmill_humanoid::Task::command`].
    pub command: Option<[f64; 3]>,
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
}

/// Plays `episodes` episodes and calls `on_step` after every step, which may end the evaluation.
pub fn evaluate(
    environment: &mut Environment,
    agent: &mut dyn Agent,
    episodes: u32,
    seed: u64,
    mut on_step: impl FnMut(EvaluationStep) -> ControlFlow<()>,
) -> Result<Evaluation, ActorError> {
    let mut observation = vec![0.0; environment.observation_size()];
    let mut action = vec![0.0; environment.action_size()];
    let mut control = action.clone();
    let mut overshoots = Vec::new();
    let mut results = Vec::new();
    'evaluation: for episode in 0..episodes {
        environment.reset(seeds::derive(seed, "evaluation", &[episode.into()]), &mut observation);
        let start_x_m = environment.physics().position()[0];
        let mut result = EpisodeResult::default();
        loop {
            agent.act(&observation, &mut action)?;
            environment.action_from_shares(&action, &mut control);
            let step = environment.step(&control, &mut observation);
            result.length += 1;
            result.fault = step.fault;
            if !step.fault {
                agent.rewarded(step.reward);
                result.return_sum += f64::from(step.reward);
                result.distance_m = environment.physics().position()[0] - start_x_m;
                overshoots.push(environment.joint_quality().limit_overshoot_rad);
            }
            let has_ended = step.terminated || step.truncated;
            if has_ended {
                result.fell = step.terminated && !step.fault;
                result.velocity_mps = result.distance_m / (f64::from(result.length) * environment.control_step_s());
                agent.episode_ended();
                results.push(result);
            }
            let flow = on_step(EvaluationStep {
                episode: episode + 1,
                step: result.length,
                reward: step.reward,
                total: result.return_sum,
                info: environment.info(),
                physics: environment.physics(),
                command: environment.task().command(),
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
