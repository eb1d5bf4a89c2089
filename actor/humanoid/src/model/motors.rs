//! Motors and servos, and their torques.

use mjcf_rs::extras::{Actuator, ActuatorKind};
use mjcf_rs::types::Tristate;
use nalgebra::Isometry3;

use super::{Hinge, Model, Motor};
use crate::error::ModelError;

/// Control range of a motor that has neither a control range nor limits of force or joint torque.
const UNIT_RANGE: [f64; 2] = [-1.0, 1.0];
const UNLIMITED: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// Reads all actuators.
pub(super) fn read(
    actuators: &[Actuator],
    hinges: &[Hinge],
    compiler: &mjcf_rs::compiler::Compiler,
) -> Result<Vec<Motor>, ModelError> {
    if actuators.is_empty() {
        return Err(ModelError::unsupported("actuator", "the model needs at least one motor"));
    }
    actuators.iter().map(|actuator| read_one(actuator, hinges, compiler.autolimits)).collect()
}

fn read_one(actuator: &Actuator, hinges: &[Hinge], autolimits: bool) -> Result<Motor, ModelError> {
    let name = actuator.name.clone().or_else(|| actuator.joint.clone()).unwrap_or_default();
    let hinge = hinges
        .iter()
        .position(|hinge| Some(hinge.name.as_str()) == actuator.joint.as_deref())
        .ok_or_else(|| ModelError::unsupported(&name, "its `joint` is not a hinge of the model"))?;
    let gear = actuator.gear[0];
    if gear == 0.0 {
        return Err(ModelError::quantity(&name, "gear", gear, "other than 0"));
    }
    let (gain, bias) = gain_and_bias(&name, actuator)?;
    let force = limits(&name, "forcerange", actuator.force_range, actuator.force_limited, autolimits)?;
    let control = limits(&name, "ctrlrange", actuator.ctrl_range, actuator.ctrl_limited, autolimits)?;
    let is_servo = bias != [0.0; 3];
    let control = match (control, force) {
        (Some(control), _) => control,
        (None, _) if is_servo => {
            return Err(ModelError::unsupported(&name, "a servo needs a `ctrlrange`: the range of its targets"));
        }
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

fn sorted(one: f64, other: f64) -> [f64; 2] {
    [one.min(other), one.max(other)]
}

/// Returns gain and bias of an actuator: force = gain × control + bias · (1, length, velocity).
fn gain_and_bias(name: &str, actuator: &Actuator) -> Result<(f64, [f64; 3]), ModelError> {
    let parameter = |list: &[f64], index: usize| list.get(index).copied().unwrap_or(0.0);
    let (gain, bias) = match actuator.kind {
        ActuatorKind::Motor => (1.0, [0.0; 3]),
        ActuatorKind::Position => {
            let (kp, kv) = (actuator.kp.unwrap_or(1.0), actuator.kv.unwrap_or(0.0));
            (kp, [0.0, -kp, -kv])
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
    for (what, value) in [("stiffness of the servo", -bias[1]), ("damping of the servo", -bias[2])] {
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

impl Motor {
    /// Returns the force for a control and the hinge's angle and rate; torque is gear × force (N·m).
    fn force(&self, control: f64, angle_rad: f64, rate_radps: f64) -> f64 {
        let [constant, per_length, per_velocity] = self.bias;
        let (length, velocity) = (self.length_per_rad * angle_rad, self.length_per_rad * rate_radps);
        (self.gain * control.clamp(self.control[0], self.control[1])
            + constant
            + per_length * length
            + per_velocity * velocity)
            .clamp(self.force[0], self.force[1])
    }
}

impl Model {
    /// Writes the total motor torque on each hinge (N·m), for one control per motor and the hinges' angles (rad) and
    /// rates (rad/s). Clamps controls to [`Motor::control`].
    pub(crate) fn motor_torques(
        &self,
        controls: &[f32],
        angles_rad: &[f64],
        rates_radps: &[f64],
        torques_nm: &mut [f64],
    ) {
        torques_nm.fill(0.0);
        for (motor, &control) in self.motors.iter().zip(controls) {
            let (angle_rad, rate_radps) = (angles_rad[motor.hinge], rates_radps[motor.hinge]);
            torques_nm[motor.hinge] += motor.gear_nm * motor.force(f64::from(control), angle_rad, rate_radps);
        }
        for (torque_nm, hinge) in torques_nm.iter_mut().zip(&self.hinges) {
            *torque_nm = torque_nm.clamp(hinge.torque_nm[0], hinge.torque_nm[1]);
        }
    }

    /// Refuses servos that are unstable with physics steps of `step_s`: their torque is computed before each step, so it
    /// must not carry the hinge past its target within one.
    ///
    /// # Errors
    /// [`ModelError`] names the servo.
    pub(crate) fn check_servos(&self, step_s: f64) -> Result<(), ModelError> {
        for motor in &self.motors {
            let [_, per_length, per_velocity] = motor.bias;
            let squared = motor.gear_nm * motor.gear_nm;
            let inertia_kgm2 = self.hinges[motor.hinge].armature_kgm2 + self.carried_inertia_kgm2(motor.hinge);
            let limit = inertia_kgm2 / (squared * step_s);
            if -per_velocity - per_length * step_s > limit {
                let problem = format!(
                    "its damping of {} and stiffness of {} need physics steps shorter than {} ms: raise env.substeps \
                     or the joint's armature, or use the joint's `damping`, which has no such limit",
                    -per_velocity,
                    -per_length,
                    step_s * 1e3
                );
                return Err(ModelError::unsupported(&motor.name, problem));
            }
        }
        Ok(())
    }

    /// Returns the inertia about a hinge's axis of all bodies that it moves, with all hinges at zero (kg·m²).
    fn carried_inertia_kgm2(&self, hinge: usize) -> f64 {
        let Some(carrier) = self.bodies.iter().position(|body| body.hinges.contains(&hinge)) else { return 0.0 };
        let axis = self.hinges[hinge].axis.into_inner();
        let anchor = self.bodies[carrier].anchor_m;
        let mut poses: Vec<Option<Isometry3<f64>>> = vec![None; self.bodies.len()];
        let mut sum = 0.0;
        for (index, body) in self.bodies.iter().enumerate().skip(carrier) {
            let pose = match body.parent.and_then(|parent| poses[parent]) {
                _ if index == carrier => Isometry3::identity(),
                Some(parent) => parent * body.pose,
                None => continue,
            };
            poses[index] = Some(pose);
            let local = pose.rotation.inverse() * axis;
            let arm = (pose * body.centre_of_mass_m - anchor).cross(&axis);
            sum += local.dot(&(body.inertia_kgm2 * local)) + body.mass_kg * arm.norm_squared();
        }
        sum
    }
}
