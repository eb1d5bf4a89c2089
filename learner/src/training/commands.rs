//! Applies control commands and publishes the run's status.

use std::time::Duration;

use treadmill_config::{ConfigSource, LearnerConfig};
use treadmill_policy::NetworkShape;
use treadmill_proto::{Command, ControlRequest, Phase, RunStatus};
use treadmill_runtime::{atomic_file, error_chain, machine, numbers::thousands};

use super::{
    Trainer, TrainingError,
    load_adaptation::LoadAdaptation,
    serving::{Serving, save_newest},
};
use crate::{checkpoint::TrainingState, intake::HorizonRule};

/// Longest wait of a paused learner between two checks for shutdown.
const TICK: Duration = Duration::from_millis(50);
/// Longest interval between two publications of the status while the learner waits.
pub(super) const STATUS_EVERY: Duration = Duration::from_secs(1);

/// Keys outside `[ppo]` that may change during a run, because no actor depends on them.
const CHANGEABLE: &[&str] = &[
    "run.steps",
    "eval.every_steps",
    "learner.checkpoint_every_updates",
    "learner.keep_checkpoints",
    "learner.table_every_updates",
    "learner.undone_max",
];
/// Keys of `[ppo]` that cannot change during a run.
const FIXED: &[&str] = &["ppo.symmetry"];

/// Whether a key of the configuration may change during a run.
pub fn is_changeable(key: &str) -> bool {
    CHANGEABLE.contains(&key) || key.starts_with("ppo.") && !FIXED.contains(&key)
}

/// Returns the status of a run before its first update.
pub(super) fn first_status(state: &TrainingState, env_steps_wanted: u64) -> RunStatus {
    RunStatus {
        run: state.run.clone(),
        phase: Phase::Training.into(),
        version: Some(state.lineage.newest().into()),
        host: machine::host_name(),
        pid: std::process::id(),
        program_version: env!("CARGO_PKG_VERSION").to_string(),
        env_steps_wanted,
        ..RunStatus::default()
    }
}

