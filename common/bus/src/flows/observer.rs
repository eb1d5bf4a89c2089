//! What observers do on the bus: listen to any key, and to metrics.

use std::time::Duration;

use treadmill_proto::{ident::check_ident, json::Metric};
use zenoh::{
    Wait,
    handlers::{RingChannel, RingChannelHandler},
    pubsub::Subscriber,
    sample::Sample,
};

use crate::{Bus, BusError, keys};

/// Messages of one tag that wait until somebody looks: some seconds of the quickest run.
const METRICS_WAITING: usize = 256;

/// Messages of one key or of all that match a key expression; older ones give way to newer.
pub struct Feed {
    ring: Subscriber<RingChannelHandler<Sample>>,
}

/// One message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// Where it was published.
    pub key: String,
    /// What it says.
    pub payload: Vec<u8>,
}

impl Feed {
    /// The next message that is there already.
    pub fn try_next(&self) -> Option<Message> {
        self.ring.try_recv().ok().flatten().map(Message::from)
    }

    /// The next message, if one comes within `patience`.
    pub fn next(&self, patience: Duration) -> Option<Message> {
        self.ring.recv_timeout(patience).ok().flatten().map(Message::from)
    }
}

impl From<Sample> for Message {
    fn from(sample: Sample) -> Self {
        Self { key: sample.key_expr().to_string(), payload: sample.payload().to_bytes().into_owned() }
    }
}

/// Begins to listen; at most `capacity` messages wait.
pub fn observe(bus: &Bus, key: &str, capacity: usize) -> Result<Feed, BusError> {
    let ring = bus
        .session
        .declare_subscriber(key.to_string())
        .with(RingChannel::new(capacity))
        .wait()
        .map_err(BusError::flow(format!("listening to {key}")))?;
    Ok(Feed { ring })
}

/// Metrics of one run or of all, under a few tags.
pub struct MetricsFeed {
    feeds: Vec<Feed>,
}

impl MetricsFeed {
    /// Begins to listen; `None` listens to every run.
    pub fn open(bus: &Bus, run: Option<&str>, tags: &[&str]) -> Result<Self, BusError> {
        let listen = |tag: &&str| observe(bus, &keys::metric(run.unwrap_or("*"), tag), METRICS_WAITING);
        Ok(Self { feeds: tags.iter().map(listen).collect::<Result<_, _>>()? })
    }

    /// The next metric that is there already; what is unsound is passed over.
    pub fn try_next(&self) -> Option<Metric> {
        self.feeds.iter().find_map(|feed| std::iter::from_fn(|| feed.try_next()).find_map(|message| sound(&message)))
    }
}

/// A metric that a learner may have sent: one that says of itself what its key says.
fn sound(message: &Message) -> Option<Metric> {
    let metric = Metric::from_json(&message.payload).ok()?;
    let is_named = check_ident("run", &metric.run).is_ok() && keys::metric(&metric.run, &metric.tag) == message.key;
    (is_named && metric.value.is_finite() && metric.time_unix_s.is_finite()).then_some(metric)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_metric_that_is_not_what_its_key_says_is_passed_over() {
        let metric = Metric { run: "walk".into(), tag: "time/fps".into(), step: 8, value: 1.5, time_unix_s: 2.0 };
        let message = |key: &str, metric: &Metric| Message { key: key.to_string(), payload: metric.to_json() };
        assert_eq!(sound(&message("treadmill/walk/metrics/time/fps", &metric)), Some(metric.clone()));
        assert_eq!(sound(&message("treadmill/run/metrics/time/fps", &metric)), None, "another run's key");
        assert_eq!(sound(&message("treadmill/walk/metrics/time/wait", &metric)), None, "another tag's key");
        let named = Metric { run: "\u{1b}[2J".into(), ..metric.clone() };
        assert_eq!(sound(&message("treadmill/\u{1b}[2J/metrics/time/fps", &named)), None, "no name of a run");
        let endless = Metric { value: f64::INFINITY, ..metric };
        assert_eq!(sound(&message("treadmill/walk/metrics/time/fps", &endless)), None, "no number");
        let nothing = Message { key: "treadmill/walk/metrics/time/fps".into(), payload: vec![0xff; 8] };
        assert_eq!(sound(&nothing), None);
    }
}
