//! Links below each other, and the joint that holds each.

use std::collections::BTreeMap;

use nalgebra::{Isometry3, Translation3, Unit, UnitQuaternion, Vector3};
use urdf_rs::{Joint, JointType, Link, Pose, Robot};

use crate::error::ModelError;

/// Deepest chain of links; a model text may not nest deeper.
const DEPTH_MAX: usize = 80;

/// Links of a robot.
pub(super) struct LinkTree<'a> {
    pub(super) links: BTreeMap<&'a str, &'a Link>,
    /// Joints below each link, in the order of the text.
    pub(super) below: BTreeMap<&'a str, Vec<Branch<'a>>>,
    /// Link without a parent.
    pub(super) root: &'a str,
    /// Whether a joint of the text lets the robot move freely in the world, which is then the root.
    pub(super) has_world: bool,
}

/// Joint with what it lets its child do.
pub(super) struct Branch<'a> {
    pub(super) joint: &'a Joint,
    /// Pose of the child in its parent with the hinge at zero, or where it is held (m).
    pub(super) pose: Isometry3<f64>,
    pub(super) motion: JointMotion,
}

/// What a joint lets its child do.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum JointMotion {
    Held,
    /// Turns about the joint's axis.
    Hinge,
    Free,
}

impl<'a> LinkTree<'a> {
    /// Orders the links of a robot, and notes which joints are held still.
    pub(super) fn of(
        robot: &'a Robot,
        holds_slides: bool,
        has_other_masses: bool,
        notices: &mut Vec<String>,
    ) -> Result<Self, ModelError> {
        let links: BTreeMap<&str, &Link> = robot.links.iter().map(|link| (link.name.as_str(), link)).collect();
        let mut below: BTreeMap<&str, Vec<Branch<'a>>> = BTreeMap::new();
        let mut parents: BTreeMap<&str, &Joint> = BTreeMap::new();
        let mut held: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
        for joint in &robot.joints {
            let label = format!("joint {}", joint.name);
            for (what, link) in [("parent", &joint.parent.link), ("child", &joint.child.link)] {
                if !links.contains_key(link.as_str()) {
                    return Err(ModelError::unsupported(&label, format!("its {what}, link `{link}`, is missing")));
                }
            }
            if let Some(other) = parents.insert(&joint.child.link, joint) {
                let problem = format!("its child, link `{}`, hangs from joint `{}` too", joint.child.link, other.name);
                return Err(ModelError::unsupported(&label, problem));
            }
            let (motion, angle_rad, why) = motion(joint, holds_slides)?;
            if let Some(why) = why {
                held.entry(why).or_default().push(&joint.name);
            }
            let turn = match angle_rad {
                0.0 => UnitQuaternion::identity(),
                angle_rad => UnitQuaternion::from_axis_angle(&axis(joint)?, angle_rad),
            };
            let branch = Branch { joint, pose: isometry(&joint.origin) * turn, motion };
            below.entry(joint.parent.link.as_str()).or_default().push(branch);
        }
        let mut roots = robot.links.iter().map(|link| link.name.as_str()).filter(|link| !parents.contains_key(link));
        let root = roots.next().ok_or_else(|| {
            ModelError::unsupported("robot", "it needs one link that is no joint's child, above all others")
        })?;
        if let Some(other) = roots.next() {
            let problem = format!("links `{root}` and `{other}` are no joint's child, but a robot hangs together");
            return Err(ModelError::unsupported("robot", problem));
        }
        let mut tree = Self { links, below, root, has_world: false };
        tree.check_reach(robot)?;
        tree.has_world = tree.check_free(&parents)?;
        if !has_other_masses {
            tree.hold_massless(tree.root, &mut held);
        }
        for (why, joints) in held {
            let names: Vec<String> = joints.iter().map(|joint| format!("`{joint}`")).collect();
            notices.push(format!("held still, because {why}: {}", names.join(", ")));
        }
        Ok(tree)
    }

    /// Holds the hinges below a link that move no mass, and returns whether the link or what is below it has mass.
    fn hold_massless(&mut self, link: &'a str, held: &mut BTreeMap<&str, Vec<&'a str>>) -> bool {
        let mut branches = self.below.remove(link).unwrap_or_default();
        let mut has_mass = self.links[link].inertial.mass.value > 0.0;
        for branch in &mut branches {
            let is_heavy = self.hold_massless(&branch.joint.child.link, held);
            if !is_heavy && branch.motion == JointMotion::Hinge {
                branch.motion = JointMotion::Held;
                held.entry("they move no mass").or_default().push(&branch.joint.name);
            }
            has_mass |= is_heavy;
        }
        self.below.insert(link, branches);
        has_mass
    }

