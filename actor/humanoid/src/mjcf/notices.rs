//! What was read differently, what MuJoCo refuses, and what is ignored.

use std::collections::{BTreeMap, BTreeSet};

use roxmltree::{Document, Node};

use super::element::Attribute;
use super::motion_text::is_motion;
use super::vocabulary::is_inert;
use super::xml::{self, elements, sections};
use super::{assets, card_text};

/// Name of a `<text>` in `<custom>` that holds a note.
const NOTICE: &str = "treadmill_notice";
/// Attributes of earlier versions that MuJoCo 4.0 does not know, by element.
const GONE: [(&str, &str); 5] = [
    ("compiler", "convexhull exactmeshinertia"),
    ("option", "apirate collision mpr_iterations mpr_tolerance"),
    ("flag", "passive sensornoise"),
    ("motor position velocity", "actlimited actearly"),
    ("mesh", "octree_maxdepth"),
];

/// Returns the notes in an MJCF text, and what MuJoCo 4.0 would refuse in it.
pub(super) fn of(document: &Document<'_>) -> Vec<String> {
    let root = document.root_element();
    let texts = sections(root, "custom").flat_map(elements).filter(is_notice);
    let mut notes: Vec<String> = texts.filter_map(|node| node.attribute("data").map(str::to_owned)).collect();
    let refused: BTreeSet<String> = root.descendants().filter(Node::is_element).flat_map(refused).collect();
    notes.extend(refused.into_iter().map(|what| format!("MuJoCo 4.0 refuses this file: {what}")));
    notes
}

/// Returns what MuJoCo 4.0 refuses in an element that is read here.
fn refused(node: Node<'_, '_>) -> Vec<String> {
    let tag = node.tag_name().name();
    if tag == "default" {
        let mut seen = BTreeSet::new();
        let kinds = elements(node).map(|part| part.tag_name().name()).filter(|kind| *kind != "default");
        let class = node.attribute("class").unwrap_or("main");
        let twice = kinds.filter(|kind| !seen.insert(*kind)).map(|kind| format!("class `{class}` has <{kind}> twice"));
        return twice.collect();
    }
    let gone = GONE.iter().filter(|(tags, _)| tags.split(' ').any(|of| of == tag));
    let gone = gone.flat_map(|(_, attributes)| attributes.split(' ')).filter(|name| node.has_attribute(*name));
    gone.map(|name| format!("<{tag}> has `{name}`, which it no longer knows")).collect()
}

/// Writes notes of a kind into a text as `<text>`s of a `<custom>`; names are unique, as MuJoCo wants them.
pub(super) fn write(text: &mut String, kind: &str, notes: &[String]) {
    for (number, note) in notes.iter().enumerate() {
        xml::write(text, "text", &attributes(&format!("{kind}_{number}"), note.clone()));
    }
}

/// Returns the attributes of a note; `key` is unique.
pub(super) fn attributes(key: &str, note: String) -> Vec<Attribute> {
    vec![("name".to_owned(), format!("{NOTICE}_{key}")), ("data".to_owned(), note)]
}

/// Returns whether a node is the `<text>` of a note.
pub(super) fn is_notice(node: &Node<'_, '_>) -> bool {
    node.attribute("name").is_some_and(|name| name.starts_with(NOTICE))
}

/// Returns the kinds of elements that the simulation ignores, with their counts: of those within each other only the
/// outermost.
pub(super) fn ignored(root: Node<'_, '_>) -> BTreeMap<String, usize> {
    fn count(node: Node<'_, '_>, found: &mut BTreeMap<String, usize>) {
        for child in elements(node) {
            let tag = child.tag_name().name();
            match is_inert(tag) {
                true if matches!(tag, "sensor" | "custom") => {
                    let within = elements(child)
                        .filter(|part| !card_text::is_card(part) && !is_motion(part))
                        .filter(|part| !is_notice(part) && !assets::is_moments(part));
                    let count = within.count();
                    if count > 0 {
                        *found.entry(tag.to_owned()).or_default() += count;
                    }
                }
                true => *found.entry(tag.to_owned()).or_default() += 1,
                false if tag == "default" => {}
                false => count(child, found),
            }
        }
    }
    let mut found = BTreeMap::new();
    count(root, &mut found);
    found
}
