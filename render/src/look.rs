//! Look of a robot: coloured surfaces on its bodies.

use std::{iter, sync::Arc};

use nalgebra::{Isometry3, Point3};
use treadmill_humanoid::{
    Mirror, Model,
    mjcf::VisualMesh,
    model::{Geometry, HeightField, Link},
};

use crate::{TriangleMesh, raster::Skin, scene::ground_skin};

/// Red, green and blue, each from 0 to 1.
pub type Colour = [f64; 3];

/// Limbs are coloured by side, which shows which leg is in front.
pub const LEFT: Colour = [0.93, 0.55, 0.24];
/// Colour of what is on the right.
pub const RIGHT: Colour = [0.18, 0.56, 0.60];
const MIDDLE: Colour = [0.85, 0.83, 0.78];
/// Share of the side's colour in that of a limb whose file has a colour of its own.
const TINT: f64 = 0.6;
/// Size of the smallest details that are drawn, as a share of the height of the base, and at least (m).
const DETAIL: f64 = 0.003;
const DETAIL_MIN_M: f64 = 1e-4;
/// Density of a body without shape (kg/m³), which gives it a thickness, and bounds of its radius (m).
const DENSITY_KGPM3: f64 = 1000.0;
const RADIUS_M: [f64; 2] = [0.012, 0.07];

/// Surface on a body, in the body's frame.
#[derive(Clone, Debug)]
pub struct RobotPart {
    /// Index of the body.
    pub body: usize,
    /// Surface.
    pub mesh: TriangleMesh,
    /// Colour in the file, or by the side.
    pub colour: Colour,
    /// Colour by the side, mixed with that in the file.
    pub tinted: Colour,
}

/// Returns the meshes of a robot's file; if they are of another robot, or there are none, its colliding shapes. A body
/// without any is a capsule to each body that hangs on it, and at the end of a limb one to its centre of mass.
#[must_use]
pub fn parts(model: &Model, visuals: &[VisualMesh]) -> Vec<RobotPart> {
    let colours = colours(model);
    let of_file = |visual: &VisualMesh| {
        let (index, link) = model.links.iter().enumerate().find(|(_, link)| link.name == visual.link)?;
        let [red, green, blue, _] = visual.colour;
        let (colour, side) = ([red, green, blue], colours[index]);
        let tinted = if side == MIDDLE {
            colour
        } else {
            iter::zip(colour, side).map(tint).collect::<Vec<_>>().try_into().ok()?
        };
        Some(RobotPart { body: link.body, mesh: placed(model, link, visual), colour, tinted })
    };
    let found: Vec<RobotPart> = visuals.iter().filter_map(of_file).collect();
    // Robots of other makers share some names of links.
    if 2 * found.len() > visuals.len() {
        return found;
    }
    let part = |body: usize, shape: &Geometry, link: Option<usize>| {
        let colour = link.map_or(MIDDLE, |link| colours[link]);
        RobotPart { body, mesh: TriangleMesh::of(shape), colour, tinted: colour }
    };
    let mut parts = Vec::new();
    for (index, body) in model.bodies.iter().enumerate() {
        for (number, shape) in body.shapes.iter().enumerate() {
            parts.push(part(index, &shape.geometry, model.link_of_shape(index, number)));
        }
        if body.shapes.is_empty() {
            let link = model.links.iter().position(|link| link.body == index);
            parts.extend(capsules(model, index).map(|capsule| part(index, &capsule, link)));
        }
    }
    parts
}

fn tint((own, side): (f64, f64)) -> f64 {
    own + (side - own) * TINT
}

/// Returns the mesh of a file in the frame of its link's body.
fn placed(model: &Model, link: &Link, visual: &VisualMesh) -> TriangleMesh {
    let pose = model.pose_in_file(link) * visual.pose;
    let place = |corner: &[f32; 3]| {
        let placed: Point3<f64> = pose * Point3::from(corner.map(f64::from));
        placed.coords.map(|part| part as f32).into()
    };
    let corners_m = visual.vertices_m.iter().map(place).collect();
    TriangleMesh { corners_m, triangles: visual.faces.clone(), is_faceted: false }
}

/// Returns capsules from a body's frame to those of the bodies that hang on it, or to its centre of mass.
fn capsules(model: &Model, index: usize) -> impl Iterator<Item = Geometry> {
    let body = &model.bodies[index];
    let ends = model.bodies.iter().filter(|child| child.parent == Some(index));
    let mut ends: Vec<Point3<f64>> = ends.map(|child| child.pose.translation.vector.into()).collect();
    if ends.is_empty() {
        ends.push(body.centre_of_mass_m);
    }
    let length_m: f64 = ends.iter().map(|end| end.coords.norm()).sum();
    let area_m2 = body.mass_kg / (DENSITY_KGPM3 * length_m.max(0.01));
    let radius_m = (area_m2 / std::f64::consts::PI).sqrt().clamp(RADIUS_M[0], RADIUS_M[1]);
    ends.into_iter().map(move |to_m| Geometry::Capsule { from_m: Point3::origin(), to_m, radius_m })
}

/// Returns the colour of each link: by its place if the model is symmetric, and else by the side in its name.
#[must_use]
pub fn colours(model: &Model) -> Vec<Colour> {
    let Ok(mirror) = Mirror::of(model) else {
        return model.links.iter().map(|link| by_name(&link.name)).collect();
    };
    let mut poses: Vec<Isometry3<f64>> = Vec::new();
    for body in &model.bodies {
        poses.push(body.parent.map_or(Isometry3::identity(), |parent| poses[parent] * body.pose));
    }
    let left_m = |link: usize| (poses[model.links[link].body] * model.links[link].centre_of_mass_m).y;
    let colour = |(link, image): (usize, &usize)| match left_m(link) > left_m(*image) {
        _ if link == *image => MIDDLE,
        true => LEFT,
        false => RIGHT,
    };
    mirror.links.iter().enumerate().map(colour).collect()
}

fn by_name(name: &str) -> Colour {
    let name = name.to_lowercase();
    let has = |word: &str, letter: &str| name.contains(word) || name.split('_').any(|part| part == letter);
    match (has("left", "l"), has("right", "r")) {
        (true, false) => LEFT,
        (false, true) => RIGHT,
        _ => MIDDLE,
    }
}

/// Surfaces of a robot, ready to be drawn at any pose.
#[derive(Clone, Debug)]
pub struct Look {
    pub(crate) skins: Vec<(usize, Arc<Skin>, Colour)>,
    /// Ground that is not level.
    pub(crate) ground: Option<(Arc<HeightField>, Arc<Skin>)>,
}

impl Look {
    /// Returns the look of a robot, see [`parts`], and of its model's ground.
    #[must_use]
    pub fn of(model: &Model, visuals: &[VisualMesh]) -> Self {
        let detail_m = (DETAIL * model.nominal_position()[2]).max(DETAIL_MIN_M) as f32;
        let skin = |part: RobotPart| (part.body, Skin::of(&part.mesh, detail_m), part.tinted);
        let ground = |field: &Arc<HeightField>| (field.clone(), ground_skin(field));
        Self {
            skins: parts(model, visuals).into_iter().map(skin).collect(),
            ground: model.ground.height_field.as_ref().map(ground),
        }
    }
}

#[cfg(test)]
#[path = "look_tests.rs"]
mod tests;
