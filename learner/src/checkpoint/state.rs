//! State that a checkpoint holds.

use serde::{Deserialize, Serialize};
use treadmill_config::{Config, ConfigSource, EvaluationConfig, LearnerConfig, PpoConfig, RunConfig};
use treadmill_experience::{ledger::Ledger, lineage::Lineage};
use treadmill_policy::{NetworkShape, Networks, PolicyMirror, mirror_indices, normaliser::Normaliser};
use treadmill_ppo::{
    AcceptedFragment, PpoState, TrainedPolicy, UpdateStats,
    settings::{check_symmetry, wants_mirror},
};
use treadmill_proto::{ActorState, PolicyBundle, Task, WIRE_VERSION, limits::BUNDLE_BYTES_MAX};
use treadmill_runtime::{error_chain, seeds};

use super::{EpisodeWindow, curricula::Curricula};
use crate::intake::FragmentCounts;

/// Whole state of a run. Adding or removing a field requires a new [`super::encoding::FORMAT`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainingState {
    /// Name of the run on the bus.
    pub run: String,
    /// Configuration as TOML.
    pub config_toml: String,
    /// Humanoid as MJCF.
    pub model_xml: String,
    /// Versions that this state descends from; the newest is its own.
    pub lineage: Lineage,
    /// Policy, optimiser and running statistics.
    pub ppo: PpoState,
    /// Handled fragments.
    pub ledger: Ledger,
    /// Counts of fragments by outcome.
    pub fragment_counts: FragmentCounts,
    /// Last finished episodes.
    pub episodes: EpisodeWindow,
    /// Curricula that environments have reached.
    pub curricula: Curricula,
    /// Counters of the run.
    pub counters: Counters,
    /// Best mean return so far.
    pub best_return: Option<f64>,
    /// Whether `best_return` is of an evaluation; until the first evaluation, it is of training.
    pub best_is_evaluated: bool,
    /// State of a deterministic run's only actor after the last fragment that was learnt from.
    pub actor_state: Option<ActorState>,
    /// Version of the physics that simulated the last episodes; 0 in runs of external tasks, which have none.
    pub physics_version: u32,
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
    /// Restarts of actor processes.
    pub restarts: u64,
    /// Resumes of this run.
    pub resumes: u64,
    /// Environment steps that the actors themselves counted.
    pub env_steps_simulated: u64,
    /// Environment steps in batches whose update was undone.
    pub env_steps_undone: u64,
}

impl Counters {
    /// Returns the share of the steps counted by the actors that the run has learnt from; `None` before the first one.
    pub fn used_share(&self) -> Option<f64> {
        let learnt = self.env_steps.saturating_sub(self.env_steps_undone) as f64;
        (self.env_steps_simulated > 0).then(|| (learnt / self.env_steps_simulated as f64).min(1.0))
    }
}

impl TrainingState {
    /// Adopts the return of the best policy that is saved, if that beats this state's own: a run that goes on from an older
    /// checkpoint must not replace a better policy.
    pub fn adopt_best(&mut self, saved: &Self) {
        let rank = |state: &Self| (state.best_is_evaluated, state.best_return);
        if rank(saved) > rank(self) {
            (self.best_is_evaluated, self.best_return) = rank(saved);
        }
    }

    /// Adopts the return in training, if it is the best so far and no policy was evaluated yet. Returns whether it is. A few
    /// absurd returns must not make a policy the best for ever.
    pub fn adopt_best_in_training(&mut self) -> bool {
        let return_mean = self.episodes.middle_return_mean().filter(|_| !self.best_is_evaluated);
        let best = return_mean.filter(|mean| self.best_return.is_none_or(|best| *mean > best));
        self.best_return = best.or(self.best_return);
        best.is_some()
    }

    /// Advances by the update from `fragments`; `stats` are `None` if it was undone.
    pub fn advance(&mut self, fragments: &[AcceptedFragment], stats: Option<&UpdateStats>) {
        self.lineage.advance();
        let counters = &mut self.counters;
        counters.updates += 1;
        let transitions = fragments.iter().map(|accepted| accepted.fragment.transitions() as u64).sum::<u64>();
        counters.env_steps += transitions;
        match stats {
            Some(stats) => counters.gradient_steps += stats.gradient_steps,
            None => {
                counters.undone_updates += 1;
                counters.env_steps_undone += transitions;
            }
        }
        for accepted in fragments {
            self.episodes.extend(&accepted.fragment.episodes);
            self.curricula.extend(&accepted.fragment.episodes);
        }
        self.actor_state = fragments.last().and_then(|accepted| accepted.fragment.actor_state.clone());
    }

