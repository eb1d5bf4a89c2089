//! The joints as Rapier's solver sees them during one physics step.
//!
//! Rapier reads the angles of a joint with several free axes from the relative quaternion; a hinge chain means
//! something else. So before every step both joint frames are laid on the chain's axes as they stand now; around this
//! posture the two readings agree to first order. Motors, springs, friction and rotors are in the flight; what is left
//! for the solver is to carry what contacts do from body to body, and to stop it at the hinges' limits.

use rapier3d::prelude::*;

use super::convert::to_rotation;
use super::world::World;
use crate::chain;
use crate::dynamics::{Flight, ROOT_POSITIONS};
use crate::model::{Body, Hinge, Model};

/// A limit becomes a constraint when the flight comes this close to it (rad).
const LIMIT_MARGIN_RAD: f64 = 0.2;

/// Lays all joints on the posture at `position`, from which the flight sets out.
pub(super) fn lay_joints(world: &mut World, model: &Model, position: &[f64], flight: &Flight) {
    for (index, body) in model.bodies.iter().enumerate() {
        let Some(handle) = world.joints[index] else { continue };
        if let Some(joint) = world.rapier.impulse_joints.get_mut(handle, false) {
            lay_joint(&mut joint.data, model, body, position, flight);
        }
    }
}

fn lay_joint(joint: &mut GenericJoint, model: &Model, body: &Body, position: &[f64], flight: &Flight) {
    let count = body.hinges.len();
    let mut turns = [0.0; 3];
    for (turn, hinge) in turns.iter_mut().zip(body.hinges.clone()) {
        *turn = model.hinges[hinge].frame_sign * position[ROOT_POSITIONS + hinge];
    }
    let slant = chain::slant(count, &turns);
    let first = chain::base(body) * chain::turn_x(turns[0]);
    // Three axes are perpendicular only while the second turn is zero. One end of the chain gets the constraint
    // direction that leaves the others alone; it goes to the end that is nearer to a limit.
    let exact_first = count == 3 && room(model, body, position, 0) < room(model, body, position, 2);
    let (inner, outer, scale) = if exact_first {
        (first * chain::turn_y(turns[1]), body.hinge_frame * chain::turn_z(-turns[2]), [slant, 1.0, 1.0])
    } else {
        let outer = body.hinge_frame * chain::turn_z(-turns[2]) * chain::turn_y(-turns[1]);
        (first, outer, [1.0, 1.0, slant])
    };
    joint.local_frame1.rotation = to_rotation(&inner);
    joint.local_frame2.rotation = to_rotation(&outer);
    joint.limit_axes = JointAxesMask::empty();
    for (slot, hinge) in body.hinges.clone().enumerate() {
        let row = Row {
            axis: [JointAxis::AngX, JointAxis::AngY, JointAxis::AngZ][slot],
            start_rad: position[ROOT_POSITIONS + hinge],
            end_rad: flight.position[ROOT_POSITIONS + hinge],
            scale: scale[slot],
        };
        row.lay_limits(joint, &model.hinges[hinge]);
    }
}

/// How far (rad) a hinge of the chain is from the nearer end of its range; negative beyond it.
fn room(model: &Model, body: &Body, position: &[f64], slot: usize) -> f64 {
    let hinge = body.hinges.start + slot;
    let angle = position[ROOT_POSITIONS + hinge];
    (angle - model.hinges[hinge].min_rad).min(model.hinges[hinge].max_rad - angle)
}

/// One free axis of a joint: a hinge, seen along a constraint direction.
struct Row {
    axis: JointAxis,
    start_rad: f64,
    end_rad: f64,
    /// Rate along the constraint direction per rate of the hinge.
    scale: f64,
}

impl Row {
    /// Keeps contacts from pushing a hinge further out than the flight takes it.
    fn lay_limits(&self, joint: &mut GenericJoint, hinge: &Hinge) {
        let (lowest, highest) = (self.start_rad.min(self.end_rad), self.start_rad.max(self.end_rad));
        if lowest - LIMIT_MARGIN_RAD > hinge.min_rad && highest + LIMIT_MARGIN_RAD < hinge.max_rad {
            return;
        }
        let below = hinge.min_rad.min(lowest) - self.start_rad;
        let above = hinge.max_rad.max(highest) - self.start_rad;
        let (below, above) = if hinge.frame_sign > 0.0 { (below, above) } else { (-above, -below) };
        joint.set_limits(self.axis, [(below * self.scale) as f32, (above * self.scale) as f32]);
    }
}
