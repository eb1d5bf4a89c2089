//! The Rapier world of one humanoid, and how it is made pristine again for every episode.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Isometry3, UnitQuaternion};
use rapier3d::prelude::*;

use super::convert::{to_matrix, to_point, to_rotation, to_vector};
use crate::config::{CONTROL_STEP_S, EnvironmentConfig};
use crate::model::{Body, FLOOR_GROUP, Geometry, Model, Shape};

/// Surfaces that are this much farther apart than their margins are still looked at (m): at 2.4 m/s they would meet
/// within a step of 7.5 ms.
const REACH_M: f64 = 0.018;

/// A Rapier world with one humanoid on a floor.
pub(super) struct World {
    pub(super) rapier: PhysicsWorld,
    /// Handles in the order of [`Model::bodies`].
    pub(super) bodies: Vec<RigidBodyHandle>,
    /// The rigid body of each link.
    pub(super) link_bodies: Vec<usize>,
    pub(super) floor: ColliderHandle,
    /// Colliders of the limbs, with the body and the place among its shapes.
    pub(super) limbs: Vec<(ColliderHandle, usize, usize)>,
    pub(super) template: Template,
}

/// The sets as they were filled, never stepped: what every episode starts from.
pub(super) struct Template {
    pub(super) bodies: RigidBodySet,
    pub(super) colliders: ColliderSet,
}

/// What each collider says about itself, in its user data.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tag {
    /// Whose shape it is; `None` is the floor.
    pub(super) link: Option<usize>,
    /// See [`Shape::margin_m`].
    pub(super) margin_m: f64,
}

impl Tag {
    /// The margin's bits above, the link's number and one below.
    fn pack(self) -> u128 {
        u128::from(self.margin_m.to_bits()) << 64 | self.link.map_or(0, |link| link as u128 + 1)
    }

    pub(super) fn of(collider: &Collider) -> Self {
        let data = collider.user_data;
        Self { link: (data as u64 as usize).checked_sub(1), margin_m: f64::from_bits((data >> 64) as u64) }
    }
}

impl World {
    pub(super) fn new(model: &Model, config: &EnvironmentConfig) -> Self {
        let mut rapier = PhysicsWorld::new();
        // Gravity is in the flight.
        rapier.gravity = Vector::ZERO;
        let parameters = &mut rapier.integration_parameters;
        parameters.dt = (CONTROL_STEP_S / f64::from(config.substeps)) as f32;
        parameters.num_solver_iterations = config.solver_iterations as usize;
        parameters.max_ccd_substeps = 0;
        // What is asked for is a first guess: without more passes for penetrations, which are dealt with later.
        parameters.num_internal_pgs_iterations = 1;
        parameters.num_internal_stabilization_iterations = 0;
        parameters.normalized_prediction_distance = (REACH_M + widest_margins_m(model)) as f32;
        // A rolling foot turns its contact point away from the floor long before the 5 cm within which Rapier
        // would go on using an old one.
        parameters.contact_recycling = false;

        let floor = ColliderBuilder::new(SharedShape::halfspace(Vector::Z))
            .friction(model.floor_friction as f32)
            .friction_combine_rule(CoefficientCombineRule::Max)
            .collision_groups(InteractionGroups::new(group(FLOOR_GROUP), Group::ALL, InteractionTestMode::And))
            .user_data(Tag { link: None, margin_m: model.floor_margin_m }.pack());
        let floor = rapier.insert_collider(floor, None);

        let mut bodies = Vec::with_capacity(model.bodies.len());
        let mut limbs = Vec::new();
        for (index, body) in model.bodies.iter().enumerate() {
            let handle = rapier.insert_body(rigid_body(body));
            for (place, shape) in body.shapes.iter().enumerate() {
                if let Some(form) = form(&shape.geometry) {
                    let tag = Tag { link: model.link_of_shape(index, place), margin_m: shape.margin_m };
                    let limb = collider(form, model, config, shape).user_data(tag.pack());
                    limbs.push((rapier.insert_collider(limb, Some(handle)), index, place));
                }
            }
            bodies.push(handle);
        }
        let template = Template { bodies: rapier.bodies.clone(), colliders: rapier.colliders.clone() };
        let link_bodies = model.links.iter().map(|link| link.body).collect();
        Self { rapier, bodies, link_bodies, floor, limbs, template }
    }

