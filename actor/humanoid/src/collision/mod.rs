//! What touches: places of contact between shapes, and between shapes and the ground.
//!
//! The pairs that can touch at all are known from the model. In every step, cheap tests for several worlds at once leave few
//! of them: spheres and capsules that contain the shapes. Spheres and capsules over a plane are solved in closed form.
//! Everything else is a contact query of Rapier's collision detection (see `queries`).

mod bounds;
mod convert;
mod field;
mod model;
mod queries;
#[cfg(test)]
mod tests;

use nalgebra::Vector3;

pub(crate) use self::model::{CollisionModel, PairNode};
pub(crate) use self::queries::POINTS_MAX;
use self::queries::{Found, Queries};
use crate::articulation::Posture;
use crate::lanes::{LANES_MAX, Lanes, Mask, Simd, Vec3};

/// Index of a pair, and of a contact point within the pair.
pub(crate) type ContactKey = (u32, u32);

/// Contact point of one pair in several worlds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact<S: Simd> {
    pub(crate) key: ContactKey,
    /// Position relative to O (m).
    pub(crate) point_m: Vec3<S>,
    /// Unit vector towards the pair's first body.
    pub(crate) normal: Vec3<S>,
    /// Direction that the first edge of the friction pyramid follows: as in MuJoCo, the axis of a capsule on a plane.
    pub(crate) along: Option<Vec3<S>>,
    /// Distance between the surfaces (m); negative where they overlap.
    pub(crate) gap_m: Lanes<S>,
}

/// Place of O in the world.
pub(crate) struct Root<'a, S: Simd> {
    /// Where it was at the start of the pass, one place for each world in use (m).
    pub(crate) start_m: &'a [Vector3<f64>],
    /// Its motion since then (m).
    pub(crate) moved_m: &'a Vec3<S>,
    /// Height (m).
    pub(crate) height_m: Lanes<S>,
}

/// Contacts of one step, and workspace to find them.
pub(crate) struct Collisions<S: Simd> {
    /// In the order of pairs and points, so that the constraint solve always takes them in the same order.
    pub(crate) contacts: Vec<Contact<S>>,
    /// Centre of each shape, and half of its capsule's axis (m, relative to O).
    centres_m: Vec<Vec3<S>>,
    halves_m: Vec<Vec3<S>>,
    queries: Queries,
}

/// By how much single precision may overestimate the distance of two axes (m), above all of nearly parallel ones.
const ROUNDING_M: f64 = 2e-4;

/// Gap of a contact in the lanes where it does not exist (m).
const ABSENT_M: f64 = 1e6;

impl<S: Simd> Collisions<S> {
    pub(crate) fn new(simd: S, model: &CollisionModel) -> Self {
        let shapes = model.shapes.len();
        Self {
            contacts: Vec::with_capacity(32),
            centres_m: vec![Vec3::zero(simd); shapes],
            halves_m: vec![Vec3::zero(simd); shapes],
            queries: Queries::default(),
        }
    }

    /// Finds all contacts at a posture.
    #[inline(always)]
    pub(crate) fn find(&mut self, model: &CollisionModel, posture: &Posture<S>, root: &Root<'_, S>) {
        self.contacts.clear();
        let zero = root.height_m.constant(0.0);
        for (index, shape) in model.shapes.iter().enumerate() {
            let rotation = &posture.rotations[shape.body];
            self.centres_m[index] = posture.origins_m[shape.body] + rotation.times_constant(&shape.centre_m);
            // Of a sphere it is 0, whatever model this workspace served before.
            self.halves_m[index] = match &shape.half_m {
                Some(half_m) => rotation.times_constant(half_m),
                None => Vec3::new(zero, zero, zero),
            };
        }
        for (index, pair) in model.pairs.iter().enumerate() {
            let key = index as u32;
            let near = match pair.second {
                None if model.is_flat() && model.shapes[pair.first].is_round => {
                    self.touch_plane(model, key, pair, root.height_m);
                    continue;
                }
                None => self.is_low(model, pair, root),
                Some(second) => self.is_near(model, pair, second),
            };
            if near.any() {
                self.query(model, posture, root, key, pair, near);
            }
        }
    }

    /// Adds the contacts of a sphere or capsule with the plane at height 0.
    #[inline(always)]
    fn touch_plane(&mut self, model: &CollisionModel, key: u32, pair: &PairNode, height_m: Lanes<S>) {
        let shape = &model.shapes[pair.first];
        let centre = self.centres_m[pair.first];
        let zero = height_m.constant(0.0);
        let normal = Vec3::new(zero, zero, zero.constant(1.0));
        let half = self.halves_m[pair.first];
        let ends = [centre + half, centre - half];
        let along = shape.half_m.map(|half_m| half * zero.constant(1.0 / half_m.norm()));
        for (number, point) in ends[..if along.is_some() { 2 } else { 1 }].iter().enumerate() {
            let gap_m = height_m + point.z - shape.thickness_m;
            if (gap_m - pair.margin_m).less_than(zero).any() {
                let down = gap_m * 0.5 + shape.thickness_m;
                let point_m = Vec3::new(point.x, point.y, point.z - down);
                self.contacts.push(Contact { key: (key, number as u32), point_m, normal, along, gap_m });
            }
        }
    }

