//! Humanoid-v5 and -v4. Reward and end of an episode are pure functions.
//!
//! Formulas are those of Gymnasium's `humanoid_v5.py` and `humanoid_v4.py`. Version 4 differs in three points: it has no
//! contact cost; if unhealthy steps end the episode, it pays for health on every step, including the last; its info has the
//! position of the centre of mass instead of the torso's.

use super::{ObservationTerm, Step, StepEvaluation, Task};
use crate::config::{EnvConfig, EnvObservation, EnvTask, EnvironmentConfig};
use crate::info::{PerTendon, StepInfo};
use crate::model::Model;
use crate::model::mirror::{Mirror, SignedPermutation};
use crate::observation::{Observation, Sensed};
use crate::physics::Physics;
use crate::randomisation::SensorNoise;

/// Quantities of one control step that reward and termination depend on.
#[derive(Clone, Copy, Debug)]
pub struct Transition<'a> {
    /// Whole-body centre of mass before the step: x and y (m).
    pub centre_before_m: [f64; 2],
    /// Whole-body centre of mass after the step: x and y (m).
    pub centre_after_m: [f64; 2],
    /// Torso position after the step: x, y, z (m).
    pub torso_m: [f64; 3],
    /// Action as given, one control per motor.
    pub action: &'a [f32],
    /// Sum of squared contact forces (N²) and moments ((N·m)²) over all links.
    pub squared_contact_wrenches: f64,
    /// Length of each tendon after the step (rad).
    pub tendon_length_rad: PerTendon,
    /// Velocity of each tendon after the step (rad/s).
    pub tendon_velocity_radps: PerTendon,
}

/// Gymnasium's Humanoid-v5 or -v4.
pub struct HumanoidTask {
    config: EnvConfig,
    observation: Observation,
    /// State with sensor noise, if the observation shows more of it than positions and velocities.
    sensed: Option<Sensed>,
    info: StepInfo,
}

impl HumanoidTask {
    /// Returns the task of a configuration for the model of a simulation.
    #[must_use]
    pub fn new(config: &EnvironmentConfig, physics: &Physics) -> Self {
        let observation = Observation::new(&config.env, physics.model());
        let is_derived = config.randomisation.has_sensor_noise() && observation.has_derived_blocks();
        Self {
            config: config.env.clone(),
            sensed: is_derived.then(|| Sensed::new(physics)),
            observation,
            info: StepInfo::default(),
        }
    }

    /// Returns the info of the last step or reset.
    pub(crate) fn info(&self) -> StepInfo {
        self.info
    }
}

impl Task for HumanoidTask {
    fn terms(&self) -> &[ObservationTerm] {
        self.observation.terms()
    }

    fn begin(&mut self, _seed: u64, physics: &Physics) {
        let (position, centre) = (physics.position(), physics.centre_of_mass());
        let [x_m, y_m] = info_position_m(self.config.task, [position[0], position[1]], [centre.x, centre.y]);
        self.info = StepInfo {
            x_position_m: x_m,
            y_position_m: y_m,
            distance_from_origin_m: x_m.hypot(y_m),
            tendon_length_rad: tendon_values(physics.model(), physics.joint_angles()),
            tendon_velocity_radps: tendon_values(physics.model(), physics.joint_rates()),
            ..StepInfo::default()
        };
    }

    fn mirrored(&self, robot: &Mirror) -> Option<SignedPermutation> {
        let size = self.terms().last().map_or(0, |term| term.range.end);
        (self.config.observation == EnvObservation::Compact).then(|| robot.observation(size))
    }

    fn evaluate(&mut self, step: &Step<'_>) -> StepEvaluation {
        let Step { physics, action, centre_before_m: before } = *step;
        let after = physics.centre_of_mass();
        let position = physics.position();
        let transition = Transition {
            centre_before_m: [before.x, before.y],
            centre_after_m: [after.x, after.y],
            torso_m: [position[0], position[1], position[2]],
            action,
            squared_contact_wrenches: physics.squared_contact_wrenches(),
            tendon_length_rad: tendon_values(physics.model(), physics.joint_angles()),
            tendon_velocity_radps: tendon_values(physics.model(), physics.joint_rates()),
        };
        let (evaluation, info) = evaluate_step(&self.config, &transition);
        self.info = info;
        evaluation
    }

