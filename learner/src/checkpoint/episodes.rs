//! Window of the last finished episodes, as in Stable-Baselines3.

use std::collections::VecDeque;

use serde::{Deserialize, Serialize};
use treadmill_proto::{EndCause, Episode};

/// Number of episodes in the window.
pub const WINDOW: usize = 100;

/// Last [`WINDOW`] episodes, and counts over the run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EpisodeWindow {
    recent: VecDeque<Entry>,
    /// Number of episodes over the run.
    pub finished: u64,
    /// Number of episodes over the run that ended because the physics produced a number that is not finite.
    pub faults: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Entry {
    return_sum: f64,
    length: f64,
    distance_m: f64,
    velocity_mean_mps: f64,
    fell: bool,
    /// Not in checkpoints: after a resume, these means are those of newer episodes.
    #[serde(skip)]
    ground_level: Option<f64>,
    #[serde(skip)]
    command_factor: Option<f64>,
}

/// Means over the window.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EpisodeMeans {
    /// Mean return.
    pub return_mean: f64,
    /// Mean length in control steps.
    pub length_mean: f64,
    /// Mean forward distance in metres.
    pub distance_mean_m: f64,
    /// Mean over episodes of distance over time, in metres per second.
    pub velocity_mean_mps: f64,
    /// Share of episodes that ended with a fall, or by termination in an external task.
    pub fall_fraction: f64,
    /// Mean level of the ground's difficulty; `None` where the task has no levels.
    pub ground_level: Option<f64>,
    /// Mean factor on the ranges of commands; `None` where the task has no such curriculum.
    pub command_factor: Option<f64>,
}

impl EpisodeWindow {
    /// Adds the episodes of a fragment.
    pub fn extend<'a>(&mut self, episodes: impl IntoIterator<Item = &'a Episode>) {
        for episode in episodes {
            self.finished += 1;
            self.faults += u64::from(episode.cause == EndCause::NonFinite);
            if self.recent.len() == WINDOW {
                self.recent.pop_front();
            }
            self.recent.push_back(Entry {
                return_sum: episode.return_sum,
                length: episode.length.into(),
                distance_m: episode.distance_m,
                velocity_mean_mps: episode.velocity_mean_mps,
                fell: matches!(episode.cause, EndCause::Fell | EndCause::Terminated),
                ground_level: episode.ground_level,
                command_factor: episode.command_factor,
            });
        }
    }

    /// Empties the window; the counts stay.
    pub fn forget(&mut self) {
        self.recent.clear();
    }

    /// Whether the window has [`WINDOW`] episodes.
    pub fn is_full(&self) -> bool {
        self.recent.len() == WINDOW
    }

    /// Returns the mean return of the middle half of the window, from the first to the third quartile. Up to a quarter
    /// of the episodes with absurd returns do not move it out of the range of the others. `None` before the window is
    /// full, or if the mean is not finite.
    pub fn middle_return_mean(&self) -> Option<f64> {
        if !self.is_full() {
            return None;
        }
        let mut returns: Vec<f64> = self.recent.iter().map(|entry| entry.return_sum).collect();
        returns.sort_by(f64::total_cmp);
        let middle = &returns[WINDOW / 4..WINDOW - WINDOW / 4];
        Some(middle.iter().sum::<f64>() / middle.len() as f64).filter(|mean| mean.is_finite())
    }

    /// Returns the means over the window, or `None` before the first episode ends.
    pub fn means(&self) -> Option<EpisodeMeans> {
        if self.recent.is_empty() {
            return None;
        }
        let mean = |of: fn(&Entry) -> f64| self.recent.iter().map(of).sum::<f64>() / self.recent.len() as f64;
        let known = |of: fn(&Entry) -> Option<f64>| {
            let (sum, count) = self.recent.iter().filter_map(of).fold((0.0, 0.0), |(sum, n), one| (sum + one, n + 1.0));
            (count > 0.0).then_some(sum / count)
        };
        Some(EpisodeMeans {
            return_mean: mean(|entry| entry.return_sum),
            length_mean: mean(|entry| entry.length),
            distance_mean_m: mean(|entry| entry.distance_m),
            velocity_mean_mps: mean(|entry| entry.velocity_mean_mps),
            fall_fraction: mean(|entry| f64::from(u8::from(entry.fell))),
            ground_level: known(|entry| entry.ground_level),
            command_factor: known(|entry| entry.command_factor),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn episode(return_sum: f64, cause: EndCause) -> Episode {
        Episode {
            return_sum,
            length: 10,
            distance_m: 2.0,
            velocity_mean_mps: 0.5,
            cause,
            ground_kind: None,
            ground_level: None,
            command_factor: None,
            failed_step: None,
        }
    }

    #[test]
    fn means_are_over_the_last_hundred_episodes() {
        let mut window = EpisodeWindow::default();
        assert_eq!(window.means(), None);
        window.extend(&vec![episode(1000.0, EndCause::NonFinite); 50]);
        window.extend(&vec![episode(1.0, EndCause::Fell); 50]);
        assert_eq!(window.means().unwrap().return_mean, 500.5);
        window.extend(&vec![episode(3.0, EndCause::TimeLimit); 50]);
        let means = window.means().unwrap();
        assert_eq!((means.return_mean, means.fall_fraction), (2.0, 0.5));
        assert_eq!((window.finished, window.faults), (150, 50));
        assert_eq!((means.ground_level, means.command_factor), (None, None));
        let on_ground = |level| Episode { ground_level: Some(level), ..episode(1.0, EndCause::Fell) };
        window.extend(&[on_ground(2.0), on_ground(5.0)]);
        assert_eq!(window.means().unwrap().ground_level, Some(3.5), "of those that have a level");
        window.forget();
        assert_eq!((window.means(), window.is_full(), window.finished), (None, false, 152));
    }

    #[test]
    fn absurd_returns_do_not_change_the_middle_mean() {
        let returns = |returns: Vec<f64>| {
            let mut window = EpisodeWindow::default();
            window.extend(&returns.into_iter().map(|sum| episode(sum, EndCause::Fell)).collect::<Vec<_>>());
            window.middle_return_mean()
        };
        assert_eq!(returns(vec![1.0; 99]), None, "the window is not full");
        // 0 to 99: the middle half is 25 to 74, whose mean is 49.5.
        let sound: Vec<f64> = (0..100).map(f64::from).collect();
        assert_eq!(returns(sound.clone()), Some(49.5));
        // The 25 smallest become absurd: the middle half is then 50 to 99.
        let absurd = |by: f64| returns(sound.iter().map(|sum| if *sum < 25.0 { by } else { *sum }).collect());
        assert_eq!(absurd(1e300), Some(74.5));
        assert_eq!(absurd(-1e300), Some(49.5));
        // The sum of the middle half overflows.
        assert_eq!(returns(vec![1e308; 100]), None);
    }

    #[test]
    fn the_middle_mean_rises_with_a_share_of_successes() {
        let successes = |count: usize| {
            let mut window = EpisodeWindow::default();
            window.extend(&vec![episode(1.0, EndCause::Fell); count]);
            window.extend(&vec![episode(0.0, EndCause::Fell); 100 - count]);
            window.middle_return_mean().unwrap()
        };
        // With k successes, k - 25 of the middle 50 episodes succeed.
        assert_eq!([successes(20), successes(30), successes(60), successes(90)], [0.0, 0.1, 0.7, 1.0]);
    }
}
