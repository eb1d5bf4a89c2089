//! Mirror images of positions, velocities, actions and observations, with left and right exchanged.

use nalgebra::{Isometry3, Point3, Vector3};

use super::robot::counterpart;
use super::{Connection, Coupling, Model};

/// For each entry of a mirrored vector, the index and the sign of the original entry that it holds.
pub type SignedPermutation = Vec<(usize, f32)>;

/// Greatest distance of a hinge from the mirror image of its counterpart (m), and least cosine between their axes, 2.6°:
/// files round, and some real robots differ a little from left to right.
const APART_MAX_M: f64 = 0.01;
const COSINE_MIN: f64 = 1.0 - 1e-3;
/// Greatest relative difference between the numbers of two equalities.
const COUPLING_MAX: f64 = 1e-3;
/// Greatest difference between the masses of two counterparts that are found by their places, as a share.
const MASS_MAX: f64 = 0.2;

/// Reflection in the plane y = 0 of a model whose hinges come in pairs of a left and a right one or lie in the plane.
///
/// Counterparts are those that the card names, else those whose names differ in their side, else those at the mirrored place
/// with the mirrored axis, about the same mass, and counterparts as parents.
#[derive(Clone, Debug, PartialEq)]
pub struct Mirror {
    /// Reflection of the position vector.
    pub position: SignedPermutation,
    /// Reflection of the velocity vector.
    pub velocity: SignedPermutation,
    /// Reflection of an action.
    pub action: SignedPermutation,
    /// Index of each link's image.
    pub links: Vec<usize>,
    /// Greatest distance of a hinge from the image of its counterpart (m), which the mirror neglects; held hinges that have
    /// none do not count.
    pub apart_m: f64,
}

impl Mirror {
    /// Returns the reflection of a model. Masses and shapes of counterparts by name are not compared.
    ///
    /// # Errors
    /// A message that names the first hinge, equality or motor without a mirror image.
    pub fn of(model: &Model) -> Result<Self, String> {
        let places = places(model);
        let names: Vec<&str> = model.hinges.iter().map(|hinge| &*hinge.name).collect();
        let (mut hinges, mut largest_m) = (Vec::new(), 0.0_f64);
        // Images of the bodies so far; parents are before their children.
        let mut bodies: Vec<usize> = vec![0; model.bodies.len()];
        for (body, of) in model.bodies.iter().enumerate() {
            for hinge in of.hinges.clone() {
                let name = names[hinge];
                let by_name = image(name, &names, model);
                let offset = |image: usize| offset(&places[hinge], &places[image]);
                let fits = |image: usize| {
                    let (apart_m, cosine) = offset(image);
                    apart_m <= APART_MAX_M && cosine.abs() >= COSINE_MIN
                };
                let by_place = || {
                    let is_like = |other: &usize| is_counterpart(model, &bodies, body, model.body_of_hinge(*other));
                    let mut alike: Vec<usize> = (0..names.len()).filter(|other| fits(*other)).filter(is_like).collect();
                    alike.sort_by(|one, other| offset(*one).0.total_cmp(&offset(*other).0));
                    alike.first().copied()
                };
                let is_held = model.robot.as_ref().is_some_and(|robot| robot.hinges[hinge].is_held);
                // No policy moves a hinge that is held, so it may lie beside the plane, as a head does.
                let image = Some(by_name).filter(|image| fits(*image)).or_else(by_place);
                let image = image.or_else(|| Some(by_name).filter(|_| is_held));
                let Some(image) = image else {
                    return Err(match by_name == hinge {
                        true => {
                            format!(
                                "hinge `{name}` has no counterpart on the other side, and does not lie in the plane"
                            )
                        }
                        false => format!("hinge `{}` is not the mirror image of `{name}`", names[by_name]),
                    });
                };
                let (apart_m, cosine) = offset(image);
                if fits(image) {
                    largest_m = largest_m.max(apart_m);
                }
                bodies[body] = model.body_of_hinge(image);
                hinges.push((image, cosine.signum() as f32));
            }
        }
        check_couplings(&model.couplings, &hinges)?;
        check_connections(model, &bodies)?;
        let mut action = Vec::new();
        for motor in &model.motors {
            let (hinge, sign) = hinges[motor.hinge];
            let alike = |gear: f64| (gear.abs() - motor.gear_nm.abs()).abs() < 1e-9;
            let image = model.motors.iter().position(|other| other.hinge == hinge && alike(other.gear_nm));
            let image = image.ok_or_else(|| format!("motor `{}` has no mirror image", motor.name))?;
            action.push((image, sign * (model.motors[image].gear_nm * motor.gear_nm).signum() as f32));
        }
        // Position x, y, z, then quaternion w, x, y, z, whose vector part is a pseudo-vector.
        let root_position = [1.0, -1.0, 1.0, 1.0, -1.0, 1.0, -1.0];
        let root_velocity = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0];
        Ok(Self {
            position: with_root(&root_position, &hinges),
            velocity: with_root(&root_velocity, &hinges),
            action,
            links: (0..model.links.len()).map(|link| link_image(model, &bodies, link)).collect(),
            apart_m: largest_m,
        })
    }
}

