//! Scalars of a run on `treadmill/{run}/metrics/{tag}`, where a tag is `group/name`.

use treadmill_proto::{ident::check_ident, json::Metric};

use super::{
    shared::publisher,
    subscription::{Feed, Message, observe},
};
use crate::{error::BusError, session::Bus};

/// Messages of one tag that may wait: some seconds of the fastest run.
const METRICS_WAITING: usize = 256;

/// Returns the key of a tag.
fn key(run: &str, tag: &str) -> String {
    format!("treadmill/{run}/metrics/{tag}")
}

/// Returns a function that publishes the values of one tag. The bus may drop them.
pub fn publish_metric(bus: &Bus, run: &str, tag: &str) -> Result<impl Fn(Vec<u8>) + Send + Sync + use<>, BusError> {
    publisher(bus, key(run, tag))
}

/// Subscription to a few metric tags.
pub struct MetricsFeed {
    feeds: Vec<Feed>,
}

impl MetricsFeed {
    /// Subscribes to `tags` of `run`, or of every run.
    pub fn open(bus: &Bus, run: Option<&str>, tags: &[&str]) -> Result<Self, BusError> {
        let subscribe = |tag: &&str| observe(bus, &key(run.unwrap_or("*"), tag), METRICS_WAITING);
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
    let is_named = check_ident("run", &metric.run).is_ok() && key(&metric.run, &metric.tag) == message.key;
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
