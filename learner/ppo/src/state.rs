//! State that learning continues from.

use rand_xoshiro::Xoshiro256PlusPlus;
use serde::{Deserialize, Serialize};
use treadmill_config::PpoConfig;
use treadmill_policy::{NetworkShape, Networks, gaussian::clamp_log_std, normaliser::RunningMoments};

use crate::{optimiser::OptimiserState, trained_policy::TrainedPolicy};

/// Policy, optimiser and running statistics. A checkpoint stores it as one field, and a resumed run continues from it
/// exactly.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PpoState {
    /// Networks that the parameters belong to.
    pub(crate) networks: Networks,
    /// Actor, log standard deviations and critic, in the order of [`Networks`].
    pub(crate) parameters: Vec<f32>,
    pub(crate) optimiser: OptimiserState,
    /// Current learning rate, after adaptation.
    pub(crate) learning_rate: f64,
    /// Statistics of raw observations.
    pub(crate) observation_moments: RunningMoments,
    /// Statistics of scaled returns.
    pub(crate) value_moments: RunningMoments,
    /// Random stream that shuffles minibatches.
    pub(crate) shuffle: Xoshiro256PlusPlus,
}

impl PpoState {
    /// Returns the state of a new run with the given parameters. Minibatches follow the random stream `shuffle`.
    ///
    /// # Panics
    /// If the parameters do not fit the shape.
    pub fn new(networks: Networks, mut parameters: Vec<f32>, shuffle: Xoshiro256PlusPlus, config: &PpoConfig) -> Self {
        clamp_log_std(&mut parameters[networks.log_std_range()]);
        Self {
            optimiser: OptimiserState::new(parameters.len()),
            learning_rate: config.learning_rate,
            observation_moments: RunningMoments::new(networks.shape().observation),
            value_moments: RunningMoments::new(1),
            networks,
            parameters,
            shuffle,
        }
    }

    /// Checks that the parts fit the networks.
    ///
    /// # Errors
    /// The first part that does not fit.
    pub fn check(&self) -> Result<(), String> {
        let shape = self.shape();
        Networks::new(shape.clone(), self.networks.mirror().cloned())?;
        let count = self.networks.parameter_count();
        let lengths = [
            ("parameters", self.parameters.len(), count),
            ("first moments", self.optimiser.first_moment.len(), count),
            ("second moments", self.optimiser.second_moment.len(), count),
            ("observation means", self.observation_moments.mean.len(), shape.observation),
        ];
        match lengths.into_iter().find(|(_, found, wanted)| found != wanted) {
            None => Ok(()),
            Some((what, found, wanted)) => {
                Err(format!("it has {found} {what}, but its network {shape:?} needs {wanted}"))
            }
        }
    }

    /// Returns the networks.
    pub fn networks(&self) -> &Networks {
        &self.networks
    }

    /// Returns the shape of the networks.
    pub fn shape(&self) -> &NetworkShape {
        self.networks.shape()
    }

    /// Returns actor, log standard deviations and critic as one flat vector, in the order of [`Networks`].
    pub fn parameters(&self) -> &[f32] {
        &self.parameters
    }

    /// Returns the current learning rate, after adaptation.
    pub fn learning_rate(&self) -> f64 {
        self.learning_rate
    }

    /// Returns the state of Adam.
    pub fn optimiser(&self) -> &OptimiserState {
        &self.optimiser
    }

    /// Returns the gradient steps taken.
    pub fn gradient_steps(&self) -> u64 {
        self.optimiser.step
    }

    /// Returns the policy.
    pub fn trained_policy(&self) -> TrainedPolicy {
        TrainedPolicy {
            parameters: self.networks.dense(&self.parameters).into_owned(),
            observation_moments: self.observation_moments.clone(),
            value_moments: Some(self.value_moments.clone()),
        }
    }

    /// Replaces the policy of a new run. Without `value_moments`, the critic learns the scale of returns anew.
    ///
    /// Where the learning rate adapts, it begins at its minimum: a finished policy's noise is small, so that small steps
    /// lead far, and the optimiser does not know its gradients yet.
    ///
    /// # Errors
    /// The distance of the policy's networks from equivariant ones, relative to their norm, if those of the run are
    /// equivariant and the policy's are not.
    ///
    /// # Panics
    /// If the parameters do not fit the shape.
    pub fn begin_with(&mut self, policy: TrainedPolicy, config: &PpoConfig) -> Result<(), f64> {
        self.parameters = self.networks.learnt(policy.parameters)?;
        clamp_log_std(&mut self.parameters[self.networks.log_std_range()]);
        self.observation_moments = policy.observation_moments;
        if let Some(mirror) = self.networks.mirror() {
            self.observation_moments.symmetrise(&mirror.observation);
        }
        self.value_moments = policy.value_moments.unwrap_or_else(|| RunningMoments::new(1));
        if config.target_kl > 0.0 {
            self.learning_rate = config.learning_rate_min;
        }
        Ok(())
    }

    /// Replaces the random stream that shuffles minibatches.
    pub fn set_shuffle(&mut self, shuffle: Xoshiro256PlusPlus) {
        self.shuffle = shuffle;
    }

    /// Adopts the setting that was given by its key, during the run or for a run that begins with its networks:
    /// `ppo.learning_rate` replaces the adapted learning rate.
    pub fn adopt_key(&mut self, key: &str, config: &PpoConfig) {
        if key == "ppo.learning_rate" {
            self.learning_rate = config.learning_rate;
        }
    }
}
