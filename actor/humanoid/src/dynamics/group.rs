//! Worlds of one pass, one per lane of a vector register.

use nalgebra::Vector3;

use super::constraints::{Constraints, Load};
use super::forces::Forces;
use super::world::World;
use crate::articulation::{BodyMasses, MassMatrix, Posture, Structure};
use crate::collision::{CollisionModel, Collisions};
use crate::lanes::{Force, LANES_MAX, Lanes, Motion, Simd, Vec3};

/// Worlds of one pass; the first ones are given.
pub(crate) type Worlds<'a, 'w> = &'a mut [Option<&'w mut World>; LANES_MAX];

/// What all parts of a step need.
#[derive(Clone, Copy)]
pub(crate) struct Pass<'a> {
    pub(crate) structure: &'a Structure,
    pub(crate) collision: &'a CollisionModel,
    /// Duration of one physics step (s).
    pub(crate) step_s: f64,
}

/// Workspace with one world per lane.
pub(crate) struct Group<S: Simd> {
    pub(super) simd: S,
    /// Number of worlds in this pass.
    pub(super) worlds: usize,
    /// Root of each world at the start of the pass (m): too far from the world's origin for single precision.
    pub(super) start_m: [Vector3<f64>; LANES_MAX],
    /// Position vectors at the start of the pass.
    pub(super) start: Vec<Lanes<S>>,
    /// Motion since then: position vectors relative to `start`. Worlds add it in double precision, so that a slow motion is
    /// not lost in the rounding of the position.
    pub(super) moved: Vec<Lanes<S>>,
    /// Present position vectors; the root's place is relative to `start_m`.
    pub(super) position: Vec<Lanes<S>>,
    pub(super) velocity: Vec<Lanes<S>>,
    pub(super) acceleration: Vec<Lanes<S>>,
    pub(super) middle: Vec<Lanes<S>>,
    pub(super) rates: Vec<Lanes<S>>,
    pub(super) masses: Vec<BodyMasses<S>>,
    pub(super) posture: Posture<S>,
    pub(super) matrix: MassMatrix<S>,
    pub(super) forces: Forces<S>,
    pub(super) constraints: Constraints<S>,
    pub(super) collisions: Collisions<S>,
    pub(super) velocities: Vec<Motion<S>>,
    /// Moment about the centre of mass, and force, of the contacts of each link, × time.
    pub(super) impulses: Vec<Force<S>>,
    pub(super) torques_nm: Vec<Lanes<S>>,
    /// Root at the middle of the last step (m, relative to `start_m`), to which its contact points are relative.
    pub(super) middle_m: Vec3<S>,
    /// Contacts of the last step.
    pub(super) loads: Vec<Load<S>>,
    /// Momentum that gravity and contacts leave, about the centre of mass.
    pub(super) momentum: Force<S>,
    /// Where the centre of mass then is (m, relative to `start_m`).
    pub(super) centre_m: Vec3<S>,
}

impl<S: Simd> Group<S> {
    pub(crate) fn new(simd: S, structure: &Structure, collision: &CollisionModel) -> Self {
        let (zero, one) = (Lanes::zero(simd), Lanes::splat(simd, 1.0));
        let (bodies, dofs) = (structure.nodes.len(), structure.dofs());
        let mut position = vec![zero; structure.positions()];
        position[3] = one;
        Self {
            simd,
            worlds: 0,
            start_m: [Vector3::zeros(); LANES_MAX],
            start: position.clone(),
            moved: position.clone(),
            middle: position.clone(),
            position,
            velocity: vec![zero; dofs],
            acceleration: vec![zero; dofs],
            rates: vec![zero; dofs],
            masses: vec![BodyMasses { mass_kg: one, inertia_kgm2: [one, one, one, zero, zero, zero] }; bodies],
            posture: Posture::new(simd, structure),
            matrix: MassMatrix::new(simd, structure),
            forces: Forces::new(simd, structure),
            constraints: Constraints::new(simd, structure),
            collisions: Collisions::new(simd, collision),
            velocities: vec![Motion::zero(simd); bodies],
            impulses: vec![Force::zero(simd); structure.link_bodies.len()],
            torques_nm: vec![zero; structure.hinges.len()],
            middle_m: Vec3::zero(simd),
            loads: Vec::with_capacity(32),
            momentum: Force::zero(simd),
            centre_m: Vec3::zero(simd),
        }
    }
}
