//! Humanoid as a multibody of Rapier in the precision of `super::rapier`.
//!
//! The root link's frame lies at its centre of mass: Rapier moves the origin of a multibody's root by the velocity of its
//! centre of mass, which is wrong for a root that turns about another point.

use super::rapier::prelude::*;
use crate::robot::{ChainLink, ChainShape, JointFrame, MultibodyRobot};
use crate::settings::MultibodySettings;

/// Index of a hinge's angle in Rapier's joint coordinates.
const ANGLE: usize = 3;

/// One humanoid on a floor.
pub struct MultibodyWorld {
    rapier: PhysicsWorld,
    robot: MultibodyRobot,
    bodies: Vec<RigidBodyHandle>,
    multibody: MultibodyIndex,
    /// Links of the multibody, by link of the robot.
    links: Vec<usize>,
    /// Origin of the file's root body in the frame of Rapier's root.
    origin: Vector,
    filter: Filter,
    substeps: u32,
}

/// Skips contacts between neighbours, and those between links if they do not collide with each other.
struct Filter {
    self_collision: bool,
}

impl PhysicsHooks for Filter {
    fn filter_contact_pair(&self, context: &PairFilterContext) -> Option<SolverFlags> {
        let groups = |handle: ColliderHandle| {
            let data = context.colliders[handle].user_data;
            (data > 0).then_some([(data >> 32) as u32, data as u32])
        };
        let allowed = match (groups(context.collider1), groups(context.collider2)) {
            (Some(a), Some(b)) => self.self_collision && a[0] != b[0] && a[0] != b[1] && a[1] != b[0],
            _ => true,
        };
        allowed.then_some(SolverFlags::default())
    }
}

impl MultibodyWorld {
    /// Builds a world with the robot at rest.
    pub fn new(robot: &MultibodyRobot, settings: MultibodySettings, control_step_s: f64) -> Self {
        let mut rapier =
            PhysicsWorld { gravity: Vector::new(0.0, 0.0, robot.gravity as Real), ..PhysicsWorld::default() };
        rapier.integration_parameters.dt = (control_step_s / f64::from(settings.substeps)) as Real;
        rapier.integration_parameters.num_solver_iterations = settings.solver_iterations;
        // Links have no friction of their own: they slide on each other, but not on the floor, as in the file.
        let floor = ColliderBuilder::new(SharedShape::halfspace(Vector::Z))
            .friction(robot.friction as Real)
            .friction_combine_rule(CoefficientCombineRule::Max);
        rapier.insert(RigidBodyBuilder::fixed(), floor);
        let centre = robot.links[0].mass.map_or(Vector::ZERO, |mass| vector(mass.centre));
        let shift = if settings.root_at_centre { centre } else { Vector::ZERO };
        let mut bodies = Vec::new();
        for (index, link) in robot.links.iter().enumerate() {
            let moved = if index == 0 { shift } else { Vector::ZERO };
            let body = insert(&mut rapier, link, moved);
            bodies.push(body);
            if let Some(parent) = link.parent {
                let mut joint = joint(link);
                if parent == 0 {
                    joint.local_frame1.translation -= shift;
                }
                rapier.multibody_joints.insert(bodies[parent], body, joint, true);
            }
        }
        let multibody = rapier.multibody_joints.rigid_body_link(bodies[0]).expect("the robot has joints").multibody;
        let link = |body: &RigidBodyHandle| rapier.multibody_joints.rigid_body_link(*body).expect("a link").id;
        let links = bodies.iter().map(link).collect();
        let filter = Filter { self_collision: settings.self_collision };
        let origin = -shift;
        let mut world = Self {
            rapier,
            robot: robot.clone(),
            bodies,
            multibody,
            links,
            origin,
            filter,
            substeps: settings.substeps,
        };
        world.set_joint_constants();
        world
    }

    /// Sets springs, rotors and damping; replaces Rapier's default damping of 0.1 of every rotation.
    fn set_joint_constants(&mut self) {
        let multibody = self.rapier.multibody_joints.get_multibody_mut(self.multibody).expect("the multibody");
        multibody.damping_mut().fill(0.0);
        for (index, link) in self.robot.links.iter().enumerate() {
            let Some(hinge) = link.hinge else { continue };
            let found = multibody.link_mut(self.links[index]).expect("a link");
            found.joint.set_spring(ANGLE, hinge.stiffness as Real, hinge.spring_rest as Real);
            let at = found.assembly_id();
            multibody.damping_mut()[at] = hinge.damping as Real;
            multibody.armature_mut()[at] = hinge.armature as Real;
        }
    }

    /// Starts from MuJoCo's state vectors.
    pub fn set_state(&mut self, qpos: &[f64], qvel: &[f64]) {
        let norm = qpos[3..7].iter().map(|part| part * part).sum::<f64>().sqrt();
        let quaternion = [qpos[4], qpos[5], qpos[6], qpos[3]].map(|part| part / norm);
        let rotation = rotation(quaternion);
        let offset = rotation * -self.origin;
        let position = vector([qpos[0], qpos[1], qpos[2]]) + offset;
        let turning = rotation * vector([qvel[3], qvel[4], qvel[5]]);
        let speed = vector([qvel[0], qvel[1], qvel[2]]) + turning.cross(offset);
        self.rapier.bodies[self.bodies[0]].set_position(Pose::from_parts(position, rotation), true);
        let multibody = self.rapier.multibody_joints.get_multibody_mut(self.multibody).expect("the multibody");
        let mut velocity = vec![speed.x, speed.y, speed.z, turning.x, turning.y, turning.z];
        velocity.resize(multibody.ndofs(), 0.0);
        for (hinge, (angle, rate)) in self.robot.hinges.iter().zip(qpos[7..].iter().zip(&qvel[6..])) {
            let link = multibody.link_mut(self.links[*hinge]).expect("a link");
            let change = *angle as Real - link.joint.coords()[ANGLE];
            link.joint.apply_displacement(&[change]);
            velocity[link.assembly_id()] = *rate as Real;
        }
        multibody.generalized_velocity_mut().copy_from_slice(&velocity);
        multibody.forward_kinematics(&self.rapier.bodies, true);
        multibody.update_rigid_bodies(&mut self.rapier.bodies, true);
    }

