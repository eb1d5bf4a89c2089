//! Contacts that Rapier detects, with its solution as a first guess, and their impulses on the links.

use nalgebra::{Point3, Vector3};
use rapier3d::prelude::*;

use super::convert::{from_vector, to_vector};
use super::exchange::pose;
use super::world::{RapierWorld, Tag};
use crate::dynamics::{ContactPoint, Contacts, Posture};

/// Force between two links, or between a link and the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactForce {
    /// Indices into [`crate::Model::links`]; `None` is the floor.
    pub links: [Option<usize>; 2],
    /// Point at which it acts (m, world frame).
    pub at_m: Point3<f64>,
    /// Force on the first link (N, world frame); the opposite acts on the second.
    pub force_n: Vector3<f64>,
}

/// Impulse of all contacts on one link: force × time (N·s) and moment × time (N·m·s), world frame.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ContactImpulse {
    pub(super) linear_ns: Vector3<f64>,
    pub(super) angular_nms: Vector3<f64>,
}

/// Collects the contacts of Rapier's last step into `contacts`; `start` and `root_height_m` are the posture and root height
/// at the start of that step.
pub(super) fn collect(world: &RapierWorld, start: &Posture, root_height_m: f64, contacts: &mut Contacts) {
    contacts.points.clear();
    let root = Vector3::new(0.0, 0.0, root_height_m);
    for pair in world.rapier.narrow_phase.contact_pairs() {
        let colliders = &world.rapier.colliders;
        let (Some(first), Some(second)) = (colliders.get(pair.collider1), colliders.get(pair.collider2)) else {
            continue;
        };
        let tags = [first, second].map(Tag::of);
        let links = tags.map(|tag| tag.link);
        let margin_m = tags[0].margin_m + tags[1].margin_m;
        let bodies = links.map(|link| link.map(|link| world.link_bodies[link]));
        // Colliders have moved since Rapier detected the contact.
        let at_start = match (bodies[0], first.position_wrt_parent()) {
            (Some(body), Some(in_body)) => pose(start, body, &root) * *in_body,
            _ => *first.position(),
        };
        for manifold in pair.solver_manifolds() {
            let (mut normal_sum, mut normal_last) = (0.0, 0.0);
            for contact in &manifold.points {
                normal_sum += contact.data.impulse;
                normal_last += contact.data.warmstart_impulse;
            }
            for contact in &manifold.points {
                let data = &contact.data;
                // Rapier keeps the sum of the normal impulses, but the friction impulse of the last solver pass only. The
                // guess scales friction like the normal impulse.
                let share = if normal_last > 0.0 { data.impulse / normal_last } else { 0.0 };
                let friction = if normal_sum > 0.0 { data.warmstart_tangent_world * -share } else { Vector::ZERO };
                let middle = at_start.transform_point(contact.local_p1) + manifold.data.normal * (contact.dist / 2.0);
                contacts.push(ContactPoint {
                    bodies,
                    links,
                    position_m: from_vector(middle - to_vector(&root)),
                    normal: from_vector(manifold.data.normal).normalize(),
                    gap_m: f64::from(contact.dist) - margin_m,
                    friction: f64::from(manifold.data.friction),
                    impulse_ns: from_vector(manifold.data.normal * data.impulse + friction),
                });
            }
        }
    }
}

/// Adds the contacts' impulses to their links, with moments about `about_m` (relative to O).
pub(super) fn accumulate(contacts: &Contacts, about_m: &Vector3<f64>, impulses: &mut [ContactImpulse]) {
    for point in &contacts.points {
        // The solver's impulse acts on the second link.
        add_impulse(point.links, &point.position_m, &-point.impulse_ns, about_m, impulses);
    }
}

/// Adds an impulse (N·s) at a point (m) to the first link and its opposite to the second; `None` is the floor. Moments are
/// about `about_m`.
pub(super) fn add_impulse(
    links: [Option<usize>; 2],
    at_m: &Vector3<f64>,
    linear_ns: &Vector3<f64>,
    about_m: &Vector3<f64>,
    impulses: &mut [ContactImpulse],
) {
    let angular_nms = (at_m - about_m).cross(linear_ns);
    for (link, sign) in links.into_iter().zip([1.0, -1.0]) {
        if let Some(link) = link {
            impulses[link].linear_ns += linear_ns * sign;
            impulses[link].angular_nms += angular_nms * sign;
        }
    }
}
