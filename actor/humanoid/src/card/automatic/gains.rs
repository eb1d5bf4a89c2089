//! Servos: stiffness, damping and torque of each hinge.
//!
//! All follow from what the hinges of legs carry, *weight × leg length* (N·m): the legs of G1, H1 and T1, whose gains
//! their makers or others have tried, have stiffnesses of 0.2 to 1.1 of it at the hip, 0.4 to 1.1 at the knee and 0.1 to
//! 0.3 at the ankle, and dampings of 0.02 to 0.06 s of the stiffness.

use std::f64::consts::TAU;

use super::legs::{LegRole, Legs};
use super::pose::felt_inertia_kgm2;
use crate::model::Model;
use crate::physics::Physics;

/// Stiffness of the hinges of a leg, per weight × leg length (1/rad), and their greatest torque where the file has none.
const STIFFNESS: [(LegRole, f64, f64); 3] =
    [(LegRole::Hip, 0.4, 0.5), (LegRole::Knee, 0.45, 0.65), (LegRole::Ankle, 0.15, 0.25)];
/// Damping per stiffness (s) of a leg of this length (m); times grow with the root of lengths.
const DAMPING_S: f64 = 0.04;
const DAMPING_LEG_M: f64 = 0.7;
/// Least natural frequency (Hz) of a hinge of such a leg, for the rotor's inertia alone.
const ROTOR_MIN_HZ: f64 = 3.0;
/// How many times more or less stiff than that a file's own servo may be.
const OWN_MAX: f64 = 2.5;
/// Torque that no hinge has more of, per weight × leg length: files without a real limit name an enormous one.
const EFFORT_MAX: f64 = 2.0;
/// Change of the target per unit of an action (rad): a unit bends a knee about half as much as a step does.
const ACTION_SCALE_RAD: f64 = 0.3;
/// Natural frequency (Hz) and damping ratio of a hinge that is held.
const HELD_HZ: f64 = 4.0;
const HELD_DAMPING_RATIO: f64 = 0.7;
/// Rotor inertia per greatest torque (kg·m² per N·m) where the file has none: that of the motors of a G1.
const ARMATURE_PER_EFFORT: f64 = 1.2e-4;
/// Natural frequency (Hz) and damping ratio, for the rotor's inertia alone, of hinges of a robot without legs. mjlab derives
/// the gains of its G1 by the same rule.
const ROTOR_HZ: f64 = 10.0;
const ROTOR_DAMPING_RATIO: f64 = 2.0;

/// How a value was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Confidence {
    /// The file says so.
    Sure,
    /// It agrees with what follows from the robot's size.
    Likely,
    /// By a rule that suits most robots.
    Guess,
}

/// Number with its reason.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Reasoned {
    pub number: f64,
    pub confidence: Confidence,
    pub reason: String,
}

impl Reasoned {
    fn new(number: f64, confidence: Confidence, reason: impl Into<String>) -> Self {
        Self { number, confidence, reason: reason.into() }
    }
}

/// Servo of a hinge.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Servo {
    pub kp: Reasoned,
    pub kd: Reasoned,
    /// `None` if neither the file nor a rule has one.
    pub effort_nm: Option<Reasoned>,
    pub armature_kgm2: Reasoned,
    /// `None` for the default.
    pub action_scale_rad: Option<Reasoned>,
    /// Why no policy moves it.
    pub held: Option<String>,
}

/// Stiffness and damping of the file's own servo; `None` without one.
fn own(model: &Model, hinge: usize) -> Option<[f64; 2]> {
    let servo = model.motors.iter().find(|motor| motor.hinge == hinge && motor.bias[1] != 0.0)?;
    let square = servo.gear_nm * servo.gear_nm;
    Some([-servo.bias[1] * square, -servo.bias[2] * square])
}

