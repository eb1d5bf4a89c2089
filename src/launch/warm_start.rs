//! First state of a run that begins with another one's policy, or branches off from another run.

use std::path::Path;

use treadmill_config::Config;
use treadmill_experience::ledger::Ledger;
use treadmill_humanoid::{PHYSICS_VERSION, mjcf};
use treadmill_learner::{
    checkpoint::{CheckpointChoice, TrainingState},
    intake::FragmentCounts,
};
use treadmill_policy::{
    NetworkShape,
    exported::{ExportedPolicy, ReturnFacts},
    normaliser::RunningMoments,
};
use treadmill_ppo::TrainedPolicy;
use treadmill_runtime::{numbers::thousands, seeds};

use crate::{
    launch::{
        exit_code::Usage,
        model,
        run_args::{AnyRunArgs, NewRunArgs},
    },
    shared::{
        saved_policy::{self, SavedPolicy},
        saved_run,
    },
};

/// Key of the learning rate to begin with.
const RATE: &str = "ppo.learning_rate";

/// Keys that choose the entries of an observation.
pub const OBSERVATION_KEYS: &str = "env.observation, env.exclude_current_positions_from_observation, env.include_…, \
                                    velocity.history and velocity.height_scan";

/// Policy that a new run begins with.
#[derive(Clone)]
pub struct InitFrom {
    from: String,
    saved: SavedPolicy,
    /// Whether the learning rate to begin with was given; otherwise it is the smallest.
    rate_is_given: bool,
}

impl InitFrom {
    /// Reads the run, checkpoint or exported file that the flags name; of a run, by default the best checkpoint if
    /// there is one.
    ///
    /// # Errors
    /// If there is no such policy.
    pub fn read(new: &NewRunArgs, any: &AnyRunArgs) -> anyhow::Result<Option<Self>> {
        let Some(from) = new.init_from.clone() else { return Ok(None) };
        new.check_noise("--init-from")?;
        let saved = saved_policy::load(&from, any.checkpoint)?;
        Ok(Some(Self { from, saved, rate_is_given: new.gives(RATE) }))
    }

    /// Returns the model of the policy; empty without one.
    pub fn model_of(from: Option<&Self>) -> &str {
        from.map_or("", |from| &from.saved.policy.model_xml)
    }

    /// Returns a model text, which was read from `file` if given, with hinges and motors in the order of the policy's model.
    ///
    /// # Errors
    /// If they have other names: a policy means nothing to another body.
    pub fn in_its_order(&self, text: &str, file: Option<&Path>) -> Result<String, Usage> {
        let Self { from, saved, .. } = self;
        if saved.policy.model_xml.is_empty() {
            let why = format!("`--init-from {from}`: it is the policy of an external task, and this run has a robot");
            return Err(Usage(why + "; begin a run of that task by --task, or name another policy"));
        }
        mjcf::in_order_of(text, &saved.policy.model_xml).map_err(|why| {
            let Usage(why) = model::in_file(file, &why);
            Usage(format!("`--init-from {from}`: {why}"))
        })
    }

    /// Returns why a run with networks of this shape cannot begin with it, if so.
    pub fn objection(&self, ours: &NetworkShape) -> Option<String> {
        let Self { from, saved: SavedPolicy { policy: ExportedPolicy { shape: theirs, .. }, .. }, .. } = self;
        (theirs != ours).then(|| {
            format!(
                "`--init-from {from}`: its networks have {} observations, {} actions and hidden layers {:?}; those of \
                 this run have {}, {} and {:?}; use the same robot and policy.hidden, and the same {OBSERVATION_KEYS}",
                theirs.observation, theirs.action, theirs.hidden, ours.observation, ours.action, ours.hidden
            )
        })
    }

