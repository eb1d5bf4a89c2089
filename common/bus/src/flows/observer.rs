//! Subscriptions of observers: to any key, and to metrics.

use std::time::Duration;

use treadmill_proto::{ident::check_ident, json::Metric};
use zenoh::{
    Wait,
    handlers::{RingChannel, RingChannelHandler},
    pubsub::Subscriber,
    sample::Sample,
};

use crate::{Bus, BusError, keys};

/// Messages of one tag that may wait: some seconds of the fastest run.
const METRICS_WAITING: usize = 256;

/// Subscription to a key expression. If too many messages wait, the oldest are dropped.
pub struct Feed {
    ring: Subscriber<RingChannelHandler<Sample>>,
}

/// Received message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// Key on which it was published.
    pub key: String,
    /// Payload.
    pub payload: Vec<u8>,
}

impl Feed {
    /// Returns the next message that has arrived.
    pub fn try_next(&self) -> Option<Message> {
        self.ring.try_recv().ok().flatten().map(Message::from)
    }

    /// Returns the next message, or `None` if none comes within `timeout`.
    pub fn next(&self, timeout: Duration) -> Option<Message> {
        self.ring.recv_timeout(timeout).ok().flatten().map(Message::from)
    }
}

impl From<Sample> for Message {
    fn from(sample: Sample) -> Self {
        Self { key: sample.key_expr().to_string(), payload: sample.payload().to_bytes().into_owned() }
    }
}

/// Subscribes to `key`; at most `capacity` messages wait.
pub fn observe(bus: &Bus, key: &str, capacity: usize) -> Result<Feed, BusError> {
    let ring = bus
        .session
        .declare_subscriber(key.to_string())
        .with(RingChannel::new(capacity))
        .wait()
        .map_err(BusError::flow(format!("listening to {key}")))?;
    Ok(Feed { ring })
}

/// Subscription to a few metric tags.
pub struct MetricsFeed {
    feeds: Vec<Feed>,
}

impl MetricsFeed {
    /// Subscribes to `tags` of `run`, or of every run.
    pub fn open(bus: &Bus, run: Option<&str>, tags: &[&str]) -> Result<Self, BusError> {
        let subscribe = |tag: &&str| observe(bus, &keys::metric(run.unwrap_or("*"), tag), METRICS_WAITING);
        Ok(Self { feeds: tags.iter().map(subscribe).collect::<Result<_, _>>()? })
    }

    /// Returns the next metric that has arrived; skips invalid ones.
    pub fn try_next(&self) -> Option<Metric> {
        self.feeds.iter().find_map(|feed| std::iter::from_fn(|| feed.try_next()).find_map(|message| decode(&message)))
    }
}

/// Returns the metric in a message if it is finite and matches its key.
fn decode(message: &Message) -> Option<Metric> {
    let metric = Metric::from_json(&message.payload).ok()?;
    let is_named = check_ident("run", &metric.run).is_ok() && keys::metric(&metric.run, &metric.tag) == message.key;
    (is_named && metric.value.is_finite() && metric.time_unix_s.is_finite()).then_some(metric)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_metric_that_does_not_match_its_key_is_skipped() {
        let metric = Metric { run: "walk".into(), tag: "time/fps".into(), step: 8, value: 1.5, time_unix_s: 2.0 };
        let message = |key: &str, metric: &Metric| Message { key: key.to_string(), payload: metric.to_json() };
        assert_eq!(decode(&message("treadmill/walk/metrics/time/fps", &metric)), Some(metric.clone()));
        assert_eq!(decode(&message("treadmill/run/metrics/time/fps", &metric)), None, "another run's key");
        assert_eq!(decode(&message("treadmill/walk/metrics/time/wait", &metric)), None, "another tag's key");
        let named = Metric { run: "\u{1b}[2J".into(), ..metric.clone() };
        assert_eq!(decode(&message("treadmill/\u{1b}[2J/metrics/time/fps", &named)), None, "an invalid name of a run");
        let infinite = Metric { value: f64::INFINITY, ..metric };
        assert_eq!(decode(&message("treadmill/walk/metrics/time/fps", &infinite)), None, "not finite");
        let garbage = Message { key: "treadmill/walk/metrics/time/fps".into(), payload: vec![0xff; 8] };
        assert_eq!(decode(&garbage), None);
    }
}
