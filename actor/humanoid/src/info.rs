//! Details of one control step, under Gymnasium's names.

use std::fmt;

use crate::config::EnvTask;
use crate::model::TENDONS_MAX;

/// One number per tendon of a model, without allocation.
#[derive(Clone, Copy, Default, PartialEq)]
pub struct PerTendon {
    numbers: [f64; TENDONS_MAX],
    count: usize,
}

impl PerTendon {
    /// Returns the numbers.
    #[must_use]
    pub fn as_slice(&self) -> &[f64] {
        &self.numbers[..self.count]
    }
}

impl FromIterator<f64> for PerTendon {
    /// Takes the first [`TENDONS_MAX`] numbers; no model has more tendons.
    fn from_iter<I: IntoIterator<Item = f64>>(numbers: I) -> Self {
        let mut all = Self::default();
        for (slot, number) in all.numbers.iter_mut().zip(numbers) {
            *slot = number;
            all.count += 1;
        }
        all
    }
}

impl fmt::Debug for PerTendon {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.as_slice().fmt(formatter)
    }
}

/// Details of one control step of Gymnasium's tasks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepInfo {
    /// Position along x (m): of the torso, or with [`EnvTask::HumanoidV4`] of the whole humanoid's centre of mass.
    pub x_position_m: f64,
    /// Position along y (m), of the same point.
    pub y_position_m: f64,
    /// Horizontal distance of that point from the world's origin (m).
    pub distance_from_origin_m: f64,
    /// Mean velocity of the whole humanoid's centre of mass along x during the step (m/s).
    pub x_velocity_mps: f64,
    /// Mean velocity of the whole humanoid's centre of mass along y during the step (m/s).
    pub y_velocity_mps: f64,
    /// Length of each tendon (rad): weighted sum of hinge angles.
    pub tendon_length_rad: PerTendon,
    /// Velocity of each tendon (rad/s).
    pub tendon_velocity_radps: PerTendon,
    /// Reward for a healthy posture.
    pub reward_survive: f64,
    /// Reward for forward motion.
    pub reward_forward: f64,
    /// Negative cost of the controls.
    pub reward_ctrl: f64,
    /// Negative cost of contacts; always 0 with [`EnvTask::HumanoidV4`].
    pub reward_contact: f64,
}

/// Value of one entry of Gymnasium's `info`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InfoValue<'a> {
    /// One number.
    Number(f64),
    /// One number per tendon.
    Numbers(&'a [f64]),
}

