//! Contact queries of Rapier's collision detection, for pairs without a closed form.
//!
//! Single precision suffices: places are relative to the root.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Vector3};
use rapier3d::math::{Pose, Vector};
use rapier3d::parry::bounding_volume::BoundingVolume;
use rapier3d::parry::query::{
    ClosestPoints, ContactManifold, ContactManifoldsWorkspace, DefaultQueryDispatcher, PersistentQueryDispatcher,
    closest_points, details::NormalConstraints,
};
use rapier3d::parry::shape::{ConvexPolyhedron, Shape};

use super::convert::{from_vector, to_pose, to_vector};
use super::model::{CollisionModel, PairNode, ShapeNode};

/// Most contact points of one pair. Two convex shapes need four; a shape may touch many triangles of a height field,
/// and then the deepest point counts, and those that lie farthest in seven horizontal directions: all corners of a sole
/// are among them.
pub(crate) const POINTS_MAX: usize = 8;
/// Most points to choose from; beyond that, the deepest ones.
const CANDIDATES_MAX: usize = 128;
/// Points of one pair that are closer than this (m) and have the same normal are one.
const SAME_POINT_M: f64 = 1e-3;

/// By how much a contact may be nearer than its shapes (m): rounding.
const SAME_GAP_M: f64 = 1e-4;
/// Distance up to which shapes that seem to touch are looked for (m): robots are smaller.
const REACH_M: f32 = 100.0;

/// Coordinates beyond this (m), and those that are not finite, have no contacts: single precision cannot place them.
const PLACE_MAX_M: f64 = 1e6;

/// Contact point in one world.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Found {
    /// Position relative to O (m).
    pub(super) point_m: Vector3<f64>,
    /// Unit vector towards the pair's first body.
    pub(super) normal: Vector3<f64>,
    pub(super) gap_m: f64,
}

/// Workspace of the queries.
pub(super) struct Queries {
    manifolds: Vec<ContactManifold<(), ()>>,
    single: ContactManifold<(), ()>,
    candidates: Vec<Found>,
    directions: [[f64; 2]; POINTS_MAX - 1],
    workspace: Option<ContactManifoldsWorkspace>,
}

impl Default for Queries {
    fn default() -> Self {
        let direction = |number: usize| (TAU * number as f64 / (POINTS_MAX - 1) as f64).sin_cos().into();
        Self {
            manifolds: Vec::new(),
            single: ContactManifold::default(),
            candidates: Vec::with_capacity(CANDIDATES_MAX),
            directions: std::array::from_fn(direction),
            workspace: None,
        }
    }
}

impl Queries {
    /// Writes the contact points of a pair, deepest first, and returns their number. `pose` gives rotation and origin
    /// of a body (m, relative to O), and `root_m` is the position of O in the world.
    pub(super) fn run(
        &mut self,
        model: &CollisionModel,
        pair: &PairNode,
        pose: impl Fn(usize) -> (Matrix3<f64>, Vector3<f64>),
        root_m: &Vector3<f64>,
        found: &mut [Found; POINTS_MAX],
    ) -> usize {
        let placed = |shape: usize| {
            let (rotation, origin) = pose(model.shapes[shape].body);
            to_pose(&rotation, &origin) * model.shapes[shape].offset
        };
        let bodies = pair.bodies.iter().flatten();
        let is_near = |vector: &Vector3<f64>| vector.iter().all(|part| part.abs() < PLACE_MAX_M);
        if !is_near(root_m) || !bodies.copied().all(|body| is_near(&pose(body).1)) {
            // The state is about to fail.
            return 0;
        }
        let first = &model.shapes[pair.first];
        let place = placed(pair.first);
        let prediction = pair.margin_m as f32;
        let mut points = Points { candidates: std::mem::take(&mut self.candidates), margin_m: pair.margin_m };
        points.candidates.clear();
        match pair.second {
            Some(second) => {
                let other = placed(second);
                self.touch([&other, &place], [&model.shapes[second], first], prediction, &mut points);
            }
            None => {
                // A plane is the same everywhere, so that places stay near 0.
                let away_m = if model.is_flat() { Vector3::new(0.0, 0.0, root_m.z) } else { *root_m };
                let ground = Pose::from_parts(to_vector(&(model.ground_m - away_m)), model.ground_rotation);
                match &model.height_field {
                    None => match first.shape.as_convex_polyhedron() {
                        Some(hull) => points.take_corners(hull, &place, |_| Some((-root_m.z, Vector3::z()))),
                        None => self.collect(&ground, &*model.ground, &place, &*first.shape, prediction, &mut points),
                    },
                    Some(heights) => {
                        let field = &heights.triangles;
                        let between = ground.inverse() * place;
                        let near = first.shape.compute_aabb(&between).loosened(prediction.max(1e-3));
                        let manifold = &mut self.single;
                        field.map_elements_in_local_aabb(&near, &mut |index, triangle| {
                            forget(manifold);
                            // Without them, an edge between two triangles would push sideways.
                            let normals = field.triangle_normal_constraints(index);
                            let asked = DefaultQueryDispatcher.contact_manifold_convex_convex(
                                &between,
                                triangle,
                                &*first.shape,
                                normals.as_ref().map(|normals| normals as &dyn NormalConstraints),
                                None,
                                prediction,
                                manifold,
                            );
                            if asked.is_ok() {
                                points.take(&ground, manifold, true);
                            }
                        });
                        if let Some(hull) = first.shape.as_convex_polyhedron() {
                            points.take_corners(hull, &place, |at_m| {
                                let (height_m, normal) = heights.surface_at(root_m.x + at_m.x, root_m.y + at_m.y)?;
                                Some((height_m - root_m.z, normal))
                            });
                        }
                    }
                }
            }
        }
        let count = points.choose(&self.directions, found);
        self.candidates = points.candidates;
        count
    }

