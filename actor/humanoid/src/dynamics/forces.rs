//! Accelerations without constraints: motors, springs, friction, gravity, gyroscopic forces.

use crate::articulation::{MassMatrix, Posture, ROOT_DOFS, ROOT_POSITIONS, Structure};
use crate::lanes::{Force, Lanes, Motion, Simd, Vec3};

/// Motors and passive forces of one hinge during a step, linear in the acceleration of the hinge.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HingeForces<S: Simd> {
    /// Motor torque (N·m), stiffness and damping, see [`super::world::Drive`].
    pub(crate) torque_nm: Lanes<S>,
    pub(crate) stiffness_nmprad: Lanes<S>,
    pub(crate) damping_nmsprad: Lanes<S>,
    pub(crate) min_nm: Lanes<S>,
    pub(crate) max_nm: Lanes<S>,
    pub(crate) friction_nmsprad: Lanes<S>,
    pub(crate) friction_powers: [Lanes<S>; 2],
    pub(crate) armature_kgm2: Lanes<S>,
    /// Motor torque of the present step without the hinge's acceleration (N·m).
    pub(crate) explicit_nm: Lanes<S>,
    /// Decrease of the motor torque per acceleration of the hinge (kg·m²).
    pub(crate) implicit_kgm2: Lanes<S>,
    /// Motor torque and its decrease per acceleration without the forces of constraints. Where `explicit_nm` is beyond
    /// the limits they are that limit and 0: a servo that is saturated has no stiffness.
    pub(crate) base_nm: Lanes<S>,
    pub(crate) base_kgm2: Lanes<S>,
    /// Spring and viscous friction of the present step without the hinge's acceleration (N·m).
    passive_nm: Lanes<S>,
}

impl<S: Simd> HingeForces<S> {
    pub(crate) fn zero(simd: S) -> Self {
        let zero = Lanes::zero(simd);
        Self {
            torque_nm: zero,
            stiffness_nmprad: zero,
            damping_nmsprad: zero,
            min_nm: zero,
            max_nm: zero,
            friction_nmsprad: zero,
            friction_powers: [zero; 2],
            armature_kgm2: zero,
            explicit_nm: zero,
            implicit_kgm2: zero,
            base_nm: zero,
            base_kgm2: zero,
            passive_nm: zero,
        }
    }
}

/// Workspace for the forces of a step.
#[derive(Clone, Debug)]
pub(crate) struct Forces<S: Simd> {
    pub(crate) hinges: Vec<HingeForces<S>>,
    pub(crate) gravity_mps2: Vec3<S>,
    /// Addition to the mass matrix, one number per degree of freedom.
    pub(crate) diagonal: Vec<Lanes<S>>,
    /// Generalised forces, then their whitened row.
    pub(crate) total: Vec<[Lanes<S>; 1]>,
    /// Viscous friction of the root without its acceleration.
    root: [Lanes<S>; ROOT_DOFS],
    velocities: Vec<Motion<S>>,
    accelerations: Vec<Motion<S>>,
    loads: Vec<Force<S>>,
}

impl<S: Simd> Forces<S> {
    pub(crate) fn new(simd: S, structure: &Structure) -> Self {
        let (dofs, bodies) = (structure.dofs(), structure.nodes.len());
        Self {
            hinges: vec![HingeForces::zero(simd); structure.hinges.len()],
            gravity_mps2: Vec3::zero(simd),
            diagonal: vec![Lanes::zero(simd); dofs],
            total: vec![[Lanes::zero(simd)]; dofs],
            root: [Lanes::zero(simd); ROOT_DOFS],
            velocities: vec![Motion::zero(simd); bodies],
            accelerations: vec![Motion::zero(simd); bodies],
            loads: vec![Force::zero(simd); bodies],
        }
    }

