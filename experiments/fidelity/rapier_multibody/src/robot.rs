//! Plain description of a robot, read by `rapier3d-mjcf`; [`crate::single`] and [`crate::double`] build worlds from it.

use std::path::Path;

use rapier3d::prelude::*;
use rapier3d_mjcf::{MjcfDofKind, MjcfLoaderOptions, MjcfRobot};

/// Position (m) and rotation (quaternion x, y, z, w).
#[derive(Clone, Copy, Debug)]
pub struct JointFrame {
    pub position: [f64; 3],
    pub rotation: [f64; 4],
}

/// Mass (kg), centre of mass (m), principal inertia (kg m²) and the rotation of its axes.
#[derive(Clone, Copy, Debug)]
pub struct LinkMass {
    pub mass: f64,
    pub centre: [f64; 3],
    pub principal: [f64; 3],
    pub axes: [f64; 4],
}

/// Collision shape of a link.
#[derive(Clone, Copy, Debug)]
pub enum ChainShape {
    Ball { centre: [f64; 3], radius: f64 },
    Capsule { ends: [[f64; 3]; 2], radius: f64 },
}

/// Hinge that turns about the x axis of its frames.
#[derive(Clone, Copy, Debug)]
pub struct ChainHinge {
    pub range: Option<[f64; 2]>,
    pub damping: f64,
    pub armature: f64,
    pub stiffness: f64,
    pub spring_rest: f64,
}

/// Body with at most one joint; a body of the file with several hinges becomes a chain, whose first links have no mass.
#[derive(Clone, Debug)]
pub struct ChainLink {
    /// Index of the parent; `None` for the root, which floats.
    pub parent: Option<usize>,
    /// `None` for the root and for a link that is welded to its parent.
    pub hinge: Option<ChainHinge>,
    /// Frames of the joint in the parent and in this link.
    pub frames: [JointFrame; 2],
    pub mass: Option<LinkMass>,
    pub shapes: Vec<ChainShape>,
    /// Group of links without a joint between them, and its parent group: such neighbours do not collide, as in MuJoCo.
    pub groups: [usize; 2],
}

/// Motor: torque (Nm) per unit of control, and the range of its control.
#[derive(Clone, Copy, Debug)]
pub struct TorqueMotor {
    pub link: usize,
    pub gear: f64,
    pub control: [f64; 2],
}

/// Robot on a floor at height 0.
#[derive(Clone, Debug)]
pub struct MultibodyRobot {
    pub links: Vec<ChainLink>,
    /// Links that hinges move, in the order of MuJoCo's `qpos`.
    pub hinges: Vec<usize>,
    pub motors: Vec<TorqueMotor>,
    pub gravity: f64,
    pub friction: f64,
    /// Height of the root in the nominal pose (m).
    pub height: f64,
}

impl MultibodyRobot {
    /// Reads a model file.
    pub fn from_mjcf(xml: &str) -> Result<Self, String> {
        let (robot, model) = MjcfRobot::from_str(xml, MjcfLoaderOptions::default(), Path::new("."))
            .map_err(|why| format!("the model is unreadable: {why}"))?;
        // Entry 0 is the world.
        let mut links = (1..robot.bodies.len()).map(|index| link(&robot, index)).collect::<Result<Vec<_>, _>>()?;
        for index in 0..links.len() {
            links[index].groups = match links[index].parent {
                None => [0, 0],
                Some(parent) if links[index].hinge.is_none() => links[parent].groups,
                // Links without mass belong to the body whose chain they begin.
                Some(parent) if links[parent].mass.is_none() => [index + 1, links[parent].groups[1]],
                Some(parent) => [index + 1, links[parent].groups[0]],
            };
        }
        let dofs = robot.qpos_dofs.iter().filter(|dof| dof.kind == MjcfDofKind::Hinge);
        let hinges: Vec<usize> = dofs.map(|dof| dof.body - 1).collect();
        let motors = robot.actuators.iter().map(|binding| {
            let joint = binding.joint_index.ok_or("a motor without a joint")?;
            let control = binding.actuator.ctrl_range.ok_or("a motor without a range")?;
            Ok(TorqueMotor { link: robot.joints[joint].link2 - 1, gear: binding.actuator.gear[0], control })
        });
        let root = robot.bodies[1].body.position();
        Ok(Self {
            hinges,
            motors: motors.collect::<Result<_, String>>()?,
            gravity: f64::from(robot.gravity.z),
            friction: model.bodies[0].body.geoms.first().map_or(1.0, |floor| floor.friction[0]),
            height: f64::from(root.translation.z),
            links,
        })
    }
}

fn link(robot: &MjcfRobot, index: usize) -> Result<ChainLink, String> {
    let body = &robot.bodies[index];
    let joint = robot.joints.iter().find(|joint| joint.link2 == index);
    if joint.is_none() && index != 1 {
        return Err("only the first body may float".to_string());
    }
    let revolute = joint.filter(|joint| joint.joint.locked_axes == JointAxesMask::LOCKED_REVOLUTE_AXES);
    let hinge = revolute.map(|joint| ChainHinge {
        range: joint.joint.limits(JointAxis::AngX).map(|limits| [f64::from(limits.min), f64::from(limits.max)]),
        damping: f64::from(joint.damping_per_dof),
        armature: f64::from(joint.armature_per_dof),
        stiffness: f64::from(joint.spring_stiffness_per_dof),
        spring_rest: f64::from(joint.spring_ref),
    });
    let [first, second] =
        joint.map_or([Pose::IDENTITY; 2], |joint| [joint.joint.local_frame1, joint.joint.local_frame2]);
    Ok(ChainLink {
        parent: joint.map(|joint| joint.link1 - 1),
        hinge,
        frames: [frame(first), frame(second)],
        mass: mass(&body.body),
        shapes: body.colliders.iter().map(shape).collect::<Result<_, _>>()?,
        groups: [0, 0],
    })
}

/// Returns the mass properties that the loader gave to a body.
fn mass(body: &RigidBody) -> Option<LinkMass> {
    let mut bodies = RigidBodySet::new();
    let handle = bodies.insert(body.clone());
    bodies[handle].recompute_mass_properties_from_colliders(&ColliderSet::new());
    let found = bodies[handle].mass_properties().local_mprops;
    let rotation = found.principal_inertia_local_frame;
    (found.mass() > 0.0).then(|| LinkMass {
        mass: f64::from(found.mass()),
        centre: vector(found.local_com),
        principal: vector(found.principal_inertia()),
        axes: [rotation.x, rotation.y, rotation.z, rotation.w].map(f64::from),
    })
}

fn shape(collider: &Collider) -> Result<ChainShape, String> {
    // A collider without a parent yet has its place in the body as its position.
    let place = *collider.position();
    let at = |point: Vector| vector(place.transform_point(point));
    if let Some(ball) = collider.shape().as_ball() {
        return Ok(ChainShape::Ball { centre: at(Vector::ZERO), radius: f64::from(ball.radius) });
    }
    let capsule = collider.shape().as_capsule().ok_or("a shape that is neither sphere nor capsule")?;
    Ok(ChainShape::Capsule { ends: [at(capsule.segment.a), at(capsule.segment.b)], radius: f64::from(capsule.radius) })
}

fn frame(pose: Pose) -> JointFrame {
    let rotation = pose.rotation;
    JointFrame {
        position: vector(pose.translation),
        rotation: [rotation.x, rotation.y, rotation.z, rotation.w].map(f64::from),
    }
}

fn vector(v: Vector) -> [f64; 3] {
    [v.x, v.y, v.z].map(f64::from)
}
