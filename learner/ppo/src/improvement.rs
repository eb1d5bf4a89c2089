//! Improves a policy by the fragments of a batch, without those that are implausible.

use treadmill_policy::{
    Policy,
    normaliser::{Normaliser, RunningMoments},
};
use treadmill_proto::Fragment;

use crate::{
    batch::Batch,
    batch_building::{AcceptedFragment, BuiltBatch, build_batch},
    plausibility::Implausible,
    state::PpoState,
    trained_policy::TrainedPolicy,
    update::Ppo,
    update_stats::{UpdateError, UpdateStats},
};

/// Batch that is ready for gradient steps.
#[derive(Debug)]
pub struct PreparedBatch {
    batch: Batch,
    /// Statistics of returns after this batch.
    value_moments: RunningMoments,
    rejected: Vec<(Fragment, Implausible)>,
}

/// Result of an improvement.
#[derive(Debug)]
pub struct Improvement {
    /// Policy after the update.
    pub policy: TrainedPolicy,
    /// Statistics of the update, or why it was undone. If it was undone, policy and running statistics are unchanged.
    pub result: Result<UpdateStats, UpdateError>,
    /// Fragments that the learner did not learn from.
    pub rejected: Vec<(Fragment, Implausible)>,
}

impl Ppo {
    /// Builds the batch of the plausible fragments, and removes the others from `accepted`.
    ///
    /// # Errors
    /// If the networks cannot be evaluated.
    pub fn prepare(
        &self,
        state: &PpoState,
        accepted: &mut Vec<AcceptedFragment>,
    ) -> Result<PreparedBatch, UpdateError> {
        let (built, value_moments) = self.build(state, &self.policy(state)?, accepted);
        let mut rejected: Vec<_> =
            built.rejected.into_iter().rev().map(|bad| (accepted.remove(bad.index).fragment, bad.why)).collect();
        rejected.reverse();
        Ok(PreparedBatch { batch: built.batch, value_moments, rejected })
    }

    fn build(&self, state: &PpoState, policy: &Policy, accepted: &[AcceptedFragment]) -> (BuiltBatch, RunningMoments) {
        let normaliser = Normaliser::from_moments(&state.observation_moments, self.options.observation_clip);
        let mut value_moments = state.value_moments.clone();
        let built = build_batch(accepted, policy, &normaliser, &mut value_moments, &self.config);
        (built, value_moments)
    }

    /// Takes `epochs` passes over the batch that was prepared from `accepted`, then adds it to the running statistics.
    /// Returns the policy.
    ///
    /// If a number becomes infinite or NaN, the fragments that cause it are removed from `accepted`, and the update is
    /// that of the others, as if the removed ones had not come.
    pub fn improve(
        &self,
        state: &mut PpoState,
        epochs: u32,
        accepted: &mut Vec<AcceptedFragment>,
        mut prepared: PreparedBatch,
    ) -> Improvement {
        let before = state.shuffle.clone();
        let mut rejected = std::mem::take(&mut prepared.rejected);
        let mut result = self.update(state, &prepared.batch, epochs);
        if matches!(result, Err(UpdateError::NonFinite { .. })) {
            let causes = self.causes(&PpoState { shuffle: before.clone(), ..state.clone() }, accepted);
            if !causes.is_empty() {
                let causes =
                    causes.into_iter().rev().map(|index| (accepted.remove(index).fragment, Implausible::NonFinite));
                rejected.extend(causes);
                state.shuffle = before;
                result = self.prepare(state, accepted).and_then(|again| {
                    prepared = again;
                    rejected.append(&mut prepared.rejected);
                    self.update(state, &prepared.batch, epochs)
                });
            }
        }
        if result.is_ok() {
            state.value_moments = prepared.value_moments;
            let parts: Vec<&[f32]> = accepted.iter().map(|accepted| &accepted.fragment.observations[..]).collect();
            state.observation_moments.update_parts(&parts, state.networks.shape().observation);
            if let Some(mirror) = state.networks.mirror() {
                state.observation_moments.symmetrise(&mirror.observation);
            }
        }
        Improvement { policy: state.trained_policy(), result, rejected }
    }

    /// Returns the indices of the fragments from which alone an update is not finite. Returns none if that is so for
    /// all: then the fault is the learner's.
    fn causes(&self, state: &PpoState, accepted: &[AcceptedFragment]) -> Vec<usize> {
        let Ok(policy) = self.policy(state) else { return Vec::new() };
        let fails = |index: &usize| {
            let alone = std::slice::from_ref(&accepted[*index]);
            let (built, _) = self.build(state, &policy, alone);
            let result = self.update(&mut state.clone(), &built.batch, 1);
            !built.rejected.is_empty() || matches!(result, Err(UpdateError::NonFinite { .. }))
        };
        let causes: Vec<usize> = (0..accepted.len()).filter(fails).collect();
        if causes.len() < accepted.len() { causes } else { Vec::new() }
    }
}

#[cfg(test)]
#[path = "improvement_tests.rs"]
mod tests;
