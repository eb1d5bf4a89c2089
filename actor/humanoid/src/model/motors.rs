//! Motors and servos, and their torques.

use mjcf_rs::extras::{Actuator, ActuatorKind};
use mjcf_rs::types::Tristate;

use super::defaults::{Attribute, REPLACED, get};
use super::values::{amount, not_negative, number};
use super::{Hinge, Model, Motor};
use crate::dynamics::{Drive, Structure};
use crate::error::ModelError;

/// Control range of a motor that has neither a control range nor limits of force or joint torque.
const UNIT_RANGE: [f64; 2] = [-1.0, 1.0];
const UNLIMITED: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// Reads all actuators; `attributes` are those of each. [`resolve_damping_ratios`] must follow.
pub(super) fn read(
    actuators: &[Actuator],
    attributes: &[Vec<Attribute>],
    hinges: &[Hinge],
    autolimits: bool,
) -> Result<Vec<Motor>, ModelError> {
    let both = actuators.iter().zip(attributes);
    both.map(|(actuator, attributes)| read_one(actuator, attributes, hinges, autolimits)).collect()
}

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

/// Reads one actuator. A damping ratio is returned as positive `bias[2]`, as in MuJoCo.
fn read_one(
    actuator: &Actuator,
    attributes: &[Attribute],
    hinges: &[Hinge],
    autolimits: bool,
) -> Result<Motor, ModelError> {
    let name = actuator.name.clone().or_else(|| actuator.joint.clone()).unwrap_or_default();
    let hinge = hinges
        .iter()
        .position(|hinge| Some(hinge.name.as_str()) == actuator.joint.as_deref())
        .ok_or_else(|| ModelError::unsupported(&name, "its `joint` is not a hinge of the model"))?;
    let gear = actuator.gear[0];
    if gear == 0.0 {
        return Err(ModelError::quantity(&name, "gear", gear, "other than 0"));
    }
    for [one, other] in REPLACED {
        if get(attributes, one).is_some() && get(attributes, other).is_some() {
            return Err(ModelError::unsupported(&name, format!("give either `{one}` or `{other}`, not both")));
        }
    }
    let (gain, bias) = gain_and_bias(&name, actuator, attributes)?;
    let force = limits(&name, "forcerange", actuator.force_range, actuator.force_limited, autolimits)?;
    let control = match inherited_range(&name, attributes, &hinges[hinge])? {
        Some(range) => Some(range).filter(|_| actuator.ctrl_limited != Tristate::False),
        None => limits(&name, "ctrlrange", actuator.ctrl_range, actuator.ctrl_limited, autolimits)?,
    };
    let control = match (control, force) {
        (Some(control), _) => control,
        (None, _) if bias != [0.0; 3] => servo_range(&name, gear, bias, &hinges[hinge])?,
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

/// Returns the control range of a position servo with `inheritrange`: a multiple of its hinge's range.
fn inherited_range(name: &str, attributes: &[Attribute], hinge: &Hinge) -> Result<Option<[f64; 2]>, ModelError> {
    let share = amount(name, attributes, "inheritrange", "inheritrange")?;
    if share == 0.0 {
        return Ok(None);
    }
    // Like MuJoCo, without regard to the gear.
    let (centre, half) = (f64::midpoint(hinge.min_rad, hinge.max_rad), (hinge.max_rad - hinge.min_rad) / 2.0);
    if !half.is_finite() {
        return Err(ModelError::unsupported(name, "`inheritrange` needs a `range` of its joint"));
    }
    Ok(Some([centre - share * half, centre + share * half]))
}

/// Returns the control range of a servo without one: for a position servo the range of its hinge.
fn servo_range(name: &str, gear: f64, bias: [f64; 3], hinge: &Hinge) -> Result<[f64; 2], ModelError> {
    if bias[1] == 0.0 || !(hinge.min_rad.is_finite() && hinge.max_rad.is_finite()) {
        let problem =
            "a servo needs a `ctrlrange`, the range of its targets; a position servo may use its joint's `range`";
        return Err(ModelError::unsupported(name, problem));
    }
    Ok(sorted(gear * hinge.min_rad, gear * hinge.max_rad))
}

fn sorted(one: f64, other: f64) -> [f64; 2] {
    [one.min(other), one.max(other)]
}

/// Returns gain and bias of an actuator: force = gain × control + bias · (1, length, velocity).
fn gain_and_bias(name: &str, actuator: &Actuator, attributes: &[Attribute]) -> Result<(f64, [f64; 3]), ModelError> {
    let parameter = |list: &[f64], index: usize| list.get(index).copied().unwrap_or(0.0);
    let (gain, bias) = match actuator.kind {
        ActuatorKind::Motor => (1.0, [0.0; 3]),
        ActuatorKind::Position => {
            let kp = actuator.kp.unwrap_or(1.0);
            let kv = amount(name, attributes, "kv", "damping of the servo")?;
            let ratio =
                number(attributes, "dampratio").map(|ratio| not_negative(name, "dampratio", ratio)).transpose()?;
            (kp, [0.0, -kp, ratio.unwrap_or(-kv)])
        }
        ActuatorKind::Velocity => {
            let kv = actuator.kv.unwrap_or(1.0);
            (kv, [0.0, 0.0, -kv])
        }
        ActuatorKind::General => {
            let gain = actuator.gainprm.first().copied().unwrap_or(1.0);
            match actuator.bias_type.as_deref() {
                Some("affine") => (gain, [0, 1, 2].map(|index| parameter(&actuator.biasprm, index))),
                _ => (gain, [0.0; 3]),
            }
        }
        _ => return Err(ModelError::unsupported(name, "actuators must be motor, position, velocity or general")),
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

fn limits(
    name: &str,
    attribute: &str,
    range: Option<[f64; 2]>,
    limited: Tristate,
    autolimits: bool,
) -> Result<Option<[f64; 2]>, ModelError> {
    match (limited, range) {
        (Tristate::False, _) | (Tristate::Auto, None) => Ok(None),
        (Tristate::Auto, Some(_)) if !autolimits => {
            Err(ModelError::unsupported(name, format!("without autolimits `{attribute}` needs its `limited` flag")))
        }
        (_, Some([low, high])) if low < high => Ok(Some([low, high])),
        (_, Some([low, high])) => {
            Err(ModelError::attribute(name, attribute, &format!("{low} {high}"), "a lower and an upper limit"))
        }
        (_, None) => Err(ModelError::unsupported(name, format!("it is limited, but has no `{attribute}`"))),
    }
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

impl Model {
    /// Writes the motors of each hinge for one control per motor. Clamps controls to [`Motor::control`].
    pub(crate) fn drives(&self, controls: &[f32], drives: &mut [Drive]) {
        for (drive, hinge) in drives.iter_mut().zip(&self.hinges) {
            let [min_nm, max_nm] = hinge.torque_nm;
            *drive = Drive { min_nm, max_nm, ..Drive::default() };
        }
        for (motor, &control) in self.motors.iter().zip(controls) {
            let drive = &mut drives[motor.hinge];
            let [constant, per_length, per_velocity] = motor.bias;
            let force = motor.gain * f64::from(control).clamp(motor.control[0], motor.control[1]) + constant;
            let limits = sorted(motor.gear_nm * motor.force[0], motor.gear_nm * motor.force[1]);
            if motor.gear_nm == 0.0 {
                // Infinite limits times 0 are no limits.
                continue;
            }
            if per_length == 0.0 && per_velocity == 0.0 {
                drive.torque_nm += (motor.gear_nm * force).clamp(limits[0], limits[1]);
            } else {
                drive.torque_nm += motor.gear_nm * force;
                drive.stiffness_nmprad -= motor.gear_nm * motor.length_per_rad * per_length;
                drive.damping_nmsprad -= motor.gear_nm * motor.length_per_rad * per_velocity;
                // A hinge rarely has several servos; their limits then hold for the sum.
                drive.min_nm = drive.min_nm.max(limits[0]);
                drive.max_nm = drive.max_nm.min(limits[1]);
            }
        }
        for drive in drives.iter_mut().filter(|drive| drive.stiffness_nmprad == 0.0 && drive.damping_nmsprad == 0.0) {
            drive.torque_nm = drive.torque_nm.max(drive.min_nm).min(drive.max_nm);
        }
    }
}
