//! Fragments turned into what the update wants: observations normalised, returns and advantages estimated, and what
//! older policies brought corrected for.
//!
//! Observations are normalised by the statistics of the newest policy, which are those its fragments were acted by; a
//! fragment that lags is read with them too, because networks and statistics together are the policy that is improved.

use treadmill_config::{OffPolicy, PpoConfig};
use treadmill_policy::{normaliser::{Normaliser, RunningMoments, ScalarNormaliser}, Policy, gaussian};
use treadmill_proto::{
    Fragment,
    fragment::{TERMINATED, TRUNCATED},
};

use crate::{
    gae::{self, Steps},
    intake::Accepted,
    mirror::Mirror,
    ppo::Batch,
};

/// The batch of one update, from whole fragments. `policy` is the newest, which the update is to improve.
/// `value_moments` take in the new returns before returns and values are normalised by them. With a `mirror` the batch has
/// the mirror image of every transition, too.
///
/// # Errors
/// If the networks cannot be evaluated.
pub fn prepare(
    accepted: &[Accepted],
    policy: &Policy,
    normaliser: &Normaliser,
    value_moments: &mut RunningMoments,
    mirror: Option<&Mirror>,
    config: &PpoConfig,
) -> Result<Batch, candle_core::Error> {
    let mut batch = Batch::default();
    // Before any return was seen nobody knows its units, so the critic has nothing to say.
    let old_scale = (value_moments.count > 0.0).then(|| ScalarNormaliser::from_moments(value_moments));
    for Accepted { fragment, lag } in accepted {
        let mut observations = fragment.observations.clone();
        normaliser.apply(&mut observations);
        let mut values = policy.values(&observations, fragment.transitions())?;
        let next_values = next_values(fragment, policy, normaliser, &mut values, old_scale.as_ref())?;
        let rewards: Vec<f32> = fragment.rewards.iter().map(|reward| reward * config.reward_scale as f32).collect();
        let correction = match (lag, config.off_policy) {
            (0, _) | (_, OffPolicy::Uncorrected) => None,
            _ => Some(Correction::of(policy, &observations, &fragment.actions, &fragment.log_probs)?),
        };
        let steps = Steps {
            envs: fragment.envs as usize,
            rewards: &rewards,
            values: &values,
            next_values: &next_values,
            terminated: &flagged(fragment, TERMINATED),
            truncated: &flagged(fragment, TRUNCATED),
            // Weights along the trace cut it short, which costs more than they correct: docs/learning.md has the runs.
            weights: match config.off_policy {
                OffPolicy::VTrace => correction.as_ref().map(|correction| &correction.weights[..]),
                OffPolicy::Decoupled | OffPolicy::Uncorrected => None,
            },
        };
        let estimated = gae::estimate(&steps, config.gamma as f32, config.gae_lambda as f32);
        batch.observations.append(&mut observations);
        batch.actions.extend_from_slice(&fragment.actions);
        match correction {
            Some(Correction { weights, log_probs }) if config.off_policy == OffPolicy::Decoupled => {
                batch.log_probs.extend(log_probs);
                batch.weights.extend(weights);
            }
            _ => {
                batch.log_probs.extend_from_slice(&fragment.log_probs);
                batch.weights.resize(batch.log_probs.len(), 1.0);
            }
        }
        batch.advantages.extend_from_slice(&estimated.advantages);
        batch.returns.extend_from_slice(&estimated.returns);
        batch.values.extend_from_slice(&values);
        if let Some(mirror) = mirror {
            let mut observations = mirror.observation.apply(&fragment.observations);
            normaliser.apply(&mut observations);
            let mut actions = mirror.action.apply(&fragment.actions);
            // Nobody did what the mirror shows; the policy that would have is the mirror image of the one that acted.
            let Correction { weights, log_probs } =
                Correction::of(policy, &observations, &actions, &fragment.log_probs)?;
            batch.observations.append(&mut observations);
            batch.actions.append(&mut actions);
            batch.log_probs.extend(log_probs);
            batch.weights.extend(weights);
            batch.advantages.extend_from_slice(&estimated.advantages);
            batch.returns.extend_from_slice(&estimated.returns);
            batch.values.extend_from_slice(&values);
        }
    }
    value_moments.update(&batch.returns, 1);
    let new_scale = ScalarNormaliser::from_moments(value_moments);
    new_scale.normalise(&mut batch.returns);
    new_scale.normalise(&mut batch.values);
    Ok(batch)
}

/// What corrects for a fragment's having been acted by an older policy.
///
/// The decoupled objective keeps the newest policy as the one that the update stays near to, and weighs each action by
/// how much more likely it is than when it was taken (Hilton et al. 2021, "Batch size-invariance for policy optimization",
/// arXiv:2110.00641, equation 2; the weight is truncated as in V-trace).
struct Correction {
    /// `min(1, π(a|s) / μ(a|s))` of each transition, with the newest policy π and the one that acted, μ.
    weights: Vec<f32>,
    /// `ln π(a|s)`.
    log_probs: Vec<f32>,
}

impl Correction {
    /// `old` are the log-probabilities of the actions under the policy that acted, `[rows]`.
    fn of(policy: &Policy, observations: &[f32], actions: &[f32], old: &[f32]) -> Result<Self, candle_core::Error> {
        let mut means = vec![0.0; actions.len()];
        policy.means(observations, old.len(), &mut means)?;
        let log_std = policy.log_std();
        let pairs = actions.chunks_exact(log_std.len()).zip(means.chunks_exact(log_std.len()));
        let log_probs: Vec<f32> =
            pairs.map(|(action, mean)| gaussian::log_probability(action, mean, log_std)).collect();
        let weights = log_probs.iter().zip(old).map(|(new, old)| (new - old).exp().min(1.0)).collect();
        Ok(Self { weights, log_probs })
    }
}

/// Values of the observations truly reached; brings `values` to the units of returns on the way, where they are known.
fn next_values(
    fragment: &Fragment,
    policy: &Policy,
    normaliser: &Normaliser,
    values: &mut [f32],
    scale: Option<&ScalarNormaliser>,
) -> Result<Vec<f32>, candle_core::Error> {
    let mut last = fragment.last_observations.clone();
    normaliser.apply(&mut last);
    let rows = last.len() / fragment.observation_size as usize;
    let mut last_values = if rows > 0 { policy.values(&last, rows)? } else { Vec::new() };
    for values in [&mut last_values[..], &mut *values] {
        match scale {
            Some(scale) => scale.denormalise(values),
            None => values.fill(0.0),
        }
    }
    // The fragment's last observations mix both kinds, ordered by step and environment.
    let (envs, mut last_values) = (fragment.envs as usize, last_values.into_iter());
    let (mut truncated_values, mut final_values) = (Vec::new(), vec![0.0; envs]);
    for (index, flags) in fragment.flags.iter().enumerate() {
        if !Fragment::needs_last_observation(*flags, (index / envs) as u32, fragment.steps) {
            continue;
        }
        let value = last_values.next().expect("a checked fragment has one last observation for each that is needed");
        if flags & TRUNCATED != 0 {
            truncated_values.push(value);
        } else {
            final_values[index % envs] = value;
        }
    }
    let (terminated, truncated) = (flagged(fragment, TERMINATED), flagged(fragment, TRUNCATED));
    Ok(gae::next_values(values, &terminated, &truncated, &truncated_values, &final_values))
}

fn flagged(fragment: &Fragment, flag: u8) -> Vec<bool> {
    fragment.flags.iter().map(|flags| flags & flag != 0).collect()
}

#[cfg(test)]
#[path = "experience_tests.rs"]
mod tests;