impl Trainer {
    /// Applies every queued command; while paused, waits for more.
    pub(super) fn apply_commands(&mut self) -> Result<(), TrainingError> {
        while !self.shutdown.asked() {
            self.serving.heartbeat.beat();
            let timeout = if self.serving.paused { TICK } else { Duration::ZERO };
            let Some(pending) = self.serving.control.next(timeout) else {
                if self.serving.paused {
                    self.check_leadership()?;
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
            Command::Pause if self.serving.paused => Ok(format!("paused already, after update {updates}")),
            Command::Pause => {
                self.serving.paused = true;
                Ok(format!("paused after update {updates} ({env_steps} env steps); actors keep their fragments"))
            }
            Command::Resume if !self.serving.paused => Ok("the run is not paused".to_string()),
            Command::Resume => {
                self.serving.paused = false;
                Ok(format!("resumed after update {updates} ({env_steps} env steps)"))
            }
            Command::Checkpoint => {
                let Serving { checkpoints, saved, .. } = &self.serving;
                let place = checkpoints.save_kept(updates, saved).map_err(|why| error_chain(&why))?;
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

    /// Changes one key and every part that depends on it.
    fn set(&mut self, key: &str, value: &str) -> Result<String, String> {
        let mut source = ConfigSource::default();
        source.text(&self.state.config_toml, "the configuration of the run").map_err(|why| error_chain(&why))?;
        source.set(&format!("{key}={value}")).map_err(|why| error_chain(&why))?;
        let mut changed = source.build().map_err(|why| error_chain(&why))?;
        let saved_toml = changed.to_toml();
        if key != "run.steps" {
            // The goal of this start may be nearer than the one that is saved.
            changed.run.steps = self.config.run.steps;
        }
        if !is_changeable(key) {
            return Err(format!(
                "`{key}` cannot be changed during the run, because actors or the state depend on it; changeable are {}, and \
                 the keys of [ppo] other than {}",
                CHANGEABLE.join(", "),
                FIXED.join(", ")
            ));
        }
        if key == "eval.every_steps" && self.serving.evaluation.is_none() && changed.evaluates() {
            let why = "`eval.every_steps` cannot be set, because the run was started without evaluation; start a new run \
                       with it";
            return Err(why.to_string());
        }
        let before = self.config.value_of(key);
        self.state.ppo.adopt_key(key, &changed.ppo);
        self.learning.ppo.set_config(&changed.ppo);
        self.learning.load = LoadAdaptation::new(&changed);
        let NetworkShape { observation, action, .. } = self.state.shape;
        self.serving.intake.fleet.set_rule(HorizonRule::new(&changed, observation, action));
        let LearnerConfig { checkpoint_every_updates, keep_checkpoints, .. } = changed.learner;
        self.serving.checkpoints.set_retention(checkpoint_every_updates.into(), keep_checkpoints as usize);
        let for_report = changed.clone();
        self.reporting.background.submit(move |report| {
            report.set_config(&for_report);
            Ok(())
        });
        if let Some(evaluation) = &mut self.serving.evaluation {
            evaluation.set_every(changed.eval.every_steps, self.state.counters.env_steps);
        }
        self.state.config_toml = saved_toml;
        self.config = changed;
        // A run that is stopped before its next update goes on with the change, too.
        let Serving { checkpoints, leadership, .. } = &mut self.serving;
        let saved = save_newest(&self.state, leadership.as_mut(), checkpoints, &self.retry);
        self.serving.saved = saved.map_err(|why| error_chain(&why))?;
        let file = &self.reporting.config_file;
        if let Err(why) = atomic_file::write(file, self.state.config_toml.as_bytes()) {
            tracing::warn!(file = %file.display(), error = %why, "the changed configuration cannot be written");
        }
        let after = self.config.value_of(key);
        let from = self.state.counters.updates + 1;
        Ok(format!("{key} is {after}, was {before}, from update {from} on"))
    }

    /// Publishes the status if [`STATUS_EVERY`] has passed since the last time.
    pub(super) fn publish_status_if_due(&mut self) {
        if self.serving.control.since_status() >= STATUS_EVERY {
            self.publish_status(false);
        }
    }

    /// Publishes the status; `is_update` right after an update.
    pub(super) fn publish_status(&mut self, is_update: bool) {
        let (state, validator) = (&self.state, &self.serving.intake.validator);
        let (means, counts) = (state.episodes.means(), validator.counts);
        let phase = match (self.shutdown.asked(), self.serving.paused) {
            (true, _) => Phase::Stopping,
            (false, true) => Phase::Paused,
            (false, false) => Phase::Training,
        };
        let status = RunStatus {
            phase: phase.into(),
            env_steps: state.counters.env_steps,
            updates: state.counters.updates,
            wall_s: state.counters.wall_s,
            env_steps_per_s: self.reporting.env_steps_per_s,
            return_mean: means.map(|means| means.return_mean),
            length_mean: means.map(|means| means.length_mean),
            distance_mean_m: means.map(|means| means.distance_mean_m),
            velocity_mean_mps: means.map(|means| means.velocity_mean_mps),
            policy_lag_mean: self.reporting.lag_mean,
            resident_bytes: machine::resident_bytes(),
            accepted: counts.accepted,
            accepted_bytes: validator.accepted_bytes,
            duplicate: counts.duplicate,
            too_old: counts.too_old,
            vanished: counts.vanished,
            malformed: counts.malformed,
            quarantined: counts.quarantined,
            used_share: self.reporting.efficiency.used_share,
            idle_share: self.reporting.efficiency.idle_share,
            undone_updates: state.counters.undone_updates,
            alarms: self.reporting.alarms.texts(&validator.rejections, std::time::Instant::now()),
            ..first_status(state, self.config.run.steps)
        };
        let quarantined = validator.quarantined(std::time::Instant::now());
        self.serving.control.set_status(status, quarantined, is_update);
    }
}
