//! Newest value of every metric in Prometheus's text format.
//!
//! A tag `group/name` becomes the gauge `treadmill_group_name` with the run as a label. Its help text has the meaning and
//! the unit in the tag's row of [`METRICS`].

use std::{
    collections::{BTreeMap, HashMap},
    fmt,
    sync::{Arc, Mutex, MutexGuard},
};

use prometheus_client::{
    collector::Collector,
    encoding::{DescriptorEncoder, EncodeMetric, text},
    metrics::{MetricType, gauge::ConstGauge},
    registry::Registry,
};
use treadmill_proto::{ActorStats, PolicyVersion};

use super::catalogue::{METRICS, MetricRow, MetricSource};

/// HTTP content type of the page.
pub const CONTENT_TYPE: &str = "application/openmetrics-text; version=1.0.0; charset=utf-8";

/// Most actors with separate gauges, so that a page stays small. Sums include all actors.
const ACTORS_SHOWN_MAX: usize = 1024;

/// Computes the value of an actor's gauge.
type OfActor = fn(&ActorStats, PolicyVersion) -> Option<f64>;

/// Returns the gauges that each actor has.
fn actor_gauges() -> impl Iterator<Item = (&'static str, OfActor)> {
    METRICS.iter().filter_map(|row| if let MetricSource::Actor(of) = row.source { Some((row.tag, of)) } else { None })
}

/// Newest values, shared between the training thread and the metrics page.
#[derive(Clone, Debug, Default)]
pub struct PrometheusMetrics {
    newest: Arc<Mutex<Newest>>,
}

#[derive(Debug, Default)]
struct Newest {
    scalars: BTreeMap<String, f64>,
    /// Values of [`actor_gauges`], in their order.
    actors: BTreeMap<String, Vec<Option<f64>>>,
}

impl PrometheusMetrics {
    /// Sets scalars; others keep their value.
    pub fn set<'a>(&self, scalars: impl IntoIterator<Item = (&'a str, f64)>) {
        let mut newest = self.lock();
        for (tag, value) in scalars {
            match newest.scalars.get_mut(tag) {
                Some(known) => *known = value,
                None => drop(newest.scalars.insert(tag.to_string(), value)),
            }
        }
    }

    /// Replaces the actors' statistics; `version` is the learner's newest.
    pub fn set_actors(&self, stats: &HashMap<String, ActorStats>, version: PolicyVersion) {
        let mut names: Vec<&String> = stats.keys().collect();
        names.sort_unstable();
        names.truncate(ACTORS_SHOWN_MAX);
        let row = |stats: &ActorStats| actor_gauges().map(|(_, of)| of(stats, version)).collect();
        self.lock().actors = names.into_iter().map(|name| (name.clone(), row(&stats[name]))).collect();
    }

    /// Returns the page with all values and with `live`, the caller's current values.
    pub fn page(&self, run: &str, live: &[(&str, f64)]) -> String {
        self.set(live.iter().copied());
        let mut registry = Registry::with_labels([("run".into(), run.to_string().into())].into_iter());
        registry.register_collector(Box::new(self.clone()));
        let mut page = String::new();
        text::encode(&mut page, &registry).expect("writing to a string does not fail");
        page
    }

    fn lock(&self) -> MutexGuard<'_, Newest> {
        self.newest.lock().expect("no holder of this lock panics")
    }
}

impl Collector for PrometheusMetrics {
    fn encode(&self, mut encoder: DescriptorEncoder<'_>) -> Result<(), fmt::Error> {
        let newest = self.lock();
        for (tag, value) in &newest.scalars {
            let name = gauge(tag);
            let descriptor = encoder.encode_descriptor(&name, &help(tag), None, MetricType::Gauge)?;
            ConstGauge::new(*value).encode(descriptor)?;
        }
        for (index, (tag, _)) in actor_gauges().enumerate() {
            let name = gauge(tag);
            let mut descriptor = encoder.encode_descriptor(&name, &help(tag), None, MetricType::Gauge)?;
            for (actor, values) in &newest.actors {
                if let Some(value) = values[index] {
                    let labels = [("actor", actor.as_str())];
                    ConstGauge::new(value).encode(descriptor.encode_family(&labels)?)?;
                }
            }
        }
        Ok(())
    }
}

