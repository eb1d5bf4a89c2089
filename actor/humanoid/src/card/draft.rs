//! Draft of a robot's card.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fmt::Write;

use crate::model::{Hinge, Model};

/// Natural frequency (Hz) and damping ratio of proposed gains, for the rotor's inertia alone. mjlab derives the gains of its
/// G1 by the same rule.
const FREQUENCY_HZ: f64 = 10.0;
const DAMPING_RATIO: f64 = 2.0;
/// Stiffness per greatest torque (1/rad) and damping per stiffness (s) of a hinge without rotor inertia.
const STIFFNESS_PER_EFFORT: f64 = 1.0;
/// Greatest torque that counts for it, per mass of the robot (N·m/kg): that of its weight at 1 m.
const WEIGHT_NMPKG: f64 = 9.81;
const DAMPING_PER_STIFFNESS_S: f64 = 0.05;
/// Proposed rotor inertia (kg·m²) of a hinge that has none and no servo.
const ARMATURE_KGM2: f64 = 0.01;

/// Numbers of a drafted rule.
#[derive(Clone)]
struct Numbers {
    kp: f64,
    kd: f64,
    effort_nm: Option<f64>,
    armature_kgm2: f64,
    default_rad: f64,
    is_proposed: bool,
    /// Damping of the joint itself (N·m·s/rad).
    of_joint: f64,
}

/// Returns a card for a model whose file is `file`. It keeps the servos of the model; where there are none it proposes
/// gains.
#[must_use]
pub fn draft(model: &Model, file: &str) -> String {
    let mut card = String::new();
    let keyframe = model.keyframes.first();
    let _ = writeln!(card, "model = {}", quoted(file));
    let _ = writeln!(card, "base = {}", quoted(&model.links[0].name));
    let feet: Vec<String> = feet(model).into_iter().map(quoted).collect();
    let _ = writeln!(card, "feet = [{}]", feet.join(", "));
    match keyframe {
        Some(key) => {
            let _ = writeln!(card, "keyframe = {}", quoted(&key.name));
        }
        None if model.bodies[0].pose.translation.z > 0.0 => {
            let _ = writeln!(card, "height_m = {}", short(model.bodies[0].pose.translation.z));
        }
        None => card.push_str("# height_m = 1.0  # missing in the file: the height of the root (m)\n"),
    }
    // The keyframe has the angles.
    for (names, numbers) in rules(model) {
        let Numbers { kp, kd, effort_nm, armature_kgm2, default_rad, is_proposed, of_joint } = numbers;
        let _ = writeln!(card, "\n[[hinges]]\nnames = {}", quoted(&names));
        let note = if is_proposed { "  # proposed: the file has no servo here" } else { "" };
        // A servo without damping of its own may rely on that of its joint, which the card keeps.
        let own = if kd == 0.0 && of_joint > 0.0 {
            format!("  # the joint's own damping, {} N·m·s/rad, acts too", short(of_joint))
        } else {
            String::new()
        };
        let _ = writeln!(card, "kp = {}{note}\nkd = {}{own}", short(kp), short(kd));
        match effort_nm {
            Some(effort_nm) => {
                let _ = writeln!(card, "effort_nm = {}", short(effort_nm));
            }
            None => card.push_str("# effort_nm = 50.0  # missing in the file: the greatest torque (N·m)\n"),
        }
        let _ = writeln!(card, "armature_kgm2 = {}", short(armature_kgm2));
        if keyframe.is_none() {
            let _ = writeln!(card, "default_rad = {}", short(default_rad));
        }
    }
    card
}

/// Returns a rule for each hinge; two hinges whose names differ only in their side and that have equal numbers share one.
fn rules(model: &Model) -> Vec<(String, Numbers)> {
    let mut found: Vec<(String, Numbers)> = Vec::new();
    let all: Vec<Numbers> = (0..model.hinges.len()).map(|hinge| numbers(model, hinge)).collect();
    let mut of_pattern: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (index, hinge) in model.hinges.iter().enumerate() {
        of_pattern.entry(without_side(&hinge.name)).or_default().push(index);
    }
    for (index, hinge) in model.hinges.iter().enumerate() {
        let pattern = without_side(&hinge.name);
        let members = &of_pattern[&pattern];
        let others_match = model.hinges.iter().enumerate().any(|(other, other_hinge)| {
            !members.contains(&other) && super::apply::matches(&pattern, &other_hinge.name)
        });
        let alike = members.iter().all(|member| all[*member].is_like(&all[members[0]]));
        if members.len() > 1 && alike && !others_match {
            if members[0] == index {
                found.push((pattern, all[index].clone()));
            }
        } else {
            found.push((hinge.name.clone(), all[index].clone()));
        }
    }
    found
}

