//! What trials of a sweep are compared by.

use std::{fs::File, path::Path};

use treadmill_config::{ChosenTask, Config};
use treadmill_learner::metrics::{
    catalogue::{METRICS, MetricRow},
    jsonl::for_each_metric,
};
use treadmill_runtime::words::nearest;

const FORMS: &str = "`highest TAG`, `lowest TAG`, `steps until TAG >= NUMBER` or `seconds until TAG <= NUMBER`";

/// Goal of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Goal {
    /// Metric that it is about.
    pub(crate) tag: String,
    kind: GoalKind,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum GoalKind {
    /// Last value of the metric, the highest or the lowest best.
    Highest,
    Lowest,
    /// Environment steps, or seconds, until the metric is at least or at most a number.
    Until {
        counts_seconds: bool,
        at_least: bool,
        number: f64,
    },
}

impl Goal {
    /// Returns the goal of a configuration that names none: the last evaluation, or the training before the first one. A
    /// population cannot wait for evaluations, which come later than the steps that they are of.
    pub(crate) fn of(config: &Config, is_population: bool) -> Self {
        let (tag, kind) = match (config.env.chosen_task(), config.evaluates() && !is_population) {
            (ChosenTask::Velocity, true) => ("eval/velocity_error", GoalKind::Lowest),
            (ChosenTask::HumanoidV4 | ChosenTask::HumanoidV5, true) => ("eval/distance_mean_m", GoalKind::Highest),
            (ChosenTask::HumanoidV4 | ChosenTask::HumanoidV5, false) => ("rollout/distance_mean_m", GoalKind::Highest),
            _ => ("rollout/ep_rew_mean", GoalKind::Highest),
        };
        Self { tag: tag.to_string(), kind }
    }

    /// Reads a goal.
    ///
    /// # Errors
    /// If it has another form, or the metric does not exist.
    pub(crate) fn read(text: &str) -> Result<Self, String> {
        let words: Vec<&str> = text.split_whitespace().collect();
        let refuse = || format!("`goal` is \"{text}\"; allowed: {FORMS}");
        let (tag, kind) = match words[..] {
            ["highest", tag] => (tag, GoalKind::Highest),
            ["lowest", tag] => (tag, GoalKind::Lowest),
            [what @ ("steps" | "seconds"), "until", tag, sign @ (">=" | "<="), number] => {
                let number = number.parse().ok().filter(|number: &f64| number.is_finite()).ok_or_else(refuse)?;
                (tag, GoalKind::Until { counts_seconds: what == "seconds", at_least: sign == ">=", number })
            }
            _ => return Err(refuse()),
        };
        if MetricRow::of(tag).is_none() {
            let near = nearest(tag, METRICS.iter().map(|row| row.tag));
            let hint = near.map(|near| format!("did you mean `{near}`? ")).unwrap_or_default();
            return Err(format!("`goal`: there is no metric `{tag}`; {hint}docs/reference/metrics.md lists them"));
        }
        Ok(Self { tag: tag.to_string(), kind })
    }

    /// Returns whether it is a value at any time, and not the time until a value.
    pub(crate) fn is_value(&self) -> bool {
        !matches!(self.kind, GoalKind::Until { .. })
    }

    /// Returns the direction of what is best, by Optuna's name.
    pub(crate) fn direction(&self) -> &'static str {
        if self.kind == GoalKind::Highest { "maximize" } else { "minimize" }
    }

    /// Returns what pruners compare of a value of the metric: it, or by how much it misses the number.
    pub(crate) fn compared(&self, value: f64) -> f64 {
        match self.kind {
            GoalKind::Highest | GoalKind::Lowest => value,
            GoalKind::Until { at_least: true, number, .. } => number - value,
            GoalKind::Until { number, .. } => value - number,
        }
    }

    /// Returns what a run has reached; `None` if it has not.
    pub(crate) fn reached(&self, run: &Path) -> Option<f64> {
        let file = File::open(run.join("metrics.jsonl")).ok()?;
        let (mut last, mut first_step, mut seconds, mut clock) = (None, None, None, (0, 0.0));
        // A file that cannot be read to its end has reached what it has.
        let _ = for_each_metric(file, |metric, _| {
            if metric.tag == self.tag {
                last = Some(metric.value);
                let is_there = !self.is_value() && self.compared(metric.value) <= 0.0;
                first_step = first_step.or(is_there.then_some(metric.step));
            }
            if metric.tag == "time/time_elapsed" {
                clock = (metric.step, metric.value);
            }
            if first_step.is_some_and(|step| clock.0 >= step) {
                seconds = seconds.or(Some(clock.1));
            }
            Ok(())
        });
        match self.kind {
            GoalKind::Highest | GoalKind::Lowest => last,
            GoalKind::Until { counts_seconds: true, .. } => seconds,
            GoalKind::Until { .. } => first_step.map(|step| step as f64),
        }
    }

    /// Returns a number by which results are sorted, the best first; what was not reached is last.
    pub(crate) fn order(&self, reached: Option<f64>) -> f64 {
        match (reached, self.kind) {
            (None, _) => f64::INFINITY,
            (Some(value), GoalKind::Highest) => -value,
            (Some(value), _) => value,
        }
    }
}

impl std::fmt::Display for Goal {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.kind {
            GoalKind::Highest => write!(f, "highest {}", self.tag),
            GoalKind::Lowest => write!(f, "lowest {}", self.tag),
            GoalKind::Until { counts_seconds, at_least, number } => {
                let (what, sign) =
                    (if counts_seconds { "seconds" } else { "steps" }, if at_least { ">=" } else { "<=" });
                write!(f, "{what} until {} {sign} {number}", self.tag)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn goals_are_read_and_measured() {
        let folder = tempfile::tempdir().unwrap();
        let line = |tag: &str, step: u64, value: f64| {
            format!("{{\"run\":\"r\",\"tag\":\"{tag}\",\"step\":{step},\"value\":{value},\"time_unix_s\":1.0}}\n")
        };
        let distance = [(10, 1.0), (20, 12.0), (30, 9.0)];
        let text: String = distance
            .iter()
            .flat_map(|(step, value)| {
                [line("time/time_elapsed", *step, *step as f64 / 5.0), line("eval/distance_mean_m", *step, *value)]
            })
            .collect();
        std::fs::write(folder.path().join("metrics.jsonl"), text).unwrap();
        for (text, reached) in [
            ("highest eval/distance_mean_m", Some(9.0)),
            ("steps until eval/distance_mean_m >= 10", Some(20.0)),
            ("seconds until eval/distance_mean_m >= 10", Some(4.0)),
            ("steps until eval/distance_mean_m >= 50", None),
            ("lowest eval/velocity_error", None),
        ] {
            let goal = Goal::read(text).unwrap();
            assert_eq!((goal.reached(folder.path()), goal.to_string()), (reached, text.to_string()));
        }
        for (text, part) in [
            ("far", "`highest TAG`"),
            ("highest eval/distance_mean", "did you mean `eval/distance_mean_m`?"),
            ("steps until eval/distance_mean_m >= far", "NUMBER"),
        ] {
            assert!(Goal::read(text).unwrap_err().contains(part), "{text}");
        }
        let highest = Goal::read("highest eval/distance_mean_m").unwrap();
        assert!(highest.order(Some(9.0)) < highest.order(Some(1.0)) && highest.order(None) > highest.order(Some(-1.0)));
    }
}
