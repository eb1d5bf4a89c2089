//! Order of hinges and bodies in a file, by its names or by forward kinematics.

use nalgebra::{Point3, Quaternion, Vector3};

use super::{MotionClip, MotionError, ROOT};
use crate::model::Model;
use crate::physics::Physics;

/// Greatest distance of a body in the file from where the hinges put it (m).
const APART_MAX_M: f64 = 0.01;
/// The same where names say which body is which: files of one robot differ a little.
const OTHER_ROBOT_M: f64 = 0.05;
/// Most frames that are compared.
const COMPARED: usize = 50;

/// Poses of bodies in the world.
pub(super) struct BodyPoses {
    /// Bodies of each frame.
    pub count: usize,
    /// Positions (m), `[frame × count]`.
    pub places_m: Vec<[f64; 3]>,
    /// Quaternions w, x, y, z.
    pub turns: Vec<[f64; 4]>,
}

/// Motion whose hinges and bodies may have another order than the robot's.
pub(super) struct Unordered {
    /// Position and quaternion w, x, y, z of the root in each frame.
    pub roots: Vec<f64>,
    /// Angles of the hinges in each frame (rad).
    pub angles_rad: Vec<f64>,
    /// Hinges of each frame.
    pub hinges: usize,
    /// Their names.
    pub hinge_names: Option<Vec<String>>,
    /// Poses of the bodies.
    pub poses: Option<BodyPoses>,
    /// Their names.
    pub body_names: Option<Vec<String>>,
}

/// Motion in the robot's order, and how that was found.
pub(super) struct Ordered {
    /// Motion.
    pub motion: MotionClip,
    /// Order of the file.
    pub order: String,
}

impl Unordered {
    /// Returns the motion in the order of the robot that `physics` simulates.
    ///
    /// # Errors
    /// [`MotionError`] if the motion is of another robot.
    pub fn ordered(mut self, name: &str, rate_hz: f64, physics: &mut Physics) -> Result<Ordered, MotionError> {
        let model = physics.model().clone();
        self.turn_roots(&model);
        let robot: Vec<String> = model.hinges.iter().map(|hinge| hinge.name.clone()).collect();
        if let Some(names) = &self.hinge_names {
            let motion = self.named(name, rate_hz, names)?.in_order_of(&robot)?;
            let apart_m = self.poses.as_ref().and_then(|poses| {
                let bodies = self.body_names.as_ref()?;
                let links: Vec<Option<usize>> =
                    bodies.iter().map(|name| model.links.iter().position(|link| link.name == *name)).collect();
                Some(apart_m(&motion, poses, &links, physics))
            });
            return match apart_m {
                Some(apart_m) if apart_m > OTHER_ROBOT_M => Err(MotionError(format!(
                    "its bodies are up to {apart_m:.3} m from where this robot's hinges put them; it is a motion of another \
                     robot, or of another version of its file"
                ))),
                Some(apart_m) => Ok(Ordered { motion, order: format!("by names; bodies agree within {apart_m:.4} m") }),
                None => Ok(Ordered { motion, order: "by names".to_owned() }),
            };
        }
        if self.hinges != robot.len() {
            return Err(MotionError(format!("it has {} hinges, the robot has {}", self.hinges, robot.len())));
        }
        let depth_first: Vec<usize> = (0..robot.len()).collect();
        let orders =
            [("depth first, as in MuJoCo", depth_first), ("breadth first, as in Isaac Lab", breadth_first(&model))];
        let Some(poses) = &self.poses else {
            let motion = self.named(name, rate_hz, &robot)?;
            return Ok(Ordered { motion, order: "taken as that of the robot: the file says nothing of it".to_owned() });
        };
        let mut found = Vec::new();
        for (label, hinges) in orders {
            let names: Vec<String> = hinges.iter().map(|hinge| robot[*hinge].clone()).collect();
            let motion = self.named(name, rate_hz, &names)?.in_order_of(&robot)?;
            let links = links_in_order(&model, poses.count, label.starts_with("breadth"));
            let apart_m = links.map(|links| apart_m(&motion, poses, &links, physics));
            found.push((label, motion, apart_m));
        }
        if found.iter().all(|(_, _, apart_m)| apart_m.is_none()) {
            let (label, motion, _) = found.swap_remove(0);
            let (bodies, links) = (poses.count, model.links.len());
            let order =
                format!("taken as {label}: it has {bodies} bodies, the robot {links}, so they cannot be compared");
            return Ok(Ordered { motion, order });
        }
        let distance = |apart_m: &Option<f64>| apart_m.unwrap_or(f64::INFINITY);
        let distances: Vec<String> =
            found.iter().map(|(label, _, apart_m)| format!("{:.3} m if they are {label}", distance(apart_m))).collect();
        found.sort_by(|one, other| distance(&one.2).total_cmp(&distance(&other.2)));
        let (label, motion, apart_m) = found.swap_remove(0);
        let apart_m = distance(&apart_m);
        if apart_m > APART_MAX_M {
            return Err(MotionError(format!(
                "its bodies are not where this robot's hinges put them: {}; it is a motion of another robot, or in an order \
                 that is unknown",
                distances.join(", ")
            )));
        }
        Ok(Ordered { motion, order: format!("{label}; bodies agree within {apart_m:.4} m") })
    }

