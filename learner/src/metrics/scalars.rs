//! Scalars of each update, by tag.

use std::{
    collections::{BTreeSet, HashMap},
    time::{Duration, Instant},
};

use treadmill_ppo::{AcceptedFragment, UpdateStats};
use treadmill_proto::{ActorStats, EvaluationReport};
use treadmill_runtime::machine;

use super::{Efficiency, History};
use crate::checkpoint::TrainingState;

/// Durations of the phases of one update.
#[derive(Clone, Copy, Debug, Default)]
pub struct PhaseDurations {
    /// Waiting for fragments and validating them.
    pub collect: Duration,
    /// Estimating advantages and learning.
    pub update: Duration,
    /// Gradient steps alone.
    pub learn: Duration,
    /// Updating the state and writing the checkpoint.
    pub checkpoint: Duration,
    /// Encoding and announcing the new policy, and releasing the receipts.
    pub publish: Duration,
    /// Work of the training thread besides the update: logging the last one, validating, saving and publishing.
    pub serial: Duration,
}

/// Lag of the batch, over transitions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PolicyLag {
    /// Mean number of versions behind.
    pub mean: f64,
    /// Largest number of versions behind.
    pub max: f64,
    /// Share of transitions that are 0, 1, 2, 3, 4, and 5 or more versions behind.
    pub shares: [f64; LAG_SHARES.len()],
    /// Number of transitions.
    pub transitions: f64,
}

/// Tags of the shares of each lag.
const LAG_SHARES: [&str; 6] = [
    "bus/policy_lag_0_share",
    "bus/policy_lag_1_share",
    "bus/policy_lag_2_share",
    "bus/policy_lag_3_share",
    "bus/policy_lag_4_share",
    "bus/policy_lag_5_up_share",
];

impl PolicyLag {
    /// Computes the lag over every transition of a batch.
    pub fn of(batch: &[AcceptedFragment]) -> Self {
        let transitions: f64 = batch.iter().map(|accepted| accepted.fragment.transitions() as f64).sum();
        let mut lag = Self { transitions, ..Self::default() };
        for accepted in batch {
            let share = accepted.fragment.transitions() as f64 / transitions.max(1.0);
            lag.mean += share * accepted.lag as f64;
            lag.max = lag.max.max(accepted.lag as f64);
            lag.shares[(accepted.lag as usize).min(LAG_SHARES.len() - 1)] += share;
        }
        lag
    }
}

/// Measures the throughput over the last updates.
#[derive(Debug)]
pub struct ThroughputMeter {
    marks: std::collections::VecDeque<Mark>,
    waited: Duration,
}

#[derive(Clone, Copy, Debug)]
struct Mark {
    at: Instant,
    env_steps: u64,
    waited: Duration,
}

/// Throughput of the last updates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Throughput {
    /// Environment steps per second.
    pub env_steps_per_s: f64,
    /// Share of the time in which the learner waited for rollouts.
    pub wait_share: f64,
}

impl ThroughputMeter {
    /// Number of updates in the measurement.
    const UPDATES: usize = 20;

    /// Starts to measure.
    pub fn new(env_steps: u64) -> Self {
        let mark = Mark { at: Instant::now(), env_steps, waited: Duration::ZERO };
        Self { marks: [mark].into(), waited: Duration::ZERO }
    }

    /// Records the steps so far and the wait for the last ones. Returns the throughput since the oldest record.
    pub fn mark(&mut self, env_steps: u64, waited: Duration) -> Throughput {
        let at = Instant::now();
        self.waited += waited;
        self.marks.push_back(Mark { at, env_steps, waited: self.waited });
        if self.marks.len() > Self::UPDATES {
            self.marks.pop_front();
        }
        let oldest = self.marks.front().copied().expect("a mark was just added");
        let passed_s = at.duration_since(oldest.at).as_secs_f64().max(1e-9);
        Throughput {
            env_steps_per_s: (env_steps - oldest.env_steps) as f64 / passed_s,
            wait_share: ((self.waited - oldest.waited).as_secs_f64() / passed_s).min(1.0),
        }
    }
}