/// Returns the name of a tag's gauge.
pub fn gauge(tag: &str) -> String {
    format!("treadmill_{}", tag.replace('/', "_"))
}

/// Returns the help text of a tag's gauge: meaning and unit, as plain text.
fn help(tag: &str) -> String {
    let Some(MetricRow { help, unit, .. }) = MetricRow::of(tag) else { return "A metric of Treadmill".to_string() };
    format!("{help} Unit: {unit}.").replace(['`', '"', '\\'], "")
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEWEST: PolicyVersion = PolicyVersion::new(7, 12);

    fn stats(number: u64, incarnation: u64) -> ActorStats {
        let version = Some(PolicyVersion::new(incarnation, number));
        ActorStats { version, env_steps_per_s: 1500.5, envs: 8, ..Default::default() }
    }

    #[test]
    fn a_page_has_every_scalar_with_help_type_and_run_label() {
        let prometheus = PrometheusMetrics::default();
        prometheus.set([("time/fps", 250.0), ("bus/fragments_accepted", 3.0)]);
        prometheus.set([("time/fps", 300.5)]);
        let page = prometheus.page("walk-1", &[("learner/silence_s", 0.25)]);
        assert!(page.contains("# TYPE treadmill_time_fps gauge\ntreadmill_time_fps{run=\"walk-1\"} 300.5\n"), "{page}");
        assert!(page.contains("treadmill_bus_fragments_accepted{run=\"walk-1\"} 3.0\n"), "{page}");
        assert!(page.contains("treadmill_learner_silence_s{run=\"walk-1\"} 0.25\n"), "{page}");
        assert!(page.contains("# HELP treadmill_time_fps Environment steps learnt from per second"), "{page}");
        assert!(page.ends_with("# EOF\n"), "{page}");
    }

    #[test]
    fn actors_have_gauges_while_they_are_alive() {
        let prometheus = PrometheusMetrics::default();
        let both = [("a".to_string(), stats(10, 7)), ("b".to_string(), stats(10, 6))];
        prometheus.set_actors(&both.into(), NEWEST);
        let page = prometheus.page("r", &[]);
        assert!(page.contains("treadmill_actor_policy_lag{run=\"r\",actor=\"a\"} 2.0\n"), "{page}");
        assert!(!page.contains("treadmill_actor_policy_lag{run=\"r\",actor=\"b\"}"), "of another learner: {page}");
        assert!(page.contains("treadmill_actor_env_steps_per_s{run=\"r\",actor=\"b\"} 1500.5\n"), "{page}");
        prometheus.set_actors(&[("b".to_string(), stats(12, 7))].into(), NEWEST);
        let page = prometheus.page("r", &[]);
        assert!(!page.contains("actor=\"a\""), "gone: {page}");
        assert!(page.contains("treadmill_actor_policy_lag{run=\"r\",actor=\"b\"} 0.0\n"), "{page}");
    }

    #[test]
    fn a_page_has_a_limited_number_of_actors() {
        let prometheus = PrometheusMetrics::default();
        let many = (0..3 * ACTORS_SHOWN_MAX).map(|n| (format!("actor-{n:05}"), stats(12, 7))).collect();
        prometheus.set_actors(&many, NEWEST);
        let page = prometheus.page("r", &[]);
        assert_eq!(page.matches("treadmill_actor_envs{").count(), ACTORS_SHOWN_MAX);
    }

    #[test]
    fn help_texts_come_from_the_table() {
        assert_eq!(help("no_such/tag"), "A metric of Treadmill");
        assert!(help("train/clip_fraction").ends_with(" ppo.clip_range. Unit: share."));
        assert_eq!(help("rewards/any"), help("rewards/other"));
        assert_eq!(help("actor/envs"), "Its environments. Unit: count.");
    }
}
