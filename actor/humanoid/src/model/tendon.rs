//! Fixed tendons: weighted sums of hinge angles, with or without limits.
//!
//! [`super::flatten`] refuses tendons that exert other forces.

use mjcf_rs::tendon::FixedTendon;

use super::defaults::Attribute;
use super::softness::SolverNumbers;
use super::values::{amount, range};
use super::{Hinge, Tendon};
use crate::error::ModelError;

/// Most tendons; a bound because every step's info holds their lengths without allocating.
pub const TENDONS_MAX: usize = 16;

/// Reads the tendons of a plain model text; `attributes` are those of each.
pub(super) fn read(
    tendons: &[FixedTendon],
    attributes: &[Vec<Attribute>],
    hinges: &[Hinge],
    autolimits: bool,
) -> Result<Vec<Tendon>, ModelError> {
    if let Some(beyond) = tendons.get(TENDONS_MAX) {
        let problem = format!("there are {} tendons, but at most {TENDONS_MAX} are supported", tendons.len());
        return Err(ModelError::unsupported(beyond.name.as_deref().unwrap_or("tendon"), problem));
    }
    let both = tendons.iter().zip(attributes);
    both.map(|(tendon, attributes)| read_fixed(tendon, attributes, hinges, autolimits)).collect()
}

fn read_fixed(
    tendon: &FixedTendon,
    attributes: &[Attribute],
    hinges: &[Hinge],
    autolimits: bool,
) -> Result<Tendon, ModelError> {
    let name = tendon.name.clone().unwrap_or_default();
    let terms: Vec<(usize, f64)> = tendon
        .joints
        .iter()
        .map(|term| {
            let hinge = hinges.iter().position(|hinge| hinge.name == term.joint).ok_or_else(|| {
                ModelError::unsupported(&name, format!("`{}` is not a hinge of this model", term.joint))
            })?;
            if !term.coef.is_finite() {
                return Err(ModelError::quantity(&name, "coef", term.coef, "finite"));
            }
            Ok((hinge, term.coef))
        })
        .collect::<Result<_, _>>()?;
    if terms.is_empty() {
        return Err(ModelError::unsupported(&name, "a fixed tendon needs at least one joint"));
    }
    Ok(Tendon {
        terms,
        range: range(&name, attributes, "range", "limited", autolimits)?,
        limit_softness: SolverNumbers::read(&name, attributes, ["solreflimit", "solimplimit"])?.softness(),
        limit_margin: amount(&name, attributes, "margin", "margin")?,
        name,
    })
}
