//! The robot as data: bodies, hinge chains and motors, free of any physics engine.
//!
//! [`Model::from_mjcf`] reads the text; [`crate::physics`] builds a world from the result.
//! Lengths are metres, angles radians, masses kilograms.

mod inertia;
mod mjcf;
mod tendon;

use std::ops::Range;

use nalgebra::{Isometry3, Matrix3, Point3, Unit, UnitQuaternion, Vector3};

pub use self::tendon::TENDONS_MAX;
use crate::error::ModelError;

/// The humanoid of this project, as MJCF text: 17 hinges, about 42 kg, the figures of Humanoid-v5.
pub const HUMANOID_XML: &str = include_str!("../../assets/humanoid.xml");

/// A tree of rigid bodies on a floating root, moved by motors at its hinges.
#[derive(Clone, Debug)]
pub struct Model {
    /// Bodies, parents before children; the first one is the floating root.
    pub bodies: Vec<Body>,
    /// Hinges in position order: as they stand in the text, body by body.
    pub hinges: Vec<Hinge>,
    /// Motors in action order.
    pub motors: Vec<Motor>,
    /// The bodies as they stand in the text, in its order and without the world; those that are welded together
    /// share one of `bodies`.
    pub links: Vec<Link>,
    /// Fixed tendons, in the order of the text; at most [`TENDONS_MAX`].
    pub tendons: Vec<Tendon>,
    /// Every motor's control is clamped to ± this.
    pub control_limit: f64,
    /// Friction coefficient between the body and the floor.
    pub floor_friction: f64,
    /// Acceleration of gravity (m/s²), world frame.
    pub gravity_mps2: Vector3<f64>,
}

/// One rigid body; parts welded to it in the text are merged into it.
#[derive(Clone, Debug)]
pub struct Body {
    /// Name in the text.
    pub name: String,
    /// Index of the body it hangs on; `None` for the root.
    pub parent: Option<usize>,
    /// Pose in the parent's frame (root: in the world) with all hinges at zero.
    pub pose: Isometry3<f64>,
    /// Where all hinges to the parent sit, in this body's frame (m).
    pub anchor_m: Point3<f64>,
    /// Which hinges join it to its parent, in chain order, parent's side first; at most 3.
    pub hinges: Range<usize>,
    /// Orthonormal triad in this body's frame; its first columns are the hinge axes (the third up to its sign).
    pub hinge_frame: UnitQuaternion<f64>,
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
#[derive(Clone, Debug)]
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
#[derive(Clone, Debug)]
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

/// A collision shape, in its body's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// One end of the capsule's axis (m).
    pub from_m: Point3<f64>,
    /// Other end of the capsule's axis (m); equal to `from_m` for a sphere.
    pub to_m: Point3<f64>,
    /// Radius (m).
    pub radius_m: f64,
    /// Density (kg/m³).
    pub density_kgpm3: f64,
}

impl Shape {
    /// Whether the shape is a sphere and not a capsule.
    #[must_use]
    pub fn is_sphere(&self) -> bool {
        self.from_m == self.to_m
    }
}

/// One hinge of a chain between a body and its parent.
#[derive(Clone, Debug)]
pub struct Hinge {
    /// Name in the text.
    pub name: String,
    /// Axis in the frame of the body that it moves, with all hinges at zero.
    pub axis: Unit<Vector3<f64>>,
    /// +1, or −1 where the axis is opposite to its column of the body's [`Body::hinge_frame`].
    pub frame_sign: f64,
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

/// A motor: torque = gear × control.
#[derive(Clone, Debug)]
pub struct Motor {
    /// Name in the text.
    pub name: String,
    /// Which hinge it turns: an index into [`Model::hinges`].
    pub hinge: usize,
    /// Torque at control 1 (N·m).
    pub gear_nm: f64,
}

impl Model {
    /// Reads a model from MJCF text.
    ///
    /// Accepted: one tree on a free joint; hinges (at most three to a body, at one point, perpendicular in order);
    /// spheres and capsules; motors with one common symmetric control range; fixed tendons that exert no force;
    /// a floor at z = 0.
    /// Files are never opened: a text with `<include>` is refused.
    ///
    /// # Errors
    /// [`ModelError`] names the first element that cannot be simulated.
    pub fn from_mjcf(text: &str) -> Result<Self, ModelError> {
        mjcf::read(text)
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
