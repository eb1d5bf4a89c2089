//! Another order of a model's bodies, joints and motors.

use std::collections::HashMap;

use roxmltree::Node;

use super::element::numbers;
use super::xml::{elements, parse_model};
use crate::error::ModelError;
use crate::model::Model;

/// Places of named elements in a document, by kind and name.
type Places<'a> = HashMap<(&'static str, &'a str), usize>;

/// Returns a model text whose hinges and motors have the order of those in `reference`, so that a policy of that model can
/// move it: they are the same if their names are.
///
/// # Errors
/// If one of the texts is no model, or the hinges or motors have other names.
pub fn in_order_of(text: &str, reference: &str) -> Result<String, ModelError> {
    let (given, wanted) = (Model::from_mjcf(text)?, Model::from_mjcf(reference)?);
    let names = |model: &Model| {
        [
            model.hinges.iter().map(|hinge| hinge.name.clone()).collect::<Vec<_>>(),
            model.motors.iter().map(|motor| motor.name.clone()).collect(),
        ]
    };
    let (given_names, wanted_names) = (names(&given), names(&wanted));
    if given_names == wanted_names {
        return Ok(text.to_owned());
    }
    let document = parse_model(reference)?;
    let mut places = Places::new();
    for (place, node) in document.descendants().enumerate() {
        if let Some(key) = key(&node) {
            places.insert(key, place);
        }
    }
    let mut ordered = String::with_capacity(text.len());
    let document = parse_model(text)?;
    ordered.push_str(&text[..document.root_element().range().start]);
    write_ordered(document.root_element(), text, &places, &mut ordered);
    ordered.push_str(&text[document.root_element().range().end..]);
    // Keyframes still have the old order, which is as long.
    let found_names = names(&Model::from_mjcf(&ordered)?);
    for ((kind, found), wanted) in ["hinge", "motor"].into_iter().zip(&found_names).zip(&wanted_names) {
        if found.len() != wanted.len() {
            let problem = format!("it has {} {kind}s, the policy's has {}", found.len(), wanted.len());
            return Err(ModelError::OtherBody(problem));
        }
        if let Some((number, (found, wanted))) =
            found.iter().zip(wanted).enumerate().find(|(_, (found, wanted))| found != wanted)
        {
            let number = number + 1;
            return Err(ModelError::OtherBody(format!("its {kind} {number} is `{found}`, the policy's is `{wanted}`")));
        }
    }
    let moved = |kind: usize| -> Vec<usize> {
        let place = |name: &String| given_names[kind].iter().position(|given| given == name).unwrap_or_default();
        found_names[kind].iter().map(place).collect()
    };
    with_keys(&ordered, &moved(0), &moved(1))
}

/// Returns kind and name of an element whose order counts.
fn key<'a>(node: &Node<'a, '_>) -> Option<(&'static str, &'a str)> {
    let is_motor = node.parent().is_some_and(|parent| parent.has_tag_name("actuator"));
    match node.tag_name().name() {
        _ if is_motor => Some(("motor", node.attribute("name").or_else(|| node.attribute("joint"))?)),
        "body" => Some(("body", node.attribute("name")?)),
        "joint" if !node.parent().is_some_and(|parent| parent.has_tag_name("equality")) => {
            Some(("joint", node.attribute("name")?))
        }
        _ => None,
    }
}

/// Writes an element with its elements of each kind in the order of their places, if all have one.
fn write_ordered(node: Node<'_, '_>, text: &str, places: &Places<'_>, ordered: &mut String) {
    let mut slots: Vec<_> = elements(node).collect();
    for kind in ["motor", "body", "joint"] {
        let of_kind = |slot: &usize| key(&slots[*slot]).is_some_and(|(found, _)| found == kind);
        let taken: Vec<usize> = (0..slots.len()).filter(of_kind).collect();
        let mut members: Vec<_> = taken.iter().map(|slot| slots[*slot]).collect();
        let place = |node: &Node<'_, '_>| key(node).and_then(|key| places.get(&key).copied());
        if members.iter().all(|node| place(node).is_some()) {
            members.sort_by_key(place);
            taken.into_iter().zip(members).for_each(|(slot, node)| slots[slot] = node);
        }
    }
    let mut from = node.range().start;
    for (child, written) in elements(node).zip(slots) {
        ordered.push_str(&text[from..child.range().start]);
        write_ordered(written, text, places, ordered);
        from = child.range().end;
    }
    ordered.push_str(&text[from..node.range().end]);
}