type Entry = (&'static str, for<'a> fn(&'a StepInfo) -> InfoValue<'a>);

const X_POSITION: Entry = ("x_position", |info| InfoValue::Number(info.x_position_m));
const Y_POSITION: Entry = ("y_position", |info| InfoValue::Number(info.y_position_m));
const TENDON_LENGTH: Entry = ("tendon_length", |info| InfoValue::Numbers(info.tendon_length_rad.as_slice()));
const TENDON_VELOCITY: Entry = ("tendon_velocity", |info| InfoValue::Numbers(info.tendon_velocity_radps.as_slice()));
const DISTANCE: Entry = ("distance_from_origin", |info| InfoValue::Number(info.distance_from_origin_m));
const X_VELOCITY: Entry = ("x_velocity", |info| InfoValue::Number(info.x_velocity_mps));
const Y_VELOCITY: Entry = ("y_velocity", |info| InfoValue::Number(info.y_velocity_mps));

/// Entries that `step` of `humanoid_v5.py` returns; `reset` returns the first five.
const V5: [Entry; 11] = [
    X_POSITION,
    Y_POSITION,
    TENDON_LENGTH,
    TENDON_VELOCITY,
    DISTANCE,
    X_VELOCITY,
    Y_VELOCITY,
    ("reward_survive", |info| InfoValue::Number(info.reward_survive)),
    ("reward_forward", |info| InfoValue::Number(info.reward_forward)),
    ("reward_ctrl", |info| InfoValue::Number(info.reward_ctrl)),
    ("reward_contact", |info| InfoValue::Number(info.reward_contact)),
];
const V5_RESET: usize = 5;

/// Entries that `step` of `humanoid_v4.py` returns; `reset` returns none.
const V4: [Entry; 9] = [
    ("reward_linvel", |info| InfoValue::Number(info.reward_forward)),
    ("reward_quadctrl", |info| InfoValue::Number(info.reward_ctrl)),
    ("reward_alive", |info| InfoValue::Number(info.reward_survive)),
    X_POSITION,
    Y_POSITION,
    DISTANCE,
    X_VELOCITY,
    Y_VELOCITY,
    ("forward_reward", |info| InfoValue::Number(info.reward_forward)),
];

impl StepInfo {
    /// Returns the `info` of Gymnasium's `step` for this task, in Gymnasium's order.
    pub fn entries(&self, task: EnvTask) -> impl Iterator<Item = (&'static str, InfoValue<'_>)> {
        self.select(if task == EnvTask::HumanoidV4 { &V4[..] } else { &V5[..] })
    }

    /// Returns the `info` of Gymnasium's `reset` for this task.
    pub fn reset_entries(&self, task: EnvTask) -> impl Iterator<Item = (&'static str, InfoValue<'_>)> {
        self.select(if task == EnvTask::HumanoidV4 { &[] } else { &V5[..V5_RESET] })
    }

    fn select(&self, entries: &'static [Entry]) -> impl Iterator<Item = (&'static str, InfoValue<'_>)> {
        entries.iter().map(|(name, value)| (*name, value(self)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn info() -> StepInfo {
        StepInfo {
            x_position_m: 1.0,
            y_position_m: 2.0,
            distance_from_origin_m: 3.0,
            x_velocity_mps: 4.0,
            y_velocity_mps: 5.0,
            tendon_length_rad: [6.0, 7.0].into_iter().collect(),
            tendon_velocity_radps: [8.0, 9.0].into_iter().collect(),
            reward_survive: 10.0,
            reward_forward: 11.0,
            reward_ctrl: 12.0,
            reward_contact: 13.0,
        }
    }

    #[test]
    fn v5_entries_are_gymnasiums() {
        use InfoValue::{Number, Numbers};
        let info = info();
        let expected = [
            ("x_position", Number(1.0)),
            ("y_position", Number(2.0)),
            ("tendon_length", Numbers(&[6.0, 7.0])),
            ("tendon_velocity", Numbers(&[8.0, 9.0])),
            ("distance_from_origin", Number(3.0)),
            ("x_velocity", Number(4.0)),
            ("y_velocity", Number(5.0)),
            ("reward_survive", Number(10.0)),
            ("reward_forward", Number(11.0)),
            ("reward_ctrl", Number(12.0)),
            ("reward_contact", Number(13.0)),
        ];
        assert_eq!(info.entries(EnvTask::HumanoidV5).collect::<Vec<_>>(), expected);
        assert_eq!(info.reset_entries(EnvTask::HumanoidV5).collect::<Vec<_>>(), expected[..5]);
    }

    #[test]
    fn v4_entries_are_gymnasiums_with_none_on_reset() {
        let info = info();
        let names: Vec<_> = info.entries(EnvTask::HumanoidV4).collect();
        let number = |name| (name, InfoValue::Number(info.reward_forward));
        assert_eq!(names[0], number("reward_linvel"));
        assert_eq!(names[1], ("reward_quadctrl", InfoValue::Number(12.0)));
        assert_eq!(names[2], ("reward_alive", InfoValue::Number(10.0)));
        assert_eq!(names[8], number("forward_reward"));
        let rest: Vec<_> = names[3..8].iter().map(|(name, _)| *name).collect();
        assert_eq!(rest, ["x_position", "y_position", "distance_from_origin", "x_velocity", "y_velocity"]);
        assert_eq!(info.reset_entries(EnvTask::HumanoidV4).count(), 0);
    }

    #[test]
    fn per_tendon_ignores_excess_numbers() {
        let many: PerTendon = (0..100).map(f64::from).collect();
        assert_eq!(many.as_slice().len(), TENDONS_MAX);
        assert_eq!(PerTendon::default().as_slice(), &[] as &[f64]);
    }
}
