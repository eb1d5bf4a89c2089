//! Newest value of every metric in Prometheus's text format.
//!
//! A tag `group/name` becomes the metric `treadmill_group_name` with the run as a label, in Prometheus's base units and with
//! its suffixes, see [`name`] and <https://prometheus.io/docs/practices/naming/>. The help text is that of the tag's row of
//! [`METRICS`].

use std::{
    collections::{BTreeMap, HashMap},
    fmt,
    sync::{Arc, Mutex, MutexGuard},
};

use prometheus_client::{
    collector::Collector,
    encoding::{DescriptorEncoder, EncodeLabelSet, EncodeMetric, text},
    metrics::{MetricType, counter::ConstCounter, gauge::ConstGauge},
    registry::Registry,
};
use treadmill_proto::{ActorStats, PolicyVersion};
use treadmill_runtime::program;

use super::catalogue::{METRICS, MetricRow, MetricSource};

/// A format of the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PageFormat {
    /// Prometheus's own, which every reader knows.
    Plain,
    /// OpenMetrics 1.0, for readers that ask for it.
    OpenMetrics,
}

impl PageFormat {
    /// Returns the format for the header `Accept` of a request.
    pub fn accepted_by(accept: &str) -> Self {
        if accept.contains("application/openmetrics-text") { Self::OpenMetrics } else { Self::Plain }
    }

    /// Returns the HTTP content type.
    pub fn content_type(self) -> &'static str {
        match self {
            Self::Plain => "text/plain; version=0.0.4; charset=utf-8",
            Self::OpenMetrics => "application/openmetrics-text; version=1.0.0; charset=utf-8",
        }
    }
}

/// Most actors with separate values, so that a page stays small. Sums include all actors.
const ACTORS_SHOWN_MAX: usize = 1024;

/// Computes the value of an actor's metric.
type OfActor = fn(&ActorStats, PolicyVersion) -> Option<f64>;

/// Returns the metrics that each actor has.
fn actor_metrics() -> impl Iterator<Item = (&'static str, OfActor)> {
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
    /// Values of [`actor_metrics`], in their order.
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

    /// Returns the newest value of a scalar.
    pub fn value(&self, tag: &str) -> Option<f64> {
        self.lock().scalars.get(tag).copied()
    }

    /// Replaces the actors' statistics; `version` is the learner's newest.
    pub fn set_actors(&self, stats: &HashMap<String, ActorStats>, version: PolicyVersion) {
        let mut names: Vec<&String> = stats.keys().collect();
        names.sort_unstable();
        names.truncate(ACTORS_SHOWN_MAX);
        let row = |stats: &ActorStats| actor_metrics().map(|(_, of)| of(stats, version)).collect();
        self.lock().actors = names.into_iter().map(|name| (name.clone(), row(&stats[name]))).collect();
    }

    /// Returns the page with all values and with `live`, the caller's current values.
    pub fn page(&self, run: &str, live: &[(&str, f64)], format: PageFormat) -> String {
        self.set(live.iter().copied());
        let mut registry = Registry::with_labels([("run".into(), run.to_string().into())].into_iter());
        registry.register_collector(Box::new(self.clone()));
        let mut page = String::new();
        text::encode(&mut page, &registry).expect("writing to a string does not fail");
        match format {
            PageFormat::OpenMetrics => page,
            PageFormat::Plain => plain(&page),
        }
    }

    fn lock(&self) -> MutexGuard<'_, Newest> {
        self.newest.lock().expect("no holder of this lock panics")
    }
}

impl Collector for PrometheusMetrics {
    fn encode(&self, mut encoder: DescriptorEncoder<'_>) -> Result<(), fmt::Error> {
        let newest = self.lock();
        for (tag, value) in &newest.scalars {
            let metric = Exported::of(tag);
            metric.encode(&mut encoder, std::iter::once(([("", ""); 0], *value)))?;
        }
        for (index, (tag, _)) in actor_metrics().enumerate() {
            let known =
                newest.actors.iter().filter_map(|(actor, values)| Some(([("actor", actor.as_str())], values[index]?)));
            Exported::of(tag).encode(&mut encoder, known)?;
        }
        let version = [("version", program::version())];
        Exported::of("build/info").encode(&mut encoder, std::iter::once((version, 1.0)))
    }
}

