//! Pairs of shapes that may touch, with the parameters of their contacts.
//!
//! Pairs and parameters are MuJoCo's: two geoms may touch by their bits, unless their bodies are equal, neighbours or
//! excluded; a `<pair>` needs none of this and has parameters of its own.

use std::collections::{BTreeMap, BTreeSet};

use super::element::Element;
use super::geoms::{self, MARGIN_MAX_M};
use crate::error::ModelError;
use crate::model::{Body, Pair, Shape, ShapeIndex, SolverNumbers, not_negative};

/// Most pairs: they take 15 MB.
const PAIRS_MAX: usize = 1 << 17;
/// Least weight of a geom in MuJoCo's mixtures.
const WEIGHT_MIN: f64 = 1e-15;

/// Indices of two MJCF bodies that never touch; 0 is the world.
pub(super) type Exclusion = [usize; 2];

/// Contact parameters of one geom.
#[derive(Clone, Debug)]
pub(super) struct ContactRules {
    /// `contype` and `conaffinity`.
    bits: [u32; 2],
    /// Whether it has friction by itself: `condim` is 3, not 1.
    has_friction: bool,
    priority: i32,
    solmix: f64,
    solver: SolverNumbers,
}

impl Default for ContactRules {
    fn default() -> Self {
        Self { bits: [1, 1], has_friction: true, priority: 0, solmix: 1.0, solver: SolverNumbers::default() }
    }
}

impl ContactRules {
    /// Reads the attributes that [`Shape`] does not hold.
    pub(super) fn read(geom: &Element) -> Result<Self, ModelError> {
        Ok(Self {
            bits: geoms::bits(geom)?,
            has_friction: geoms::has_friction(geom)?,
            priority: geom.whole("priority", 0)?,
            solmix: not_negative(&geom.label, "solmix", geom.number("solmix").unwrap_or(1.0))?,
            solver: geom.softness(["solref", "solimp"])?,
        })
    }
}

/// Shape with its contact parameters and the index of its MJCF body; 0 is the world.
#[derive(Clone, Copy)]
pub(super) struct Party<'a> {
    pub(super) shape: &'a Shape,
    pub(super) rules: &'a ContactRules,
    pub(super) origin: usize,
}

/// Everything that decides which shapes touch.
pub(super) struct Source<'a> {
    pub(super) bodies: &'a [Body],
    /// Contact parameters and MJCF body of each shape, as `[body][shape]`.
    pub(super) rules: &'a [Vec<(ContactRules, usize)>],
    pub(super) ground: Party<'a>,
    pub(super) exclusions: &'a [Exclusion],
    /// Each `<pair>`.
    pub(super) explicit: &'a [Element],
}

impl<'a> Source<'a> {
    /// Returns all pairs: those with the ground first, each kind in the order of the model.
    pub(super) fn pairs(&self) -> Result<Vec<Pair>, ModelError> {
        let explicit = self.read_explicit()?;
        let excluded: BTreeSet<Exclusion> =
            self.exclusions.iter().flat_map(|[one, other]| [[*one, *other], [*other, *one]]).collect();
        let all: Vec<ShapeIndex> = self.shapes().map(|(index, _)| index).collect();
        let on_ground = all.iter().map(|first| (*first, None));
        let between = all
            .iter()
            .enumerate()
            .flat_map(|(place, first)| all[place + 1..].iter().map(move |second| (*first, Some(*second))));
        let mut pairs = Vec::new();
        for (first, second) in on_ground.chain(between) {
            let found = match explicit.get(&(first, second)) {
                Some(pair) => Some(pair.clone()),
                None => self.may_touch(first, second, &excluded).then(|| self.mixed(first, second)),
            };
            if pairs.len() == PAIRS_MAX && found.is_some() {
                let problem = format!(
                    "more than {PAIRS_MAX} pairs of shapes may touch; set contype and conaffinity of shapes that need \
                     not touch each other"
                );
                return Err(ModelError::unsupported("contact", problem));
            }
            pairs.extend(found);
        }
        Ok(pairs)
    }

    fn shapes(&self) -> impl Iterator<Item = (ShapeIndex, &'a Shape)> {
        self.bodies.iter().enumerate().flat_map(|(body, data)| {
            data.shapes.iter().enumerate().map(move |(shape, data)| (ShapeIndex { body, shape }, data))
        })
    }

