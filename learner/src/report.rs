//! One scalar, every place it goes to: screen, TensorBoard, `metrics.jsonl`, the bus, Prometheus.

use std::collections::HashMap;

use treadmill_common::{
    bus::{Bus, keys, publish_dropping},
    config::Config,
    machine,
    run_folder::RunFolder,
    shutdown::Shutdown,
};
use treadmill_proto::json::Metric;

use crate::{
    checkpoint::TrainingState,
    logging::{Console, EventWriter, Exposition, JsonLines, draw_curve},
    room::wait_for_room,
    training::{TrainingError, TrainingOptions},
};

/// Sends a JSON object under one tag.
type Publish = Box<dyn Fn(Vec<u8>) + Send>;

/// Where scalars go.
pub struct Report {
    run: String,
    bus: Bus,
    folder: RunFolder,
    console: Console,
    lines: JsonLines,
    events: EventWriter,
    exposition: Exposition,
    publishers: HashMap<String, Publish>,
    table_every_updates: u64,
}

impl Report {
    /// Opens the logs; on a resumed run, what they hold beyond the checkpoint is taken out.
    pub fn open(
        bus: &Bus,
        state: &TrainingState,
        config: &Config,
        options: &TrainingOptions,
    ) -> Result<Self, TrainingError> {
        let folder = options.folder.clone();
        let (now, env_steps) = (machine::time_unix_s(), state.counters.env_steps);
        if folder.metrics().exists() {
            JsonLines::truncate_after(&folder.metrics(), env_steps)?;
        }
        let lines = JsonLines::append(&folder.metrics())?;
        let mut events = EventWriter::create(folder.root(), now, &machine::host_name())?;
        if env_steps > 0 {
            events.resume(env_steps + 1, now)?;
        }
        events.text("config", &format!("```toml\n{}\n```", state.config_toml))?;
        Ok(Self {
            run: state.run.clone(),
            bus: bus.clone(),
            console: Console::new(config.run.steps, env_steps, options.show_progress),
            folder,
            lines,
            events,
            exposition: options.exposition.clone(),
            publishers: HashMap::new(),
            table_every_updates: config.learner.table_every_updates.into(),
        })
    }

    /// Prints the table at other intervals from now on.
    pub fn set_table_every(&mut self, updates: u64) {
        self.table_every_updates = updates;
    }

    /// The run ends after another number of steps than it began with.
    pub fn set_steps(&mut self, steps: u64) {
        self.console.set_steps(steps);
    }

    /// Logs the scalars of one update; where the disk is full, once it is not.
    pub fn log(
        &mut self,
        env_steps: u64,
        updates: u64,
        scalars: &[(String, f64)],
        shutdown: &Shutdown,
    ) -> std::io::Result<()> {
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
        wait_for_room(shutdown, || self.lines.write(&metrics))?;
        wait_for_room(shutdown, || self.events.scalars(env_steps, time_unix_s, scalars))?;
        self.exposition.take(metrics.iter().map(|metric| (metric.tag.as_str(), metric.value)));
        for metric in &metrics {
            self.publish(metric);
        }
        self.console.progress(env_steps);
        if updates.is_multiple_of(self.table_every_updates) {
            self.console.table(scalars);
        }
        Ok(())
    }

    /// One publisher for each tag, declared once: a declared key costs memory for as long as the session lives.
    fn publish(&mut self, metric: &Metric) {
        if !self.publishers.contains_key(&metric.tag) {
            match publish_dropping(&self.bus, keys::metric(&self.run, &metric.tag)) {
                Ok(publish) => drop(self.publishers.insert(metric.tag.clone(), Box::new(publish))),
                Err(why) => return tracing::warn!("{why}"),
            }
        }
        self.publishers[&metric.tag](metric.to_json());
    }

    /// Ends the bar and draws the learning curve.
    pub fn finish(&mut self) -> Result<(), TrainingError> {
        self.console.finish();
        Ok(draw_curve(&self.folder.metrics(), &self.folder.learning_curve())?)
    }
}
