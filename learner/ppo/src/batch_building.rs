//! Turns accepted fragments into the batch of one update: normalises observations, estimates returns and advantages,
//! corrects for fragments of older policies, and leaves out implausible fragments.
//!
//! All observations, including those of a fragment that lags, are normalised by the newest policy's statistics:
//! networks and statistics together are the policy that the update improves.
//!
//! The networks evaluate all fragments in one call, on the threads of the policy's pool. The rest runs on the calling
//! thread, because it is little: for 8,192 rows the networks take 33 ms on one thread, normalisation 0.2 ms, everything
//! else 1.5 ms.

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
    plausibility::{self, FragmentNumbers, Implausible},
};

/// Fragment that the learner accepted, and its lag.
#[derive(Debug)]
pub struct AcceptedFragment {
    /// Its content.
    pub fragment: Fragment,
    /// Number of versions between its policy and the newest.
    pub lag: u64,
}

/// Fragment that the learner does not learn from.
#[derive(Clone, Debug, PartialEq)]
pub struct RejectedFragment {
    /// Its index among the accepted fragments.
    pub index: usize,
    /// Reason.
    pub why: Implausible,
}

/// Result of [`build_batch`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BuiltBatch {
    /// Transitions of all plausible fragments.
    pub batch: Batch,
    /// Other fragments, in ascending order.
    pub rejected: Vec<RejectedFragment>,
}

/// Builds the batch of one update from whole fragments. It equals the batch of the plausible fragments alone.
///
/// `policy` is the newest, which the update improves. The new returns are added to `value_moments` before returns and
/// values are normalised by them.
pub fn build_batch(
    accepted: &[AcceptedFragment],
    policy: &Policy,
    normaliser: &Normaliser,
    value_moments: &mut RunningMoments,
    config: &PpoConfig,
) -> BuiltBatch {
    // Before the first return, the units of returns are unknown, so the critic's output is not used.
    let value_scale = (value_moments.count > 0.0).then(|| ScalarNormaliser::from_moments(value_moments));
    let builder = BatchBuilder { policy, normaliser, value_scale, config };
    let mut kept: Vec<usize> = (0..accepted.len()).collect();
    let mut rejected = Vec::new();
    let mut batch = loop {
        // Anew after a rejection: the results for a row may differ in the last bit with the rows beside it.
        let fragments: Vec<&AcceptedFragment> = kept.iter().map(|index| &accepted[*index]).collect();
        let batch = builder.build(&fragments);
        let found = builder.implausible(&fragments, &batch, value_moments);
        if found.is_empty() {
            break batch;
        }
        rejected.extend(found.iter().map(|(place, why)| RejectedFragment { index: kept[*place], why: why.clone() }));
        for (place, _) in found.iter().rev() {
            kept.remove(*place);
        }
    };
    rejected.sort_by_key(|rejected| rejected.index);
    value_moments.update(&batch.returns, 1);
    let new_scale = ScalarNormaliser::from_moments(value_moments);
    new_scale.normalise(&mut batch.returns);
    new_scale.normalise(&mut batch.values);
    BuiltBatch { batch, rejected }
}

/// Inputs that are the same for every fragment of a batch.
struct BatchBuilder<'a> {
    policy: &'a Policy,
    normaliser: &'a Normaliser,
    /// Units of returns before this batch, if they are known.
    value_scale: Option<ScalarNormaliser>,
    config: &'a PpoConfig,
}