    /// Refuses links that the root does not lead to, and chains that are too long.
    fn check_reach(&self, robot: &Robot) -> Result<(), ModelError> {
        let mut open = vec![(self.root, 1)];
        let mut reached = 0;
        while let Some((link, depth)) = open.pop() {
            reached += 1;
            if depth > DEPTH_MAX {
                return Err(ModelError::unsupported(link, format!("it is more than {DEPTH_MAX} links below the root")));
            }
            open.extend(self.below(link).iter().map(|branch| (branch.joint.child.link.as_str(), depth + 1)));
        }
        if reached < robot.links.len() {
            let problem = format!("{} links hang from each other in a ring", robot.links.len() - reached);
            return Err(ModelError::unsupported("robot", problem));
        }
        Ok(())
    }

    /// Returns whether a joint lets the robot move freely; only one, directly below the root, may.
    fn check_free(&self, parents: &BTreeMap<&str, &'a Joint>) -> Result<bool, ModelError> {
        let free = self.below.values().flatten().filter(|branch| branch.motion == JointMotion::Free);
        let mut count = 0;
        for branch in free {
            count += 1;
            if count > 1 || parents.contains_key(branch.joint.parent.link.as_str()) {
                let problem = format!(
                    "it is floating or planar, as only one joint may be, directly below the root `{}`",
                    self.root
                );
                return Err(ModelError::unsupported(&format!("joint {}", branch.joint.name), problem));
            }
        }
        Ok(count > 0)
    }

    /// Returns the joints below a link.
    pub(super) fn below(&self, link: &str) -> &[Branch<'a>] {
        self.below.get(link).map_or(&[], Vec::as_slice)
    }
}

/// Returns what a joint lets its child do, the angle at which it is held (rad), and why.
fn motion(joint: &Joint, holds_slides: bool) -> Result<(JointMotion, f64, Option<&'static str>), ModelError> {
    let refuse = |problem: &str| Err(ModelError::unsupported(&format!("joint {}", joint.name), problem));
    let limit = &joint.limit;
    Ok(match joint.joint_type {
        JointType::Fixed => (JointMotion::Held, 0.0, None),
        JointType::Floating => (JointMotion::Free, 0.0, None),
        JointType::Planar => (JointMotion::Free, 0.0, Some("its base moves freely, not only in a plane")),
        JointType::Prismatic if holds_slides => (JointMotion::Held, 0.0, Some("they slide")),
        JointType::Prismatic => {
            return refuse("it slides, which is not simulated; `--hold-slides` holds it still, and all others");
        }
        JointType::Spherical => return refuse("ball joints are not simulated; use three hinges"),
        JointType::Revolute | JointType::Continuous => {
            if let Some(mimic) = &joint.mimic {
                // The joint that it follows is at zero.
                return Ok((JointMotion::Held, mimic.offset.unwrap_or(0.0), Some("they mimic other joints")));
            }
            if joint.joint_type == JointType::Revolute && limit.lower > limit.upper {
                let problem =
                    format!("its range ends at {} rad, below its beginning, {} rad", limit.upper, limit.lower);
                return refuse(&problem);
            }
            if joint.joint_type == JointType::Revolute && limit.lower.is_finite() != limit.upper.is_finite() {
                return refuse("its <limit> has one side only; give `lower` and `upper`");
            }
            match joint.joint_type == JointType::Revolute && limit.lower == limit.upper {
                true => (JointMotion::Held, limit.lower, Some("their range is a single angle")),
                false => (JointMotion::Hinge, 0.0, None),
            }
        }
    })
}

/// Returns the axis of a joint.
pub(super) fn axis(joint: &Joint) -> Result<Unit<Vector3<f64>>, ModelError> {
    Unit::try_new(Vector3::from(*joint.axis.xyz), 1e-9).ok_or_else(|| {
        let label = format!("joint {}", joint.name);
        ModelError::attribute(
            &label,
            "xyz",
            "0 0 0",
            "a direction other than zero, since the joint turns about it".to_owned(),
        )
    })
}

/// Returns a pose: roll, pitch and yaw are angles about the fixed axes x, y and z, in this order.
pub(super) fn isometry(pose: &Pose) -> Isometry3<f64> {
    let ([x, y, z], [roll, pitch, yaw]) = (*pose.xyz, *pose.rpy);
    Isometry3::from_parts(Translation3::new(x, y, z), UnitQuaternion::from_euler_angles(roll, pitch, yaw))
}
