//! Humanoid-v5 and -v4. Reward and end of an episode are pure functions.
//!
//! Formulas are those of Gymnasium's `humanoid_v5.py` and `humanoid_v4.py`. Version 4 differs in three points: it has no
//! contact cost; if unhealthy steps end the episode, it pays for health on every step, including the last; its info has the
//! position of the centre of mass instead of the torso's.

use super::{ObservationTerm, Step, StepEvaluation, Task};
use crate::config::{EnvConfig, EnvTask, EnvironmentConfig};
use crate::info::{PerTendon, StepInfo};
use crate::model::Model;
use crate::model::mirror::{Mirror, SignedPermutation};
use crate::observation::{Observation, Sensed};
use crate::physics::Physics;
use crate::randomisation::SensorNoise;

/// Quantities of one control step that reward and termination depend on.
#[derive(Clone, Copy, Debug)]
struct Transition<'a> {
    /// Mean velocity of the whole-body centre of mass during the step: x and y (m/s).
    velocity_mps: [f64; 2],
    /// Height of the torso after the step (m).
    height_m: f64,
    /// Action as given, one control per motor.
    action: &'a [f32],
    /// Sum of squared contact forces (N²) and moments ((N·m)²) over all links.
    squared_contact_wrenches: f64,
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

    /// Returns the info of the present state, without velocities and rewards.
    fn present_info(&self, physics: &Physics) -> StepInfo {
        let [x_m, y_m] = match self.config.task {
            EnvTask::HumanoidV4 => [physics.centre_of_mass().x, physics.centre_of_mass().y],
            _ => [physics.position()[0], physics.position()[1]],
        };
        StepInfo {
            x_position_m: x_m,
            y_position_m: y_m,
            distance_from_origin_m: x_m.hypot(y_m),
            tendon_length_rad: tendon_values(physics.model(), physics.joint_angles()),
            tendon_velocity_radps: tendon_values(physics.model(), physics.joint_rates()),
            ..StepInfo::default()
        }
    }
}

impl Task for HumanoidTask {
    fn terms(&self) -> &[ObservationTerm] {
        self.observation.terms()
    }

    fn begin(&mut self, _seed: u64, physics: &Physics) {
        self.info = self.present_info(physics);
    }

    fn mirrored(&self, robot: &Mirror) -> Option<SignedPermutation> {
        Some(self.observation.mirrored(robot))
    }

    fn evaluate(&mut self, step: &Step<'_>) -> StepEvaluation {
        let Step { physics, action, centre_before_m: before } = *step;
        let after = physics.centre_of_mass();
        let transition = Transition {
            velocity_mps: [0, 1].map(|axis| (after[axis] - before[axis]) / self.config.control_step_s),
            height_m: physics.torso_height_m(),
            action,
            squared_contact_wrenches: physics.squared_contact_wrenches(),
        };
        let (evaluation, info) = evaluate_step(&self.config, &transition, self.present_info(physics));
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
fn control_cost(config: &EnvConfig, action: &[f32]) -> f64 {
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
fn health_reward(config: &EnvConfig, healthy: bool) -> f64 {
    if healthy || (config.task == EnvTask::HumanoidV4 && config.terminate_when_unhealthy) {
        config.healthy_reward
    } else {
        0.0
    }
}

/// Computes reward, termination and info of one control step, after which the info is `present` but for velocities and
/// rewards.
fn evaluate_step(config: &EnvConfig, transition: &Transition<'_>, present: StepInfo) -> (StepEvaluation, StepInfo) {
    let [x_velocity_mps, y_velocity_mps] = transition.velocity_mps;
    let healthy = is_healthy(config, transition.height_m);
    let info = StepInfo {
        x_velocity_mps,
        y_velocity_mps,
        reward_survive: health_reward(config, healthy),
        reward_forward: config.forward_reward_weight * x_velocity_mps,
        reward_ctrl: -control_cost(config, transition.action),
        reward_contact: -contact_cost(config, transition.squared_contact_wrenches),
        ..present
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

    const TRANSITION: Transition<'static> =
        Transition { velocity_mps: [2.0, -1.0], height_m: 1.4, action: &[0.5, -0.25], squared_contact_wrenches: 2.0e6 };

    fn at_height(config: &EnvConfig, height_m: f64) -> (StepEvaluation, StepInfo) {
        evaluate_step(config, &Transition { height_m, ..TRANSITION }, StepInfo::default())
    }

    #[test]
    fn reward_matches_the_sum_computed_by_hand() {
        let (step, info) = at_height(&EnvConfig::default(), 1.4);
        // 2 m/s × 1.25 = 2.5. 0.1 × (0.25 + 0.0625) = 0.03125. 5e-7 × 2e6 = 1.
        assert_eq!((info.x_velocity_mps, info.y_velocity_mps), (2.0, -1.0));
        assert!((info.reward_forward - 2.5).abs() < 1e-9);
        assert!((info.reward_ctrl + 0.031_25).abs() < 1e-9);
        assert!((info.reward_contact + 1.0).abs() < 1e-9);
        assert!((f64::from(step.reward) - 6.468_75).abs() < 1e-6);
        assert!(!step.terminated);
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
        let huge = Transition { action: &[f32::MAX], ..TRANSITION };
        let (step, info) = evaluate_step(&EnvConfig::default(), &huge, StepInfo::default());
        assert!(step.reward == f32::MIN && info.reward_ctrl.is_finite());
    }

    #[test]
    fn v5_does_not_pay_for_health_on_an_unhealthy_last_step() {
        for height_m in [1.0, 0.9, 2.0, 2.5] {
            for terminate_when_unhealthy in [true, false] {
                let config = EnvConfig { terminate_when_unhealthy, ..EnvConfig::default() };
                let (step, info) = at_height(&config, height_m);
                assert_eq!((step.terminated, info.reward_survive), (terminate_when_unhealthy, 0.0), "{height_m} m");
                assert!((f64::from(step.reward) - 1.468_75).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn contact_cost_stays_within_its_range() {
        for (contact_cost_range, squares, cost) in [
            ([f64::NEG_INFINITY, 10.0], 2.0e7, 10.0),
            ([f64::NEG_INFINITY, 10.0], 1.0e12, 10.0),
            ([f64::NEG_INFINITY, 10.0], 1.0e7, 5.0),
            ([f64::NEG_INFINITY, 10.0], 0.0, 0.0),
            ([0.25, 0.5], 0.0, 0.25),
            ([0.25, 0.5], 1.0e7, 0.5),
            ([0.0, f64::INFINITY], 1.0e9, 500.0),
        ] {
            let found = contact_cost(&EnvConfig { contact_cost_range, ..EnvConfig::default() }, squares);
            assert!((found - cost).abs() < 1e-9, "{found} instead of {cost}");
        }
        assert_eq!(EnvConfig::default().contact_cost_range, [f64::NEG_INFINITY, 10.0]);
    }

    #[test]
    fn v4_pays_for_health_on_the_last_step_and_has_no_contact_cost() {
        let config = EnvConfig { task: EnvTask::HumanoidV4, ..EnvConfig::default() };
        let (step, info) = at_height(&config, 0.9);
        assert!(step.terminated);
        assert_eq!((info.reward_survive, info.reward_contact), (5.0, 0.0));
        // 2.5 for going forward, 5 for health, 0.03125 for control.
        assert!((f64::from(step.reward) - 7.468_75).abs() < 1e-6);

        let lenient = EnvConfig { terminate_when_unhealthy: false, ..config };
        assert_eq!([0.9, 1.4].map(|height_m| at_height(&lenient, height_m).1.reward_survive), [0.0, 5.0]);
    }
}
