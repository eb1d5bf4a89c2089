//! The tasks of Humanoid-v5 and -v4: what a step is worth and when an episode is over. Pure functions, no state.
//!
//! Formulas are those of Gymnasium's `humanoid_v5.py` and `humanoid_v4.py`. They differ in three points: v4 charges
//! nothing for contact; it pays for health on every step while unhealthy steps end the episode, so also on the last one;
//! and its info tells where the centre of mass is, and not the torso.

use crate::config::{CONTROL_STEP_S, EnvironmentConfig, Task};
use crate::info::{PerTendon, StepInfo};

/// What the task needs to know about one control step.
#[derive(Clone, Copy, Debug)]
pub struct Transition<'a> {
    /// Whole-body centre of mass before the step: x and y (m).
    pub centre_before_m: [f64; 2],
    /// Whole-body centre of mass after the step: x and y (m).
    pub centre_after_m: [f64; 2],
    /// Torso position after the step: x, y, z (m).
    pub torso_m: [f64; 3],
    /// The controls that acted, one per motor, already clamped.
    pub controls: &'a [f32],
    /// Sum of squared contact forces (N²) and moments ((N·m)²) over all links.
    pub squared_contact_wrenches: f64,
    /// Length of each tendon after the step (rad).
    pub tendon_length_rad: PerTendon,
    /// Velocity of each tendon after the step (rad/s).
    pub tendon_velocity_radps: PerTendon,
    /// Control steps done in this episode, this one included.
    pub episode_steps: u32,
}

/// Result of one control step.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// Reward of the step.
    pub reward: f32,
    /// The episode ended, and the state it ended in has no future worth.
    pub terminated: bool,
    /// The episode was cut off by its time limit; the state it was cut in does have a future. Never with `terminated`.
    pub truncated: bool,
    /// The physics or the action was not finite; implies `terminated`.
    pub fault: bool,
    /// The step in detail.
    pub info: StepInfo,
}

/// Whether a torso height (m) is healthy: strictly between the two bounds.
#[must_use]
pub fn is_healthy(config: &EnvironmentConfig, torso_height_m: f64) -> bool {
    let [low, high] = config.healthy_z_range;
    low < torso_height_m && torso_height_m < high
}

/// Cost of a control vector: weight × Σ control².
#[must_use]
pub fn control_cost(config: &EnvironmentConfig, controls: &[f32]) -> f64 {
    let sum: f64 = controls.iter().map(|&control| f64::from(control).powi(2)).sum();
    config.ctrl_cost_weight * sum
}

/// Cost of the contact forces of a step: weight × Σ (force² + moment²), brought into its range; 0 in Humanoid-v4.
#[must_use]
pub fn contact_cost(config: &EnvironmentConfig, squared_contact_wrenches: f64) -> f64 {
    let [low, high] = config.contact_cost_range;
    match config.task {
        Task::HumanoidV5 => (config.contact_cost_weight * squared_contact_wrenches).max(low).min(high),
        Task::HumanoidV4 => 0.0,
    }
}

/// Reward for the posture that a step ended with.
#[must_use]
pub fn health_reward(config: &EnvironmentConfig, healthy: bool) -> f64 {
    let paid = match config.task {
        Task::HumanoidV5 => healthy,
        Task::HumanoidV4 => healthy || config.terminate_when_unhealthy,
    };
    if paid { config.healthy_reward } else { 0.0 }
}

/// Where the info says the body is: x and y (m) of the torso, or in Humanoid-v4 of the centre of mass.
#[must_use]
pub fn place_m(task: Task, torso_m: [f64; 2], centre_m: [f64; 2]) -> [f64; 2] {
    match task {
        Task::HumanoidV5 => torso_m,
        Task::HumanoidV4 => centre_m,
    }
}

