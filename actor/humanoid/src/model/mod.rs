//! Robot as data: bodies, hinges and motors, independent of texts and of the physics engine.
//!
//! [`crate::mjcf`] reads a model from text, [`crate::card`] edits it, and [`crate::physics`] builds a world from it.
//! Lengths are metres, angles radians, masses kilograms.

mod equality;
mod geometry;
mod ground;
pub(crate) mod hull;
pub(crate) mod inertia;
pub mod mirror;
pub(crate) mod moments;
mod motion;
mod pair;
mod quantity;
mod robot;
mod softness;
mod turn;

use std::ops::Range;
use std::sync::Arc;

use nalgebra::{Isometry3, Matrix3, Point3, Unit, Vector3};

pub use self::equality::{Connection, Coupling};
pub use self::geometry::Geometry;
pub use self::ground::{Ground, HEIGHT_FIELD_SIDE_MAX, HeightField};
pub use self::motion::{MotionClip, MotionError};
pub use self::pair::{Pair, ShapeIndex};
pub(crate) use self::quantity::{length, not_negative};
pub(crate) use self::robot::counterpart;
pub use self::robot::{HingeControl, Robot};
pub use self::softness::Softness;
pub(crate) use self::softness::SolverNumbers;
pub use self::turn::BaseAxis;

/// Most tendons; a bound because every step's info holds their lengths without allocating.
pub const TENDONS_MAX: usize = 16;

/// Method that solves for the forces of contacts, limits and friction, as named by MJCF's `<option solver>`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Solver {
    /// Newton's method, MuJoCo's default; also for `CG`, which has the same solution.
    #[default]
    Newton,
    /// Projected Gauss-Seidel sweeps, `PGS`: faster where few constraints act.
    GaussSeidel,
}

/// Tree of rigid bodies on a floating root, moved by motors at its hinges.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// Bodies, parents before children; the first one is the floating root.
    pub bodies: Vec<Body>,
    /// Hinges in the order of the position vector: that of the text, body by body.
    pub hinges: Vec<Hinge>,
    /// Motors in action order.
    pub motors: Vec<Motor>,
    /// Moving MJCF bodies in the order of the text; those that are welded together share one of `bodies`.
    pub links: Vec<Link>,
    /// Fixed tendons, in the order of the text; at most [`TENDONS_MAX`].
    pub tendons: Vec<Tendon>,
    /// Hinges that follow others, in the order of the text.
    pub couplings: Vec<Coupling>,
    /// Points that stay together, in the order of the text.
    pub connections: Vec<Connection>,
    /// Every two shapes that may touch: those with the ground first, each kind in the order of the bodies and shapes.
    pub pairs: Vec<Pair>,
    /// Ground.
    pub ground: Ground,
    /// Free joint of the root.
    pub root: RootJoint,
    /// Keyframes, in the order of the text.
    pub keyframes: Vec<Keyframe>,
    /// Acceleration of gravity (m/s²), world frame.
    pub gravity_mps2: Vector3<f64>,
    /// Solver of constraints.
    pub solver: Solver,
    /// What the robot's card says, if the text has one.
    pub robot: Option<Robot>,
    /// Motions to imitate, if the text has some.
    pub motions: Arc<[MotionClip]>,
    /// What is simulated more simply than the text says.
    pub simplifications: Vec<String>,
}

/// Rigid body: an MJCF body with joints, and all bodies without joints that are welded to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Name in the text.
    pub name: String,
    /// Index of the parent body; `None` for the root.
    pub parent: Option<usize>,
    /// Pose in the parent's frame (root: in the world) with all hinges at zero.
    pub pose: Isometry3<f64>,
    /// Hinges between the parent and this body, from the parent on.
    pub hinges: Range<usize>,
    /// Collision shapes, in this body's frame.
    pub shapes: Vec<Shape>,
    /// Mass (kg).
    pub mass_kg: f64,
    /// Centre of mass in this body's frame (m).
    pub centre_of_mass_m: Point3<f64>,
    /// Inertia about the centre of mass, in this body's axes (kg·m²).
    pub inertia_kgm2: Matrix3<f64>,
    /// Share of its weight that a force at the centre of mass holds up: MJCF's `gravcomp`.
    pub gravity_compensation: f64,
}

/// An MJCF body, or a link in terms of URDF: a rigid body of its own, or a welded part of one.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Name in the text.
    pub name: String,
    /// Index of its rigid body in [`Model::bodies`].
    pub body: usize,
    /// Pose of its frame in the rigid body's frame (m).
    pub pose: Isometry3<f64>,
    /// Indices of its shapes in [`Body::shapes`].
    pub shapes: Range<usize>,
    /// Mass (kg); may be 0 for a welded part.
    pub mass_kg: f64,
    /// Centre of mass in the rigid body's frame (m); the origin of its own frame if it has no mass.
    pub centre_of_mass_m: Point3<f64>,
    /// Inertia about its centre of mass, in the rigid body's axes (kg·m²).
    pub inertia_kgm2: Matrix3<f64>,
}

