//! How well a robot follows its commands: tracking errors, energy, foot slip.
//!
//! A change of command or a push starts a wait of one second. From then on the time is cut into windows of one second, until
//! the next change or push. The error of a window is that of its mean velocity, so that the sway of each stride cancels.

use treadmill_humanoid::{Physics, task::velocity::Foot};

use crate::poses::heading_velocity;

/// Length of a window, and of the wait before the first one (s).
const WINDOW_S: f64 = 1.0;

/// What one control step contributes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TrackingSample {
    /// Velocity of the base in the heading frame after the step, forward and left (m/s), and its yaw rate (rad/s).
    pub motion: [f64; 3],
    /// Command that the policy observed before the step, in the same units.
    pub command: [f64; 3],
    /// Whether this command replaced another one just before the step.
    pub is_new_command: bool,
    /// Whether a push began the step.
    pub is_pushed: bool,
    /// Mechanical power of the motors without sign, at the end of the step (W).
    pub power_w: f64,
    /// Horizontal path of the base in the step (m).
    pub path_m: f64,
    /// Sum of the horizontal speeds of the feet that stand (m/s).
    pub slip_mps: f64,
    /// Number of feet that stand.
    pub standing: u32,
}

impl TrackingSample {
    /// Returns the sample of a robot after a step that began with its base at `from_m`; command, change and push are
    /// default.
    #[must_use]
    pub fn of(physics: &Physics, from_m: [f64; 2]) -> Self {
        let position = physics.position();
        let powers = physics.joint_torques_nm().iter().zip(physics.joint_rates()).map(|(torque, rate)| torque * rate);
        let feet = physics.model().robot.iter().flat_map(|robot| &robot.feet);
        let standing = feet.map(|link| Foot::now(physics, *link, 0.0)).filter(|foot| foot.stands);
        let (mut slip_mps, mut count) = (0.0, 0);
        standing.for_each(|foot| {
            slip_mps += foot.velocity_mps.xy().norm();
            count += 1;
        });
        Self {
            motion: heading_velocity(physics),
            power_w: powers.map(f64::abs).sum(),
            path_m: (position[0] - from_m[0]).hypot(position[1] - from_m[1]),
            slip_mps,
            standing: count,
            ..Self::default()
        }
    }
}

/// Sums over the control steps of one or more episodes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tracking {
    /// Complete windows.
    pub windows: u32,
    /// Pushes.
    pub pushes: u32,
    velocity_errors_mps: f64,
    yaw_rate_errors_radps: f64,
    energy_j: f64,
    path_m: f64,
    slips_mps: f64,
    standing: u32,
}

impl Tracking {
    /// Returns the mean error of the horizontal velocity over all windows (m/s); `None` without a window.
    #[must_use]
    pub fn velocity_error_mps(&self) -> Option<f64> {
        ratio(self.velocity_errors_mps, self.windows.into())
    }

    /// Returns the mean error of the yaw rate over all windows (rad/s); `None` without a window.
    #[must_use]
    pub fn yaw_rate_error_radps(&self) -> Option<f64> {
        ratio(self.yaw_rate_errors_radps, self.windows.into())
    }

    /// Returns the energy per path length of the base (J/m); `None` if it did not move.
    #[must_use]
    pub fn energy_per_metre_jpm(&self) -> Option<f64> {
        ratio(self.energy_j, self.path_m)
    }

    /// Returns the mean horizontal speed of the feet that stand (m/s); `None` if none stood.
    #[must_use]
    pub fn foot_slip_mps(&self) -> Option<f64> {
        ratio(self.slips_mps, self.standing.into())
    }

    /// Adds the sums of other episodes.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        Self {
            windows: self.windows + other.windows,
            pushes: self.pushes + other.pushes,
            velocity_errors_mps: self.velocity_errors_mps + other.velocity_errors_mps,
            yaw_rate_errors_radps: self.yaw_rate_errors_radps + other.yaw_rate_errors_radps,
            energy_j: self.energy_j + other.energy_j,
            path_m: self.path_m + other.path_m,
            slips_mps: self.slips_mps + other.slips_mps,
            standing: self.standing.saturating_add(other.standing),
        }
    }
}

fn ratio(sum: f64, by: f64) -> Option<f64> {
    (by > 0.0).then(|| sum / by)
}

/// Accumulates the steps of one episode.
#[derive(Clone, Debug)]
pub struct Tracker {
    control_step_s: f64,
    window_steps: u32,
    /// Control steps since the last change of command or push.
    undisturbed_steps: u32,
    /// Sums of motion minus command over the steps of the present window.
    differences: [f64; 3],
    sums: Tracking,
}

impl Tracker {
    /// Begins an episode with control steps of this length (s).
    #[must_use]
    pub fn new(control_step_s: f64) -> Self {
        Self {
            control_step_s,
            window_steps: (WINDOW_S / control_step_s).round().max(1.0) as u32,
            undisturbed_steps: 0,
            differences: [0.0; 3],
            sums: Tracking::default(),
        }
    }

