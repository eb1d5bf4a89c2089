//! Writes each scalar to every output: console, TensorBoard, `metrics.jsonl`, bus and Prometheus.

use std::{collections::HashMap, io, time::Duration};

use treadmill_bus::{Bus, learner::publish_metric};
use treadmill_config::{ChosenTask, Config};
use treadmill_proto::json::Metric;
use treadmill_runtime::{error_chain, machine, run_folder::RunFolder};

use super::{
    Console, ConsoleOptions, CurveError, CurveFacts, CurveThread, EventWriter, FilmOfPolicy, FilmSlot, Histogram,
    History, JsonLines, PrometheusMetrics, tensorboard::texts,
};
use crate::{checkpoint::TrainingState, waiting::Retry};

/// Publishes a JSON object under one tag.
type Publish = Box<dyn Fn(Vec<u8>) + Send>;

/// Options of [`MetricsReport`].
#[derive(Clone, Debug, Default)]
pub struct ReportOptions {
    /// What the console shows.
    pub console: ConsoleOptions,
    /// Newest values for Prometheus.
    pub prometheus: PrometheusMetrics,
    /// Command line of this process, for TensorBoard.
    pub command: String,
    /// Names and values of versions and machine, for TensorBoard.
    pub versions: Vec<(String, String)>,
    /// Films for TensorBoard.
    pub films: FilmSlot,
}

/// All outputs of scalars and histograms.
pub struct MetricsReport {
    run: String,
    bus: Bus,
    curve: CurveThread,
    console: Console,
    lines: JsonLines,
    events: EventWriter,
    prometheus: PrometheusMetrics,
    publishers: HashMap<String, Publish>,
    table_every_updates: u64,
    films: FilmSlot,
}

impl MetricsReport {
    /// Opens the logs in the run's folder. For a resumed run, removes lines that are newer than the checkpoint.
    ///
    /// # Errors
    /// If a log cannot be written.
    pub fn open(
        bus: &Bus,
        folder: &RunFolder,
        state: &TrainingState,
        config: &Config,
        options: &ReportOptions,
    ) -> io::Result<Self> {
        let (now, env_steps) = (machine::time_unix_s(), state.counters.env_steps);
        if folder.metrics().exists() {
            JsonLines::truncate_after(&folder.metrics(), env_steps)?;
        }
        let lines = JsonLines::append(&folder.metrics())?;
        let mut events = EventWriter::create(folder.root(), now, &machine::host_name())?;
        let first_step = if env_steps > 0 { env_steps + 1 } else { 0 };
        events.begin_session(first_step, now)?;
        events.hyperparameters(config, now)?;
        events.layout(env_steps, now, config.env.chosen_task() == ChosenTask::Velocity)?;
        // Texts that apply from this step on; TensorBoard also shows the earlier ones.
        for (tag, text) in [
            ("config", texts::configuration(config)),
            ("command", texts::command(&options.command)),
            ("versions", texts::facts(&options.versions)),
            ("description", texts::description(&config.run)),
        ] {
            if !text.is_empty() {
                events.text(env_steps, now, tag, &text)?;
            }
        }
        Ok(Self {
            curve: CurveThread::new(folder.metrics(), CurveFacts::of(config), folder.learning_curve()),
            run: state.run.clone(),
            bus: bus.clone(),
            console: Console::new(config.run.steps, env_steps, options.console.clone()),
            lines,
            events,
            prometheus: options.prometheus.clone(),
            publishers: HashMap::new(),
            table_every_updates: config.learner.table_every_updates.into(),
            films: options.films.clone(),
        })
    }

    /// Applies a changed configuration: the interval of the table, and the run's number of steps.
    pub fn set_config(&mut self, config: &Config) {
        self.table_every_updates = config.learner.table_every_updates.into();
        self.console.set_steps(config.run.steps);
    }

    /// Logs the scalars of one update; waits while the disk is full.
    pub fn log(
        &mut self,
        env_steps: u64,
        updates: u64,
        scalars: &[(String, f64)],
        history: &History,
        retry: &Retry,
    ) -> io::Result<()> {
        let time_unix_s = machine::time_unix_s();
        let metrics: Vec<Metric> = scalars
            .iter()
            .filter(|(_, value)| value.is_finite())
            .map(|(tag, value)| Metric {
                run: self.run.clone(),
                tag: tag.clone(),
                step: env_steps,
                value: *value,
                time_unix_s,
            })
            .collect();
        retry.until_written(|| self.lines.write(&metrics))?;
        retry.until_written(|| self.events.scalars(env_steps, time_unix_s, scalars))?;
        if let Some(FilmOfPolicy { env_steps, size, gif }) = self.films.take() {
            // A film is no reason to wait for a disk.
            if let Err(why) = self.events.picture(env_steps, time_unix_s, "film", size, gif) {
                tracing::warn!(error = %why, "a film of the robot was not written for TensorBoard");
            }
        }
        self.prometheus.set(metrics.iter().map(|metric| (metric.tag.as_str(), metric.value)));
        for metric in &metrics {
            self.publish(metric);
        }
        self.console.progress(env_steps, scalars, history);
        self.curve.poll();
        if updates.is_multiple_of(self.table_every_updates) {
            self.console.table(scalars);
        }
        Ok(())
    }

    /// Logs histograms to TensorBoard; waits while the disk is full.
    pub fn log_histograms(
        &mut self,
        env_steps: u64,
        histograms: &[(String, Histogram)],
        retry: &Retry,
    ) -> io::Result<()> {
        let time_unix_s = machine::time_unix_s();
        retry.until_written(|| self.events.histograms(env_steps, time_unix_s, histograms))
    }

    /// Reports a long wait for experience on the console; `actors` are alive.
    pub fn show_wait(&mut self, waited: Duration, actors: usize) {
        self.console.show_wait(waited, actors);
    }

    /// Publishes a metric. Each tag's publisher is declared once, because a key takes memory until the session ends.
    fn publish(&mut self, metric: &Metric) {
        if !self.publishers.contains_key(&metric.tag) {
            match publish_metric(&self.bus, &self.run, &metric.tag) {
                Ok(publish) => drop(self.publishers.insert(metric.tag.clone(), Box::new(publish))),
                Err(why) => {
                    return tracing::warn!(tag = %metric.tag, error = %error_chain(&why), "metric not published");
                }
            }
        }
        self.publishers[&metric.tag](metric.to_json());
    }

    /// Writes how the run ended: `stopped` is whether it was stopped before its last step, or `None` if it failed.
    /// Nothing is written for a stopped run, because it may be resumed.
    pub fn end(&self, stopped: Option<bool>) {
        if stopped == Some(true) {
            return;
        }
        if let Err(why) = self.events.end(stopped.is_some(), machine::time_unix_s()) {
            tracing::warn!(error = %why, "the end of the run was not written for TensorBoard");
        }
    }

    /// Finishes the console output and draws the learning curve.
    ///
    /// # Errors
    /// If the curve cannot be drawn.
    pub fn finish(&mut self, history: &History) -> Result<(), CurveError> {
        self.console.finish(history);
        self.curve.finish()
    }
}
