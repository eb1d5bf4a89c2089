//! Constraints of hinges, tendons and the root: limits, dry friction, and the limits of servos' torques.

use pulp::Simd;

use super::rows::{Rows, Sweep};
use super::softness::soft_row;
use crate::dynamics::forces::HingeForces;
use crate::dynamics::mass_matrix::MassMatrix;
use crate::dynamics::structure::Structure;
use crate::lanes::{Lanes, Mask};

/// Largest violation of a limit that counts (rad); absent limits are infinitely far.
const LIMIT_MAX: f64 = 1e6;

/// Constraints of one coordinate that share a row.
#[derive(Clone, Copy, Debug)]
pub(super) struct CoordinateConstraint<S: Simd> {
    /// Index into [`Structure::coordinates`].
    pub(super) coordinate: usize,
    /// First of its numbers in [`Rows`].
    start: usize,
    /// Acceleration per torque.
    response: Lanes<S>,
    /// Limit that acts: 1 pushes to greater angles, −1 to smaller ones.
    limit_sign: Lanes<S>,
    /// Where the limit is reached.
    is_beyond: Mask<S>,
    limit_target: Lanes<S>,
    limit_softness: Lanes<S>,
    limit_divisor: Lanes<S>,
    pub(super) limit_nm: Lanes<S>,
    loss_target: Lanes<S>,
    loss_softness: Lanes<S>,
    loss_divisor: Lanes<S>,
    loss_max_nm: f64,
    pub(super) loss_nm: Lanes<S>,
    /// Motor torque for no acceleration, its decrease per acceleration, and its limits.
    is_servo: bool,
    explicit_nm: Lanes<S>,
    implicit_kgm2: Lanes<S>,
    min_nm: Lanes<S>,
    max_nm: Lanes<S>,
    /// Motor torque in the accelerations before the constraints, where its stiffness is not part of them.
    base_nm: Lanes<S>,
    is_base_stiff: Mask<S>,
    servo_divisor: Lanes<S>,
    /// Torque added to the servo's to keep it within its limits.
    pub(super) servo_nm: Lanes<S>,
}

/// Forces of a coordinate's constraints: limit, friction loss, servo.
pub(super) type CoordinateForces<S> = [Lanes<S>; 3];

/// Writes the constraints of all coordinates that may act.
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "the state of a step has many parts")]
pub(super) fn prepare<S: Simd>(
    constraints: &mut Vec<CoordinateConstraint<S>>,
    rows: &mut Rows<S>,
    structure: &Structure,
    matrix: &MassMatrix<S>,
    hinges: &[HingeForces<S>],
    middle: &[Lanes<S>],
    velocity: &[Lanes<S>],
    warm: &[CoordinateForces<S>],
    step_s: f64,
) {
    constraints.clear();
    let zero = velocity[0].constant(0.0);
    let one = zero.constant(1.0);
    for (index, coordinate) in structure.coordinates.iter().enumerate() {
        let (mut place, mut rate) = (zero, zero);
        for (dof, weight) in &coordinate.terms {
            // One more number describes the root's place than its rate.
            place += middle[dof + 1] * *weight;
            rate += velocity[*dof] * *weight;
        }
        // The nearer limit.
        let (to_min, to_max) = (place - coordinate.min, -(place - coordinate.max));
        let sign = to_min.less_than(to_max).select(one, -one);
        let violation = to_min.min(to_max) - coordinate.limit_margin;
        let beyond = violation.less_than(zero);
        let servo = coordinate.hinge.map(|hinge| &hinges[hinge]);
        let saturates = match servo {
            Some(servo) => {
                servo.min_nm.abs().min(servo.max_nm.abs()).less_than(zero.constant(f64::MAX)).any()
                    && zero.less_than(servo.implicit_kgm2).any()
            }
            None => false,
        };
        if !(beyond.any() || coordinate.friction_loss > 0.0 || saturates) {
            continue;
        }
        let start = rows.numbers.len();
        rows.push(structure, matrix, coordinate);
        let mut response = zero;
        for number in &rows.numbers[start..] {
            response = number.mul_add(*number, response);
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
            start,
            response,
            limit_sign: sign,
            is_beyond: beyond,
            limit_target: limit.target,
            limit_softness: limit.softness,
            limit_divisor: one / (response + limit.softness),
            limit_nm: beyond.keep(limit_nm),
            loss_target: loss.target,
            loss_softness: loss.softness,
            loss_divisor: one / (response + loss.softness),
            loss_max_nm: coordinate.friction_loss,
            loss_nm,
            is_servo: saturates,
            explicit_nm: servo.map_or(zero, |servo| servo.explicit_nm),
            implicit_kgm2,
            min_nm: servo.map_or(zero, |servo| servo.min_nm),
            max_nm: servo.map_or(zero, |servo| servo.max_nm),
            base_nm: servo.map_or(zero, |servo| servo.base_nm),
            is_base_stiff: zero.less_than(servo.map_or(zero, |servo| servo.base_kgm2)),
            servo_divisor: one / implicit_kgm2.mul_add(response, one),
            servo_nm: zero,
        });
    }
}

