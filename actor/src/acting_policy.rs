//! Policy in use: actor network, observation statistics and version of one bundle.

use treadmill_policy::{
    NetworkShape, Networks, Policy, PolicyMirror, actor_from_safetensors, exported::ExportedPolicy,
    normaliser::Normaliser,
};
use treadmill_proto::{PolicyBundle, PolicyVersion};
use treadmill_runtime::{error_chain, seeds};

use crate::ActorError;

/// Policy that is ready to choose actions.
pub struct ActingPolicy {
    /// Version of the policy.
    pub version: PolicyVersion,
    policy: Policy,
    normaliser: Normaliser,
}

impl ActingPolicy {
    /// Checks a bundle and loads its actor network. A critic is not needed.
    pub fn new(bundle: &PolicyBundle) -> Result<Self, ActorError> {
        let refuse = |why: String| ActorError::Bundle { number: bundle.version.number, why };
        if seeds::checksum(&[&bundle.weights]) != bundle.checksum {
            return Err(refuse("the checksum of the weights is wrong".to_string()));
        }
        let shape = NetworkShape {
            observation: bundle.observation_size as usize,
            action: bundle.action_size as usize,
            hidden: bundle.hidden.iter().map(|width| *width as usize).collect(),
            privileged: bundle.privileged_size as usize,
        };
        let parameters = actor_from_safetensors(&bundle.weights, &shape);
        let parameters = parameters.map_err(|error| refuse(error_chain(&error)))?;
        let mirror = PolicyMirror::of_indices(&bundle.observation_mirror, &bundle.action_mirror);
        let networks = Networks::new(shape, mirror).map_err(refuse)?;
        let parameters = networks.learnt(parameters).map_err(|distance| {
            refuse(format!("its networks do not fit its mirror: their relative distance is {distance}"))
        })?;
        let policy = Policy::new(networks, parameters).map_err(|error| refuse(error_chain(&error)))?;
        let normaliser = Normaliser {
            mean: bundle.observation_mean.clone(),
            inverse_std: bundle.observation_inverse_std.clone(),
            clip: bundle.observation_clip,
        };
        Ok(Self { version: bundle.version, policy, normaliser })
    }

    /// Loads an exported policy. Its version is 0, because no learner receives what it collects.
    pub fn exported(exported: &ExportedPolicy) -> Result<Self, ActorError> {
        let policy = Policy::new(exported.shape.clone(), exported.parameters.clone())
            .map_err(|error| ActorError::Bundle { number: 0, why: error_chain(&error) })?;
        Ok(Self { version: PolicyVersion::default(), policy, normaliser: exported.normaliser() })
    }

    /// Returns the logarithms of the standard deviations, `[action]`.
    pub fn log_std(&self) -> &[f32] {
        self.policy.log_std()
    }

    /// Computes action means, `[rows][action]`, from raw observations, `[rows][observation]`. `normalised` is a buffer for
    /// the normalised observations.
    pub fn means(&self, observations: &[f32], rows: usize, normalised: &mut Vec<f32>, means: &mut [f32]) {
        self.normaliser.apply_into(observations, normalised);
        self.policy.means(normalised, rows, means);
    }
}
