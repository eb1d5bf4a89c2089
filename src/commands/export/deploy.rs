//! `deploy.yaml`, which the controllers of Unitree's `unitree_rl_lab` read.
//!
//! Gains are in the order of the robot's motors, see `motors` of a robot card; all else is in the order of the action.
//! `joint_ids_map` has the number of the motor for each joint of the action. Unitree's loader wants every key, and
//! `null` for none.

use std::fmt::Write;

use treadmill_humanoid::task::velocity::ACTION_MAX;

use super::contract::{Contract, Joint};

/// Returns the text of the file.
pub(super) fn yaml(contract: &Contract) -> anyhow::Result<String> {
    let joints = &contract.joints;
    let of = |number: fn(&Joint) -> f64| list(joints.iter().map(number));
    let offset = of(|joint| joint.default_rad);
    let names = joints.iter().map(|joint| serde_json::to_string(&joint.name)).collect::<Result<Vec<_>, _>>()?;
    let clip: Vec<String> = joints
        .iter()
        .map(|joint| {
            let most_rad = ACTION_MAX * joint.action_scale_rad;
            list([joint.default_rad - most_rad, joint.default_rad + most_rad])
        })
        .collect();
    let velocity = &contract.config.velocity;
    let mut text = format!(
        "joint_ids_map: [{ids}]\nstep_dt: {step:?}\nstiffness: {stiffness}\ndamping: {damping}\n\
         default_joint_pos: {offset}\n\
         commands:\n  base_velocity:\n    ranges:\n      lin_vel_x: {x}\n      lin_vel_y: {y}\n      \
         ang_vel_z: {yaw}\n      heading: null\n\
         actions:\n  JointPositionAction:\n    clip: [{clip}]\n    joint_names: [{names}]\n    scale: {scale}\n    \
         offset: {offset}\n    joint_ids: null\nobservations:\n",
        ids = joints.iter().map(|joint| joint.motor.to_string()).collect::<Vec<_>>().join(", "),
        step = contract.control_step_s(),
        stiffness = by_motor(contract, |joint| joint.kp),
        damping = by_motor(contract, |joint| joint.kd),
        x = list(velocity.lin_vel_x_mps),
        y = list(velocity.lin_vel_y_mps),
        yaw = list(velocity.ang_vel_z_radps),
        clip = clip.join(", "),
        names = names.join(", "),
        scale = of(|joint| joint.action_scale_rad),
    );
    for term in &contract.terms {
        let (name, params) = (term.name, &term.deploy_params);
        let ones = list(vec![1.0; term.size]);
        writeln!(
            text,
            "  {name}:\n    params: {params}\n    clip: null\n    scale: {ones}\n    history_length: {}",
            velocity.history
        )?;
    }
    if velocity.history > 1 {
        // Whole frames one after the other. Its place must not be the first, by which the loader knows groups of terms.
        text.push_str("  use_gym_history: true\n");
    }
    Ok(text)
}

/// Returns a number of each motor; 0 for motors without a joint.
fn by_motor(contract: &Contract, number: fn(&Joint) -> f64) -> String {
    let joints = || contract.joints.iter().chain(&contract.held);
    let mut numbers = vec![0.0; joints().map(|joint| joint.motor + 1).max().unwrap_or(0)];
    joints().for_each(|joint| numbers[joint.motor] = number(joint));
    list(numbers)
}

/// Returns numbers as a YAML list.
fn list(numbers: impl IntoIterator<Item = f64>) -> String {
    let numbers: Vec<String> = numbers.into_iter().map(|number| format!("{number:?}")).collect();
    format!("[{}]", numbers.join(", "))
}