    /// Collects the contacts of two shapes at these poses.
    fn touch(&mut self, [pose, other_pose]: [&Pose; 2], shapes: [&ShapeNode; 2], prediction: f32, points: &mut Points) {
        let [shape, other] = shapes.map(|node| &*node.shape);
        self.collect(pose, shape, other_pose, other, prediction, points);
        // Of hulls and cylinders 0.2 to 5 mm apart, two in a thousand get contacts, up to 3 cm deep
        // (`findings/parry_contacts_of_shapes_apart.sh`).
        if !points.candidates.is_empty()
            && shapes.iter().any(|node| !node.is_round)
            && let Some(width_m) = slab_m([pose, other_pose], [shape, other])
        {
            points.candidates.retain(|point| point.gap_m > f64::from(width_m) - SAME_GAP_M);
        }
    }

    fn collect(
        &mut self,
        pose: &Pose,
        shape: &dyn Shape,
        other_pose: &Pose,
        other: &dyn Shape,
        prediction: f32,
        points: &mut Points,
    ) {
        self.manifolds.iter_mut().for_each(forget);
        let between = pose.inverse() * *other_pose;
        let Self { manifolds, workspace, .. } = self;
        let asked = DefaultQueryDispatcher.contact_manifolds(&between, shape, other, prediction, manifolds, workspace);
        if asked.is_ok() {
            for manifold in &*manifolds {
                points.take(pose, manifold, false);
            }
        }
    }
}

/// Points of one pair so far.
struct Points {
    candidates: Vec<Found>,
    margin_m: f64,
}

impl Points {
    /// Adds the points of a manifold whose first shape is at `pose`; the ground pushes upwards only.
    fn take(&mut self, pose: &Pose, manifold: &ContactManifold<(), ()>, is_ground: bool) {
        let normal = from_vector(pose.rotation * manifold.local_n1);
        let norm = normal.norm();
        if !(norm > 0.5 && norm < 2.0) || is_ground && normal.z <= 0.0 {
            return;
        }
        let normal = normal / norm;
        for contact in &manifold.points {
            let gap_m = f64::from(contact.dist);
            let point_m = from_vector(*pose * contact.local_p1) + normal * (gap_m / 2.0);
            if gap_m < self.margin_m && point_m.iter().all(|part| part.is_finite()) {
                self.insert(Found { point_m, normal, gap_m });
            }
        }
    }

