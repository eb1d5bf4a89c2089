//! Joints: the root's free joint, and hinges.

use mjcf_rs::body::{Joint, JointType};
use mjcf_rs::types::Tristate;
use nalgebra::{Point3, Unit, Vector3};

use super::defaults::Attribute;
use super::softness::SolverNumbers;
use super::values::{amount, not_negative, range};
use super::{Hinge, Softness};
use crate::error::ModelError;

/// Free joint of the root: forces that act alike on each of its six degrees of freedom.
///
/// These are the root's velocity along the world's axes (m, N, kg) and its rate about its own axes (rad, N·m, kg·m²).
#[derive(Clone, Debug, PartialEq)]
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

/// Reads the root's free joint, which must have no spring; `attributes` are its own.
pub(super) fn read_free(joint: &Joint, attributes: &[Attribute]) -> Result<RootJoint, ModelError> {
    let name = joint.name.as_deref().unwrap_or("free joint");
    if joint.stiffness != 0.0 {
        let expected = "0: springs of the root are not simulated";
        return Err(ModelError::quantity(name, "stiffness of a free joint", joint.stiffness, expected));
    }
    Ok(RootJoint {
        damping: amount(name, attributes, "damping", "damping of a free joint")?,
        friction_loss: amount(name, attributes, "frictionloss", "frictionloss of a free joint")?,
        friction_softness: SolverNumbers::read(name, attributes, FRICTION)?.softness(),
        armature: amount(name, attributes, "armature", "armature of a free joint")?,
    })
}

/// Attributes for the softness of dry friction.
const FRICTION: [&str; 2] = ["solreffriction", "solimpfriction"];

/// Reads a hinge with the given attributes.
pub(super) fn read_hinge(joint: &Joint, attributes: &[Attribute], autolimits: bool) -> Result<Hinge, ModelError> {
    let name = joint.name.clone().unwrap_or_default();
    match joint.type_ {
        JointType::Hinge => {}
        JointType::Free => return Err(ModelError::unsupported(&name, "only the root may have a free joint")),
        JointType::Ball | JointType::Slide => {
            let kind = format!("{:?}", joint.type_).to_lowercase();
            return Err(ModelError::unsupported(&name, format!("joints must be hinges, not of type {kind}")));
        }
    }
    let axis = Unit::try_new(Vector3::from(joint.axis), 1e-6)
        .ok_or_else(|| ModelError::unsupported(&name, "the axis must not be zero"))?;
    let (min_rad, max_rad) = angle_range(&name, joint, autolimits)?;
    let torque_nm = range(&name, attributes, "actuatorfrcrange", "actuatorfrclimited", autolimits)?;
    Ok(Hinge {
        axis,
        anchor_m: Point3::from(joint.pos),
        min_rad,
        max_rad,
        stiffness_nmprad: not_negative(&name, "stiffness (N·m/rad)", joint.stiffness)?,
        rest_rad: joint.springref,
        damping_nmsprad: not_negative(&name, "damping (N·m·s/rad)", joint.damping)?,
        armature_kgm2: not_negative(&name, "armature (kg·m²)", joint.armature)?,
        friction_loss_nm: amount(&name, attributes, "frictionloss", "frictionloss (N·m)")?,
        friction_softness: SolverNumbers::read(&name, attributes, FRICTION)?.softness(),
        limit_softness: SolverNumbers::read(&name, attributes, ["solreflimit", "solimplimit"])?.softness(),
        // MuJoCo reads it in radians, whatever the unit of angles.
        limit_margin_rad: amount(&name, attributes, "margin", "margin (rad)")?,
        torque_nm: torque_nm.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]),
        name,
    })
}

fn angle_range(name: &str, joint: &Joint, autolimits: bool) -> Result<(f64, f64), ModelError> {
    let limited = match joint.limited {
        Tristate::True => true,
        Tristate::False => false,
        Tristate::Auto if joint.range.is_some() && !autolimits => {
            return Err(ModelError::unsupported(name, "without autolimits a range needs `limited`"));
        }
        Tristate::Auto => joint.range.is_some(),
    };
    if !limited {
        return Ok((f64::NEG_INFINITY, f64::INFINITY));
    }
    let [min_rad, max_rad] =
        joint.range.ok_or_else(|| ModelError::unsupported(name, "it is limited, but has no range"))?;
    if min_rad.is_nan() || max_rad.is_nan() || min_rad >= max_rad {
        return Err(ModelError::quantity(name, "lower end of the range (rad)", min_rad, "below the upper end"));
    }
    Ok((min_rad, max_rad))
}
