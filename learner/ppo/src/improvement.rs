//! Improves a policy by the fragments of a batch, without those that are implausible.

use rand::Rng;
use treadmill_policy::{
    Policy,
    normaliser::{Normaliser, RunningMoments},
};
use treadmill_proto::Fragment;

use crate::{
    batch::Batch,
    batch_building::{AcceptedFragment, BuiltBatch, build_batch},
    mirror::BatchMirror,
    plausibility::Implausible,
    update::{UpdateError, UpdateStats, Updater},
};

/// What an improvement reads and changes.
#[derive(Debug)]
pub struct Improver<'a> {
    /// Policy and optimiser.
    pub updater: &'a mut Updater,
    /// Running statistics of observations.
    pub observation_moments: &'a mut RunningMoments,
    /// Running statistics of returns.
    pub value_moments: &'a mut RunningMoments,
    /// Mirror for `ppo.symmetry`.
    pub mirror: Option<&'a BatchMirror>,
    /// Limit of normalised observations.
    pub observation_clip: f32,
}

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
    /// Statistics of the update, or why it was undone. If it was undone, policy and running statistics are unchanged.
    pub result: Result<UpdateStats, UpdateError>,
    /// Fragments that the learner did not learn from.
    pub rejected: Vec<(Fragment, Implausible)>,
}

impl Improver<'_> {
    /// Builds the batch of the plausible fragments, and removes the others from `accepted`.
    ///
    /// # Errors
    /// If the networks cannot be evaluated.
    pub fn prepare(&self, accepted: &mut Vec<AcceptedFragment>) -> Result<PreparedBatch, UpdateError> {
        let (built, value_moments) = self.build(&self.updater.policy()?, accepted)?;
        let mut rejected: Vec<_> =
            built.rejected.into_iter().rev().map(|bad| (accepted.remove(bad.index).fragment, bad.why)).collect();
        rejected.reverse();
        Ok(PreparedBatch { batch: built.batch, value_moments, rejected })
    }

    fn build(
        &self,
        policy: &Policy,
        accepted: &[AcceptedFragment],
    ) -> candle_core::Result<(BuiltBatch, RunningMoments)> {
        let normaliser = Normaliser::from_moments(self.observation_moments, self.observation_clip);
        let mut value_moments = self.value_moments.clone();
        let config = self.updater.config();
        let built = build_batch(accepted, policy, &normaliser, &mut value_moments, self.mirror, config)?;
        Ok((built, value_moments))
    }

    /// Takes `epochs` passes over the batch that was prepared from `accepted`, then adds it to the running statistics.
    ///
    /// If a number becomes infinite or NaN, the fragments that cause it are removed from `accepted`, and the update is that of
    /// the others, as if the removed ones had not come.
    pub fn improve(
        &mut self,
        epochs: u32,
        accepted: &mut Vec<AcceptedFragment>,
        mut prepared: PreparedBatch,
        rng: &mut (impl Rng + Clone),
    ) -> Improvement {
        let before = rng.clone();
        let mut rejected = std::mem::take(&mut prepared.rejected);
        let mut result = self.updater.update_in_epochs(epochs, &prepared.batch, rng);
        if matches!(result, Err(UpdateError::NonFinite { .. })) {
            let causes = self.causes(accepted, &before);
            if !causes.is_empty() {
                let causes =
                    causes.into_iter().rev().map(|index| (accepted.remove(index).fragment, Implausible::NonFinite));
                rejected.extend(causes);
                *rng = before;
                result = self.prepare(accepted).and_then(|again| {
                    prepared = again;
                    rejected.append(&mut prepared.rejected);
                    self.updater.update_in_epochs(epochs, &prepared.batch, rng)
                });
            }
        }
        if result.is_ok() {
            *self.value_moments = prepared.value_moments;
            let parts: Vec<&[f32]> = accepted.iter().map(|accepted| &accepted.fragment.observations[..]).collect();
            self.observation_moments.update_parts(&parts, self.updater.shape().observation);
        }
        Improvement { result, rejected }
    }

    /// Returns the indices of the fragments from which alone an update is not finite. Returns none if that is so for all: then
    /// the fault is the learner's.
    fn causes(&self, accepted: &[AcceptedFragment], rng: &(impl Rng + Clone)) -> Vec<usize> {
        let Ok(policy) = self.updater.policy() else { return Vec::new() };
        let fails = |index: &usize| {
            let alone = std::slice::from_ref(&accepted[*index]);
            let Ok((built, _)) = self.build(&policy, alone) else { return false };
            let result = self.updater.clone().update_in_epochs(1, &built.batch, &mut rng.clone());
            !built.rejected.is_empty() || matches!(result, Err(UpdateError::NonFinite { .. }))
        };
        let causes: Vec<usize> = (0..accepted.len()).filter(fails).collect();
        if causes.len() < accepted.len() { causes } else { Vec::new() }
    }
}

#[cfg(test)]
#[path = "improvement_tests.rs"]
mod tests;
