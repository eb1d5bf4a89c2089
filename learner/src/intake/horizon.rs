//! Length of every actor's next fragment, from the number and the speed of the environments.
//!
//! A round should yield one batch, and all actors should end it together. So the *nominal* horizon follows the number of
//! environments, and an actor at half the usual speed gets half of it.

use std::collections::BTreeMap;

use treadmill_config::{Config, RolloutConfig};
use treadmill_ppo::BatchSize;
use treadmill_proto::limits::{FRAGMENT_BYTES_MAX, STEPS_MAX};

/// Horizon below which advantages lose more by their bias than small batches gain. Beyond the number of environments
/// that fill a batch with it, batches grow, and horizons shrink with the fourth root of that number.
const NOMINAL_KNEE: f64 = 32.0;
/// Growth of the batch from which on horizons shrink in proportion to the number of environments instead: more policies
/// that act in turn teach more than longer fragments of each.
const GROWTH_MAX: f64 = 4.0;
/// Shortest horizon of any actor.
const STEPS_MIN: usize = RolloutConfig::STEPS_MIN as usize;
/// Longest horizon of a fast actor, relative to the nominal one.
const FACTOR_MAX: usize = 4;

/// Member of the fleet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member {
    /// Number of environments.
    pub envs: usize,
    /// Speed relative to the usual actor: 1, or 0.5 if each of its control steps takes twice as long.
    pub speed: f64,
}

/// Settings of the rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HorizonRule {
    /// Configured horizon; 0 means automatic.
    pinned: usize,
    /// Fewest transitions of a batch.
    batch: usize,
    /// Transitions of a batch that horizons do not exceed.
    batch_max: usize,
    /// Most transitions of one fragment, by its size on the bus.
    fragment_rows_max: usize,
}

impl HorizonRule {
    /// Rule for a run whose observations and actions have these sizes.
    pub fn new(config: &Config, observation: usize, action: usize) -> Self {
        let BatchSize { transitions, transitions_max } = BatchSize::of(&config.ppo);
        // Observation, action, log-probability, reward and flags. A truncated transition has a second observation.
        let row_bytes = 4 * (2 * observation + action + 2) + 1;
        Self {
            pinned: config.rollout.fragment_steps as usize,
            batch: transitions,
            batch_max: transitions_max,
            fragment_rows_max: FRAGMENT_BYTES_MAX / row_bytes,
        }
    }

    /// Returns the transitions that `envs` environments should deliver in one round.
    pub fn round_rows(&self, envs: usize) -> usize {
        let envs = envs.max(1);
        let excess = envs as f64 * NOMINAL_KNEE / self.batch as f64;
        if excess > 1.0 {
            let grown = self.batch as f64 * excess.powf(0.75).min(GROWTH_MAX);
            return (grown as usize).min(self.batch_max);
        }
        // With few environments, a batch needs several rounds of equal size.
        let rounds = self.batch.div_ceil(RolloutConfig::STEPS_MAX as usize * envs);
        self.batch.div_ceil(rounds)
    }

    /// Returns the horizon of an actor at the usual speed, in a fleet of `envs` environments.
    pub fn nominal(&self, envs: usize) -> u32 {
        let steps = match self.pinned {
            0 => self.round_rows(envs).div_ceil(envs.max(1)).max(STEPS_MIN),
            pinned => pinned,
        };
        steps.min(STEPS_MAX as usize) as u32
    }

    /// Returns the horizon of an actor with `envs` environments that no plan has had yet, where others have `steps`:
    /// its fragment is at most a batch, and fits into a message.
    pub fn first(&self, steps: u32, envs: usize) -> u32 {
        match self.pinned {
            0 => self.fitting(steps.min((self.batch / envs.max(1)) as u32), envs),
            _ => steps,
        }
    }

    /// Returns at most as many of these steps as fit into a message, though not fewer than the shortest horizon.
    pub fn fitting(&self, steps: u32, envs: usize) -> u32 {
        (steps as usize).min(self.longest(envs)).max(STEPS_MIN) as u32
    }

    fn longest(&self, envs: usize) -> usize {
        self.fragment_rows_max / envs.max(1)
    }

    /// Returns every member's horizon. Together they deliver at least [`Self::round_rows`].
    pub fn horizons<'a>(&self, fleet: &BTreeMap<&'a str, Member>) -> BTreeMap<&'a str, u32> {
        let envs: usize = fleet.values().map(|member| member.envs).sum();
        let nominal = self.nominal(envs);
        let share = self.round_rows(envs) as f64 / fleet.values().map(|m| m.envs as f64 * m.speed).sum::<f64>();
        let steps = |member: &Member| {
            if self.pinned > 0 {
                return nominal;
            }
            let longest = (FACTOR_MAX * nominal as usize).min(self.longest(member.envs));
            let steps = (share * member.speed).ceil() as usize;
            steps.clamp(STEPS_MIN, longest.clamp(STEPS_MIN, STEPS_MAX as usize)) as u32
        };
        fleet.iter().map(|(name, member)| (*name, steps(member))).collect()
    }
}

#[cfg(test)]
#[path = "horizon_tests.rs"]
mod tests;
