//! Motion without contacts: motors, springs, friction, rotors, gravity, gyroscopic forces, limits.
//!
//! The integrator is the implicit midpoint rule, of second order: forces are those of the step's middle. The hinges' springs
//! and friction enter the matrix, so that the step is stable at any stiffness. One fixed-point pass finds the gyroscopic
//! forces. Contacts then change the final velocity ([`Flight::solve_constraints`]).

use nalgebra::Vector3;

use super::contacts::Contacts;
use super::limits::Limits;
use super::mass_matrix::MassMatrix;
use super::momentum::Momentum;
use super::posture::{Posture, integrate};
use super::spatial::{Force, Motion};
use super::tree::{ROOT_DOFS, ROOT_POSITIONS, Tree};

/// Integration steps per flight: two are as accurate as MuJoCo's implicit integrators at 3 ms.
const HALF_STEPS: u32 = 2;

/// Results and workspace of a flight.
#[derive(Clone, Debug)]
pub(crate) struct Flight {
    /// Posture in the middle of the last half-step; contacts use it for the whole step.
    pub(crate) middle: Posture,
    /// Factored mass matrix at `middle`, with rotors and implicit friction.
    matrix: MassMatrix,
    /// Position at the end.
    pub(crate) position: Vec<f64>,
    /// Velocity at the end.
    pub(crate) velocity: Vec<f64>,
    /// Momentum at the start.
    start_momentum: Momentum,
    limits: Limits,
    diagonal: Vec<f64>,
    middle_position: Vec<f64>,
    mean_velocity: Vec<f64>,
    end_velocity: Vec<f64>,
    acceleration: Vec<f64>,
    forces: Vec<f64>,
    velocities: Vec<Motion>,
    accelerations: Vec<Motion>,
    loads: Vec<Force>,
}

impl Flight {
    pub(crate) fn new(tree: &Tree) -> Self {
        let (dofs, bodies) = (tree.dofs(), tree.nodes.len());
        let positions = ROOT_POSITIONS + tree.hinges.len();
        Self {
            middle: Posture::new(tree),
            matrix: MassMatrix::new(tree),
            position: vec![0.0; positions],
            velocity: vec![0.0; dofs],
            start_momentum: Momentum::default(),
            limits: Limits::new(tree),
            diagonal: vec![0.0; dofs],
            middle_position: vec![0.0; positions],
            mean_velocity: vec![0.0; dofs],
            end_velocity: vec![0.0; dofs],
            acceleration: vec![0.0; dofs],
            forces: vec![0.0; dofs],
            velocities: vec![Motion::default(); bodies],
            accelerations: vec![Motion::default(); bodies],
            loads: vec![Force::default(); bodies],
        }
    }

    /// Integrates (`position`, `velocity`) over `time_s` under the motors' torques (N·m, one per hinge).
    ///
    /// The result is in [`Self::position`] and [`Self::velocity`]; [`Self::solve_constraints`] must follow.
    /// `start` must be the posture at `position`, with inertia.
    pub(crate) fn advance(
        &mut self,
        tree: &Tree,
        start: &Posture,
        position: &[f64],
        velocity: &[f64],
        torques_nm: &[f64],
        time_s: f64,
    ) {
        start.velocities(tree, velocity, &mut self.velocities);
        self.start_momentum = Momentum::of(start, &self.velocities);
        self.position.copy_from_slice(position);
        self.velocity.copy_from_slice(velocity);
        for half_step in 0..HALF_STEPS {
            self.half_step(tree, torques_nm, time_s / f64::from(HALF_STEPS), half_step == 0);
        }
    }

    /// Returns the centre of mass at the start (m, relative to the root there).
    pub(crate) fn start_centre_m(&self) -> Vector3<f64> {
        self.start_momentum.centre_m
    }

    /// Applies contacts: replaces the state at the start of the flight by that at its end, and updates its posture with
    /// inertia.
    pub(crate) fn solve_constraints(
        &mut self,
        tree: &Tree,
        contacts: &mut Contacts,
        position: &mut [f64],
        velocity: &mut [f64],
        posture: &mut Posture,
        time_s: f64,
    ) {
        self.end_velocity.copy_from_slice(&self.velocity);
        let (middle, limits) = (&self.middle, &mut self.limits);
        let start_m = Vector3::from_column_slice(&position[..3]);
        let has_contacts =
            contacts.solve(tree, middle, &self.matrix, limits, position, velocity, &mut self.end_velocity, time_s);
        if has_contacts {
            for (mean, (new, free)) in self.mean_velocity.iter_mut().zip(self.end_velocity.iter().zip(&self.velocity)) {
                *mean = (new - free) / 2.0;
            }
            integrate(&self.position, &self.mean_velocity, time_s, position);
        } else {
            position.copy_from_slice(&self.position);
        }
        velocity.copy_from_slice(&self.end_velocity);
        posture.update_kinematics(tree, position);
        posture.update_inertia(tree);
        posture.velocities(tree, velocity, &mut self.velocities);
        let after = Momentum::of(posture, &self.velocities);
        let before = &self.start_momentum;
        let target = before.expected_after(&tree.gravity_mps2, time_s, &contacts.floor_impulse(&before.centre_m));
        after.restore(posture, &target.about_centre, velocity);
        // The centre of mass follows the momentum alone: without contacts, along a parabola.
        let moved = (before.velocity_mps() + target.velocity_mps()) * (time_s / 2.0);
        let root_m = start_m + before.centre_m + moved - after.centre_m;
        position[..3].copy_from_slice(root_m.as_slice());
    }

