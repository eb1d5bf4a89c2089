//! The robot as data: bodies, hinge chains and motors, free of any physics engine.
//!
//! [`Model::from_mjcf`] reads the text; [`crate::physics`] builds a world from the result.
//! Lengths are metres, angles radians, masses kilograms.

mod collision;
mod defaults;
mod file;
mod flatten;
mod geoms;
mod inertia;
mod joints;
mod mass;
pub mod mirror;
mod mjcf;
mod motors;
mod tendon;
mod vocabulary;
mod xml;

use std::ops::Range;

use nalgebra::{Isometry3, Matrix3, Point3, Unit, Vector3};

pub(crate) use self::collision::FLOOR_GROUP;
pub use self::file::read_model_file;
pub use self::tendon::TENDONS_MAX;
pub use self::xml::MODEL_BYTES_MAX;
use crate::error::ModelError;

/// The humanoid of this project, as MJCF text: 17 hinges, about 42 kg, the figures of Humanoid-v5.
pub const HUMANOID_XML: &str = include_str!("../../assets/humanoid.xml");

/// A tree of rigid bodies on a floating root, moved by motors at its hinges.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// Bodies, parents before children; the first one is the floating root.
    pub bodies: Vec<Body>,
    /// Hinges in position order: as they stand in the text, body by body.
    pub hinges: Vec<Hinge>,
    /// Motors in action order.
    pub motors: Vec<Motor>,
    /// The bodies as they stand in the text, in its order and without the world and what stands still; those that are
    /// welded together share one of `bodies`.
    pub links: Vec<Link>,
    /// Fixed tendons, in the order of the text; at most [`TENDONS_MAX`].
    pub tendons: Vec<Tendon>,
    /// For each [`Shape::group`], bits of the groups that its shapes may touch; the highest bit is the floor.
    pub touches: Vec<u32>,
    /// Friction coefficient of the floor; the greater one of two shapes counts.
    pub floor_friction: f64,
    /// Distance (m) from which on the floor pushes; those of two shapes add up.
    pub floor_margin_m: f64,
    /// Acceleration of gravity (m/s²), world frame.
    pub gravity_mps2: Vector3<f64>,
}

/// One rigid body; parts welded to it in the text are merged into it.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Name in the text.
    pub name: String,
    /// Index of the body it hangs on; `None` for the root.
    pub parent: Option<usize>,
    /// Pose in the parent's frame (root: in the world) with all hinges at zero.
    pub pose: Isometry3<f64>,
    /// Where all hinges to the parent sit, in this body's frame (m).
    pub anchor_m: Point3<f64>,
    /// Which hinges join it to its parent, in chain order, parent's side first.
    pub hinges: Range<usize>,
    /// Collision shapes, in this body's frame.
    pub shapes: Vec<Shape>,
    /// Mass (kg).
    pub mass_kg: f64,
    /// Centre of mass in this body's frame (m).
    pub centre_of_mass_m: Point3<f64>,
    /// Inertia about the centre of mass, in this body's axes (kg·m²).
    pub inertia_kgm2: Matrix3<f64>,
}

/// A body of the text: a rigid body of its own, or a welded part of one.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Name in the text.
    pub name: String,
    /// Which rigid body it is part of: an index into [`Model::bodies`].
    pub body: usize,
    /// Pose of its frame in the rigid body's frame (m).
    pub pose: Isometry3<f64>,
    /// Which of the rigid body's shapes are its own.
    pub shapes: Range<usize>,
    /// Mass (kg); 0 for a part without shapes.
    pub mass_kg: f64,
    /// Centre of mass in the rigid body's frame (m); the origin of its own frame if it weighs nothing.
    pub centre_of_mass_m: Point3<f64>,
    /// Inertia about its centre of mass, in the rigid body's axes (kg·m²).
    pub inertia_kgm2: Matrix3<f64>,
}

/// A fixed tendon: a weighted sum of hinge angles. It exerts no force.
#[derive(Clone, Debug, PartialEq)]
pub struct Tendon {
    /// Name in the text.
    pub name: String,
    /// Hinges, as indices into [`Model::hinges`], with their weights.
    pub terms: Vec<(usize, f64)>,
}

