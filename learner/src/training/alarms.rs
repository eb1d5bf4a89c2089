//! Alarms: conditions that waste work or hide a fault, each with its remedy. The status and the dashboard show them.

use std::time::{Duration, Instant};

use treadmill_config::{Config, LearnerMode};
use treadmill_ppo::{UpdateError, UpdateStats};
use treadmill_runtime::error_chain;

use super::stuck::Stuck;
use crate::{checkpoint::EpisodeMeans, intake::Rejections, metrics::Efficiency};

/// Share of the simulated steps below which waste is an alarm.
const USED_SHARE_MIN: f64 = 0.9;
/// An alarm about rejected or undone work lasts for this long.
const LASTS: Duration = Duration::from_secs(60);
/// Time for which steps are wasted before that is an alarm.
const WASTE_LASTS: Duration = Duration::from_secs(10);
/// Mean length of episodes, in control steps, that is an alarm after so many updates in a row.
const SHORT_STEPS: f64 = 5.0;
const SHORT_UPDATES: u32 = 20;
/// Updates for which a curriculum may stay where it begins although most episodes survive; values of that beginning.
const STALLED_UPDATES: u32 = 50;
const FIRST_LEVELS: f64 = 0.05;
const FIRST_FACTORS: f64 = 0.42;
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
    /// Updates in a row with short episodes, and with a curriculum that stands still.
    short_updates: u32,
    stalled_updates: u32,
    stuck: Stuck,
    episodes: Vec<String>,
    episodes_logged: Option<Instant>,
}

impl Alarms {
    /// Records how the last episodes and the last evaluation, with its velocity error (m/s), went, after an update of a run
    /// with so many steps.
    pub(super) fn record_episodes(
        &mut self,
        (means, error_mps): (Option<EpisodeMeans>, Option<f64>),
        env_steps: u64,
        config: &Config,
        now: Instant,
    ) {
        let Some(means) = means else { return };
        let count = |updates: u32, is_so: bool| if is_so { updates.saturating_add(1) } else { 0 };
        self.short_updates = count(self.short_updates, means.length_mean <= SHORT_STEPS);
        let is_low = config.ground.curriculum
            && config.ground.start_level == 0
            && config.ground.levels > 1
            && means.ground_level.is_some_and(|level| level < FIRST_LEVELS);
        let is_slow = means.command_factor.is_some_and(|factor| factor < FIRST_FACTORS);
        let survives = means.fall_fraction < 0.5;
        self.stalled_updates = count(self.stalled_updates, survives && (is_low || is_slow));
        self.episodes = self.stuck.record(means, error_mps, env_steps, config).into_iter().collect();
        if self.short_updates >= SHORT_UPDATES {
            self.episodes.push(format!(
                "episodes end after {:.1} steps, for {} updates, which teaches nothing: see how the robot starts by \
                 `treadmill robot FILE`, and velocity.fall_height_share, velocity.fall_tilt_rad or env.healthy_z_range",
                means.length_mean, self.short_updates
            ));
        }
        if self.stalled_updates >= STALLED_UPDATES {
            let (what, why) = match is_low {
                true => ("ground", "cover less than half of the way that is commanded"),
                false => ("commands", "cover less than 0.7 of the way that is commanded, or track it worse than that"),
            };
            self.episodes.push(format!(
                "the curriculum of the {what} stands still, for {} updates: {:.0} % of the episodes survive, but they {why}; \
                 see eval/velocity_error, the ranges of [velocity], and the rewards for tracking",
                self.stalled_updates,
                100.0 * (1.0 - means.fall_fraction)
            ));
        }
        if !self.episodes.is_empty() && self.episodes_logged.is_none_or(|logged| now.duration_since(logged) >= LASTS) {
            self.episodes_logged = Some(now);
            self.episodes.iter().for_each(|text| tracing::warn!("{text}"));
        }
    }

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
        self.waste.iter().chain(undone).chain(&self.episodes).cloned().chain(rejected).collect()
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

    #[test]
    fn episodes_that_teach_nothing_and_curricula_that_stand_still_are_alarms() {
        let (mut alarms, rejections, now) = (Alarms::default(), Rejections::default(), Instant::now());
        let mut config = Config::default();
        config.ground.levels = 10;
        let means = |length_mean, fall_fraction, level| EpisodeMeans {
            length_mean,
            fall_fraction,
            ground_level: Some(level),
            ..EpisodeMeans::default()
        };
        let record = |alarms: &mut Alarms, updates: u32, means: EpisodeMeans| {
            (0..updates).for_each(|_| alarms.record_episodes((Some(means), None), 0, &config, now));
            alarms.texts(&rejections, now)
        };
        assert!(record(&mut alarms, SHORT_UPDATES - 1, means(1.0, 1.0, 0.0)).is_empty());
        let texts = record(&mut alarms, 1, means(1.0, 1.0, 0.0));
        assert!(
            texts[0].contains("after 1.0 steps, for 20 updates") && texts[0].contains("treadmill robot"),
            "{texts:?}"
        );
        assert!(record(&mut alarms, 200, means(40.0, 1.0, 0.0)).is_empty(), "it still learns to stand");
        assert!(record(&mut alarms, STALLED_UPDATES - 1, means(900.0, 0.1, 0.0)).is_empty());
        let texts = record(&mut alarms, 1, means(900.0, 0.1, 0.0));
        assert!(texts[0].contains("90 % of the episodes survive") && texts[0].contains("half of the way"), "{texts:?}");
        assert!(record(&mut alarms, 1, means(900.0, 0.1, 0.5)).is_empty(), "it rises");
    }
}