/// A tag as Prometheus knows it.
struct Exported {
    /// Name without `_total`, which the encoder adds.
    family: String,
    help: String,
    is_total: bool,
    /// Base units in a unit of the tag.
    scale: f64,
}

impl Exported {
    fn of(tag: &str) -> Self {
        let row = MetricRow::of(tag);
        let unit = row.map_or("", |row| row.unit);
        // Ends of a tag that name its unit, the base unit instead, and the scale.
        let (ends, base, scale): (&[&str], _, _) = match unit.trim_end_matches(" since start") {
            "s" => (&["_s"], "_seconds", 1.0),
            "MB" => (&["_mb"], "_bytes", 1e6),
            "m" => (&["_m"], "_meters", 1.0),
            "m/s" => (&["_mps"], "_meters_per_second", 1.0),
            "rad" => (&[], "_radians", 1.0),
            "rad/s" => (&[], "_radians_per_second", 1.0),
            "share" => (&["_share"], "_ratio", 1.0),
            "steps/s" => (&["env_steps_per_s", "fps"], "_steps_per_second", 1.0),
            "1/s" => (&["_per_s"], "_per_second", 1.0),
            _ => (&[], "", 1.0),
        };
        let (group, name) = tag.split_once('/').unwrap_or(("", tag));
        let name = ends.iter().find_map(|end| name.strip_suffix(end)).unwrap_or(name);
        let is_total = row.is_some_and(|row| row.is_total);
        let name =
            if is_total { name.trim_start_matches("total_").trim_start_matches(&format!("{group}_")) } else { name };
        let family = format!("treadmill_{group}_{name}").trim_end_matches('_').to_string() + base;
        let family = family.replace(|c: char| !c.is_ascii_alphanumeric(), "_");
        let help = row.map_or("A metric of Treadmill", |row| row.help).replace(['`', '"', '\\'], "");
        Self { family, help, is_total, scale }
    }

    /// Writes the values with their labels.
    fn encode<L: EncodeLabelSet>(
        &self,
        encoder: &mut DescriptorEncoder<'_>,
        values: impl Iterator<Item = (L, f64)>,
    ) -> Result<(), fmt::Error> {
        let kind = if self.is_total { MetricType::Counter } else { MetricType::Gauge };
        let mut descriptor = encoder.encode_descriptor(&self.family, &self.help, None, kind)?;
        for (labels, value) in values {
            let value = value * self.scale;
            let family = descriptor.encode_family(&labels)?;
            if self.is_total {
                ConstCounter::new(value).encode(family)?;
            } else {
                ConstGauge::new(value).encode(family)?;
            }
        }
        Ok(())
    }
}

/// Returns the name of a tag's metric: in base units, totals with `_total`.
pub fn name(tag: &str) -> String {
    let Exported { family, is_total, .. } = Exported::of(tag);
    if is_total { family + "_total" } else { family }
}

