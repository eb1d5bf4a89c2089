//! Page of all metrics, generated from their table.

use std::collections::BTreeSet;

use treadmill_learner::metrics::{
    catalogue::{METRICS, MetricRow, MetricSource},
    prometheus,
};

use super::heading;

/// Text of the page, with `{section}` in place of each section's metrics.
const TEXT: &str = include_str!("metrics.txt");

/// Returns the page.
pub fn page() -> String {
    let sections: BTreeSet<&str> = METRICS.iter().map(section).collect();
    let head = heading("Metrics", "`learner/src/metrics/catalogue.rs` and `src/commands/manual/metrics.txt`");
    sections.into_iter().fold(head + TEXT, |page, name| {
        let lines: String = METRICS.iter().filter(|row| section(row) == name).map(line).collect();
        page.replace(&format!("{{{name}}}\n"), &lines)
    })
}

/// Returns the section of a metric: its group, or the one output that has it.
fn section(row: &MetricRow) -> &'static str {
    match row.source {
        MetricSource::Actor(_) | MetricSource::Live => "prometheus",
        MetricSource::Histogram => "tensorboard",
        _ => row.group(),
    }
}

/// Returns the line of a metric.
fn line(row: &MetricRow) -> String {
    let name = if section(row) == "prometheus" { prometheus::name(row.tag) } else { row.tag.to_string() };
    // Those of Prometheus name their base units.
    let unit = if section(row) == "prometheus" { "" } else { row.unit };
    let known: Vec<&str> = [unit, row.typical].into_iter().filter(|text| !["", "–"].contains(text)).collect();
    let known = if known.is_empty() { String::new() } else { format!(" ({})", known.join("; ")) };
    format!("- `{name}`{known}: {}\n", row.help)
}
