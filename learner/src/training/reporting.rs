//! Logs each update.

use std::{
    io,
    path::PathBuf,
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::{Duration, Instant},
};

use treadmill_bus::learner::StatsFeed;
use treadmill_ppo::{AcceptedFragment, UpdateStats};
use treadmill_runtime::error_chain;

use super::{
    Trainer, TrainingError, TrainingOptions, alarms::Alarms, background::Background, evaluation::EvaluationResult,
};
use crate::{
    checkpoint::TrainingState,
    intake::ledger_report,
    leadership::Status,
    metrics::{
        Efficiency, EfficiencyMeter, History, MetricsReport, PrometheusMetrics, RewardTerms, histograms,
        scalars::{PhaseDurations, PolicyLag, ThroughputMeter, UpdateRecord},
    },
};

/// Longest time for writing into the store why a leadership ended. A supervisor kills after a minute at the earliest.
const END_WITHIN: Duration = Duration::from_secs(20);

/// Reporting part of a [`Trainer`].
pub(super) struct Reporting {
    pub(super) background: Background,
    /// Return and distance over the run.
    pub(super) history: History,
    stats: StatsFeed,
    prometheus: PrometheusMetrics,
    ledger_report: PathBuf,
    /// Configuration in the run folder.
    pub(super) config_file: PathBuf,
    action_names: Vec<String>,
    reward_terms: RewardTerms,
    throughput: ThroughputMeter,
    efficiency_meter: EfficiencyMeter,
    /// Efficiency of the fleet over the last updates.
    pub(super) efficiency: Efficiency,
    pub(super) alarms: Alarms,
    restarts: Arc<AtomicU64>,
    restarts_before: u64,
    /// Environment steps that actors had counted when this process started.
    pub(super) simulated_before: u64,
    begun: Instant,
    /// When the last round was logged, and how long the intake had been idle then.
    last_round: (Instant, Duration),
    wall_before_s: f64,
    pub(super) env_steps_per_s: f64,
    /// Mean lag of the last batch.
    pub(super) lag_mean: f64,
}

impl Reporting {
    pub(super) fn new(
        report: MetricsReport,
        history: History,
        stats: StatsFeed,
        state: &TrainingState,
        options: &TrainingOptions,
    ) -> io::Result<Self> {
        Ok(Self {
            background: Background::start(report)?,
            history,
            stats,
            prometheus: options.prometheus.clone(),
            ledger_report: options.folder.accounts(),
            config_file: options.folder.config(),
            action_names: options.action_names.clone(),
            reward_terms: RewardTerms::default(),
            throughput: ThroughputMeter::new(state.counters.env_steps),
            efficiency_meter: EfficiencyMeter::new(Instant::now()),
            efficiency: Efficiency::default(),
            alarms: Alarms::default(),
            restarts: options.restarts.clone(),
            restarts_before: state.counters.restarts,
            simulated_before: state.counters.env_steps_simulated,
            begun: Instant::now(),
            last_round: (Instant::now(), Duration::ZERO),
            wall_before_s: state.counters.wall_s,
            env_steps_per_s: 0.0,
            lag_mean: 0.0,
        })
    }

    /// Seconds of training over the whole run.
    pub(super) fn wall_s(&self) -> f64 {
        self.wall_before_s + self.begun.elapsed().as_secs_f64()
    }

    /// Returns the work of the training thread besides the update, since the last call. `idle` is that of the intake so far.
    pub(super) fn serial(&mut self, update: Duration, idle: Duration) -> Duration {
        let (last, idle_before) = std::mem::replace(&mut self.last_round, (Instant::now(), idle));
        self.last_round.0.duration_since(last).saturating_sub(update + (idle - idle_before))
    }

    /// Restarts of actor processes over the whole run.
    pub(super) fn restarts(&self) -> u64 {
        self.restarts_before + self.restarts.load(Ordering::Relaxed)
    }
}