    /// State of a new run, whose networks have the hidden layers of its configuration.
    pub fn fresh(run: &str, config: &Config, model_xml: &str, networks: Networks, incarnation: u64) -> Self {
        let seed = config.run.seed;
        let mut random = seeds::stream(seed, "initial-parameters", &[]);
        let parameters = networks.initial_parameters(config.policy.init_log_std as f32, &mut random);
        Self {
            run: run.to_string(),
            config_toml: config.to_toml(),
            model_xml: model_xml.to_string(),
            lineage: Lineage::new(incarnation),
            ppo: PpoState::new(networks, parameters, seeds::stream(seed, "shuffle", &[]), &config.ppo),
            ledger: Ledger::default(),
            fragment_counts: FragmentCounts::default(),
            episodes: EpisodeWindow::default(),
            curricula: Curricula::default(),
            counters: Counters::default(),
            best_return: None,
            best_is_evaluated: false,
            actor_state: None,
            physics_version: 0,
        }
    }

    /// Returns the shape of the networks.
    pub fn shape(&self) -> &NetworkShape {
        self.ppo.shape()
    }

    /// Task of this run, for actors of external tasks.
    pub fn task(&self) -> Result<Task, String> {
        let config = self.config()?;
        let narrow = |size: usize| u32::try_from(size).map_err(|why| why.to_string());
        let own = Task {
            name: config.task_name(),
            observation_size: narrow(self.shape().observation)?,
            action_size: narrow(self.shape().action)?,
            ..Task::default()
        };
        Ok(config.task.known().unwrap_or(own))
    }

    /// Parses the configuration.
    pub fn config(&self) -> Result<Config, String> {
        let mut source = ConfigSource::default();
        source.text(&self.config_toml, "the configuration in the checkpoint").map_err(|why| error_chain(&why))?;
        source.build().map_err(|why| error_chain(&why))
    }

    /// Returns why a run of this configuration cannot train `task`, or `None` if it can. Allocates no networks.
    pub fn objection(config: &Config, task: &Task) -> Option<String> {
        let name = &config.task.name;
        if !name.is_empty() && *name != task.name {
            return Some(format!("this run trains `{name}`; you registered {task}"));
        }
        let parameters = Self::shape_for(config, task).parameter_count();
        // The other half is for the statistics of observations and the texts.
        let parameters_max = BUNDLE_BYTES_MAX / 2 / size_of::<f32>();
        if parameters > parameters_max {
            return Some(format!(
                "networks for {task} have {parameters} parameters with policy.hidden {:?}, and a policy bundle holds at \
                 most {parameters_max}; make policy.hidden narrower",
                config.policy.hidden
            ));
        }
        Self::networks_for(config, task).err()
    }

    /// Returns the networks of a new run, which `ppo.symmetry` may make equivariant to a mirror.
    ///
    /// # Errors
    /// If they must be equivariant, and there is no mirror, or it does not fit.
    pub fn networks(
        config: &Config,
        shape: NetworkShape,
        mirror: impl FnOnce() -> Result<PolicyMirror, String>,
    ) -> Result<Networks, String> {
        let equivariant = || Networks::new(shape.clone(), Some(mirror()?));
        match wants_mirror(&config.ppo) {
            Some(false) => Ok(shape.into()),
            Some(true) => equivariant().map_err(|why| {
                format!("`ppo.symmetry` is \"equivariant\", but {why}; allowed here: \"auto\" or \"off\"")
            }),
            None => Ok(equivariant().unwrap_or_else(|why| {
                tracing::info!(why, "the networks are not equivariant");
                shape.into()
            })),
        }
    }

    /// Returns the networks of a new run of an external task.
    ///
    /// # Errors
    /// If `ppo.symmetry` asks for a mirror that the task has not.
    pub fn networks_for(config: &Config, task: &Task) -> Result<Networks, String> {
        Self::networks(config, Self::shape_for(config, task), || {
            PolicyMirror::of_indices(&task.observation_mirror, &task.action_mirror)
                .ok_or_else(|| format!("{task} has no mirror image"))
        })
    }

    /// Returns the shape of the networks for an external task.
    pub fn shape_for(config: &Config, task: &Task) -> NetworkShape {
        let hidden = config.policy.hidden.iter().map(|width| *width as usize).collect();
        let (observation, action) = (task.observation_size as usize, task.action_size as usize);
        NetworkShape { observation, action, hidden, privileged: 0 }
    }

