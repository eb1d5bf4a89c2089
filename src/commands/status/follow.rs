//! Polls the learners' statuses and receives their metrics for the dashboard.

use std::{
    fs::File,
    path::{Path, PathBuf},
    sync::mpsc::{SyncSender, TrySendError},
    time::{Duration, Instant},
};

use treadmill_bus::{
    Bus, BusOptions,
    observer::{MetricsFeed, newest_of_each_run, statuses},
};
use treadmill_learner::metrics::jsonl::for_each_metric;
use treadmill_proto::{RunStatus, json::Metric};
use treadmill_runtime::error_chain;

use super::{WATCH_EVERY, fleet::CURVES};
use crate::{
    diagnosis::Silence,
    shared::learner_address::{self, ReachArgs},
};

/// Interval of polling for metrics.
const LISTEN_EVERY: Duration = Duration::from_millis(200);
/// Most metrics forwarded per poll, so that a flood does not delay the next request for statuses.
const METRICS_AT_ONCE: usize = 4096;
/// Capacity of the queue to the dashboard. Further items are dropped; the next answer repeats them.
pub const NEWS_QUEUED_MAX: usize = 4096;

/// Message to the dashboard.
pub enum News {
    /// Statuses of runs.
    Answers(Vec<RunStatus>),
    /// No learner answered, with the reason as far as known.
    Silence(String),
    /// Metric of a run.
    Metric(Metric),
    /// Earlier metrics of a run on this machine, in the order of its log.
    Past(Vec<Metric>),
}

/// Client that supplies the dashboard.
pub struct Follower {
    reach: ReachArgs,
    options: BusOptions,
    bus: Bus,
    feed: MetricsFeed,
    news: SyncSender<News>,
    /// Metrics file of the run, until it was read.
    metrics_file: Option<PathBuf>,
}

/// The dashboard has closed the queue.
struct Closed;

impl Follower {
    /// Subscribes to metrics on a session that was opened with these options.
    pub fn new(reach: ReachArgs, options: BusOptions, bus: Bus, news: SyncSender<News>) -> anyhow::Result<Self> {
        let feed = MetricsFeed::open(&bus, reach.run.as_deref(), &CURVES)?;
        let metrics_file = reach.metrics_file();
        Ok(Self { reach, options, bus, feed, news, metrics_file })
    }

    /// Polls until the dashboard closes the queue.
    pub async fn run(mut self) {
        while self.poll_statuses().await.is_ok() {
            let until = Instant::now() + WATCH_EVERY;
            while Instant::now() < until {
                tokio::time::sleep(LISTEN_EVERY).await;
                if self.forward_metrics().is_err() {
                    return;
                }
            }
        }
    }

    async fn poll_statuses(&mut self) -> Result<(), Closed> {
        match statuses(&self.bus, self.reach.run.as_deref(), learner_address::ANSWER_TIMEOUT).await {
            Ok(replies) if !replies.is_empty() => {
                self.send(News::Answers(newest_of_each_run(replies)))?;
                self.load_past().await
            }
            Ok(_) => {
                let silence = Silence::of_run(&self.bus, &self.options, self.reach.run.as_deref()).await;
                self.send(News::Silence(silence.in_one_line()))?;
                self.redial().await
            }
            Err(why) => self.send(News::Silence(error_chain(&why))),
        }
    }

    /// Loads earlier metrics after the first answer, because only metrics of known runs are kept.
    async fn load_past(&mut self) -> Result<(), Closed> {
        let Some(file) = self.metrics_file.take() else { return Ok(()) };
        let past = tokio::task::spawn_blocking(move || read_past(&file)).await.unwrap_or_default();
        self.send(News::Past(past))
    }

    /// Dials the endpoint in the run's folder if it changed: a resumed learner may listen elsewhere. The bus itself redials
    /// an unchanged endpoint.
    async fn redial(&mut self) -> Result<(), Closed> {
        let connect = self.reach.endpoints().unwrap_or_default();
        if connect.is_empty() || connect == self.options.connect {
            return Ok(());
        }
        let options = BusOptions { connect, ..self.options.clone() };
        let moved: anyhow::Result<_> = async {
            let bus = learner_address::dial(&options, self.reach.run.as_deref()).await?;
            let feed = MetricsFeed::open(&bus, self.reach.run.as_deref(), &CURVES)?;
            Ok((bus, feed))
        }
        .await;
        match moved {
            Ok((bus, feed)) => {
                self.feed = feed;
                let old = std::mem::replace(&mut self.bus, bus);
                // Closing may take seconds if the peer is gone.
                tokio::task::spawn_blocking(move || old.close());
            }
            Err(why) => {
                let silence = why.downcast_ref().map(Silence::in_one_line);
                self.send(News::Silence(silence.unwrap_or_else(|| error_chain(why.as_ref()))))?;
            }
        }
        // One attempt is enough: the bus itself redials a peer that answers late.
        self.options = options;
        Ok(())
    }

    fn forward_metrics(&self) -> Result<(), Closed> {
        for _ in 0..METRICS_AT_ONCE {
            let Some(metric) = self.feed.try_next() else { break };
            self.send(News::Metric(metric))?;
        }
        Ok(())
    }

    fn send(&self, news: News) -> Result<(), Closed> {
        match self.news.try_send(news) {
            Ok(()) | Err(TrySendError::Full(_)) => Ok(()),
            Err(TrySendError::Disconnected(_)) => Err(Closed),
        }
    }
}

/// Reads the metrics of curves that a run on this machine logged before; an unreadable log has none.
fn read_past(log: &Path) -> Vec<Metric> {
    let mut metrics = Vec::new();
    let keep = |metric: Metric, _: &[u8]| {
        if CURVES.contains(&&metric.tag[..]) {
            metrics.push(metric);
        }
        Ok(())
    };
    let _ = File::open(log).and_then(|file| for_each_metric(file, keep));
    metrics
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn past_curves_are_read_and_malformed_lines_skipped() {
        let folder = tempfile::tempdir().unwrap();
        let log = folder.path().join("metrics.jsonl");
        let metric = |tag: &str, step| Metric { run: "r".into(), tag: tag.into(), step, value: 1.5, time_unix_s: 2.0 };
        let metrics = [metric("rollout/ep_rew_mean", 8), metric("train/std", 9), metric("time/fps", 16)];
        let lines = metrics.each_ref().map(|metric| [b"\xff\n{}\n", &metric.to_json()[..], b"\n{\"run"].concat());
        std::fs::write(&log, lines.join(&b'\n')).unwrap();
        assert_eq!(read_past(&log), [metrics[0].clone(), metrics[2].clone()]);
        assert_eq!(read_past(&folder.path().join("none")), []);
    }
}
