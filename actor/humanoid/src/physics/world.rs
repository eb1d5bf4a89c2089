//! Rapier world of one humanoid, and its reset for every episode.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Isometry3, UnitQuaternion};
use rapier3d::prelude::*;

use super::convert::{to_matrix, to_point, to_rotation, to_vector};
use crate::config::{CONTROL_STEP_S, PhysicsSettings};
use crate::model::{Body, FLOOR_GROUP, Geometry, Model, Shape};

/// Distance beyond the margins within which Rapier reports contacts (m). Surfaces this far apart that approach at 2.4 m/s
/// meet within a step of 7.5 ms.
const PREDICTION_M: f64 = 0.018;

/// Rapier world with one humanoid on a floor.
pub(super) struct RapierWorld {
    pub(super) rapier: PhysicsWorld,
    /// Handles in the order of [`Model::bodies`].
    pub(super) bodies: Vec<RigidBodyHandle>,
    /// Body of each link.
    pub(super) link_bodies: Vec<usize>,
    pub(super) floor: ColliderHandle,
    /// Colliders of the shapes, with the body and the index among its shapes.
    pub(super) shape_colliders: Vec<(ColliderHandle, usize, usize)>,
    pub(super) template: Template,
}

/// Sets before the first step; every episode starts from a copy.
pub(super) struct Template {
    pub(super) bodies: RigidBodySet,
    pub(super) colliders: ColliderSet,
}

/// Content of a collider's user data.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tag {
    /// Link of the shape; `None` is the floor.
    pub(super) link: Option<usize>,
    /// See [`Shape::margin_m`].
    pub(super) margin_m: f64,
}

impl Tag {
    /// Packs the margin's bits into the upper half and the link's index plus one into the lower half.
    fn pack(self) -> u128 {
        u128::from(self.margin_m.to_bits()) << 64 | self.link.map_or(0, |link| link as u128 + 1)
    }

    pub(super) fn of(collider: &Collider) -> Self {
        let data = collider.user_data;
        Self { link: (data as u64 as usize).checked_sub(1), margin_m: f64::from_bits((data >> 64) as u64) }
    }
}

impl RapierWorld {
    pub(super) fn new(model: &Model, settings: &PhysicsSettings) -> Self {
        let mut rapier = PhysicsWorld::new();
        // The flight includes gravity.
        rapier.gravity = Vector::ZERO;
        let parameters = &mut rapier.integration_parameters;
        parameters.dt = (CONTROL_STEP_S / f64::from(settings.substeps)) as f32;
        parameters.num_solver_iterations = settings.solver_iterations as usize;
        parameters.max_ccd_substeps = 0;
        // Rapier provides only a first guess; the refinement resolves penetrations.
        parameters.num_internal_pgs_iterations = 1;
        parameters.num_internal_stabilization_iterations = 0;
        parameters.normalized_prediction_distance = (PREDICTION_M + largest_margin_sum_m(model)) as f32;
        // Rapier reuses a contact point until it has moved 5 cm; under a rolling foot, the point leaves the floor long before.
        parameters.contact_recycling = false;

        let floor = ColliderBuilder::new(SharedShape::halfspace(Vector::Z))
            .friction(model.floor_friction as f32)
            .friction_combine_rule(CoefficientCombineRule::Max)
            .collision_groups(InteractionGroups::new(group(FLOOR_GROUP), Group::ALL, InteractionTestMode::And))
            .user_data(Tag { link: None, margin_m: model.floor_margin_m }.pack());
        let floor = rapier.insert_collider(floor, None);

        let mut bodies = Vec::with_capacity(model.bodies.len());
        let mut shape_colliders = Vec::new();
        for (index, body) in model.bodies.iter().enumerate() {
            let handle = rapier.insert_body(rigid_body(body));
            for (shape_index, shape) in body.shapes.iter().enumerate() {
                if let Some(builder) = collider_shape(&shape.geometry) {
                    let tag = Tag { link: model.link_of_shape(index, shape_index), margin_m: shape.margin_m };
                    let builder = collider(builder, model, settings, shape).user_data(tag.pack());
                    shape_colliders.push((rapier.insert_collider(builder, Some(handle)), index, shape_index));
                }
            }
            bodies.push(handle);
        }
        let template = Template { bodies: rapier.bodies.clone(), colliders: rapier.colliders.clone() };
        let link_bodies = model.links.iter().map(|link| link.body).collect();
        Self { rapier, bodies, link_bodies, floor, shape_colliders, template }
    }

