//! Default classes, merged into the attributes of each element as in MuJoCo.

use std::collections::BTreeMap;

use roxmltree::Node;

use super::element::{Attribute, Element};
use super::vocabulary::{self, AttributeRule, is_inert};
use super::xml;
use crate::error::ModelError;

/// Class of elements that name none.
const MAIN: &str = "main";
/// Tags of supported actuators.
pub(super) const ACTUATORS: [&str; 4] = ["motor", "position", "velocity", "general"];
/// Key of the defaults of all actuators.
const ACTUATOR: &str = "actuator";

/// Defaults of one class, including those of its parents: attributes by tag. Actuators of all kinds share those of
/// [`ACTUATOR`].
type Class = BTreeMap<String, Defaults>;

/// Attributes of a class for one tag.
#[derive(Clone, Debug, Default)]
pub(super) struct Defaults {
    /// Tag that they were given for last.
    tag: String,
    attributes: Vec<Attribute>,
}

/// All classes of a model.
#[derive(Debug, Default)]
pub(super) struct Classes {
    classes: BTreeMap<String, Class>,
}

impl Classes {
    /// Reads all classes of a text.
    pub(super) fn of(root: Node<'_, '_>) -> Result<Self, ModelError> {
        let mut classes = Self::default();
        xml::sections(root, "default").try_for_each(|node| classes.read_main(node))?;
        Ok(classes)
    }

    /// Reads an outermost `<default>`; there may be several.
    fn read_main(&mut self, node: Node<'_, '_>) -> Result<(), ModelError> {
        if let Some(name) = node.attribute("class")
            && name != MAIN
        {
            return Err(ModelError::attribute(
                "default",
                "class",
                name,
                "main, or omitted, for the outermost <default>",
            ));
        }
        let class = self.classes.remove(MAIN).unwrap_or_default();
        self.read(node, MAIN, class)
    }

    fn read(&mut self, node: Node<'_, '_>, name: &str, mut class: Class) -> Result<(), ModelError> {
        let label = format!("default {name}");
        let mut nested = Vec::new();
        for child in node.children().filter(Node::is_element) {
            let tag = child.tag_name().name();
            if tag == "default" {
                nested.push(child);
                continue;
            }
            // Defaults of elements that are refused at every occurrence have no effect.
            if is_inert(tag) {
                continue;
            }
            // Spatial tendons, which share these defaults, are refused.
            let tag = if tag == "tendon" { "fixed" } else { tag };
            if vocabulary::rules(tag).is_none() {
                return Err(ModelError::unsupported(&label, format!("<{tag}> is not supported")));
            }
            let element = Element::of(child, &label);
            for (attribute, value) in &element.attributes {
                let rule = vocabulary::rule(tag, attribute)
                    .ok_or_else(|| element.refused(format!("attribute `{attribute}` of <{tag}> is not supported")))?;
                // A value that is not simulated is refused at the elements that inherit it, if any.
                if !matches!(rule, AttributeRule::Only(_) | AttributeRule::Choice(_)) {
                    vocabulary::allowed(rule, value).map_err(|expected| element.wrong(attribute, expected))?;
                }
            }
            let before = class.remove(key(tag)).unwrap_or_default().attributes_for(tag);
            let attributes = merge(tag, before, element.attributes);
            class.insert(key(tag).to_owned(), Defaults { tag: tag.to_owned(), attributes });
        }
        for child in nested {
            let name = child
                .attribute("class")
                .ok_or_else(|| ModelError::unsupported(&label, "a <default> within another needs a class"))?;
            if self.classes.contains_key(name) || name == MAIN {
                return Err(ModelError::unsupported(&format!("default {name}"), "there are two classes of this name"));
            }
            self.read(child, name, class.clone())?;
        }
        self.classes.insert(name.to_owned(), class);
        Ok(())
    }

    /// Returns an element with its class's defaults; `ambient` is its body's `childclass`.
    pub(super) fn with_defaults(
        &self,
        node: Node<'_, '_>,
        ambient: Option<&str>,
        label: impl Into<String>,
    ) -> Result<Element, ModelError> {
        self.completed(Element::of(node, label), ambient)
    }

