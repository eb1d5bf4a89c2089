//! Steps of several worlds of one model at once.
//!
//! The integrator is the implicit midpoint rule, of second order: forces and constraints are those of the step's middle.

use super::exchange::set_lane;
use super::group::{Group, Pass, Worlds};
use super::momentum::{Momentum, is_free};
use crate::articulation::{ROOT_DOFS, compose, integrate};
use crate::collision::Root;
use crate::lanes::{Force, Lanes, NullaryFnOnce, Simd, Vec3};

/// Workspace that steps several worlds of one structure.
pub(crate) trait Engine {
    /// Returns the most worlds of a pass.
    fn lanes(&self) -> usize;

    /// Simulates physics steps and updates everything in the worlds.
    fn advance(&mut self, pass: Pass<'_>, worlds: Worlds<'_, '_>, steps: u32);

    /// Updates what follows from positions and velocities; no time passes.
    fn refresh(&mut self, pass: Pass<'_>, worlds: Worlds<'_, '_>);
}

/// Parts of a step as operations that `pulp` compiles for the machine's registers: everything that computes with lanes
/// must be inlined into one of them.
macro_rules! parts {
    ($($part:ident => $method:ident),*) => { $(
        struct $part<'a, S: Simd>(&'a mut Group<S>, Pass<'a>);

        impl<S: Simd> NullaryFnOnce for $part<'_, S> {
            type Output = ();
            #[inline(always)]
            fn call(self) {
                self.0.$method(self.1);
            }
        }
    )* };
}

parts!(
    MoveToMiddle => move_to_middle,
    AssembleMatrix => assemble_matrix,
    Begin => begin,
    PredictAcceleration => predict_acceleration,
    SolveForces => solve_forces,
    FindContacts => find_contacts,
    SolveConstraints => solve_constraints,
    Integrate => integrate,
    Finish => finish,
    Place => place
);

impl<S: Simd> Group<S> {
    fn step(&mut self, pass: Pass<'_>, is_first: bool) {
        let simd = self.simd;
        simd.vectorize(MoveToMiddle(self, pass));
        simd.vectorize(AssembleMatrix(self, pass));
        if is_first {
            simd.vectorize(PredictAcceleration(self, pass));
        }
        simd.vectorize(SolveForces(self, pass));
        simd.vectorize(FindContacts(self, pass));
        simd.vectorize(SolveConstraints(self, pass));
        simd.vectorize(Integrate(self, pass));
    }

    /// Notes momentum and centre of mass at the start.
    #[inline(always)]
    fn begin(&mut self, pass: Pass<'_>) {
        let momentum = self.present_momentum(pass);
        self.momentum = momentum.about_centre;
        self.centre_m = momentum.centre_m;
    }

    #[inline(always)]
    fn present_momentum(&mut self, pass: Pass<'_>) -> Momentum<S> {
        self.posture.update_kinematics(pass.structure, &self.position);
        self.posture.update_inertia(&self.masses);
        self.posture.velocities(pass.structure, &self.velocity, &mut self.velocities);
        Momentum::of(self.simd, &self.posture, &self.velocities)
    }

    #[inline(always)]
    fn move_to_middle(&mut self, pass: Pass<'_>) {
        integrate(&self.moved, &self.velocity, pass.step_s / 2.0, &mut self.middle);
        compose(&self.start, &mut self.middle);
        self.posture.update_kinematics(pass.structure, &self.middle);
        self.posture.update_inertia(&self.masses);
        self.middle_m = Vec3::new(self.middle[0], self.middle[1], self.middle[2]);
    }

    #[inline(always)]
    fn assemble_matrix(&mut self, pass: Pass<'_>) {
        self.forces.prepare(pass.structure, &self.middle, &self.velocity, pass.step_s);
        self.matrix.assemble(pass.structure, &self.posture, &self.forces.diagonal);
        self.constraints.note_masses(&self.matrix);
        self.matrix.factor(pass.structure);
    }

    /// Computes the acceleration with the gyroscopic forces of the start, for the first step.
    #[inline(always)]
    fn predict_acceleration(&mut self, pass: Pass<'_>) {
        self.forces.solve(pass.structure, &self.posture, &self.matrix, &self.velocity);
        for (acceleration, total) in self.acceleration.iter_mut().zip(&self.forces.total) {
            *acceleration = total[0];
        }
        self.matrix.unwhiten(pass.structure, &mut self.acceleration);
    }

    /// Solves for the acceleration without constraints. Gyroscopic forces are those at the velocity of the middle; the
    /// acceleration up to there is that of the previous step.
    #[inline(always)]
    fn solve_forces(&mut self, pass: Pass<'_>) {
        let half = Lanes::splat(self.simd, pass.step_s / 2.0);
        for (rate, (old, acceleration)) in self.rates.iter_mut().zip(self.velocity.iter().zip(&self.acceleration)) {
            *rate = acceleration.mul_add(half, *old);
        }
        self.forces.solve(pass.structure, &self.posture, &self.matrix, &self.rates);
        for (whitened, total) in self.constraints.whitened.iter_mut().zip(&self.forces.total) {
            *whitened = total[0];
        }
    }

    #[inline(always)]
    fn find_contacts(&mut self, pass: Pass<'_>) {
        let (start_m, moved_m) = (&self.start_m[..self.worlds], &self.middle_m);
        let root = Root { start_m, moved_m, height_m: self.start[2] + moved_m.z };
        self.collisions.find(pass.collision, &self.posture, &root);
    }

