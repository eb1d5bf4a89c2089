//! Who may touch whom.
//!
//! Rapier tells pairs apart by 32 groups, MuJoCo by bits of each shape, by exclusions between bodies of the text, and by
//! neighbourhood in the tree. So shapes about which all of these say the same share a group.

use super::{Body, Shape};
use crate::error::ModelError;

/// The floor's group.
pub(crate) const FLOOR_GROUP: usize = 31;
/// Groups of shapes that move.
const GROUPS_MAX: usize = FLOOR_GROUP;

/// Two bodies of the text that never touch; `None` is the world.
pub(super) type Exclusion = [Option<usize>; 2];

/// What the rules know about the shapes of one group.
#[derive(Clone, Debug, PartialEq)]
struct Kind {
    body: usize,
    contype: u32,
    conaffinity: u32,
    /// Exclusions that one of its sides takes part in: for each, which side.
    excluded: Vec<(usize, usize)>,
}

/// Sorts the bodies' shapes into groups, and returns for each group the bits of those it may touch.
///
/// `links` gives for each shape, in order of the bodies, the body of the text that it was written in.
pub(super) fn sort(
    bodies: &mut [Body],
    links: &[Vec<usize>],
    floor: &Shape,
    exclusions: &[Exclusion],
) -> Result<Vec<u32>, ModelError> {
    let mut kinds: Vec<Kind> = Vec::new();
    for (index, body) in bodies.iter_mut().enumerate() {
        for (shape, link) in body.shapes.iter_mut().zip(&links[index]) {
            let kind = Kind {
                body: index,
                contype: shape.contype,
                conaffinity: shape.conaffinity,
                excluded: sides(exclusions, Some(*link)),
            };
            shape.group = kinds.iter().position(|known| *known == kind).unwrap_or(kinds.len());
            if shape.group == kinds.len() {
                if kinds.len() == GROUPS_MAX {
                    let problem = format!(
                        "there are more than {GROUPS_MAX} kinds of colliding shapes; give those of one body the same \
                         contype, conaffinity and exclusions"
                    );
                    return Err(ModelError::unsupported(&shape.name, problem));
                }
                kinds.push(kind);
            }
        }
    }
    let world = sides(exclusions, None);
    let masks = kinds.iter().map(|kind| {
        let touches = |other: &&(usize, &Kind)| {
            let other = other.1;
            let (mine, theirs) = (bodies[kind.body].parent, bodies[other.body].parent);
            kind.body != other.body
                && mine != Some(other.body)
                && theirs != Some(kind.body)
                && meet([kind.contype, kind.conaffinity], [other.contype, other.conaffinity])
                && !faces(&kind.excluded, &other.excluded)
        };
        let others: Vec<(usize, &Kind)> = kinds.iter().enumerate().collect();
        let limbs = others.iter().filter(touches).fold(0, |mask, (group, _)| mask | 1 << group);
        let on_floor = meet([kind.contype, kind.conaffinity], [floor.contype, floor.conaffinity])
            && !faces(&kind.excluded, &world);
        limbs | u32::from(on_floor) << FLOOR_GROUP
    });
    let masks: Vec<u32> = masks.collect();
    check_friction(bodies, floor, &masks)?;
    Ok(masks)
}

/// MuJoCo's rule: the type of one must be among what the other has affinity to.
fn meet([contype, conaffinity]: [u32; 2], [other_type, other_affinity]: [u32; 2]) -> bool {
    contype & other_affinity != 0 || other_type & conaffinity != 0
}

fn sides(exclusions: &[Exclusion], body: Option<usize>) -> Vec<(usize, usize)> {
    let takes_part = |(index, exclusion): (usize, &Exclusion)| {
        (0..2).filter(|side| exclusion[*side] == body).map(|side| (index, side)).collect::<Vec<_>>()
    };
    exclusions.iter().enumerate().flat_map(takes_part).collect()
}

/// Whether two stand on opposite sides of one exclusion.
fn faces(one: &[(usize, usize)], other: &[(usize, usize)]) -> bool {
    one.iter().any(|(index, side)| other.contains(&(*index, 1 - side)))
}

/// In MuJoCo a pair rubs if one of its shapes does, with the greater friction of the two, also where that is the one of
/// a shape that does not rub by itself. Rapier is given no friction for such a shape, which must come to the same.
fn check_friction(bodies: &[Body], floor: &Shape, masks: &[u32]) -> Result<(), ModelError> {
    let all: Vec<&Shape> = bodies.iter().flat_map(|body| &body.shapes).collect();
    for smooth in all.iter().filter(|shape| !shape.rubs) {
        let limbs = all.iter().filter(|other| masks[smooth.group] & 1 << other.group != 0).copied();
        let below = (masks[smooth.group] & 1 << FLOOR_GROUP != 0).then_some(floor);
        let mut partners = limbs.chain(below).filter(|other| other.rubs);
        if let Some(other) = partners.find(|other| other.friction < smooth.friction) {
            let problem = format!(
                "its friction of {} counts against `{}`, which has only {}; give both the same, or both condim=\"3\"",
                smooth.friction, other.name, other.friction
            );
            return Err(ModelError::unsupported(&smooth.name, problem));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_meet_by_either_ones_affinity() {
        assert!(meet([1, 1], [1, 1]));
        assert!(meet([1, 0], [0, 1]) && meet([0, 1], [1, 0]));
        assert!(!meet([1, 0], [1, 0]));
        assert!(!meet([0, 0], [3, 3]));
        assert!(meet([2, 1], [4, 6]));
    }

    #[test]
    fn exclusions_part_opposite_sides_only() {
        let exclusions = [[Some(1), Some(2)], [Some(2), None]];
        let of = |body| sides(&exclusions, body);
        assert!(faces(&of(Some(1)), &of(Some(2))) && faces(&of(Some(2)), &of(Some(1))));
        assert!(faces(&of(Some(2)), &of(None)));
        assert!(!faces(&of(Some(1)), &of(None)));
        assert!(!faces(&of(Some(2)), &of(Some(2))));
    }
}
