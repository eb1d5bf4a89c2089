//! Charts of the CUSTOM SCALARS tab: what says how good a run is, before how it got there.

use treadmill_proto::event_file::{Chart, ChartCategory, ChartLayout, Lines};

/// Tag of the tab's charts.
pub(super) const TAG: &str = "custom_scalars__config__";

/// Charts of a task that goes forward, and of one with commands: titles and tags.
type Charts = [(&'static str, &'static [&'static str])];
const FORWARD: &Charts = &[
    ("return", &["rollout/ep_rew_mean", "eval/mean_reward"]),
    ("distance [m]", &["rollout/distance_mean_m", "eval/distance_mean_m"]),
    ("falls [share]", &["rollout/fall_fraction", "eval/fall_fraction"]),
];
const COMMANDED: &Charts = &[
    ("return", &["rollout/ep_rew_mean", "eval/mean_reward"]),
    ("error of the velocity [m/s]", &["eval/velocity_error"]),
    ("error of the yaw rate [rad/s]", &["eval/yaw_rate_error"]),
    ("falls [share]", &["rollout/fall_fraction", "eval/fall_fraction"]),
];
/// Charts below them.
const LEARNING: &Charts = &[
    ("speed [steps/s]", &["time/fps"]),
    ("divergence of the update", &["train/approx_kl"]),
    ("noise of the policy", &["train/std"]),
    ("explained variance", &["train/explained_variance"]),
];

/// Returns the charts of a run.
pub(super) fn charts(has_commands: bool) -> ChartLayout {
    let category = |title: &str, charts: &Charts| ChartCategory {
        title: title.to_string(),
        chart: charts.iter().map(|(title, tags)| chart(title, tags)).collect(),
    };
    let results = if has_commands { COMMANDED } else { FORWARD };
    ChartLayout { category: vec![category("Results", results), category("Learning", LEARNING)] }
}

fn chart(title: &str, tags: &[&str]) -> Chart {
    let whole = |tag: &&str| format!("^{tag}$");
    Chart { title: title.to_string(), multiline: Some(Lines { tag: tags.iter().map(whole).collect() }) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metrics::catalogue::MetricRow;

    #[test]
    fn every_tag_is_a_metric() {
        for (_, tags) in FORWARD.iter().chain(COMMANDED).chain(LEARNING) {
            assert!(tags.iter().all(|tag| MetricRow::of(tag).is_some()), "{tags:?}");
        }
    }
}
