//! A card applied to a model.

use std::collections::HashSet;

use super::{HingeRule, RobotCard, SelfContacts};
use crate::error::ModelError;
use crate::model::{Hinge, HingeControl, Model, Motor, Pair, Robot, ShapeIndex, counterpart};

/// Share of the greatest torque that one unit of an action asks for, at rest.
const ACTION_SHARE: f64 = 0.25;
/// Greatest change of a target, in units of an action: all of the torque.
const ACTION_MAX: f64 = 4.0;
/// Most rules, and most pairs of symmetry: a card comes from another machine, too.
const RULES_MAX: usize = 4096;
const PAIRS_MAX: usize = 64;
/// Longest pattern of names (bytes).
const PATTERN_BYTES_MAX: usize = 256;
/// Largest magnitude of a number, and least stiffness other than 0: targets and torques must stay finite.
const NUMBER_MAX: f64 = 1e6;
const STIFFNESS_MIN: f64 = 1e-6;

fn refuse<T>(problem: String) -> Result<T, ModelError> {
    Err(ModelError::Card(problem))
}

impl RobotCard {
    /// Replaces the motors of a model by one servo for each hinge that is not held, in the order of the hinges, and sets
    /// [`Model::robot`].
    ///
    /// # Errors
    /// [`ModelError`] names a body, keyframe, hinge or pattern that the model does not have, or a number that is impossible.
    pub fn apply(&self, model: &mut Model) -> Result<(), ModelError> {
        if let Some(base) = &self.base
            && *base != model.links[0].name
        {
            return refuse(format!("`base` is `{base}`, but the free joint belongs to `{}`", model.links[0].name));
        }
        self.check_bounds()?;
        let link = |key: &str, name: &String| {
            let found = model.links.iter().position(|link| link.name == *name);
            found.ok_or_else(|| ModelError::Card(format!("`{key}`: the model has no body `{name}`")))
        };
        let feet = self.feet.iter().map(|foot| link("feet", foot)).collect::<Result<Vec<usize>, ModelError>>()?;
        let pair = |[one, other]: &[String; 2]| Ok([link("exclude", one)?, link("exclude", other)?]);
        let mut excluded = self.exclude.iter().map(pair).collect::<Result<Vec<[usize; 2]>, ModelError>>()?;
        let rules = self.rules_of_hinges(&model.hinges)?;
        if let (SelfContacts::Legs, [left, right]) = (self.self_contacts, &feet[..]) {
            excluded.extend(but_of_legs(model, [*left, *right]));
        }
        exclude(model, &mut excluded);
        model.turn_base(self.forward);
        let mut position = self.position(model)?;
        self.check_symmetry(&model.hinges)?;
        self.check_motors(&model.hinges)?;
        let mut robot = Robot {
            forward: self.forward,
            feet,
            excluded,
            symmetry: self.symmetry.clone(),
            motors: self.motors.clone(),
            default_position: Vec::new(),
            hinges: Vec::new(),
        };
        let mut motors = Vec::new();
        for (index, rule) in rules.iter().enumerate() {
            let control = control(model, index, rule)?;
            let hinge = &mut model.hinges[index];
            if let Some(angle_rad) = rule.default_rad
                && hinge.overshoot_rad(angle_rad) > 1e-6
            {
                let range = format!("{:.4} to {:.4}", hinge.min_rad, hinge.max_rad);
                let problem = format!("`default_rad` is {angle_rad}, outside of its range, {range}");
                return refuse(format!("hinge `{}`: {problem}", hinge.name));
            }
            let angle_rad = &mut position[7 + index];
            // Keyframes may be a little outside.
            *angle_rad = rule.default_rad.unwrap_or(*angle_rad).max(hinge.min_rad).min(hinge.max_rad);
            hinge.armature_kgm2 = rule.armature_kgm2.unwrap_or(hinge.armature_kgm2);
            if control.is_held {
                hinge.damping_nmsprad += control.kd;
                // A hinge without a servo keeps its spring.
                if control.kp > 0.0 {
                    (hinge.stiffness_nmprad, hinge.rest_rad) = (control.kp, *angle_rad);
                    hinge.stiffness_powers = [0.0; 2];
                }
            } else {
                motors.push(servo(index, hinge, *angle_rad, &control));
            }
            robot.hinges.push(control);
        }
        if motors.is_empty() {
            return refuse("every hinge is held; a policy needs at least one that is not".to_owned());
        }
        // Controls of keyframes belong to the motors of the text.
        model.keyframes.iter_mut().for_each(|key| key.controls = vec![0.0; motors.len()]);
        model.motors = motors;
        robot.default_position = position;
        model.robot = Some(robot);
        Ok(())
    }