    #[inline(always)]
    fn solve_constraints(&mut self, pass: Pass<'_>) {
        self.constraints.solve(
            pass.structure,
            &pass.collision.pairs,
            &self.posture,
            &self.matrix,
            &self.forces,
            &self.collisions,
            &self.middle,
            &self.velocity,
            &self.acceleration,
            pass.step_s,
        );
    }

    #[inline(always)]
    fn integrate(&mut self, pass: Pass<'_>) {
        let (half, whole) = (Lanes::splat(self.simd, pass.step_s / 2.0), Lanes::splat(self.simd, pass.step_s));
        self.acceleration.copy_from_slice(&self.constraints.whitened);
        self.matrix.unwhiten(pass.structure, &mut self.acceleration);
        for ((rate, velocity), acceleration) in self.rates.iter_mut().zip(&mut self.velocity).zip(&self.acceleration) {
            *rate = acceleration.mul_add(half, *velocity);
            *velocity = acceleration.mul_add(whole, *velocity);
        }
        self.middle.copy_from_slice(&self.moved);
        integrate(&self.middle, &self.rates, pass.step_s, &mut self.moved);
        self.position.copy_from_slice(&self.moved);
        compose(&self.start, &mut self.position);
        self.add_impulses(pass);
    }

    /// Adds the contacts' impulses to their links.
    #[inline(always)]
    fn add_impulses(&mut self, pass: Pass<'_>) {
        let zero = Lanes::zero(self.simd);
        let (mut mass, mut moment) = (zero, Vec3::zero(self.simd));
        for inertia in &self.posture.inertias {
            mass += inertia.mass_kg;
            moment += inertia.first_moment;
        }
        let centre_m = moment * (zero.constant(1.0) / mass);
        let before = self.momentum.force;
        let gravity = self.forces.gravity_mps2 * (mass * pass.step_s);
        self.momentum.force += gravity;
        self.constraints.add_moments(&mut self.momentum.moment, zero.constant(pass.step_s));
        self.constraints.write_loads(&mut self.loads);
        for load in &self.loads {
            let force = load.force_n * zero.constant(pass.step_s);
            let impulse = Force { moment: (load.point_m - centre_m).cross(&force), force };
            let [first, second] = pass.collision.pairs[load.pair].links;
            if let Some(link) = first {
                self.impulses[link] += impulse;
            }
            match second {
                Some(link) => self.impulses[link] -= impulse,
                None => self.momentum += impulse,
            }
        }
        self.centre_m += (before + self.momentum.force) * (zero.constant(pass.step_s / 2.0) / mass);
    }

    /// Computes torques of the motors, and corrects the momentum.
    #[inline(always)]
    fn finish(&mut self, pass: Pass<'_>) {
        for (index, (torque_nm, hinge)) in self.torques_nm.iter_mut().zip(&self.forces.hinges).enumerate() {
            *torque_nm = hinge.base_nm - hinge.base_kgm2 * self.acceleration[ROOT_DOFS + index]
                + self.constraints.servo_nm(index);
        }
        if is_free(pass.structure) {
            self.restore_momentum(pass);
        }
    }

    /// Corrects the root's state so that momentum and centre of mass are those that gravity and contacts leave.
    #[inline(always)]
    fn restore_momentum(&mut self, pass: Pass<'_>) {
        let found = self.present_momentum(pass);
        let correction = found.correction(&self.momentum);
        let turned = self.posture.rotations[0].transpose_times(&correction.angular);
        for (rate, change) in self.velocity.iter_mut().zip([
            correction.linear.x,
            correction.linear.y,
            correction.linear.z,
            turned.x,
            turned.y,
            turned.z,
        ]) {
            *rate += change;
        }
        let root_m = self.centre_m - found.centre_m;
        for (number, part) in self.moved.iter_mut().zip([root_m.x, root_m.y, root_m.z]) {
            *number = part;
        }
    }

    /// Computes poses and velocities of the bodies.
    #[inline(always)]
    fn place(&mut self, pass: Pass<'_>) {
        let structure = pass.structure;
        self.posture.update_kinematics(structure, &self.position);
        self.posture.velocities(structure, &self.velocity, &mut self.velocities);
        for (velocity, centre_m) in self.velocities.iter_mut().zip(&self.posture.centres_m) {
            velocity.linear = velocity.at(centre_m);
        }
    }
}

impl<S: Simd> Engine for Group<S> {
    fn lanes(&self) -> usize {
        S::F32_LANES
    }

    fn advance(&mut self, pass: Pass<'_>, worlds: Worlds<'_, '_>, steps: u32) {
        self.load(worlds);
        self.constraints.forget();
        self.impulses.fill(Force::zero(self.simd));
        let simd = self.simd;
        simd.vectorize(Begin(self, pass));
        for step in 0..steps {
            self.step(pass, step == 0);
        }
        simd.vectorize(Finish(self, pass));
        self.store_state(worlds);
        simd.vectorize(Place(self, pass));
        self.store(pass.collision, worlds);
    }

    fn refresh(&mut self, pass: Pass<'_>, worlds: Worlds<'_, '_>) {
        for (lane, world) in worlds.iter().flatten().enumerate() {
            set_lane(&mut self.position, lane, &world.position);
            set_lane(&mut self.velocity, lane, &world.velocity);
            self.posture.root_centre_m.set_lane(lane, &world.parameters.root_centre_m);
        }
        let simd = self.simd;
        simd.vectorize(Place(self, pass));
        for (lane, world) in worlds.iter_mut().flatten().enumerate() {
            self.store_bodies(lane, world);
        }
    }
}
