//! Contacts with friction as MuJoCo's pyramids.
//!
//! The force of a contact with friction is a sum of non-negative forces along the four edges n ± μ t₁, n ± μ t₂ of a
//! pyramid. Each edge is a soft one-sided constraint.

use super::softness::soft_row;
use crate::articulation::{MassMatrix, Posture, ROOT_DOFS, Structure};
use crate::collision::{Contact, ContactKey, PairNode};
use crate::lanes::{Lanes, Mask, Simd, Vec3};

/// Edges of a friction pyramid.
pub(super) const EDGES: usize = 4;
/// Least friction of a pyramid, as MuJoCo's `mjMINMU`: the edges of a flat one would be infinitely stiff.
const FRICTION_MIN: f64 = 1e-5;
/// Least friction for which the edges' stiffness follows MuJoCo's formula. It grows with the inverse square: below, single
/// precision would turn rounding errors of accelerations into forces.
const STIFF_FRICTION_MIN: f64 = 0.01;

/// Least square of a direction's share in the plane of contact, so that its angle is not rounding.
const ALONG_MIN: f64 = 1e-6;

/// Contact of a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct ContactConstraint<S: Simd> {
    /// Index into the pairs that can touch, and of the point within the pair.
    pub(super) key: ContactKey,
    /// First of its numbers, `[dof][direction]`.
    pub(super) start: usize,
    /// Normal and tangents.
    pub(super) frame: [Vec3<S>; 3],
    pub(super) point_m: Vec3<S>,
    pub(super) edges: usize,
    /// Friction along the two tangents.
    pub(super) friction: [Lanes<S>; 2],
    /// Worlds in which it touches.
    pub(super) is_active: Mask<S>,
    pub(super) targets: [Lanes<S>; EDGES],
    pub(super) softness: Lanes<S>,
    pub(super) forces_n: [Lanes<S>; EDGES],
}

/// Numbers of all contacts' rows, whitened or not: `[contact][dof of its pair][direction]`, and workspace.
#[derive(Clone, Debug)]
pub(super) struct ContactRows<S: Simd> {
    pub(super) numbers: Vec<[Lanes<S>; 3]>,
    scratch: Vec<[Lanes<S>; 3]>,
}

impl<S: Simd> ContactRows<S> {
    pub(super) fn new(simd: S, structure: &Structure) -> Self {
        let zero = Lanes::zero(simd);
        Self { numbers: Vec::with_capacity(16 * structure.dofs()), scratch: vec![[zero; 3]; structure.dofs()] }
    }

    /// Adds the rows of two points of bodies, of which `None` is still: rates of the first against the second along the
    /// directions of `frame`, per rate of each degree of freedom, whitened by `whitening`. The first `skipped` degrees of
    /// freedom move both alike.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "the state of a step has many parts")]
    pub(super) fn push(
        &mut self,
        structure: &Structure,
        posture: &Posture<S>,
        whitening: Option<&MassMatrix<S>>,
        dofs: &[u32],
        points: [Option<(usize, Vec3<S>)>; 2],
        skipped: usize,
        frame: &[Vec3<S>; 3],
    ) {
        let zero = frame[0].x.constant(0.0);
        for dof in dofs {
            self.scratch[*dof as usize] = [zero; 3];
        }
        for (point, sign) in points.into_iter().zip([1.0, -1.0]) {
            let Some((body, point_m)) = point else { continue };
            for dof in structure.path_of_body(body).iter().skip(skipped) {
                let moved = posture.axes[*dof as usize].at(&point_m);
                let row = &mut self.scratch[*dof as usize];
                for (number, direction) in row.iter_mut().zip(frame) {
                    *number += moved.dot(direction) * sign;
                }
            }
        }
        if let Some(matrix) = whitening {
            matrix.whiten_rows(structure, dofs.iter().map(|dof| *dof as usize), &mut self.scratch);
        }
        for dof in dofs {
            self.numbers.push(self.scratch[*dof as usize]);
        }
    }

    /// Returns the products of a contact's rows and a vector.
    #[inline(always)]
    pub(super) fn products(&self, start: usize, dofs: &[u32], vector: &[Lanes<S>]) -> [Lanes<S>; 3] {
        let mut sums = [vector[0].constant(0.0); 3];
        for (row, dof) in self.numbers[start..start + dofs.len()].iter().zip(dofs) {
            let entry = vector[*dof as usize];
            for (sum, number) in sums.iter_mut().zip(row) {
                *sum = number.mul_add(entry, *sum);
            }
        }
        sums
    }

    /// Adds forces along a contact's directions to generalised forces, or to whitened accelerations.
    #[inline(always)]
    pub(super) fn add(&self, start: usize, dofs: &[u32], forces: &[Lanes<S>; 3], vector: &mut [Lanes<S>]) {
        for (row, dof) in self.numbers[start..start + dofs.len()].iter().zip(dofs) {
            let entry = &mut vector[*dof as usize];
            for (number, force) in row.iter().zip(forces) {
                *entry = number.mul_add(*force, *entry);
            }
        }
    }
}

