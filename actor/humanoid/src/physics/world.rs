//! The Rapier world of one humanoid, and how it is made pristine again for every episode.

use rapier3d::prelude::*;

use super::convert::{from_pose, from_vector, to_matrix, to_point, to_pose, to_rotation, to_vector};
use super::kinematics::{BodyMotion, chain_base, parent_anchor};
use crate::config::{CONTROL_STEP_S, EnvironmentConfig};
use crate::model::{Body, Model, Shape};

/// Collision group of the floor; body i is in group i.
const FLOOR_GROUP: Group = Group::GROUP_32;

/// Sweeps over all constraints in each pass of the solver. The second halves the distance between joint ends
/// for a tenth of the time.
const SWEEPS: usize = 2;
/// Speed at which a hinge beyond its limit is brought back (rad/s). With Rapier's default of 3 a fall bends the waist
/// up to 0.5 rad too far. The solver takes this speed out again before velocities count, so nothing is flung.
const LIMIT_RECOVERY_RADPS: f32 = 30.0;

/// A Rapier world with one humanoid on a floor.
pub(super) struct World {
    pub(super) rapier: PhysicsWorld,
    /// Handles in the order of [`Model::bodies`].
    pub(super) bodies: Vec<RigidBodyHandle>,
    /// Joint of each body to its parent, in the same order; the root has none.
    pub(super) joints: Vec<Option<ImpulseJointHandle>>,
    template: Template,
}

/// The sets as they were filled, never stepped: what every episode starts from.
struct Template {
    bodies: RigidBodySet,
    colliders: ColliderSet,
    joints: ImpulseJointSet,
}

impl World {
    pub(super) fn new(model: &Model, config: &EnvironmentConfig) -> Self {
        let mut rapier = PhysicsWorld::new();
        rapier.gravity = to_vector(&model.gravity_mps2);
        let parameters = &mut rapier.integration_parameters;
        parameters.dt = (CONTROL_STEP_S / f64::from(config.substeps)) as f32;
        parameters.num_solver_iterations = config.solver_iterations as usize;
        parameters.max_ccd_substeps = 0;
        // A light waist between a heavy chest and heavy legs: one sweep over the joints per pass leaves them apart.
        parameters.num_internal_pgs_iterations = SWEEPS;
        // Only limits that are far exceeded ever get this fast (rad/s); contacts push out much more slowly.
        parameters.normalized_max_corrective_velocity = LIMIT_RECOVERY_RADPS;
        // A rolling foot turns its contact point away from the floor long before the 5 cm within which Rapier
        // would go on using an old one.
        parameters.contact_recycling = false;

        let floor = ColliderBuilder::new(SharedShape::halfspace(Vector::Z))
            .friction(model.floor_friction as f32)
            .friction_combine_rule(CoefficientCombineRule::Max)
            .collision_groups(InteractionGroups::new(FLOOR_GROUP, Group::ALL, InteractionTestMode::And))
            .user_data(0);
        rapier.insert_collider(floor, None);

        let mut bodies = Vec::with_capacity(model.bodies.len());
        let mut joints = Vec::with_capacity(model.bodies.len());
        for (index, body) in model.bodies.iter().enumerate() {
            let handle = rapier.insert_body(rigid_body(body));
            for (number, shape) in body.shapes.iter().enumerate() {
                // The floor is 0, and so is a shape that is no link's; every shape that was read is some link's.
                let owner = model.link_of_shape(index, number).map_or(0, |link| link as u128 + 1);
                rapier.insert_collider(collider(model, config, index, shape).user_data(owner), Some(handle));
            }
            joints.push(body.parent.map(|parent| rapier.insert_impulse_joint(bodies[parent], handle, joint(body))));
            bodies.push(handle);
        }
        let template = Template {
            bodies: rapier.bodies.clone(),
            colliders: rapier.colliders.clone(),
            joints: rapier.impulse_joints.clone(),
        };
        Self { rapier, bodies, joints, template }
    }

