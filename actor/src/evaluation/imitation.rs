//! How well a robot imitates a motion.

use std::any::Any;

use treadmill_humanoid::{
    Environment,
    task::motion::{MotionErrors, MotionTask},
};

/// Length of the windows of which the worst one is reported (s).
const WINDOW_S: f64 = 1.0;

/// Sums over the control steps of one or more episodes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Imitation {
    episodes: u32,
    steps: u32,
    /// Sums of the errors: anchor (m, rad), compared links (m, rad), hinges (rad).
    errors: [f64; 5],
    /// Sum of the shares of the motions that were done.
    shares: f64,
    /// Episodes that reached the end of their motion.
    finished: u32,
    /// Greatest mean error of the links within a second (m), and when that second began in its motion (s).
    worst: Option<(f64, f64)>,
}

impl Imitation {
    /// Returns the mean distance between the anchors (m).
    #[must_use]
    pub fn anchor_error_m(&self) -> f64 {
        self.mean(0)
    }

    /// Returns the mean angle between the anchors (rad).
    #[must_use]
    pub fn anchor_error_rad(&self) -> f64 {
        self.mean(1)
    }

    /// Returns the mean distance of the compared links from the motion, moved so that the anchors lie above each other (m).
    #[must_use]
    pub fn body_error_m(&self) -> f64 {
        self.mean(2)
    }

    /// Returns the mean angle between them (rad).
    #[must_use]
    pub fn body_error_rad(&self) -> f64 {
        self.mean(3)
    }

    /// Returns the mean of the hinges' root mean square error (rad).
    #[must_use]
    pub fn hinge_error_rad(&self) -> f64 {
        self.mean(4)
    }

    /// Returns the mean share of a motion that was done.
    #[must_use]
    pub fn done_share(&self) -> f64 {
        self.shares / f64::from(self.episodes.max(1))
    }

    /// Returns the number of episodes that reached the end of their motion.
    #[must_use]
    pub fn finished(&self) -> u32 {
        self.finished
    }

    /// Returns the greatest mean distance of the links within a second (m), and when that second begins in its motion (s);
    /// `None` if no episode lasted as long.
    #[must_use]
    pub fn worst_second(&self) -> Option<(f64, f64)> {
        self.worst
    }

    fn mean(&self, error: usize) -> f64 {
        self.errors[error] / f64::from(self.steps.max(1))
    }

    /// Adds the sums of other episodes.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        Self {
            episodes: self.episodes + other.episodes,
            steps: self.steps.saturating_add(other.steps),
            errors: std::array::from_fn(|error| self.errors[error] + other.errors[error]),
            shares: self.shares + other.shares,
            finished: self.finished + other.finished,
            worst: worse(self.worst, other.worst),
        }
    }
}

fn worse(one: Option<(f64, f64)>, other: Option<(f64, f64)>) -> Option<(f64, f64)> {
    [one, other].into_iter().flatten().max_by(|(one, _), (other, _)| one.total_cmp(other))
}

/// Accumulates the steps of one episode.
#[derive(Clone, Debug)]
pub struct Imitator {
    window_steps: u32,
    /// Errors of the links in the present window (m), and when it began (s).
    window: (f64, f64),
    sums: Imitation,
}

impl Imitator {
    /// Begins an episode; `None` if the task has no motions.
    #[must_use]
    pub fn of(environment: &Environment) -> Option<Self> {
        task(environment)?;
        let window_steps = (WINDOW_S / environment.control_step_s()).round().max(1.0) as u32;
        Some(Self { window_steps, window: (0.0, 0.0), sums: Imitation { episodes: 1, ..Imitation::default() } })
    }

    /// Adds the control step that an environment has made.
    pub fn record(&mut self, environment: &Environment) {
        let Some(task) = task(environment) else { return };
        let MotionErrors { anchor_m, anchor_rad, body_m, body_rad, hinge_rad } = *task.errors();
        let (_, time_s, duration_s) = task.place(environment.physics());
        let sums = &mut self.sums;
        if sums.steps.is_multiple_of(self.window_steps) {
            self.window = (0.0, (time_s - environment.control_step_s()).max(0.0));
        }
        for (sum, error) in sums.errors.iter_mut().zip([anchor_m, anchor_rad, body_m, body_rad, hinge_rad]) {
            *sum += error;
        }
        sums.steps += 1;
        sums.shares = time_s / duration_s;
        self.window.0 += body_m;
        if sums.steps.is_multiple_of(self.window_steps) {
            sums.worst = worse(sums.worst, Some((self.window.0 / f64::from(self.window_steps), self.window.1)));
        }
    }

    /// Ends the episode and returns its sums.
    #[must_use]
    pub fn end(mut self, has_fallen: bool) -> Imitation {
        if !has_fallen {
            self.sums.finished = 1;
            self.sums.shares = 1.0;
        }
        self.sums
    }
}

fn task(environment: &Environment) -> Option<&MotionTask> {
    let task: &dyn Any = environment.task();
    task.downcast_ref()
}
