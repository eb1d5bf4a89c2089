//! Asks the learners how it goes and listens to their metrics, for as long as the dashboard is there.

use std::{
    path::PathBuf,
    sync::mpsc::{SyncSender, TrySendError},
    time::{Duration, Instant},
};

use treadmill_bus::{Bus, BusOptions, MetricsFeed, statuses};
use treadmill_proto::{RunStatus, json::Metric};

use super::{WATCH_EVERY, fleet, past};
use crate::shared::learner_address::{self, ReachArgs};

/// How often it is looked for metrics.
const LISTEN_EVERY: Duration = Duration::from_millis(200);
/// Metrics that are handed over in one look: a flood must not keep us from asking.
const METRICS_AT_ONCE: usize = 4096;
/// News that may wait for the dashboard; what finds no room is left out, and the next answer says it anew.
pub const NEWS_WAITING: usize = 4096;

/// What there is to tell the dashboard.
pub enum News {
    /// How the runs go.
    Answers(Vec<RunStatus>),
    /// Nobody answered, and what is known of why.
    Silence(String),
    /// A metric of some run.
    Metric(Metric),
    /// What a run of this machine has logged before, in this order.
    Past(Vec<Metric>),
}

/// Where the dashboard's answers come from.
pub struct Follower {
    reach: ReachArgs,
    options: BusOptions,
    bus: Bus,
    feed: MetricsFeed,
    news: SyncSender<News>,
    /// The run's log, until it was read.
    log: Option<PathBuf>,
}

/// The dashboard does not listen any more.
struct Left;

impl Follower {
    /// Begins to listen on a session that was opened with these options.
    pub fn new(reach: ReachArgs, options: BusOptions, bus: Bus, news: SyncSender<News>) -> anyhow::Result<Self> {
        let feed = MetricsFeed::open(&bus, reach.run.as_deref(), &fleet::tags())?;
        let log = reach.log();
        Ok(Self { reach, options, bus, feed, news, log })
    }

    /// Asks and listens until the dashboard is left.
    pub async fn run(mut self) {
        while self.ask().await.is_ok() {
            let until = Instant::now() + WATCH_EVERY;
            while Instant::now() < until {
                tokio::time::sleep(LISTEN_EVERY).await;
                if self.hand_over_metrics().is_err() {
                    return;
                }
            }
        }
    }

    async fn ask(&mut self) -> Result<(), Left> {
        match statuses(&self.bus, self.reach.run.as_deref(), learner_address::ANSWER_TIMEOUT).await {
            Ok(replies) if !replies.is_empty() => {
                let answers = replies.into_iter().filter_map(|reply| reply.status).collect();
                self.send(News::Answers(answers))?;
                self.load_past().await
            }
            Ok(_) => {
                self.send(News::Silence("no learner answers".to_string()))?;
                self.redial().await
            }
            Err(why) => self.send(News::Silence(why.to_string())),
        }
    }

    /// Once somebody has answered, what its log has is of use.
    async fn load_past(&mut self) -> Result<(), Left> {
        let Some(log) = self.log.take() else { return Ok(()) };
        let past = tokio::task::spawn_blocking(move || past::read(&log)).await.unwrap_or_default();
        self.send(News::Past(past))
    }

    /// A learner that was resumed may listen elsewhere, and its run's folder says where. On an endpoint that stays the same
    /// the bus dials again by itself.
    async fn redial(&mut self) -> Result<(), Left> {
        let connect = self.reach.endpoints().unwrap_or_default();
        if connect.is_empty() || connect == self.options.connect {
            return Ok(());
        }
        let options = BusOptions { connect, ..self.options.clone() };
        let moved = match learner_address::dial(options.clone()).await {
            Ok(bus) => MetricsFeed::open(&bus, self.reach.run.as_deref(), &fleet::tags())
                .map(|feed| (bus, feed))
                .map_err(anyhow::Error::from),
            Err(why) => Err(why),
        };
        match moved {
            Ok((bus, feed)) => {
                self.feed = feed;
                let left = std::mem::replace(&mut self.bus, bus);
                // Closing may take seconds where nobody is at the other end.
                tokio::task::spawn_blocking(move || left.close());
            }
            Err(why) => self.send(News::Silence(why.to_string()))?,
        }
        // Tried once: who answers late is dialled by the bus itself.
        self.options = options;
        Ok(())
    }

    fn hand_over_metrics(&self) -> Result<(), Left> {
        for _ in 0..METRICS_AT_ONCE {
            let Some(metric) = self.feed.try_next() else { break };
            self.send(News::Metric(metric))?;
        }
        Ok(())
    }

    fn send(&self, news: News) -> Result<(), Left> {
        match self.news.try_send(news) {
            Ok(()) | Err(TrySendError::Full(_)) => Ok(()),
            Err(TrySendError::Disconnected(_)) => Err(Left),
        }
    }
}