/// Checks that the mirror image of each coupling is a coupling; `hinges` has the image and the sign of each hinge.
fn check_couplings(couplings: &[Coupling], hinges: &[(usize, f32)]) -> Result<(), String> {
    let equal = |one: f64, other: f64| (one - other).abs() <= COUPLING_MAX * one.abs().max(1.0);
    for coupling in couplings {
        let (image, sign) = hinges[coupling.hinge];
        let offset_rad = f64::from(sign) * coupling.offset_rad;
        let follows = coupling.follows.map(|(other, ratio)| {
            let (other, other_sign) = hinges[other];
            (other, f64::from(sign * other_sign) * ratio)
        });
        let is_image = |found: &Coupling| match (found.follows, follows) {
            (None, None) => found.hinge == image && equal(found.offset_rad, offset_rad),
            (Some((leads, found_ratio)), Some((other, ratio))) => {
                let same = found.hinge == image && leads == other;
                let swapped = found.hinge == other && leads == image;
                (same && equal(found_ratio, ratio) && equal(found.offset_rad, offset_rad))
                    // y = a + b x is x = −a/b + y/b.
                    || (swapped && equal(found_ratio * ratio, 1.0) && equal(found.offset_rad * ratio, -offset_rad))
            }
            _ => false,
        };
        if !couplings.iter().any(is_image) {
            return Err(format!("the equality `{}` has no mirror image", coupling.name));
        }
    }
    Ok(())
}

/// Checks that the mirror image of each connection is a connection; `bodies` has the image of each body.
fn check_connections(model: &Model, bodies: &[usize]) -> Result<(), String> {
    let poses = poses(model);
    let ends = |connection: &Connection| {
        let end = |end: usize| {
            let body = model.links[connection.links[end]].body;
            (body, poses[body] * connection.points_m[end])
        };
        [end(0), end(1)]
    };
    for connection in &model.connections {
        let images = ends(connection).map(|(body, point_m)| (bodies[body], mirrored(&point_m)));
        let is_at = |image: (usize, Point3<f64>), found: (usize, Point3<f64>)| {
            image.0 == found.0 && (image.1 - found.1).norm() <= APART_MAX_M
        };
        let is_image = |found: &Connection| {
            let [one, other] = ends(found);
            is_at(images[0], one) && is_at(images[1], other) || is_at(images[0], other) && is_at(images[1], one)
        };
        if !model.connections.iter().any(is_image) {
            return Err(format!("the equality `{}` has no mirror image", connection.name));
        }
    }
    Ok(())
}

/// Returns the mirror image of a point.
fn mirrored(point_m: &Point3<f64>) -> Point3<f64> {
    Point3::new(point_m.x, -point_m.y, point_m.z)
}

