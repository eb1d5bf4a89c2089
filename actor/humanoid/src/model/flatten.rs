//! Checks a model text and writes it as plain MJCF: defaults filled in, every element named, inert elements omitted.
//!
//! `mjcf-rs` reads the result.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use roxmltree::Node;

use super::defaults::{ACTUATORS, Attribute, Classes, attributes_of, get};
use super::vocabulary::{self, is_inert, numbers};
use super::xml;
use crate::error::ModelError;

/// Plain model text, and settings that `mjcf-rs` does not read.
#[derive(Default)]
pub(super) struct Flat {
    pub(super) text: String,
    /// Limits of the total motor torque by joint (N·m), for joints that have them.
    pub(super) torque_ranges: BTreeMap<String, [f64; 2]>,
    /// First and last group of geoms that count for masses.
    pub(super) inertia_groups: [i32; 2],
}

/// Returns the plain text, or an error for the first element that cannot be simulated.
pub(super) fn flatten(text: &str) -> Result<Flat, ModelError> {
    let document = xml::parse_model(text)?;
    let root = document.root_element();
    let mut writer = Writer::default();
    writer.read_settings(root)?;
    writer.open("mujoco", &[]);
    for tag in ["compiler", "option"] {
        for node in sections(root, tag) {
            writer.open(tag, &attributes_of(node));
            writer.close(tag);
        }
    }
    for node in sections(root, "worldbody") {
        writer.open("worldbody", &[]);
        writer.write_tree(node, None, "world", &mut Counts::default())?;
        writer.close("worldbody");
    }
    for (section, kinds) in [("contact", &["exclude"][..]), ("tendon", &["fixed"]), ("actuator", &ACTUATORS)] {
        for node in sections(root, section) {
            writer.open(section, &[]);
            writer.write_section(node, section, kinds)?;
            writer.close(section);
        }
    }
    writer.close("mujoco");
    let Writer { text, torque_ranges, inertia_groups, .. } = writer;
    Ok(Flat { text, torque_ranges, inertia_groups: inertia_groups.unwrap_or([0, 5]) })
}

fn sections<'a, 'text>(root: Node<'a, 'text>, tag: &'static str) -> impl Iterator<Item = Node<'a, 'text>> {
    elements(root).filter(move |node| node.has_tag_name(tag))
}

fn elements<'a, 'text>(node: Node<'a, 'text>) -> impl Iterator<Item = Node<'a, 'text>> {
    node.children().filter(Node::is_element)
}

