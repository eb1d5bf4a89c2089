//! Linear and angular momentum of a whole robot, which only gravity and the ground change.
//!
//! Time stepping conserves momentum only approximately. A correction of the root's state restores it exactly, which
//! costs less than finer steps.

use crate::articulation::{Posture, ROOT_DOFS, Structure};
use crate::lanes::{Force, Inertia, Motion, Simd, Vec3};

/// Momentum of a robot, and its inertia.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Momentum<S: Simd> {
    /// Moment of momentum about the centre of mass (N·m·s) and linear momentum (N·s).
    pub(crate) about_centre: Force<S>,
    /// Centre of mass (m, relative to O).
    pub(crate) centre_m: Vec3<S>,
    inertia: Inertia<S>,
}

impl<S: Simd> Momentum<S> {
    /// Sums over the bodies of a posture with inertia, moving at the given velocities.
    #[inline(always)]
    pub(crate) fn of(simd: S, posture: &Posture<S>, velocities: &[Motion<S>]) -> Self {
        let (mut inertia, mut sum) = (Inertia::zero(simd), Force::zero(simd));
        for (part, velocity) in posture.inertias.iter().zip(velocities) {
            inertia += *part;
            sum += part.times(velocity);
        }
        let centre_m = inertia.first_moment * (sum.force.x.constant(1.0) / inertia.mass_kg);
        let about_centre = Force { moment: sum.moment - centre_m.cross(&sum.force), force: sum.force };
        Self { about_centre, centre_m, inertia }
    }

    /// Returns the velocity of the root, as linear and angular part in world axes, that has to be added for this momentum to
    /// become `wanted` (moment about the centre).
    #[inline(always)]
    pub(crate) fn correction(&self, wanted: &Force<S>) -> Motion<S> {
        let missing = wanted.moment - self.about_centre.moment;
        let angular = self.solve(&missing);
        let one = self.inertia.mass_kg.constant(1.0);
        let linear = (wanted.force - self.about_centre.force) * (one / self.inertia.mass_kg);
        Motion { angular, linear: linear - angular.cross(&self.centre_m) }
    }

    /// Solves inertia about the centre × x = moment, by the adjugate.
    #[inline(always)]
    fn solve(&self, moment: &Vec3<S>) -> Vec3<S> {
        let (c, m) = (&self.centre_m, self.inertia.mass_kg);
        let [xx, yy, zz, xy, xz, yz] = self.inertia.about_origin;
        let (mx, my, mz) = (c.x * m, c.y * m, c.z * m);
        let (xx, yy, zz) = (xx - (c.y * my + c.z * mz), yy - (c.x * mx + c.z * mz), zz - (c.x * mx + c.y * my));
        let (xy, xz, yz) = (xy + c.x * my, xz + c.x * mz, yz + c.y * mz);
        let first = Vec3::new(yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy);
        let second = Vec3::new(first.y, xx * zz - xz * xz, xy * xz - xx * yz);
        let third = Vec3::new(first.z, second.z, xx * yy - xy * xy);
        let determinant = xx * first.x + xy * first.y + xz * first.z;
        Vec3::new(first.dot(moment), second.dot(moment), third.dot(moment)) * (m.constant(1.0) / determinant)
    }
}

/// Whether gravity and contacts are all that acts on a robot as a whole, and nothing weighs less than its mass.
pub(crate) fn is_free(structure: &Structure) -> bool {
    structure.root_damping == 0.0
        && structure.root_armature == 0.0
        && structure.nodes.iter().all(|node| node.gravity_compensation == 0.0)
        && structure.coordinates.iter().all(|coordinate| coordinate.terms.iter().all(|(dof, _)| *dof >= ROOT_DOFS))
}