    /// Adds the next control step. The first one of an episode counts as a change of command.
    pub fn record(&mut self, sample: &TrackingSample) {
        let sums = &mut self.sums;
        sums.pushes += u32::from(sample.is_pushed);
        sums.energy_j += sample.power_w * self.control_step_s;
        sums.path_m += sample.path_m;
        sums.slips_mps += sample.slip_mps;
        sums.standing = sums.standing.saturating_add(sample.standing);

        if sample.is_new_command || sample.is_pushed {
            self.undisturbed_steps = 0;
        }
        if self.undisturbed_steps.is_multiple_of(self.window_steps) {
            self.differences = [0.0; 3];
        }
        for (sum, (found, wanted)) in self.differences.iter_mut().zip(sample.motion.iter().zip(sample.command)) {
            *sum += found - wanted;
        }
        self.undisturbed_steps += 1;
        let windows = self.undisturbed_steps / self.window_steps;
        // The first second is the wait.
        if windows > 1 && self.undisturbed_steps.is_multiple_of(self.window_steps) {
            let [forward, left, yaw] = self.differences.map(|sum| sum / f64::from(self.window_steps));
            sums.windows += 1;
            sums.velocity_errors_mps += forward.hypot(left);
            sums.yaw_rate_errors_radps += yaw.abs();
        }
    }

    /// Returns the sums so far.
    #[must_use]
    pub fn sums(&self) -> Tracking {
        self.sums
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Plays samples of 0.25 s: a window has four steps.
    fn played(samples: &[TrackingSample]) -> Tracking {
        let mut tracker = Tracker::new(0.25);
        samples.iter().for_each(|sample| tracker.record(sample));
        tracker.sums()
    }

    fn moving(motion: [f64; 3], command: [f64; 3]) -> TrackingSample {
        TrackingSample { motion, command, ..TrackingSample::default() }
    }

    fn close(found: Option<f64>, expected: f64) {
        assert!(found.is_some_and(|found| (found - expected).abs() < 1e-12), "{found:?} instead of {expected}");
    }

    #[test]
    fn errors_are_those_of_the_means_over_windows_after_the_first_second() {
        let wait = [moving([9.0, 9.0, 9.0], [0.0; 3]); 4];
        // Sways by 1 m/s about 0.7 and −0.4 instead of 1.0 and 0.0, and turns by 0.1 on average instead of 0.3.
        let sway = [
            moving([1.7, -1.4, 0.4], [1.0, 0.0, 0.2]),
            moving([-0.3, 0.6, -0.2], [1.0, 0.0, 0.4]),
            moving([1.7, -1.4, 0.4], [1.0, 0.0, 0.2]),
            moving([-0.3, 0.6, -0.2], [1.0, 0.0, 0.4]),
        ];
        let still = [moving([0.0; 3], [0.6, 0.8, -0.4]); 4];
        assert_eq!(played(&wait).windows, 0);
        assert_eq!(played(&wait).velocity_error_mps(), None);
        let one = played(&[wait, sway].concat());
        assert_eq!(one.windows, 1);
        close(one.velocity_error_mps(), 0.5);
        close(one.yaw_rate_error_radps(), 0.2);
        // The last window is incomplete.
        let two = played(&[&[wait, sway, still].concat()[..], &wait[..3]].concat());
        assert_eq!(two.windows, 2);
        close(two.velocity_error_mps(), 0.75);
        close(two.yaw_rate_error_radps(), 0.3);
    }

    #[test]
    fn a_change_of_command_and_a_push_discard_their_window_and_begin_the_wait_anew() {
        let off = |speed| moving([speed, 0.0, 0.0], [0.0; 3]);
        for disturbed in
            [TrackingSample { is_new_command: true, ..off(7.0) }, TrackingSample { is_pushed: true, ..off(7.0) }]
        {
            // Wait, one window, three steps of another one.
            let before = [&[off(5.0); 4][..], &[off(1.0); 4], &[off(5.0); 3]].concat();
            let after = [&[disturbed][..], &[off(5.0); 3], &[off(2.0); 4]].concat();
            let tracking = played(&[before.clone(), after.clone()].concat());
            assert_eq!(tracking.windows, 2, "{disturbed:?}");
            close(tracking.velocity_error_mps(), 1.5);
            assert_eq!(tracking.pushes, u32::from(disturbed.is_pushed));
            assert_eq!(played(&[before, after[..7].to_vec()].concat()).windows, 1);
        }
    }

    #[test]
    fn energy_slip_and_episodes_add_up() {
        let none = played(&[TrackingSample::default(); 3]);
        assert_eq!((none.energy_per_metre_jpm(), none.foot_slip_mps()), (None, None));
        let step =
            TrackingSample { power_w: 40.0, path_m: 0.1, slip_mps: 0.3, standing: 2, ..TrackingSample::default() };
        let single = TrackingSample { slip_mps: 0.6, standing: 1, ..step };
        // Two steps of 0.25 s: 20 J over 0.2 m; 0.9 m/s over three standing feet.
        let sums = played(&[step, single]);
        close(sums.energy_per_metre_jpm(), 100.0);
        close(sums.foot_slip_mps(), 0.3);
        let both = sums.with(played(&[single]));
        close(both.energy_per_metre_jpm(), 100.0);
        close(both.foot_slip_mps(), 1.5 / 4.0);
    }

    #[test]
    fn a_second_is_rounded_to_control_steps() {
        for (control_step_s, steps) in [(0.02, 50), (0.015, 67), (0.3, 3), (2.0, 1)] {
            let mut tracker = Tracker::new(control_step_s);
            (0..2 * steps - 1).for_each(|_| tracker.record(&TrackingSample::default()));
            assert_eq!(tracker.sums().windows, 0, "{control_step_s}");
            tracker.record(&TrackingSample::default());
            assert_eq!(tracker.sums().windows, 1, "{control_step_s}");
        }
    }
}