    fn check_bounds(&self) -> Result<(), ModelError> {
        for (what, count, most) in [
            ("[[hinges]]", self.rules.len(), RULES_MAX),
            ("symmetry", self.symmetry.len(), PAIRS_MAX),
            ("motors", self.motors.len(), RULES_MAX),
            ("exclude", self.exclude.len(), RULES_MAX),
        ] {
            if count > most {
                return refuse(format!("{what} has {count} entries, but at most {most} are supported"));
            }
        }
        let patterns = self.rules.iter().map(|rule| &rule.names).chain(self.symmetry.iter().flatten());
        match patterns.map(String::len).max() {
            Some(longest) if longest > PATTERN_BYTES_MAX => {
                refuse(format!("a name has {longest} bytes, but at most {PATTERN_BYTES_MAX} are supported"))
            }
            _ => Ok(()),
        }
    }

    fn position(&self, model: &Model) -> Result<Vec<f64>, ModelError> {
        let mut position = match &self.keyframe {
            None => model.nominal_position(),
            Some(name) => {
                let found = model.keyframes.iter().find(|key| key.name == *name);
                let known: Vec<&str> = model.keyframes.iter().map(|key| key.name.as_str()).collect();
                let missing =
                    || ModelError::Card(format!("the model has no keyframe `{name}`; it has: {}", known.join(", ")));
                found.ok_or_else(missing)?.position.clone()
            }
        };
        if let Some(height_m) = self.height_m {
            if !(height_m.is_finite() && height_m > 0.0) {
                return refuse(format!("`height_m` is {height_m}, but must be above 0"));
            }
            position[2] = height_m;
        }
        Ok(position)
    }

    fn check_symmetry(&self, hinges: &[Hinge]) -> Result<(), ModelError> {
        for pair @ [left, right] in &self.symmetry {
            let mut of_left =
                hinges.iter().filter_map(|hinge| counterpart(&hinge.name, pair).filter(|_| matches(left, &hinge.name)));
            let first = of_left.next().ok_or_else(|| {
                ModelError::Card(format!("symmetry [\"{left}\", \"{right}\"]: no hinge is named `{left}`"))
            })?;
            for image in std::iter::once(first).chain(of_left) {
                if !hinges.iter().any(|hinge| hinge.name == image) {
                    return refuse(format!("symmetry [\"{left}\", \"{right}\"]: the model has no hinge `{image}`"));
                }
            }
        }
        Ok(())
    }

    /// Checks that the motors, if there are any, name each hinge once.
    fn check_motors(&self, hinges: &[Hinge]) -> Result<(), ModelError> {
        let named = || self.motors.iter().filter(|name| !name.is_empty());
        if let Some(unknown) = named().find(|name| !hinges.iter().any(|hinge| hinge.name == **name)) {
            return refuse(format!("`motors`: the model has no hinge `{unknown}`"));
        }
        for hinge in hinges.iter().filter(|_| !self.motors.is_empty()) {
            let count = named().filter(|name| **name == hinge.name).count();
            if count != 1 {
                return refuse(format!("`motors` names hinge `{}` {count} times; name each hinge once", hinge.name));
            }
        }
        Ok(())
    }

