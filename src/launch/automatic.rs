//! Settings of the velocity task that follow from a robot's size.
//!
//! Two walkers move alike if their *Froude number* `v² ÷ (g L)` is the same (Alexander 1989, "Optimization and gaits in the
//! locomotion of vertebrates"): with leg length `L`, velocities scale with √L, times with √L, angular velocities with 1 ÷ √L
//! and heights with L. The reward's weights scale so that each term keeps its share.

use toml::Value;
use treadmill_config::{Config, ConfigSource};
use treadmill_humanoid::card::BodySize;

/// Leg length and weight of a G1 with its card, for which the defaults are made.
const LEG_LENGTH_M: f64 = 0.657;
const WEIGHT_N: f64 = 327.0;

/// Returns the keys of a robot of this size; without one, those of a G1.
pub fn keys(size: Option<BodySize>) -> Vec<(&'static str, Value)> {
    let size = size.unwrap_or(BodySize { leg_length_m: LEG_LENGTH_M, weight_n: WEIGHT_N });
    let length = size.leg_length_m / LEG_LENGTH_M;
    let torque = length * size.weight_n / WEIGHT_N;
    let speed = length.sqrt();
    let Config { velocity, rewards, randomisation, .. } = of_a_g1();
    let range = |range: [f64; 2], factor: f64| Value::from(range.map(|end| short(end * factor)).to_vec());
    let number = |number: f64| Value::from(short(number));
    vec![
        ("velocity.lin_vel_x_mps", range(velocity.lin_vel_x_mps, speed)),
        ("velocity.lin_vel_y_mps", range(velocity.lin_vel_y_mps, speed)),
        ("velocity.ang_vel_z_radps", range(velocity.ang_vel_z_radps, 1.0 / speed)),
        ("velocity.gait_period_s", number(velocity.gait_period_s * speed)),
        ("velocity.gait_rests_after_s", number(velocity.gait_rests_after_s * speed)),
        ("velocity.swing_height_m", number(velocity.swing_height_m * length)),
        ("velocity.tracking_variance", number(velocity.tracking_variance * length)),
        ("velocity.yaw_tracking_variance", number(velocity.yaw_tracking_variance / length)),
        ("rewards.base_height", number(rewards.base_height / length.powi(2))),
        ("rewards.vertical_velocity", number(rewards.vertical_velocity / length)),
        ("rewards.roll_pitch_rate", number(rewards.roll_pitch_rate * length)),
        ("rewards.feet_clearance", number(rewards.feet_clearance / length.powi(2))),
        ("rewards.stand_still", number(rewards.stand_still * length)),
        ("rewards.feet_slip", number(rewards.feet_slip / length)),
        // A change per control step, whose duration does not scale.
        ("rewards.action_rate", number(rewards.action_rate * length)),
        ("rewards.joint_torque", number(rewards.joint_torque / torque.powi(2))),
        ("rewards.joint_acceleration", number(rewards.joint_acceleration * length.powi(2))),
        ("randomisation.push_mps", range(randomisation.push_mps, speed)),
    ]
}

/// Returns the keys of a G1.
fn of_a_g1() -> Config {
    let mut source = ConfigSource::default();
    source.preset("g1").and_then(|()| source.build()).expect("the preset is valid")
}

/// Returns a number with three digits, so that a configuration is easy to read.
fn short(number: f64) -> f64 {
    format!("{number:.2e}").parse().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_robot_of_a_quarter_of_the_length_walks_half_as_fast_and_steps_twice_as_often() {
        let size = BodySize { leg_length_m: LEG_LENGTH_M / 4.0, weight_n: WEIGHT_N / 64.0 };
        let keys = keys(Some(size));
        let value = |key: &str| keys.iter().find(|(name, _)| *name == key).map(|(_, value)| value.to_string()).unwrap();
        for (key, wanted) in [
            ("velocity.lin_vel_x_mps", "[-0.25, 0.5]"),
            ("velocity.ang_vel_z_radps", "[-1.0, 1.0]"),
            ("velocity.gait_period_s", "0.4"),
            ("velocity.gait_rests_after_s", "0.5"),
            ("velocity.swing_height_m", "0.02"),
            ("velocity.tracking_variance", "0.025"),
            ("velocity.yaw_tracking_variance", "0.4"),
            // 20 m⁻² of a squared length.
            ("rewards.base_height", "-320.0"),
            // 1e-5 for torques of a 256th.
            ("rewards.joint_torque", "-0.655"),
            ("randomisation.push_mps", "[0.0, 0.25]"),
        ] {
            assert_eq!(value(key), wanted, "{key}");
        }
    }

    #[test]
    fn a_robot_of_the_size_of_a_g1_has_the_defaults() {
        let (mut source, mut g1) = (ConfigSource::default(), ConfigSource::default());
        source.preset("velocity").unwrap();
        for (key, value) in keys(None) {
            source.value(key, value).unwrap();
        }
        g1.preset("g1").unwrap();
        g1.value("env.robot", "").unwrap();
        assert_eq!(source.build().unwrap(), g1.build().unwrap());
    }
}
