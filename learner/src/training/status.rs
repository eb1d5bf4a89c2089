//! Publishes the status of a run.

use std::time::{Duration, Instant};

use treadmill_config::Config;
use treadmill_proto::{PartTime, Phase, RunStatus};
use treadmill_runtime::{machine, program};

use super::Trainer;
use crate::{
    checkpoint::TrainingState,
    metrics::{PARTS, PartTimes, RunFigures},
};

/// Longest interval between two publications of the status while the learner waits.
pub(super) const EVERY: Duration = Duration::from_secs(1);

/// Returns the status of a run before its first update.
pub(super) fn first(state: &TrainingState, config: &Config) -> RunStatus {
    RunStatus {
        run: state.run.clone(),
        phase: Phase::Training.into(),
        version: Some(state.lineage.newest()),
        host: machine::host_name(),
        pid: std::process::id(),
        program_version: program::version().to_string(),
        env_steps_wanted: config.run.steps,
        ..RunStatus::default()
    }
}

fn parts(times: &PartTimes) -> Vec<PartTime> {
    let shares = times.shares().into_iter().flatten();
    PARTS.iter().zip(shares).map(|(part, share)| PartTime { name: part.name.to_string(), share }).collect()
}

impl Trainer {
    /// Publishes the status if [`EVERY`] has passed since the last time.
    pub(super) fn publish_status_if_due(&mut self) {
        if self.serving.control.since_status() >= EVERY {
            self.publish_status(false);
        }
    }

    /// Publishes the status; `is_update` right after an update.
    pub(super) fn publish_status(&mut self, is_update: bool) {
        let pool = self.serving.pool();
        if let Some(demand) = &pool {
            self.reporting.show_demand(demand);
        }
        let (state, validator, reporting) = (&self.state, &self.serving.intake.validator, &self.reporting);
        let (means, counts) = (state.episodes.means(), validator.counts);
        let phase = match (self.shutdown.asked(), self.is_paused) {
            (true, _) => Phase::Stopping,
            (false, true) => Phase::Paused,
            (false, false) => Phase::Training,
        };
        let status = RunStatus {
            phase: phase.into(),
            env_steps: state.counters.env_steps,
            updates: state.counters.updates,
            wall_s: state.counters.wall_s,
            env_steps_per_s: reporting.efficiency.env_steps_per_s,
            return_mean: means.map(|means| means.return_mean),
            length_mean: means.map(|means| means.length_mean),
            distance_mean_m: means.map(|means| means.distance_mean_m),
            velocity_mean_mps: means.map(|means| means.velocity_mean_mps),
            fall_fraction: means.map(|means| means.fall_fraction),
            has_commands: reporting.history.figures == RunFigures::Tracking,
            velocity_error_mps: reporting.history.tracking_errors.map(|[velocity, _]| velocity),
            yaw_rate_error_radps: reporting.history.tracking_errors.map(|[_, yaw_rate]| yaw_rate),
            done_share: reporting.history.imitated.map(|[done_share, _]| done_share),
            body_error_m: reporting.history.imitated.map(|[_, error_m]| error_m),
            policy_lag_mean: reporting.lag_mean,
            resident_bytes: machine::resident_bytes(),
            accepted: counts.accepted,
            accepted_bytes: validator.accepted_bytes,
            duplicate: counts.duplicate,
            too_old: counts.too_old,
            vanished: counts.vanished,
            malformed: counts.malformed,
            quarantined: counts.quarantined,
            used_share: reporting.efficiency.used_share,
            idle_share: reporting.efficiency.idle_share,
            undone_updates: state.counters.undone_updates,
            limit: reporting.parts.limit().map(|part| part.name.to_string()).unwrap_or_default(),
            limit_help: reporting.parts.limit().map(|part| part.help.to_string()).unwrap_or_default(),
            parts: parts(&reporting.parts),
            pool,
            alarms: reporting.alarms.texts(&validator.rejections, Instant::now()),
            ..first(state, &self.config)
        };
        let quarantined = validator.quarantined(Instant::now());
        self.serving.report_envs();
        self.serving.control.set_status(status, quarantined, is_update);
    }
}