    /// Returns one rule per hinge, merged from all that match it.
    fn rules_of_hinges(&self, hinges: &[Hinge]) -> Result<Vec<HingeRule>, ModelError> {
        let mut merged = vec![HingeRule::default(); hinges.len()];
        for rule in &self.rules {
            rule.check()?;
            let mut is_used = false;
            for (of_hinge, _) in merged.iter_mut().zip(hinges).filter(|(_, hinge)| matches(&rule.names, &hinge.name)) {
                is_used = true;
                let HingeRule { names, kp, kd, effort_nm, armature_kgm2, default_rad, action_scale_rad, held } =
                    rule.clone();
                *of_hinge = HingeRule {
                    names,
                    kp: kp.or(of_hinge.kp),
                    kd: kd.or(of_hinge.kd),
                    effort_nm: effort_nm.or(of_hinge.effort_nm),
                    armature_kgm2: armature_kgm2.or(of_hinge.armature_kgm2),
                    default_rad: default_rad.or(of_hinge.default_rad),
                    action_scale_rad: action_scale_rad.or(of_hinge.action_scale_rad),
                    held: held.or(of_hinge.held),
                };
            }
            if !is_used {
                let known: Vec<&str> = hinges.iter().map(|hinge| hinge.name.as_str()).collect();
                let known = known.join(", ");
                return refuse(format!("names = \"{}\" matches no hinge of the model; it has: {known}", rule.names));
            }
        }
        Ok(merged)
    }
}

impl HingeRule {
    fn check(&self) -> Result<(), ModelError> {
        for (key, value, least) in [
            ("kp", self.kp, 0.0),
            ("kd", self.kd, 0.0),
            ("effort_nm", self.effort_nm, f64::MIN_POSITIVE),
            ("armature_kgm2", self.armature_kgm2, 0.0),
            ("default_rad", self.default_rad, f64::MIN),
            ("action_scale_rad", self.action_scale_rad, f64::MIN_POSITIVE),
        ] {
            if let Some(value) = value.filter(|value| !(value.abs() <= NUMBER_MAX && *value >= least)) {
                let wanted = match least {
                    0.0 => "0 to 1e6",
                    f64::MIN => "-1e6 to 1e6",
                    _ => "above 0, up to 1e6",
                };
                return refuse(format!("hinges \"{}\": `{key}` is {value}, but must be {wanted}", self.names));
            }
        }
        Ok(())
    }
}

/// Returns the pairs of links that are not one of the left and one of the right leg.
pub(super) fn but_of_legs(model: &Model, feet: [usize; 2]) -> Vec<[usize; 2]> {
    let path = |link: usize| -> Vec<usize> { model.upward(model.links[link].body).collect() };
    let paths = feet.map(path);
    // The body below the one that both legs hang on.
    let hips = [0, 1].map(|leg: usize| paths[leg].iter().copied().rfind(|body| !paths[1 - leg].contains(body)));
    let leg = |link: usize| hips.iter().position(|hip| hip.is_some_and(|hip| path(link).contains(&hip)));
    let legs: Vec<Option<usize>> = (0..model.links.len()).map(leg).collect();
    let of_both =
        |[one, other]: &[usize; 2]| matches!((legs[*one], legs[*other]), (Some(one), Some(other)) if one != other);
    let links = 0..model.links.len();
    links.flat_map(|link| (0..link).map(move |other| [other, link])).filter(|pair| !of_both(pair)).collect()
}

/// Removes the pairs of shapes that belong to these pairs of links, and keeps those of `excluded` that had any.
fn exclude(model: &mut Model, excluded: &mut Vec<[usize; 2]>) {
    if excluded.is_empty() {
        return;
    }
    let mut had = HashSet::new();
    let wanted: HashSet<[usize; 2]> =
        excluded.iter().flat_map(|[one, other]| [[*one, *other], [*other, *one]]).collect();
    let pairs = std::mem::take(&mut model.pairs);
    let mut touches = |pair: &Pair| {
        let link = |of: ShapeIndex| model.link_of_shape(of.body, of.shape);
        let links = pair.second.and_then(|second| Some([link(pair.first)?, link(second)?]));
        let Some([one, other]) = links.filter(|links| wanted.contains(links)) else { return true };
        had.insert([one.min(other), one.max(other)]);
        false
    };
    model.pairs = pairs.into_iter().filter(&mut touches).collect();
    excluded.retain(|[one, other]| had.contains(&[*one.min(other), *one.max(other)]));
}