    /// Simulates one control step; returns whether the state is finite.
    pub fn step(&mut self, controls: &[f64]) -> bool {
        for _ in 0..self.substeps {
            self.apply_torques(controls);
            self.rapier.step_with_events(&self.filter, &());
        }
        let multibody = self.rapier.multibody_joints.get_multibody(self.multibody).expect("the multibody");
        multibody.generalized_velocity().iter().all(|rate| rate.is_finite()) && self.height().is_finite()
    }

    /// Applies the motors' torques to both links of each hinge. Rapier keeps them during its own smaller steps.
    fn apply_torques(&mut self, controls: &[f64]) {
        let bodies = &mut self.rapier.bodies;
        for body in &self.bodies {
            bodies[*body].reset_torques(true);
        }
        for (motor, control) in self.robot.motors.iter().zip(controls) {
            let link = &self.robot.links[motor.link];
            let parent = self.bodies[link.parent.expect("a hinge has a parent")];
            let axis = bodies[parent].rotation() * (rotation(link.frames[0].rotation) * Vector::X);
            let torque = axis * (control.clamp(motor.control[0], motor.control[1]) * motor.gear) as Real;
            bodies[self.bodies[motor.link]].add_torque(torque, true);
            bodies[parent].add_torque(-torque, true);
        }
    }

    /// Height of the root (m).
    pub fn height(&self) -> f64 {
        (*self.rapier.bodies[self.bodies[0]].position() * self.origin).z as f64
    }

    /// Returns MuJoCo's state vectors.
    pub fn state(&self) -> (Vec<f64>, Vec<f64>) {
        let multibody = self.rapier.multibody_joints.get_multibody(self.multibody).expect("the multibody");
        let rates = multibody.generalized_velocity();
        let pose = *self.rapier.bodies[self.bodies[0]].position();
        let at = pose * self.origin;
        let turning = Vector::new(rates[3], rates[4], rates[5]);
        let speed = Vector::new(rates[0], rates[1], rates[2]) + turning.cross(pose.rotation * self.origin);
        let local = pose.rotation.inverse() * turning;
        let turn = pose.rotation;
        let mut qpos = vec![at.x, at.y, at.z, turn.w, turn.x, turn.y, turn.z];
        let mut qvel = vec![speed.x, speed.y, speed.z, local.x, local.y, local.z];
        for hinge in &self.robot.hinges {
            let link = multibody.link(self.links[*hinge]).expect("a link");
            qpos.push(link.joint.coords()[ANGLE]);
            qvel.push(rates[link.assembly_id()]);
        }
        (qpos.into_iter().map(widen).collect(), qvel.into_iter().map(widen).collect())
    }
}

fn insert(rapier: &mut PhysicsWorld, link: &ChainLink, moved: Vector) -> RigidBodyHandle {
    let mut body = RigidBodyBuilder::dynamic().can_sleep(false);
    if let Some(mass) = link.mass {
        body = body.additional_mass_properties(MassProperties::with_principal_inertia_frame(
            vector(mass.centre) - moved,
            mass.mass as Real,
            vector(mass.principal),
            rotation(mass.axes),
        ));
    }
    let body = rapier.bodies.insert(body);
    let user_data = (link.groups[0] as u128 + 1) << 32 | (link.groups[1] as u128 + 1);
    for shape in &link.shapes {
        let collider = match *shape {
            ChainShape::Ball { centre, radius } => {
                ColliderBuilder::ball(radius as Real).translation(vector(centre) - moved)
            }
            ChainShape::Capsule { ends: [a, b], radius } => {
                ColliderBuilder::capsule_from_endpoints(vector(a) - moved, vector(b) - moved, radius as Real)
            }
        };
        let collider =
            collider.density(0.0).friction(0.0).user_data(user_data).active_hooks(ActiveHooks::FILTER_CONTACT_PAIRS);
        rapier.colliders.insert_with_parent(collider, body, &mut rapier.bodies);
    }
    // Rapier computes mass properties in its first step; a state may be set before.
    rapier.bodies[body].recompute_mass_properties_from_colliders(&rapier.colliders);
    body
}

fn joint(link: &ChainLink) -> GenericJoint {
    let axes =
        if link.hinge.is_some() { JointAxesMask::LOCKED_REVOLUTE_AXES } else { JointAxesMask::LOCKED_FIXED_AXES };
    let mut joint =
        GenericJointBuilder::new(axes).local_frame1(pose(link.frames[0])).local_frame2(pose(link.frames[1]));
    if let Some(range) = link.hinge.and_then(|hinge| hinge.range) {
        joint = joint.limits(JointAxis::AngX, range.map(|limit| limit as Real));
    }
    joint.build()
}

fn pose(frame: JointFrame) -> Pose {
    Pose::from_parts(vector(frame.position), rotation(frame.rotation))
}

fn vector([x, y, z]: [f64; 3]) -> Vector {
    Vector::new(x as Real, y as Real, z as Real)
}

fn rotation([x, y, z, w]: [f64; 4]) -> Rotation {
    Rotation::from_xyzw(x as Real, y as Real, z as Real, w as Real).normalize()
}

fn widen(number: Real) -> f64 {
    f64::from(number)
}
