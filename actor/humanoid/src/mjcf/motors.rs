//! Motors and servos.

use super::defaults::{REPLACED, inherits_nothing};
use super::element::Element;
use super::joints::damping_powers;
use crate::articulation::Structure;
use crate::error::ModelError;
use crate::model::{Hinge, Model, Motor, not_negative};

/// Control range of a motor that has neither a control range nor limits of force or joint torque.
const UNIT_RANGE: [f64; 2] = [-1.0, 1.0];
const UNLIMITED: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// Replaces damping ratios by damping: ratio × 2 √(stiffness × inertia), with the inertia that a torque on the hinge alone
/// accelerates in the nominal pose.
///
/// # Errors
/// [`ModelError`] names a servo whose damping is not finite.
pub(super) fn resolve_damping_ratios(model: &mut Model) -> Result<(), ModelError> {
    if model.motors.iter().all(|motor| motor.bias[2] <= 0.0) {
        return Ok(());
    }
    let responses = Structure::new(model).hinge_responses;
    for motor in model.motors.iter_mut().filter(|motor| motor.bias[2] > 0.0) {
        let mass = 1.0 / (responses[motor.hinge] * motor.gear_nm.powi(2));
        let damping = motor.bias[2] * 2.0 * (motor.gain * mass).sqrt();
        motor.bias[2] = -not_negative(&motor.name, "damping of the servo by its `dampratio`", damping)?;
    }
    Ok(())
}

/// Reads one actuator. A damping ratio is returned as positive `bias[2]`, as in MuJoCo; [`resolve_damping_ratios`] must
/// follow.
pub(super) fn read(actuator: &Element, hinges: &[Hinge], autolimits: bool) -> Result<Motor, ModelError> {
    let name = actuator.label.clone();
    let hinge = hinges.iter().position(|hinge| Some(hinge.name.as_str()) == actuator.get("joint"));
    let hinge = hinge.ok_or_else(|| actuator.refused("its `joint` is not a hinge of the model"))?;
    let gear = actuator.number("gear").unwrap_or(1.0);
    if gear == 0.0 {
        return Err(ModelError::quantity(&name, "gear", gear, "other than 0"));
    }
    for [one, other] in REPLACED {
        let is_set = |name: &str| actuator.get(name).is_some_and(|value| !inherits_nothing(name, value));
        if is_set(one) && is_set(other) {
            return Err(actuator.refused(format!("give either `{one}` or `{other}`, not both")));
        }
    }
    let (gain, bias) = gain_and_bias(actuator)?;
    let force = actuator.range("forcerange", "forcelimited", autolimits)?;
    let control = match inherited_range(actuator, &hinges[hinge])? {
        Some(range) => Some(range).filter(|_| !matches!(actuator.get("ctrllimited"), Some("false" | "0"))),
        None => actuator.range("ctrlrange", "ctrllimited", autolimits)?,
    };
    let control = match (control, force) {
        (Some(control), _) => control,
        (None, _) if bias != [0.0; 3] => servo_range(actuator, gear, bias, &hinges[hinge])?,
        // Derive the action range from the limits of the motor or its joint.
        (None, Some([low, high])) => sorted(low / gain, high / gain),
        (None, None) => match hinges[hinge].torque_nm {
            [low, high] if low.is_finite() => sorted(low / (gain * gear), high / (gain * gear)),
            _ => UNIT_RANGE,
        },
    };
    Ok(Motor {
        name,
        hinge,
        gear_nm: gear,
        length_per_rad: gear,
        control,
        gain,
        bias,
        force: force.unwrap_or(UNLIMITED),
    })
}

/// Adds an actuator's own friction and rotor inertia to its hinge: as in MuJoCo times the square of the gear, all powers of
/// the friction alike.
pub(super) fn add_rotor(actuator: &Element, motor: &Motor, hinge: &mut Hinge) -> Result<(), ModelError> {
    let square = motor.gear_nm.powi(2);
    hinge.armature_kgm2 += square * actuator.amount("armature", "armature (kg·m²)")?;
    hinge.damping_nmsprad += square * actuator.amount("damping", "damping (N·m·s/rad)")?;
    for (sum, power) in hinge.damping_powers.iter_mut().zip(damping_powers(actuator)?) {
        *sum += square * power;
    }
    Ok(())
}

