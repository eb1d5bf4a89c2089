//! Card that is found from a model alone: its feet, legs, home pose and servos, each with its reason.

mod gains;
mod legs;
mod pose;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use nalgebra::Vector3;

use self::gains::{Confidence, Reasoned, Servo};
use self::legs::Legs;
use crate::config::PhysicsSettings;
use crate::error::ModelError;
use crate::model::{BaseAxis, Model};
use crate::physics::Physics;

/// Cosine of the greatest tilt of a base that stands.
const UPRIGHT: f64 = 0.9;

/// Line of a hinge that no gait moves, and what it becomes for motions. Hinges that follow others stay without a servo.
const HELD: &str = "held = true  # no hinge of a leg";
const FREED: &str = "action_scale_rad = 0.25  # guess: motions move it by a radian";

/// What gaits scale with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodySize {
    /// Height of the hips above the ground in the default pose (m).
    pub leg_length_m: f64,
    /// Weight (N).
    pub weight_n: f64,
}

impl BodySize {
    /// Returns the size of a robot with a card.
    ///
    /// # Errors
    /// [`ModelError`] if it cannot be simulated, or does not stand on two legs in its default pose.
    pub fn of(model: &Model) -> Result<Self, ModelError> {
        let mut physics = Physics::new(model.clone(), PhysicsSettings::default())?;
        let legs = match &model.robot {
            None => Legs::of(&physics),
            Some(robot) => {
                physics.set_state(&robot.default_position, &vec![0.0; model.velocity_size()]);
                match robot.feet[..] {
                    [left, right] => Legs::with_feet(&physics, [left, right]),
                    _ => Legs::of(&physics),
                }
            }
        };
        let legs = legs.map_err(ModelError::Card)?;
        Ok(Self { leg_length_m: legs.hip_height_m, weight_n: model.mass_kg() * model.gravity_mps2.norm() })
    }
}

/// Card of a model, without the path of a file.
pub struct Proposal {
    /// TOML text. Comments have the reasons.
    pub card: String,
    /// What could not be found, each with the key that asks for it.
    pub missing: Vec<String>,
}

impl Proposal {
    /// Returns the card for a robot that moves all hinges that can have a servo, and all of whose parts may meet: for
    /// motions.
    #[must_use]
    pub fn moving_all(mut self) -> Self {
        let freed = |line| match line {
            line if str::starts_with(line, HELD) => FREED,
            line => line,
        };
        let lines = self.card.lines().filter(|line| !line.starts_with("self_contacts = "));
        self.card = lines.map(freed).flat_map(|line| [line, "\n"]).collect();
        self
    }

