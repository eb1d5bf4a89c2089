//! Joints: the root's free joint, and hinges.

use nalgebra::{Isometry3, Point3, Unit, UnitQuaternion, Vector3};

use super::element::Element;
use super::tree::Compiler;
use crate::error::ModelError;
use crate::model::{Hinge, RootJoint};

/// Attributes for the softness of dry friction.
const FRICTION: [&str; 2] = ["solreffriction", "solimpfriction"];
const UNLIMITED: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// Returns whether a joint leaves all six degrees of freedom.
pub(super) fn is_free(joint: &Element) -> bool {
    joint.tag == "freejoint" || joint.get("type") == Some("free")
}

/// Reads the root's free joint, which must have no spring.
pub(super) fn read_free(joint: &Element) -> Result<RootJoint, ModelError> {
    let stiffness = joint.number("stiffness").unwrap_or(0.0);
    if stiffness != 0.0 {
        let expected = "0: springs of the root are not simulated";
        return Err(ModelError::quantity(&joint.label, "stiffness of a free joint", stiffness, expected));
    }
    Ok(RootJoint {
        damping: joint.amount("damping", "damping of a free joint")?,
        friction_loss: joint.amount("frictionloss", "frictionloss of a free joint")?,
        friction_softness: joint.softness(FRICTION)?.softness(),
        armature: joint.amount("armature", "armature of a free joint")?,
    })
}

/// Reads a hinge.
pub(super) fn read_hinge(joint: &Element, compiler: &Compiler) -> Result<Hinge, ModelError> {
    if is_free(joint) {
        return Err(joint.refused("only the root may have a free joint"));
    }
    if let Some(kind) = joint.get("type").filter(|kind| *kind != "hinge") {
        return Err(joint.refused(format!("joints must be hinges, not of type {kind}")));
    }
    let axis = Vector3::from(joint.list_over("axis", [0.0, 0.0, 1.0]));
    let axis = Unit::try_new(axis, 1e-6).ok_or_else(|| joint.refused("the axis must not be zero"))?;
    let range = joint.range("range", "limited", compiler.autolimits)?;
    let [min_rad, max_rad] = range.map_or(UNLIMITED, |range| range.map(|angle| compiler.angles.radians(angle)));
    let torque_nm = joint.range("actuatorfrcrange", "actuatorfrclimited", compiler.autolimits)?;
    Ok(Hinge {
        axis,
        anchor_m: Point3::from(joint.list_over("pos", [0.0; 3])),
        min_rad,
        max_rad,
        stiffness_nmprad: joint.amount("stiffness", "stiffness (N·m/rad)")?,
        nominal_rad: compiler.angles.radians(joint.number("ref").unwrap_or(0.0)),
        rest_rad: compiler.angles.radians(joint.number("springref").unwrap_or(0.0)),
        damping_nmsprad: joint.amount("damping", "damping (N·m·s/rad)")?,
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
