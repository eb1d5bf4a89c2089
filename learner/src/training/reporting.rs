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
use treadmill_config::Config;
use treadmill_proto::PoolDemand;
use treadmill_runtime::atomic_file;

use super::{
    Learning, Serving, TrainingError, TrainingOptions, Update, alarms::Alarms, background::Background,
    evaluation::EvaluationResult,
};
use crate::{
    checkpoint::{Counters, TrainingState},
    intake::{CollectedBatch, FleetEffort},
    metrics::{
        Efficiency, EfficiencyMeter, History, MetricsReport, PartMeter, PartTimes, PrometheusMetrics, RewardTerms,
        histograms,
        scalars::{PhaseDurations, PolicyLag, UpdateRecord},
    },
    waiting::Retry,
};

/// What is logged of a round.
pub(super) struct Round {
    pub(super) batch: CollectedBatch,
    pub(super) update: Update,
    /// Evaluation that has ended during the round.
    pub(super) evaluation: Option<EvaluationResult>,
    pub(super) durations: PhaseDurations,
}

/// Reporting part of a trainer.
pub(super) struct Reporting {
    pub(super) background: Background,
    /// Return and distance over the run.
    pub(super) history: History,
    stats: StatsFeed,
    prometheus: PrometheusMetrics,
    retry: Retry,
    /// Account of every actor process, in the run folder.
    pub(super) ledger_report: PathBuf,
    /// Configuration in the run folder.
    config_file: PathBuf,
    action_names: Vec<String>,
    reward_terms: RewardTerms,
    efficiency_meter: EfficiencyMeter,
    part_meter: PartMeter,
    /// Times of the parts over the last updates.
    pub(super) parts: PartTimes,
    /// When the last round ended.
    round_ended: Instant,
    /// Speed and efficiency over the last updates.
    pub(super) efficiency: Efficiency,
    pub(super) alarms: Alarms,
    restarts: Arc<AtomicU64>,
    restarts_before: u64,
    /// Environment steps that actors had counted when this process started.
    simulated_before: u64,
    begun: Instant,
    wall_before_s: f64,
    /// When an update was last logged.
    logged: Option<Instant>,
    /// Last set of histograms that was logged.
    histogram_set: u64,
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
        retry: Retry,
    ) -> io::Result<Self> {
        Ok(Self {
            background: Background::start(report)?,
            history,
            stats,
            prometheus: options.report.prometheus.clone(),
            retry,
            ledger_report: options.folder.accounts(),
            config_file: options.folder.config(),
            action_names: options.action_names.clone(),
            reward_terms: RewardTerms::default(),
            efficiency_meter: EfficiencyMeter::new(Instant::now(), state.counters.env_steps),
            part_meter: PartMeter::default(),
            parts: PartTimes::default(),
            round_ended: Instant::now(),
            efficiency: Efficiency::default(),
            alarms: Alarms::default(),
            restarts: options.restarts.clone(),
            restarts_before: state.counters.restarts,
            simulated_before: state.counters.env_steps_simulated,
            begun: Instant::now(),
            wall_before_s: state.counters.wall_s,
            logged: None,
            histogram_set: histograms::set_of(state.counters.updates),
            lag_mean: 0.0,
        })
    }

    /// Adopts a changed configuration, and writes that of the state into the run folder.
    pub(super) fn set_config(&self, state: &TrainingState, config: &Config) {
        let config = config.clone();
        self.background.submit(move |report| {
            report.set_config(&config);
            Ok(())
        });
        let file = &self.config_file;
        if let Err(why) = atomic_file::write(file, state.config_toml.as_bytes()) {
            tracing::warn!(file = %file.display(), error = %why, "the changed configuration cannot be written");
        }
    }

    /// Sets what the run has cost so far: time, restarts of actor processes, and the steps that they have simulated.
    pub(super) fn advance(&self, counters: &mut Counters, effort: FleetEffort) {
        counters.env_steps_simulated = self.simulated_before + effort.env_steps;
        counters.wall_s = self.wall_before_s + self.begun.elapsed().as_secs_f64();
        counters.restarts = self.restarts_before + self.restarts.load(Ordering::Relaxed);
    }

    /// Shows a long wait for experience on the console, and the number of actors, which are alive, on the metrics page.
    pub(super) fn show_wait(&self, waited: Duration, actors: usize) {
        self.prometheus.set([("actors/alive", actors as f64)]);
        self.background.submit(move |report| {
            report.show_wait(waited, actors);
            Ok(())
        });
    }

    /// Shows the demand for a pool's actors on the metrics page.
    pub(super) fn show_demand(&self, demand: &PoolDemand) {
        let values = [("pool/envs_wanted", demand.envs_wanted()), ("pool/envs", demand.envs)];
        self.prometheus.set(values.map(|(tag, envs)| (tag, f64::from(envs))));
    }

    /// Returns whether the metrics of an update are to be logged.
    fn is_due(&self, state: &TrainingState, config: &Config, has_evaluation: bool) -> bool {
        let every = Duration::from_millis(config.learner.metrics_every_ms.into());
        let Counters { env_steps, updates, .. } = state.counters;
        self.logged.is_none_or(|logged| logged.elapsed() >= every)
            || config.run.deterministic
            || has_evaluation
            || updates.is_multiple_of(config.learner.table_every_updates.into())
            || env_steps >= config.run.steps
    }

    /// Logs a round.
    pub(super) fn log(
        &mut self,
        state: &TrainingState,
        config: &Config,
        learning: &Learning,
        serving: &Serving,
        Round { batch, update, evaluation, durations }: &Round,
    ) -> Result<(), TrainingError> {
        let fragments = &batch.fragments;
        let (validator, alive) = (&serving.intake.validator, serving.intake.alive());
        let lag = PolicyLag::of(fragments);
        let learnt = match &update.result {
            Ok(_) => fragments.iter().map(|accepted| accepted.fragment.transitions() as u64).sum(),
            Err(_) => 0,
        };
        let (env_steps, effort) = (state.counters.env_steps, serving.intake.fleet.effort());
        self.efficiency =
            self.efficiency_meter.mark(Instant::now(), env_steps, serving.waited, learnt, effort, alive.len());
        let losses = [validator.counts.too_old, state.counters.undone_updates];
        self.alarms.record_efficiency(self.efficiency, losses, config, Instant::now());
        let error_mps = self.history.tracking_errors.map(|[velocity_mps, _]| velocity_mps);
        self.alarms.record_episodes((state.episodes.means(), error_mps), env_steps, config, Instant::now());
        self.lag_mean = lag.mean;
        let is_due = self.is_due(state, config, evaluation.is_some());
        let stats = self.stats.newest();
        let round = std::mem::replace(&mut self.round_ended, Instant::now()).elapsed();
        self.part_meter.add(learnt, round, durations);
        self.parts = self.part_meter.times(stats, config.learner.mode);
        self.prometheus.set_actors(stats, state.lineage.newest());
        let (return_mean, distance_m) = state.episodes.means().map(|m| (m.return_mean, m.distance_mean_m)).unzip();
        self.history.add(return_mean, distance_m, evaluation.as_ref().map(|result| result.report.distance_mean_m));
        if let Some(EvaluationResult { report, .. }) = evaluation {
            self.history.note_tracking(report.velocity_error_mps, report.yaw_rate_error_radps);
            self.history.note_imitation(report.done_share, report.body_error_m);
        }
        if !is_due {
            return self.background.check();
        }
        self.logged = Some(Instant::now());
        let record = UpdateRecord {
            state,
            clip_range: learning.ppo.clip_range(),
            control_step_s: config.env.control_step_s,
            update: update.stats(),
            lag,
            reward_terms: self.reward_terms.of(fragments),
            epochs: update.epochs,
            durations: *durations,
            evaluation: evaluation.as_ref().map(|result| (&result.report, result.env_steps)),
            history: &self.history,
            stats,
            efficiency: self.efficiency,
            parts: self.parts,
            alive,
            quarantined: validator.quarantined(Instant::now()).len(),
            turned_away: validator.turned_away,
            accepted_bytes: validator.accepted_bytes,
        };
        let scalars = record.scalars();
        let updates = state.counters.updates;
        let set = histograms::set_of(updates);
        let histograms = (set != self.histogram_set).then(|| histograms::of(fragments, &self.action_names));
        self.histogram_set = set;
        let (history, retry) = (self.history.clone(), self.retry.clone());
        self.background.submit(move |report| {
            if let Some(histograms) = histograms {
                report.log_histograms(env_steps, &histograms, &retry)?;
            }
            Ok(report.log(env_steps, updates, &scalars, &history, &retry)?)
        });
        self.background.check()
    }
}
