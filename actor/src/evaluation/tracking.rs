//! How well a robot follows its commands: tracking errors, energy, foot slip.
//!
//! A change of command or a push starts a wait of one second. From then on the time is cut into windows of one second, until
//! the next change or push. The error of a window is that of its mean velocity, so that the sway of each stride cancels.
//!
//! How still a robot stands is measured from two seconds after such a moment on, while the command says: stand.

use treadmill_humanoid::{
    Physics,
    task::velocity::{Command, Foot},
};

use crate::poses::heading_velocity;

/// Length of a window, and of the wait before the first one (s).
const WINDOW_S: f64 = 1.0;
/// Wait before a robot that is commanded to stand must stand still (s).
const STILL_AFTER_S: f64 = 2.0;

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
    /// Feet that stand, a bit for each.
    pub standing: u32,
    /// Where the base is, along x and y (m, world frame).
    pub place_m: [f64; 2],
    /// Mean square of the hinges' rates (rad²/s²).
    pub rates_radps2: f64,
}

impl TrackingSample {
    /// Returns the sample of a robot after a step that began with its base at `from_m`; command, change and push are
    /// default.
    #[must_use]
    pub fn of(physics: &Physics, from_m: [f64; 2]) -> Self {
        let position = physics.position();
        let powers = physics.joint_torques_nm().iter().zip(physics.joint_rates()).map(|(torque, rate)| torque * rate);
        let feet = physics.model().robot.iter().flat_map(|robot| &robot.feet);
        let feet = feet.map(|link| Foot::now(physics, *link, 0.0)).enumerate().filter(|(_, foot)| foot.stands);
        let (mut slip_mps, mut standing) = (0.0, 0);
        feet.for_each(|(index, foot)| {
            slip_mps += foot.velocity_mps.xy().norm();
            standing |= 1 << index;
        });
        let rates = physics.joint_rates();
        Self {
            motion: heading_velocity(physics),
            power_w: powers.map(f64::abs).sum(),
            path_m: (position[0] - from_m[0]).hypot(position[1] - from_m[1]),
            slip_mps,
            standing,
            place_m: [position[0], position[1]],
            rates_radps2: rates.iter().map(|rate| rate * rate).sum::<f64>() / rates.len().max(1) as f64,
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
    /// While the robot must stand still: times that it had to, control steps, their duration (s), squares of the hinges'
    /// rates (rad²/s²), feet that were lifted, and largest distances from where it stood first (m).
    rests: u32,
    still_steps: u32,
    still_s: f64,
    still_rates_radps2: f64,
    lifts: u32,
    drifts_m: f64,
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

    /// Returns how far the base goes from where it stood 2 s after a command to stand (m), until the next one; the mean of
    /// the largest distances. `None` if no command to stand lasted.
    #[must_use]
    pub fn standing_drift_m(&self) -> Option<f64> {
        ratio(self.drifts_m, self.rests.into())
    }

    /// Returns the root mean square of the hinges' rates from 2 s after a command to stand on (rad/s).
    #[must_use]
    pub fn standing_hinge_radps(&self) -> Option<f64> {
        ratio(self.still_rates_radps2, self.still_steps.into()).map(f64::sqrt)
    }

    /// Returns how often a foot is lifted from 2 s after a command to stand on (1/s).
    #[must_use]
    pub fn standing_lifts_per_s(&self) -> Option<f64> {
        ratio(self.lifts.into(), self.still_s)
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
            rests: self.rests + other.rests,
            still_steps: self.still_steps + other.still_steps,
            still_s: self.still_s + other.still_s,
            still_rates_radps2: self.still_rates_radps2 + other.still_rates_radps2,
            lifts: self.lifts + other.lifts,
            drifts_m: self.drifts_m + other.drifts_m,
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
    /// First place of the present rest, and the largest distance from it (m).
    rest: Option<([f64; 2], f64)>,
    /// Feet that stood after the step before.
    stood: u32,
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
            rest: None,
            stood: 0,
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
        sums.standing = sums.standing.saturating_add(sample.standing.count_ones());

        if sample.is_new_command || sample.is_pushed {
            self.undisturbed_steps = 0;
        }
        self.record_rest(sample);
        let sums = &mut self.sums;
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

    /// Adds a step in which the robot must stand still.
    fn record_rest(&mut self, sample: &TrackingSample) {
        let stood = std::mem::replace(&mut self.stood, sample.standing);
        let waited_s = f64::from(self.undisturbed_steps) * self.control_step_s;
        if !Command::from_numbers(sample.command).stands() || waited_s < STILL_AFTER_S {
            self.rest = None;
            return;
        }
        let sums = &mut self.sums;
        let (first_m, furthest_m) = self.rest.unwrap_or_else(|| {
            sums.rests += 1;
            (sample.place_m, 0.0)
        });
        let drift_m = (sample.place_m[0] - first_m[0]).hypot(sample.place_m[1] - first_m[1]).max(furthest_m);
        self.rest = Some((first_m, drift_m));
        sums.drifts_m += drift_m - furthest_m;
        sums.still_steps += 1;
        sums.still_s += self.control_step_s;
        sums.still_rates_radps2 += sample.rates_radps2;
        sums.lifts += (stood & !sample.standing).count_ones();
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
            TrackingSample { power_w: 40.0, path_m: 0.1, slip_mps: 0.3, standing: 0b11, ..TrackingSample::default() };
        let single = TrackingSample { slip_mps: 0.6, standing: 0b10, ..step };
        // Two steps of 0.25 s: 20 J over 0.2 m; 0.9 m/s over three standing feet.
        let sums = played(&[step, single]);
        close(sums.energy_per_metre_jpm(), 100.0);
        close(sums.foot_slip_mps(), 0.3);
        let both = sums.with(played(&[single]));
        close(both.energy_per_metre_jpm(), 100.0);
        close(both.foot_slip_mps(), 1.5 / 4.0);
    }

    #[test]
    fn a_robot_that_is_to_stand_is_measured_after_two_seconds() {
        let stands = |x, rates_radps2, standing| TrackingSample {
            place_m: [x, 0.0],
            rates_radps2,
            standing,
            ..TrackingSample::default()
        };
        let wait = [stands(9.0, 100.0, 0b01); 8];
        // It goes 0.3 m away and comes back; one foot leaves the ground twice, the other one once.
        let rest = [stands(1.0, 0.0, 0b11), stands(1.3, 1.0, 0b10), stands(1.1, 0.0, 0b01), stands(1.0, 3.0, 0b00)];
        let walks = TrackingSample { command: [0.1, 0.0, 0.0], is_new_command: true, ..stands(50.0, 9.0, 0b10) };
        let none = played(&[&wait[..], &[walks; 12]].concat());
        assert_eq!(none.standing_drift_m(), None);
        assert_eq!((none.standing_hinge_radps(), none.standing_lifts_per_s()), (None, None));
        let one = played(&[&wait[..], &rest].concat());
        close(one.standing_drift_m(), 0.3);
        close(one.standing_hinge_radps(), 1.0);
        close(one.standing_lifts_per_s(), 3.0);
        // A push begins the wait anew, and the next rest somewhere else.
        let pushed = TrackingSample { is_pushed: true, ..wait[0] };
        let two = played(&[&wait[..], &rest, &[pushed], &wait[1..], &[stands(7.0, 4.0, 0b01)], &[walks]].concat());
        close(two.standing_drift_m(), 0.15);
        close(two.standing_hinge_radps(), 8.0_f64.sqrt() / 5.0_f64.sqrt());
        close(two.standing_lifts_per_s(), 3.0 / 1.25);
        close(one.with(two).standing_lifts_per_s(), 6.0 / 2.25);
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
