//! Joints: the root's free joint, and hinges.

use nalgebra::{Isometry3, Point3, Unit, UnitQuaternion, Vector3};

use super::element::Element;
use super::pose::Pose;
use super::tree::{BodyNode, Compiler};
use crate::articulation::Structure;
use crate::error::ModelError;
use crate::model::{Hinge, Model, RootJoint, not_negative};

/// Attributes for the softness of dry friction.
const FRICTION: [&str; 2] = ["solreffriction", "solimpfriction"];
const UNLIMITED: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// Returns whether a joint leaves all six degrees of freedom.
pub(super) fn is_free(joint: &Element) -> bool {
    joint.tag == "freejoint" || joint.get("type") == Some("free")
}

/// Returns whether a body moves freely by three slides along x, y and z and a ball joint, on which nothing else acts.
pub(super) fn are_free(body: &BodyNode) -> bool {
    let at_rest = |joint: &Element| {
        let is_zero = |name: &&str| joint.list(name).is_none_or(|all| all.iter().all(|number| *number == 0.0));
        let unmoved =
            ["pos", "ref", "stiffness", "damping", "armature", "frictionloss", "springdamper"].iter().all(is_zero);
        unmoved && !joint.is_true("limited", false) && joint.list("range").is_none()
    };
    let is = |joint: &Element, kind: &str| joint.get("type") == Some(kind);
    let along = |(joint, axis): (&(Element, Pose), [f64; 3])| {
        is(&joint.0, "slide") && joint.0.list_over("axis", [0.0, 0.0, 1.0]) == axis
    };
    let [slides @ .., ball] = &body.joints[..] else { return false };
    slides.len() == 3
        && slides.iter().zip([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]).all(along)
        && is(&ball.0, "ball")
        && body.joints.iter().all(|(joint, frame)| at_rest(joint) && frame.isometry() == Isometry3::identity())
        && body.pose.isometry().rotation == UnitQuaternion::identity()
}

/// Reads the root's free joint, which must have no spring.
pub(super) fn read_free(joint: &Element) -> Result<RootJoint, ModelError> {
    let stiffness = joint.list_over("stiffness", [0.0; 3]);
    if stiffness != [0.0; 3] {
        return Err(joint.refused("the stiffness of a free joint must be 0: springs of the root are not simulated"));
    }
    if powers(joint, "damping") != [0.0; 2] {
        return Err(
            joint.refused("the damping of a free joint must be one number: its square and cube are not simulated")
        );
    }
    if joint.list("springdamper").is_some_and(|both| both.iter().all(|number| *number > 0.0)) {
        return Err(joint.refused("a free joint may have no `springdamper`: springs of the root are not simulated"));
    }
    Ok(RootJoint {
        damping: joint.amount("damping", "damping of a free joint")?,
        friction_loss: joint.amount("frictionloss", "frictionloss of a free joint")?,
        friction_softness: joint.softness(FRICTION)?.softness(),
        armature: joint.amount("armature", "armature of a free joint")?,
    })
}

