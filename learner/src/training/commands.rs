//! Applies control commands.

use std::time::Duration;

use treadmill_config::{Config, ConfigError, ConfigSource};
use treadmill_ppo::settings;
use treadmill_proto::{Command, ControlRequest};
use treadmill_runtime::{error_chain, numbers::thousands};

use super::{Trainer, TrainingError};

/// Longest wait of a paused learner between two checks for shutdown.
const TICK: Duration = Duration::from_millis(50);

/// Keys outside `[ppo]` that may change during a run, because no actor depends on them.
const CHANGEABLE: &[&str] = &[
    "run.steps",
    "run.share",
    "run.envs_min",
    "run.envs_max",
    "eval.every_steps",
    "learner.checkpoint_every_updates",
    "learner.keep_checkpoints",
    "learner.table_every_updates",
    "learner.metrics_every_ms",
    "learner.undone_max",
];

/// Whether a key of the configuration may change during a run.
pub fn is_changeable(key: &str) -> bool {
    CHANGEABLE.contains(&key) || settings::is_changeable(key)
}

impl Trainer {
    /// Applies every queued command; while paused, waits for more.
    pub(super) fn apply_commands(&mut self) -> Result<(), TrainingError> {
        while !self.shutdown.asked() {
            self.heartbeat.beat();
            let timeout = if self.is_paused { TICK } else { Duration::ZERO };
            let Some(pending) = self.serving.control.next(timeout) else {
                if self.is_paused {
                    self.serving.storage.check_leadership()?;
                    self.publish_status_if_due();
                    continue;
                }
                break;
            };
            let outcome = self.apply(&pending.request);
            if let Ok(text) = &outcome {
                tracing::info!(outcome = text, "command applied");
            }
            self.publish_status(false);
            self.serving.control.answer(pending, outcome);
        }
        Ok(())
    }

    fn apply(&mut self, request: &ControlRequest) -> Result<String, String> {
        let (updates, env_steps) = (self.state.counters.updates, thousands(self.state.counters.env_steps));
        match request.command() {
            Command::Pause if self.is_paused => Ok(format!("paused already, after update {updates}")),
            Command::Pause => {
                self.is_paused = true;
                self.serving.set_open(false);
                Ok(format!("paused after update {updates} ({env_steps} env steps); actors keep their fragments"))
            }
            Command::Resume if !self.is_paused => Ok("the run is not paused".to_string()),
            Command::Resume => {
                self.is_paused = false;
                self.serving.set_open(true);
                Ok(format!("resumed after update {updates} ({env_steps} env steps)"))
            }
            Command::Checkpoint => {
                let place = self.serving.storage.save_kept(updates).map_err(|why| error_chain(&why))?;
                Ok(format!("the state after update {updates} ({env_steps} env steps) is saved as {place}"))
            }
            Command::Stop => {
                self.is_stopped = true;
                self.shutdown.ask();
                Ok(format!("stopping; saved after update {updates} ({env_steps} env steps)"))
            }
            Command::Set => self.set(&request.key, &request.value),
            Command::Status | Command::Unspecified => Ok(String::new()),
        }
    }

    /// Changes one key.
    fn set(&mut self, key: &str, value: &str) -> Result<String, String> {
        let mut changed = changed(&self.state.config_toml, key, value).map_err(|why| error_chain(&why))?;
        settings::choose(&mut changed.ppo, self.state.ppo.networks());
        self.objection(key, &changed).map_or(Ok(()), Err)?;
        let before = self.config.value_of(key);
        self.adopt(key, changed).map_err(|why| error_chain(&why))?;
        let after = self.config.value_of(key);
        let from = self.state.counters.updates + 1;
        Ok(format!("{key} is {after}, was {before}, from update {from} on"))
    }

    /// Returns why a key cannot be changed, if so.
    fn objection(&self, key: &str, changed: &Config) -> Option<String> {
        if !is_changeable(key) {
            return Some(format!(
                "`{key}` cannot be changed during the run, because actors or the state depend on it; changeable are {}, and \
                 the keys of [ppo] other than {}",
                CHANGEABLE.join(", "),
                settings::FIXED_KEYS.join(", ")
            ));
        }
        let is_late = key == "eval.every_steps" && !self.serving.evaluates() && changed.evaluates();
        is_late.then(|| {
            "`eval.every_steps` cannot be set, because the run was started without evaluation; start a new run with it"
                .to_string()
        })
    }

    /// Lets every part adopt a configuration in which `key` has changed, and saves it.
    fn adopt(&mut self, key: &str, changed: Config) -> Result<(), TrainingError> {
        let Self { state, config, learning, serving, reporting, .. } = self;
        state.config_toml = changed.to_toml();
        // The goal of this start may be nearer than the one that is saved.
        let steps = if key == "run.steps" { changed.run.steps } else { config.run.steps };
        *config = changed;
        config.run.steps = steps;
        let grown = config.grown(state.counters.env_steps);
        state.ppo.adopt_key(key, &config.ppo);
        learning.set_config(&grown);
        serving.set_config(state, &grown);
        // A run that is stopped before its next update goes on with the change, too.
        serving.storage.save(state)?;
        reporting.set_config(state, config);
        Ok(())
    }
}

/// Returns the configuration `toml` with another value of `key`.
fn changed(toml: &str, key: &str, value: &str) -> Result<Config, ConfigError> {
    let mut source = ConfigSource::default();
    source.text(toml, "the configuration of the run")?;
    source.set(&format!("{key}={value}"))?;
    source.build()
}
