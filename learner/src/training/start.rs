//! Prepares a trainer for its first batch.

use treadmill_bus::Bus;
use treadmill_config::ChosenTask;
use treadmill_runtime::shutdown::Shutdown;

use super::{Learning, Reporting, Serving, Trainer, TrainingError, TrainingOptions, storage::Storage};
use crate::{
    checkpoint::TrainingState,
    leadership::Leadership,
    metrics::{History, MetricsReport, RunFigures},
    waiting::{PendingWrites, Retry},
};

impl Trainer {
    /// Saves the state, then opens the logs and the flows on the bus.
    pub(super) fn start(
        bus: &Bus,
        mut state: TrainingState,
        leadership: Option<Leadership>,
        options: &TrainingOptions,
        shutdown: &Shutdown,
    ) -> Result<Self, TrainingError> {
        state.lineage.set_epoch(options.epoch);
        let mut config = state.config().map_err(|why| TrainingError::State { why })?;
        config.run.steps = options.steps;
        let grown = config.grown(state.counters.env_steps);
        let learning = Learning::new(&state, &grown, options)?;
        let (heartbeat, pending, shutdown) = (options.heartbeat.clone(), PendingWrites::default(), shutdown.clone());
        let overtaken = leadership.as_ref().map(Leadership::overtaken).unwrap_or_default();
        let retry =
            Retry { shutdown: shutdown.clone(), heartbeat: heartbeat.clone(), pending: pending.clone(), overtaken };
        // Save this version before any actor can get it, so that a learner that dies now resumes from it.
        let storage = Storage::open(&state, &config, leadership, &options.folder, retry.clone())?;
        let report = MetricsReport::open(bus, &options.folder, &state, &config, &options.report)?;
        // `MetricsReport::open` has removed lines newer than the checkpoint.
        let mut history = History::read(&options.folder.metrics())?;
        history.figures = match config.env.chosen_task() {
            ChosenTask::Velocity => RunFigures::Tracking,
            ChosenTask::Motion => RunFigures::Imitation,
            _ => RunFigures::Distance,
        };
        let (serving, stats) = Serving::open(bus, &state, &grown, options, storage, pending)?;
        let reporting = Reporting::new(report, history, stats, &state, options, retry)?;
        let (is_paused, is_stopped) = (false, false);
        Ok(Self { state, config, shutdown, heartbeat, is_paused, is_stopped, learning, serving, reporting })
    }
}
