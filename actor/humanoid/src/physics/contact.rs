//! Contact forces on the links, read off Rapier after a physics step.

use nalgebra::{Point3, Vector3};
use rapier3d::prelude::*;

use super::convert::from_vector;
use super::world::World;

/// A force between two links, or between a link and the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactForce {
    /// The two links, as indices into [`crate::Model::links`]; `None` is the floor.
    pub links: [Option<usize>; 2],
    /// Where it acts (m, world frame).
    pub at_m: Point3<f64>,
    /// What the first link feels (N, world frame); the second one feels the opposite.
    pub force_n: Vector3<f64>,
}

/// Impulse of all contacts on one link: force × time (N·s) and moment × time (N·m·s), world frame.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ContactImpulse {
    pub(super) linear_ns: Vector3<f64>,
    pub(super) angular_nms: Vector3<f64>,
}

/// Adds the impulses of the physics step just done, with moments about `about` (m, Rapier's world); says whether there
/// were any.
pub(super) fn accumulate(world: &World, about: &Point3<f64>, impulses: &mut [ContactImpulse]) -> bool {
    let mut touched = false;
    for pair in world.rapier.narrow_phase.contact_pairs() {
        if !pair.has_any_active_contact() {
            continue;
        }
        let colliders = &world.rapier.colliders;
        let (Some(first), Some(second)) = (colliders.get(pair.collider1), colliders.get(pair.collider2)) else {
            continue;
        };
        let links = [first.user_data, second.user_data].map(|data| (data as usize).checked_sub(1));
        for manifold in pair.solver_manifolds() {
            let (mut rubbing, mut pressed, mut pressed_last) = (None, 0.0, 0.0);
            for contact in &manifold.points {
                if contact.data.impulse == 0.0 {
                    continue;
                }
                touched = true;
                let at = first.position().transform_point(contact.local_p1);
                let impulse = from_vector(manifold.data.normal * -contact.data.impulse);
                push(links, from_vector(at), impulse, about, impulses);
                pressed += contact.data.impulse;
                pressed_last += contact.data.warmstart_impulse;
                rubbing = Some((at, contact.data.warmstart_tangent_world));
            }
            // Rapier solves friction once per manifold, stores it with every contact, and keeps the last solver pass
            // only. Taking it to be in proportion to the normal impulse, of which both the sum and the last pass are
            // known, is the closest reading there is.
            if let Some((at, impulse)) = rubbing
                && pressed_last > 0.0
            {
                let impulse = from_vector(impulse * (pressed / pressed_last));
                push(links, from_vector(at), impulse, about, impulses);
            }
        }
    }
    touched
}

/// Gives an impulse (N·s) at a point (m) to the first link and its opposite to the second; `None` is the floor.
pub(super) fn push(
    links: [Option<usize>; 2],
    at: Vector3<f64>,
    linear: Vector3<f64>,
    about: &Point3<f64>,
    impulses: &mut [ContactImpulse],
) {
    let angular = (at - about.coords).cross(&linear);
    for (link, sign) in links.into_iter().zip([1.0, -1.0]) {
        if let Some(link) = link {
            impulses[link].linear_ns += linear * sign;
            impulses[link].angular_nms += angular * sign;
        }
    }
}
