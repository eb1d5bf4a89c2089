//! Episodes without learning, and what came of them.

use treadmill_humanoid::{Environment, Physics, StepInfo, StepOutcome};
use treadmill_runtime::seeds;

use crate::{ActorError, agent::Agent};

/// One finished episode.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Played {
    /// Sum of rewards.
    pub return_sum: f64,
    /// Control steps.
    pub length: u32,
    /// Forward distance.
    pub distance_m: f64,
    /// Distance over time.
    pub velocity_mps: f64,
    /// Whether it ended with a fall.
    pub fell: bool,
    /// Whether the physics failed.
    pub fault: bool,
}

/// How far the joints were from perfect, over every step of every episode.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointReport {
    /// 99.9 % of samples overshoot a limit by at most this.
    pub overshoot_p999_rad: f64,
    /// The largest overshoot seen.
    pub overshoot_max_rad: f64,
}

/// A step as it is told while an episode runs.
#[derive(Clone, Copy)]
pub struct Told<'a> {
    /// Episode, counted from 1.
    pub episode: u32,
    /// Step within the episode, counted from 1.
    pub step: u32,
    /// Its reward.
    pub reward: f32,
    /// Sum of rewards so far.
    pub total: f64,
    /// The step in detail.
    pub info: &'a StepInfo,
    /// The body after it.
    pub physics: &'a Physics,
}

/// What an evaluation gave.
#[derive(Clone, Debug, PartialEq)]
pub struct Evaluation {
    /// Every episode.
    pub episodes: Vec<Played>,
    /// Joint quality.
    pub joints: JointReport,
}

impl Evaluation {
    /// Mean over episodes.
    pub fn mean(&self, of: impl Fn(&Played) -> f64) -> f64 {
        self.episodes.iter().map(of).sum::<f64>() / self.episodes.len().max(1) as f64
    }

    /// Standard deviation of the return, over the population of episodes played.
    pub fn return_std(&self) -> f64 {
        let mean = self.mean(|played| played.return_sum);
        self.mean(|played| (played.return_sum - mean).powi(2)).sqrt()
    }

    /// Forward velocity over all steps: total distance over total time, so that a short fall does not weigh as much as
    /// a long walk.
    pub fn velocity_mean_mps(&self, control_step_s: f64) -> f64 {
        let time_s = self.episodes.iter().map(|played| f64::from(played.length)).sum::<f64>() * control_step_s;
        self.episodes.iter().map(|played| played.distance_m).sum::<f64>() / time_s.max(1e-9)
    }

    /// Episodes that ended with a fall.
    pub fn falls(&self) -> usize {
        self.episodes.iter().filter(|played| played.fell).count()
    }
}

/// Plays `episodes` episodes; every step is told to `tell`.
pub fn evaluate(
    environment: &mut Environment,
    agent: &mut dyn Agent,
    episodes: u32,
    seed: u64,
    mut tell: impl FnMut(Told),
) -> Result<Evaluation, ActorError> {
    let mut observation = vec![0.0; environment.observation_size()];
    let mut action = vec![0.0; environment.action_size()];
    let mut control = action.clone();
    let mut overshoots = Vec::new();
    let mut all = Vec::new();
    for episode in 0..episodes {
        environment.reset(seeds::derive(seed, "evaluation", &[episode.into()]), &mut observation);
        let start_x_m = environment.physics().position()[0];
        let mut played = Played::default();
        loop {
            agent.act(&observation, &mut action)?;
            environment.action_from_shares(&action, &mut control);
            let step: StepOutcome = environment.step(&control, &mut observation);
            played.length += 1;
            played.fault = step.fault;
            if !step.fault {
                agent.rewarded(step.reward);
                played.return_sum += f64::from(step.reward);
                played.distance_m = environment.physics().position()[0] - start_x_m;
                overshoots.push(environment.joint_quality().limit_overshoot_rad);
            }
            tell(Told {
                episode: episode + 1,
                step: played.length,
                reward: step.reward,
                total: played.return_sum,
                info: environment.info(),
                physics: environment.physics(),
            });
            if step.terminated || step.truncated {
                played.fell = step.terminated && !step.fault;
                break;
            }
        }
        played.velocity_mps = played.distance_m / (f64::from(played.length) * environment.control_step_s());
        agent.episode_ended();
        all.push(played);
    }
    Ok(Evaluation { episodes: all, joints: joint_report(&mut overshoots) })
}

fn joint_report(overshoots: &mut [f64]) -> JointReport {
    JointReport { overshoot_p999_rad: percentile(overshoots, 0.999), overshoot_max_rad: percentile(overshoots, 1.0) }
}

/// The smallest sample that at least this share of samples does not exceed; 0 without samples.
fn percentile(samples: &mut [f64], share: f64) -> f64 {
    samples.sort_by(f64::total_cmp);
    let rank = (share * samples.len() as f64).ceil() as usize;
    samples.get(rank.saturating_sub(1)).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_by_nearest_rank() {
        let mut samples: Vec<f64> = (1..=1000).rev().map(f64::from).collect();
        assert_eq!(percentile(&mut samples, 0.999), 999.0);
        assert_eq!(percentile(&mut samples, 1.0), 1000.0);
        assert_eq!(percentile(&mut [], 0.5), 0.0);
    }

    #[test]
    fn means_by_hand() {
        let played = |return_sum, length, distance_m| Played { return_sum, length, distance_m, ..Played::default() };
        let evaluation = Evaluation {
            episodes: vec![played(10.0, 100, 3.0), played(30.0, 300, 1.0)],
            joints: JointReport::default(),
        };
        assert_eq!(evaluation.mean(|played| played.return_sum), 20.0);
        assert_eq!(evaluation.return_std(), 10.0);
        // 4 m in 400 steps of 15 ms.
        assert!((evaluation.velocity_mean_mps(0.015) - 4.0 / 6.0).abs() < 1e-12);
    }
}