/// Returns the control range of a position servo with `inheritrange`: a multiple of its hinge's range.
fn inherited_range(actuator: &Element, hinge: &Hinge) -> Result<Option<[f64; 2]>, ModelError> {
    let share = actuator.amount("inheritrange", "inheritrange")?;
    if share == 0.0 {
        return Ok(None);
    }
    // Like MuJoCo, without regard to the gear.
    let (centre, half) = (f64::midpoint(hinge.min_rad, hinge.max_rad), (hinge.max_rad - hinge.min_rad) / 2.0);
    if !half.is_finite() {
        return Err(actuator.refused("`inheritrange` needs a `range` of its joint"));
    }
    Ok(Some([centre - share * half, centre + share * half]))
}

/// Returns the control range of a servo without one: for a position servo the range of its hinge.
fn servo_range(servo: &Element, gear: f64, bias: [f64; 3], hinge: &Hinge) -> Result<[f64; 2], ModelError> {
    if bias[1] == 0.0 || !(hinge.min_rad.is_finite() && hinge.max_rad.is_finite()) {
        let problem =
            "a servo needs a `ctrlrange`, the range of its targets; a position servo may use its joint's `range`";
        return Err(servo.refused(problem));
    }
    Ok(sorted(gear * hinge.min_rad, gear * hinge.max_rad))
}

fn sorted(one: f64, other: f64) -> [f64; 2] {
    [one.min(other), one.max(other)]
}

/// Returns gain and bias of an actuator: force = gain × control + bias · (1, length, velocity).
fn gain_and_bias(actuator: &Element) -> Result<(f64, [f64; 3]), ModelError> {
    let name = &actuator.label;
    let (gain, bias) = match actuator.tag.as_str() {
        "motor" => (1.0, [0.0; 3]),
        "position" => {
            let kp = actuator.number("kp").unwrap_or(1.0);
            let kv = actuator.amount("kv", "damping of the servo")?;
            let ratio = actuator.number("dampratio").map(|ratio| not_negative(name, "dampratio", ratio)).transpose()?;
            (kp, [0.0, -kp, ratio.unwrap_or(-kv)])
        }
        "velocity" => {
            let kv = actuator.number("kv").unwrap_or(1.0);
            (kv, [0.0, 0.0, -kv])
        }
        _ => {
            let gain = actuator.number("gainprm").unwrap_or(1.0);
            let is_affine = actuator.get("biastype").is_some_and(|kind| kind == "affine");
            (gain, if is_affine { actuator.list_over("biasprm", [0.0; 3]) } else { [0.0; 3] })
        }
    };
    if gain == 0.0 {
        return Err(ModelError::quantity(name, "gain", gain, "other than 0"));
    }
    // A general actuator may have a damping ratio too.
    let damping = if gain == -bias[1] { 0.0 } else { -bias[2] };
    for (what, value) in [("stiffness of the servo", -bias[1]), ("damping of the servo", damping)] {
        if value < 0.0 {
            return Err(ModelError::quantity(name, what, value, "at least 0, so that the servo is stable"));
        }
    }
    Ok((gain, bias))
}

/// Returns a note for each hinge on whose several motors the limits of a servo hold together.
pub(super) fn shared_limits(motors: &[Motor], hinges: &[Hinge]) -> Vec<String> {
    let of_hinge = |index: usize| motors.iter().filter(move |motor| motor.hinge == index);
    let is_limited = |motor: &Motor| motor.bias[1..] != [0.0; 2] && motor.force.iter().any(|force| force.is_finite());
    let shares = |index: &usize| of_hinge(*index).count() > 1 && of_hinge(*index).any(is_limited);
    let note = |index: usize| {
        let name = &hinges[index].name;
        format!("joint `{name}`: the sum of its actuators has the limit of the narrowest servo, not each one its own")
    };
    (0..hinges.len()).filter(shares).map(note).collect()
}
