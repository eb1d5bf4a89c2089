//! Alarms: conditions that waste work or hide a fault, each with its remedy. The status and the dashboard show them.

use std::time::{Duration, Instant};

use treadmill_bus::learner::RateLimitedLog;
use treadmill_config::{Config, LearnerMode};
use treadmill_ppo::{UpdateError, UpdateStats};
use treadmill_runtime::error_chain;

use crate::{intake::Rejections, metrics::Efficiency};

/// Share of the simulated steps below which waste is an alarm.
const USED_SHARE_MIN: f64 = 0.9;
/// An alarm about rejected or undone work lasts for this long.
const LASTS: Duration = Duration::from_secs(60);
/// Most senders that are named.
const SENDERS_MAX: usize = 4;

/// Present alarms.
#[derive(Debug, Default)]
pub(super) struct Alarms {
    waste: Option<String>,
    undone: Option<(Instant, String)>,
    log: RateLimitedLog,
}

impl Alarms {
    /// Records the efficiency after an update. `late` fragments were too old, in this run.
    pub(super) fn record_efficiency(&mut self, efficiency: Efficiency, late: u64, undone: u64, config: &Config) {
        let wasted = efficiency.used_share.filter(|share| *share < USED_SHARE_MIN);
        let remedy = if late > 0 || undone == 0 { remedy(config) } else { "the log says why updates were undone" };
        if let Some(used_share) = wasted {
            self.log.emit(|| {
                tracing::warn!(
                    used_share,
                    too_old = late,
                    undone_updates = undone,
                    remedy,
                    "simulated steps are not learnt from"
                );
            });
        }
        self.waste = wasted.map(|share| {
            format!(
                "{:.0} % of the simulated steps are learnt from ({late} fragments were too old, {undone} updates undone): \
                 {remedy}",
                100.0 * share
            )
        });
    }

    /// Records an update. One without a plausible fragment is an alarm about its senders, not about itself.
    pub(super) fn record_update(&mut self, result: &Result<UpdateStats, UpdateError>, now: Instant) {
        if let Err(why) = result
            && !matches!(why, UpdateError::Empty)
        {
            self.record_undone(&error_chain(why), now);
        }
    }

    fn record_undone(&mut self, why: &str, now: Instant) {
        let text = format!("an update was undone: {why}; if fragments caused it, the log names their senders");
        self.undone = Some((now, text));
    }

    /// Returns every alarm as one sentence.
    pub(super) fn texts(&self, rejections: &Rejections, now: Instant) -> Vec<String> {
        let undone = self.undone.as_ref().filter(|(at, _)| now.duration_since(*at) < LASTS).map(|(_, text)| text);
        let rejected = rejections.recent(now, LASTS).take(SENDERS_MAX).map(|(sender, rejection)| {
            let (count, reason) = (rejection.fragments, &rejection.reason);
            format!(
                "fragments of `{sender}` were rejected ({count}), the last because {reason}; stop or repair that actor"
            )
        });
        self.waste.iter().chain(undone).cloned().chain(rejected).collect()
    }
}

/// Returns what makes fewer fragments too old.
fn remedy(config: &Config) -> &'static str {
    match (config.rollout.fragment_steps, config.learner.mode) {
        (1.., _) => "in a new run, set rollout.fragment_steps = 0",
        (0, LearnerMode::Sync) => "in a new run, set learner.mode = \"async\"",
        (0, LearnerMode::Async) => "set learner.max_policy_lag higher",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_alarm_says_what_to_do_and_ends() {
        let (mut alarms, mut rejections, now) = (Alarms::default(), Rejections::default(), Instant::now());
        assert!(alarms.texts(&rejections, now).is_empty());
        let (wasteful, mut config) =
            (Efficiency { used_share: Some(0.64), ..Efficiency::default() }, Config::default());
        config.rollout.fragment_steps = 128;
        alarms.record_efficiency(wasteful, 12, 0, &config);
        alarms.record_undone("the loss is not finite", now);
        rejections.record("bad", "`rewards` is absurd", now);
        let texts = alarms.texts(&rejections, now);
        assert!(texts[0].starts_with("64 % of the simulated steps") && texts[0].contains("rollout.fragment_steps"));
        assert!(texts[1].contains("the loss is not finite"));
        assert!(
            texts[2].contains("fragments of `bad` were rejected (1)") && texts[2].contains("stop or repair"),
            "{}",
            texts[2]
        );
        alarms.record_efficiency(Efficiency { used_share: Some(0.97), ..Efficiency::default() }, 12, 0, &config);
        assert!(alarms.texts(&rejections, now + LASTS).is_empty());
        (config.rollout.fragment_steps, config.learner.mode) = (0, LearnerMode::Async);
        for (late, undone, wanted) in [(12, 8, "learner.max_policy_lag"), (0, 8, "why updates were undone")] {
            alarms.record_efficiency(wasteful, late, undone, &config);
            assert!(alarms.texts(&rejections, now + LASTS)[0].contains(wanted), "{wanted}");
        }
    }
}