impl<S: Simd> ContactConstraint<S> {
    /// Adds the rows of a contact and returns its constraint. `whitening` whitens the rows; `start_velocity` is
    /// whitened likewise.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "the state of a step has many parts")]
    pub(super) fn new(
        rows: &mut ContactRows<S>,
        structure: &Structure,
        posture: &Posture<S>,
        whitening: Option<&MassMatrix<S>>,
        pair: &PairNode,
        contact: &Contact<S>,
        friction_scale: Lanes<S>,
        start_velocity: &[Lanes<S>],
        warm: &[Lanes<S>; EDGES],
        step_s: f64,
    ) -> Self {
        let frame = frame(&contact.normal, contact.along.as_ref());
        let start = rows.numbers.len();
        // Contacts between two bodies do not move the robot as a whole.
        let skipped = if pair.bodies[1].is_some() { ROOT_DOFS } else { 0 };
        let points = pair.bodies.map(|body| body.map(|body| (body, contact.point_m)));
        rows.push(structure, posture, whitening, &pair.dofs, points, skipped, &frame);
        let zero = contact.gap_m.constant(0.0);
        let edges = if pair.friction != [0.0; 2] { EDGES } else { 1 };
        let least = if edges == 1 { 0.0 } else { FRICTION_MIN };
        let [first, second] = pair.friction;
        let friction = [friction_scale * first, friction_scale * second];
        let friction = [friction[0].max(zero.constant(least)), friction[1].max(zero.constant(least))];
        let violation = contact.gap_m - pair.margin_m;
        let active = violation.less_than(zero);
        // MuJoCo's approximate response of an edge, and its softness for pyramids ("diagApprox", "makeImpedance"): that of
        // the first tangent's edges holds for all.
        let stiff = friction[0].max(zero.constant(STIFF_FRICTION_MIN));
        let square = stiff * stiff;
        let response =
            if edges == 1 { zero.constant(pair.response) } else { (square + 1.0) * square * (2.0 * pair.response) };
        let rates = rows.products(start, &pair.dofs, start_velocity);
        let mut constraint = Self {
            key: contact.key,
            start,
            frame,
            point_m: contact.point_m,
            edges,
            friction,
            is_active: active,
            targets: [zero; EDGES],
            softness: zero,
            forces_n: *warm,
        };
        for force in &mut constraint.forces_n {
            *force = active.keep(*force);
        }
        for edge in 0..edges {
            let (tangent, slope) = constraint.slope(edge);
            let rate = slope.mul_add(rates[tangent], rates[0]);
            let row = soft_row(&pair.softness, violation, rate, response, step_s);
            constraint.targets[edge] = row.target;
            constraint.softness = row.softness;
        }
        constraint
    }

    /// Returns the tangent of an edge and its slope.
    #[inline(always)]
    pub(super) fn slope(&self, edge: usize) -> (usize, Lanes<S>) {
        let friction = self.friction[edge / 2];
        let friction = if self.edges == 1 { friction.constant(0.0) } else { friction };
        (1 + edge / 2, if edge.is_multiple_of(2) { friction } else { -friction })
    }

    /// Returns the force along the normal and the tangents.
    #[inline(always)]
    pub(super) fn force(&self) -> [Lanes<S>; 3] {
        let [a, b, c, d] = self.forces_n;
        [(a + b) + (c + d), (a - b) * self.friction[0], (c - d) * self.friction[1]]
    }

    /// Returns the force of an edge at accelerations along the three directions, of an edge with this stiffness, and
    /// its decrease per acceleration along the edge.
    #[inline(always)]
    pub(super) fn respond(
        &self,
        edge: usize,
        stiffness: Lanes<S>,
        accelerations: &[Lanes<S>; 3],
    ) -> (Lanes<S>, Lanes<S>) {
        let (tangent, slope) = self.slope(edge);
        let missing = self.targets[edge] - slope.mul_add(accelerations[tangent], accelerations[0]);
        let pushes = self.is_active.and(missing.constant(0.0).less_than(missing));
        (pushes.keep(missing * stiffness), pushes.keep(stiffness))
    }
}

/// Second derivatives of a contact along its normal and tangents; the two tangents are independent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Weights<S: Simd> {
    pub(super) normal: Lanes<S>,
    mixed: [Lanes<S>; 2],
    tangents: [Lanes<S>; 2],
}

impl<S: Simd> Weights<S> {
    #[inline(always)]
    pub(super) fn new([a, b, c, d]: [Lanes<S>; EDGES], [first, second]: [Lanes<S>; 2]) -> Self {
        Self {
            normal: (a + b) + (c + d),
            mixed: [(a - b) * first, (c - d) * second],
            tangents: [(a + b) * (first * first), (c + d) * (second * second)],
        }
    }

    #[inline(always)]
    pub(super) fn times(&self, [normal, first, second]: &[Lanes<S>; 3]) -> [Lanes<S>; 3] {
        let [to_first, to_second] = self.mixed;
        [
            self.normal.mul_add(*normal, to_first.mul_add(*first, to_second * *second)),
            to_first.mul_add(*normal, self.tangents[0] * *first),
            to_second.mul_add(*normal, self.tangents[1] * *second),
        ]
    }
}

/// Returns the normal and two tangents, those of MuJoCo's `mju_makeFrame`. The first is `along`, as far as it is a tangent.
#[inline(always)]
fn frame<S: Simd>(normal: &Vec3<S>, along: Option<&Vec3<S>>) -> [Vec3<S>; 3] {
    let (zero, one) = (normal.x.constant(0.0), normal.x.constant(1.0));
    let tangent = |along: &Vec3<S>| *along - *normal * normal.dot(along);
    let flat = normal.y.abs().less_than(one.constant(0.5));
    let mut across = tangent(&Vec3::new(zero, flat.select(one, zero), flat.select(zero, one)));
    if let Some(along) = along.map(tangent) {
        // An upright capsule has no direction in the plane.
        let lies = one.constant(ALONG_MIN).less_than(along.dot(&along));
        let choose = |one: Lanes<S>, other: Lanes<S>| lies.select(one, other);
        across = Vec3::new(choose(along.x, across.x), choose(along.y, across.y), choose(along.z, across.z));
    }
    let first = across * (one / across.dot(&across).sqrt());
    [*normal, first, normal.cross(&first)]
}
