//! Names of parts of a tree, and elements that refer to them.

use std::collections::BTreeSet;

use super::element_tree::Piece;

/// Attributes that refer to a part, and the kind of the part.
const REFERENCES: [(&str, &str); 11] = [
    ("joint", "joint joint1 joint2 jointinparent"),
    ("body", "body body1 body2 target"),
    ("geom", "geom geom1 geom2"),
    ("site", "site site1 site2 refsite cranksite slidersite"),
    ("tendon", "tendon tendon1 tendon2"),
    ("actuator", "actuator"),
    ("class", "class childclass"),
    ("mesh", "mesh"),
    ("hfield", "hfield"),
    ("material", "material"),
    ("texture", "texture"),
];

/// Returns the kind of part that an attribute refers to.
fn kind_of(attribute: &str) -> Option<&'static str> {
    let refers = |(_, attributes): &&(&str, &str)| attributes.split(' ').any(|name| name == attribute);
    REFERENCES.iter().find(refers).map(|(kind, _)| *kind)
}

/// Returns whether an attribute refers to another element.
pub(super) fn is_reference(attribute: &str) -> bool {
    kind_of(attribute).is_some()
}

/// How the names of a copy differ.
pub(super) enum Change {
    /// Not at all.
    None,
    Prefix(String),
    Suffix(String),
}

impl Change {
    fn of(&self, name: &str) -> String {
        match self {
            Self::None => name.to_owned(),
            Self::Prefix(prefix) => format!("{prefix}{name}"),
            Self::Suffix(suffix) => format!("{name}{suffix}"),
        }
    }
}

/// Kinds and names of parts.
pub(super) struct Names(BTreeSet<(&'static str, String)>);

impl Names {
    /// Returns those of elements of the tree and all that is in them.
    pub(super) fn within(elements: &[Piece]) -> Self {
        let mut names = Self(BTreeSet::new());
        elements.iter().for_each(|element| names.collect(element));
        names
    }

    fn collect(&mut self, element: &Piece) {
        let kind = match element.tag.as_str() {
            "joint" | "freejoint" => Some("joint"),
            tag => ["body", "geom", "site"].into_iter().find(|kind| *kind == tag),
        };
        if let Some((kind, name)) = kind.zip(element.get("name")) {
            self.0.insert((kind, name.to_owned()));
        }
        element.children.iter().for_each(|child| self.collect(child));
    }

    /// Adds the names of elements of a section, if others may refer to them.
    pub(super) fn add(&mut self, section: &str, elements: &[Piece]) {
        if section == "tendon" {
            self.0.extend(elements.iter().filter_map(|tendon| Some(("tendon", tendon.get("name")?.to_owned()))));
        }
    }

    fn has(&self, attribute: &str, name: &str) -> bool {
        kind_of(attribute).is_some_and(|kind| self.0.contains(&(kind, name.to_owned())))
    }

    /// Returns whether an element, or one in it, refers to one of the parts.
    pub(super) fn are_in(&self, element: &Piece) -> bool {
        element.attributes.iter().any(|(attribute, name)| self.has(attribute, name))
            || element.children.iter().any(|child| self.are_in(child))
    }

    /// Returns whether all parts that an element, or one in it, refers to are among these; the world is always there.
    pub(super) fn have_all_of(&self, element: &Piece) -> bool {
        let is_here = |(attribute, name): &(String, String)| match kind_of(attribute) {
            Some("joint" | "body" | "geom" | "site" | "tendon") => name == "world" || self.has(attribute, name),
            _ => true,
        };
        element.attributes.iter().all(is_here) && element.children.iter().all(|child| self.have_all_of(child))
    }

    /// Changes the names of an element and of all in it, and what refers to the parts.
    pub(super) fn apply(&self, element: &mut Piece, change: &Change) {
        for (attribute, value) in &mut element.attributes {
            if attribute == "name" || self.has(attribute, value) {
                *value = change.of(value);
            }
        }
        element.children.iter_mut().for_each(|child| self.apply(child, change));
    }
}