    fn half_step(&mut self, tree: &Tree, torques_nm: &[f64], step_s: f64, is_first: bool) {
        integrate(&self.position, &self.velocity, step_s / 2.0, &mut self.middle_position);
        self.middle.update_kinematics(tree, &self.middle_position);
        self.middle.update_inertia(tree);
        self.matrix.assemble(tree, &self.middle);
        for (hinge, node) in tree.hinges.iter().enumerate() {
            self.diagonal[ROOT_DOFS + hinge] = node.armature_kgm2
                + node.damping_nmsprad * step_s / 2.0
                + node.stiffness_nmprad * step_s * step_s / 4.0;
        }
        self.matrix.add_diagonal(tree, &self.diagonal);
        self.matrix.factor(tree);

        // Gyroscopic forces are those at the velocity of the middle. The acceleration up to the middle is that of the previous
        // half-step, or in the first one that with the gyroscopic forces of the start.
        if is_first {
            self.mean_velocity.copy_from_slice(&self.velocity);
            self.solve_acceleration(tree, torques_nm, step_s);
        }
        for (mean, (old, acceleration)) in
            self.mean_velocity.iter_mut().zip(self.velocity.iter().zip(&self.acceleration))
        {
            *mean = old + acceleration * step_s / 2.0;
        }
        self.solve_acceleration(tree, torques_nm, step_s);
        for (new, (old, acceleration)) in self.end_velocity.iter_mut().zip(self.velocity.iter().zip(&self.acceleration))
        {
            *new = old + acceleration * step_s;
        }
        self.limits.solve(tree, &self.matrix, &self.position, &self.velocity, &mut self.end_velocity, step_s);
        for (mean, (old, new)) in self.mean_velocity.iter_mut().zip(self.velocity.iter().zip(&self.end_velocity)) {
            *mean = (old + new) / 2.0;
        }
        integrate(&self.position, &self.mean_velocity, step_s, &mut self.middle_position);
        std::mem::swap(&mut self.position, &mut self.middle_position);
        std::mem::swap(&mut self.velocity, &mut self.end_velocity);
    }

    /// Solves for the acceleration with the gyroscopic forces at `mean_velocity`.
    fn solve_acceleration(&mut self, tree: &Tree, torques_nm: &[f64], step_s: f64) {
        self.bias_forces(tree);
        for (hinge, node) in tree.hinges.iter().enumerate() {
            let dof = ROOT_DOFS + hinge;
            let deflection = self.position[ROOT_POSITIONS + hinge] + self.velocity[dof] * step_s / 2.0 - node.rest_rad;
            self.forces[dof] +=
                torques_nm[hinge] - node.damping_nmsprad * self.velocity[dof] - node.stiffness_nmprad * deflection;
        }
        self.acceleration.copy_from_slice(&self.forces);
        self.matrix.solve(tree, &mut self.acceleration);
    }

    /// Writes the negative bias forces, by the recursive Newton-Euler algorithm (Featherstone 2008, table 5.1).
    fn bias_forces(&mut self, tree: &Tree) {
        let (posture, rates) = (&self.middle, &self.mean_velocity);
        let linear = Vector3::new(rates[0], rates[1], rates[2]);
        let mut root = Motion::default();
        for (axis, rate) in posture.axes.iter().zip(rates).take(ROOT_DOFS) {
            root += *axis * *rate;
        }
        self.velocities[0] = root;
        // The rotation axes move with the root; its linear coordinates are the velocity of its origin.
        self.accelerations[0] = Motion::new(Vector3::zeros(), linear.cross(&root.angular) - tree.gravity_mps2);
        for (index, node) in tree.nodes.iter().enumerate().skip(1) {
            let (mut velocity, mut acceleration) = (self.velocities[node.parent], self.accelerations[node.parent]);
            for hinge in node.hinges.clone() {
                let joint_velocity = posture.axes[ROOT_DOFS + hinge] * rates[ROOT_DOFS + hinge];
                acceleration += velocity.cross(&joint_velocity);
                velocity += joint_velocity;
            }
            self.velocities[index] = velocity;
            self.accelerations[index] = acceleration;
        }
        for (index, inertia) in posture.inertias.iter().enumerate() {
            let velocity = &self.velocities[index];
            self.loads[index] = inertia.times(&self.accelerations[index]);
            self.loads[index] += velocity.cross_force(&inertia.times(velocity));
        }
        for (index, node) in tree.nodes.iter().enumerate().skip(1).rev() {
            let load = self.loads[index];
            for hinge in node.hinges.clone() {
                self.forces[ROOT_DOFS + hinge] = -posture.axes[ROOT_DOFS + hinge].dot(&load);
            }
            self.loads[node.parent] += load;
        }
        for dof in 0..ROOT_DOFS {
            self.forces[dof] = -posture.axes[dof].dot(&self.loads[0]);
        }
    }
}
