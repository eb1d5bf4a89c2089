//! What a checkpoint holds.

use serde::{Deserialize, Serialize};
use treadmill_config::{Config, ConfigSource, EvaluationConfig, LearnerConfig, PpoConfig};
use treadmill_policy::{
    NetworkShape, init,
    normaliser::{Normaliser, RunningMoments},
};
use treadmill_ppo::optimiser::OptimiserState;
use treadmill_proto::{ActorState, PolicyBundle, Task, limits::BUNDLE_BYTES_MAX};
use treadmill_runtime::seeds::{self, Stream};

use crate::{
    intake::{FragmentCounts, Ledger, Lineage},
    metrics::episodes::EpisodeWindow,
};

/// Everything a run is. A field that is added or removed raises [`super::encoding::FORMAT`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainingState {
    /// The run's name on the bus.
    pub run: String,
    /// The configuration as used.
    pub config_toml: String,
    /// The humanoid as MJCF.
    pub model_xml: String,
    /// The networks' shape.
    pub shape: NetworkShape,
    /// Which versions this state descends from; the newest is its own.
    pub lineage: Lineage,
    /// Actor, log standard deviations and critic, in [`NetworkShape`]'s order.
    pub parameters: Vec<f32>,
    /// Adam's moments and step count.
    pub optimiser: OptimiserState,
    /// The current learning rate, as adaptation left it.
    pub learning_rate: f64,
    /// Statistics of raw observations.
    pub observation_moments: RunningMoments,
    /// Statistics of scaled returns.
    pub value_moments: RunningMoments,
    /// The stream that shuffles minibatches.
    pub shuffle: Stream,
    /// Which fragments were dealt with.
    pub ledger: Ledger,
    /// Counts of fragments by outcome.
    pub fragment_counts: FragmentCounts,
    /// The last finished episodes.
    pub episodes: EpisodeWindow,
    /// Counters of the run.
    pub counters: Counters,
    /// The best mean return so far.
    pub best_return: Option<f64>,
    /// Whether that is of an evaluation; until the first, it is of training.
    pub best_is_evaluated: bool,
    /// Where the only actor of a deterministic run was after the last fragment that was learnt from.
    pub actor_state: Option<ActorState>,
}

/// Counters over the whole run, across resumes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Counters {
    /// Transitions learnt from.
    pub env_steps: u64,
    /// Updates.
    pub updates: u64,
    /// Gradient steps.
    pub gradient_steps: u64,
    /// Updates that were undone because a number was not finite.
    pub undone_updates: u64,
    /// Seconds of training.
    pub wall_s: f64,
    /// Actor processes that were started again.
    pub restarts: u64,
    /// Learners that went on with this run.
    pub resumes: u64,
}

impl TrainingState {
    /// A run that begins.
    pub fn fresh(
        run: &str,
        config: &Config,
        model_xml: &str,
        observation: usize,
        action: usize,
        incarnation: u64,
    ) -> Self {
        let hidden = config.policy.hidden.iter().map(|width| *width as usize).collect();
        let shape = NetworkShape { observation, action, hidden };
        let seed = config.run.seed;
        let mut random = seeds::stream(seed, "initial-parameters", &[]);
        let parameters = init::initial_parameters(&shape, config.policy.init_log_std as f32, &mut random);
        Self {
            run: run.to_string(),
            config_toml: config.to_toml(),
            model_xml: model_xml.to_string(),
            lineage: Lineage::new(incarnation),
            optimiser: OptimiserState::new(parameters.len()),
            learning_rate: config.ppo.learning_rate,
            observation_moments: RunningMoments::new(observation),
            value_moments: RunningMoments::new(1),
            shuffle: seeds::stream(seed, "shuffle", &[]),
            ledger: Ledger::default(),
            fragment_counts: FragmentCounts::default(),
            episodes: EpisodeWindow::default(),
            counters: Counters::default(),
            best_return: None,
            best_is_evaluated: false,
            actor_state: None,
            parameters,
            shape,
        }
    }

    /// What this run trains, as actors of external tasks are told.
    pub fn task(&self) -> Result<Task, String> {
        let config = self.config()?;
        let narrow = |size: usize| u32::try_from(size).map_err(|why| why.to_string());
        let own = Task {
            name: config.task_name(),
            observation_size: narrow(self.shape.observation)?,
            action_size: narrow(self.shape.action)?,
            ..Task::default()
        };
        Ok(config.task.known().unwrap_or(own))
    }

