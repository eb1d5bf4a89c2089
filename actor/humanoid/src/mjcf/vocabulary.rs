//! Supported MJCF elements and attributes, and the values that each may have.
//!
//! Everything else is refused. Names and defaults are those of MuJoCo's XML reference
//! (<https://mujoco.readthedocs.io/en/stable/XMLreference.html>).

use super::element::{Element, numbers};
use crate::error::ModelError;
use crate::model::HEIGHT_FIELD_SIDE_MAX;

/// Most vertices of a mesh.
const MESH_VERTICES_MAX: usize = 4096;

/// Values that an attribute may have.
#[derive(Clone, Copy, Debug)]
pub(super) enum AttributeRule {
    /// Anything: no motion depends on it.
    Inert,
    /// A name, checked where it is used.
    Word,
    /// One of these keywords, separated by `|`.
    Choice(&'static str),
    /// Finite numbers; smallest and largest count.
    Numbers(usize, usize),
    /// Whole numbers; smallest and largest count.
    Whole(usize, usize),
    /// One of these values, separated by `|`, under which it has no effect; others are not simulated.
    Only(&'static str),
}

use AttributeRule::{Choice, Inert, Numbers, Only, Whole, Word};

/// Keywords of flags.
const BOOLEAN: AttributeRule = Choice("true|false|1|0");
const LIMITED: AttributeRule = Choice("true|false|auto|1|0");

/// Attribute names, separated by spaces, and their common rule.
type Rules = [(&'static str, AttributeRule)];

/// Attributes that give an orientation; an element may have at most one.
pub(super) const ORIENTATIONS: [&str; 5] = ["quat", "axisangle", "xyaxes", "zaxis", "euler"];

const PLACE: &Rules =
    &[("pos zaxis euler", Numbers(3, 3)), ("quat axisangle", Numbers(4, 4)), ("xyaxes", Numbers(6, 6))];

const NAMED: &Rules = &[("name class", Word), ("group", Whole(1, 1)), ("user", Inert)];

const COMPILER: &Rules = &[
    ("autolimits balanceinertia strippath discardvisual exactmeshinertia convexhull", BOOLEAN),
    ("angle", Choice("degree|radian")),
    ("inertiafromgeom", Choice("true|false|auto")),
    ("eulerseq", Word),
    ("boundmass boundinertia settotalmass", Numbers(1, 1)),
    ("coordinate", Only("local")),
    ("inertiagrouprange", Whole(2, 2)),
    ("alignfree", Only("false")),
    ("fitaabb meshdir texturedir assetdir usethread fusestatic saveinertial", Inert),
];

/// Most solver settings of MuJoCo are inert: they do not apply to this crate's solvers.
const OPTION: &Rules = &[
    ("gravity", Numbers(3, 3)),
    ("wind", Only("0 0 0")),
    ("density viscosity", Only("0")),
    ("solver", Choice("Newton|CG|PGS")),
    ("timestep", Numbers(1, 1)),
    ("collision", Only("all")),
    ("magnetic apirate impratio integrator cone jacobian iterations tolerance", Inert),
    ("ls_iterations ls_tolerance noslip_iterations noslip_tolerance mpr_iterations mpr_tolerance", Inert),
    ("ccd_iterations ccd_tolerance sleep_tolerance sdf_iterations sdf_initpoints", Inert),
];

const FLAG: &Rules = &[
    ("constraint equality frictionloss limit contact passive spring damper gravity clampctrl", Only("enable")),
    ("filterparent actuation", Only("enable")),
    ("override", Only("disable")),
    ("warmstart refsafe sensor midphase nativeccd eulerdamp autoreset energy fwdinv invdiscrete", Inert),
    ("multiccd island sleep sensornoise", Inert),
];

const BODY: &Rules =
    &[("name childclass", Word), ("mocap", Only("false")), ("gravcomp", Numbers(1, 1)), ("user sleep", Inert)];

const INERTIAL: &Rules = &[("mass", Numbers(1, 1)), ("diaginertia", Numbers(3, 3)), ("fullinertia", Numbers(6, 6))];

const JOINT: &Rules = &[
    ("type", Choice("hinge|free|slide|ball")),
    ("limited actuatorfrclimited", LIMITED),
    ("pos axis", Numbers(3, 3)),
    ("range actuatorfrcrange springdamper", Numbers(2, 2)),
    ("actuatorgravcomp", Only("false")),
    ("solreflimit solreffriction", Numbers(1, 2)),
    ("solimplimit solimpfriction", Numbers(1, 5)),
    ("ref springref armature frictionloss margin", Numbers(1, 1)),
    ("stiffness damping", Numbers(1, 3)),
];

const FREEJOINT: &Rules = &[("name", Word), ("group", Inert), ("align", Only("false|auto"))];

const GEOM: &Rules = &[
    ("type", Choice("plane|hfield|sphere|capsule|ellipsoid|cylinder|box|mesh|sdf")),
    ("mesh hfield", Word),
    ("size friction", Numbers(1, 3)),
    ("fromto", Numbers(6, 6)),
    // In MuJoCo 4.0 contacts within a gap beyond the margin are seen, but without force.
    ("mass density margin gap solmix", Numbers(1, 1)),
    ("shellinertia", BOOLEAN),
    ("contype conaffinity condim priority", Whole(1, 1)),
    ("solref", Numbers(1, 2)),
    ("solimp", Numbers(1, 5)),
    // No effect without a fluid.
    ("fluidshape fluidcoef", Inert),
    ("rgba", Numbers(4, 4)),
    ("fitscale material", Inert),
];

const ACTUATOR: &Rules = &[
    ("joint", Word),
    ("ctrllimited forcelimited", LIMITED),
    ("gear", Numbers(1, 6)),
    ("ctrlrange forcerange", Numbers(2, 2)),
    ("armature", Numbers(1, 1)),
    ("damping", Numbers(1, 3)),
    ("delay nsample", Only("0")),
    ("actlimited", Only("false|auto")),
    ("actearly", Only("false")),
    // For muscles.
    ("lengthrange", Inert),
];

const POSITION: &Rules = &[("kp kv dampratio inheritrange", Numbers(1, 1)), ("timeconst", Only("0"))];
const VELOCITY: &Rules = &[("kv", Numbers(1, 1))];
const GENERAL: &Rules = &[
    ("gaintype", Only("fixed")),
    ("biastype", Only("none|affine")),
    ("dyntype", Only("none")),
    ("gainprm biasprm", Numbers(1, 10)),
    ("dynprm", Inert),
];

/// Only tendons without stiffness, friction and motor are accepted.
const FIXED: &Rules = &[
    ("limited", LIMITED),
    ("stiffness damping frictionloss armature", Only("0")),
    ("range", Numbers(2, 2)),
    ("solreflimit", Numbers(1, 2)),
    ("solimplimit", Numbers(1, 5)),
    ("margin", Numbers(1, 1)),
    ("actuatorfrclimited actuatorfrcrange springlength solreffriction solimpfriction", Inert),
    ("width material rgba", Inert),
];

const PAIR: &Rules = &[
    ("name class geom1 geom2", Word),
    ("condim", Whole(1, 1)),
    ("friction", Numbers(1, 5)),
    ("solref", Numbers(1, 2)),
    ("solimp", Numbers(1, 5)),
    ("margin gap", Numbers(1, 1)),
    ("solreffriction", Only("0 0")),
];

const EQUALITY: &Rules =
    &[("name class", Word), ("active", BOOLEAN), ("solref", Numbers(1, 2)), ("solimp", Numbers(1, 5))];
const COUPLING: &Rules = &[("joint1 joint2", Word), ("polycoef", Numbers(1, 5))];
const CONNECTION: &Rules = &[("body1 body2 site1 site2", Word), ("anchor", Numbers(3, 3))];

/// Meshes with vertices in the text; others are ignored.
const MESH: &Rules = &[
    ("name class", Word),
    ("vertex", Numbers(12, 3 * MESH_VERTICES_MAX)),
    ("scale refpos", Numbers(3, 3)),
    ("refquat", Numbers(4, 4)),
    ("inertia", Only("convex|exact|legacy|shell")),
    ("maxhullvert", Only("-1")),
    ("face", Whole(3, 6 * MESH_VERTICES_MAX)),
    ("normal texcoord smoothnormal content_type material octree_maxdepth", Inert),
    // Beside vertices MuJoCo refuses these; in a class they hold for other meshes.
    ("file builtin params", Inert),
];

const HFIELD: &Rules = &[
    ("name", Word),
    ("nrow ncol", Whole(1, 1)),
    ("size", Numbers(4, 4)),
    ("elevation", Numbers(4, HEIGHT_FIELD_SIDE_MAX * HEIGHT_FIELD_SIDE_MAX)),
    ("file content_type", Inert),
];

const KEY: &Rules = &[("name qpos qvel ctrl", Word), ("time", Inert)];

/// Returns the rules of an element's attributes; `None` for an unsupported element.
pub(super) fn rules(tag: &str) -> Option<&'static [&'static Rules]> {
    Some(match tag {
        "mujoco" => &[&[("model", Inert)]],
        "compiler" => &[COMPILER],
        "option" => &[OPTION],
        "flag" => &[FLAG],
        "default" => &[&[("class", Word)]],
        "worldbody" | "contact" | "tendon" | "actuator" | "asset" | "keyframe" => &[],
        "body" => &[BODY, PLACE],
        "frame" => &[&[("name childclass", Word)], PLACE],
        "replicate" => &[&[("count", Whole(1, 1)), ("sep", Word), ("offset euler", Numbers(3, 3))]],
        "attach" => &[&[("model body frame prefix", Word)]],
        "inertial" => &[INERTIAL, PLACE],
        "joint" => &[NAMED, JOINT],
        "freejoint" => &[FREEJOINT],
        "geom" => &[NAMED, GEOM, PLACE],
        "motor" => &[NAMED, ACTUATOR],
        "position" => &[NAMED, ACTUATOR, POSITION],
        "velocity" => &[NAMED, ACTUATOR, VELOCITY],
        "general" => &[NAMED, ACTUATOR, GENERAL],
        "exclude" => &[&[("name body1 body2", Word)]],
        "pair" => &[PAIR],
        "equality" => &[EQUALITY],
        "equality/joint" => &[EQUALITY, COUPLING],
        "equality/connect" => &[EQUALITY, CONNECTION],
        "mesh" => &[MESH],
        "hfield" => &[HFIELD],
        "key" => &[KEY],
        "fixed" => &[NAMED, FIXED],
        "term" => &[&[("joint", Word), ("coef", Numbers(1, 1))]],
        _ => return None,
    })
}

/// Returns whether an outermost element is a section that the simulation reads.
pub(super) fn is_section(tag: &str) -> bool {
    "compiler option default asset worldbody contact equality tendon actuator keyframe"
        .split(' ')
        .any(|section| section == tag)
}

/// Returns whether an element, with its content, never affects motion.
pub(super) fn is_inert(tag: &str) -> bool {
    "size visual statistic custom sensor texture material light camera site lengthrange numeric text"
        .split(' ')
        .any(|inert| inert == tag)
}

/// Returns the rule of one attribute.
pub(super) fn rule(tag: &str, attribute: &str) -> Option<AttributeRule> {
    let has_attribute = |(names, _): &&(&str, AttributeRule)| names.split(' ').any(|name| name == attribute);
    rules(tag)?.iter().copied().flatten().find(has_attribute).map(|(_, rule)| *rule)
}

/// Refuses unknown attributes, invalid values, and several orientations; `tag` has the rules.
pub(super) fn check(tag: &str, element: &Element) -> Result<(), ModelError> {
    for (name, value) in &element.attributes {
        let rule = rule(tag, name)
            .ok_or_else(|| element.refused(format!("attribute `{name}` of <{tag}> is not supported")))?;
        allowed(rule, value).map_err(|expected| element.wrong(name, expected))?;
    }
    let mut turned = ORIENTATIONS.into_iter().filter(|name| element.get(name).is_some());
    if let (Some(first), Some(second)) = (turned.next(), turned.next()) {
        return Err(element.refused(format!("give either `{first}` or `{second}`, not both")));
    }
    for (name, count) in [("quat", 4), ("axisangle", 3), ("xyaxes", 3), ("zaxis", 3), ("axis", 3)] {
        if element.list(name).is_some_and(|all| all[..count].iter().all(|number| *number == 0.0)) {
            return Err(element.wrong(name, "a direction other than zero"));
        }
    }
    Ok(())
}

/// Checks a value against a rule; the error describes the accepted values.
pub(super) fn allowed(rule: AttributeRule, value: &str) -> Result<(), String> {
    let several = |least: usize, most: usize, what: &str| {
        let count = if least == most { least.to_string() } else { format!("{least} to {most}") };
        format!("{count} {what} number{}", if most == 1 { "" } else { "s" })
    };
    match rule {
        Inert | Word => Ok(()),
        Numbers(least, most) => match numbers(value) {
            Some(all) if (least..=most).contains(&all.len()) => Ok(()),
            _ => Err(several(least, most, "finite")),
        },
        Whole(least, most) => {
            let all: Option<Vec<i32>> = value.split_whitespace().map(|token| token.parse().ok()).collect();
            match all {
                Some(all) if (least..=most).contains(&all.len()) => Ok(()),
                _ => Err(several(least, most, "whole")),
            }
        }
        Choice(choices) if choices.split('|').any(|choice| choice == value) => Ok(()),
        Choice(choices) => Err(listed(choices.trim_end_matches("|1|0"))),
        Only(choices) if choices.split('|').any(|choice| same(choice, value)) => Ok(()),
        Only(choices) => Err(format!("{}; anything else is not simulated", listed(choices))),
    }
}

/// Returns choices as a list: `a, b or c`.
fn listed(choices: &str) -> String {
    match choices.rsplit_once('|') {
        Some((first, last)) => format!("{} or {last}", first.replace('|', ", ")),
        None => choices.to_owned(),
    }
}

/// Returns whether two values are equal: as numbers if they are numbers, where `found` may omit the last ones.
fn same(wanted: &str, found: &str) -> bool {
    match (numbers(wanted), numbers(found)) {
        (Some(wanted), Some(found)) if !found.is_empty() => found.len() <= wanted.len() && wanted.starts_with(&found),
        _ => wanted == found.trim(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_checked_against_their_rules() {
        assert!(allowed(Numbers(1, 3), "0.1 -2e3").is_ok());
        for wrong in ["", "a", "1 2 3 4", "nan", "1 inf"] {
            assert_eq!(allowed(Numbers(1, 3), wrong).unwrap_err(), "1 to 3 finite numbers", "{wrong}");
        }
        assert!(allowed(Whole(1, 1), "-3").is_ok());
        assert_eq!(allowed(Whole(1, 1), "1.5").unwrap_err(), "1 whole number");
        assert!(allowed(Only("0.02 1"), "2e-2").is_ok());
        assert!(allowed(Only("0.02 1"), "0.02 1.0").is_ok());
        assert!(allowed(Only("0.02 1"), "0.01 1").is_err());
        assert!(allowed(Only("0"), "").is_err());
        assert!(allowed(Only("false|auto"), "auto").is_ok());
        assert!(allowed(Only("false|auto"), "true").unwrap_err().contains("false or auto"));
    }

    #[test]
    fn an_element_has_at_most_one_orientation_and_no_zero_axis() {
        let check = |pairs: &[(&str, &str)]| {
            let attributes = pairs.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
            let part = Element { tag: "body".to_owned(), label: "part".to_owned(), attributes };
            super::check("body", &part).map_err(|why| why.to_string())
        };
        assert!(check(&[("pos", "0 0 0"), ("quat", "0 0 0 1")]).is_ok());
        assert!(check(&[("quat", "1 0 0 0"), ("euler", "0 0 0")]).unwrap_err().contains("not both"));
        assert!(check(&[("quat", "0 0 0 0")]).unwrap_err().contains("quat"));
        assert!(check(&[("axisangle", "0 0 0 90")]).unwrap_err().contains("axisangle"));
        assert!(check(&[("wings", "2")]).unwrap_err().contains("`wings` of <body>"));
    }
}
