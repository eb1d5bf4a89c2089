//! Observation: its terms, and their numbers.

use std::f64::consts::TAU;

use super::feet::FEET;
use super::rewards::BaseMotion;
use super::scan::{SCAN_MAX_M, SCAN_POINTS, ground_around};
use super::{ObservationTerm, VelocityTask};
use crate::config::VelocityConfig;
use crate::physics::Physics;
use crate::randomisation::SensorNoise;

/// Heights of the ground around the base.
const SCAN: (&str, usize) = ("height_scan", SCAN_POINTS);

/// Returns the terms of an observation: those of the policy, each with its history, then those of the critic alone.
pub(super) fn observation_terms(config: &VelocityConfig, actions: usize, has_ground: bool) -> Vec<ObservationTerm> {
    let of_policy = [
        ("base_ang_vel", 3),
        ("projected_gravity", 3),
        ("velocity_commands", 3),
        ("joint_pos_rel", actions),
        ("joint_vel_rel", actions),
        ("last_action", actions),
        ("gait_phase", 2),
        SCAN,
    ];
    let of_critic = [
        ("base_lin_vel", 3),
        ("base_height", 1),
        ("feet_contact", FEET),
        ("feet_air_time", FEET),
        ("feet_lift", FEET),
        SCAN,
    ];
    let with_scan = |terms: usize, has_scan: bool| terms - usize::from(!has_scan);
    let of_policy = &of_policy[..with_scan(of_policy.len(), config.height_scan)];
    let of_critic = &of_critic[..with_scan(of_critic.len(), has_ground)];
    let history = config.history as usize;
    let rows = (0..history).flat_map(|_| of_policy).map(|term| (term, false));
    let mut end = 0;
    rows.chain(of_critic.iter().map(|term| (term, true)))
        .map(|((name, size), is_privileged)| {
            let start = end;
            end += size;
            ObservationTerm { name: (*name).to_owned(), range: start..end, is_privileged }
        })
        .collect()
}

impl VelocityTask {
    /// Writes what the policy observes now.
    pub(super) fn write_row(&self, physics: &Physics, noise: &mut SensorNoise, row: &mut [f32]) {
        let base = self.base(physics);
        let mut numbers = row.iter_mut();
        let mut write = |number: f64| *numbers.next().expect("the terms fill the row") = number as f32;
        base.angular_radps.iter().for_each(|rate| write(rate + noise.velocity()));
        base.gravity.iter().for_each(|part| write(part + noise.position()));
        self.command.numbers().into_iter().for_each(&mut write);
        for (hinge, default_rad, _) in &self.motors {
            let error_rad = self.encoder_errors_rad[*hinge] + noise.position();
            write(physics.joint_angles()[*hinge] - default_rad + error_rad);
        }
        for (hinge, _, _) in &self.motors {
            write(physics.joint_rates()[*hinge] + noise.velocity());
        }
        self.actions.iter().for_each(|action| write(*action));
        let (sin, cos) = (TAU * self.time_s() / self.config.gait_period_s).sin_cos();
        [sin, cos].into_iter().for_each(&mut write);
        if self.config.height_scan {
            self.scanned(physics, &base).for_each(|height_m| write(height_m + noise.position()));
        }
    }

    /// Writes what only the critic observes.
    pub(super) fn write_privileged(&self, physics: &Physics, row: &mut [f32]) {
        let base = self.base(physics);
        let mut numbers = row.iter_mut();
        let mut write = |number: f64| *numbers.next().expect("the terms fill the row") = number as f32;
        base.velocity_mps.iter().for_each(|part| write(*part));
        write(base.height_m);
        self.feet.iter().for_each(|foot| write(f64::from(u8::from(foot.stands))));
        self.feet.iter().for_each(|foot| write(foot.air_s));
        self.feet.iter().for_each(|foot| write(foot.lift_m));
        if self.ground.is_some() {
            self.scanned(physics, &base).for_each(&mut write);
        }
    }

    /// Returns how much higher the ground around the base is than where the robot would stand in the default pose (m).
    fn scanned(&self, physics: &Physics, base: &BaseMotion) -> impl Iterator<Item = f64> {
        let position = physics.position();
        let standing_m = position[2] - self.body.height_m;
        ground_around(physics, [position[0], position[1]], base.heading_rad)
            .map(move |ground_m| (ground_m - standing_m).clamp(-SCAN_MAX_M, SCAN_MAX_M))
    }
}