/// Returns a page of OpenMetrics in Prometheus's own format, where a counter's description also has the suffix.
fn plain(page: &str) -> String {
    let mut lines: Vec<String> = page.lines().filter(|line| *line != "# EOF").map(str::to_string).collect();
    for index in 1..lines.len() {
        let family = lines[index].strip_prefix("# TYPE ").and_then(|line| line.strip_suffix(" counter"));
        let Some(family) = family.map(str::to_string) else { continue };
        lines[index] = format!("# TYPE {family}_total counter");
        lines[index - 1] = lines[index - 1].replacen(&family, &format!("{family}_total"), 1);
    }
    lines.push(String::new());
    lines.join("\n")
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
        let page = |format| prometheus.page("walk-1", &[("learner/silence_s", 0.25)], format);
        let (plain, open) = (page(PageFormat::Plain), page(PageFormat::OpenMetrics));
        for page in [&plain, &open] {
            for part in [
                "# HELP treadmill_time_steps_per_second Environment steps learnt from per second",
                "# TYPE treadmill_time_steps_per_second gauge\ntreadmill_time_steps_per_second{run=\"walk-1\"} 300.5\n",
                "treadmill_bus_fragments_accepted_total{run=\"walk-1\"} 3.0\n",
                "treadmill_learner_silence_seconds{run=\"walk-1\"} 0.25\n",
                "treadmill_build_info{run=\"walk-1\",version=\"0.1.0",
            ] {
                assert!(page.contains(part), "`{part}` is missing in {page}");
            }
        }
        assert!(plain.contains("# HELP treadmill_bus_fragments_accepted_total Accepted"), "{plain}");
        assert!(plain.contains("# TYPE treadmill_bus_fragments_accepted_total counter\n"), "{plain}");
        assert!(plain.ends_with("} 1.0\n") && !plain.contains("# EOF"), "{plain}");
        assert!(open.contains("# TYPE treadmill_bus_fragments_accepted counter\n"), "{open}");
        assert!(open.ends_with("# EOF\n"), "{open}");
    }

    #[test]
    fn actors_have_gauges_while_they_are_alive() {
        let prometheus = PrometheusMetrics::default();
        let both = [("a".to_string(), stats(10, 7)), ("b".to_string(), stats(10, 6))];
        prometheus.set_actors(&both.into(), NEWEST);
        let page = prometheus.page("r", &[], PageFormat::Plain);
        assert!(page.contains("treadmill_actor_policy_lag{run=\"r\",actor=\"a\"} 2.0\n"), "{page}");
        assert!(!page.contains("treadmill_actor_policy_lag{run=\"r\",actor=\"b\"}"), "of another learner: {page}");
        assert!(page.contains("treadmill_actor_steps_per_second{run=\"r\",actor=\"b\"} 1500.5\n"), "{page}");
        prometheus.set_actors(&[("b".to_string(), stats(12, 7))].into(), NEWEST);
        let page = prometheus.page("r", &[], PageFormat::Plain);
        assert!(!page.contains("actor=\"a\""), "gone: {page}");
        assert!(page.contains("treadmill_actor_policy_lag{run=\"r\",actor=\"b\"} 0.0\n"), "{page}");
    }

    #[test]
    fn a_page_has_a_limited_number_of_actors() {
        let prometheus = PrometheusMetrics::default();
        let many = (0..3 * ACTORS_SHOWN_MAX).map(|n| (format!("actor-{n:05}"), stats(12, 7))).collect();
        prometheus.set_actors(&many, NEWEST);
        let page = prometheus.page("r", &[], PageFormat::Plain);
        assert_eq!(page.matches("treadmill_actor_envs{").count(), ACTORS_SHOWN_MAX);
    }

    #[test]
    fn names_have_base_units_and_totals_their_suffix() {
        for (tag, wanted) in [
            ("rollout/ep_rew_mean", "treadmill_rollout_ep_rew_mean"),
            ("rollout/used_share", "treadmill_rollout_used_ratio"),
            ("rollout/velocity_mean_mps", "treadmill_rollout_velocity_mean_meters_per_second"),
            ("time/time_elapsed", "treadmill_time_elapsed_seconds_total"),
            ("time/total_timesteps", "treadmill_time_timesteps_total"),
            ("train/samples_per_s", "treadmill_train_samples_per_second"),
            ("parts/simulation", "treadmill_parts_simulation_steps_per_second"),
            ("actors/env_steps_per_s", "treadmill_actors_steps_per_second"),
            ("bus/accepted_mb", "treadmill_bus_accepted_bytes_total"),
            ("rewards/my.term-2", "treadmill_rewards_my_term_2"),
        ] {
            assert_eq!(name(tag), wanted);
        }
        let prometheus = PrometheusMetrics::default();
        prometheus.set([("learner/memory_mb", 1.5)]);
        let page = prometheus.page("r", &[], PageFormat::Plain);
        assert!(page.contains("treadmill_learner_memory_bytes{run=\"r\"} 1500000.0\n"), "{page}");
    }

    #[test]
    fn help_texts_come_from_the_table() {
        let help = |tag| Exported::of(tag).help;
        assert_eq!(help("no_such/tag"), "A metric of Treadmill");
        assert!(help("train/clip_fraction").ends_with(" ppo.clip_range."));
        assert_eq!(help("rewards/any"), help("rewards/other"));
        assert_eq!(help("actor/envs"), "Its environments.");
    }
}