    fn reward_terms(&self, each: &mut dyn FnMut(&'static str, f64)) {
        each("survive", self.info.reward_survive);
        each("forward", self.info.reward_forward);
        each("ctrl", self.info.reward_ctrl);
        each("contact", self.info.reward_contact);
    }

    fn observe(&mut self, physics: &Physics, noise: &mut SensorNoise, observation: &mut [f32]) {
        self.observation.write(physics, observation);
        if noise.is_off() {
            return;
        }
        self.observation.add_noise(noise, observation);
        if let Some(sensed) = &mut self.sensed {
            self.observation.write_sensed(physics, sensed, observation);
        }
    }
}

fn tendon_values(model: &Model, hinges: &[f64]) -> PerTendon {
    model.tendons.iter().map(|tendon| tendon.sum_over(hinges)).collect()
}

/// Returns whether a torso height (m) is healthy: strictly between the two bounds.
#[must_use]
pub fn is_healthy(config: &EnvConfig, torso_height_m: f64) -> bool {
    let [low, high] = config.healthy_z_range;
    low < torso_height_m && torso_height_m < high
}

/// Returns the cost of an action: weight × Σ control².
///
/// It charges the controls as given, even beyond the motors' ranges, because Gymnasium does: MuJoCo clamps only the
/// copy that moves the motors, and `control_cost` of `humanoid_v5.py` sums over `data.ctrl`. Policies of this project
/// never pay more than the ranges allow: as in Stable-Baselines3, their actions are clipped before
/// (`Environment::action_from_shares`).
#[must_use]
pub fn control_cost(config: &EnvConfig, action: &[f32]) -> f64 {
    let sum: f64 = action.iter().map(|&control| f64::from(control).powi(2)).sum();
    config.ctrl_cost_weight * sum
}

/// Returns the cost of a step's contact forces: weight × Σ (force² + moment²), clamped to its range; 0 in Humanoid-v4.
#[must_use]
pub fn contact_cost(config: &EnvConfig, squared_contact_wrenches: f64) -> f64 {
    let [low, high] = config.contact_cost_range;
    match config.task {
        EnvTask::HumanoidV4 => 0.0,
        _ => (config.contact_cost_weight * squared_contact_wrenches).max(low).min(high),
    }
}

/// Returns the reward for the posture at the end of a step.
#[must_use]
pub fn health_reward(config: &EnvConfig, healthy: bool) -> f64 {
    if healthy || (config.task == EnvTask::HumanoidV4 && config.terminate_when_unhealthy) {
        config.healthy_reward
    } else {
        0.0
    }
}

/// Returns the position in the info: x and y (m) of the torso, or in Humanoid-v4 of the centre of mass.
#[must_use]
pub fn info_position_m(task: EnvTask, torso_m: [f64; 2], centre_m: [f64; 2]) -> [f64; 2] {
    if task == EnvTask::HumanoidV4 { centre_m } else { torso_m }
}

/// Computes reward, termination and info of one control step.
#[must_use]
pub fn evaluate_step(config: &EnvConfig, transition: &Transition<'_>) -> (StepEvaluation, StepInfo) {
    let [torso_x_m, torso_y_m, height_m] = transition.torso_m;
    let [x_m, y_m] = info_position_m(config.task, [torso_x_m, torso_y_m], transition.centre_after_m);
    let [x_velocity_mps, y_velocity_mps] =
        [0, 1].map(|axis| (transition.centre_after_m[axis] - transition.centre_before_m[axis]) / config.control_step_s);
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
        reward_ctrl: -control_cost(config, transition.action),
        reward_contact: -contact_cost(config, transition.squared_contact_wrenches),
    };
    let evaluation = StepEvaluation {
        // The cost of huge controls exceeds single precision.
        reward: (info.reward_survive + info.reward_forward + info.reward_ctrl + info.reward_contact)
            .clamp(f32::MIN.into(), f32::MAX.into()) as f32,
        terminated: config.terminate_when_unhealthy && !healthy,
        truncated: false,
    };
    (evaluation, info)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CONTROLS: [f32; 2] = [0.5, -0.25];