    /// The configuration as used.
    pub fn config(&self) -> Result<Config, String> {
        let mut source = ConfigSource::default();
        source.text(&self.config_toml, "the configuration in the checkpoint").map_err(|why| why.to_string())?;
        source.build().map_err(|why| why.to_string())
    }

    /// Why no run of this configuration can be of `task`, in words; called before anything is allocated for it.
    pub fn objection(config: &Config, task: &Task) -> Option<String> {
        let name = &config.task.name;
        if !name.is_empty() && *name != task.name {
            return Some(format!("this run trains `{name}`; you registered {task}"));
        }
        let hidden = config.policy.hidden.iter().map(|width| *width as usize).collect();
        let (observation, action) = (task.observation_size as usize, task.action_size as usize);
        let parameters = NetworkShape { observation, action, hidden }.parameter_count();
        // The statistics of observations and the texts take up what is left.
        let most = BUNDLE_BYTES_MAX / 2 / size_of::<f32>();
        (parameters > most).then(|| {
            format!(
                "networks for {task} have {parameters} parameters with policy.hidden {:?}, and at most {most} can be handed \
                 out; make policy.hidden narrower",
                config.policy.hidden
            )
        })
    }

    /// Whether the parts fit each other.
    pub fn check(&self) -> Result<(), String> {
        let count = self.shape.parameter_count();
        let lengths = [
            ("parameters", self.parameters.len(), count),
            ("first moments", self.optimiser.first_moment.len(), count),
            ("second moments", self.optimiser.second_moment.len(), count),
            ("observation means", self.observation_moments.mean.len(), self.shape.observation),
        ];
        for (what, found, wanted) in lengths {
            if found != wanted {
                return Err(format!("it has {found} {what}, but its network {:?} needs {wanted}", self.shape));
            }
        }
        let config = self.config()?;
        if let Some(task) = config.task.known()
            && (task.observation_size as usize, task.action_size as usize)
                != (self.shape.observation, self.shape.action)
        {
            return Err(format!("its configuration says that it trains {task}, but its network is {:?}", self.shape));
        }
        let hidden: Vec<usize> = config.policy.hidden.iter().map(|width| *width as usize).collect();
        if hidden != self.shape.hidden {
            return Err(format!(
                "its network has hidden layers {:?}, but its configuration says policy.hidden = {hidden:?}",
                self.shape.hidden
            ));
        }
        self.actor_state.as_ref().map_or(Ok(()), |state| state.check().map_err(|why| why.to_string()))
    }

    /// The hash that every fragment repeats: over the model and what of the configuration an actor depends on. How long the
    /// run is and how the learner learns are not part of it, so that they can be changed while actors go on.
    pub fn config_hash(&self) -> Result<u64, String> {
        let mut config = self.config()?;
        config.run.steps = 0;
        config.ppo = PpoConfig::default();
        config.eval = EvaluationConfig::default();
        config.learner = LearnerConfig { mode: config.learner.mode, ..LearnerConfig::default() };
        Ok(seeds::checksum(&[config.to_toml().as_bytes(), self.model_xml.as_bytes()]))
    }

    /// What actors get of this state. Its [`Self::actor_state`] is added where it is resumed.
    pub fn bundle(&self) -> Result<PolicyBundle, String> {
        let config = self.config()?;
        let weights = treadmill_policy::to_safetensors(&self.shape, &self.parameters);
        let normaliser = Normaliser::from_moments(&self.observation_moments, config.policy.observation_clip as f32);
        let narrow = |size: usize| u32::try_from(size).map_err(|why| why.to_string());
        Ok(PolicyBundle {
            run: self.run.clone(),
            version: self.lineage.newest(),
            observation_size: narrow(self.shape.observation)?,
            action_size: narrow(self.shape.action)?,
            hidden: config.policy.hidden.clone(),
            checksum: seeds::checksum(&[&weights]),
            weights: weights.into(),
            observation_mean: normaliser.mean,
            observation_inverse_std: normaliser.inverse_std,
            observation_clip: normaliser.clip,
            config_hash: self.config_hash()?,
            config_toml: self.config_toml.clone(),
            model_xml: self.model_xml.clone(),
            actor_state: None,
        })
    }
}
