//! A whole model text: checked, with defaults filled in and every element named, as bodies and lists.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Point3, Vector3};
use roxmltree::{Document, Node};

use super::assets::Assets;
use super::card_text;
use super::defaults::{ACTUATORS, Classes};
use super::element::{Element, numbers};
use super::motion_text;
use super::pose::{Angles, Pose};
use super::vocabulary::{self, is_inert};
use super::xml::{elements, sections};
use crate::card::RobotCard;
use crate::error::ModelError;
use crate::model::MotionClip;
use crate::model::Solver;

/// Everything in a text that motion depends on.
pub(super) struct Tree {
    pub(super) compiler: Compiler,
    pub(super) gravity_mps2: Vector3<f64>,
    pub(super) solver: Solver,
    /// Bodies, parents before children; the first is the world.
    pub(super) bodies: Vec<BodyNode>,
    pub(super) exclusions: Vec<Element>,
    pub(super) pairs: Vec<Element>,
    /// Fixed tendons, each with its terms.
    pub(super) tendons: Vec<(Element, Vec<Element>)>,
    pub(super) actuators: Vec<Element>,
    /// Equalities, with tags like `equality/joint`.
    pub(super) equalities: Vec<Element>,
    pub(super) sites: Vec<Site>,
    pub(super) keys: Vec<Element>,
    pub(super) assets: Assets,
    pub(super) card: Option<RobotCard>,
    /// Motions.
    pub(super) motions: Vec<MotionClip>,
}

/// Site, which only an equality may need.
pub(super) struct Site {
    pub(super) name: String,
    /// Index of its body.
    pub(super) body: usize,
    /// Place in the body (m), if the site itself gives it.
    pub(super) point_m: Option<Point3<f64>>,
}

/// An MJCF body, with what is in its frames.
pub(super) struct BodyNode {
    pub(super) name: String,
    /// Index of the parent; the world is its own.
    pub(super) parent: usize,
    pub(super) pose: Pose,
    /// Share of its weight that is held up.
    pub(super) gravity_compensation: f64,
    /// Joints and the poses of the frames around them.
    pub(super) joints: Vec<(Element, Pose)>,
    /// Geoms and their poses.
    pub(super) geoms: Vec<(Element, Pose)>,
    pub(super) inertial: Option<(Element, Pose)>,
}

/// Settings in `<compiler>`.
pub(super) struct Compiler {
    pub(super) angles: Angles,
    pub(super) autolimits: bool,
    pub(super) balances_inertia: bool,
    /// Whether masses are those of the geoms; `None` where there is no `<inertial>`.
    pub(super) inertia_from_geoms: Option<bool>,
    /// First and last group of geoms that count for masses.
    pub(super) inertia_groups: [i32; 2],
    /// Least mass (kg) and principal inertia (kg·m²).
    pub(super) bound_mass: f64,
    pub(super) bound_inertia: f64,
    /// Mass of the whole robot (kg), if above 0.
    pub(super) total_mass_kg: f64,
}

impl Compiler {
    fn of(element: &Element) -> Result<Self, ModelError> {
        let sequence = element.get("eulerseq").unwrap_or("xyz").to_owned();
        if sequence.len() != 3 || !sequence.bytes().all(|axis| b"xyzXYZ".contains(&axis)) {
            return Err(element.wrong("eulerseq", "three of the letters xyzXYZ"));
        }
        Ok(Self {
            angles: Angles { are_degrees: element.get("angle") != Some("radian"), sequence },
            autolimits: element.is_true("autolimits", true),
            balances_inertia: element.is_true("balanceinertia", false),
            inertia_from_geoms: element
                .get("inertiafromgeom")
                .filter(|value| *value != "auto")
                .map(|value| value == "true"),
            inertia_groups: element.list_over("inertiagrouprange", [0.0, 5.0]).map(|group| group as i32),
            bound_mass: element.number("boundmass").unwrap_or(0.0),
            bound_inertia: element.number("boundinertia").unwrap_or(0.0),
            total_mass_kg: element.number("settotalmass").unwrap_or(0.0),
        })
    }
}