/// Reads a hinge; `frame` is the pose of the frames around it.
pub(super) fn read_hinge(joint: &Element, frame: &Pose, compiler: &Compiler) -> Result<Hinge, ModelError> {
    if is_free(joint) {
        return Err(joint.refused("only the root may have a free joint"));
    }
    if let Some(kind) = joint.get("type").filter(|kind| *kind != "hinge") {
        return Err(joint.refused(format!("joints must be hinges, not of type {kind}")));
    }
    let axis = Vector3::from(joint.list_over("axis", [0.0, 0.0, 1.0]));
    let axis = Unit::try_new(axis, 1e-6).ok_or_else(|| joint.refused("the axis must not be zero"))?;
    let frame = frame.isometry();
    let range = joint.range("range", "limited", compiler.autolimits)?;
    let [min_rad, max_rad] = range.map_or(UNLIMITED, |range| range.map(|angle| compiler.angles.radians(angle)));
    let torque_nm = joint.range("actuatorfrcrange", "actuatorfrclimited", compiler.autolimits)?;
    Ok(Hinge {
        axis: frame.rotation * axis,
        anchor_m: frame * Point3::from(joint.list_over("pos", [0.0; 3])),
        min_rad,
        max_rad,
        stiffness_nmprad: joint.amount("stiffness", "stiffness (N·m/rad)")?,
        stiffness_powers: powers(joint, "stiffness"),
        nominal_rad: compiler.angles.radians(joint.number("ref").unwrap_or(0.0)),
        rest_rad: compiler.angles.radians(joint.number("springref").unwrap_or(0.0)),
        damping_nmsprad: joint.amount("damping", "damping (N·m·s/rad)")?,
        damping_powers: damping_powers(joint)?,
        armature_kgm2: joint.amount("armature", "armature (kg·m²)")?,
        friction_loss_nm: joint.amount("frictionloss", "frictionloss (N·m)")?,
        friction_softness: joint.softness(FRICTION)?.softness(),
        limit_softness: joint.softness(["solreflimit", "solimplimit"])?.softness(),
        // MuJoCo reads it in radians, whatever the unit of angles.
        limit_margin_rad: joint.amount("margin", "margin (rad)")?,
        torque_nm: torque_nm.unwrap_or(UNLIMITED),
        name: joint.label.clone(),
    })
}

/// Sets spring and friction of hinges with `springdamper`, a time constant and a damping ratio, as MuJoCo's compiler does:
/// inertia ÷ (time² × ratio²) and 2 × inertia ÷ time, with the inertia that a torque on the hinge alone accelerates in the
/// nominal pose.
pub(super) fn resolve_spring_dampers<'a>(joints: impl Iterator<Item = &'a Element>, model: &mut Model) {
    let mut responses = None;
    for joint in joints {
        let [time_s, ratio] = joint.list_over("springdamper", [0.0; 2]);
        let hinge = model.hinges.iter().position(|hinge| hinge.name == joint.label);
        let Some(hinge) = hinge.filter(|_| time_s > 0.0 && ratio > 0.0) else { continue };
        let responses = responses.get_or_insert_with(|| Structure::new(model).hinge_responses);
        let inertia_kgm2 = 1.0 / responses[hinge];
        let of_hinge = &mut model.hinges[hinge];
        of_hinge.stiffness_nmprad = inertia_kgm2 / (time_s * ratio).powi(2);
        // That of actuators stays.
        of_hinge.damping_nmsprad += 2.0 * inertia_kgm2 / time_s - joint.number("damping").unwrap_or(0.0);
    }
}

/// Returns the second and third number of a polynomial.
fn powers(element: &Element, name: &str) -> [f64; 2] {
    let [_, square, cube] = element.list_over(name, [0.0; 3]);
    [square, cube]
}

/// Returns the second and third coefficient of viscous friction, which never drives.
pub(super) fn damping_powers(element: &Element) -> Result<[f64; 2], ModelError> {
    let powers = powers(element, "damping");
    for power in powers {
        not_negative(&element.label, "damping", power)?;
    }
    Ok(powers)
}

/// Returns the motion of a body from its pose in the text to the one with its hinges at zero.
pub(super) fn from_nominal(hinges: &[Hinge]) -> Result<Isometry3<f64>, ModelError> {
    let Some(hinge) = hinges.iter().find(|hinge| hinge.nominal_rad != 0.0) else { return Ok(Isometry3::identity()) };
    if hinges.len() > 1 {
        let problem = "with several hinges of one body `ref` must be 0; give each hinge a body";
        return Err(ModelError::unsupported(&hinge.name, problem));
    }
    let back = UnitQuaternion::from_axis_angle(&hinge.axis, -hinge.nominal_rad);
    Ok(Isometry3::rotation_wrt_point(back, hinge.anchor_m))
}
