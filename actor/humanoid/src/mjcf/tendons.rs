//! Fixed tendons: weighted sums of hinge angles, with or without limits.
//!
//! [`super::vocabulary`] refuses tendons that exert other forces.

use super::element::Element;
use crate::error::ModelError;
use crate::model::{Hinge, TENDONS_MAX, Tendon};

/// Reads tendons, each with its terms.
pub(super) fn read(
    tendons: &[(Element, Vec<Element>)],
    hinges: &[Hinge],
    autolimits: bool,
) -> Result<Vec<Tendon>, ModelError> {
    if let Some((beyond, _)) = tendons.get(TENDONS_MAX) {
        let problem = format!("there are {} tendons, but at most {TENDONS_MAX} are supported", tendons.len());
        return Err(beyond.refused(problem));
    }
    tendons.iter().map(|(tendon, terms)| read_fixed(tendon, terms, hinges, autolimits)).collect()
}

fn read_fixed(tendon: &Element, terms: &[Element], hinges: &[Hinge], autolimits: bool) -> Result<Tendon, ModelError> {
    let read_term = |term: &Element| {
        let joint = term.text("joint");
        let hinge = hinges.iter().position(|hinge| hinge.name == joint);
        let hinge = hinge.ok_or_else(|| term.refused(format!("`{joint}` is not a hinge of this model")))?;
        Ok((hinge, term.number("coef").unwrap_or(1.0)))
    };
    let terms = terms.iter().map(read_term).collect::<Result<Vec<_>, ModelError>>()?;
    if terms.is_empty() {
        return Err(tendon.refused("a fixed tendon needs at least one joint"));
    }
    Ok(Tendon {
        name: tendon.text("name"),
        terms,
        range: tendon.range("range", "limited", autolimits)?,
        limit_softness: tendon.softness(["solreflimit", "solimplimit"])?.softness(),
        limit_margin: tendon.amount("margin", "margin")?,
    })
}