/// Reads a parsed text, or returns an error for the first element that cannot be simulated.
pub(super) fn read(document: &Document<'_>) -> Result<Tree, ModelError> {
    let root = document.root_element();
    check_sections(root)?;
    let [compiler, option] = ["compiler", "option"].map(|tag| merged(root, tag));
    let solver = match option.get("solver") {
        Some("PGS") => Solver::GaussSeidel,
        _ => Solver::Newton,
    };
    let mut builder = Builder { classes: Classes::of(root)?, names: BTreeSet::new() };
    let mut tree = Tree {
        compiler: Compiler::of(&compiler)?,
        gravity_mps2: option.list_over("gravity", [0.0, 0.0, -9.81]).into(),
        solver,
        bodies: vec![BodyNode::new("world".to_owned(), 0, Pose::IDENTITY)],
        exclusions: Vec::new(),
        pairs: Vec::new(),
        tendons: Vec::new(),
        actuators: Vec::new(),
        equalities: Vec::new(),
        sites: Vec::new(),
        keys: Vec::new(),
        assets: Assets::default(),
        card: card_text::in_document(document)?,
        motions: motion_text::in_document(document)?,
    };
    for asset in sections(root, "asset").flat_map(elements).filter(|asset| !is_inert(asset.tag_name().name())) {
        tree.assets.read(asset, &builder.classes)?;
    }
    tree.assets.read_moments(root)?;
    for key in sections(root, "keyframe").flat_map(elements) {
        if !key.has_tag_name("key") {
            let problem = format!("<{}> is not supported", key.tag_name().name());
            return Err(ModelError::unsupported("keyframe", problem));
        }
        let label = own_name(key).map_or_else(|| format!("key {}", tree.keys.len() + 1), str::to_owned);
        tree.keys.push(builder.named("key", Element::of(key, label))?);
    }
    for node in sections(root, "worldbody") {
        builder.read_body(&mut tree, node, &Surroundings::WORLD, &mut Counts::default())?;
    }
    for node in sections(root, "contact").flat_map(elements) {
        let element = builder.section_element("contact", node, &["exclude", "pair"])?;
        if node.has_tag_name("pair") { &mut tree.pairs } else { &mut tree.exclusions }.push(element);
    }
    for node in sections(root, "tendon").flat_map(elements) {
        tree.tendons.push(builder.read_tendon(node)?);
    }
    for node in sections(root, "actuator").flat_map(elements) {
        tree.actuators.push(builder.section_element("actuator", node, &ACTUATORS)?);
    }
    for node in sections(root, "equality").flat_map(elements) {
        tree.equalities.push(builder.read_equality(node)?);
    }
    Ok(tree)
}

/// Refuses unknown sections and settings that are not simulated.
fn check_sections(root: Node<'_, '_>) -> Result<(), ModelError> {
    vocabulary::check("mujoco", &Element::of(root, "mujoco"))?;
    if let Some(include) = root.descendants().find(|node| node.has_tag_name("include")) {
        let file = include.attribute("file").unwrap_or_default();
        let problem = format!("`{file}` must be pasted in: a model is sent as one text");
        return Err(ModelError::unsupported("include", problem));
    }
    for node in elements(root) {
        let tag = node.tag_name().name();
        match tag {
            _ if is_inert(tag) => {}
            _ if vocabulary::is_section(tag) => vocabulary::check(tag, &Element::of(node, tag))?,
            _ => return Err(ModelError::unsupported("mujoco", format!("<{tag}> is not supported"))),
        }
        for child in elements(node).filter(|_| matches!(tag, "asset" | "option")) {
            let kind = child.tag_name().name();
            match kind {
                "flag" if tag == "option" => vocabulary::check(kind, &Element::of(child, "option flag"))?,
                _ if tag == "asset" && (is_inert(kind) || matches!(kind, "mesh" | "hfield")) => {}
                _ => return Err(ModelError::unsupported(tag, format!("<{kind}> is not supported"))),
            }
        }
    }
    Ok(())
}

/// Returns all sections of a kind as one; of an attribute that several have, the last one counts.
fn merged(root: Node<'_, '_>, tag: &'static str) -> Element {
    let mut whole = Element { tag: tag.to_owned(), label: tag.to_owned(), attributes: Vec::new() };
    for node in sections(root, tag) {
        whole.attributes.splice(0..0, Element::of(node, tag).attributes);
    }
    whole
}