/// Proposes the servo of a hinge of a robot with legs, in its home pose.
pub(super) fn of_walker(physics: &Physics, legs: &Legs, hinge: usize) -> Servo {
    let model = physics.model();
    let carried_nm = model.mass_kg() * model.gravity_mps2.norm() * legs.hip_height_m;
    let role = legs.role(hinge);
    let shares =
        STIFFNESS.iter().find(|(of, ..)| Some(*of) == role).map(|(_, stiffness, torque)| [*stiffness, *torque]);
    let effort_nm = match (model.effort_nm(hinge), shares) {
        (Some(own_nm), _) if own_nm <= EFFORT_MAX * carried_nm && own_nm > 0.0 => {
            Reasoned::new(own_nm, Confidence::Sure, "of the file")
        }
        (own_nm, shares) => {
            let share = shares.map_or(STIFFNESS[0].2, |[_, torque]| torque);
            let why = own_nm.map_or("the file has none".to_owned(), |own_nm| {
                format!("the file's {} is no limit", super::short(own_nm))
            });
            let reason = format!("{why}: {share} of weight × leg length, {}", super::short(carried_nm));
            Reasoned::new(share * carried_nm, Confidence::Guess, reason)
        }
    };
    let armature_kgm2 = match model.hinges[hinge].armature_kgm2 {
        own if own > 0.0 => Reasoned::new(own, Confidence::Sure, "of the file"),
        _ => Reasoned::new(
            ARMATURE_PER_EFFORT * effort_nm.number,
            Confidence::Guess,
            format!("the file has none: {ARMATURE_PER_EFFORT:?} of effort_nm"),
        ),
    };
    if let Some(why) = model.moved_by(hinge) {
        let none = || Reasoned::new(0.0, Confidence::Sure, "no servo");
        return Servo {
            kp: none(),
            kd: none(),
            effort_nm: Some(effort_nm),
            armature_kgm2: Reasoned::new(model.hinges[hinge].armature_kgm2, Confidence::Sure, "of the file"),
            action_scale_rad: None,
            held: Some(why),
        };
    }
    let damping_s = DAMPING_S * (legs.hip_height_m / DAMPING_LEG_M).sqrt();
    // What the joint itself has acts too.
    let rest = |kd: f64| (kd - model.hinges[hinge].damping_nmsprad).max(0.0);
    let Some([stiffness, _]) = shares else {
        let inertia_kgm2 = felt_inertia_kgm2(physics, hinge);
        let rate_radps = TAU * HELD_HZ;
        let reason = format!("{HELD_HZ} Hz for {} kg·m²", super::short(inertia_kgm2));
        return Servo {
            kp: Reasoned::new(inertia_kgm2 * rate_radps * rate_radps, Confidence::Guess, reason),
            kd: Reasoned::new(
                rest(2.0 * HELD_DAMPING_RATIO * inertia_kgm2 * rate_radps),
                Confidence::Guess,
                format!("damping ratio {HELD_DAMPING_RATIO}"),
            ),
            effort_nm: Some(effort_nm),
            armature_kgm2,
            action_scale_rad: None,
            held: Some("no hinge of a leg".to_owned()),
        };
    };
    // A heavy rotor needs more to move in time.
    let rate_radps = TAU * ROTOR_MIN_HZ * (DAMPING_LEG_M / legs.hip_height_m).sqrt();
    let by_rotor = model.hinges[hinge].armature_kgm2 * rate_radps * rate_radps;
    let (by_rule, rule) = match stiffness * carried_nm {
        by_weight if by_weight < by_rotor => (by_rotor, format!("{:.1} Hz for its rotor", rate_radps / TAU)),
        by_weight => (by_weight, format!("{stiffness} of weight × leg length")),
    };
    let (kp, kd) = match own(model, hinge) {
        Some([kp, kd])
            if kp <= OWN_MAX * by_rule && by_rule <= OWN_MAX * kp && kd + model.hinges[hinge].damping_nmsprad > 0.0 =>
        {
            let reason = format!("of the file; {rule} would be {}", super::short(by_rule));
            (Reasoned::new(kp, Confidence::Likely, reason), Reasoned::new(kd, Confidence::Likely, "of the file"))
        }
        own => {
            let instead =
                own.map(|[kp, kd]| format!(", instead of the file's {} and {}", super::short(kp), super::short(kd)));
            let reason = rule + &instead.unwrap_or_default();
            let kd = Reasoned::new(rest(damping_s * by_rule), Confidence::Guess, format!("{damping_s:.3} s of kp"));
            (Reasoned::new(by_rule, Confidence::Guess, reason), kd)
        }
    };
    let scale = Reasoned::new(ACTION_SCALE_RAD, Confidence::Guess, "for all hinges of legs");
    Servo { kp, kd, effort_nm: Some(effort_nm), armature_kgm2, action_scale_rad: Some(scale), held: None }
}

/// Proposes the servo of a hinge of a robot whose legs are not known.
pub(super) fn of_any(model: &Model, hinge: usize) -> Servo {
    /// Stiffness per greatest torque (1/rad) and damping per stiffness (s) of a hinge without rotor inertia.
    const PER_EFFORT: f64 = 1.0;
    const DAMPING_S: f64 = 0.05;
    /// Greatest torque that counts for it, per mass of the robot (N·m/kg): that of its weight at 1 m.
    const WEIGHT_NMPKG: f64 = 9.81;
    /// Rotor inertia where the file has none (kg·m²).
    const ARMATURE_KGM2: f64 = 0.01;
    let effort_nm = model.effort_nm(hinge);
    let of_file = effort_nm.map(|effort_nm| Reasoned::new(effort_nm, Confidence::Sure, "of the file"));
    let own_kgm2 = model.hinges[hinge].armature_kgm2;
    let sure = |number: f64| Reasoned::new(number, Confidence::Sure, "of the file");
    let common = Servo {
        kp: sure(0.0),
        kd: sure(0.0),
        effort_nm: of_file,
        armature_kgm2: sure(own_kgm2),
        action_scale_rad: None,
        held: None,
    };
    if let Some([kp, kd]) = own(model, hinge) {
        return Servo { kp: sure(kp), kd: sure(kd), ..common };
    }
    let rate_radps = TAU * ROTOR_HZ;
    let guess = |number: f64| Reasoned::new(number, Confidence::Guess, "proposed: the file has no servo here");
    let kp = match (own_kgm2 > 0.0, effort_nm) {
        (false, Some(effort_nm)) => effort_nm.min(model.mass_kg() * WEIGHT_NMPKG) * PER_EFFORT,
        (has_rotor, _) => (if has_rotor { own_kgm2 } else { ARMATURE_KGM2 }) * rate_radps * rate_radps,
    };
    let kd = if own_kgm2 > 0.0 { 2.0 * ROTOR_DAMPING_RATIO * own_kgm2 * rate_radps } else { kp * DAMPING_S };
    let armature_kgm2 = if own_kgm2 > 0.0 { sure(own_kgm2) } else { guess(ARMATURE_KGM2) };
    Servo { kp: guess(kp), kd: guess(kd), armature_kgm2, ..common }
}