/// Judges one control step.
#[must_use]
pub fn judge(config: &EnvironmentConfig, transition: &Transition<'_>) -> Step {
    let [torso_x_m, torso_y_m, height_m] = transition.torso_m;
    let [x_m, y_m] = place_m(config.task, [torso_x_m, torso_y_m], transition.centre_after_m);
    let [x_velocity_mps, y_velocity_mps] =
        [0, 1].map(|axis| (transition.centre_after_m[axis] - transition.centre_before_m[axis]) / CONTROL_STEP_S);
    let healthy = is_healthy(config, height_m);
    let info = StepInfo {
        x_position_m: x_m,
        y_position_m: y_m,
        distance_from_origin_m: x_m.hypot(y_m),
        x_velocity_mps,
        y_velocity_mps,
        tendon_length_rad: transition.tendon_length_rad,
        tendon_velocity_radps: transition.tendon_velocity_radps,
        reward_survive: health_reward(config, healthy),
        reward_forward: config.forward_reward_weight * x_velocity_mps,
        reward_ctrl: -control_cost(config, transition.controls),
        reward_contact: -contact_cost(config, transition.squared_contact_wrenches),
        torso_height_m: height_m,
    };
    let terminated = config.terminate_when_unhealthy && !healthy;
    let out_of_time = config.max_episode_steps > 0 && transition.episode_steps >= config.max_episode_steps;
    Step {
        reward: (info.reward_survive + info.reward_forward + info.reward_ctrl + info.reward_contact) as f32,
        terminated,
        truncated: out_of_time && !terminated,
        fault: false,
        info,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CONTROLS: [f32; 2] = [0.5, -0.25];

    fn transition(height_m: f64, episode_steps: u32) -> Transition<'static> {
        Transition {
            centre_before_m: [1.0, 2.0],
            centre_after_m: [1.03, 1.985],
            torso_m: [3.0, 4.0, height_m],
            controls: &CONTROLS,
            squared_contact_wrenches: 2.0e6,
            tendon_length_rad: [0.5, -0.5].into_iter().collect(),
            tendon_velocity_radps: [1.5, -1.5].into_iter().collect(),
            episode_steps,
        }
    }

    #[test]
    fn reward_is_the_sum_worked_out_by_hand() {
        let step = judge(&EnvironmentConfig::default(), &transition(1.4, 1));
        // 0.03 m in 0.015 s = 2 m/s; × 1.25 = 2.5. 0.1 × (0.25 + 0.0625) = 0.03125. 5e-7 × 2e6 = 1.
        assert!((step.info.x_velocity_mps - 2.0).abs() < 1e-9);
        assert!((step.info.y_velocity_mps + 1.0).abs() < 1e-9);
        assert!((step.info.reward_forward - 2.5).abs() < 1e-9);
        assert!((step.info.reward_ctrl + 0.031_25).abs() < 1e-9);
        assert!((step.info.reward_contact + 1.0).abs() < 1e-9);
        assert!((step.info.distance_from_origin_m - 5.0).abs() < 1e-12);
        assert!((f64::from(step.reward) - 6.468_75).abs() < 1e-6);
        assert!(!step.terminated && !step.truncated && !step.fault);
    }

    #[test]
    fn the_step_that_ends_unhealthy_is_not_paid_for_health() {
        for height in [1.0, 0.9, 2.0, 2.5] {
            let step = judge(&EnvironmentConfig::default(), &transition(height, 7));
            assert!(step.terminated && !step.truncated, "height {height}");
            assert_eq!(step.info.reward_survive, 0.0);
            assert!((f64::from(step.reward) - 1.468_75).abs() < 1e-6);
        }
    }

    #[test]
    fn without_termination_health_still_decides_the_pay() {
        let config = EnvironmentConfig { terminate_when_unhealthy: false, ..EnvironmentConfig::default() };
        let step = judge(&config, &transition(0.5, 7));
        assert!(!step.terminated);
        assert_eq!(step.info.reward_survive, 0.0);
    }

    #[test]
    fn time_runs_out_on_the_last_step_and_not_before() {
        let config = EnvironmentConfig { max_episode_steps: 10, ..EnvironmentConfig::default() };
        assert!(!judge(&config, &transition(1.4, 9)).truncated);
        let last = judge(&config, &transition(1.4, 10));
        assert!(last.truncated && !last.terminated);
        assert_eq!(last.info.reward_survive, 5.0);
    }

    #[test]
    fn falling_on_the_last_step_is_a_fall_and_not_a_time_limit() {
        let config = EnvironmentConfig { max_episode_steps: 10, ..EnvironmentConfig::default() };
        let step = judge(&config, &transition(0.9, 10));
        assert!(step.terminated && !step.truncated);
    }

    #[test]
    fn no_time_limit_means_no_truncation() {
        let config = EnvironmentConfig { max_episode_steps: 0, ..EnvironmentConfig::default() };
        assert!(!judge(&config, &transition(1.4, u32::MAX)).truncated);
    }

    #[test]
    fn contact_cost_stays_within_its_range() {
        let config = EnvironmentConfig::default();
        assert!((contact_cost(&config, 2.0e7) - 10.0).abs() < 1e-12);
        assert!((contact_cost(&config, 1.0e12) - 10.0).abs() < 1e-12);
        assert!((contact_cost(&config, 1.0e7) - 5.0).abs() < 1e-12);
        assert_eq!(contact_cost(&config, 0.0), 0.0);
        let narrow = EnvironmentConfig { contact_cost_range: [0.25, 0.5], ..config.clone() };
        assert_eq!(contact_cost(&narrow, 0.0), 0.25);
        assert_eq!(contact_cost(&narrow, 1.0e7), 0.5);
        let open = EnvironmentConfig { contact_cost_range: [0.0, f64::INFINITY], ..config };
        assert!((contact_cost(&open, 1.0e9) - 500.0).abs() < 1e-9);
    }

    #[test]
    fn v4_pays_for_health_on_the_last_step_and_charges_nothing_for_contact() {
        let config = EnvironmentConfig { task: Task::HumanoidV4, ..EnvironmentConfig::default() };
        let step = judge(&config, &transition(0.9, 7));
        assert!(step.terminated);
        assert_eq!(step.info.reward_survive, 5.0);
        assert_eq!(step.info.reward_contact, 0.0);
        // 2.5 for going forward, 5 for health, 0.03125 for control.
        assert!((f64::from(step.reward) - 7.468_75).abs() < 1e-6);

        let lenient = EnvironmentConfig { terminate_when_unhealthy: false, ..config };
        assert_eq!(judge(&lenient, &transition(0.9, 7)).info.reward_survive, 0.0);
        assert_eq!(judge(&lenient, &transition(1.4, 7)).info.reward_survive, 5.0);
    }

    #[test]
    fn v5_tells_where_the_torso_is_and_v4_where_the_centre_of_mass_is() {
        let place = |task| {
            let info = judge(&EnvironmentConfig { task, ..EnvironmentConfig::default() }, &transition(1.4, 7)).info;
            [info.x_position_m, info.y_position_m, info.distance_from_origin_m]
        };
        assert_eq!(place(Task::HumanoidV5), [3.0, 4.0, 5.0]);
        assert_eq!(place(Task::HumanoidV4), [1.03, 1.985, 1.03f64.hypot(1.985)]);
    }

    #[test]
    fn tendons_are_passed_on() {
        let info = judge(&EnvironmentConfig::default(), &transition(1.4, 7)).info;
        assert_eq!(info.tendon_length_rad.as_slice(), [0.5, -0.5]);
        assert_eq!(info.tendon_velocity_radps.as_slice(), [1.5, -1.5]);
    }
}
