//! Checks of a URDF text by name, before it is read as a whole.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use roxmltree::{Document, Node};

use crate::error::ModelError;

/// Attributes that are numbers, and how many each has.
const NUMBERS: [(&str, &str, usize); 14] = [
    ("origin", "xyz rpy", 3),
    ("origin", "quat_xyzw", 4),
    ("axis", "xyz", 3),
    ("mass", "value", 1),
    ("inertia", "ixx ixy ixz iyy iyz izz", 1),
    ("box", "size", 3),
    ("cylinder", "radius length", 1),
    ("capsule", "radius length", 1),
    ("sphere", "radius", 1),
    ("mesh", "scale", 3),
    ("limit", "lower upper effort velocity", 1),
    ("dynamics", "damping friction", 1),
    ("mimic", "multiplier offset", 1),
    ("color", "rgba", 4),
];
/// Elements that others must have.
const NEEDED: [(&str, &str); 6] = [
    ("inertial", "mass"),
    ("inertial", "inertia"),
    ("collision", "geometry"),
    ("visual", "geometry"),
    ("joint", "parent"),
    ("joint", "child"),
];
/// Attributes that elements must have.
const GIVEN: [(&str, &str); 10] = [
    ("joint", "type"),
    ("parent", "link"),
    ("child", "link"),
    ("mass", "value"),
    ("inertia", "ixx ixy ixz iyy iyz izz"),
    ("box", "size"),
    ("cylinder", "radius length"),
    ("capsule", "radius length"),
    ("sphere", "radius"),
    ("mesh", "filename"),
];
/// Shapes, which are within a `<geometry>`.
const SHAPES: [&str; 5] = ["box", "cylinder", "capsule", "sphere", "mesh"];
/// Types of joints.
const TYPES: [&str; 7] = ["fixed", "revolute", "continuous", "prismatic", "floating", "planar", "spherical"];
/// Elements within links and joints that are not read.
const UNREAD: [&str; 3] = ["texture", "safety_controller", "calibration"];
/// Children of `<robot>` whose content is read.
const READ: [&str; 4] = ["link", "joint", "material", "mujoco"];

/// Refuses numbers that are none, missing elements, and names that are missing or given twice.
pub(super) fn check(document: &Document<'_>, file: &Path) -> Result<(), ModelError> {
    let root = document.root_element();
    refuse_xacro(document, file)?;
    let mut names = BTreeSet::new();
    for part in root.children().filter(|node| node.has_tag_name("link") || node.has_tag_name("joint")) {
        let tag = part.tag_name().name();
        let Some(name) = part.attribute("name").filter(|name| !name.is_empty()) else {
            return Err(ModelError::unsupported(tag, format!("a <{tag}> of the URDF has no `name`")));
        };
        let label = format!("{tag} {name}");
        if !names.insert(label.clone()) {
            return Err(ModelError::unsupported(&label, "there are two of this name"));
        }
        for node in part.descendants().filter(Node::is_element) {
            check_element(node, &label)?;
        }
    }
    Ok(())
}