impl Tendon {
    /// Length or velocity of the tendon: Σ weight × angle or rate, one for each hinge of the model.
    #[must_use]
    pub fn sum_over(&self, hinges: &[f64]) -> f64 {
        self.terms.iter().map(|&(hinge, weight)| weight * hinges[hinge]).sum()
    }
}

/// A collision shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Name in the text.
    pub name: String,
    /// Form and place, in its body's frame.
    pub geometry: Geometry,
    /// Friction coefficient; between two shapes the greater one counts, if at least one of them rubs.
    pub friction: f64,
    /// Whether contacts with it resist sliding by themselves (MJCF's `condim` 3) or not (1).
    pub rubs: bool,
    /// Distance (m) from which on it pushes what comes near; those of two shapes add up.
    pub margin_m: f64,
    /// Bits that say what it is: it touches what has affinity to one of them.
    pub contype: u32,
    /// Bits of what it has affinity to.
    pub conaffinity: u32,
    /// Group of shapes to which the same rules of collision apply: an index into [`Model::touches`].
    pub group: usize,
}

/// Form and place of a shape; lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Geometry {
    /// A ball.
    Sphere {
        /// Its centre.
        centre_m: Point3<f64>,
        /// Its radius.
        radius_m: f64,
    },
    /// All points within a radius of a line.
    Capsule {
        /// One end of the line.
        from_m: Point3<f64>,
        /// The other end.
        to_m: Point3<f64>,
        /// The radius.
        radius_m: f64,
    },
    /// A cylinder along the z axis of its pose.
    Cylinder {
        /// Centre and orientation.
        pose: Isometry3<f64>,
        /// Its radius.
        radius_m: f64,
        /// From the centre to either end.
        half_length_m: f64,
    },
    /// A box.
    Box {
        /// Centre and orientation.
        pose: Isometry3<f64>,
        /// From the centre to the sides.
        half_m: Vector3<f64>,
    },
    /// An ellipsoid; it has mass, but cannot collide.
    Ellipsoid {
        /// Centre and orientation.
        pose: Isometry3<f64>,
        /// Semi-axes.
        half_m: Vector3<f64>,
    },
}

impl Geometry {
    /// Its middle, in its body's frame (m).
    #[must_use]
    pub fn centre_m(&self) -> Point3<f64> {
        match self {
            Self::Sphere { centre_m, .. } => *centre_m,
            Self::Capsule { from_m, to_m, .. } => nalgebra::center(from_m, to_m),
            Self::Cylinder { pose, .. } | Self::Box { pose, .. } | Self::Ellipsoid { pose, .. } => {
                Point3::from(pose.translation.vector)
            }
        }
    }
}

/// One hinge of a chain between a body and its parent.
#[derive(Clone, Debug, PartialEq)]
pub struct Hinge {
    /// Name in the text.
    pub name: String,
    /// Axis in the frame of the body that it moves, with all hinges at zero.
    pub axis: Unit<Vector3<f64>>,
    /// Smallest allowed angle (rad); −∞ without a limit.
    pub min_rad: f64,
    /// Largest allowed angle (rad); +∞ without a limit.
    pub max_rad: f64,
    /// Spring towards `rest_rad` (N·m/rad).
    pub stiffness_nmprad: f64,
    /// Angle at which the spring is slack (rad).
    pub rest_rad: f64,
    /// Viscous friction (N·m·s/rad).
    pub damping_nmsprad: f64,
    /// Inertia of the motor's rotor, seen at the hinge (kg·m²).
    pub armature_kgm2: f64,
    /// Least and greatest torque of all its motors together (N·m); infinite without limits.
    pub torque_nm: [f64; 2],
}

impl Hinge {
    /// Middle of the allowed range (rad); 0 without a limit.
    #[must_use]
    pub fn centre_rad(&self) -> f64 {
        let centre = f64::midpoint(self.min_rad, self.max_rad);
        if centre.is_finite() { centre } else { 0.0 }
    }