/// Returns a text whose keyframes have their numbers in another order: entry `i` of the hinges comes from `hinges[i]`.
fn with_keys(text: &str, hinges: &[usize], motors: &[usize]) -> Result<String, ModelError> {
    let document = parse_model(text)?;
    let mut changed = text.to_owned();
    let sections = elements(document.root_element()).filter(|section| section.has_tag_name("keyframe"));
    let attributes: Vec<_> = sections.flat_map(elements).flat_map(|key| key.attributes()).collect();
    // From the back, so that the places before stay.
    for attribute in attributes.into_iter().rev() {
        let (root, order) = match attribute.name() {
            "qpos" => (7, hinges),
            "qvel" => (6, hinges),
            "ctrl" => (0, motors),
            _ => continue,
        };
        let Some(list) = numbers(attribute.value()).filter(|list| list.len() == root + order.len()) else { continue };
        let reordered = list[..root].iter().copied().chain(order.iter().map(|from| list[root + from]));
        let numbers: Vec<String> = reordered.map(|number: f64| number.to_string()).collect();
        changed.replace_range(attribute.range_value(), &numbers.join(" "));
    }
    Ok(changed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mjcf::HUMANOID_XML;

    fn hinges(text: &str) -> Vec<String> {
        Model::from_mjcf(text).unwrap().hinges.into_iter().map(|hinge| hinge.name).collect()
    }

    /// Returns the built-in humanoid with its thighs and its motors in the other order, and a keyframe of either.
    fn swapped() -> [String; 2] {
        let document = parse_model(HUMANOID_XML).unwrap();
        let of = |name| document.descendants().find(|node| node.attribute("name") == Some(name)).unwrap().range();
        let [right, left] = ["right_thigh", "left_thigh"].map(of);
        let (first, second) = if right.start < left.start { (right, left) } else { (left, right) };
        let text = HUMANOID_XML;
        let other = [
            &text[..first.start],
            &text[second.clone()],
            &text[first.end..second.start],
            &text[first],
            &text[second.end..],
        ];
        let with_key = |text: &str| {
            let list: Vec<String> = hinges(text).iter().map(|name| (name.len() as f64 / 100.0).to_string()).collect();
            let key = format!("<keyframe><key name=\"k\" qpos=\"0 0 1.4 1 0 0 0 {}\"/></keyframe>", list.join(" "));
            text.replace("</mujoco>", &(key + "</mujoco>"))
        };
        [with_key(text), with_key(&other.concat())]
    }

    #[test]
    fn a_model_in_another_order_becomes_the_same() {
        let [reference, other] = swapped();
        assert_ne!(hinges(&other), hinges(&reference));
        let ordered = in_order_of(&other, &reference).unwrap();
        let (found, wanted) = (Model::from_mjcf(&ordered).unwrap(), Model::from_mjcf(&reference).unwrap());
        assert_eq!(format!("{found:?}"), format!("{wanted:?}"));
        assert_eq!(in_order_of(&reference, &reference).unwrap(), reference);
    }

    #[test]
    fn another_body_is_refused_with_the_first_part_that_differs() {
        let renamed = HUMANOID_XML.replace("right_knee", "knee_on_the_right");
        let why = in_order_of(&renamed, HUMANOID_XML).unwrap_err().to_string();
        assert!(why.contains("hinge ") && why.contains("`knee_on_the_right`") && why.contains("`right_knee`"), "{why}");
    }
}
