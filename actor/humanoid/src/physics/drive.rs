//! What acts at the hinges during one physics step: motor torques, springs, friction, rotors and limits.
//!
//! Rapier reads the angles of a joint with several free axes from the relative quaternion; a hinge chain means
//! something else. So before every step both joint frames are laid on the chain's axes as they stand now. Around this
//! posture the two readings agree to first order, and springs and limits are given as distances from it.

use nalgebra::Vector3;
use rapier3d::prelude::*;

use super::convert::{to_rotation, to_vector};
use super::kinematics::{BodyMotion, ChainMotion, chain_base};
use super::world::World;
use crate::chain;
use crate::model::{Body, Hinge, Model};

/// A limit becomes a constraint this far (rad) before it is reached, plus what the hinge turns within a step.
const LIMIT_MARGIN_RAD: f64 = 0.2;

/// Lays the joints on the present posture and applies torques (N·m, one per hinge) for the next physics step.
pub(super) fn prepare(
    world: &mut World,
    model: &Model,
    motions: &[BodyMotion],
    chains: &[ChainMotion],
    torques_nm: &[f64],
    body_torques: &mut [Vector3<f64>],
) {
    let step = StepLength::of(&world.rapier.integration_parameters);
    body_torques.fill(Vector3::zeros());
    for (index, body) in model.bodies.iter().enumerate() {
        let (Some(parent), Some(handle)) = (body.parent, world.joints[index]) else {
            continue;
        };
        let torque = hinge_torque(model, body, &motions[parent], &chains[index], torques_nm);
        body_torques[index] += torque;
        body_torques[parent] -= torque;
        if let Some(joint) = world.rapier.impulse_joints.get_mut(handle, false) {
            lay_joint(&mut joint.data, model, body, &chains[index], &step);
        }
    }
    for (handle, torque) in world.bodies.iter().zip(body_torques) {
        let body = &mut world.rapier.bodies[*handle];
        body.reset_torques(false);
        body.add_torque(to_vector(torque), false);
    }
}

/// Torque (N·m, world frame) of a chain's motors on the outer body; the inner one feels the opposite.
fn hinge_torque(
    model: &Model,
    body: &Body,
    parent: &BodyMotion,
    chain_motion: &ChainMotion,
    torques_nm: &[f64],
) -> Vector3<f64> {
    let duals = chain::dual_axes(body.hinges.len(), &chain_motion.turns_rad);
    let sum: Vector3<f64> = body
        .hinges
        .clone()
        .zip(duals)
        .map(|(hinge, dual)| dual * (model.hinges[hinge].frame_sign * torques_nm[hinge]))
        .sum();
    parent.pose.rotation * (chain_base(body) * sum)
}

fn lay_joint(joint: &mut GenericJoint, model: &Model, body: &Body, chain_motion: &ChainMotion, step: &StepLength) {
    let count = body.hinges.len();
    let turns = &chain_motion.turns_rad;
    let slant = chain::slant(count, turns);
    let first = chain_base(body) * chain::turn_x(turns[0]);
    // Three axes are perpendicular only while the second turn is zero. One end of the chain gets the constraint
    // direction that leaves the others alone; it goes to the end that is nearer to a limit.
    let exact_first = count == 3 && room(model, body, chain_motion, 0) < room(model, body, chain_motion, 2);
    let (inner, outer, scale) = if exact_first {
        (first * chain::turn_y(turns[1]), body.hinge_frame * chain::turn_z(-turns[2]), [slant, 1.0, 1.0])
    } else {
        let outer = body.hinge_frame * chain::turn_z(-turns[2]) * chain::turn_y(-turns[1]);
        (first, outer, [1.0, 1.0, slant])
    };
    joint.local_frame1.rotation = to_rotation(&inner);
    joint.local_frame2.rotation = to_rotation(&outer);
    joint.limit_axes = JointAxesMask::empty();
    joint.motor_axes = JointAxesMask::empty();
    for (slot, hinge) in body.hinges.clone().enumerate() {
        let row = Row {
            axis: [JointAxis::AngX, JointAxis::AngY, JointAxis::AngZ][slot],
            turn_rad: turns[slot],
            rate_radps: chain_motion.rates_radps[slot],
            scale: scale[slot],
        };
        row.lay_limits(joint, &model.hinges[hinge], step);
        row.lay_motor(joint, &model.hinges[hinge], step);
    }
}

/// How far (rad) a hinge of the chain is from the nearer end of its range; negative beyond it.
fn room(model: &Model, body: &Body, chain_motion: &ChainMotion, slot: usize) -> f64 {
    let hinge = &model.hinges[body.hinges.start + slot];
    let angle = hinge.frame_sign * chain_motion.turns_rad[slot];
    (angle - hinge.min_rad).min(hinge.max_rad - angle)
}

/// One free axis of a joint: a hinge, seen along a constraint direction.
struct Row {
    axis: JointAxis,
    turn_rad: f64,
    rate_radps: f64,
    /// Rate along the constraint direction per rate of the hinge.
    scale: f64,
}

impl Row {
    fn lay_limits(&self, joint: &mut GenericJoint, hinge: &Hinge, step: &StepLength) {
        let (min, max) =
            if hinge.frame_sign > 0.0 { (hinge.min_rad, hinge.max_rad) } else { (-hinge.max_rad, -hinge.min_rad) };
        let (below, above) = (min - self.turn_rad, max - self.turn_rad);
        let reach = LIMIT_MARGIN_RAD + self.rate_radps.abs() * step.whole_s;
        if below < -reach && above > reach {
            return;
        }
        joint.set_limits(self.axis, [(below * self.scale) as f32, (above * self.scale) as f32]);
    }

    /// Spring, viscous friction and rotor as one implicit row: stable however light the body at the hinge.
    ///
    /// The rotor resists a change of rate: it is friction relative to the rate at the start of the step, with the
    /// coefficient that makes the impulse over the step armature × change of rate.
    fn lay_motor(&self, joint: &mut GenericJoint, hinge: &Hinge, step: &StepLength) {
        let rotor = hinge.armature_kgm2 / step.rotor_s;
        let damping = hinge.damping_nmsprad + rotor;
        if damping + hinge.stiffness_nmprad <= 0.0 {
            return;
        }
        let target_radps = if damping > 0.0 { self.rate_radps * rotor / damping } else { 0.0 };
        let slack_rad = hinge.frame_sign * hinge.rest_rad - self.turn_rad;
        let per_row = 1.0 / (self.scale * self.scale);
        joint.motor_axes |= self.axis.into();
        joint.motors[self.axis as usize] = JointMotor {
            target_vel: (target_radps * self.scale) as f32,
            target_pos: (slack_rad * self.scale) as f32,
            stiffness: (hinge.stiffness_nmprad * per_row) as f32,
            damping: (damping * per_row) as f32,
            max_force: Real::MAX,
            impulse: 0.0,
            model: MotorModel::ForceBased,
        };
    }
}

/// Durations that the rows of a physics step need (s).
struct StepLength {
    whole_s: f64,
    /// Time over which a rotor's friction acts: see [`Row::lay_motor`].
    rotor_s: f64,
}

impl StepLength {
    fn of(parameters: &IntegrationParameters) -> Self {
        let whole_s = f64::from(parameters.dt);
        let iterations = parameters.num_solver_iterations as f64;
        // The solver passes n times through the step while the rate changes about evenly: on average
        // it has changed by (n + 1) / 2n of the whole.
        Self { whole_s, rotor_s: whole_s * (iterations + 1.0) / (2.0 * iterations) }
    }
}