impl Numbers {
    /// Returns whether two rules may share one: the sides of a robot differ by rounding.
    fn is_like(&self, other: &Self) -> bool {
        let near = |one: f64, other: f64| (one - other).abs() <= 2e-3 * one.abs().max(other.abs());
        near(self.kp, other.kp)
            && near(self.kd, other.kd)
            && near(self.effort_nm.unwrap_or(0.0), other.effort_nm.unwrap_or(0.0))
            && near(self.armature_kgm2, other.armature_kgm2)
            && near(self.default_rad, other.default_rad)
            && self.is_proposed == other.is_proposed
            && near(self.of_joint, other.of_joint)
    }
}

fn numbers(model: &Model, index: usize) -> Numbers {
    let hinge: &Hinge = &model.hinges[index];
    let motor = model.motors.iter().find(|motor| motor.hinge == index);
    let effort_nm = model.effort_nm(index);
    let common = Numbers {
        kp: 0.0,
        kd: 0.0,
        effort_nm,
        armature_kgm2: hinge.armature_kgm2,
        default_rad: 0.0f64.clamp(hinge.min_rad, hinge.max_rad),
        is_proposed: false,
        of_joint: hinge.damping_nmsprad,
    };
    if let Some(servo) = motor.filter(|motor| motor.bias[1] != 0.0) {
        let square = servo.gear_nm * servo.gear_nm;
        return Numbers { kp: -servo.bias[1] * square, kd: -servo.bias[2] * square, ..common };
    }
    let (armature_kgm2, rate_radps) = (hinge.armature_kgm2, TAU * FREQUENCY_HZ);
    let kp = match (armature_kgm2 > 0.0, effort_nm) {
        // Files without a real limit name an enormous one.
        (false, Some(effort_nm)) => effort_nm.min(model.mass_kg() * WEIGHT_NMPKG) * STIFFNESS_PER_EFFORT,
        (has_rotor, _) => (if has_rotor { armature_kgm2 } else { ARMATURE_KGM2 }) * rate_radps * rate_radps,
    };
    let kd = match armature_kgm2 > 0.0 {
        true => 2.0 * DAMPING_RATIO * armature_kgm2 * rate_radps,
        false => kp * DAMPING_PER_STIFFNESS_S,
    };
    let armature_kgm2 = if armature_kgm2 > 0.0 { armature_kgm2 } else { ARMATURE_KGM2 };
    Numbers { kp, kd, armature_kgm2, is_proposed: true, ..common }
}

/// Returns the links at the ends of the tree that may touch the ground and have the name of a foot.
fn feet(model: &Model) -> Vec<&str> {
    let on_ground = |body: usize| model.pairs.iter().any(|pair| pair.second.is_none() && pair.first.body == body);
    let is_named_foot =
        |name: &str| ["foot", "ank", "sole", "toe"].iter().any(|part| name.to_lowercase().contains(part));
    let is_leaf = |body: usize| !model.bodies.iter().any(|other| other.parent == Some(body));
    let candidates: Vec<&str> = (0..model.bodies.len())
        .filter(|body| on_ground(*body) && is_leaf(*body))
        .filter_map(|body| {
            let own = model.links.iter().filter(|link| link.body == body && !link.shapes.is_empty());
            own.map(|link| link.name.as_str()).find(|name| is_named_foot(name))
        })
        .collect();
    candidates
}

/// Returns a name with its side replaced by `*`.
fn without_side(name: &str) -> String {
    for [left, right] in [["left", "right"], ["Left", "Right"], ["LEFT", "RIGHT"]] {
        for side in [left, right] {
            if let Some((before, after)) = name.split_once(side) {
                return format!("{before}*{after}");
            }
        }
    }
    for [start, end] in [["l_", "_l"], ["r_", "_r"], ["L_", "_L"], ["R_", "_R"]] {
        if let Some(after) = name.strip_prefix(start) {
            return format!("*_{after}");
        }
        if let Some(before) = name.strip_suffix(end) {
            return format!("{before}_*");
        }
    }
    name.to_owned()
}

fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

/// Returns a number with at most five digits after the first.
fn short(number: f64) -> String {
    let rounded: f64 = format!("{number:.5e}").parse().unwrap_or(number);
    format!("{rounded:?}")
}