    fn party(&self, index: Option<ShapeIndex>) -> Party<'a> {
        let Some(ShapeIndex { body, shape }) = index else { return self.ground };
        let (rules, origin) = &self.rules[body][shape];
        Party { shape: &self.bodies[body].shapes[shape], rules, origin: *origin }
    }

    fn may_touch(&self, first: ShapeIndex, second: Option<ShapeIndex>, excluded: &BTreeSet<Exclusion>) -> bool {
        let are_apart = second.is_none_or(|second| {
            let (one, other) = (first.body, second.body);
            one != other && self.bodies[one].parent != Some(other) && self.bodies[other].parent != Some(one)
        });
        let (one, other) = (self.party(Some(first)), self.party(second));
        are_apart
            && filters_match(one.rules.bits, other.rules.bits)
            && (excluded.is_empty() || !excluded.contains(&[one.origin, other.origin]))
    }

    /// Returns a pair with the contact parameters of its two shapes mixed.
    fn mixed(&self, first: ShapeIndex, second: Option<ShapeIndex>) -> Pair {
        let (one, other) = (self.party(Some(first)), self.party(second));
        let friction = |party: &Party<'_>| if party.rules.has_friction { party.shape.friction } else { 0.0 };
        let (friction, solver) = match one.rules.priority.cmp(&other.rules.priority) {
            std::cmp::Ordering::Greater => (friction(&one), one.rules.solver),
            std::cmp::Ordering::Less => (friction(&other), other.rules.solver),
            std::cmp::Ordering::Equal => {
                // The coefficient of a shape without friction counts if the other one has friction.
                let has_friction = one.rules.has_friction || other.rules.has_friction;
                let friction = if has_friction { one.shape.friction.max(other.shape.friction) } else { 0.0 };
                (friction, one.rules.solver.mixed(&other.rules.solver, share(one.rules.solmix, other.rules.solmix)))
            }
        };
        let margin_m = one.shape.margin_m + other.shape.margin_m;
        Pair { first, second, friction: [friction; 2], margin_m, softness: solver.softness() }
    }

    fn read_explicit(&self) -> Result<BTreeMap<(ShapeIndex, Option<ShapeIndex>), Pair>, ModelError> {
        let mut pairs = BTreeMap::new();
        if self.explicit.is_empty() {
            return Ok(pairs);
        }
        let mut places: BTreeMap<&str, Option<ShapeIndex>> =
            self.shapes().map(|(index, shape)| (shape.name.as_str(), Some(index))).collect();
        places.insert(&self.ground.shape.name, None);
        for element in self.explicit {
            let find = |side: &str| {
                let name = element.get(side).ok_or_else(|| element.refused(format!("`{side}` is missing")))?;
                places.get(name).copied().ok_or_else(|| element.refused(format!("there is no geom `{name}`")))
            };
            let (first, second) = match (find("geom1")?, find("geom2")?) {
                (Some(one), Some(other)) if one.body != other.body => (one.min(other), Some(one.max(other))),
                (Some(one), None) | (None, Some(one)) => (one, None),
                _ => return Err(element.refused("its geoms belong to one rigid body; remove the pair")),
            };
            let pair = explicit_pair(element, first, second)?;
            if pairs.insert((first, second), pair).is_some() {
                return Err(element.refused("there are two pairs of these geoms; remove one"));
            }
        }
        Ok(pairs)
    }
}

/// MuJoCo's rule: the `contype` of one shape shares a bit with the `conaffinity` of the other.
fn filters_match([contype, conaffinity]: [u32; 2], [other_type, other_affinity]: [u32; 2]) -> bool {
    contype & other_affinity != 0 || other_type & conaffinity != 0
}

/// Returns the share of the first geom in a mixture.
fn share(weight: f64, other: f64) -> f64 {
    match (weight >= WEIGHT_MIN, other >= WEIGHT_MIN) {
        (true, true) => weight / (weight + other),
        (true, false) => 1.0,
        (false, true) => 0.0,
        (false, false) => 0.5,
    }
}

/// Reads the parameters of a `<pair>`; missing ones have MJCF's defaults, not those of the geoms.
fn explicit_pair(element: &Element, first: ShapeIndex, second: Option<ShapeIndex>) -> Result<Pair, ModelError> {
    let has_friction = geoms::has_friction(element)?;
    let friction = element.list_over("friction", [1.0, 1.0]);
    let margin_m = element.amount("margin", "margin (m)")?;
    if margin_m > 2.0 * MARGIN_MAX_M {
        return Err(ModelError::quantity(&element.label, "margin (m)", margin_m, "between 0 and 0.02"));
    }
    for coefficient in friction {
        not_negative(&element.label, "friction", coefficient)?;
    }
    let softness = element.softness(["solref", "solimp"])?.softness();
    Ok(Pair { first, second, friction: if has_friction { friction } else { [0.0; 2] }, margin_m, softness })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn either_shapes_affinity_is_enough() {
        assert!(filters_match([1, 1], [1, 1]));
        assert!(filters_match([1, 0], [0, 1]) && filters_match([0, 1], [1, 0]));
        assert!(!filters_match([1, 0], [1, 0]));
        assert!(!filters_match([0, 0], [3, 3]));
        assert!(filters_match([2, 1], [4, 6]));
    }
}