/// Number of elements of each kind in a body so far; numbers elements without a name.
#[derive(Default)]
struct Counts(BTreeMap<&'static str, usize>);

#[derive(Default)]
struct Writer {
    text: String,
    classes: Classes,
    names: BTreeSet<(&'static str, String)>,
    torque_ranges: BTreeMap<String, [f64; 2]>,
    inertia_groups: Option<[i32; 2]>,
    without_autolimits: bool,
    bodies: usize,
}

impl Writer {
    /// Reads everything but the robot: settings and defaults. Refuses unknown sections.
    fn read_settings(&mut self, root: Node<'_, '_>) -> Result<(), ModelError> {
        vocabulary::check("mujoco", "mujoco", &attributes_of(root))?;
        if let Some(include) = root.descendants().find(|node| node.has_tag_name("include")) {
            let file = include.attribute("file").unwrap_or_default();
            let problem = format!("`{file}` must be pasted in: a model is sent as one text");
            return Err(ModelError::unsupported("include", problem));
        }
        for node in elements(root) {
            let tag = node.tag_name().name();
            match tag {
                "equality" => {
                    if let Some(constraint) = elements(node).next() {
                        let kind = constraint.tag_name().name();
                        let coupled = ["name", "body1", "joint1", "tendon1"];
                        let name = coupled.iter().find_map(|name| constraint.attribute(*name)).unwrap_or(kind);
                        let problem = format!("<equality><{kind}> makes a kinematic loop or couples joints; remove it");
                        return Err(ModelError::unsupported(name, problem));
                    }
                }
                "default" => {
                    vocabulary::check("default", tag, &attributes_of(node))?;
                    self.classes.read_main(node)?;
                }
                "compiler" => self.read_compiler(node)?,
                "asset" | "option" => {
                    vocabulary::check(tag, tag, &attributes_of(node))?;
                    for child in elements(node) {
                        let kind = child.tag_name().name();
                        match kind {
                            _ if tag == "asset" && is_inert(kind) => {}
                            "flag" if tag == "option" => vocabulary::check("option flag", kind, &attributes_of(child))?,
                            _ => return Err(ModelError::unsupported(tag, format!("<{kind}> is not supported"))),
                        }
                    }
                }
                "worldbody" | "contact" | "tendon" | "actuator" => vocabulary::check(tag, tag, &attributes_of(node))?,
                _ if is_inert(tag) => {}
                _ => return Err(ModelError::unsupported("mujoco", format!("<{tag}> is not supported"))),
            }
        }
        Ok(())
    }

    fn read_compiler(&mut self, node: Node<'_, '_>) -> Result<(), ModelError> {
        let attributes = attributes_of(node);
        vocabulary::check("compiler", "compiler", &attributes)?;
        if let Some(sequence) = get(&attributes, "eulerseq")
            && (sequence.len() != 3 || !sequence.bytes().all(|axis| b"xyzXYZ".contains(&axis)))
        {
            return Err(ModelError::attribute("compiler", "eulerseq", sequence, "three of the letters xyzXYZ"));
        }
        if let Some(groups) = get(&attributes, "inertiagrouprange") {
            let groups: Vec<i32> = groups.split_whitespace().filter_map(|token| token.parse().ok()).collect();
            if let [first, last] = groups[..] {
                self.inertia_groups = Some([first, last]);
            }
        }
        if let Some(autolimits) = get(&attributes, "autolimits") {
            self.without_autolimits = autolimits == "false";
        }
        Ok(())
    }

    /// Writes the content of a body, a frame or the world.
    fn write_tree(
        &mut self,
        node: Node<'_, '_>,
        class: Option<&str>,
        owner: &str,
        counts: &mut Counts,
    ) -> Result<(), ModelError> {
        if let Some(class) = class {
            self.classes.class(class, owner)?;
        }
        let in_frame = node.has_tag_name("frame");
        for child in elements(node) {
            let tag = child.tag_name().name();
            match tag {
                "body" => {
                    let label = match own_name(child) {
                        Some(name) => name.to_owned(),
                        None => format!("body {}", self.bodies + 1),
                    };
                    self.bodies += 1;
                    let attributes = self.checked("body", &label, attributes_of(child), "body")?;
                    self.open(tag, &attributes);
                    self.write_tree(child, child.attribute("childclass").or(class), &label, &mut Counts::default())?;
                    self.close(tag);
                }
                "frame" => {
                    let attributes = attributes_of(child);
                    vocabulary::check(&format!("frame in {owner}"), tag, &attributes)?;
                    self.open(tag, &attributes);
                    self.write_tree(child, child.attribute("childclass").or(class), owner, counts)?;
                    self.close(tag);
                }
                // `mjcf-rs` ignores these in a frame.
                "inertial" | "joint" | "freejoint" if in_frame => {
                    let problem = format!("<{tag}> within <frame> is not supported; move it into the body");
                    return Err(ModelError::unsupported(owner, problem));
                }
                "inertial" => self.write_inertial(child, owner)?,
                "joint" | "freejoint" => {
                    let label = label_of(child, "joint", owner, counts);
                    let attributes = self.classes.with_defaults(child, class, &label)?;
                    let attributes = self.checked(tag, &label, attributes, "joint")?;
                    self.record_torque_range(&label, &attributes)?;
                    self.open(tag, &attributes);
                    self.close(tag);
                }
                "geom" => {
                    let label = label_of(child, "geom", owner, counts);
                    if let Some(inner) = elements(child).next() {
                        let problem = format!("<{}> is not supported", inner.tag_name().name());
                        return Err(ModelError::unsupported(&label, problem));
                    }
                    let attributes = self.classes.with_defaults(child, class, &label)?;
                    let attributes = self.checked(tag, &label, attributes, "geom")?;
                    self.open(tag, &attributes);
                    self.close(tag);
                }
                _ if is_inert(tag) => {}
                _ => return Err(ModelError::unsupported(owner, format!("<{tag}> is not supported"))),
            }
        }
        Ok(())
    }

    fn write_inertial(&mut self, node: Node<'_, '_>, owner: &str) -> Result<(), ModelError> {
        let attributes = attributes_of(node);
        let label = format!("inertial of {owner}");
        vocabulary::check(&label, "inertial", &attributes)?;
        for needed in ["pos", "mass"] {
            if get(&attributes, needed).is_none() {
                return Err(ModelError::unsupported(&label, format!("`{needed}` is missing")));
            }
        }
        match (get(&attributes, "diaginertia"), get(&attributes, "fullinertia")) {
            (Some(_), None) => {}
            (None, Some(_)) if vocabulary::ORIENTATIONS.iter().all(|turn| get(&attributes, turn).is_none()) => {}
            (None, Some(_)) => {
                return Err(ModelError::unsupported(&label, "`fullinertia` allows no orientation"));
            }
            _ => return Err(ModelError::unsupported(&label, "give either `diaginertia` or `fullinertia`")),
        }
        self.open("inertial", &attributes);
        self.close("inertial");
        Ok(())
    }

    fn write_section(&mut self, node: Node<'_, '_>, section: &str, kinds: &[&'static str]) -> Result<(), ModelError> {
        for child in elements(node) {
            let tag = child.tag_name().name();
            let label = own_name(child).or(child.attribute("joint")).unwrap_or(tag).to_owned();
            let Some(kind) = kinds.iter().find(|kind| **kind == tag) else {
                let problem = format!("<{section}><{tag}> is not supported; accepted: {}", kinds.join(", "));
                return Err(ModelError::unsupported(&label, problem));
            };
            if section == "actuator" {
                // MuJoCo keeps one set of defaults for all actuators, `mjcf-rs` one for each kind.
                if let Some(other) = self.classes.actuators.iter().find(|other| *other != tag) {
                    let problem = format!("defaults of <{other}> apply to it: all actuators must be of one kind");
                    return Err(ModelError::unsupported(&label, problem));
                }
            }
            let attributes = self.classes.with_defaults(child, None, &label)?;
            let attributes = match own_name(child) {
                Some(_) => {
                    self.checked(kind, &label, attributes, if section == "actuator" { "actuator" } else { kind })?
                }
                None => {
                    vocabulary::check(&label, kind, &attributes)?;
                    without_class(attributes)
                }
            };
            self.open(tag, &attributes);
            if section == "tendon" {
                self.write_terms(child, &label, &attributes)?;
            } else if let Some(inner) = elements(child).next() {
                let problem = format!("<{}> is not supported", inner.tag_name().name());
                return Err(ModelError::unsupported(&label, problem));
            }
            self.close(tag);
        }
        Ok(())
    }

    fn write_terms(&mut self, node: Node<'_, '_>, label: &str, attributes: &[Attribute]) -> Result<(), ModelError> {
        if get(attributes, "range").is_some() && get(attributes, "limited") != Some("false") && !self.without_autolimits
        {
            return Err(ModelError::unsupported(label, "limits of tendons are not simulated; remove its range"));
        }
        for term in elements(node) {
            if !term.has_tag_name("joint") {
                return Err(ModelError::unsupported(label, format!("<{}> is not supported", term.tag_name().name())));
            }
            let attributes = attributes_of(term);
            vocabulary::check(label, "term", &attributes)?;
            let joint = get(&attributes, "joint").unwrap_or_default();
            if !self.names.contains(&("joint", joint.to_owned())) {
                return Err(ModelError::unsupported(label, format!("there is no joint `{joint}`")));
            }
            self.open("joint", &attributes);
            self.close("joint");
        }
        Ok(())
    }

    /// Checks an element's attributes and sets its name, which must be unique among elements of its `kind`.
    fn checked(
        &mut self,
        tag: &str,
        label: &str,
        mut attributes: Vec<Attribute>,
        kind: &'static str,
    ) -> Result<Vec<Attribute>, ModelError> {
        vocabulary::check(label, tag, &attributes)?;
        if !self.names.insert((kind, label.to_owned())) {
            return Err(ModelError::unsupported(label, format!("there are two elements <{tag}> of this name")));
        }
        attributes.retain(|(name, _)| name != "name");
        attributes.insert(0, ("name".to_owned(), label.to_owned()));
        Ok(without_class(attributes))
    }

    fn record_torque_range(&mut self, joint: &str, attributes: &[Attribute]) -> Result<(), ModelError> {
        let range = get(attributes, "actuatorfrcrange").and_then(numbers);
        let limited = match get(attributes, "actuatorfrclimited") {
            Some("true") => true,
            Some("false") => false,
            _ if self.without_autolimits && range.is_some() => {
                let problem = "without autolimits `actuatorfrcrange` needs `actuatorfrclimited`";
                return Err(ModelError::unsupported(joint, problem));
            }
            _ => range.is_some(),
        };
        match range.as_deref() {
            _ if !limited => {}
            Some([low, high]) if low < high => {
                self.torque_ranges.insert(joint.to_owned(), [*low, *high]);
            }
            _ => {
                return Err(ModelError::unsupported(joint, "`actuatorfrcrange` must be a lower and an upper torque"));
            }
        }
        Ok(())
    }

    fn open(&mut self, tag: &str, attributes: &[Attribute]) {
        let _ = write!(self.text, "<{tag}");
        for (name, value) in attributes {
            let _ = write!(self.text, " {name}=\"");
            for letter in value.chars() {
                match letter {
                    '&' => self.text.push_str("&amp;"),
                    '<' => self.text.push_str("&lt;"),
                    '"' => self.text.push_str("&quot;"),
                    _ => self.text.push(letter),
                }
            }
            self.text.push('"');
        }
        self.text.push('>');
    }

    fn close(&mut self, tag: &str) {
        let _ = writeln!(self.text, "</{tag}>");
    }
}

fn own_name<'a>(node: Node<'a, '_>) -> Option<&'a str> {
    node.attribute("name").filter(|name| !name.is_empty())
}

/// Removes class names, which are unused once defaults are filled in.
fn without_class(mut attributes: Vec<Attribute>) -> Vec<Attribute> {
    attributes.retain(|(name, _)| name != "class" && name != "childclass");
    attributes
}

/// Returns an element's name, or a label for messages.
fn label_of(node: Node<'_, '_>, kind: &'static str, owner: &str, counts: &mut Counts) -> String {
    let number = counts.0.entry(kind).or_default();
    *number += 1;
    own_name(node).map_or_else(|| format!("{kind} {number} of {owner}"), str::to_owned)
}