    /// Finds the card of a model. With two legs, the policy moves these, and all other hinges are held.
    ///
    /// # Errors
    /// [`ModelError`] if the model cannot be simulated.
    pub fn of(model: &Model) -> Result<Self, ModelError> {
        let (mut physics, mut chosen) = at_start(model.clone())?;
        let mut legs = Legs::of(&physics);
        let mut card = String::new();
        let mut missing = Vec::new();
        let _ = writeln!(card, "base = {}", quoted(&model.links[0].name));
        let forward = legs.as_ref().map_or(BaseAxis::X, |legs| legs.forward(&physics));
        if let Some((_, name)) = BaseAxis::ALL.iter().find(|(axis, _)| *axis == forward && forward != BaseAxis::X) {
            let _ = writeln!(card, "forward = {}  # likely: by the places of its left and right foot", quoted(name));
            let mut turned = model.clone();
            turned.turn_base(forward);
            (physics, chosen) = at_start(turned)?;
            legs = Legs::of(&physics);
        }
        let model = &physics.model().clone();
        let keyframe = chosen.map(|index| &model.keyframes[index]);
        let start = physics.position().to_vec();
        let (servos, defaults): (Vec<Servo>, Option<Vec<f64>>) = match &legs {
            Ok(legs) => {
                let feet = legs.feet.map(|foot| quoted(&model.links[foot].name));
                let _ =
                    writeln!(card, "feet = [{}]  # likely: the lowest parts of two legs, left first", feet.join(", "));
                let home = pose::home(&mut physics, legs, keyframe.map(|key| key.name.as_str()));
                if let Some(key) = keyframe {
                    let _ = writeln!(card, "keyframe = {}", quoted(&key.name));
                }
                let height_m = home.position[2];
                let _ = writeln!(card, "height_m = {}  # likely: {}", short(height_m), home.reason);
                if height_m <= 0.0 {
                    let base = &model.links[0].name;
                    missing.push(format!(
                        "its base `{base}` is at or below the ground in the default pose; give the root's frame the place of \
                         the pelvis"
                    ));
                }
                card.push_str("self_contacts = \"legs\"  # guess: other parts do not meet in a walk\n");
                let together: BTreeSet<_> = super::apply::but_of_legs(model, legs.feet).into_iter().collect();
                let mut overlapping = overlapping(&physics, &home.position)?;
                overlapping.retain(|pair| !together.contains(pair));
                if !overlapping.is_empty() {
                    let pairs = overlapping
                        .iter()
                        .map(|pair| format!("[{}]", pair.map(|link| quoted(&model.links[link].name)).join(", ")));
                    let pairs = pairs.collect::<Vec<_>>().join(", ");
                    let _ = writeln!(card, "exclude = [{pairs}]  # likely: their shapes overlap in the default pose");
                }
                let stands = Legs::of(&physics).unwrap_or_else(|_| legs.clone());
                let servos = (0..model.hinges.len()).map(|hinge| gains::of_walker(&physics, &stands, hinge)).collect();
                (servos, Some(home.position[7..].to_vec()))
            }
            Err(why) => {
                let _ = writeln!(card, "# feet = [\"left_foot\", \"right_foot\"]  # not found: {why}");
                missing.push(format!("its feet cannot be found, since {why}: name them, `feet` of the card"));
                match keyframe {
                    Some(key) => {
                        let _ = writeln!(card, "keyframe = {}", quoted(&key.name));
                    }
                    None if start[2] > 0.0 => {
                        let _ = writeln!(card, "height_m = {}", short(start[2]));
                    }
                    None => card.push_str("# height_m = 1.0  # missing in the file: the height of the root (m)\n"),
                }
                let defaults = keyframe.is_none().then(|| start[7..].to_vec());
                ((0..model.hinges.len()).map(|hinge| gains::of_any(model, hinge)).collect(), defaults)
            }
        };
        let default_rad = |hinge: usize| {
            let of = &model.hinges[hinge];
            defaults.as_ref().map(|angles| angles[hinge].max(of.min_rad).min(of.max_rad))
        };
        let rules: Vec<Rule> =
            servos.into_iter().enumerate().map(|(hinge, servo)| (servo, default_rad(hinge))).collect();
        write_rules(&mut card, model, &rules);
        Ok(Self { card, missing })
    }

    /// Returns the card for a model whose file is `file`, to be edited.
    #[must_use]
    pub fn draft(&self, file: &str) -> String {
        format!("model = {}\n{}", quoted(file), self.card)
    }
}

/// Returns the pairs of links that press on each other in a pose.
fn overlapping(physics: &Physics, position: &[f64]) -> Result<Vec<[usize; 2]>, ModelError> {
    // So short that nothing moves.
    let settings = PhysicsSettings { control_step_s: 1e-3, substeps: 1, self_collision: true };
    let model = physics.model();
    let mut still = Physics::new(model.clone(), settings)?;
    still.set_state(position, &vec![0.0; model.velocity_size()]);
    // A state that cannot be simulated has no contacts, and is found again when the robot is examined.
    let _ = still.step_only(&vec![0.0; model.motors.len()]);
    let pressing = still.contact_points().filter(|contact| contact.force_n.norm() > 0.0);
    let pairs = pressing.filter_map(|contact| {
        let [one, other] = [contact.links[0]?, contact.links[1]?];
        Some([one.min(other), one.max(other)])
    });
    Ok(pairs.collect::<BTreeSet<_>>().into_iter().collect())
}