    /// Adds the corners of a hull that are near the ground: a face of Rapier's manifolds has at most four corners. `surface`
    /// returns the ground's height (m, relative to O) and normal at a place (m, relative to O).
    fn take_corners(
        &mut self,
        hull: &ConvexPolyhedron,
        place: &Pose,
        surface: impl Fn(&Vector3<f64>) -> Option<(f64, Vector3<f64>)>,
    ) {
        for corner in hull.points() {
            let corner_m = from_vector(*place * *corner);
            let Some((height_m, normal)) = surface(&corner_m) else { continue };
            let gap_m = (corner_m.z - height_m) * normal.z;
            if gap_m < self.margin_m {
                self.insert(Found { point_m: corner_m - normal * (gap_m / 2.0), normal, gap_m });
            }
        }
    }

    fn insert(&mut self, new: Found) {
        let same =
            |known: &Found| (known.point_m - new.point_m).norm() < SAME_POINT_M && known.normal.dot(&new.normal) > 0.99;
        if let Some(known) = self.candidates.iter_mut().find(|known| same(known)) {
            if new.gap_m < known.gap_m {
                *known = new;
            }
        } else if self.candidates.len() < CANDIDATES_MAX {
            self.candidates.push(new);
        } else if let Some(shallowest) = self.candidates.iter_mut().max_by(|a, b| a.gap_m.total_cmp(&b.gap_m))
            && new.gap_m < shallowest.gap_m
        {
            *shallowest = new;
        }
    }

    /// Writes the points that count, the deepest first, and returns their number.
    fn choose(&mut self, directions: &[[f64; 2]; POINTS_MAX - 1], found: &mut [Found; POINTS_MAX]) -> usize {
        let candidates = &mut self.candidates;
        candidates.sort_by(|a, b| a.gap_m.total_cmp(&b.gap_m));
        let mut counts = [true; CANDIDATES_MAX];
        if candidates.len() > POINTS_MAX {
            counts[1..].fill(false);
            for [x, y] in directions {
                let reach_m = |index: &usize| x * candidates[*index].point_m.x + y * candidates[*index].point_m.y;
                // Of equals, the deepest.
                let farthest = (0..candidates.len()).rev().max_by(|a, b| reach_m(a).total_cmp(&reach_m(b)));
                counts[farthest.unwrap_or(0)] = true;
            }
        }
        let counted = candidates.iter().zip(counts).filter(|(_, counts)| *counts);
        found.iter_mut().zip(counted).map(|(place, (point, _))| *place = *point).count()
    }
}

/// Removes everything that Rapier would reuse: points, and normals, from which it starts its search.
fn forget(manifold: &mut ContactManifold<(), ()>) {
    manifold.clear();
    (manifold.local_n1, manifold.local_n2) = (Vector::ZERO, Vector::ZERO);
}

/// Returns the width of the empty slab between two convex shapes across the line of their closest points (m), if a slab
/// separates them.
fn slab_m(poses: [&Pose; 2], shapes: [&dyn Shape; 2]) -> Option<f32> {
    let Ok(ClosestPoints::WithinMargin(near, far)) = closest_points(poses[0], shapes[0], poses[1], shapes[1], REACH_M)
    else {
        return None;
    };
    let along = (far - near).try_normalize()?;
    let [one, other] = [shapes[0].as_support_map()?, shapes[1].as_support_map()?];
    let start_m = one.support_point(poses[0], along).dot(along);
    let end_m = other.support_point(poses[1], -along).dot(along);
    (end_m > start_m).then_some(end_m - start_m)
}

/// Returns how deep the second shape at a place is in the first one (m); none if they do not touch.
#[cfg(test)]
pub(super) fn overlap_m(one: &ShapeNode, other: &ShapeNode, place: &nalgebra::Isometry3<f64>) -> Option<f64> {
    let pose = to_pose(place.rotation.to_rotation_matrix().matrix(), &place.translation.vector) * other.offset;
    let mut points = Points { candidates: Vec::new(), margin_m: 0.0 };
    Queries::default().touch([&one.offset, &pose], [one, other], 0.0, &mut points);
    points.candidates.iter().map(|point| -point.gap_m).reduce(f64::max)
}

/// Returns the width of the slab between a shape and a second one at a place (m).
#[cfg(test)]
pub(super) fn gap_m(one: &ShapeNode, other: &ShapeNode, place: &nalgebra::Isometry3<f64>) -> Option<f64> {
    let pose = to_pose(place.rotation.to_rotation_matrix().matrix(), &place.translation.vector) * other.offset;
    slab_m([&one.offset, &pose], [&*one.shape, &*other.shape]).map(f64::from)
}