/// Number of elements of each kind in a body so far; numbers elements without a name.
#[derive(Default)]
struct Counts(BTreeMap<&'static str, usize>);

/// Where an element is: its body's index, the pose of the frames within that body, and the class of its children.
struct Surroundings<'a> {
    body: usize,
    frame: Pose,
    class: Option<&'a str>,
}

impl Surroundings<'_> {
    const WORLD: Self = Self { body: 0, frame: Pose::IDENTITY, class: None };
}

impl BodyNode {
    fn new(name: String, parent: usize, pose: Pose) -> Self {
        Self { name, parent, pose, gravity_compensation: 0.0, joints: Vec::new(), geoms: Vec::new(), inertial: None }
    }
}

struct Builder {
    classes: Classes,
    /// Kinds and names of all elements so far.
    names: BTreeSet<(&'static str, String)>,
}

impl Builder {
    /// Reads the content of a body, a frame or the world.
    fn read_body(
        &mut self,
        tree: &mut Tree,
        node: Node<'_, '_>,
        around: &Surroundings<'_>,
        counts: &mut Counts,
    ) -> Result<(), ModelError> {
        let (body, class, is_frame) = (around.body, around.class, node.has_tag_name("frame"));
        let owner = tree.bodies[body].name.clone();
        let refuse = |problem: String| Err(ModelError::unsupported(&owner, problem));
        let within = |pose: Pose| if is_frame { around.frame.times(&pose) } else { pose };
        if let Some(class) = class {
            self.classes.class(class, &owner)?;
        }
        for child in elements(node) {
            let tag = child.tag_name().name();
            let class_within = child.attribute("childclass").or(class);
            match tag {
                "body" => {
                    let number = tree.bodies.len();
                    let label = own_name(child).map_or_else(|| format!("body {number}"), str::to_owned);
                    let element = self.named("body", Element::of(child, label))?;
                    let pose = around.frame.times(&tree.compiler.angles.pose(&element));
                    let gravity_compensation = element.number("gravcomp").unwrap_or(0.0);
                    tree.bodies.push(BodyNode { gravity_compensation, ..BodyNode::new(element.label, body, pose) });
                    let within = Surroundings { body: number, frame: Pose::IDENTITY, class: class_within };
                    self.read_body(tree, child, &within, &mut Counts::default())?;
                }
                "frame" => {
                    let element = Element::of(child, format!("frame in {owner}"));
                    vocabulary::check(tag, &element)?;
                    let frame = around.frame.times(&tree.compiler.angles.pose(&element));
                    self.read_body(tree, child, &Surroundings { body, frame, class: class_within }, counts)?;
                }
                "inertial" => {
                    let element = inertial(child, &owner)?;
                    let pose = within(tree.compiler.angles.pose(&element));
                    tree.bodies[body].inertial = Some((element, pose));
                }
                "joint" | "freejoint" => {
                    let label = label_of(child, "joint", &owner, counts);
                    let element = self.named("joint", self.classes.with_defaults(child, class, label)?)?;
                    tree.bodies[body].joints.push((element, around.frame));
                }
                "site" => {
                    let element = Element::of(child, child.attribute("name").unwrap_or_default());
                    let pose = within(tree.compiler.angles.pose(&element));
                    let place = Point3::from(pose.isometry().translation.vector);
                    let point_m = element.get("pos").and_then(numbers).filter(|all| all.len() == 3).map(|_| place);
                    tree.sites.push(Site { name: element.label, body, point_m });
                }
                "geom" => {
                    let label = label_of(child, "geom", &owner, counts);
                    refuse_content(child, &label)?;
                    let element = self.named("geom", self.classes.with_defaults(child, class, label)?)?;
                    let pose = within(tree.compiler.angles.pose(&element));
                    tree.bodies[body].geoms.push((element, pose));
                }
                _ if is_inert(tag) => {}
                _ => return refuse(format!("<{tag}> is not supported")),
            }
        }
        Ok(())
    }

