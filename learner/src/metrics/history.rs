//! Return and distance over a run, in a bounded number of points.

use std::{fs::File, io, path::Path};

use super::jsonl::for_each_metric;

/// Most points that are kept: more than a line of text shows.
const POINTS_MAX: usize = 128;

const RETURN_TAG: &str = "rollout/ep_rew_mean";
const DISTANCE_TAG: &str = "rollout/distance_mean_m";
const EVALUATED_TAG: &str = "eval/distance_mean_m";
const VELOCITY_ERROR_TAG: &str = "eval/velocity_error";
const BODY_ERROR_TAG: &str = "eval/body_error";
const DONE_TAG: &str = "eval/done_share";
const YAW_RATE_ERROR_TAG: &str = "eval/yaw_rate_error";

/// Return and distance after one update.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Mean return of the last episodes.
    pub return_mean: f64,
    /// Mean distance of the last episodes in metres.
    pub distance_m: f64,
}

/// Return and distance of a run so far.
#[derive(Clone, Debug, Default)]
pub struct History {
    points: Vec<Point>,
    /// How often every second point was dropped: one in `2^halvings` updates has a point.
    halvings: u32,
    seen: u64,
    last: Option<Point>,
    /// Greatest mean distance in training, in metres.
    pub distance_best_m: Option<f64>,
    /// Greatest mean distance of an evaluation, in metres.
    pub evaluated_best_m: Option<f64>,
    /// What counts beside the return.
    pub figures: RunFigures,
    /// Errors of the velocity (m/s) and the yaw rate (rad/s) in the last evaluation, of a task with commands.
    pub tracking_errors: Option<[f64; 2]>,
    /// Share of a motion that was done, and error of the links (m), in the last evaluation of a motion task.
    pub imitated: Option<[f64; 2]>,
}

/// What counts beside the return.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RunFigures {
    /// Distance.
    #[default]
    Distance,
    /// Errors of commanded velocities.
    Tracking,
    /// How much of a motion is done, and how well.
    Imitation,
}

impl History {
    /// Reads the history from a run's metrics; empty if the file does not exist.
    pub fn read(metrics_jsonl: &Path) -> io::Result<Self> {
        let mut history = Self::default();
        let file = match File::open(metrics_jsonl) {
            Ok(file) => file,
            Err(why) if why.kind() == io::ErrorKind::NotFound => return Ok(history),
            Err(why) => return Err(why),
        };
        let (mut return_mean, mut velocity_error, mut body_error) = (None, None, None);
        for_each_metric(file, |metric, _| {
            match &metric.tag[..] {
                RETURN_TAG => return_mean = Some(metric.value),
                // In every update it comes after the return.
                DISTANCE_TAG => history.add(return_mean.take(), Some(metric.value), None),
                EVALUATED_TAG => history.add(None, None, Some(metric.value)),
                VELOCITY_ERROR_TAG => velocity_error = Some(metric.value),
                YAW_RATE_ERROR_TAG => history.note_tracking(velocity_error.take(), Some(metric.value)),
                BODY_ERROR_TAG => body_error = Some(metric.value),
                DONE_TAG => history.note_imitation(Some(metric.value), body_error.take()),
                _ => {}
            }
            Ok(())
        })?;
        Ok(history)
    }

    /// Adds the values after an update: mean return and distance of the last episodes, and the mean distance of an
    /// evaluation that has just ended.
    pub fn add(&mut self, return_mean: Option<f64>, distance_m: Option<f64>, evaluated_m: Option<f64>) {
        self.distance_best_m = greater(self.distance_best_m, distance_m);
        self.evaluated_best_m = greater(self.evaluated_best_m, evaluated_m);
        let (Some(return_mean), Some(distance_m)) = (return_mean, distance_m) else { return };
        let point = Point { return_mean, distance_m };
        self.last = Some(point);
        if self.seen.is_multiple_of(1 << self.halvings) {
            if self.points.len() == POINTS_MAX {
                self.points = self.points.iter().step_by(2).copied().collect();
                self.halvings += 1;
            }
            self.points.push(point);
        }
        self.seen += 1;
    }

