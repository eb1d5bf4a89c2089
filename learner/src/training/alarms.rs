//! Alarms: conditions that waste work or hide a fault, each with its remedy. The status and the dashboard show them.

use std::time::{Duration, Instant};

use treadmill_config::{Config, LearnerMode};
use treadmill_ppo::{UpdateError, UpdateStats};
use treadmill_runtime::error_chain;

use crate::{intake::Rejections, metrics::Efficiency};

/// Share of the simulated steps below which waste is an alarm.
const USED_SHARE_MIN: f64 = 0.9;
/// An alarm about rejected or undone work lasts for this long.
const LASTS: Duration = Duration::from_secs(60);
/// Time for which steps are wasted before that is an alarm.
const WASTE_LASTS: Duration = Duration::from_secs(10);
/// Most senders that are named.
const SENDERS_MAX: usize = 4;

/// Present alarms.
#[derive(Debug, Default)]
pub(super) struct Alarms {
    waste: Option<String>,
    /// Since when steps are wasted, and when that was logged last.
    wasting_since: Option<Instant>,
    logged: Option<Instant>,
    undone: Option<(Instant, String)>,
}

impl Alarms {
    /// Records the efficiency after an update. `late` fragments were too old, in this run. The first updates say little:
    /// waste is an alarm once it has lasted, and is logged once a minute.
    pub(super) fn record_efficiency(
        &mut self,
        efficiency: Efficiency,
        [late, undone]: [u64; 2],
        config: &Config,
        now: Instant,
    ) {
        let wasted = efficiency.used_share.filter(|share| *share < USED_SHARE_MIN);
        let since = *self.wasting_since.get_or_insert(now);
        if wasted.is_none() {
            self.wasting_since = None;
        }
        let wasted = wasted.filter(|_| now.duration_since(since) >= WASTE_LASTS);
        let remedy = if late > 0 || undone == 0 { remedy(config) } else { "the log says why updates were undone" };
        if let Some(used_share) = wasted
            && self.logged.is_none_or(|logged| now.duration_since(logged) >= LASTS)
        {
            self.logged = Some(now);
            tracing::warn!(
                used_share,
                too_old = late,
                undone_updates = undone,
                remedy,
                "simulated steps are not learnt from"
            );
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
        alarms.record_efficiency(wasteful, [12, 0], &config, now);
        assert!(alarms.texts(&rejections, now).is_empty(), "the first updates say little");
        let now = now + WASTE_LASTS;
        alarms.record_efficiency(wasteful, [12, 0], &config, now);
        let logged = alarms.logged;
        assert_eq!(logged, Some(now));
        alarms.record_efficiency(wasteful, [12, 0], &config, now + LASTS / 2);
        assert_eq!(alarms.logged, logged, "once a minute");
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
        let better = Efficiency { used_share: Some(0.97), ..Efficiency::default() };
        alarms.record_efficiency(better, [12, 0], &config, now);
        assert!(alarms.texts(&rejections, now + LASTS).is_empty());
        (config.rollout.fragment_steps, config.learner.mode) = (0, LearnerMode::Async);
        for (late, undone, wanted) in [(12, 8, "learner.max_policy_lag"), (0, 8, "why updates were undone")] {
            alarms.record_efficiency(wasteful, [late, undone], &config, now);
            alarms.record_efficiency(wasteful, [late, undone], &config, now + WASTE_LASTS);
            assert!(alarms.texts(&rejections, now + LASTS)[0].contains(wanted), "{wanted}");
        }
    }
}
