//! Agents that an evaluation can play: the trained policy and two baselines.

use rand::RngExt;
use treadmill_policy::exported::ExportedPolicy;
use treadmill_proto::PolicyBundle;
use treadmill_runtime::seeds::{self, Stream};

use crate::{ActorError, acting_policy::ActingPolicy};

/// Chooses actions; −1 is the lower end of a motor's range, 1 the upper one.
pub trait Agent {
    /// Writes the action for one raw observation.
    fn act(&mut self, observation: &[f32], action: &mut [f32]) -> Result<(), ActorError>;

    /// Receives the reward of the last action.
    fn rewarded(&mut self, _reward: f32) {}

    /// Receives the end of an episode.
    fn episode_ended(&mut self) {}
}

/// Agent that takes the mean action of a trained policy, without exploration.
pub struct PolicyAgent {
    policy: ActingPolicy,
    normalised: Vec<f32>,
}

impl PolicyAgent {
    /// Loads an exported policy.
    pub fn new(policy: &ExportedPolicy) -> Result<Self, ActorError> {
        Ok(Self { policy: ActingPolicy::exported(policy)?, normalised: Vec::new() })
    }

    /// Loads a policy bundle of a learner.
    pub fn of_bundle(bundle: &PolicyBundle) -> Result<Self, ActorError> {
        Ok(Self { policy: ActingPolicy::new(bundle)?, normalised: Vec::new() })
    }
}

impl Agent for PolicyAgent {
    fn act(&mut self, observation: &[f32], action: &mut [f32]) -> Result<(), ActorError> {
        self.policy.means(observation, 1, &mut self.normalised, action);
        Ok(())
    }
}

/// Agent that takes uniformly random actions.
pub struct RandomAgent {
    random: Stream,
}

impl RandomAgent {
    /// Creates the agent with its own random stream.
    pub fn new(seed: u64) -> Self {
        Self { random: seeds::stream(seed, "random-agent", &[]) }
    }
}

impl Agent for RandomAgent {
    fn act(&mut self, _observation: &[f32], action: &mut [f32]) -> Result<(), ActorError> {
        action.fill_with(|| self.random.random_range(-1.0..1.0));
        Ok(())
    }
}

/// Naive learner: it ignores the observation and moves one preferred action towards actions whose reward exceeds the mean
/// reward so far.
pub struct PreferredActionAgent {
    random: Stream,
    preferred: Vec<f32>,
    tried: Vec<f32>,
    exploration: f64,
    reward_mean: f64,
    rewards: u64,
}

impl PreferredActionAgent {
    /// Step size towards a rewarded action.
    pub const NUDGE: f32 = 0.05;
    /// Probability of a random action in the first episode.
    pub const EXPLORATION_START: f64 = 0.5;
    /// Factor on that probability after each episode.
    pub const EXPLORATION_DECAY: f64 = 0.99;
    /// Lower bound of that probability.
    pub const EXPLORATION_MIN: f64 = 0.05;

    /// Creates the agent with its own random stream.
    pub fn new(seed: u64, action_size: usize) -> Self {
        Self {
            random: seeds::stream(seed, "preferred-action-agent", &[]),
            preferred: vec![0.0; action_size],
            tried: vec![0.0; action_size],
            exploration: Self::EXPLORATION_START,
            reward_mean: 0.0,
            rewards: 0,
        }
    }
}

impl Agent for PreferredActionAgent {
    fn act(&mut self, _observation: &[f32], action: &mut [f32]) -> Result<(), ActorError> {
        if self.random.random_bool(self.exploration) {
            action.fill_with(|| self.random.random_range(-1.0..1.0));
        } else {
            action.copy_from_slice(&self.preferred);
        }
        self.tried.copy_from_slice(action);
        Ok(())
    }

    fn rewarded(&mut self, reward: f32) {
        let reward = f64::from(reward);
        if self.rewards > 0 && reward > self.reward_mean {
            for (preferred, tried) in self.preferred.iter_mut().zip(&self.tried) {
                *preferred += Self::NUDGE * (tried - *preferred);
            }
        }
        self.rewards += 1;
        self.reward_mean += (reward - self.reward_mean) / self.rewards as f64;
    }

    fn episode_ended(&mut self) {
        self.exploration = (self.exploration * Self::EXPLORATION_DECAY).max(Self::EXPLORATION_MIN);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn preferred_action_moves_only_after_rewards_above_the_mean() {
        let mut agent = PreferredActionAgent::new(1, 1);
        agent.tried = vec![1.0];
        agent.rewarded(5.0);
        assert_eq!(agent.preferred, [0.0], "the first reward is the mean");
        agent.rewarded(6.0);
        assert_eq!(agent.preferred, [0.05]);
        agent.rewarded(1.0);
        assert_eq!(agent.preferred, [0.05]);
        agent.tried = vec![-1.0];
        agent.rewarded(9.0);
        assert!((agent.preferred[0] - (0.05 - 0.05 * 1.05)).abs() < 1e-6);
    }

    #[test]
    fn exploration_decays_to_its_minimum() {
        let mut agent = PreferredActionAgent::new(1, 1);
        agent.episode_ended();
        assert!((agent.exploration - 0.495).abs() < 1e-12);
        (0..1000).for_each(|_| agent.episode_ended());
        assert_eq!(agent.exploration, 0.05);
    }

    #[test]
    fn random_actions_cover_the_range_and_repeat_with_the_seed() {
        let draw = |seed| {
            let mut actions = vec![0.0; 1000];
            RandomAgent::new(seed).act(&[], &mut actions).unwrap();
            actions
        };
        assert_eq!(draw(1), draw(1));
        assert_ne!(draw(1), draw(2));
        let (low, high) = draw(1).iter().fold((1f32, -1f32), |(low, high), a| (low.min(*a), high.max(*a)));
        assert!((-1.0..-0.9).contains(&low) && (0.9..1.0).contains(&high));
    }
}