    /// Forgets everything that was simulated.
    ///
    /// Contact pairs, impulses kept for warm starts, islands and the order of constraints all live in what is thrown
    /// away here, so nothing of an earlier episode can reach the next one.
    pub(super) fn restore(&mut self) {
        let world = &mut self.rapier;
        world.bodies = self.template.bodies.clone();
        world.colliders = self.template.colliders.clone();
        world.physics_pipeline = PhysicsPipeline::new();
        world.islands = IslandManager::new();
        // A tree of a few dozen limbs needs no rebalancing while they move.
        world.broad_phase = BroadPhaseBvh::with_optimization_strategy(BvhOptimizationStrategy::None);
        world.narrow_phase = NarrowPhase::new();
        world.ccd_solver = CCDSolver::new();
    }

    /// Whether every body's motion is finite. Rapier disables a body whose state is not, and goes on without it.
    pub(super) fn is_sound(&self) -> bool {
        self.rapier.quarantine().is_empty()
            && self.bodies.iter().all(|handle| {
                let body = &self.rapier.bodies[*handle];
                body.is_enabled() && body.position().is_finite() && body.vels().is_finite()
            })
    }
}

/// Largest sum of the margins of two shapes (m).
fn widest_margins_m(model: &Model) -> f64 {
    let shapes = model.bodies.iter().flat_map(|body| &body.shapes);
    let widest_m = shapes.map(|shape| shape.margin_m).fold(0.0, f64::max);
    widest_m + widest_m.max(model.floor_margin_m)
}

fn rigid_body(body: &Body) -> RigidBodyBuilder {
    RigidBodyBuilder::dynamic()
        .additional_mass_properties(mass_properties(body))
        .can_sleep(false)
        // Gyroscopic forces are in the flight.
        .gyroscopic_forces_enabled(false)
        // Its guard against fast turning is for shapes that could pass through each other; limbs may whirl.
        .allow_fast_rotation(true)
}

pub(super) fn mass_properties(body: &Body) -> MassProperties {
    MassProperties::with_inertia_matrix(
        to_point(&body.centre_of_mass_m),
        body.mass_kg as f32,
        to_matrix(&body.inertia_kgm2),
    )
}

/// Form and place of a shape; `None` for those that the model's reader lets only weigh.
fn form(geometry: &Geometry) -> Option<ColliderBuilder> {
    Some(match *geometry {
        Geometry::Sphere { centre_m, radius_m } => {
            ColliderBuilder::ball(radius_m as f32).translation(to_point(&centre_m))
        }
        Geometry::Capsule { from_m, to_m, radius_m } => {
            ColliderBuilder::capsule_from_endpoints(to_point(&from_m), to_point(&to_m), radius_m as f32)
        }
        Geometry::Cylinder { pose, radius_m, half_length_m } => {
            // Rapier's cylinders lie along y.
            let upright = UnitQuaternion::from_axis_angle(&nalgebra::Vector3::x_axis(), FRAC_PI_2);
            ColliderBuilder::cylinder(half_length_m as f32, radius_m as f32).position(at(&(pose * upright)))
        }
        Geometry::Box { pose, half_m } => {
            ColliderBuilder::cuboid(half_m.x as f32, half_m.y as f32, half_m.z as f32).position(at(&pose))
        }
        Geometry::Ellipsoid { .. } => return None,
    })
}

fn at(pose: &Isometry3<f64>) -> Pose {
    Pose::from_parts(to_vector(&pose.translation.vector), to_rotation(&pose.rotation))
}

fn collider(form: ColliderBuilder, model: &Model, config: &EnvironmentConfig, shape: &Shape) -> ColliderBuilder {
    let touches = Group::from_bits_truncate(model.collision_masks[shape.group]);
    let filter = if config.self_collision { touches } else { touches & group(FLOOR_GROUP) };
    form
        // Masses are the body's: it was summed up in double precision, with overlaps as the model means them.
        .density(0.0)
        // The greater friction of a pair counts; where neither shape rubs, both have none.
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
