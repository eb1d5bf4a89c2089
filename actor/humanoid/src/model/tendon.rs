//! Fixed tendons: sums over hinge angles that are told about and exert no force.

use roxmltree::{Document, Node};

use super::{Hinge, Tendon};
use crate::error::ModelError;

/// More tendons than this are refused: their lengths are part of what every step tells, which allocates nothing.
pub const TENDONS_MAX: usize = 16;

/// Attributes with which a tendon would act on the body, unless they are zero.
const ACTING: [&str; 4] = ["stiffness", "damping", "frictionloss", "armature"];
/// Attributes that limit a tendon, by the attribute that gives the range.
const LIMITING: [(&str, &str); 2] = [("limited", "range"), ("actuatorfrclimited", "actuatorfrcrange")];

/// Reads the tendons of a model text that was parsed to `source`; refuses those that would do anything.
pub(super) fn read(text: &str, source: &mjcf_rs::Model, hinges: &[Hinge]) -> Result<Vec<Tendon>, ModelError> {
    refuse_acting(text)?;
    for equality in &source.equality {
        if let mjcf_rs::equality::Equality::Tendon(coupled) = equality {
            return Err(ModelError::unsupported(
                &coupled.tendon1,
                "an equality would hold this tendon, which is not simulated; remove it",
            ));
        }
    }
    if source.tendons.len() > TENDONS_MAX {
        return Err(ModelError::unsupported("tendon", format!("at most {TENDONS_MAX} tendons are told about")));
    }
    source.tendons.iter().enumerate().map(|(index, tendon)| read_fixed(index, tendon, hinges)).collect()
}

fn read_fixed(index: usize, tendon: &mjcf_rs::tendon::FixedTendon, hinges: &[Hinge]) -> Result<Tendon, ModelError> {
    let name = tendon.name.clone().unwrap_or_else(|| format!("tendon {index}"));
    let terms: Vec<(usize, f64)> = tendon
        .joints
        .iter()
        .map(|term| {
            let hinge = hinges
                .iter()
                .position(|hinge| hinge.name == term.joint)
                .ok_or_else(|| ModelError::unsupported(&name, format!("`{}` is no hinge of this model", term.joint)))?;
            if !term.coef.is_finite() {
                return Err(ModelError::Figure {
                    element: name.clone(),
                    figure: "coef",
                    value: term.coef,
                    expected: "finite",
                });
            }
            Ok((hinge, term.coef))
        })
        .collect::<Result<_, _>>()?;
    if terms.is_empty() {
        return Err(ModelError::unsupported(&name, "a fixed tendon needs at least one joint"));
    }
    Ok(Tendon { name, terms })
}

/// Looks through the text itself, since the parser passes over what it does not know of tendons.
fn refuse_acting(text: &str) -> Result<(), ModelError> {
    let document = Document::parse(text).map_err(|why| ModelError::Parse(mjcf_rs::ParseError::Xml(why)))?;
    let elements = |node: Node<'_, '_>, tag: &str| node.is_element() && node.has_tag_name(tag);
    for block in document.root_element().children().filter(|node| elements(*node, "tendon")) {
        for tendon in block.children().filter(Node::is_element) {
            let name = tendon.attribute("name").unwrap_or("tendon");
            if !tendon.has_tag_name("fixed") {
                let kind = tendon.tag_name().name();
                return Err(ModelError::unsupported(
                    name,
                    format!("{kind} tendons are not simulated; only fixed ones are"),
                ));
            }
            if let Some(term) = tendon.children().find(|term| term.is_element() && !is_term(term)) {
                let found = term.tag_name().name();
                return Err(ModelError::unsupported(name, format!("`{found}` in it is no <joint joint=\"…\">")));
            }
            refuse_attributes(name, tendon)?;
        }
    }
    // The defaults of tendons stand in blocks of their own, at any depth.
    let defaults = document.descendants().filter(|node| elements(*node, "default"));
    for tendon in defaults.flat_map(|node| node.children()).filter(|node| elements(*node, "tendon")) {
        refuse_attributes("default tendon", tendon)?;
    }
    Ok(())
}

fn is_term(node: &Node<'_, '_>) -> bool {
    node.has_tag_name("joint") && node.has_attribute("joint")
}

fn refuse_attributes(name: &str, tendon: Node<'_, '_>) -> Result<(), ModelError> {
    let refuse = |attribute: &str, value: &str| {
        let problem = format!("{attribute} is {value}, but tendons are told about and do not act; remove it");
        Err(ModelError::unsupported(name, problem))
    };
    let is_zero = |number: &str| number.parse::<f64>().is_ok_and(|number| number == 0.0);
    for attribute in ACTING {
        if let Some(value) = tendon.attribute(attribute)
            && !value.split_whitespace().all(is_zero)
        {
            return refuse(attribute, value);
        }
    }
    for (switch, range) in LIMITING {
        match (tendon.attribute(switch), tendon.attribute(range)) {
            (Some("false"), _) | (None | Some("auto"), None) => {}
            (_, Some(value)) => return refuse(range, value),
            (Some(value), None) => return refuse(switch, value),
        }
    }
    Ok(())
}