    /// Returns where a shape's sphere and capsule reach below the highest point of the ground near it.
    #[inline(always)]
    fn is_low(&self, model: &CollisionModel, pair: &PairNode, root: &Root<'_, S>) -> Mask<S> {
        let shape = &model.shapes[pair.first];
        let (centre, radius_m) = (self.centres_m[pair.first], shape.radius_m);
        let reach = (self.halves_m[pair.first].z.abs() + shape.thickness_m).min(centre.z.constant(radius_m));
        let lowest = root.height_m + centre.z - reach;
        let mut highest = lowest.constant(pair.margin_m);
        if let Some(field) = &model.height_field {
            let (x, y) = (root.moved_m.x + centre.x, root.moved_m.y + centre.y);
            for (lane, start_m) in root.start_m.iter().enumerate() {
                let (x_m, y_m) = (start_m.x + x.lane(lane), start_m.y + y.lane(lane));
                highest.set_lane(lane, field.highest_near_m(x_m, y_m, radius_m + pair.margin_m) + pair.margin_m);
            }
        }
        lowest.less_than(highest)
    }

    /// Returns where two shapes may touch: by their spheres, then by their capsules.
    #[inline(always)]
    fn is_near(&self, model: &CollisionModel, pair: &PairNode, second: usize) -> Mask<S> {
        let first = pair.first;
        let offset = self.centres_m[first] - self.centres_m[second];
        let reach_m = model.shapes[first].radius_m + model.shapes[second].radius_m + pair.margin_m;
        let near = offset.dot(&offset).less_than(offset.x.constant(reach_m * reach_m));
        if !near.any() {
            return near;
        }
        let squared = squared_distance(&offset, &self.halves_m[first], &self.halves_m[second]);
        let reach_m = model.shapes[first].thickness_m + model.shapes[second].thickness_m + pair.margin_m + ROUNDING_M;
        near.and(squared.less_than(offset.x.constant(reach_m * reach_m)))
    }

    /// Adds the contacts that Rapier finds, world by world.
    fn query(
        &mut self,
        model: &CollisionModel,
        posture: &Posture<S>,
        root: &Root<'_, S>,
        key: u32,
        pair: &PairNode,
        near: Mask<S>,
    ) {
        let zero = root.height_m.constant(0.0);
        let asked = near.select(zero.constant(1.0), zero);
        let mut found = [[Found::default(); POINTS_MAX]; LANES_MAX];
        let mut counts = [0; LANES_MAX];
        for (lane, start_m) in root.start_m.iter().enumerate() {
            if asked.lane(lane) == 0.0 {
                continue;
            }
            let pose = |body: usize| (posture.rotations[body].lane(lane), posture.origins_m[body].lane(lane));
            counts[lane] = self.queries.run(model, pair, pose, &(start_m + root.moved_m.lane(lane)), &mut found[lane]);
        }
        for number in 0..counts.into_iter().max().unwrap_or(0) {
            let vertical = Vec3::new(zero, zero, zero.constant(1.0));
            let nowhere = Vec3::new(zero, zero, zero);
            let mut contact = Contact {
                key: (key, number as u32),
                point_m: nowhere,
                normal: vertical,
                along: None,
                gap_m: zero.constant(ABSENT_M),
            };
            for (lane, points) in found.iter().enumerate().filter(|(lane, _)| number < counts[*lane]) {
                let point = &points[number];
                contact.point_m.set_lane(lane, &point.point_m);
                contact.normal.set_lane(lane, &point.normal);
                contact.gap_m.set_lane(lane, point.gap_m);
            }
            self.contacts.push(contact);
        }
    }
}

/// Returns the squared distance of two line segments with the given halves, whose centres differ by `offset`.
///
/// Formulas: C. Ericson, *Real-Time Collision Detection*, 2005, section 5.1.9, for centres instead of ends.
#[inline(always)]
fn squared_distance<S: Simd>(offset: &Vec3<S>, one: &Vec3<S>, other: &Vec3<S>) -> Lanes<S> {
    let tiny = offset.x.constant(1e-12);
    let (a, b, e) = (one.dot(one), one.dot(other), other.dot(other));
    let (c, f) = (one.dot(offset), other.dot(offset));
    // Of parallel ones, any place along the first will do.
    let least = a * e * 1e-6 + tiny.constant(1e-30);
    let s = within_one((b * f - c * e) / (a * e - b * b).max(least));
    let t = within_one((b * s + f) / e.max(tiny));
    let s = within_one((b * t - c) / a.max(tiny));
    let between = *offset + *one * s - *other * t;
    between.dot(&between)
}

#[inline(always)]
fn within_one<S: Simd>(number: Lanes<S>) -> Lanes<S> {
    let one = number.constant(1.0);
    number.min(one).max(-one)
}