    /// Copies its weights and statistics into the state of a new run, whose counters remain. Returns what was copied.
    ///
    /// # Errors
    /// If its networks have another shape.
    pub fn copy_to(&self, state: &mut TrainingState) -> anyhow::Result<String> {
        if let Some(why) = self.objection(state.shape()) {
            return Err(Usage(why).into());
        }
        let Self { from, saved: SavedPolicy { policy, origin, .. }, rate_is_given } = self;
        let count = policy.observation.count;
        let m2 = policy.variance.iter().map(|variance| variance * count).collect();
        let observation_moments = RunningMoments { count, mean: policy.mean.clone(), m2 };
        let (parameters, value_moments) =
            (policy.parameters.clone(), policy.returns.as_ref().map(ReturnFacts::moments));
        let trained = TrainedPolicy { parameters, observation_moments, value_moments };
        let config = state.config().map_err(anyhow::Error::msg)?;
        state.ppo.begin_with(trained, &config.ppo).map_err(|distance| {
            Usage(format!(
                "`--init-from {}`: its networks do not act mirrored in mirrored states (they are {:.0} % away from such \
                 ones), and those of this run must; add --set ppo.symmetry=off",
                self.from,
                distance * 100.0
            ))
        })?;
        if *rate_is_given {
            state.ppo.adopt_key(RATE, &config.ppo);
        }
        Ok(origin.as_ref().map_or_else(|| format!("`{from}`"), |origin| format!("`{from}`, {origin}")))
    }
}

/// Learning state of another run: what a new run that branches off goes on from.
pub struct Fork {
    /// Weights, optimiser, statistics and counters.
    pub state: TrainingState,
    /// What was copied, for the banner.
    pub origin: String,
}

impl Fork {
    /// Reads the state of the run `from`.
    ///
    /// # Errors
    /// If there is no such run, or this program cannot continue it.
    pub fn read(from: &str, which: Option<CheckpointChoice>) -> anyhow::Result<Self> {
        let loaded = saved_run::load(from, which.unwrap_or(CheckpointChoice::Latest))?;
        let mut state = loaded.state;
        let origin = format!("`{from}`, checkpoint {}, {} steps", loaded.name, thousands(state.counters.env_steps));
        if !state.config().map_err(anyhow::Error::msg)?.is_external() {
            state.adopt_physics(PHYSICS_VERSION).map_err(anyhow::Error::msg)?;
        }
        state.lineage.resume(seeds::unique());
        // Its own actors will deliver to it, and its own episodes decide what is best.
        state.episodes.forget();
        (state.ledger, state.fragment_counts) = (Ledger::default(), FragmentCounts::default());
        (state.best_return, state.best_is_evaluated, state.actor_state) = (None, false, None);
        state.counters.resumes = 0;
        Ok(Self { state, origin })
    }

    /// Returns the state with another configuration.
    ///
    /// # Errors
    /// If the configuration does not fit the state, or has no more steps than it.
    pub fn with_config(mut self, config: &Config, new: &NewRunArgs) -> anyhow::Result<TrainingState> {
        new.check_noise("--fork")?;
        let state = &mut self.state;
        let reached = state.counters.env_steps;
        if config.run.steps <= reached {
            return Err(Usage(format!(
                "`--fork`: the run is at {} steps already and its goal is {}; go on with `--steps {}`",
                thousands(reached),
                thousands(config.run.steps),
                reached.saturating_mul(2)
            ))
            .into());
        }
        let before = state.config().map_err(anyhow::Error::msg)?;
        if before.env.robot != config.env.robot {
            let why = "`env.robot`: a fork keeps the robot of its run; begin a new run with --model and --init-from";
            return Err(Usage(why.to_string()).into());
        }
        // It replaces the adapted one.
        if new.gives(RATE) {
            state.ppo.adopt_key(RATE, &config.ppo);
        }
        if before.run.seed != config.run.seed {
            state.ppo.set_shuffle(seeds::stream(config.run.seed, "shuffle", &[]));
        }
        state.config_toml = config.to_toml();
        state.check().map_err(|why| Usage(format!("`--fork`: the new configuration does not fit: {why}")))?;
        Ok(self.state)
    }
}