    /// Computes the hinges' forces for a step that starts at `velocity` and has `middle` as the position of its middle.
    ///
    /// Forces are those of the middle: an acceleration a adds a·step/2 to the rate and a·step²/4 to the angle there.
    /// These parts are implicit: they belong to the mass matrix, so that the step is stable at any stiffness.
    #[inline(always)]
    pub(crate) fn prepare(&mut self, structure: &Structure, middle: &[Lanes<S>], velocity: &[Lanes<S>], step_s: f64) {
        let root = structure.root_armature + structure.root_damping * step_s / 2.0;
        for ((passive, diagonal), rate) in self.root.iter_mut().zip(&mut self.diagonal).zip(velocity) {
            *passive = *rate * -structure.root_damping;
            *diagonal = rate.constant(root);
        }
        for (index, (node, hinge)) in structure.hinges.iter().zip(&mut self.hinges).enumerate() {
            let dof = ROOT_DOFS + index;
            let (angle, rate) = (middle[ROOT_POSITIONS + index], velocity[dof]);
            hinge.explicit_nm = hinge.torque_nm - hinge.stiffness_nmprad * angle - hinge.damping_nmsprad * rate;
            hinge.implicit_kgm2 =
                hinge.damping_nmsprad * (step_s / 2.0) + hinge.stiffness_nmprad * (step_s * step_s / 4.0);
            let nearest_nm = hinge.explicit_nm.min(hinge.max_nm).max(hinge.min_nm);
            let is_stiff = angle.constant(0.0).less_than(hinge.implicit_kgm2);
            let excess_nm = (hinge.explicit_nm - nearest_nm).abs();
            let is_saturated = is_stiff.and(angle.constant(0.0).less_than(excess_nm));
            hinge.base_nm = is_saturated.select(nearest_nm, hinge.explicit_nm);
            hinge.base_kgm2 = is_saturated.select(angle.constant(0.0), hinge.implicit_kgm2);
            hinge.passive_nm = -(hinge.friction_nmsprad * rate + (angle - node.rest_rad) * node.stiffness_nmprad);
            self.diagonal[dof] = hinge.armature_kgm2
                + hinge.base_kgm2
                + hinge.friction_nmsprad * (step_s / 2.0)
                + angle.constant(node.stiffness_nmprad * step_s * step_s / 4.0);
            if node.has_damping_powers {
                let (speed, [square, cube]) = (rate.abs(), hinge.friction_powers);
                hinge.passive_nm -= (cube * speed + square) * speed * rate;
                self.diagonal[dof] += (cube * speed * 1.5 + square) * speed * step_s;
            }
            let [square, cube] = node.stiffness_powers;
            if [square, cube] != [0.0; 2] {
                let deflection = angle - node.rest_rad;
                hinge.passive_nm -= (deflection * cube + square) * deflection * deflection;
                let slope = (deflection * (3.0 * cube) + 2.0 * square) * deflection;
                self.diagonal[dof] += slope.max(angle.constant(0.0)) * (step_s * step_s / 4.0);
            }
        }
    }

    /// Writes the whitened acceleration with the gyroscopic forces at velocity `rates` into [`Self::total`].
    #[inline(always)]
    pub(crate) fn solve(
        &mut self,
        structure: &Structure,
        posture: &Posture<S>,
        matrix: &MassMatrix<S>,
        rates: &[Lanes<S>],
    ) {
        self.bias_forces(structure, posture, rates);
        for (total, passive) in self.total.iter_mut().zip(&self.root) {
            total[0] += *passive;
        }
        for (total, hinge) in self.total[ROOT_DOFS..].iter_mut().zip(&self.hinges) {
            total[0] += hinge.base_nm + hinge.passive_nm;
        }
        matrix.whiten_rows(structure, 0..structure.dofs(), &mut self.total);
    }

    /// Writes the negative bias forces, by the recursive Newton-Euler algorithm (Featherstone 2008, table 5.1).
    #[inline(always)]
    fn bias_forces(&mut self, structure: &Structure, posture: &Posture<S>, rates: &[Lanes<S>]) {
        let root = posture.root_velocity(rates);
        self.velocities[0] = root;
        // The rotation axes move with the root; its linear coordinates are the velocity of its origin.
        let zero = root.linear.x.constant(0.0);
        self.accelerations[0] = Motion {
            angular: Vec3::new(zero, zero, zero),
            linear: root.linear.cross(&root.angular) - self.gravity_mps2,
        };
        for (index, node) in structure.nodes.iter().enumerate().skip(1) {
            let (mut velocity, mut acceleration) = (self.velocities[node.parent], self.accelerations[node.parent]);
            for hinge in node.hinges.clone() {
                let axis = &posture.axes[ROOT_DOFS + hinge];
                let rate = rates[ROOT_DOFS + hinge];
                let joint = Motion { angular: axis.angular * rate, linear: axis.linear * rate };
                acceleration += velocity.cross(&joint);
                velocity += joint;
            }
            self.velocities[index] = velocity;
            self.accelerations[index] = acceleration;
        }
        for (index, inertia) in posture.inertias.iter().enumerate() {
            let velocity = &self.velocities[index];
            let mut load = inertia.times(&self.accelerations[index]);
            load += velocity.cross_force(&inertia.times(velocity));
            let held = structure.nodes[index].gravity_compensation;
            if held != 0.0 {
                let gravity =
                    Motion { angular: Vec3::new(zero, zero, zero), linear: self.gravity_mps2 * zero.constant(held) };
                load += inertia.times(&gravity);
            }
            self.loads[index] = load;
        }
        for (index, node) in structure.nodes.iter().enumerate().skip(1).rev() {
            let load = self.loads[index];
            for hinge in node.hinges.clone() {
                self.total[ROOT_DOFS + hinge] = [-posture.axes[ROOT_DOFS + hinge].dot(&load)];
            }
            self.loads[node.parent] += load;
        }
        let whole = self.loads[0];
        for (total, part) in self.total.iter_mut().zip([whole.force.x, whole.force.y, whole.force.z]) {
            *total = [-part];
        }
        for dof in 3..ROOT_DOFS {
            self.total[dof] = [-posture.axes[dof].dot(&whole)];
        }
    }
}