impl<S: Simd> CoordinateConstraint<S> {
    /// Returns the total torque.
    #[inline(always)]
    fn torque(&self) -> Lanes<S> {
        self.limit_nm * self.limit_sign + self.loss_nm + self.servo_nm
    }

    /// Adds the effect of the first guess to whitened accelerations.
    #[inline(always)]
    pub(super) fn apply(&self, rows: &Rows<S>, structure: &Structure, whitened: &mut [Lanes<S>]) {
        rows.add(self.start, &structure.coordinates[self.coordinate].dofs, self.torque(), whitened);
    }

    /// Solves for the torques while all other constraints stay as they are.
    #[inline(always)]
    pub(super) fn update(
        &mut self,
        rows: &Rows<S>,
        structure: &Structure,
        whitened: &mut [Lanes<S>],
        sweep: &mut Sweep<S>,
    ) {
        let path = &structure.coordinates[self.coordinate].dofs;
        let before = self.torque();
        let start = rows.product(self.start, path, whitened);
        let mut acceleration = start;
        let zero = start.constant(0.0);
        if self.is_servo {
            let within = |torque: Lanes<S>| torque.min(self.max_nm).max(self.min_nm);
            // A servo that was taken for unsaturated: what keeps it within its limits at the present acceleration. Taking its
            // stiffness into account would be faster alone, but may diverge together with a contact.
            let free_nm = self.explicit_nm - self.implicit_kgm2 * acceleration;
            let of_free = within(free_nm) - free_nm;
            // A saturated one is a bounded soft constraint, whose torque changes the acceleration.
            let without = acceleration - self.response * self.servo_nm;
            let missing = self.explicit_nm - self.base_nm - self.implicit_kgm2 * without;
            let of_saturated = within(missing.mul_add(self.servo_divisor, self.base_nm)) - self.base_nm;
            let wanted = self.is_base_stiff.select(of_free, of_saturated);
            let change = sweep.running.keep(wanted - self.servo_nm);
            self.servo_nm += change;
            acceleration = self.response.mul_add(change, acceleration);
        }
        if self.loss_max_nm > 0.0 {
            let missing = self.loss_target - acceleration - self.loss_softness * self.loss_nm;
            let most = zero.constant(self.loss_max_nm);
            let wanted = missing.mul_add(self.loss_divisor, self.loss_nm).min(most).max(-most);
            let change = sweep.running.keep(wanted - self.loss_nm);
            self.loss_nm += change;
            acceleration = self.response.mul_add(change, acceleration);
        }
        let missing = self.limit_target - acceleration * self.limit_sign - self.limit_softness * self.limit_nm;
        let wanted = missing.mul_add(self.limit_divisor, self.limit_nm).max(zero);
        self.limit_nm += sweep.running.and(self.is_beyond).keep(wanted - self.limit_nm);
        let change = self.torque() - before;
        sweep.note_change(change * self.response);
        sweep.note_effect(self.torque() * self.response);
        rows.add(self.start, path, sweep.running.keep(change), whitened);
    }
}