/// Returns the servo of a hinge: of the card, or else of the model's motor.
fn control(model: &Model, hinge: usize, rule: &HingeRule) -> Result<HingeControl, ModelError> {
    let name = &model.hinges[hinge].name;
    let missing =
        |what: &str| ModelError::Card(format!("hinge `{name}` has no {what} in the model; give it in the card"));
    let motor = model.motors.iter().find(|motor| motor.hinge == hinge);
    let servo = motor.filter(|motor| motor.bias[1] != 0.0);
    let gear = motor.map_or(1.0, |motor| motor.gear_nm);
    let kp = rule.kp.or(servo.map(|servo| -servo.bias[1] * gear * gear)).ok_or_else(|| missing("servo: `kp`"))?;
    let kd = rule.kd.or(servo.map(|servo| -servo.bias[2] * gear * gear)).ok_or_else(|| missing("servo: `kd`"))?;
    let effort_nm =
        rule.effort_nm.or_else(|| model.effort_nm(hinge)).ok_or_else(|| missing("limit of torque: `effort_nm`"))?;
    if !(kp == 0.0 || (STIFFNESS_MIN..=NUMBER_MAX).contains(&kp)) {
        return refuse(format!("hinge `{name}`: `kp` is {kp}, but must be 0, or from 1e-6 to 1e6"));
    }
    if !(effort_nm > 0.0 && effort_nm <= NUMBER_MAX) {
        let wanted = "give `effort_nm`, above 0 and up to 1e6";
        return refuse(format!("hinge `{name}`: its effort is {effort_nm} N·m; {wanted}"));
    }
    let is_held = rule.held.unwrap_or(false);
    if rule.action_scale_rad.is_none() && kp == 0.0 && !is_held {
        return refuse(format!("hinge `{name}`: `kp` is 0, so give its `action_scale_rad`"));
    }
    let by_rule = if kp == 0.0 { 0.0 } else { ACTION_SHARE * effort_nm / kp };
    let action_scale_rad = rule.action_scale_rad.unwrap_or(by_rule);
    Ok(HingeControl { kp, kd, effort_nm, action_scale_rad, is_held })
}

/// Returns a position servo whose targets surround the default angle.
fn servo(index: usize, hinge: &Hinge, default_rad: f64, control: &HingeControl) -> Motor {
    let HingeControl { kp, kd, effort_nm, action_scale_rad, .. } = *control;
    let most_rad = ACTION_MAX * action_scale_rad;
    Motor {
        name: hinge.name.clone(),
        hinge: index,
        gear_nm: 1.0,
        length_per_rad: 1.0,
        control: [default_rad - most_rad, default_rad + most_rad],
        gain: kp,
        bias: [0.0, -kp, -kd],
        force: [-effort_nm, effort_nm],
    }
}

/// Returns whether a name matches a pattern, in which `*` stands for any letters.
pub(super) fn matches(pattern: &str, name: &str) -> bool {
    let Some((first, rest)) = pattern.split_once('*') else { return pattern == name };
    let Some(mut left) = name.strip_prefix(first) else { return false };
    let (between, last) = rest.rsplit_once('*').unwrap_or(("", rest));
    for part in between.split('*') {
        // The first place leaves most for the other parts.
        let Some(place) = left.find(part) else { return false };
        left = &left[place + part.len()..];
    }
    left.ends_with(last)
}

#[cfg(test)]
mod tests {
    use super::matches;

    #[test]
    fn a_star_stands_for_any_letters() {
        for (pattern, name) in
            [("a", "a"), ("*", ""), ("*_knee", "left_knee"), ("l*_k*e", "left_knee"), ("**é", "éé"), ("*", "a")]
        {
            assert!(matches(pattern, name), "{pattern} {name}");
        }
        for (pattern, name) in [("a", "ab"), ("", "a"), ("*_knee", "left_knee_joint"), ("l*t", "lef"), ("b*", "ab")] {
            assert!(!matches(pattern, name), "{pattern} {name}");
        }
    }
}
