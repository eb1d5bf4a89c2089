//! Turns accepted fragments into the batch of one update: normalises observations, estimates returns and advantages,
//! and corrects for fragments of older policies.
//!
//! All observations, including those of a fragment that lags, are normalised by the newest policy's statistics:
//! networks and statistics together are the policy that the update improves.

use candle_core::Result;
use treadmill_config::PpoConfig;
use treadmill_policy::{
    Policy, gaussian,
    normaliser::{Normaliser, RunningMoments, ScalarNormaliser},
};
use treadmill_proto::{
    Fragment,
    fragment::{TERMINATED, TRUNCATED},
};

use crate::{
    batch::Batch,
    gae::{self, Advantages, Steps},
    mirror::BatchMirror,
};

/// Fragment that the learner accepted, and its lag.
#[derive(Debug)]
pub struct AcceptedFragment {
    /// Its content.
    pub fragment: Fragment,
    /// Number of versions between its policy and the newest.
    pub lag: u64,
}

/// Builds the batch of one update from whole fragments.
///
/// `policy` is the newest, which the update improves. The new returns are added to `value_moments` before returns and
/// values are normalised by them. With a `mirror`, the batch also has the mirror image of every transition.
///
/// # Errors
/// If the networks cannot be evaluated.
pub fn build_batch(
    accepted: &[AcceptedFragment],
    policy: &Policy,
    normaliser: &Normaliser,
    value_moments: &mut RunningMoments,
    mirror: Option<&BatchMirror>,
    config: &PpoConfig,
) -> Result<Batch> {
    // Before the first return, the units of returns are unknown, so the critic's output is not used.
    let old_scale = (value_moments.count > 0.0).then(|| ScalarNormaliser::from_moments(value_moments));
    let builder = BatchBuilder { policy, normaliser, value_scale: old_scale.as_ref(), mirror, config };
    let mut batch = Batch::default();
    for accepted in accepted {
        builder.add(accepted, &mut batch)?;
    }
    value_moments.update(&batch.returns, 1);
    let new_scale = ScalarNormaliser::from_moments(value_moments);
    new_scale.normalise(&mut batch.returns);
    new_scale.normalise(&mut batch.values);
    Ok(batch)
}

/// Inputs that are the same for every fragment of a batch.
struct BatchBuilder<'a> {
    policy: &'a Policy,
    normaliser: &'a Normaliser,
    /// Units of returns before this batch, if they are known.
    value_scale: Option<&'a ScalarNormaliser>,
    mirror: Option<&'a BatchMirror>,
    config: &'a PpoConfig,
}

