//! Joints: the root's free joint, and hinges.

use mjcf_rs::body::{Joint, JointType};
use mjcf_rs::types::Tristate;
use nalgebra::{Unit, Vector3};

use super::Hinge;
use super::geoms::not_negative;
use crate::error::ModelError;

/// Refuses a free joint with stiffness, damping or armature.
pub(super) fn check_free(joint: &Joint) -> Result<(), ModelError> {
    let name = joint.name.as_deref().unwrap_or("free joint");
    for (what, value) in [
        ("stiffness of a free joint", joint.stiffness),
        ("damping of a free joint", joint.damping),
        ("armature of a free joint", joint.armature),
    ] {
        if value != 0.0 {
            return Err(ModelError::quantity(name, what, value, "0: the root must move freely"));
        }
    }
    Ok(())
}

/// Reads a hinge; `torque_nm` limits the total torque of its motors.
pub(super) fn read_hinge(joint: &Joint, autolimits: bool, torque_nm: Option<[f64; 2]>) -> Result<Hinge, ModelError> {
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
    let (min_rad, max_rad) = range(&name, joint, autolimits)?;
    Ok(Hinge {
        axis,
        min_rad,
        max_rad,
        stiffness_nmprad: not_negative(&name, "stiffness (N·m/rad)", joint.stiffness)?,
        rest_rad: joint.springref,
        damping_nmsprad: not_negative(&name, "damping (N·m·s/rad)", joint.damping)?,
        armature_kgm2: not_negative(&name, "armature (kg·m²)", joint.armature)?,
        torque_nm: torque_nm.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]),
        name,
    })
}

fn range(name: &str, joint: &Joint, autolimits: bool) -> Result<(f64, f64), ModelError> {
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