    /// How far an angle (rad) lies outside the allowed range, 0 inside.
    #[must_use]
    pub fn overshoot_rad(&self, angle_rad: f64) -> f64 {
        (self.min_rad - angle_rad).max(angle_rad - self.max_rad).max(0.0)
    }
}

/// A motor or a servo: torque = gear × force, where force = gain × control + bias · (1, length, velocity), and length
/// and velocity are those of the hinge times [`Motor::length_per_rad`]. A plain motor has gain 1 and no bias.
#[derive(Clone, Debug, PartialEq)]
pub struct Motor {
    /// Name in the text.
    pub name: String,
    /// Which hinge it turns: an index into [`Model::hinges`].
    pub hinge: usize,
    /// Torque per unit of force (N·m).
    pub gear_nm: f64,
    /// What a servo measures per angle of the hinge: the gear again, also where a motor is stronger or weaker than it.
    pub length_per_rad: f64,
    /// Least and greatest control; others are clamped.
    pub control: [f64; 2],
    /// Force per unit of control.
    pub gain: f64,
    /// Force, force per length and force per velocity.
    pub bias: [f64; 3],
    /// Least and greatest force; infinite without limits.
    pub force: [f64; 2],
}

impl Model {
    /// Reads a model from MJCF text.
    ///
    /// docs/guide/robots.md lists what is accepted. All other MJCF is refused by name, unless no motion depends
    /// on it. Files are never opened: [`read_model_file`] makes one text of a file and those that it includes.
    ///
    /// # Errors
    /// [`ModelError`] names the first element that cannot be simulated.
    pub fn from_mjcf(text: &str) -> Result<Self, ModelError> {
        mjcf::read(text)
    }

    /// The first part that is not the same in another model.
    pub(crate) fn difference(&self, other: &Self) -> Option<String> {
        fn among<T: PartialEq>(kind: &str, ours: &[T], theirs: &[T], name: fn(&T) -> &str) -> Option<String> {
            if ours.len() != theirs.len() {
                return Some(format!("{kind} count ({} and {})", ours.len(), theirs.len()));
            }
            ours.iter().zip(theirs).find(|(one, other)| one != other).map(|(one, _)| format!("{kind} `{}`", name(one)))
        }
        among("body part", &self.links, &other.links, |link| &link.name)
            .or_else(|| among("rigid body", &self.bodies, &other.bodies, |body| &body.name))
            .or_else(|| among("hinge", &self.hinges, &other.hinges, |hinge| &hinge.name))
            .or_else(|| among("motor", &self.motors, &other.motors, |motor| &motor.name))
            .or_else(|| among("tendon", &self.tendons, &other.tendons, |tendon| &tendon.name))
            .or_else(|| (self != other).then(|| "the floor, gravity or who touches whom".to_owned()))
    }

    /// Which link a shape of a rigid body belongs to.
    #[must_use]
    pub fn link_of_shape(&self, body: usize, shape: usize) -> Option<usize> {
        self.links.iter().position(|link| link.body == body && link.shapes.contains(&shape))
    }

    /// Mass of the whole robot (kg).
    #[must_use]
    pub fn mass_kg(&self) -> f64 {
        self.bodies.iter().map(|body| body.mass_kg).sum()
    }

    /// Length of the position vector: 3 for the root's position, 4 for its quaternion, 1 per hinge.
    #[must_use]
    pub fn position_size(&self) -> usize {
        7 + self.hinges.len()
    }

    /// Length of the velocity vector: 6 for the root, 1 per hinge.
    #[must_use]
    pub fn velocity_size(&self) -> usize {
        6 + self.hinges.len()
    }

    /// Position vector of the pose in which the text describes the robot: all hinges at zero.
    #[must_use]
    pub fn nominal_position(&self) -> Vec<f64> {
        let root = &self.bodies[0].pose;
        let quaternion = root.rotation.quaternion();
        let mut position = vec![0.0; self.position_size()];
        position[..3].copy_from_slice(root.translation.vector.as_slice());
        position[3..7].copy_from_slice(&[quaternion.w, quaternion.i, quaternion.j, quaternion.k]);
        position
    }
}