    /// Forgets everything that was simulated and puts the bodies where they are told.
    ///
    /// Contact pairs, impulses kept for warm starts, islands and the order of constraints all live in what is thrown
    /// away here, so nothing of an earlier episode can reach the next one.
    pub(super) fn restore(&mut self, motions: &[BodyMotion]) {
        let world = &mut self.rapier;
        world.bodies = self.template.bodies.clone();
        world.colliders = self.template.colliders.clone();
        world.impulse_joints = self.template.joints.clone();
        world.physics_pipeline = PhysicsPipeline::new();
        world.islands = IslandManager::new();
        world.broad_phase = BroadPhaseBvh::default();
        world.narrow_phase = NarrowPhase::new();
        world.ccd_solver = CCDSolver::new();
        for (handle, motion) in self.bodies.iter().zip(motions) {
            let body = &mut world.bodies[*handle];
            body.set_position(to_pose(&motion.pose), false);
            body.set_linvel(to_vector(&motion.linear_mps), false);
            body.set_angvel(to_vector(&motion.angular_radps), false);
        }
    }

    /// Whether every body's motion is finite. Rapier disables a body whose state is not, and goes on without it.
    pub(super) fn is_sound(&self) -> bool {
        self.rapier.quarantine().is_empty()
            && self.bodies.iter().all(|handle| {
                let body = &self.rapier.bodies[*handle];
                body.is_enabled() && body.position().is_finite() && body.vels().is_finite()
            })
    }

    /// Makes the root's velocity NaN.
    pub(super) fn poison(&mut self) {
        self.rapier.bodies[self.bodies[0]].set_linvel(Vector::splat(Real::NAN), false);
    }

    /// Copies the bodies' motion out of Rapier.
    pub(super) fn read(&self, motions: &mut [BodyMotion]) {
        for (handle, motion) in self.bodies.iter().zip(motions) {
            let body = &self.rapier.bodies[*handle];
            *motion = BodyMotion {
                pose: from_pose(body.position()),
                linear_mps: from_vector(body.linvel()),
                angular_radps: from_vector(body.angvel()),
            };
        }
    }
}

fn rigid_body(body: &Body) -> RigidBodyBuilder {
    let mass = MassProperties::with_inertia_matrix(
        to_point(&body.centre_of_mass_m),
        body.mass_kg as f32,
        to_matrix(&body.inertia_kgm2),
    );
    RigidBodyBuilder::dynamic().additional_mass_properties(mass).can_sleep(false)
}

fn collider(model: &Model, config: &EnvironmentConfig, body: usize, shape: &Shape) -> ColliderBuilder {
    let builder = if shape.is_sphere() {
        ColliderBuilder::ball(shape.radius_m as f32).translation(to_point(&shape.from_m))
    } else {
        ColliderBuilder::capsule_from_endpoints(to_point(&shape.from_m), to_point(&shape.to_m), shape.radius_m as f32)
    };
    let filter = if config.self_collision { FLOOR_GROUP | strangers(model, body) } else { FLOOR_GROUP };
    builder
        // Masses are the body's: it was summed up in double precision, with overlaps as the model means them.
        .density(0.0)
        // Contacts between body parts slide, as in the original; the floor's rule lifts contacts with it to its friction.
        .friction(0.0)
        .collision_groups(InteractionGroups::new(group(body), filter, InteractionTestMode::And))
}

/// Groups of the bodies that a body may touch: all but itself and its neighbours in the tree.
fn strangers(model: &Model, body: usize) -> Group {
    let parent = model.bodies[body].parent;
    (0..model.bodies.len())
        .filter(|&other| other != body && parent != Some(other) && model.bodies[other].parent != Some(body))
        .fold(Group::NONE, |groups, other| groups | group(other))
}

fn group(body: usize) -> Group {
    Group::from_bits_truncate(1 << body)
}

fn joint(body: &Body) -> GenericJoint {
    let missing = match body.hinges.len() {
        1 => JointAxesMask::ANG_Y | JointAxesMask::ANG_Z,
        2 => JointAxesMask::ANG_Z,
        _ => JointAxesMask::empty(),
    };
    let mut joint = GenericJoint::new(JointAxesMask::LIN_AXES | missing);
    joint.local_frame1 = Pose::from_parts(to_point(&parent_anchor(body)), to_rotation(&chain_base(body)));
    joint.local_frame2 = Pose::from_parts(to_point(&body.anchor_m), to_rotation(&body.hinge_frame));
    joint.contacts_enabled = false;
    joint
}
