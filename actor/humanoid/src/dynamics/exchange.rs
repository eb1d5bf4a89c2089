//! Exchange between the lanes of a group and its worlds.

use nalgebra::{Quaternion, Vector3};

use super::group::{Group, Worlds};
use super::world::{BodyState, ContactLoad, Impulse, World};
use crate::articulation::ROOT_POSITIONS;
use crate::collision::CollisionModel;
use crate::lanes::{Lanes, Simd};

/// Magnitude (m, rad, m/s or rad/s) from which a state counts as a fault, as in MuJoCo (`mjMAXVAL`).
const NUMBER_MAX: f64 = 1e10;

impl<S: Simd> Group<S> {
    /// Copies states and parameters of the worlds into the lanes. Lanes without a world repeat the first one: left
    /// alone, they would go on with bodies that have long fallen, whose many contacts take time.
    pub(super) fn load(&mut self, worlds: Worlds<'_, '_>) {
        self.worlds = worlds.iter().flatten().count();
        let first = worlds[0].as_deref();
        for (lane, world) in worlds.iter().take(S::F32_LANES).enumerate() {
            let Some(world) = world.as_deref().or(first) else { return };
            self.start_m[lane] = Vector3::from_column_slice(&world.position[..3]);
            set_lane(&mut self.position, lane, &world.position);
            set_lane(&mut self.velocity, lane, &world.velocity);
            let parameters = &world.parameters;
            for (index, body) in self.masses.iter_mut().enumerate() {
                body.mass_kg.set_lane(lane, parameters.masses_kg[index]);
                let own = &parameters.inertias_kgm2[index];
                for (number, (row, column)) in
                    body.inertia_kgm2.iter_mut().zip([(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)])
                {
                    number.set_lane(lane, own[(row, column)]);
                }
            }
            for (index, (hinge, drive)) in self.forces.hinges.iter_mut().zip(&world.drives).enumerate() {
                hinge.friction_nmsprad.set_lane(lane, parameters.damping_nmsprad[index]);
                for (lanes, power) in hinge.friction_powers.iter_mut().zip(parameters.damping_powers[index]) {
                    lanes.set_lane(lane, power);
                }
                hinge.armature_kgm2.set_lane(lane, parameters.armature_kgm2[index]);
                hinge.torque_nm.set_lane(lane, drive.torque_nm);
                hinge.stiffness_nmprad.set_lane(lane, drive.stiffness_nmprad);
                hinge.damping_nmsprad.set_lane(lane, drive.damping_nmsprad);
                hinge.min_nm.set_lane(lane, drive.min_nm);
                hinge.max_nm.set_lane(lane, drive.max_nm);
            }
            self.posture.root_centre_m.set_lane(lane, &parameters.root_centre_m);
            self.forces.gravity_mps2.set_lane(lane, &parameters.gravity_mps2);
            self.constraints.friction_scale.set_lane(lane, parameters.friction_scale);
        }
        self.start.copy_from_slice(&self.position);
        self.moved.fill(Lanes::zero(self.simd));
        self.moved[3] = Lanes::splat(self.simd, 1.0);
    }

    /// Adds the motion of the pass to the states, where it is finite, and takes the positions back as the worlds have
    /// them: what follows from a position must not depend on how it was reached.
    pub(super) fn store_state(&mut self, worlds: Worlds<'_, '_>) {
        for (lane, world) in worlds.iter_mut().flatten().enumerate() {
            let moved = |index: usize| self.moved[index].lane(lane);
            let position = &mut world.position;
            let turned = Quaternion::new(position[3], position[4], position[5], position[6])
                * Quaternion::new(moved(3), moved(4), moved(5), moved(6));
            let mut numbers = self.moved.iter().chain(&self.velocity);
            // A turn that is no number of single precision has lost its norm.
            world.has_failed = !numbers.all(|number| number.lane(lane).abs() < NUMBER_MAX)
                || !position.iter().all(|number| number.abs() < NUMBER_MAX)
                || turned.norm_squared() < 0.5;
            if world.has_failed {
                continue;
            }
            for (index, number) in position.iter_mut().enumerate() {
                *number += moved(index);
            }
            let [x, y, z, w] = turned.normalize().coords.into();
            position[3..ROOT_POSITIONS].copy_from_slice(&[w, x, y, z]);
            get_lane(&self.velocity, lane, &mut world.velocity);
            set_lane(&mut self.position, lane, &world.position);
        }
    }

    pub(super) fn store_bodies(&self, lane: usize, world: &mut World) {
        for (index, body) in world.bodies.iter_mut().enumerate() {
            *body = BodyState {
                rotation: self.posture.rotations[index].lane(lane),
                origin_m: self.posture.origins_m[index].lane(lane),
                centre_m: self.posture.centres_m[index].lane(lane),
                linear_mps: self.velocities[index].linear.lane(lane),
                angular_radps: self.velocities[index].angular.lane(lane),
            };
        }
    }

    /// Writes what follows from the states, and forces.
    pub(super) fn store(&self, collision: &CollisionModel, worlds: Worlds<'_, '_>) {
        for (lane, world) in worlds.iter_mut().flatten().enumerate() {
            if world.has_failed {
                continue;
            }
            get_lane(&self.torques_nm, lane, &mut world.torques_nm);
            self.store_bodies(lane, world);
            for (impulse, sum) in world.link_impulses.iter_mut().zip(&self.impulses) {
                *impulse = Impulse { linear_ns: sum.force.lane(lane), angular_nms: sum.moment.lane(lane) };
            }
            world.contacts.clear();
            let origin_m = self.start_m[lane] + self.middle_m.lane(lane);
            for load in &self.loads {
                let force_n = load.force_n.lane(lane);
                if force_n != Vector3::zeros() {
                    let at_m = origin_m + load.point_m.lane(lane);
                    world.contacts.push(ContactLoad { links: collision.pairs[load.pair].links, at_m, force_n });
                }
            }
        }
    }
}

pub(super) fn set_lane<S: Simd>(lanes: &mut [Lanes<S>], lane: usize, numbers: &[f64]) {
    for (lanes, number) in lanes.iter_mut().zip(numbers) {
        lanes.set_lane(lane, *number);
    }
}

fn get_lane<S: Simd>(lanes: &[Lanes<S>], lane: usize, numbers: &mut [f64]) {
    for (number, lanes) in numbers.iter_mut().zip(lanes) {
        *number = lanes.lane(lane);
    }
}
