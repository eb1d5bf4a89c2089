//! Collision groups: which shapes may touch each other.
//!
//! Rapier filters pairs by 32 groups. MuJoCo filters them by bits of each shape, by exclusions between bodies, and by
//! parenthood. Shapes for which all of these agree share a group.

use super::{Body, Shape};
use crate::error::ModelError;

/// Group of the floor.
pub(crate) const FLOOR_GROUP: usize = 31;
/// Most groups of moving shapes.
const GROUPS_MAX: usize = FLOOR_GROUP;

/// Two MJCF bodies that never touch; `None` is the world.
pub(super) type Exclusion = [Option<usize>; 2];

/// Collision rules that the shapes of one group share.
#[derive(Clone, Debug, PartialEq)]
struct GroupRules {
    body: usize,
    contype: u32,
    conaffinity: u32,
    /// Index of each [`Exclusion`] that names the shapes' MJCF body, and the side that names it.
    excluded: Vec<(usize, usize)>,
}

/// Assigns the bodies' shapes to groups. Returns for each group the bits of the groups that it may touch.
///
/// `origins` holds the MJCF body of each shape, as `[body][shape]`.
pub(super) fn assign_groups(
    bodies: &mut [Body],
    origins: &[Vec<usize>],
    floor: &Shape,
    exclusions: &[Exclusion],
) -> Result<Vec<u32>, ModelError> {
    let mut groups: Vec<GroupRules> = Vec::new();
    for (index, body) in bodies.iter_mut().enumerate() {
        for (shape, origin) in body.shapes.iter_mut().zip(&origins[index]) {
            let rules = GroupRules {
                body: index,
                contype: shape.contype,
                conaffinity: shape.conaffinity,
                excluded: exclusion_sides(exclusions, Some(*origin)),
            };
            shape.group = groups.iter().position(|known| *known == rules).unwrap_or(groups.len());
            if shape.group == groups.len() {
                if groups.len() == GROUPS_MAX {
                    let problem = format!(
                        "colliding shapes need more than {GROUPS_MAX} collision groups; give the shapes of one body \
                         the same contype, conaffinity and exclusions"
                    );
                    return Err(ModelError::unsupported(&shape.name, problem));
                }
                groups.push(rules);
            }
        }
    }
    let world = exclusion_sides(exclusions, None);
    let masks = groups.iter().map(|own| {
        let may_touch = |(_, other): &(usize, &GroupRules)| {
            let (own_parent, other_parent) = (bodies[own.body].parent, bodies[other.body].parent);
            own.body != other.body
                && own_parent != Some(other.body)
                && other_parent != Some(own.body)
                && filters_match([own.contype, own.conaffinity], [other.contype, other.conaffinity])
                && !is_excluded(&own.excluded, &other.excluded)
        };
        let others = groups.iter().enumerate().filter(may_touch).fold(0, |mask, (group, _)| mask | 1 << group);
        let on_floor = filters_match([own.contype, own.conaffinity], [floor.contype, floor.conaffinity])
            && !is_excluded(&own.excluded, &world);
        others | u32::from(on_floor) << FLOOR_GROUP
    });
    let masks: Vec<u32> = masks.collect();
    check_friction(bodies, floor, &masks)?;
    Ok(masks)
}

/// MuJoCo's rule: the `contype` of one shape shares a bit with the `conaffinity` of the other.
fn filters_match([contype, conaffinity]: [u32; 2], [other_type, other_affinity]: [u32; 2]) -> bool {
    contype & other_affinity != 0 || other_type & conaffinity != 0
}

fn exclusion_sides(exclusions: &[Exclusion], body: Option<usize>) -> Vec<(usize, usize)> {
    let sides_of = |(index, exclusion): (usize, &Exclusion)| {
        (0..2).filter(|side| exclusion[*side] == body).map(|side| (index, side)).collect::<Vec<_>>()
    };
    exclusions.iter().enumerate().flat_map(sides_of).collect()
}

/// Returns whether two lists of exclusion sides hold opposite sides of one exclusion.
fn is_excluded(one: &[(usize, usize)], other: &[(usize, usize)]) -> bool {
    one.iter().any(|(index, side)| other.contains(&(*index, 1 - side)))
}

/// Refuses a frictionless shape (`condim` 1) whose coefficient would count against a shape with friction.
///
/// In MuJoCo a pair has friction if one of its shapes has it, with the greater coefficient of the two. Rapier gets
/// coefficient 0 for a frictionless shape, which is the same only if the partner's coefficient is the greater one.
fn check_friction(bodies: &[Body], floor: &Shape, masks: &[u32]) -> Result<(), ModelError> {
    let all: Vec<&Shape> = bodies.iter().flat_map(|body| &body.shapes).collect();
    for smooth in all.iter().filter(|shape| !shape.has_friction) {
        let moving = all.iter().filter(|other| masks[smooth.group] & 1 << other.group != 0).copied();
        let below = (masks[smooth.group] & 1 << FLOOR_GROUP != 0).then_some(floor);
        let mut partners = moving.chain(below).filter(|other| other.has_friction);
        if let Some(other) = partners.find(|other| other.friction < smooth.friction) {
            let problem = format!(
                "its friction of {} counts against `{}`, which has only {}; give both the same friction, or both condim=\"3\"",
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
    fn either_shapes_affinity_is_enough() {
        assert!(filters_match([1, 1], [1, 1]));
        assert!(filters_match([1, 0], [0, 1]) && filters_match([0, 1], [1, 0]));
        assert!(!filters_match([1, 0], [1, 0]));
        assert!(!filters_match([0, 0], [3, 3]));
        assert!(filters_match([2, 1], [4, 6]));
    }

    #[test]
    fn an_exclusion_separates_only_its_two_sides() {
        let exclusions = [[Some(1), Some(2)], [Some(2), None]];
        let of = |body| exclusion_sides(&exclusions, body);
        assert!(is_excluded(&of(Some(1)), &of(Some(2))) && is_excluded(&of(Some(2)), &of(Some(1))));
        assert!(is_excluded(&of(Some(2)), &of(None)));
        assert!(!is_excluded(&of(Some(1)), &of(None)));
        assert!(!is_excluded(&of(Some(2)), &of(Some(2))));
    }
}
