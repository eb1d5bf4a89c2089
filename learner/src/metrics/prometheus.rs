//! Newest value of every metric in Prometheus's text format.
//!
//! A tag `group/name` becomes the gauge `treadmill_group_name` with the run as a label. Its help text comes from the
//! tag's row in `docs/reference/metrics.md`.

use std::{
    collections::{BTreeMap, HashMap},
    fmt,
    sync::{Arc, LazyLock, Mutex, MutexGuard},
};

use prometheus_client::{
    collector::Collector,
    encoding::{DescriptorEncoder, EncodeMetric, text},
    metrics::{MetricType, gauge::ConstGauge},
    registry::Registry,
};
use treadmill_proto::{ActorStats, PolicyVersion};

/// HTTP content type of the page.
pub const CONTENT_TYPE: &str = "application/openmetrics-text; version=1.0.0; charset=utf-8";

/// Most actors with separate gauges, so that a page stays small. Sums include all actors.
const ACTORS_SHOWN_MAX: usize = 1024;

/// Gauge of each actor: name and value.
type ActorGauge = (&'static str, fn(&ActorStats, PolicyVersion) -> Option<f64>);

const ACTOR_GAUGES: [ActorGauge; 6] = [
    ("actor_env_steps_per_s", |stats, _| Some(stats.env_steps_per_s)),
    ("actor_envs", |stats, _| Some(stats.envs.into())),
    ("actor_policy_version", |stats, _| stats.version.as_ref().map(|version| version.number as f64)),
    // Absent if its policy is of another learner.
    ("actor_policy_lag", |stats, newest| {
        let version = stats.version.as_ref().filter(|version| version.incarnation == newest.incarnation)?;
        Some(newest.number.saturating_sub(version.number) as f64)
    }),
    ("actor_fragments_resent", |stats, _| Some(stats.resent as f64)),
    ("actor_memory_mb", |stats, _| Some(stats.resident_bytes as f64 / 1e6)),
];

/// Newest values, shared between the training thread and the metrics page.
#[derive(Clone, Debug, Default)]
pub struct PrometheusMetrics {
    newest: Arc<Mutex<Newest>>,
}

#[derive(Debug, Default)]
struct Newest {
    scalars: BTreeMap<String, f64>,
    actors: BTreeMap<String, Vec<(usize, f64)>>,
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
        let row = |stats: &ActorStats| {
            let values = ACTOR_GAUGES.iter().map(|(_, of)| of(stats, version)).enumerate();
            values.filter_map(|(index, value)| Some((index, value?))).collect()
        };
        self.lock().actors = names.into_iter().map(|name| (name.clone(), row(&stats[name]))).collect();
    }

    /// Returns the page with all values and with `live`, the caller's current values.
    pub fn page(&self, run: &str, live: &[(&str, f64)]) -> String {
        self.set(live.iter().copied());
        let mut registry =
            Registry::with_prefix_and_labels("treadmill", [("run".into(), run.to_string().into())].into_iter());
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
            let descriptor = encoder.encode_descriptor(&name, help(&name), None, MetricType::Gauge)?;
            ConstGauge::new(*value).encode(descriptor)?;
        }
        for (index, (name, _)) in ACTOR_GAUGES.iter().enumerate() {
            let mut descriptor = encoder.encode_descriptor(name, help(name), None, MetricType::Gauge)?;
            for (actor, values) in &newest.actors {
                if let Some((_, value)) = values.iter().find(|(of, _)| *of == index) {
                    let labels = [("actor", actor.as_str())];
                    ConstGauge::new(*value).encode(descriptor.encode_family(&labels)?)?;
                }
            }
        }
        Ok(())
    }
}

/// Returns the gauge's name for a tag, without the prefix.
fn gauge(tag: &str) -> String {
    tag.replace('/', "_")
}

/// Returns the help text of a gauge from the page of metrics.
fn help(gauge: &str) -> &'static str {
    static HELP: LazyLock<HashMap<String, String>> =
        LazyLock::new(|| include_str!("../../../docs/reference/metrics.md").lines().filter_map(row).collect());
    let other = if gauge.starts_with("rewards_") {
        "Mean of weight times this term of the reward over the batch"
    } else {
        "A metric of Treadmill"
    };
    HELP.get(gauge).map_or(other, String::as_str)
}

/// Parses a row of the page's tables: name of the gauge and help text.
fn row(line: &str) -> Option<(String, String)> {
    let (name, rest) = line.strip_prefix("| `")?.split_once("` | ")?;
    let (unit, meaning) = rest.strip_suffix(" |")?.split_once(" | ")?;
    // The typical value is in the last column.
    let meaning = meaning.split(" | ").next().unwrap_or(meaning);
    let name =
        name.strip_prefix("treadmill_").map(str::to_string).or_else(|| name.contains('/').then(|| gauge(name)))?;
    Some((name, format!("{meaning} Unit: {unit}.").replace(['`', '"', '\\'], "")))
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEWEST: PolicyVersion = PolicyVersion::new(7, 12);

    fn stats(number: u64, incarnation: u64) -> ActorStats {
        let version = Some(PolicyVersion::new(incarnation, number).into());
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
    fn help_texts_come_from_the_page_of_metrics() {
        assert_eq!(help("no_such_gauge"), "A metric of Treadmill");
        let text = help("learner_memory_mb");
        assert!(text.contains("Resident memory of the learner process. Unit: MB"), "{text}");
        assert!(help("actor_envs").contains("Unit: count"));
        assert_eq!(row("| `run`, `actor` | – | Which run, and which of its actors. |"), None);
        assert_eq!(row("| `a/b` | s | Says `x`. |"), Some(("a_b".to_string(), "Says x. Unit: s.".to_string())));
        assert_eq!(row("| `treadmill_c` | s | C. |"), Some(("c".to_string(), "C. Unit: s.".to_string())));
    }
}
