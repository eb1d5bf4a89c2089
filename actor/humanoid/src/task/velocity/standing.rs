//! Standing: when the gait rests, and what wakes it.

use nalgebra::Vector3;

use super::VelocityTask;
use crate::config::VelocityConfig;
use crate::physics::Physics;
use crate::randomisation::{stream, uniform};

/// Shares of the bounds of [`Calm`], one of which holds for an episode of training. With bounds that never change, policies
/// learn to rest just within them, and fall beside them.
const SHARES_IN_TRAINING: [f64; 2] = [0.5, 1.5];

/// When a robot whose gait rests is calm, by what its inertial sensor measures. A base that turns, as by a push or a stop
/// that tips it over, wakes the gait: from a rest, policies hardly learn to step. A tilt does not: some robots rest so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Calm {
    /// Largest angular velocity of the base (rad/s).
    pub rate_radps: f64,
    /// Time at rest after which its steps have died away (s).
    pub settled_s: f64,
    /// Largest angular velocity from then on (rad/s).
    pub settled_rate_radps: f64,
}

impl Calm {
    /// Returns the bounds for a gait, whose period is the robot's unit of time.
    #[must_use]
    pub fn of(config: &VelocityConfig) -> Self {
        let per_period = |turn_rad: f64| turn_rad / config.gait_period_s;
        Self { rate_radps: per_period(1.6), settled_s: config.gait_period_s, settled_rate_radps: per_period(0.32) }
    }

    /// Returns the bounds in an episode of training with this seed.
    pub fn in_training(self, seed: u64) -> Self {
        let share = uniform(&mut stream(seed, "calm"), SHARES_IN_TRAINING);
        let [rate_radps, settled_rate_radps] = [self.rate_radps, self.settled_rate_radps].map(|bound| share * bound);
        Self { rate_radps, settled_rate_radps, ..self }
    }

    /// Returns whether a robot is disturbed after so long at rest.
    pub fn is_disturbed(&self, angular_radps: &Vector3<f64>, rested_s: f64) -> bool {
        let rate_radps = if rested_s < self.settled_s { self.rate_radps } else { self.settled_rate_radps };
        angular_radps.norm() > rate_radps
    }
}

/// How long a robot has been asked to stand.
#[derive(Clone, Copy, Debug, Default)]
pub struct Standing {
    /// Observations since then, or since the last disturbance at rest, with the present one.
    pub steps: u32,
}

impl Standing {
    /// Returns the time with another observation.
    pub fn after(self, stands: bool, is_disturbed: bool) -> Self {
        let steps = if is_disturbed { 0 } else { self.steps };
        Self { steps: if stands { steps.saturating_add(1) } else { 0 } }
    }

    /// Returns how long its gait has rested (s); `None` if it does not.
    pub fn rested_s(self, config: &VelocityConfig, step_s: f64) -> Option<f64> {
        let rested_s = f64::from(self.steps.checked_sub(1)?) * step_s - config.gait_rests_after_s;
        (config.gait_rests && rested_s >= 0.0).then_some(rested_s)
    }
}

impl VelocityTask {
    /// Returns how long the gait has rested (s); `None` if it does not, and the policy sees its phase.
    pub(super) fn rested_s(&self) -> Option<f64> {
        self.standing.rested_s(&self.config, self.step_s).filter(|_| self.command.stands())
    }

    /// Returns whether a robot at rest is disturbed.
    pub(super) fn is_disturbed(&self, physics: &Physics) -> bool {
        self.rested_s().is_some_and(|rested_s| {
            let calm = Calm::of(&self.config);
            let calm = if self.in_training { calm.in_training(self.seed) } else { calm };
            let velocity = physics.velocity();
            calm.is_disturbed(&Vector3::new(velocity[3], velocity[4], velocity[5]), rested_s)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_disturbance_begins_the_time_at_rest_anew() {
        let config = VelocityConfig { gait_rests: true, gait_rests_after_s: 0.04, ..VelocityConfig::default() };
        let standing = |steps: u32| Standing { steps };
        assert_eq!(
            [(true, false), (true, true), (false, false)].map(|(s, d)| standing(4).after(s, d).steps),
            [5, 1, 0]
        );
        assert_eq!(
            [0, 2, 3, 5].map(|steps| standing(steps).rested_s(&config, 0.02)),
            [None, None, Some(0.0), Some(0.04)]
        );
        assert_eq!(standing(5).rested_s(&VelocityConfig::default(), 0.02), None);
    }

    #[test]
    fn a_turn_disturbs_and_once_settled_a_slower_one() {
        // A period of 0.8 s: 2 rad/s, and 0.4 rad/s from then on.
        let calm = Calm::of(&VelocityConfig::default());
        let is_disturbed =
            |rate_radps: f64, rested_s: f64| calm.is_disturbed(&(rate_radps * Vector3::new(0.8, -0.6, 0.0)), rested_s);
        assert!(!is_disturbed(1.99, 0.0) && !is_disturbed(1.99, 0.79) && is_disturbed(2.01, 0.79));
        assert!(!is_disturbed(0.39, 0.81) && is_disturbed(0.41, 0.81));
        let shares: Vec<f64> = (0..100).map(|seed| calm.in_training(seed).rate_radps / calm.rate_radps).collect();
        assert!(shares.iter().all(|share| (0.5..=1.5).contains(share)));
        assert!(shares.iter().any(|share| *share < 0.6) && shares.iter().any(|share| *share > 1.4));
        let changed = calm.in_training(3);
        assert!((changed.settled_rate_radps / calm.settled_rate_radps - shares[3]).abs() < 1e-12);
    }
}