    /// Returns an element with its class's defaults.
    pub(super) fn completed(&self, mut element: Element, ambient: Option<&str>) -> Result<Element, ModelError> {
        let name = element.get("class").or(ambient).unwrap_or(MAIN);
        if let Some(under) = self.class(name, &element.label)?.and_then(|class| class.get(key(&element.tag))) {
            element.attributes = merge(&element.tag, under.attributes_for(&element.tag), element.attributes);
        }
        Ok(element)
    }

    /// Returns the class of a name; `None` for [`MAIN`] in a text without defaults.
    pub(super) fn class(&self, name: &str, label: &str) -> Result<Option<&Class>, ModelError> {
        match self.classes.get(name) {
            None if name != MAIN => {
                Err(ModelError::unsupported(label, format!("there is no <default class=\"{name}\">")))
            }
            found => Ok(found),
        }
    }
}

/// Returns the key of a tag's defaults. Equalities, which share theirs, have tags like `equality/joint`.
fn key(tag: &str) -> &str {
    if ACTUATORS.contains(&tag) { ACTUATOR } else { tag.split('/').next().unwrap_or(tag) }
}

impl Defaults {
    /// Returns the attributes as they hold for a tag. As in MuJoCo, an actuator of another kind takes ranges and gear, but
    /// not the gains, unless one of the two is `general`.
    fn attributes_for(&self, tag: &str) -> Vec<Attribute> {
        if self.tag == tag || self.tag.is_empty() || key(tag) != ACTUATOR {
            return self.attributes.clone();
        }
        let is_common = |(name, _): &&Attribute| ACTUATORS.iter().all(|kind| vocabulary::rule(kind, name).is_some());
        let mut found: Vec<Attribute> = self.attributes.iter().filter(is_common).cloned().collect();
        let under = Element { tag: self.tag.clone(), label: String::new(), attributes: self.attributes.clone() };
        let gain = |name: &str| under.number(name);
        let gains: Vec<(&str, Option<String>)> = match (self.tag.as_str(), tag) {
            ("position", "general") => {
                let stiffness = gain("kp").unwrap_or(1.0);
                let damping = gain("dampratio").unwrap_or(-gain("kv").unwrap_or(0.0));
                affine(stiffness, &format!("0 {} {damping}", -stiffness))
            }
            ("velocity", "general") => {
                let damping = gain("kv").unwrap_or(1.0);
                affine(damping, &format!("0 0 {}", -damping))
            }
            ("general", "position") => {
                let bias = under.list("biasprm").and_then(|all| all.get(2).copied());
                let damping = bias.filter(|bias| *bias <= 0.0).map(|bias| -bias);
                [("kp", gain("gainprm")), ("kv", damping), ("dampratio", bias.filter(|ratio| *ratio > 0.0))]
                    .map(|(name, value)| (name, value.map(|value| value.to_string())))
                    .into()
            }
            ("general", "velocity") => vec![("kv", gain("gainprm").map(|gain| gain.to_string()))],
            _ => Vec::new(),
        };
        // Those that only a position servo may have are refused by name where a general one inherits them.
        let of_servo =
            ["inheritrange", "timeconst"].into_iter().filter(|name| gain(name).is_some_and(|value| value != 0.0));
        if [&self.tag, tag].iter().all(|kind| ["position", "general"].contains(kind)) {
            found.extend(of_servo.map(|name| (name.to_owned(), under.text(name))));
        }
        found.extend(gains.into_iter().filter_map(|(name, value)| Some((name.to_owned(), value?))));
        found
    }
}

/// Returns the attributes of a general actuator with these gains.
fn affine(gain: f64, bias: &str) -> Vec<(&'static str, Option<String>)> {
    [("gainprm", gain.to_string()), ("biastype", "affine".to_owned()), ("biasprm", bias.to_owned())]
        .map(|(name, value)| (name, Some(value)))
        .into()
}

