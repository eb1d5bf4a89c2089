//! The policy in use: networks, statistics and version of one bundle.

use treadmill_policy::{NetworkShape, Policy, exported::ExportedPolicy, from_safetensors, normaliser::Normaliser};
use treadmill_proto::{PolicyBundle, PolicyVersion};
use treadmill_runtime::seeds;

use crate::ActorError;

/// What chooses actions.
pub struct ActingPolicy {
    /// Which policy this is.
    pub version: PolicyVersion,
    policy: Policy,
    normaliser: Normaliser,
}

impl ActingPolicy {
    /// Checks a bundle and makes it ready.
    pub fn new(bundle: &PolicyBundle) -> Result<Self, ActorError> {
        let refuse = |why: String| ActorError::Bundle { number: bundle.version.number, why };
        if seeds::checksum(&[&bundle.weights]) != bundle.checksum {
            return Err(refuse("the weights do not have the checksum that was announced".to_string()));
        }
        let shape = NetworkShape {
            observation: bundle.observation_size as usize,
            action: bundle.action_size as usize,
            hidden: bundle.hidden.iter().map(|width| *width as usize).collect(),
        };
        let parameters = from_safetensors(&bundle.weights, &shape).map_err(|why| refuse(why.to_string()))?;
        let policy = Policy::new(shape, parameters).map_err(|why| refuse(why.to_string()))?;
        let normaliser = Normaliser {
            mean: bundle.observation_mean.clone(),
            inverse_std: bundle.observation_inverse_std.clone(),
            clip: bundle.observation_clip,
        };
        Ok(Self { version: bundle.version, policy, normaliser })
    }

    /// Makes an exported policy ready; it has no version, because no learner will ask.
    pub fn exported(exported: &ExportedPolicy) -> Result<Self, ActorError> {
        let refuse = |why: String| ActorError::Bundle { number: 0, why };
        let policy = Policy::new(exported.shape.clone(), exported.parameters.clone());
        let policy = policy.map_err(|why| refuse(why.to_string()))?;
        Ok(Self { version: PolicyVersion::default(), policy, normaliser: exported.normaliser() })
    }

    /// Logarithms of the standard deviations, `[action]`.
    pub fn log_std(&self) -> &[f32] {
        self.policy.log_std()
    }

    /// Action means, `[rows][action]`, of raw observations, `[rows][observation]`; `normalised` is room for those as the
    /// networks see them.
    pub fn means(
        &self,
        observations: &[f32],
        rows: usize,
        normalised: &mut Vec<f32>,
        means: &mut [f32],
    ) -> Result<(), ActorError> {
        self.normaliser.apply_into(observations, normalised);
        Ok(self.policy.means(normalised, rows, means)?)
    }
}
