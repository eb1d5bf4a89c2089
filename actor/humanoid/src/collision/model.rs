//! Shapes of a model, and the pairs of them that can touch.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use rapier3d::math::{Pose, Rotation};
use rapier3d::parry::shape::SharedShape;

use super::bounds::Capsule;
use super::convert::{to_rotation, to_vector};
use super::field::FieldShape;
use crate::articulation::Structure;
use crate::model::{Geometry, Model, Softness};

/// Shapes, ground, and pairs of a model.
#[derive(Clone)]
pub(crate) struct CollisionModel {
    pub(crate) shapes: Vec<ShapeNode>,
    pub(crate) pairs: Vec<PairNode>,
    pub(super) ground: SharedShape,
    pub(super) height_field: Option<Arc<FieldShape>>,
    /// Pose of the ground's shape in the world.
    pub(super) ground_m: Vector3<f64>,
    pub(super) ground_rotation: Rotation,
}

/// Shape that can collide.
#[derive(Clone)]
pub(crate) struct ShapeNode {
    pub(crate) body: usize,
    pub(crate) link: Option<usize>,
    /// Centre of its sphere and capsule, in the body's frame (m).
    pub(super) centre_m: Vector3<f64>,
    /// Radius of the sphere around the centre that contains the shape (m).
    pub(super) radius_m: f64,
    /// Half of the axis of the capsule that contains the shape, in the body's frame (m); none of a sphere.
    pub(super) half_m: Option<Vector3<f64>>,
    /// Radius of the capsule (m).
    pub(super) thickness_m: f64,
    /// Whether the shape is its capsule or sphere.
    pub(super) is_round: bool,
    /// Rapier's shape, and its pose in the body.
    pub(super) shape: SharedShape,
    pub(super) offset: Pose,
}

/// Two shapes that can touch, or a shape and the ground.
#[derive(Clone, Debug)]
pub(crate) struct PairNode {
    /// Index into [`CollisionModel::shapes`].
    pub(super) first: usize,
    /// Index into [`CollisionModel::shapes`]; `None` for the ground.
    pub(super) second: Option<usize>,
    pub(crate) bodies: [Option<usize>; 2],
    pub(crate) links: [Option<usize>; 2],
    pub(crate) friction: [f64; 2],
    pub(crate) margin_m: f64,
    pub(crate) softness: Softness,
    /// Degrees of freedom that move either body, with their paths, in ascending order.
    pub(crate) dofs: Vec<u32>,
    /// Those of them that move one body against the other, or against the ground.
    pub(crate) coupled_dofs: Vec<u32>,
    /// Approximate acceleration of the gap per force (1/kg), see [`crate::articulation::Structure::link_responses`].
    pub(crate) response: f64,
}

impl CollisionModel {
    pub(crate) fn new(model: &Model, structure: &Structure, self_collision: bool) -> Self {
        let mut shapes = Vec::new();
        let mut indices = Vec::new();
        for (body, parts) in model.bodies.iter().enumerate() {
            let own = parts.shapes.iter().enumerate().map(|(index, shape)| {
                shapes.push(ShapeNode::new(body, model.link_of_shape(body, index), &shape.geometry));
                shapes.len() - 1
            });
            indices.push(own.collect::<Vec<_>>());
        }
        let pair = |pair: &crate::model::Pair| {
            let first = indices[pair.first.body][pair.first.shape];
            let second = pair.second.map(|second| indices[second.body][second.shape]);
            let both = [Some(first), second];
            let links = both.map(|shape| shape.and_then(|shape| shapes[shape].link));
            let bodies = both.map(|shape| shape.map(|shape| shapes[shape].body));
            let dofs = structure.dofs_of_bodies(bodies.iter().flatten().copied());
            let common = match bodies {
                [Some(first), Some(second)] => structure.common_dofs(first, second),
                _ => 0,
            };
            PairNode {
                first,
                second,
                bodies,
                links,
                friction: pair.friction,
                margin_m: pair.margin_m,
                softness: pair.softness,
                coupled_dofs: dofs[common..].to_vec(),
                dofs,
                response: links.iter().flatten().map(|link| structure.link_responses[*link]).sum(),
            }
        };
        let pairs = model.pairs.iter().filter(|pair| self_collision || pair.second.is_none()).map(pair).collect();
        let height_field = model.ground.height_field.as_ref().map(FieldShape::of);
        let ground_m = model.ground.height_field.as_ref().map_or(Vector3::zeros(), |field| field.centre_m.coords);
        let ground_rotation = match &height_field {
            // The heights of Rapier's height fields are along y.
            Some(_) => to_rotation(&UnitQuaternion::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2)),
            None => Rotation::IDENTITY,
        };
        Self {
            shapes,
            pairs,
            ground: SharedShape::halfspace(rapier3d::math::Vector::Z),
            height_field,
            ground_m,
            ground_rotation,
        }
    }

    /// Returns whether the ground is the plane at height 0.
    pub(super) fn is_flat(&self) -> bool {
        self.height_field.is_none()
    }
}

