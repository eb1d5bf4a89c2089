//! What the training thread does when it is told to.

use std::time::Duration;

use treadmill_config::ConfigSource;
use treadmill_runtime::{machine, shutdown::Shutdown};
use treadmill_proto::{Command, ControlRequest, Phase, RunStatus};

use super::Trainer;
use crate::{checkpoint::TrainingState, pace::Pace};

/// How often a paused learner looks whether it is to stop.
const TICK: Duration = Duration::from_millis(50);
/// Status is told anew at least this often, also while no update comes to an end.
pub(super) const TELL_EVERY: Duration = Duration::from_secs(1);

/// Keys that may change while a run goes on, beside all of `[ppo]` but those below: no actor depends on them.
const CHANGEABLE: &[&str] = &[
    "run.steps",
    "eval.every_steps",
    "learner.checkpoint_every_updates",
    "learner.keep_checkpoints",
    "learner.table_every_updates",
    "learner.undone_max",
];
/// Keys of `[ppo]` that are built into what was begun.
const FIXED: &[&str] = &["ppo.symmetry"];

/// Whether a key of the configuration may change while a run goes on.
pub fn is_changeable(key: &str) -> bool {
    CHANGEABLE.contains(&key) || key.starts_with("ppo.") && !FIXED.contains(&key)
}

/// What is told of a run before its first update.
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
    /// Heeds every command that waits; while paused, waits for more.
    pub(super) fn heed_commands(&mut self, shutdown: &Shutdown) {
        while !shutdown.asked() {
            self.pulse.beat();
            let patience = if self.paused { TICK } else { Duration::ZERO };
            let Some(inquiry) = self.control.next(patience) else {
                if self.paused {
                    self.tell_if_due(shutdown);
                    continue;
                }
                break;
            };
            let outcome = self.obey(&inquiry.request, shutdown);
            if let Ok(text) = &outcome {
                tracing::info!("on request: {text}");
            }
            self.tell(shutdown, false);
            self.control.answer(inquiry, outcome);
        }
    }

    fn obey(&mut self, request: &ControlRequest, shutdown: &Shutdown) -> Result<String, String> {
        let (updates, env_steps) = (self.state.counters.updates, self.state.counters.env_steps);
        match request.command() {
            Command::Pause if self.paused => Ok(format!("it is paused already, after update {updates}")),
            Command::Pause => {
                self.paused = true;
                Ok(format!("paused after update {updates} ({env_steps} env steps); actors keep what they have"))
            }
            Command::Resume if !self.paused => Ok("it is not paused".to_string()),
            Command::Resume => {
                self.paused = false;
                Ok(format!("going on after update {updates} ({env_steps} env steps)"))
            }
            Command::Checkpoint => {
                let path = self.saver.keep_newest(updates).map_err(|why| why.to_string())?;
                Ok(format!("the state after update {updates} ({env_steps} env steps) is kept as {}", path.display()))
            }
            Command::Stop => {
                shutdown.ask();
                Ok(format!("stopping; saved after update {updates} ({env_steps} env steps)"))
            }
            Command::Set => self.set(&request.key, &request.value),
            Command::Status | Command::Unspecified => Ok(String::new()),
        }
    }

    /// Changes one key, and all that is made from it.
    fn set(&mut self, key: &str, value: &str) -> Result<String, String> {
        let mut source = ConfigSource::default();
        let source_of = "the configuration of the run";
        source.text(&self.state.config_toml, source_of).map_err(|why| why.to_string())?;
        source.set(&format!("{key}={value}")).map_err(|why| why.to_string())?;
        let changed = source.build().map_err(|why| why.to_string())?;
        if !is_changeable(key) {
            return Err(format!(
                "`{key}` cannot be changed while the run goes on, because actors or the state depend on it; changeable are \
                 {}, and the keys of [ppo] other than {}",
                CHANGEABLE.join(", "),
                FIXED.join(", ")
            ));
        }
        if self.trial.is_none() && changed.evaluates() {
            return Err(
                "`eval.every_steps` cannot be set where the run began without evaluation; resume it with the value \
                        you want"
                    .to_string(),
            );
        }
        let before = self.config.value_of(key);
        if key == "ppo.learning_rate" {
            // What adaptation has made of it gives way, too.
            self.updater.set_learning_rate(changed.ppo.learning_rate);
        }
        self.updater.set_config(&changed.ppo);
        self.pace = Pace::new(&changed);
        self.saver.set_rule(changed.learner.checkpoint_every_updates.into(), changed.learner.keep_checkpoints as usize);
        self.report.set_table_every(changed.learner.table_every_updates.into());
        self.report.set_steps(changed.run.steps);
        if let Some(trial) = &mut self.trial {
            trial.set_every(changed.eval.every_steps, self.state.counters.env_steps);
        }
        self.state.config_toml = changed.to_toml();
        self.config = changed;
        let after = self.config.value_of(key);
        let from = self.state.counters.updates + 1;
        Ok(format!("{key} is {after}, was {before}, from update {from} on"))
    }

    /// Tells anew how it goes where that was not done for a while.
    pub(super) fn tell_if_due(&mut self, shutdown: &Shutdown) {
        if self.control.since_told() >= TELL_EVERY {
            self.tell(shutdown, false);
        }
    }

    /// Tells how it goes; `is_update` right after an update.
    pub(super) fn tell(&mut self, shutdown: &Shutdown, is_update: bool) {
        let (state, judge) = (&self.state, self.intake.judge());
        let (means, tally) = (state.episodes.means(), judge.tally);
        let phase = match (shutdown.asked(), self.paused) {
            (true, _) => Phase::Stopping,
            (false, true) => Phase::Paused,
            (false, false) => Phase::Training,
        };
        let status = RunStatus {
            phase: phase.into(),
            env_steps: state.counters.env_steps,
            updates: state.counters.updates,
            wall_s: state.counters.wall_s,
            env_steps_per_s: self.env_steps_per_s,
            return_mean: means.map(|means| means.return_mean),
            length_mean: means.map(|means| means.length_mean),
            distance_mean_m: means.map(|means| means.distance_mean_m),
            velocity_mean_mps: means.map(|means| means.velocity_mean_mps),
            policy_lag_mean: self.lag_mean,
            resident_bytes: machine::resident_bytes(),
            accepted: tally.accepted,
            accepted_bytes: judge.accepted_bytes(),
            duplicate: tally.duplicate,
            too_old: tally.too_old,
            vanished: tally.vanished,
            malformed: tally.malformed,
            quarantined: tally.quarantined,
            ..first_status(state, self.config.run.steps)
        };
        let quarantined = judge.quarantined(std::time::Instant::now());
        self.control.tell(status, quarantined, is_update);
    }
}