/// Fixed tendon: a weighted sum of hinge angles, which it may limit.
#[derive(Clone, Debug, PartialEq)]
pub struct Tendon {
    /// Name in the text.
    pub name: String,
    /// Indices into [`Model::hinges`], with weights.
    pub terms: Vec<(usize, f64)>,
    /// Smallest and largest length; `None` without limits.
    pub range: Option<[f64; 2]>,
    /// Softness of the limits.
    pub limit_softness: Softness,
    /// Distance before a limit from which it pushes, in units of length.
    pub limit_margin: f64,
}

impl Tendon {
    /// Returns the tendon's length for the angles, or its velocity for the rates, of all hinges: Σ weight × entry.
    #[must_use]
    pub fn sum_over(&self, hinges: &[f64]) -> f64 {
        self.terms.iter().map(|&(hinge, weight)| weight * hinges[hinge]).sum()
    }
}

/// Collision shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Name in the text.
    pub name: String,
    /// Geometry in its body's frame.
    pub geometry: Geometry,
    /// Friction coefficient of its own; contacts have that of their [`Pair`].
    pub friction: f64,
    /// Distance (m) below which contacts push; the margins of a pair add up.
    pub margin_m: f64,
}

/// Free joint of the root: forces that act alike on each of its six degrees of freedom.
///
/// These are the root's velocity along the world's axes (m, N, kg) and its rate about its own axes (rad, N·m, kg·m²).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RootJoint {
    /// Viscous friction (N·s/m and N·m·s/rad).
    pub damping: f64,
    /// Greatest force of dry friction (N and N·m).
    pub friction_loss: f64,
    /// Softness of the dry friction.
    pub friction_softness: Softness,
    /// Additional inertia (kg and kg·m²).
    pub armature: f64,
}

/// One hinge of the chain between a body and its parent.
#[derive(Clone, Debug, PartialEq)]
pub struct Hinge {
    /// Name in the text.
    pub name: String,
    /// Axis in the frame of the moved body, with all hinges at zero.
    pub axis: Unit<Vector3<f64>>,
    /// Point on the axis, in the frame of the moved body (m).
    pub anchor_m: Point3<f64>,
    /// Smallest allowed angle (rad); −∞ without a limit.
    pub min_rad: f64,
    /// Largest allowed angle (rad); +∞ without a limit.
    pub max_rad: f64,
    /// Angle in the pose of the text (rad).
    pub nominal_rad: f64,
    /// Stiffness of the spring towards `rest_rad` (N·m/rad).
    pub stiffness_nmprad: f64,
    /// Further coefficients of the spring: of the square (N·m/rad²) and the cube (N·m/rad³) of the deflection.
    pub stiffness_powers: [f64; 2],
    /// Rest angle of the spring (rad).
    pub rest_rad: f64,
    /// Viscous friction (N·m·s/rad).
    pub damping_nmsprad: f64,
    /// Further coefficients of the viscous friction: of rate × |rate| (N·m·s²/rad²) and rate³ (N·m·s³/rad³).
    pub damping_powers: [f64; 2],
    /// Rotor inertia, as seen at the hinge (kg·m²).
    pub armature_kgm2: f64,
    /// Greatest torque of dry friction (N·m).
    pub friction_loss_nm: f64,
    /// Softness of the dry friction.
    pub friction_softness: Softness,
    /// Softness of the limits.
    pub limit_softness: Softness,
    /// Angle before a limit from which it pushes (rad).
    pub limit_margin_rad: f64,
    /// Smallest and largest total torque of its motors (N·m); infinite without limits.
    pub torque_nm: [f64; 2],
}

impl Hinge {
    /// Returns the middle of the range (rad); 0 without limits.
    #[must_use]
    pub fn centre_rad(&self) -> f64 {
        let centre = f64::midpoint(self.min_rad, self.max_rad);
        if centre.is_finite() { centre } else { 0.0 }
    }

    /// Returns the distance of an angle (rad) from the range; 0 inside.
    #[must_use]
    pub fn overshoot_rad(&self, angle_rad: f64) -> f64 {
        (self.min_rad - angle_rad).max(angle_rad - self.max_rad).max(0.0)
    }
}