impl BatchBuilder<'_> {
    /// Appends the transitions of one fragment, and their mirror images if there is a mirror.
    fn add(&self, AcceptedFragment { fragment, lag }: &AcceptedFragment, batch: &mut Batch) -> Result<()> {
        let mut observations = fragment.observations.clone();
        self.normaliser.apply(&mut observations);
        let mut values = self.policy.values(&observations, fragment.transitions())?;
        let next_values = self.next_values(fragment, &mut values)?;
        let Correction { weights, log_probs } = match lag {
            0 => Correction::none(&fragment.log_probs),
            _ => Correction::of(self.policy, &observations, &fragment.actions, &fragment.log_probs)?,
        };
        let estimated = self.advantages(fragment, &values, &next_values);
        batch.observations.append(&mut observations);
        batch.actions.extend_from_slice(&fragment.actions);
        batch.log_probs.extend(log_probs);
        batch.weights.extend(weights);
        batch.extend_targets(&estimated, &values);
        if let Some(mirror) = self.mirror {
            self.add_mirror_image(fragment, mirror, batch)?;
            batch.extend_targets(&estimated, &values);
        }
        Ok(())
    }

    /// Estimates advantages and returns of one fragment, in units of scaled rewards.
    fn advantages(&self, fragment: &Fragment, values: &[f32], next_values: &[f32]) -> Advantages {
        let config = self.config;
        let rewards: Vec<f32> = fragment.rewards.iter().map(|reward| reward * config.reward_scale as f32).collect();
        let steps = Steps {
            envs: fragment.envs as usize,
            rewards: &rewards,
            values,
            next_values,
            terminated: &flagged(fragment, TERMINATED),
            truncated: &flagged(fragment, TRUNCATED),
        };
        gae::estimate(&steps, config.gamma as f32, config.gae_lambda as f32)
    }

    /// Returns the values of the observations truly reached. Converts `values` to the units of returns; if those are
    /// unknown, sets all values to 0.
    fn next_values(&self, fragment: &Fragment, values: &mut [f32]) -> Result<Vec<f32>> {
        let mut last = fragment.last_observations.clone();
        self.normaliser.apply(&mut last);
        let rows = last.len() / fragment.observation_size as usize;
        let mut last_values = if rows > 0 { self.policy.values(&last, rows)? } else { Vec::new() };
        for values in [&mut last_values[..], &mut *values] {
            match self.value_scale {
                Some(scale) => scale.denormalise(values),
                None => values.fill(0.0),
            }
        }
        // The last observations of truncated episodes and of the fragment's end are mixed, ordered by step and environment.
        let (envs, mut last_values) = (fragment.envs as usize, last_values.into_iter());
        let (mut truncated_values, mut final_values) = (Vec::new(), vec![0.0; envs]);
        for (index, flags) in fragment.flags.iter().enumerate() {
            if !Fragment::needs_last_observation(*flags, (index / envs) as u32, fragment.steps) {
                continue;
            }
            let value =
                last_values.next().expect("a checked fragment has one last observation for each that is needed");
            if flags & TRUNCATED != 0 {
                truncated_values.push(value);
            } else {
                final_values[index % envs] = value;
            }
        }
        let (terminated, truncated) = (flagged(fragment, TERMINATED), flagged(fragment, TRUNCATED));
        Ok(gae::next_values(values, &terminated, &truncated, &truncated_values, &final_values))
    }

    /// Appends observations, actions, log-probabilities and weights of the mirror image of a fragment.
    fn add_mirror_image(&self, fragment: &Fragment, mirror: &BatchMirror, batch: &mut Batch) -> Result<()> {
        let mut observations = mirror.observation.apply(&fragment.observations);
        self.normaliser.apply(&mut observations);
        let mut actions = mirror.action.apply(&fragment.actions);
        // The mirror image of the acting policy takes the mirrored actions with the same probabilities.
        let Correction { weights, log_probs } =
            Correction::of(self.policy, &observations, &actions, &fragment.log_probs)?;
        batch.observations.append(&mut observations);
        batch.actions.append(&mut actions);
        batch.log_probs.extend(log_probs);
        batch.weights.extend(weights);
        Ok(())
    }
}

/// Correction of a fragment that an older policy acted.
///
/// The decoupled objective keeps the update near the newest policy, and weights each action by its probability under
/// the newest policy relative to the one that acted (Hilton et al. 2021, "Batch size-invariance for policy
/// optimization", arXiv:2110.00641, equation 2; the weight is truncated at 1).
struct Correction {
    /// `min(1, π(a|s) / μ(a|s))` of each transition, with the newest policy π and the one that acted, μ.
    weights: Vec<f32>,
    /// `ln π(a|s)`.
    log_probs: Vec<f32>,
}

impl Correction {
    /// Correction of a fragment that the newest policy acted.
    fn none(log_probs: &[f32]) -> Self {
        Self { weights: vec![1.0; log_probs.len()], log_probs: log_probs.to_vec() }
    }

    /// `old` are the log-probabilities of the actions under the policy that acted, `[rows]`.
    fn of(policy: &Policy, observations: &[f32], actions: &[f32], old: &[f32]) -> Result<Self> {
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

fn flagged(fragment: &Fragment, flag: u8) -> Vec<bool> {
    fragment.flags.iter().map(|flags| flags & flag != 0).collect()
}

#[cfg(test)]
#[path = "batch_building_tests.rs"]
mod tests;