/// Sources of the scalars of one update.
pub struct UpdateRecord<'a> {
    /// State after the update.
    pub state: &'a TrainingState,
    /// Largest distance of a probability ratio from 1 that the loss rewards.
    pub clip_range: f64,
    /// Statistics of the update; `None` if it was undone.
    pub update: Option<&'a UpdateStats>,
    /// Lag of the batch.
    pub lag: PolicyLag,
    /// Tag and mean over the batch of each term of the reward.
    pub reward_terms: Vec<(String, f64)>,
    /// Passes over the batch.
    pub epochs: u32,
    /// Durations of the phases.
    pub durations: PhaseDurations,
    /// Report of an evaluation that has just ended, and the environment steps that its policy has learnt from.
    pub evaluation: Option<(&'a EvaluationReport, u64)>,
    /// History of the run, including this update.
    pub history: &'a History,
    /// Throughput of the last updates.
    pub throughput: Throughput,
    /// Efficiency of the fleet over the last updates.
    pub efficiency: Efficiency,
    /// Actors that are alive.
    pub alive: &'a BTreeSet<String>,
    /// Newest statistics of each actor.
    pub stats: &'a HashMap<String, ActorStats>,
    /// Senders in quarantine.
    pub quarantined: usize,
    /// Number of fragments rejected unread because the queue was full, since this start.
    pub turned_away: u64,
    /// Size of the accepted fragments in bytes, since this start.
    pub accepted_bytes: u64,
}