    /// Turns the root from the base of the file to that of the robot, whose x axis points forward.
    fn turn_roots(&mut self, model: &Model) {
        let Some(robot) = &model.robot else { return };
        for root in self.roots.chunks_exact_mut(ROOT) {
            let [w, x, y, z] = [root[3], root[4], root[5], root[6]];
            let turned = Quaternion::new(w, x, y, z) * robot.forward.turn().into_inner();
            root[3..].copy_from_slice(&[turned.w, turned.i, turned.j, turned.k]);
        }
    }

    fn named(&self, name: &str, rate_hz: f64, hinges: &[String]) -> Result<MotionClip, MotionError> {
        let frames = self.roots.chunks_exact(ROOT).zip(self.angles_rad.chunks_exact(self.hinges.max(1)));
        let frames = frames.flat_map(|(root, angles)| root.iter().chain(angles)).map(|number| *number as f32);
        MotionClip::new(name, rate_hz, hinges.to_vec(), frames.collect())
    }
}

/// Returns the robot's hinges breadth first: those of the bodies at each depth, in the order of the text.
fn breadth_first(model: &Model) -> Vec<usize> {
    bodies_breadth_first(model).into_iter().flat_map(|body| model.bodies[body].hinges.clone()).collect()
}

fn bodies_breadth_first(model: &Model) -> Vec<usize> {
    let mut order: Vec<usize> = (0..model.bodies.len()).collect();
    order.sort_by_key(|body| model.upward(*body).count());
    order
}

/// Returns the link of each body of a file that has so many: all links, or those that hinges move.
fn links_in_order(model: &Model, count: usize, is_breadth_first: bool) -> Option<Vec<Option<usize>>> {
    if count == model.bodies.len() {
        let bodies = if is_breadth_first { bodies_breadth_first(model) } else { (0..count).collect() };
        let first = |body: usize| model.links.iter().position(|link| link.body == body);
        return Some(bodies.into_iter().map(first).collect());
    }
    (count == model.links.len() && !is_breadth_first).then(|| (0..count).map(Some).collect())
}

/// Returns the greatest distance of a link from where the file has it (m).
fn apart_m(motion: &MotionClip, poses: &BodyPoses, links: &[Option<usize>], physics: &mut Physics) -> f64 {
    let rest = vec![0.0; physics.model().velocity_size()];
    let every = motion.len().div_ceil(COMPARED);
    let mut largest_m = 0.0_f64;
    for (number, frame) in motion.frames().enumerate().step_by(every) {
        let position: Vec<f64> = frame.iter().map(|entry| f64::from(*entry)).collect();
        physics.set_state(&position, &rest);
        for (body, link) in links.iter().enumerate() {
            let Some(link) = link else { continue };
            let place = Point3::from(physics.link_pose(*link).translation.vector);
            let found = Point3::from(Vector3::from(poses.places_m[number * poses.count + body]));
            largest_m = largest_m.max((place - found).norm());
        }
    }
    largest_m
}
