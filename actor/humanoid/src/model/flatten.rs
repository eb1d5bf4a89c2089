//! Checks a model text and writes it as plain MJCF: defaults filled in, every element named, inert elements omitted.
//!
//! `mjcf-rs` reads the result.

use std::collections::{BTreeMap, BTreeSet};

use roxmltree::Node;

use super::Solver;
use super::assets::Assets;
use super::defaults::{ACTUATORS, Attribute, Classes, attributes_of, get};
use super::vocabulary::{self, is_inert};
use super::xml::{self, elements, sections};
use crate::card::{self, RobotCard};
use crate::error::ModelError;

/// Plain model text, and settings that `mjcf-rs` does not read.
#[derive(Default)]
pub(super) struct Flat {
    pub(super) text: String,
    /// First and last group of geoms that count for masses.
    pub(super) inertia_groups: [i32; 2],
    /// Attributes of joints and geoms by name, with defaults.
    pub(super) joints: BTreeMap<String, Vec<Attribute>>,
    pub(super) geoms: BTreeMap<String, Vec<Attribute>>,
    /// Attributes of tendons and actuators in their order, with defaults.
    pub(super) tendons: Vec<Vec<Attribute>>,
    pub(super) actuators: Vec<Vec<Attribute>>,
    /// Labels and attributes of pairs and keyframes.
    pub(super) pairs: Vec<(String, Vec<Attribute>)>,
    pub(super) keys: Vec<(String, Vec<Attribute>)>,
    pub(super) assets: Assets,
    pub(super) solver: Solver,
    pub(super) card: Option<RobotCard>,
}

impl Flat {
    /// Returns the attributes of a joint with defaults.
    pub(super) fn joint(&self, name: &str) -> &[Attribute] {
        self.joints.get(name).map_or(&[], Vec::as_slice)
    }

    /// Returns the attributes of a geom with defaults.
    pub(super) fn geom(&self, name: &str) -> &[Attribute] {
        self.geoms.get(name).map_or(&[], Vec::as_slice)
    }
}

/// Returns the plain text, or an error for the first element that cannot be simulated.
pub(super) fn flatten(text: &str) -> Result<Flat, ModelError> {
    let document = xml::parse_model(text)?;
    let root = document.root_element();
    let mut writer = Writer { flat: Flat { inertia_groups: [0, 5], ..Flat::default() }, ..Writer::default() };
    writer.read_settings(root)?;
    writer.flat.card = card::in_document(&document)?;
    for asset in sections(root, "asset").flat_map(elements) {
        if !is_inert(asset.tag_name().name()) {
            writer.flat.assets.read(asset, &writer.classes)?;
        }
    }
    for key in sections(root, "keyframe").flat_map(elements) {
        writer.read_key(key)?;
    }
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
    for (section, kinds) in [("contact", &["exclude", "pair"][..]), ("tendon", &["fixed"]), ("actuator", &ACTUATORS)] {
        for node in sections(root, section) {
            writer.open(section, &[]);
            writer.write_section(node, section, kinds)?;
            writer.close(section);
        }
    }
    writer.close("mujoco");
    Ok(writer.flat)
}

/// Number of elements of each kind in a body so far; numbers elements without a name.
#[derive(Default)]
struct Counts(BTreeMap<&'static str, usize>);

#[derive(Default)]
struct Writer {
    flat: Flat,
    classes: Classes,
    names: BTreeSet<(&'static str, String)>,
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
                    if let Some(solver) = node.attribute("solver") {
                        self.flat.solver = match solver {
                            "Newton" | "CG" => Solver::Newton,
                            "PGS" => Solver::GaussSeidel,
                            _ => return Err(ModelError::attribute(tag, "solver", solver, "Newton, CG or PGS")),
                        };
                    }
                    for child in elements(node) {
                        let kind = child.tag_name().name();
                        match kind {
                            _ if tag == "asset" && (is_inert(kind) || matches!(kind, "mesh" | "hfield")) => {}
                            "flag" if tag == "option" => vocabulary::check("option flag", kind, &attributes_of(child))?,
                            _ => return Err(ModelError::unsupported(tag, format!("<{kind}> is not supported"))),
                        }
                    }
                }
                "worldbody" | "contact" | "tendon" | "actuator" | "keyframe" => {
                    vocabulary::check(tag, tag, &attributes_of(node))?;
                }
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
                self.flat.inertia_groups = [first, last];
            }
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
                    self.open(tag, &attributes);
                    self.close(tag);
                    self.flat.joints.insert(label, attributes);
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
                    self.flat.geoms.insert(label, attributes);
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
            let label = match (child.attribute("geom1"), child.attribute("geom2")) {
                (Some(one), Some(other)) if own_name(child).is_none() => format!("{tag} of {one} and {other}"),
                _ => own_name(child).or(child.attribute("joint")).unwrap_or(tag).to_owned(),
            };
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
                self.write_terms(child, &label)?;
            } else if let Some(inner) = elements(child).next() {
                let problem = format!("<{}> is not supported", inner.tag_name().name());
                return Err(ModelError::unsupported(&label, problem));
            }
            self.close(tag);
            match section {
                "tendon" => self.flat.tendons.push(attributes),
                "actuator" => self.flat.actuators.push(attributes),
                _ if tag == "pair" => self.flat.pairs.push((label, attributes)),
                _ => {}
            }
        }
        Ok(())
    }

    fn read_key(&mut self, node: Node<'_, '_>) -> Result<(), ModelError> {
        let tag = node.tag_name().name();
        if tag != "key" {
            return Err(ModelError::unsupported("keyframe", format!("<{tag}> is not supported")));
        }
        let label = own_name(node).map_or_else(|| format!("key {}", self.flat.keys.len() + 1), str::to_owned);
        let attributes = self.checked(tag, &label, attributes_of(node), "key")?;
        self.flat.keys.push((label, attributes));
        Ok(())
    }

    fn write_terms(&mut self, node: Node<'_, '_>, label: &str) -> Result<(), ModelError> {
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

    fn open(&mut self, tag: &str, attributes: &[Attribute]) {
        xml::open(&mut self.flat.text, tag, attributes);
    }

    fn close(&mut self, tag: &str) {
        xml::close(&mut self.flat.text, tag);
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