    /// Notes the errors of an evaluation that has just ended, if the task has commands.
    pub fn note_tracking(&mut self, velocity_error_mps: Option<f64>, yaw_rate_error_radps: Option<f64>) {
        let errors = velocity_error_mps.zip(yaw_rate_error_radps).map(<[f64; 2]>::from);
        self.tracking_errors = errors.or(self.tracking_errors);
    }

    /// Notes how a motion was done in an evaluation that has just ended, if the task has motions.
    pub fn note_imitation(&mut self, done_share: Option<f64>, body_error_m: Option<f64>) {
        self.imitated = done_share.zip(body_error_m).map(<[f64; 2]>::from).or(self.imitated);
    }

    /// Iterates over the points from first to last, including the last update's.
    pub fn points(&self) -> impl Iterator<Item = Point> + Clone + '_ {
        let missing = self.last.filter(|last| self.points.last() != Some(last));
        self.points.iter().copied().chain(missing)
    }

    /// Best distance of the run, in metres: the greatest mean of an evaluation, or in training before the first one.
    pub fn best_m(&self) -> Option<f64> {
        self.evaluated_best_m.or(self.distance_best_m)
    }
}

/// Returns the greater of two values, without one that is absent or not finite.
fn greater(best: Option<f64>, value: Option<f64>) -> Option<f64> {
    best.into_iter().chain(value.filter(|value| value.is_finite())).reduce(f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_whole_evaluation_of_commands_counts() {
        let mut history = History::default();
        history.note_tracking(Some(0.3), Some(0.4));
        history.note_tracking(Some(0.1), None);
        assert_eq!(history.tracking_errors, Some([0.3, 0.4]));
        history.note_tracking(Some(0.1), Some(0.2));
        assert_eq!(history.tracking_errors, Some([0.1, 0.2]));
    }

    #[test]
    fn a_long_run_keeps_few_points_including_the_first_and_the_last() {
        let mut history = History::default();
        for update in 0..10_001 {
            history.add(Some(f64::from(update)), Some(0.5), None);
        }
        let points: Vec<_> = history.points().collect();
        assert!((POINTS_MAX / 2..=POINTS_MAX + 1).contains(&points.len()), "{}", points.len());
        assert_eq!((points[0].return_mean, points.last().unwrap().return_mean), (0.0, 10_000.0));
        let gaps: Vec<_> = points.windows(2).map(|pair| pair[1].return_mean - pair[0].return_mean).collect();
        assert!(gaps[..gaps.len() - 1].windows(2).all(|pair| pair[0] == pair[1]), "{gaps:?}");
    }

    #[test]
    fn the_greatest_distances_are_kept() {
        let mut history = History::default();
        assert_eq!(history.best_m(), None);
        for distance_m in [1.0, 4.0, 2.0, f64::NAN] {
            history.add(Some(1.0), Some(distance_m), None);
        }
        assert_eq!(history.best_m(), Some(4.0));
        history.add(None, None, Some(3.0));
        assert_eq!((history.distance_best_m, history.evaluated_best_m), (Some(4.0), Some(3.0)));
        assert_eq!(history.best_m(), Some(3.0), "exploration is no evaluation");
    }

    #[test]
    fn the_history_is_read_from_the_metrics() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("metrics.jsonl");
        assert_eq!(History::read(&path).unwrap().points().count(), 0);
        let line = |tag: &str, step: u64, value: f64| {
            format!("{{\"run\":\"r\",\"tag\":\"{tag}\",\"step\":{step},\"value\":{value},\"time_unix_s\":1.0}}\n")
        };
        let text = line(RETURN_TAG, 1, 5.0) + &line(DISTANCE_TAG, 1, 0.5) + &line(EVALUATED_TAG, 2, 7.5) + "{\"run";
        std::fs::write(&path, text).unwrap();
        let history = History::read(&path).unwrap();
        assert_eq!(history.points().collect::<Vec<_>>(), [Point { return_mean: 5.0, distance_m: 0.5 }]);
        assert_eq!(history.best_m(), Some(7.5));
    }
}