fn check_element(node: Node<'_, '_>, label: &str) -> Result<(), ModelError> {
    let tag = node.tag_name().name();
    // Extensions of other programs have shapes of their own.
    if SHAPES.contains(&tag) && !node.parent().is_some_and(|parent| parent.has_tag_name("geometry")) {
        return Ok(());
    }
    for (_, names, count) in NUMBERS.iter().filter(|(of, ..)| *of == tag) {
        for name in names.split(' ') {
            let Some(value) = node.attribute(name) else { continue };
            let numbers =
                value.split_whitespace().map(|token| token.parse::<f64>().ok().filter(|number| number.is_finite()));
            if numbers.collect::<Option<Vec<_>>>().is_none_or(|all| all.len() != *count) {
                let expected =
                    if *count == 1 { "a finite number".to_owned() } else { format!("{count} finite numbers") };
                return Err(ModelError::attribute(label, name, value, expected));
            }
        }
    }
    for (_, child) in NEEDED.iter().filter(|(of, _)| *of == tag) {
        if !node.children().any(|found| found.has_tag_name(*child)) {
            return Err(ModelError::unsupported(label, format!("its <{tag}> has no <{child}>")));
        }
    }
    for name in GIVEN.iter().filter(|(of, _)| *of == tag).flat_map(|(_, names)| names.split(' ')) {
        if node.attribute(name).is_none() {
            return Err(ModelError::unsupported(label, format!("its <{tag}> has no `{name}`")));
        }
    }
    let kind = node.attribute("type").filter(|_| tag == "joint");
    if let Some(kind) = kind.filter(|kind| !TYPES.contains(kind)) {
        return Err(ModelError::attribute(label, "type", kind, format!("one of {}", TYPES.join(", "))));
    }
    if matches!(kind, Some("revolute" | "prismatic")) && !node.children().any(|found| found.has_tag_name("limit")) {
        let problem =
            "it has no <limit>, which this type needs; a joint that turns without end has the type \"continuous\"";
        return Err(ModelError::unsupported(label, problem));
    }
    let version = version(node.document());
    if tag == "limit" && version < (1, 2) && node.attribute("velocity").is_none() {
        let problem = "its <limit> has no `velocity`, which the format needs; add the greatest speed (rad/s)";
        return Err(ModelError::unsupported(label, problem));
    }
    if node.has_attribute("quat_xyzw") && version < (1, 1) {
        let problem = "`quat_xyzw` is of version 1.1 of the format; write `rpy`, or <robot version=\"1.1\">";
        return Err(ModelError::unsupported(label, problem));
    }
    Ok(())
}

/// Returns the version of the format, 1.0 if none is given.
fn version(document: &Document<'_>) -> (u32, u32) {
    let given = document.root_element().attribute("version").and_then(|version| {
        let (major, minor) = version.trim().split_once('.')?;
        Some((major.parse().ok()?, minor.parse().ok()?))
    });
    given.unwrap_or((1, 0))
}

fn refuse_xacro(document: &Document<'_>, file: &Path) -> Result<(), ModelError> {
    let is_macro = |node: &Node<'_, '_>| node.tag_name().namespace().is_some_and(|space| space.ends_with("/xacro"));
    let has_expression = |node: &Node<'_, '_>| node.attributes().any(|attribute| attribute.value().contains("${"));
    if !document.descendants().any(|node| is_macro(&node) || has_expression(&node)) {
        return Ok(());
    }
    let name = file.display();
    let problem = format!(
        "the file has xacro macros, which are not expanded here; expand them first: `xacro {name} > robot.urdf`"
    );
    Err(ModelError::unsupported("robot", problem))
}

/// Returns a notice of elements that are left out.
pub(super) fn unused(document: &Document<'_>) -> Vec<String> {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for node in document.root_element().children().filter(Node::is_element) {
        let tag = node.tag_name().name();
        if !READ.contains(&tag) {
            *counts.entry(tag).or_default() += 1;
        }
    }
    let safety = document.descendants().filter(|node| node.has_tag_name("safety_controller")).count();
    if safety > 0 {
        counts.insert("safety_controller", safety);
    }
    if counts.is_empty() {
        return Vec::new();
    }
    let list: Vec<String> = counts.iter().map(|(tag, count)| format!("<{tag}> ({count})")).collect();
    vec![format!("not simulated: {}", list.join(", "))]
}

/// Returns the text without elements that are not read, some of which `urdf_rs` would refuse.
pub(super) fn needed_text(document: &Document<'_>, has_visuals: bool) -> String {
    let text = document.input_text();
    let root = document.root_element();
    let foreign = root.children().filter(|node| node.is_element() && !READ.contains(&node.tag_name().name()));
    let is_unread = |node: &Node<'_, '_>| {
        let tag = node.tag_name().name();
        UNREAD.contains(&tag) || (tag == "visual" && !has_visuals)
    };
    let mut cut: Vec<_> = foreign.chain(document.descendants().filter(is_unread)).map(|node| node.range()).collect();
    cut.sort_by_key(|range| range.start);
    let (mut whole, mut done) = (String::with_capacity(text.len()), 0);
    for range in cut {
        // One may be within another.
        if range.start < done {
            continue;
        }
        whole.push_str(&text[done..range.start]);
        done = range.end;
    }
    whole + &text[done..]
}