impl BatchBuilder<'_> {
    /// Returns the transitions of the fragments, with returns and values in units of scaled rewards.
    fn build(&self, fragments: &[&AcceptedFragment]) -> Batch {
        let joined = |plane: fn(&Fragment) -> &[f32]| -> Vec<f32> {
            fragments.iter().flat_map(|accepted| plane(&accepted.fragment)).copied().collect()
        };
        let mut observations = joined(|fragment| &fragment.observations);
        self.normaliser.apply(&mut observations);
        let mut last_observations = joined(|fragment| &fragment.last_observations);
        self.normaliser.apply(&mut last_observations);
        let values = self.values(&observations);
        let mut last_values = self.values(&last_observations).into_iter();
        let mut batch = self.with_actions(observations, joined(|fragment| &fragment.actions));
        let mut start = 0;
        for AcceptedFragment { fragment, lag } in fragments {
            let rows = start..start + fragment.transitions();
            let correction = |(new, old): (&f32, &f32)| importance_weight(*new, *old);
            match lag {
                0 => batch.weights.resize(rows.end, 1.0),
                _ => {
                    batch.weights.extend(batch.log_probs[rows.clone()].iter().zip(&fragment.log_probs).map(correction))
                }
            }
            let estimated = self.advantages(fragment, &values[rows.clone()], &mut last_values);
            batch.advantages.extend(estimated.advantages);
            batch.returns.extend(estimated.returns);
            start = rows.end;
        }
        batch.values = values;
        batch
    }

    /// Returns the critic's values of normalised observations in units of returns; 0 if those are unknown.
    fn values(&self, observations: &[f32]) -> Vec<f32> {
        let rows = observations.len() / self.policy.shape().observation;
        match self.value_scale {
            Some(scale) if rows > 0 => {
                let mut values = self.policy.values(observations, rows);
                scale.denormalise(&mut values);
                values
            }
            _ => vec![0.0; rows],
        }
    }

    /// Returns a batch of normalised observations and actions, with the newest policy's means and log-probabilities.
    ///
    /// At lag 0 these equal the claimed log-probabilities within rounding, so that the ratios of the first gradient
    /// step are 1.
    fn with_actions(&self, observations: Vec<f32>, actions: Vec<f32>) -> Batch {
        let log_std = self.policy.log_std();
        let mut means = vec![0.0; actions.len()];
        if !actions.is_empty() {
            self.policy.means(&observations, actions.len() / log_std.len(), &mut means);
        }
        let log_probs = gaussian::log_probabilities(&actions, &means, log_std);
        Batch { observations, actions, means, log_probs, ..Batch::default() }
    }

    /// Estimates advantages and returns of one fragment, in units of scaled rewards. Takes its values of true last
    /// observations.
    fn advantages(
        &self,
        fragment: &Fragment,
        values: &[f32],
        last_values: &mut impl Iterator<Item = f32>,
    ) -> Advantages {
        let config = self.config;
        let (terminated, truncated) = (flagged(fragment, TERMINATED), flagged(fragment, TRUNCATED));
        // The last observations of truncated episodes and of the fragment's end are mixed, ordered by step and environment.
        let envs = fragment.envs as usize;
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
        let next_values = gae::next_values(values, &terminated, &truncated, &truncated_values, &final_values);
        let steps = Steps {
            envs,
            rewards: &self.scaled_rewards(fragment),
            values,
            next_values: &next_values,
            terminated: &terminated,
            truncated: &truncated,
        };
        gae::estimate(&steps, config.gamma as f32, config.gae_lambda as f32)
    }

    fn scaled_rewards(&self, fragment: &Fragment) -> Vec<f32> {
        fragment.rewards.iter().map(|reward| reward * self.config.reward_scale as f32).collect()
    }

    /// Returns places and reasons of the fragments that cannot be what an actor observed, in ascending order.
    fn implausible(
        &self,
        fragments: &[&AcceptedFragment],
        batch: &Batch,
        value_moments: &RunningMoments,
    ) -> Vec<(usize, Implausible)> {
        let rewards: Vec<Vec<f32>> = fragments.iter().map(|accepted| self.scaled_rewards(&accepted.fragment)).collect();
        let mut start = 0;
        let mut parts = Vec::with_capacity(fragments.len());
        for (AcceptedFragment { fragment, lag }, rewards) in fragments.iter().zip(&rewards) {
            let rows = start..start + fragment.transitions();
            start = rows.end;
            parts.push(FragmentNumbers {
                lag: *lag,
                claimed: &fragment.log_probs,
                log_probs: &batch.log_probs[rows.clone()],
                rewards,
                returns: &batch.returns[rows.clone()],
                advantages: &batch.advantages[rows],
            });
        }
        plausibility::implausible(&parts, self.policy.log_std(), value_moments)
    }
}

/// Returns `min(1, π(a|s) / μ(a|s))`, given the log-probabilities under the newest policy π and the one that acted, μ.
///
/// The decoupled objective keeps the update near the newest policy, and weights each action by its probability under
/// the newest policy relative to the one that acted (Hilton et al. 2021, "Batch size-invariance for policy
/// optimization", arXiv:2110.00641, equation 2; the weight is truncated at 1).
fn importance_weight(new: f32, old: f32) -> f32 {
    (new - old).min(0.0).exp()
}

fn flagged(fragment: &Fragment, flag: u8) -> Vec<bool> {
    fragment.flags.iter().map(|flags| flags & flag != 0).collect()
}

#[cfg(test)]
#[path = "batch_building_tests.rs"]
mod tests;