impl Trainer {
    /// Logs one update.
    pub(super) fn log(
        &mut self,
        update: Option<&UpdateStats>,
        batch: &[AcceptedFragment],
        durations: PhaseDurations,
        evaluation: Option<&EvaluationResult>,
    ) -> Result<(), TrainingError> {
        let Self { state, config, retry, learning, serving, reporting, .. } = self;
        let alive = serving.intake.alive();
        let learnt = if update.is_some() { transitions(batch) } else { 0 };
        let effort = serving.intake.fleet.effort();
        reporting.efficiency = reporting.efficiency_meter.mark(Instant::now(), learnt, effort, alive.len());
        let (too_old, undone) = (serving.intake.validator.counts.too_old, state.counters.undone_updates);
        reporting.alarms.record_efficiency(reporting.efficiency, too_old, undone, config);
        let env_steps = state.counters.env_steps;
        let (throughput, lag) = (reporting.throughput.mark(env_steps, serving.waited), PolicyLag::of(batch));
        (reporting.env_steps_per_s, reporting.lag_mean) = (throughput.env_steps_per_s, lag.mean);
        let stats = reporting.stats.newest();
        reporting.prometheus.set_actors(stats, state.lineage.newest());
        let (return_mean, distance_m) = state.episodes.means().map(|m| (m.return_mean, m.distance_mean_m)).unzip();
        reporting.history.add(return_mean, distance_m, evaluation.map(|result| result.report.distance_mean_m));
        if let Some(EvaluationResult { report, .. }) = evaluation {
            reporting.history.note_tracking(report.velocity_error_mps, report.yaw_rate_error_radps);
        }
        let validator = &serving.intake.validator;
        let record = UpdateRecord {
            state,
            config,
            update,
            lag,
            reward_terms: reporting.reward_terms.of(batch),
            epochs: learning.load.epochs(),
            durations,
            evaluation,
            history: &reporting.history,
            throughput,
            stats,
            efficiency: reporting.efficiency,
            alive,
            quarantined: validator.quarantined(Instant::now()).len(),
            turned_away: validator.turned_away,
            accepted_bytes: validator.accepted_bytes,
        };
        let scalars = record.scalars();
        let updates = state.counters.updates;
        let histograms = histograms::is_due(updates).then(|| histograms::of(batch, &reporting.action_names));
        let (history, retry) = (reporting.history.clone(), retry.clone());
        reporting.background.submit(move |report| {
            if let Some(histograms) = histograms {
                report.log_histograms(env_steps, &histograms, &retry)?;
            }
            Ok(report.log(env_steps, updates, &scalars, &history, &retry)?)
        });
        reporting.background.check()
    }

    /// Ends the run: answers waiting senders and writes the last logs. `outcome` is whether the run was stopped before
    /// its last step. Returns the state, what it has reached, and the outcome.
    pub(super) fn finish(
        mut self,
        outcome: Result<bool, TrainingError>,
    ) -> Result<(TrainingState, History, bool), TrainingError> {
        self.serving.intake.stop(&self.state.lineage);
        self.end_leadership(&outcome);
        let Reporting { background, history, ledger_report, .. } = self.reporting;
        let (mut report, written) = background.finish();
        let outcome = outcome.and_then(|stopped| written.map(|()| stopped));
        report.end(outcome.as_ref().ok().copied());
        let stopped = outcome?;
        // The ledger of the last checkpoint, without fragments accepted since. The run is saved, whatever becomes of these.
        if let Err(why) = ledger_report::write(&ledger_report, &self.state.ledger) {
            tracing::warn!(file = %ledger_report.display(), error = %error_chain(&why), "the accounts cannot be written");
        }
        if let Err(why) = report.finish(&history) {
            tracing::warn!(error = %error_chain(&why), "the last logs cannot be written");
        }
        Ok((self.state, history, stopped))
    }
}

impl Trainer {
    /// Says in the store why this learner leads no longer, so that a standby need not wait.
    fn end_leadership(&mut self, outcome: &Result<bool, TrainingError>) {
        let Some(leadership) = &mut self.serving.leadership else { return };
        let status = match outcome {
            Ok(false) => Status::Finished,
            Ok(true) if self.is_stopped => Status::Stopped,
            _ => Status::Released,
        };
        // A standby finds out by itself that a learner is gone, but not that the run is to end.
        let within = if status == Status::Released { Duration::ZERO } else { END_WITHIN };
        match (leadership.end(status, within), status) {
            (Ok(()), _) => {}
            (Err(why), Status::Stopped) => {
                tracing::warn!(error = %error_chain(&why), "the store does not know that the run was stopped: stop standbys, too");
            }
            (Err(why), _) => tracing::debug!(error = %error_chain(&why), "end of the leadership not written"),
        }
    }
}

fn transitions(batch: &[AcceptedFragment]) -> u64 {
    batch.iter().map(|accepted| accepted.fragment.transitions() as u64).sum()
}