/// Returns how far the mirror image of a place is from another one (m), and the cosine between its axis and the other's.
fn offset((anchor_m, axis): &Place, (other_m, other_axis): &Place) -> (f64, f64) {
    let apart_m = (mirrored(anchor_m) - other_m).norm();
    // An axis is a pseudo-vector: a reflection inverts its components in the plane and keeps the one across.
    (apart_m, other_axis.dot(&axis.component_mul(&Vector3::new(-1.0, 1.0, -1.0))))
}

/// Returns whether a body may be the image of another one, given the images of those before it.
fn is_counterpart(model: &Model, images: &[usize], body: usize, other: usize) -> bool {
    let (of_body, of_other) = (&model.bodies[body], &model.bodies[other]);
    let masses_kg = [of_body.mass_kg, of_other.mass_kg];
    let are_alike = (masses_kg[0] - masses_kg[1]).abs() <= MASS_MAX * masses_kg[0].max(masses_kg[1]);
    are_alike && of_body.parent.map(|parent| images[parent]) == of_other.parent
}

/// Returns the image of a link: by its name, or else the link at the same place of its body's image.
fn link_image(model: &Model, images: &[usize], link: usize) -> usize {
    let names: Vec<&str> = model.links.iter().map(|link| &*link.name).collect();
    let body = model.links[link].body;
    let by_name = image(names[link], &names, model);
    if model.links[by_name].body == images[body] {
        return by_name;
    }
    let of = |body: usize| (0..names.len()).filter(move |link| model.links[*link].body == body);
    let place = of(body).position(|other| other == link).unwrap_or_default();
    of(images[body]).nth(place).unwrap_or(link)
}

fn with_root(root: &[f32], hinges: &[(usize, f32)]) -> SignedPermutation {
    let own = root.iter().copied().enumerate();
    own.chain(hinges.iter().map(|(image, sign)| (root.len() + image, *sign))).collect()
}

/// Anchor (m) and axis of a hinge.
type Place = (Point3<f64>, Vector3<f64>);

/// Returns where each body is in the root's frame, with all hinges at zero.
fn poses(model: &Model) -> Vec<Isometry3<f64>> {
    let mut poses: Vec<Isometry3<f64>> = Vec::new();
    for body in &model.bodies {
        poses.push(body.parent.map_or(Isometry3::identity(), |parent| poses[parent] * body.pose));
    }
    poses
}

/// Returns where each hinge is in the root's frame, with all hinges at zero.
fn places(model: &Model) -> Vec<Place> {
    let of_body = model.bodies.iter().zip(poses(model)).flat_map(|(body, pose)| {
        model.hinges[body.hinges.clone()].iter().map(move |hinge| (pose * hinge.anchor_m, pose.rotation * *hinge.axis))
    });
    of_body.collect()
}

/// Returns the index of the name of the other side, or that of the name itself.
fn image(name: &str, names: &[&str], model: &Model) -> usize {
    let find = |name: &str| names.iter().position(|other| *other == name);
    let swapped = [["left", "right"], ["Left", "Right"], ["LEFT", "RIGHT"]].into_iter().flat_map(|[left, right]| {
        [(left, right), (right, left)].map(|(from, to)| name.contains(from).then(|| name.replacen(from, to, 1)))
    });
    let letter = |part: &str| match part {
        "l" => Some("r"),
        "r" => Some("l"),
        "L" => Some("R"),
        "R" => Some("L"),
        _ => None,
    };
    let parts: Vec<&str> = name.split('_').collect();
    let by_part = parts.iter().position(|part| letter(part).is_some()).map(|place| {
        let mut parts = parts.clone();
        parts[place] = letter(parts[place]).unwrap_or_default();
        parts.join("_")
    });
    let by_first = name.get(..1).and_then(letter).map(|first| format!("{first}{}", &name[1..]));
    let of_card = model.robot.iter().flat_map(|robot| &robot.symmetry).map(|pair| counterpart(name, pair));
    let candidates = of_card.chain(swapped).chain([by_part, by_first]).flatten();
    candidates.filter_map(|name| find(&name)).chain(find(name)).next().unwrap_or_default()
}