/// Motor or servo: torque = gear × force, force = gain × control + bias · (1, length, velocity).
///
/// Length and velocity are angle and rate of the hinge times [`Motor::length_per_rad`]. A plain motor has gain 1 and no
/// bias.
#[derive(Clone, Debug, PartialEq)]
pub struct Motor {
    /// Name in the text.
    pub name: String,
    /// Index of its hinge in [`Model::hinges`].
    pub hinge: usize,
    /// Torque per unit of force (N·m).
    pub gear_nm: f64,
    /// Length that a servo measures per angle of the hinge: the text's gear, which randomised motor strength does not scale.
    pub length_per_rad: f64,
    /// Smallest and largest control; other values are clamped.
    pub control: [f64; 2],
    /// Force per unit of control.
    pub gain: f64,
    /// Constant force, force per length and force per velocity.
    pub bias: [f64; 3],
    /// Smallest and largest force; infinite without limits.
    pub force: [f64; 2],
}

impl Motor {
    /// Returns the angle (rad) at which a servo with this control rests without a load; `None` for a motor that is no servo.
    #[must_use]
    pub fn target_rad(&self, control: f64) -> Option<f64> {
        let [constant, per_length, _] = self.bias;
        let force = self.gain * control.clamp(self.control[0], self.control[1]) + constant;
        (per_length != 0.0).then(|| -force / (per_length * self.length_per_rad))
    }
}

/// State and controls under a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Keyframe {
    /// Name in the text.
    pub name: String,
    /// Position vector; the root's quaternion has length 1. Without `qpos` that of the text's pose.
    pub position: Vec<f64>,
    /// Velocity vector; without `qvel` 0.
    pub velocity: Vec<f64>,
    /// One control per motor, as in the text; without `ctrl` 0.
    pub controls: Vec<f64>,
}

impl Model {
    /// Returns the index in [`Model::links`] of the link that a shape of a rigid body belongs to.
    #[must_use]
    pub fn link_of_shape(&self, body: usize, shape: usize) -> Option<usize> {
        self.links.iter().position(|link| link.body == body && link.shapes.contains(&shape))
    }

    /// Returns the rigid body that a hinge moves.
    #[must_use]
    pub fn body_of_hinge(&self, hinge: usize) -> usize {
        self.bodies.iter().position(|body| body.hinges.contains(&hinge)).unwrap_or_default()
    }

    /// Returns a rigid body and those that it hangs on, up to the root.
    pub fn upward(&self, body: usize) -> impl Iterator<Item = usize> + '_ {
        std::iter::successors(Some(body), |body| self.bodies[*body].parent)
    }

    /// Returns the mass of the whole robot (kg).
    #[must_use]
    pub fn mass_kg(&self) -> f64 {
        self.bodies.iter().map(|body| body.mass_kg).sum()
    }

    /// Returns the length of the position vector: 3 for the root's position, 4 for its quaternion, 1 per hinge.
    #[must_use]
    pub fn position_size(&self) -> usize {
        7 + self.hinges.len()
    }

    /// Returns the length of the velocity vector: 6 for the root, 1 per hinge.
    #[must_use]
    pub fn velocity_size(&self) -> usize {
        6 + self.hinges.len()
    }

    /// Returns the position vector of the text's pose, with all hinges at zero.
    #[must_use]
    pub fn nominal_position(&self) -> Vec<f64> {
        let root = &self.bodies[0].pose;
        let quaternion = root.rotation.quaternion();
        let mut position = vec![0.0; self.position_size()];
        position[..3].copy_from_slice(root.translation.vector.as_slice());
        position[3..7].copy_from_slice(&[quaternion.w, quaternion.i, quaternion.j, quaternion.k]);
        position[7..].iter_mut().zip(&self.hinges).for_each(|(angle_rad, hinge)| *angle_rad = hinge.nominal_rad);
        position
    }

    /// Returns the greatest torque that a hinge and its first motor allow (N·m); `None` if it is not limited.
    #[must_use]
    pub fn effort_nm(&self, hinge: usize) -> Option<f64> {
        let greatest = |[low, high]: [f64; 2]| low.abs().max(high.abs());
        let motor = self.motors.iter().find(|motor| motor.hinge == hinge);
        let of_motor = motor.map_or(f64::INFINITY, |motor| {
            let by_force = greatest(motor.force);
            // The control of a plain motor is its force.
            let by_control =
                if motor.bias == [0.0; 3] { greatest(motor.control) * motor.gain.abs() } else { f64::INFINITY };
            by_force.min(by_control) * motor.gear_nm.abs()
        });
        Some(greatest(self.hinges[hinge].torque_nm).min(of_motor)).filter(|effort_nm| effort_nm.is_finite())
    }
}
