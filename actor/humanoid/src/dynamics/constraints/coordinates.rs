//! Constraints of hinges, tendons and the root: limits, dry friction, and the limits of servos' torques.

use super::softness::{SoftRow, soft_row};
use crate::articulation::{Coordinate, Structure};
use crate::dynamics::forces::HingeForces;
use crate::lanes::{Lanes, Mask, Simd};

/// Largest violation of a limit that counts (rad); absent limits are infinitely far.
const LIMIT_MAX: f64 = 1e6;

/// Constraints of one coordinate, which share a row.
#[derive(Clone, Copy, Debug)]
pub(super) struct CoordinateConstraint<S: Simd> {
    /// Index into [`Structure::coordinates`].
    pub(super) coordinate: usize,
    /// Worlds in which any of them may act.
    pub(super) is_active: Mask<S>,
    /// Whether it pushes both ways: an equality.
    pub(super) is_fixed: bool,
    /// Limit that acts: 1 pushes to greater angles, −1 to smaller ones.
    pub(super) limit_sign: Lanes<S>,
    /// Where the limit is reached.
    pub(super) is_beyond: Mask<S>,
    pub(super) limit: SoftRow<S>,
    pub(super) limit_nm: Lanes<S>,
    pub(super) loss: SoftRow<S>,
    pub(super) loss_max_nm: f64,
    pub(super) loss_nm: Lanes<S>,
    /// Motor torque for no acceleration, its decrease per acceleration, and its limits.
    pub(super) is_servo: bool,
    pub(super) explicit_nm: Lanes<S>,
    pub(super) implicit_kgm2: Lanes<S>,
    pub(super) min_nm: Lanes<S>,
    pub(super) max_nm: Lanes<S>,
    /// Motor torque in the accelerations before the constraints, where its stiffness is not part of them.
    pub(super) base_nm: Lanes<S>,
    pub(super) is_base_stiff: Mask<S>,
    /// Torque added to the servo's to keep it within its limits.
    pub(super) servo_nm: Lanes<S>,
}

/// Forces of a coordinate's constraints: limit, friction loss, servo.
pub(super) type CoordinateForces<S> = [Lanes<S>; 3];

/// Writes the constraints of all coordinates that may act.
#[inline(always)]
pub(super) fn prepare<S: Simd>(
    constraints: &mut Vec<CoordinateConstraint<S>>,
    structure: &Structure,
    hinges: &[HingeForces<S>],
    middle: &[Lanes<S>],
    velocity: &[Lanes<S>],
    warm: &[CoordinateForces<S>],
    step_s: f64,
) {
    constraints.clear();
    let zero = velocity[0].constant(0.0);
    let one = zero.constant(1.0);
    let never = one.less_than(zero);
    for (index, coordinate) in structure.coordinates.iter().enumerate() {
        let (mut place, mut rate) = (zero, zero);
        for (dof, weight) in &coordinate.terms {
            // One more number describes the root's place than its rate.
            place += middle[dof + 1] * *weight;
            rate += velocity[*dof] * *weight;
        }
        // The nearer limit.
        let (to_min, to_max) = (place - coordinate.min, -(place - coordinate.max));
        let (sign, violation, beyond) = if coordinate.is_fixed {
            (one, to_min, zero.less_than(one))
        } else {
            let violation = to_min.min(to_max) - coordinate.limit_margin;
            (to_min.less_than(to_max).select(one, -one), violation, violation.less_than(zero))
        };
        let servo = coordinate.hinge.map(|hinge| &hinges[hinge]);
        let saturates = servo.map_or(never, |servo| {
            let nearest_nm = servo.min_nm.abs().min(servo.max_nm.abs());
            nearest_nm.less_than(zero.constant(1e30)).and(zero.less_than(servo.implicit_kgm2))
        });
        let slips = if coordinate.friction_loss > 0.0 { zero.less_than(one) } else { never };
        let active = beyond.or(saturates).or(slips);
        if !active.any() {
            continue;
        }
        let weight = zero.constant(coordinate.response);
        let limit = soft_row(
            &coordinate.limit_softness,
            violation.min(zero.constant(LIMIT_MAX)).max(zero.constant(-LIMIT_MAX)),
            rate * sign,
            weight,
            step_s,
        );
        let loss = soft_row(&coordinate.friction_softness, zero, rate, weight, step_s);
        // What is added to a servo depends on whether it is saturated, which may have changed.
        let [limit_nm, loss_nm, _] = warm[index];
        let implicit_kgm2 = servo.map_or(zero, |servo| servo.implicit_kgm2);
        constraints.push(CoordinateConstraint {
            coordinate: index,
            is_active: active,
            is_fixed: coordinate.is_fixed,
            limit_sign: sign,
            is_beyond: beyond,
            limit,
            limit_nm: beyond.keep(limit_nm),
            loss,
            loss_max_nm: coordinate.friction_loss,
            loss_nm,
            is_servo: saturates.any(),
            explicit_nm: servo.map_or(zero, |servo| servo.explicit_nm),
            implicit_kgm2,
            min_nm: servo.map_or(zero, |servo| servo.min_nm),
            max_nm: servo.map_or(zero, |servo| servo.max_nm),
            base_nm: servo.map_or(zero, |servo| servo.base_nm),
            is_base_stiff: zero.less_than(servo.map_or(zero, |servo| servo.base_kgm2)),
            servo_nm: zero,
        });
    }
}