/// Attributes of servos that set the same quantity.
pub(super) const REPLACED: [[&str; 2]; 2] = [["kv", "dampratio"], ["ctrlrange", "inheritrange"]];

/// Returns whether an attribute is an `inheritrange` of 0, under which a control range stays.
pub(super) fn inherits_nothing(name: &str, value: &str) -> bool {
    name == "inheritrange" && value.trim().parse() == Ok(0.0)
}

fn opposite<'a>([one, other]: &[&'a str; 2], name: &str) -> Option<&'a str> {
    if name == *one { Some(*other) } else { (name == *other).then_some(*one) }
}

/// Merges `over` into `under`. A list that may be shorter keeps the remaining numbers of the one under it.
fn merge(tag: &str, mut under: Vec<Attribute>, over: Vec<Attribute>) -> Vec<Attribute> {
    // Of two settings of one quantity, the one nearest to the element counts.
    let sets = over.iter().filter(|(name, value)| !inherits_nothing(name, value)).map(|(name, _)| name);
    for replaced in sets.flat_map(|name| REPLACED.iter().filter_map(move |pair| opposite(pair, name))) {
        under.retain(|(found, _)| found != replaced);
    }
    for (name, mut value) in over {
        let optional =
            matches!(vocabulary::rule(tag, &name), Some(AttributeRule::Numbers(least, most)) if least < most);
        match under.iter_mut().find(|(found, _)| *found == name) {
            Some((_, below)) => {
                let given = value.split_whitespace().count();
                if optional && given > 0 {
                    for rest in below.split_whitespace().skip(given) {
                        value.push(' ');
                        value.push_str(rest);
                    }
                }
                *below = value;
            }
            None => under.push((name, value)),
        }
    }
    under
}

#[cfg(test)]
mod tests {
    use super::*;
    use roxmltree::Document;

    /// Returns the element named `part` of a text, defaults included.
    fn part_of(text: &str) -> Result<Element, ModelError> {
        let document = Document::parse(text).expect("well-formed");
        let classes = Classes::of(document.root_element())?;
        let part = document.descendants().find(|node| node.attribute("name") == Some("part")).expect("a part");
        classes.with_defaults(part, Some("leg"), "part")
    }

    #[test]
    fn a_class_inherits_each_attribute_from_the_class_around_it() {
        let text = r#"<mujoco>
            <default>
              <default class="leg"><geom quat="0 1 0 0"/><default class="foot"><geom mass="2"/></default></default>
              <geom pos="1 2 3" size="0.1 0.2 0.3" friction="0.5"/>
            </default>
            <geom name="part" size="0.4"/></mujoco>"#;
        let part = part_of(text).expect("valid");
        // The element gives one size of three; position and orientation come from different classes.
        assert_eq!(part.get("size"), Some("0.4 0.2 0.3"));
        assert_eq!((part.get("pos"), part.get("quat")), (Some("1 2 3"), Some("0 1 0 0")));
        assert_eq!(part.get("mass"), None);
        let foot = part_of(&text.replace("name=\"part\"", "name=\"part\" class=\"foot\"")).expect("valid");
        assert_eq!((foot.get("mass"), foot.get("pos")), (Some("2"), Some("1 2 3")));
    }

    #[test]
    fn missing_duplicate_and_nameless_classes_are_refused() {
        let problem = |text: &str| part_of(text).expect_err("refused").to_string();
        assert!(problem("<mujoco><geom name='part'/></mujoco>").contains("class=\"leg\""));
        let twice =
            "<mujoco><default><default class='leg'/><default class='leg'/></default><geom name='part'/></mujoco>";
        assert!(problem(twice).contains("default leg"));
        let nameless = "<mujoco><default><default><geom/></default></default><geom name='part'/></mujoco>";
        assert!(problem(nameless).contains("needs a class"));
        let unknown = "<mujoco><default><geom wings='2'/></default><geom name='part'/></mujoco>";
        assert!(problem(unknown).contains("wings"));
        let renamed = "<mujoco><default class='all'><default class='leg'/></default><geom name='part'/></mujoco>";
        assert!(problem(renamed).contains("`class` is \"all\""));
    }
}