    /// Discards everything that was simulated.
    ///
    /// That includes contact pairs, impulses for warm starts, islands and the order of constraints, so an earlier episode
    /// cannot influence the next one.
    pub(super) fn reset(&mut self) {
        let world = &mut self.rapier;
        world.bodies = self.template.bodies.clone();
        world.colliders = self.template.colliders.clone();
        world.physics_pipeline = PhysicsPipeline::new();
        world.islands = IslandManager::new();
        // A tree of a few dozen colliders needs no rebalancing while they move.
        world.broad_phase = BroadPhaseBvh::with_optimization_strategy(BvhOptimizationStrategy::None);
        world.narrow_phase = NarrowPhase::new();
        world.ccd_solver = CCDSolver::new();
    }

    /// Returns whether every body's motion is finite. Rapier disables a body with a non-finite state and continues.
    pub(super) fn is_finite(&self) -> bool {
        self.rapier.quarantine().is_empty()
            && self.bodies.iter().all(|handle| {
                let body = &self.rapier.bodies[*handle];
                body.is_enabled() && body.position().is_finite() && body.vels().is_finite()
            })
    }
}

/// Returns the largest sum of the margins of two shapes (m).
fn largest_margin_sum_m(model: &Model) -> f64 {
    let shapes = model.bodies.iter().flat_map(|body| &body.shapes);
    let widest_m = shapes.map(|shape| shape.margin_m).fold(0.0, f64::max);
    widest_m + widest_m.max(model.floor_margin_m)
}

fn rigid_body(body: &Body) -> RigidBodyBuilder {
    RigidBodyBuilder::dynamic()
        .additional_mass_properties(mass_properties(body))
        .can_sleep(false)
        // The flight includes gyroscopic forces.
        .gyroscopic_forces_enabled(false)
        // Rapier limits rotation so that shapes do not pass through each other; limbs may rotate faster.
        .allow_fast_rotation(true)
}

pub(super) fn mass_properties(body: &Body) -> MassProperties {
    MassProperties::with_inertia_matrix(
        to_point(&body.centre_of_mass_m),
        body.mass_kg as f32,
        to_matrix(&body.inertia_kgm2),
    )
}

/// Returns a collider of a shape; `None` for geometries that only contribute mass.
fn collider_shape(geometry: &Geometry) -> Option<ColliderBuilder> {
    Some(match *geometry {
        Geometry::Sphere { centre_m, radius_m } => {
            ColliderBuilder::ball(radius_m as f32).translation(to_point(&centre_m))
        }
        Geometry::Capsule { from_m, to_m, radius_m } => {
            ColliderBuilder::capsule_from_endpoints(to_point(&from_m), to_point(&to_m), radius_m as f32)
        }
        Geometry::Cylinder { pose, radius_m, half_length_m } => {
            // The axis of Rapier's cylinders is y.
            let upright = UnitQuaternion::from_axis_angle(&nalgebra::Vector3::x_axis(), FRAC_PI_2);
            ColliderBuilder::cylinder(half_length_m as f32, radius_m as f32).position(to_pose(&(pose * upright)))
        }
        Geometry::Box { pose, half_m } => {
            ColliderBuilder::cuboid(half_m.x as f32, half_m.y as f32, half_m.z as f32).position(to_pose(&pose))
        }
        Geometry::Ellipsoid { .. } => return None,
    })
}

fn to_pose(pose: &Isometry3<f64>) -> Pose {
    Pose::from_parts(to_vector(&pose.translation.vector), to_rotation(&pose.rotation))
}

/// Adds friction and collision groups to a collider.
fn collider(builder: ColliderBuilder, model: &Model, settings: &PhysicsSettings, shape: &Shape) -> ColliderBuilder {
    let touches = Group::from_bits_truncate(model.collision_masks[shape.group]);
    let filter = if settings.self_collision { touches } else { touches & group(FLOOR_GROUP) };
    builder
        // The body has the mass, which the model sums in double precision.
        .density(0.0)
        // A pair has the greater of both frictions.
        .friction(own_friction(shape))
        .friction_combine_rule(CoefficientCombineRule::Max)
        .collision_groups(InteractionGroups::new(group(shape.group), filter, InteractionTestMode::And))
}

pub(super) fn own_friction(shape: &Shape) -> f32 {
    if shape.has_friction { shape.friction as f32 } else { 0.0 }
}

fn group(index: usize) -> Group {
    Group::from_bits_truncate(1 << index)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_survive_the_user_data() {
        for (link, margin_m) in [(None, 0.0), (None, 0.001), (Some(0), 0.01), (Some(30), f64::MIN_POSITIVE)] {
            let tag = Tag { link, margin_m };
            let collider = ColliderBuilder::ball(1.0).user_data(tag.pack()).build();
            assert_eq!(Tag::of(&collider), tag);
        }
    }
}
