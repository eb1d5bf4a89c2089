//! Points that stay together, as MuJoCo's `<connect>`: three soft constraints that push both ways, along the world's axes.

use super::contacts::ContactRows;
use super::softness::{impedance, soft_row_of};
use crate::articulation::{ConnectionNode, MassMatrix, Posture, Structure};
use crate::lanes::{Lanes, Simd, Vec3};

/// Connection of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct ConnectionConstraint<S: Simd> {
    /// First of its numbers in [`ContactRows`].
    pub(super) start: usize,
    /// From the second point to the first (m).
    pub(super) apart_m: Vec3<S>,
    pub(super) targets: [Lanes<S>; 3],
    pub(super) softness: Lanes<S>,
    /// Force on the first body along the world's axes.
    pub(super) forces_n: [Lanes<S>; 3],
}

impl<S: Simd> ConnectionConstraint<S> {
    /// Adds the rows of a connection, whitened by `whitening`, and returns its constraint; `start_velocity` is whitened
    /// likewise.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "the state of a step has many parts")]
    pub(super) fn new(
        rows: &mut ContactRows<S>,
        structure: &Structure,
        posture: &Posture<S>,
        whitening: Option<&MassMatrix<S>>,
        node: &ConnectionNode,
        start_velocity: &[Lanes<S>],
        warm: &[Lanes<S>; 3],
        step_s: f64,
    ) -> Self {
        let [first, second] = node.bodies;
        let place = |body: usize, point_m| posture.origins_m[body] + posture.rotations[body].times_constant(point_m);
        let points = [place(first, &node.points_m[0]), place(second, &node.points_m[1])];
        let zero = points[0].x.constant(0.0);
        let one = zero.constant(1.0);
        let axes = [Vec3::new(one, zero, zero), Vec3::new(zero, one, zero), Vec3::new(zero, zero, one)];
        let start = rows.numbers.len();
        let sides = [Some((first, points[0])), Some((second, points[1]))];
        rows.push(structure, posture, whitening, &node.dofs, sides, 0, &axes);
        let apart = points[0] - points[1];
        let impedance = impedance(&node.softness, apart.dot(&apart).sqrt());
        let response = zero.constant(node.response);
        let rates = rows.products(start, &node.dofs, start_velocity);
        let mut constraint = Self { start, apart_m: apart, targets: [zero; 3], softness: zero, forces_n: *warm };
        for (axis, violation) in [apart.x, apart.y, apart.z].into_iter().enumerate() {
            let row = soft_row_of(&node.softness, impedance, violation, rates[axis], response, step_s);
            constraint.targets[axis] = row.target;
            constraint.softness = row.softness;
        }
        constraint
    }

    /// Returns the moment of its two forces, whose points are not quite together (N·m).
    #[inline(always)]
    pub(super) fn moment_nm(&self) -> Vec3<S> {
        let [x, y, z] = self.forces_n;
        self.apart_m.cross(&Vec3::new(x, y, z))
    }

    /// Returns the forces at these accelerations, of a connection with this stiffness.
    #[inline(always)]
    pub(super) fn respond(&self, stiffness: Lanes<S>, accelerations: &[Lanes<S>; 3]) -> [Lanes<S>; 3] {
        let mut forces = self.targets;
        for (force, acceleration) in forces.iter_mut().zip(accelerations) {
            *force = (*force - *acceleration) * stiffness;
        }
        forces
    }
}