impl<S: Simd> CoordinateConstraint<S> {
    /// Returns the total torque.
    #[inline(always)]
    pub(super) fn torque(&self) -> Lanes<S> {
        self.limit_nm * self.limit_sign + self.loss_nm + self.servo_nm
    }

    /// Returns the forces at an acceleration of the coordinate, of constraints with these stiffnesses (limit, friction
    /// loss), and the decrease of their sum per acceleration.
    #[inline(always)]
    pub(super) fn respond(
        &self,
        [limit_stiffness, loss_stiffness]: [Lanes<S>; 2],
        acceleration: Lanes<S>,
    ) -> (CoordinateForces<S>, Lanes<S>) {
        let zero = acceleration.constant(0.0);
        let (mut loss_nm, mut servo_nm, mut decrease) = (zero, zero, zero);
        if self.is_servo {
            let free_nm = self.explicit_nm - self.implicit_kgm2 * acceleration;
            let within_nm = free_nm.min(self.max_nm).max(self.min_nm);
            servo_nm = within_nm - self.is_base_stiff.select(free_nm, self.base_nm);
            // The accelerations before the constraints already know the stiffness of unsaturated servos.
            decrease = within_nm.equals(free_nm).keep(self.implicit_kgm2) - self.is_base_stiff.keep(self.implicit_kgm2);
        }
        if self.loss_max_nm > 0.0 {
            let most_nm = zero.constant(self.loss_max_nm);
            let free_nm = (self.loss.target - acceleration) * loss_stiffness;
            loss_nm = free_nm.min(most_nm).max(-most_nm);
            decrease += loss_nm.equals(free_nm).keep(loss_stiffness);
        }
        let missing = self.limit.target - acceleration * self.limit_sign;
        let pushes = if self.is_fixed { self.is_beyond } else { self.is_beyond.and(zero.less_than(missing)) };
        decrease += pushes.keep(limit_stiffness);
        ([pushes.keep(missing * limit_stiffness), loss_nm, servo_nm], decrease)
    }
}

/// Returns the acceleration of a coordinate.
#[inline(always)]
pub(super) fn of_terms<S: Simd>(coordinate: &Coordinate, accelerations: &[Lanes<S>]) -> Lanes<S> {
    let mut sum = accelerations[0].constant(0.0);
    for (dof, weight) in &coordinate.terms {
        sum += accelerations[*dof] * *weight;
    }
    sum
}