    /// Checks that the parts are consistent.
    pub fn check(&self) -> Result<(), String> {
        self.ppo.check()?;
        let config = self.config()?;
        if let Some(task) = config.task.known()
            && (task.observation_size as usize, task.action_size as usize)
                != (self.shape().observation, self.shape().action)
        {
            return Err(format!("its configuration is for {task}, but its network is {:?}", self.shape()));
        }
        check_symmetry(&config.ppo, self.ppo.networks())?;
        let hidden: Vec<usize> = config.policy.hidden.iter().map(|width| *width as usize).collect();
        if hidden != self.shape().hidden {
            return Err(format!(
                "its network has hidden layers {:?}, but its configuration has policy.hidden = {hidden:?}",
                self.shape().hidden
            ));
        }
        self.actor_state.as_ref().map_or(Ok(()), |state| state.check().map_err(|why| error_chain(&why)))
    }

    /// Continues the run with this program's physics. If the run has another one, its actor begins new episodes.
    ///
    /// # Errors
    /// If the run has a newer physics.
    pub fn adopt_physics(&mut self, ours: u32) -> Result<(), String> {
        let theirs = self.physics_version;
        if theirs > ours {
            return Err(format!(
                "this program simulates physics {ours}, the run has physics {theirs}: continue with the version that wrote \
                 it, named in versions.json in the run's folder"
            ));
        }
        if theirs < ours {
            tracing::warn!(theirs, ours, "the run goes on with a newer physics; its actors begin new episodes");
            self.actor_state = None;
        }
        self.physics_version = ours;
        Ok(())
    }

    /// Hash that every fragment repeats: of the model and of the configuration that actors depend on. The run's length
    /// and the learner's settings are excluded, so that they can be changed while actors continue.
    pub fn config_hash(&self, config: &Config) -> u64 {
        let mut config = config.clone();
        config.run = RunConfig { steps: 0, tags: Vec::new(), description: String::new(), ..config.run };
        config.ppo = PpoConfig::default();
        config.eval = EvaluationConfig::default();
        config.learner = LearnerConfig { mode: config.learner.mode, ..LearnerConfig::default() };
        seeds::checksum(&[config.to_toml().as_bytes(), self.model_xml.as_bytes()])
    }

    /// Returns a bundle with the weights of the actor only, which is what actors need.
    pub fn for_actors(&self, policy: &TrainedPolicy, bundle: &PolicyBundle) -> PolicyBundle {
        let weights = treadmill_policy::actor_to_safetensors(self.shape(), &policy.parameters);
        PolicyBundle { checksum: seeds::checksum(&[&weights]), weights: weights.into(), ..bundle.clone() }
    }

    /// Returns the bundle of this state's policy with actor and critic, without [`Self::actor_state`], which is added on
    /// resume. `config` is the parsed configuration and `config_hash` its hash: bundles are too frequent to compute either.
    ///
    /// # Errors
    /// If a size is too large.
    pub fn bundle(&self, policy: &TrainedPolicy, config: &Config, config_hash: u64) -> Result<PolicyBundle, String> {
        let weights = treadmill_policy::to_safetensors(self.shape(), &policy.parameters);
        let normaliser = Normaliser::from_moments(&policy.observation_moments, config.policy.observation_clip as f32);
        let narrow = |size: usize| u32::try_from(size).map_err(|why| why.to_string());
        let mirror = self.ppo.networks().mirror();
        let bundle = PolicyBundle {
            run: self.run.clone(),
            version: self.lineage.newest(),
            observation_size: narrow(self.shape().observation)?,
            action_size: narrow(self.shape().action)?,
            hidden: config.policy.hidden.clone(),
            checksum: seeds::checksum(&[&weights]),
            weights: weights.into(),
            observation_mean: normaliser.mean,
            observation_inverse_std: normaliser.inverse_std,
            observation_clip: normaliser.clip,
            config_hash,
            config_toml: self.config_toml.clone(),
            model_xml: self.model_xml.clone(),
            actor_state: None,
            fragment_steps: 0,
            wire_version: WIRE_VERSION,
            // Actors of every version know every key that exists; a release that adds one raises this.
            wire_version_min: 0,
            physics_version: self.physics_version,
            privileged_size: narrow(self.shape().privileged)?,
            observation_mirror: mirror.map(|mirror| mirror_indices(&mirror.observation)).unwrap_or_default(),
            action_mirror: mirror.map(|mirror| mirror_indices(&mirror.action)).unwrap_or_default(),
            ..PolicyBundle::default()
        };
        Ok(self.curricula.in_bundle(bundle))
    }
}
