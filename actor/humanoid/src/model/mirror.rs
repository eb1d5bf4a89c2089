//! Mirror images of positions, velocities, actions and observations, with left and right exchanged.

use nalgebra::{Isometry3, Point3, Vector3};

use super::Model;
use super::robot::counterpart;

/// For each entry of a mirrored vector, the index and the sign of the original entry that it holds.
pub type SignedPermutation = Vec<(usize, f32)>;

/// Greatest distance of a hinge from the mirror image of its counterpart (m), and least cosine between their axes:
/// files round.
const APART_MAX_M: f64 = 5e-3;
const COSINE_MIN: f64 = 1.0 - 1e-4;

/// Reflection in the plane y = 0 of a model whose hinges come in pairs of a left and a right one or lie in the plane.
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
}

impl Mirror {
    /// Returns the reflection of a model. Masses and shapes are not compared.
    ///
    /// # Errors
    /// A message that names the first hinge or motor without a mirror image.
    pub fn of(model: &Model) -> Result<Self, String> {
        let places = places(model);
        let names: Vec<&str> = model.hinges.iter().map(|hinge| &*hinge.name).collect();
        let mut hinges = Vec::new();
        for (hinge, (anchor_m, axis)) in model.hinges.iter().zip(&places) {
            let image = image(&hinge.name, &names, model);
            let name = &model.hinges[image].name;
            let (other_m, other_axis) = &places[image];
            let apart_m = (Vector3::new(anchor_m.x, -anchor_m.y, anchor_m.z) - other_m.coords).norm();
            // An axis is a pseudo-vector: a reflection inverts its components in the plane and keeps the one across.
            let cosine = other_axis.dot(&axis.component_mul(&Vector3::new(-1.0, 1.0, -1.0)));
            if cosine.abs() < COSINE_MIN || apart_m > APART_MAX_M {
                return Err(match *name == hinge.name {
                    true => {
                        format!("hinge `{name}` has no counterpart on the other side, and does not lie in the plane")
                    }
                    false => format!("hinge `{name}` is not the mirror image of `{}`", hinge.name),
                });
            }
            hinges.push((image, cosine.signum() as f32));
        }
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
        let names: Vec<&str> = model.links.iter().map(|link| &*link.name).collect();
        Ok(Self {
            position: with_root(&root_position, &hinges),
            velocity: with_root(&root_velocity, &hinges),
            action,
            links: names.iter().map(|name| image(name, &names, model)).collect(),
        })
    }
}

fn with_root(root: &[f32], hinges: &[(usize, f32)]) -> SignedPermutation {
    let own = root.iter().copied().enumerate();
    own.chain(hinges.iter().map(|(image, sign)| (root.len() + image, *sign))).collect()
}

/// Returns anchor (m) and axis of each hinge in the root's frame, with all hinges at zero.
fn places(model: &Model) -> Vec<(Point3<f64>, Vector3<f64>)> {
    let mut poses: Vec<Isometry3<f64>> = Vec::new();
    for body in &model.bodies {
        poses.push(body.parent.map_or(Isometry3::identity(), |parent| poses[parent] * body.pose));
    }
    let of_body = model.bodies.iter().zip(&poses).flat_map(|(body, pose)| {
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
