//! Notices a robot that does no better than to stand or to fall for long.

use treadmill_config::{ChosenTask, Config};
use treadmill_runtime::numbers::thousands;

use crate::checkpoint::EpisodeMeans;

/// Environment steps for which it does no better, from which that is an alarm.
const STEPS: u64 = 1_000_000;
/// Share of the episodes that end with a fall, from which the robot only falls, and growth of their length that is progress.
const FALLS: f64 = 0.95;
const LONGER: f64 = 1.1;
/// A robot only stands if its velocity error is above this share of that of a standing one. Without commands it stands if it
/// does not get farther than this (m).
const STANDING_ERROR: f64 = 0.9;
/// Mean commanded speed (m/s) below which standing may be what is wanted.
const COMMANDED_MPS_MIN: f64 = 0.1;
const STANDING_M: f64 = 0.5;

/// How long a robot has only stood or fallen.
#[derive(Debug, Default)]
pub(super) struct Stuck {
    /// Environment steps when it began.
    since: Option<u64>,
    /// Greatest mean length of episodes that end with a fall, in control steps.
    longest: f64,
}

impl Stuck {
    /// Records the last episodes, the velocity error of the last evaluation (m/s) and the steps of the run. Returns an
    /// alarm if there is one.
    pub(super) fn record(
        &mut self,
        means: EpisodeMeans,
        error_mps: Option<f64>,
        env_steps: u64,
        config: &Config,
    ) -> Option<String> {
        let standing_mps = config.velocity.mean_speed_mps();
        let has_commands = match config.env.chosen_task() {
            ChosenTask::Velocity => true,
            // How far a motion goes says nothing; falls do.
            ChosenTask::Motion if means.fall_fraction > FALLS => true,
            ChosenTask::Motion => return None,
            ChosenTask::HumanoidV4 | ChosenTask::HumanoidV5 => false,
            // What is good in other tasks is not known.
            ChosenTask::Own(_) | ChosenTask::External => return None,
        };
        let falls = means.fall_fraction > FALLS;
        let stands = !falls
            && match has_commands {
                true => {
                    standing_mps >= COMMANDED_MPS_MIN
                        && error_mps.is_some_and(|error| error > STANDING_ERROR * standing_mps)
                }
                false => means.distance_mean_m < STANDING_M,
            };
        let is_longer = falls && means.length_mean > LONGER * self.longest;
        if is_longer {
            self.longest = means.length_mean;
        }
        if is_longer || !(falls || stands) {
            self.since = None;
            return None;
        }
        let steps = env_steps.saturating_sub(*self.since.get_or_insert(env_steps));
        if steps < STEPS {
            return None;
        }
        let look = "look at it on the page, or by `treadmill eval RUN --film film.gif`";
        let steps = thousands(steps);
        Some(match (falls, has_commands) {
            (true, _) => format!(
                "the robot falls in nearly every episode, after {:.0} control steps, for {steps} steps no later: {look}; \
                 `treadmill robot FILE` says which hinges sag or saturate",
                means.length_mean
            ),
            (false, true) => format!(
                "the robot only stands, for {steps} steps: it misses the commands by {:.2} m/s, a standing one by \
                 {standing_mps:.2}; {look}, and see which of the metrics rewards/… it gives up",
                error_mps.unwrap_or_default()
            ),
            (false, false) => format!(
                "the robot only stands, for {steps} steps: it gets {:.1} m far; {look}, and see whether moving is rewarded",
                means.distance_mean_m
            ),
        })
    }
}

#[cfg(test)]
mod tests {
    use treadmill_config::EnvTask;

    use super::*;

    fn means(length_mean: f64, fall_fraction: f64, distance_mean_m: f64) -> EpisodeMeans {
        EpisodeMeans { length_mean, fall_fraction, distance_mean_m, ..EpisodeMeans::default() }
    }

    #[test]
    fn a_robot_that_falls_no_later_is_stuck_until_it_does() {
        let (mut stuck, config) = (Stuck::default(), Config::default());
        let mut record = |steps, length| stuck.record(means(length, 1.0, 0.1), None, steps, &config);
        assert_eq!((record(0, 20.0), record(100, 20.0)), (None, None));
        assert_eq!(record(1_000_099, 21.0), None);
        let text = record(1_000_100, 21.0).unwrap();
        assert!(text.contains("after 21 control steps") && text.contains("1,000,000 steps"), "{text}");
        assert_eq!(record(1_000_200, 23.0), None, "it falls later");
        assert_eq!(record(2_000_299, 23.0), None);
    }

    #[test]
    fn a_robot_that_stands_is_stuck_whatever_its_return() {
        let (mut stuck, mut config) = (Stuck::default(), Config::default());
        stuck.record(means(1000.0, 0.0, 0.2), None, 0, &config);
        let text = stuck.record(means(1000.0, 0.0, 0.2), None, STEPS, &config).unwrap();
        assert!(text.contains("only stands") && text.contains("0.2 m far"), "{text}");
        assert_eq!(stuck.record(means(1000.0, 0.0, 9.0), None, STEPS + 1, &config), None);
        config.env.task = EnvTask::Velocity;
        config.velocity.lin_vel_x_mps = [0.0, 1.0];
        config.velocity.lin_vel_y_mps = [0.0, 0.0];
        config.velocity.standing_share = 0.0;
        // Its mean command is 0.5 m/s.
        let mut record = |steps, error| stuck.record(means(1000.0, 0.1, 0.0), error, steps, &config);
        assert_eq!((record(0, Some(0.46)), record(STEPS, None)), (None, None));
        assert_eq!(record(STEPS, Some(0.46)), None, "an error that is unknown begins anew");
        let text = record(2 * STEPS, Some(0.46)).unwrap();
        assert!(text.contains("by 0.46 m/s, a standing one by 0.50"), "{text}");
        assert_eq!(record(2 * STEPS + 1, Some(0.44)), None);
        config.velocity.standing_share = 1.0;
        let mut record = |steps| stuck.record(means(1000.0, 0.1, 0.0), Some(0.03), steps, &config);
        assert_eq!((record(3 * STEPS), record(5 * STEPS)), (None, None), "it stands as it is commanded");
    }
}