    fn transition(height_m: f64) -> Transition<'static> {
        Transition {
            centre_before_m: [1.0, 2.0],
            centre_after_m: [1.03, 1.985],
            torso_m: [3.0, 4.0, height_m],
            action: &CONTROLS,
            squared_contact_wrenches: 2.0e6,
            tendon_length_rad: [0.5, -0.5].into_iter().collect(),
            tendon_velocity_radps: [1.5, -1.5].into_iter().collect(),
        }
    }

    #[test]
    fn reward_matches_the_sum_computed_by_hand() {
        let (step, info) = evaluate_step(&EnvConfig::default(), &transition(1.4));
        // 0.03 m in 0.015 s = 2 m/s; × 1.25 = 2.5. 0.1 × (0.25 + 0.0625) = 0.03125. 5e-7 × 2e6 = 1.
        assert!((info.x_velocity_mps - 2.0).abs() < 1e-9);
        assert!((info.y_velocity_mps + 1.0).abs() < 1e-9);
        assert!((info.reward_forward - 2.5).abs() < 1e-9);
        assert!((info.reward_ctrl + 0.031_25).abs() < 1e-9);
        assert!((info.reward_contact + 1.0).abs() < 1e-9);
        assert!((info.distance_from_origin_m - 5.0).abs() < 1e-12);
        assert!((f64::from(step.reward) - 6.468_75).abs() < 1e-6);
        assert!(!step.terminated);
    }

    #[test]
    fn the_velocity_follows_the_control_step() {
        let config = EnvConfig { control_step_s: 0.03, ..EnvConfig::default() };
        let info = evaluate_step(&config, &transition(1.4)).1;
        assert!((info.x_velocity_mps - 1.0).abs() < 1e-9 && (info.y_velocity_mps + 0.5).abs() < 1e-9);
        assert!((info.reward_forward - 1.25).abs() < 1e-9);
    }

    #[test]
    fn controls_beyond_their_range_cost_what_they_cost_in_gymnasium() {
        // `reward_ctrl` of gymnasium.make("Humanoid-v5").step(action), with Gymnasium 1.4.0 and MuJoCo 4.0.0; v4 gives
        // the same.
        let action: [f32; 17] = std::array::from_fn(|motor| (0.1 * (-1f64).powi(motor as i32) * motor as f64) as f32);
        let cost = control_cost(&EnvConfig::default(), &action);
        assert!((cost - 1.496_000_005_394_221).abs() < 1e-12, "{cost}");
    }

    #[test]
    fn huge_controls_leave_the_reward_finite() {
        let (step, info) = evaluate_step(&EnvConfig::default(), &Transition { action: &[f32::MAX], ..transition(1.4) });
        assert!(step.reward == f32::MIN && info.reward_ctrl.is_finite());
    }

    #[test]
    fn v5_does_not_pay_for_health_on_an_unhealthy_last_step() {
        for height in [1.0, 0.9, 2.0, 2.5] {
            let (step, info) = evaluate_step(&EnvConfig::default(), &transition(height));
            assert!(step.terminated, "height {height}");
            assert_eq!(info.reward_survive, 0.0);
            assert!((f64::from(step.reward) - 1.468_75).abs() < 1e-6);
        }
    }

    #[test]
    fn without_termination_an_unhealthy_step_has_no_health_reward() {
        let config = EnvConfig { terminate_when_unhealthy: false, ..EnvConfig::default() };
        let (step, info) = evaluate_step(&config, &transition(0.5));
        assert!(!step.terminated);
        assert_eq!(info.reward_survive, 0.0);
    }

    #[test]
    fn contact_cost_stays_within_its_range() {
        let config = EnvConfig::default();
        assert!((contact_cost(&config, 2.0e7) - 10.0).abs() < 1e-12);
        assert!((contact_cost(&config, 1.0e12) - 10.0).abs() < 1e-12);
        assert!((contact_cost(&config, 1.0e7) - 5.0).abs() < 1e-12);
        assert_eq!(contact_cost(&config, 0.0), 0.0);
        let narrow = EnvConfig { contact_cost_range: [0.25, 0.5], ..config.clone() };
        assert_eq!(contact_cost(&narrow, 0.0), 0.25);
        assert_eq!(contact_cost(&narrow, 1.0e7), 0.5);
        let open = EnvConfig { contact_cost_range: [0.0, f64::INFINITY], ..config };
        assert!((contact_cost(&open, 1.0e9) - 500.0).abs() < 1e-9);
    }

    #[test]
    fn v4_pays_for_health_on_the_last_step_and_has_no_contact_cost() {
        let config = EnvConfig { task: EnvTask::HumanoidV4, ..EnvConfig::default() };
        let (step, info) = evaluate_step(&config, &transition(0.9));
        assert!(step.terminated);
        assert_eq!(info.reward_survive, 5.0);
        assert_eq!(info.reward_contact, 0.0);
        // 2.5 for going forward, 5 for health, 0.03125 for control.
        assert!((f64::from(step.reward) - 7.468_75).abs() < 1e-6);

        let lenient = EnvConfig { terminate_when_unhealthy: false, ..config };
        assert_eq!(evaluate_step(&lenient, &transition(0.9)).1.reward_survive, 0.0);
        assert_eq!(evaluate_step(&lenient, &transition(1.4)).1.reward_survive, 5.0);
    }

    #[test]
    fn v5_reports_the_torso_and_v4_the_centre_of_mass() {
        let position = |task| {
            let info = evaluate_step(&(EnvConfig { task, ..EnvConfig::default() }), &transition(1.4)).1;
            [info.x_position_m, info.y_position_m, info.distance_from_origin_m]
        };
        assert_eq!(position(EnvTask::HumanoidV5), [3.0, 4.0, 5.0]);
        assert_eq!(position(EnvTask::HumanoidV4), [1.03, 1.985, 1.03f64.hypot(1.985)]);
    }

    #[test]
    fn info_has_the_tendons() {
        let info = evaluate_step(&EnvConfig::default(), &transition(1.4)).1;
        assert_eq!(info.tendon_length_rad.as_slice(), [0.5, -0.5]);
        assert_eq!(info.tendon_velocity_radps.as_slice(), [1.5, -1.5]);
    }
}