impl ShapeNode {
    pub(super) fn new(body: usize, link: Option<usize>, geometry: &Geometry) -> Self {
        let centre_m = geometry.centre_m().coords;
        let mut node = Self {
            body,
            link,
            centre_m,
            radius_m: 0.0,
            half_m: None,
            thickness_m: 0.0,
            is_round: false,
            shape: SharedShape::ball(0.0),
            offset: Pose::from_parts(to_vector(&centre_m), Rotation::IDENTITY),
        };
        match geometry {
            Geometry::Sphere { radius_m, .. } => {
                node.shape = SharedShape::ball(*radius_m as f32);
                (node.radius_m, node.thickness_m, node.is_round) = (*radius_m, *radius_m, true);
            }
            Geometry::Capsule { from_m, to_m, radius_m } => {
                let half_m = (to_m - from_m) / 2.0;
                node.shape = SharedShape::capsule(to_vector(&-half_m), to_vector(&half_m), *radius_m as f32);
                (node.radius_m, node.thickness_m, node.is_round) = (half_m.norm() + radius_m, *radius_m, true);
                node.half_m = Some(half_m);
            }
            Geometry::Cylinder { pose, radius_m, half_length_m } => {
                // The axis of Rapier's cylinders is y.
                let upright = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2);
                node.shape = SharedShape::cylinder(*half_length_m as f32, *radius_m as f32);
                node.offset = to_pose(&(pose * upright));
                let axis_m = pose.rotation * Vector3::z() * *half_length_m;
                node.contain(Capsule { centre_m, half_m: axis_m, radius_m: *radius_m });
                node.radius_m = radius_m.hypot(*half_length_m);
            }
            Geometry::Box { pose, half_m } => {
                node.shape = SharedShape::cuboid(half_m.x as f32, half_m.y as f32, half_m.z as f32);
                node.offset = to_pose(pose);
                let corners: Vec<_> = [-1.0, 1.0]
                    .iter()
                    .flat_map(|x| [-1.0, 1.0].map(|y| [-1.0, 1.0].map(|z| Vector3::new(*x, y, z))))
                    .flatten()
                    .map(|corner| pose.rotation * corner.component_mul(half_m) + centre_m)
                    .collect();
                node.surround(&corners, pose);
            }
            Geometry::Hull { vertices_m } => {
                let points: Vec<_> = vertices_m.iter().map(|vertex| to_vector(&(vertex.coords - centre_m))).collect();
                // The model refuses flat hulls.
                node.shape = SharedShape::convex_hull(&points).unwrap_or(node.shape);
                let corners: Vec<_> = vertices_m.iter().map(|vertex| vertex.coords).collect();
                node.surround(&corners, &Isometry3::identity());
            }
            Geometry::Ellipsoid { pose, half_m } => {
                let points: Vec<_> = ball_points().map(|point| point.component_mul(half_m)).collect();
                let rounded: Vec<_> = points.iter().map(to_vector).collect();
                node.shape = SharedShape::convex_hull(&rounded).unwrap_or(node.shape);
                node.offset = to_pose(pose);
                let corners: Vec<_> = points.iter().map(|point| pose.rotation * point + centre_m).collect();
                node.surround(&corners, pose);
            }
        }
        node
    }

    /// Sets sphere and capsule for a shape with these corners in the body's frame (m) and this pose.
    fn surround(&mut self, corners_m: &[Vector3<f64>], pose: &Isometry3<f64>) {
        self.contain(Capsule::around(corners_m, pose.rotation.to_rotation_matrix().matrix()));
        self.radius_m = corners_m.iter().map(|corner| (corner - self.centre_m).norm()).fold(0.0, f64::max);
    }

    fn contain(&mut self, capsule: Capsule) {
        self.centre_m = capsule.centre_m;
        (self.half_m, self.thickness_m) = (Some(capsule.half_m), capsule.radius_m);
    }
}

/// Parts of each edge of the octahedron whose points, on a ball, stand for an ellipsoid: 146 points.
const BALL_PARTS: i32 = 6;
/// Radius of these points, such that their hull extends as far as the unit ball in the mean over all directions.
const BALL_RADIUS: f64 = 1.0077;

/// Returns points of a ball with all symmetries of the axes.
fn ball_points() -> impl Iterator<Item = Vector3<f64>> {
    let all = -BALL_PARTS..=BALL_PARTS;
    let cube = all.clone().flat_map(move |x| all.clone().map(move |y| (x, y)));
    let octahedron = cube.filter(|(x, y)| x.abs() + y.abs() <= BALL_PARTS).flat_map(|(x, y)| {
        let z = BALL_PARTS - x.abs() - y.abs();
        [z, -z].into_iter().take(if z == 0 { 1 } else { 2 }).map(move |z| Vector3::new(x, y, z).cast::<f64>())
    });
    octahedron.map(|point| point.normalize() * BALL_RADIUS)
}

fn to_pose(pose: &Isometry3<f64>) -> Pose {
    Pose::from_parts(to_vector(&pose.translation.vector), to_rotation(&pose.rotation))
}
