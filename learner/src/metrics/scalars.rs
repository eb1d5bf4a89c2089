//! Sources of the scalars of each update.

use std::{
    collections::{BTreeSet, HashMap},
    time::Duration,
};

use treadmill_ppo::{AcceptedFragment, UpdateStats};
use treadmill_proto::{ActorStats, EvaluationReport};

use super::{Efficiency, History, catalogue::METRICS, parts::PartTimes};
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
    pub shares: [f64; 6],
    /// Number of transitions.
    pub transitions: f64,
}

impl PolicyLag {
    /// Computes the lag over every transition of a batch.
    pub fn of(batch: &[AcceptedFragment]) -> Self {
        let transitions: f64 = batch.iter().map(|accepted| accepted.fragment.transitions() as f64).sum();
        let mut lag = Self { transitions, ..Self::default() };
        for accepted in batch {
            let share = accepted.fragment.transitions() as f64 / transitions.max(1.0);
            lag.mean += share * accepted.lag as f64;
            lag.max = lag.max.max(accepted.lag as f64);
            lag.shares[(accepted.lag as usize).min(lag.shares.len() - 1)] += share;
        }
        lag
    }
}

/// Sources of the scalars of one update.
pub struct UpdateRecord<'a> {
    /// State after the update.
    pub state: &'a TrainingState,
    /// Largest distance of a probability ratio from 1 that the loss rewards.
    pub clip_range: f64,
    /// Duration of a control step (s).
    pub control_step_s: f64,
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
    /// Speed and efficiency over the last updates.
    pub efficiency: Efficiency,
    /// Times of the parts.
    pub parts: PartTimes,
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
        let of_table = METRICS.iter().filter_map(|row| Some((row.tag.to_string(), row.value(self)?)));
        of_table.chain(self.reward_terms.iter().cloned()).collect()
    }

    /// Returns a sum over actors.
    pub(super) fn sum(&self, of: fn(&ActorStats) -> f64) -> f64 {
        self.stats.values().map(of).sum()
    }
}
