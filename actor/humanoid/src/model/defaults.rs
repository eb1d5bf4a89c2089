//! Default classes, merged into the attributes of each element as in MuJoCo.
//!
//! `mjcf-rs` ignores unknown classes, and drops a default position from an element that gives only its orientation.
//! It therefore reads a text in which defaults are already filled in.

use std::collections::{BTreeMap, BTreeSet};

use roxmltree::Node;

use super::vocabulary::{self, AttributeRule, is_inert};
use crate::error::ModelError;

/// Name and value of an attribute.
pub(super) type Attribute = (String, String);

/// Returns the value of an attribute.
pub(super) fn get<'a>(attributes: &'a [Attribute], name: &str) -> Option<&'a str> {
    attributes.iter().find(|(found, _)| found == name).map(|(_, value)| value.as_str())
}

/// Class of elements that name none.
const MAIN: &str = "main";
/// Tags of supported actuators.
pub(super) const ACTUATORS: [&str; 4] = ["motor", "position", "velocity", "general"];

/// Defaults of one class, including those of its parents: attributes by tag.
type Class = BTreeMap<String, Vec<Attribute>>;

/// All classes of a model.
#[derive(Debug, Default)]
pub(super) struct Classes {
    classes: BTreeMap<String, Class>,
    /// Actuator tags that have defaults.
    pub(super) actuators: BTreeSet<String>,
}

impl Classes {
    /// Reads an outermost `<default>`; there may be several.
    pub(super) fn read_main(&mut self, node: Node<'_, '_>) -> Result<(), ModelError> {
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
            if is_inert(tag) || tag == "equality" {
                continue;
            }
            // Spatial tendons, which share these defaults, are refused.
            let tag = if tag == "tendon" { "fixed" } else { tag };
            if vocabulary::rules(tag).is_none() {
                return Err(ModelError::unsupported(&label, format!("<{tag}> is not supported")));
            }
            let attributes = attributes_of(child);
            for (attribute, value) in &attributes {
                let rule = vocabulary::rule(tag, attribute).ok_or_else(|| {
                    ModelError::unsupported(&label, format!("attribute `{attribute}` of <{tag}> is not supported"))
                })?;
                // A value that is not simulated is refused at the elements that inherit it, if any.
                if !matches!(rule, AttributeRule::Only(_))
                    && let Err(expected) = vocabulary::allowed(rule, value)
                {
                    return Err(ModelError::attribute(&label, attribute, value, expected));
                }
            }
            if ACTUATORS.contains(&tag) {
                self.actuators.insert(tag.to_owned());
            }
            let before = class.remove(tag).unwrap_or_default();
            class.insert(tag.to_owned(), merge(tag, before, attributes));
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

    /// Returns an element's attributes merged over its class's defaults; `ambient` is its body's `childclass`.
    pub(super) fn with_defaults(
        &self,
        node: Node<'_, '_>,
        ambient: Option<&str>,
        label: &str,
    ) -> Result<Vec<Attribute>, ModelError> {
        let tag = node.tag_name().name();
        let name = node.attribute("class").or(ambient).unwrap_or(MAIN);
        let under = match self.class(name, label)?.and_then(|class| class.get(tag)) {
            Some(attributes) => attributes.clone(),
            None => Vec::new(),
        };
        Ok(merge(tag, under, attributes_of(node)))
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

/// Returns an element's attributes without defaults.
pub(super) fn attributes_of(node: Node<'_, '_>) -> Vec<Attribute> {
    node.attributes().map(|attribute| (attribute.name().to_owned(), attribute.value().to_owned())).collect()
}

/// Attributes of servos that set the same quantity.
pub(super) const REPLACED: [[&str; 2]; 2] = [["kv", "dampratio"], ["ctrlrange", "inheritrange"]];

fn opposite<'a>([one, other]: &[&'a str; 2], name: &str) -> Option<&'a str> {
    if name == *one { Some(*other) } else { (name == *other).then_some(*one) }
}

/// Merges `over` into `under`. A list that may be shorter keeps the remaining numbers of the one under it.
fn merge(tag: &str, mut under: Vec<Attribute>, over: Vec<Attribute>) -> Vec<Attribute> {
    // Of two settings of one quantity, the one nearest to the element counts.
    for replaced in over.iter().flat_map(|(name, _)| REPLACED.iter().filter_map(move |pair| opposite(pair, name))) {
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

    /// Returns the attributes of the element named `part` in a text, defaults included.
    fn attributes_of_part(text: &str) -> Result<Vec<Attribute>, ModelError> {
        let document = Document::parse(text).expect("well-formed");
        let mut classes = Classes::default();
        for node in document.root_element().children().filter(|node| node.has_tag_name("default")) {
            classes.read_main(node)?;
        }
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
        let part = attributes_of_part(text).expect("valid");
        // The element gives one size of three; position and orientation come from different classes.
        assert_eq!(get(&part, "size"), Some("0.4 0.2 0.3"));
        assert_eq!((get(&part, "pos"), get(&part, "quat")), (Some("1 2 3"), Some("0 1 0 0")));
        assert_eq!(get(&part, "mass"), None);
        let foot = attributes_of_part(&text.replace("name=\"part\"", "name=\"part\" class=\"foot\"")).expect("valid");
        assert_eq!((get(&foot, "mass"), get(&foot, "pos")), (Some("2"), Some("1 2 3")));
    }

    #[test]
    fn missing_duplicate_and_nameless_classes_are_refused() {
        let problem = |text: &str| attributes_of_part(text).expect_err("refused").to_string();
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