/// Returns the simulation of a model in the first keyframe in which it stands on bent legs, else in the first one in which
/// it stands, or else in the pose of the text; with the number of that keyframe.
fn at_start(model: Model) -> Result<(Physics, Option<usize>), ModelError> {
    let rest = vec![0.0; model.velocity_size()];
    let mut physics = Physics::new(model, PhysicsSettings::default())?;
    let positions: Vec<Vec<f64>> = physics.model().keyframes.iter().map(|key| key.position.clone()).collect();
    let nominal = physics.model().nominal_position();
    // Whether the robot stands on two legs, and whether these are bent.
    let mut stands = |position: &[f64]| {
        physics.set_state(position, &rest);
        let up = physics.body_motion(0).pose.rotation * Vector3::z_axis();
        let legs = Legs::of(&physics).ok().filter(|_| up.z > UPRIGHT)?;
        Some(pose::is_bent(&physics, &legs))
    };
    let standing: Vec<Option<bool>> = positions.iter().map(|position| stands(position)).collect();
    let bent = standing.iter().position(|found| *found == Some(true));
    let upright = bent.or_else(|| standing.iter().position(Option::is_some));
    let chosen = match upright {
        None if stands(&nominal).is_some() || positions.is_empty() => None,
        upright => upright.or(Some(0)),
    };
    let start = chosen.map_or(nominal, |index| positions[index].clone());
    physics.set_state(&start, &rest);
    Ok((physics, chosen))
}

/// Servo of a hinge, and its angle in the default pose, unless a keyframe has it (rad).
type Rule = (Servo, Option<f64>);

fn write_rules(card: &mut String, model: &Model, rules: &[Rule]) {
    for (names, at) in named(model, rules) {
        let (servo, default_rad) = &rules[at];
        let _ = writeln!(card, "\n[[hinges]]\nnames = {}", quoted(&names));
        line(card, "kp", &servo.kp);
        line(card, "kd", &servo.kd);
        match &servo.effort_nm {
            Some(effort_nm) => line(card, "effort_nm", effort_nm),
            None => card.push_str("# effort_nm = 50.0  # missing in the file: the greatest torque (N·m)\n"),
        }
        line(card, "armature_kgm2", &servo.armature_kgm2);
        if let Some(scale) = &servo.action_scale_rad {
            line(card, "action_scale_rad", scale);
        }
        if let Some(default_rad) = default_rad {
            // Smaller digits are errors of the solver.
            let _ = writeln!(card, "default_rad = {}", short((default_rad * 1e6).round() / 1e6 + 0.0));
        }
        if let Some(why) = &servo.held {
            let _ = writeln!(card, "held = true  # {why}");
        }
    }
}

fn line(card: &mut String, key: &str, value: &Reasoned) {
    let word = match value.confidence {
        Confidence::Sure => "sure",
        Confidence::Likely => "likely",
        Confidence::Guess => "guess",
    };
    let _ = writeln!(card, "{key} = {}  # {word}: {}", short(value.number), value.reason);
}

/// Returns the names of each rule, and a hinge that it is of; two hinges whose names differ only in their side and that have
/// equal numbers share one.
fn named(model: &Model, rules: &[Rule]) -> Vec<(String, usize)> {
    let mut found = Vec::new();
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
        let alike = members.iter().all(|member| are_alike(&rules[*member], &rules[members[0]]));
        if members.len() > 1 && alike && !others_match {
            if members[0] == index {
                found.push((pattern, index));
            }
        } else {
            found.push((hinge.name.clone(), index));
        }
    }
    found
}

/// Returns whether two rules may share one: the sides of a robot differ by rounding.
fn are_alike((one, one_rad): &Rule, (other, other_rad): &Rule) -> bool {
    let near = |one: f64, other: f64| (one - other).abs() <= 2e-3 * one.abs().max(other.abs());
    let number = |value: &Option<Reasoned>| value.as_ref().map_or(0.0, |value| value.number);
    let angles = (one_rad.unwrap_or(0.0), other_rad.unwrap_or(0.0));
    near(one.kp.number, other.kp.number)
        && near(one.kd.number, other.kd.number)
        && near(number(&one.effort_nm), number(&other.effort_nm))
        && near(one.armature_kgm2.number, other.armature_kgm2.number)
        && (near(angles.0, angles.1) || (angles.0 - angles.1).abs() < 1e-4)
        && one.held.is_some() == other.held.is_some()
        && one.kp.confidence == other.kp.confidence
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