    /// Reads an element of a section, whose accepted tags are `kinds`.
    fn section_element(
        &mut self,
        section: &'static str,
        node: Node<'_, '_>,
        kinds: &[&'static str],
    ) -> Result<Element, ModelError> {
        let tag = node.tag_name().name();
        let label = match (node.attribute("geom1"), node.attribute("geom2")) {
            (Some(one), Some(other)) if own_name(node).is_none() => format!("{tag} of {one} and {other}"),
            _ => own_name(node).or(node.attribute("joint")).unwrap_or(tag).to_owned(),
        };
        let Some(kind) = kinds.iter().find(|kind| **kind == tag) else {
            let problem = format!("<{section}><{tag}> is not supported; accepted: {}", kinds.join(", "));
            return Err(ModelError::unsupported(&label, problem));
        };
        let element = self.classes.with_defaults(node, None, label)?;
        let element = match own_name(node) {
            Some(_) => self.named(if section == "actuator" { section } else { kind }, element)?,
            None => vocabulary::check(kind, &element).map(|()| element)?,
        };
        if section != "tendon" {
            refuse_content(node, &element.label)?;
        }
        Ok(element)
    }

    /// Reads an equality; those that are not active have no effect.
    fn read_equality(&mut self, node: Node<'_, '_>) -> Result<Element, ModelError> {
        let kind = node.tag_name().name();
        let coupled = ["name", "joint1", "body1", "site1", "tendon1"];
        let label = coupled.iter().find_map(|name| node.attribute(*name)).unwrap_or(kind);
        let tag = format!("equality/{kind}");
        if vocabulary::rules(&tag).is_none() {
            let problem = format!("<equality><{kind}> is not supported; accepted: connect, joint");
            return Err(ModelError::unsupported(label, problem));
        }
        let element = self.classes.completed(Element { tag, ..Element::of(node, label) }, None)?;
        refuse_content(node, label)?;
        match own_name(node) {
            Some(_) => self.named("equality", element),
            None => vocabulary::check(&element.tag, &element).map(|()| element),
        }
    }

    fn read_tendon(&mut self, node: Node<'_, '_>) -> Result<(Element, Vec<Element>), ModelError> {
        let tendon = self.section_element("tendon", node, &["fixed"])?;
        let mut terms = Vec::new();
        for node in elements(node) {
            if !node.has_tag_name("joint") {
                return Err(tendon.refused(format!("<{}> is not supported", node.tag_name().name())));
            }
            let term = Element::of(node, tendon.label.as_str());
            vocabulary::check("term", &term)?;
            let joint = term.text("joint");
            if !self.names.contains(&("joint", joint.clone())) {
                return Err(term.refused(format!("there is no joint `{joint}`")));
            }
            terms.push(term);
        }
        Ok((tendon, terms))
    }

    /// Checks an element's attributes, and that its label is unique among elements of its kind.
    fn named(&mut self, kind: &'static str, element: Element) -> Result<Element, ModelError> {
        vocabulary::check(&element.tag, &element)?;
        match self.names.insert((kind, element.label.clone())) {
            true => Ok(element),
            false => Err(element.refused(format!("there are two elements <{}> of this name", element.tag))),
        }
    }
}

fn inertial(node: Node<'_, '_>, owner: &str) -> Result<Element, ModelError> {
    let element = Element::of(node, format!("inertial of {owner}"));
    vocabulary::check("inertial", &element)?;
    let has = |name: &str| element.get(name).is_some();
    if let Some(needed) = ["pos", "mass"].into_iter().find(|needed| !has(needed)) {
        return Err(element.refused(format!("`{needed}` is missing")));
    }
    match (has("diaginertia"), has("fullinertia")) {
        (false, true) if vocabulary::ORIENTATIONS.into_iter().any(has) => {
            Err(element.refused("`fullinertia` allows no orientation"))
        }
        (true, false) | (false, true) => Ok(element),
        _ => Err(element.refused("give either `diaginertia` or `fullinertia`")),
    }
}

fn refuse_content(node: Node<'_, '_>, label: &str) -> Result<(), ModelError> {
    let Some(inner) = elements(node).next() else { return Ok(()) };
    Err(ModelError::unsupported(label, format!("<{}> is not supported", inner.tag_name().name())))
}

fn own_name<'a>(node: Node<'a, '_>) -> Option<&'a str> {
    node.attribute("name").filter(|name| !name.is_empty())
}

/// Returns an element's name, or a label for messages.
fn label_of(node: Node<'_, '_>, kind: &'static str, owner: &str, counts: &mut Counts) -> String {
    let number = counts.0.entry(kind).or_default();
    *number += 1;
    own_name(node).map_or_else(|| format!("{kind} {number} of {owner}"), str::to_owned)
}