impl UpdateRecord<'_> {
    /// Returns every tag with its value.
    pub fn scalars(&self) -> Vec<(String, f64)> {
        let mut out: Vec<(&str, f64)> = Vec::with_capacity(64);
        self.rollout(&mut out);
        self.time(&mut out);
        self.train(&mut out);
        self.bus(&mut out);
        self.actors(&mut out);
        self.eval(&mut out);
        let mut scalars: Vec<_> = out.into_iter().map(|(tag, value)| (tag.to_string(), value)).collect();
        scalars.extend_from_slice(&self.reward_terms);
        scalars
    }

    fn rollout(&self, out: &mut Vec<(&str, f64)>) {
        if let Some(means) = self.state.episodes.means() {
            out.extend([
                ("rollout/ep_rew_mean", means.return_mean),
                ("rollout/ep_len_mean", means.length_mean),
                ("rollout/distance_mean_m", means.distance_mean_m),
                ("rollout/velocity_mean_mps", means.velocity_mean_mps),
                ("rollout/fall_fraction", means.fall_fraction),
            ]);
            out.extend(means.ground_level.map(|level| ("rollout/ground_level", level)));
            out.extend(means.command_factor.map(|factor| ("rollout/command_factor", factor)));
        }
        out.extend(self.history.distance_best_m.map(|best_m| ("rollout/distance_best_m", best_m)));
        out.push(("rollout/episodes", self.state.episodes.finished as f64));
        out.extend(self.efficiency.used_share.map(|share| ("rollout/used_share", share)));
    }

    fn time(&self, out: &mut Vec<(&str, f64)>) {
        let counters = &self.state.counters;
        out.extend([
            ("time/fps", self.throughput.env_steps_per_s),
            ("time/iterations", counters.updates as f64),
            ("time/time_elapsed", counters.wall_s),
            ("time/total_timesteps", counters.env_steps as f64),
            ("time/collect_s", self.durations.collect.as_secs_f64()),
            ("time/update_s", self.durations.update.as_secs_f64()),
            ("time/checkpoint_s", self.durations.checkpoint.as_secs_f64()),
            ("time/publish_s", self.durations.publish.as_secs_f64()),
            ("time/serial_s", self.durations.serial.as_secs_f64()),
        ]);
    }

    fn train(&self, out: &mut Vec<(&str, f64)>) {
        if let Some(update) = self.update {
            out.extend([
                ("train/approx_kl", update.approx_kl),
                ("train/clip_fraction", update.clip_fraction),
                // Stable-Baselines3 logs the loss, which is the negative entropy.
                ("train/entropy_loss", -update.entropy),
                ("train/explained_variance", update.explained_variance),
                ("train/policy_gradient_loss", update.policy_loss),
                ("train/value_loss", update.value_loss),
                ("train/bounds_loss", update.bounds_loss),
                ("train/grad_norm", update.grad_norm),
                ("train/std", update.std),
                ("train/samples_per_s", update.samples as f64 / self.durations.learn.as_secs_f64().max(1e-9)),
            ]);
        }
        let counters = &self.state.counters;
        out.extend([
            ("train/clip_range", self.clip_range),
            ("train/batch", self.lag.transitions),
            ("train/epochs", f64::from(self.epochs)),
            ("train/learning_rate", self.state.ppo.learning_rate()),
            ("train/n_updates", counters.gradient_steps as f64),
            ("train/undone_updates", counters.undone_updates as f64),
        ]);
    }

    fn bus(&self, out: &mut Vec<(&str, f64)>) {
        let (counts, account) = (&self.state.fragment_counts, self.state.ledger.total());
        out.extend([("bus/policy_lag_mean", self.lag.mean), ("bus/policy_lag_max", self.lag.max)]);
        out.extend(LAG_SHARES.into_iter().zip(self.lag.shares));
        out.extend([
            ("bus/fragments_accepted", counts.accepted as f64),
            ("bus/fragments_duplicate", counts.duplicate as f64),
            ("bus/fragments_too_old", counts.too_old as f64),
            ("bus/fragments_vanished", counts.vanished as f64),
            ("bus/fragments_malformed", counts.malformed as f64),
            ("bus/fragments_implausible", counts.implausible as f64),
            ("bus/fragments_quarantined", counts.quarantined as f64),
            ("bus/fragments_turned_away", self.turned_away as f64),
            ("bus/accepted_mb", self.accepted_bytes as f64 / 1e6),
            ("bus/fragments_unseen", account.unseen as f64),
            ("bus/env_steps_dropped", account.env_steps_dropped as f64),
        ]);
    }

    fn eval(&self, out: &mut Vec<(&str, f64)>) {
        let Some((report, env_steps)) = self.evaluation else { return };
        out.extend([
            ("eval/mean_reward", report.return_mean),
            ("eval/std_reward", report.return_std),
            ("eval/mean_ep_length", report.length_mean),
            ("eval/distance_mean_m", report.distance_mean_m),
            ("eval/distance_best_m", self.history.evaluated_best_m.unwrap_or(report.distance_mean_m)),
            ("eval/velocity_mean_mps", report.velocity_mean_mps),
            ("eval/fall_fraction", f64::from(report.falls) / f64::from(report.episodes)),
            ("eval/total_timesteps", env_steps as f64),
        ]);
        out.extend(report.velocity_error_mps.map(|error| ("eval/velocity_error", error)));
        out.extend(report.yaw_rate_error_radps.map(|error| ("eval/yaw_rate_error", error)));
    }

    fn actors(&self, out: &mut Vec<(&str, f64)>) {
        let sum = |of: fn(&ActorStats) -> f64| self.stats.values().map(of).sum::<f64>();
        let memory_max = self.stats.values().map(|stats| stats.resident_bytes).max().unwrap_or(0);
        out.extend([
            ("actors/alive", self.alive.len() as f64),
            ("actors/envs", sum(|stats| f64::from(stats.envs))),
            ("actors/restarts", self.state.counters.restarts as f64),
            ("actors/quarantined", self.quarantined as f64),
            ("actors/physics_faults", self.state.episodes.faults as f64),
            ("actors/env_steps_per_s", sum(|stats| stats.env_steps_per_s)),
            ("actors/fragments_resent", sum(|stats| stats.resent as f64)),
            ("actors/memory_max_mb", memory_max as f64 / 1e6),
            ("learner/wait_share", self.throughput.wait_share),
            ("learner/memory_mb", machine::resident_bytes() as f64 / 1e6),
        ]);
        out.extend(self.efficiency.idle_share.map(|share| ("actors/idle_share", share)));
    }
}
