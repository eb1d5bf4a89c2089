//! Coloured shapes of a body, at their poses.

use nalgebra::{Isometry3, Point3, Vector3};
use treadmill_humanoid::{Physics, model::Geometry};

use crate::{
    solid::{Ball, Hit, Ray, Solid},
    surface::Surface,
};

/// Red, green and blue, each from 0 to 1.
pub type Colour = [f64; 3];

/// Limbs are coloured by side, which shows which leg is in front.
const LEFT: Colour = [0.93, 0.55, 0.24];
const RIGHT: Colour = [0.18, 0.56, 0.60];
const MIDDLE: Colour = [0.85, 0.83, 0.78];
/// Radius of an arrow's shaft (m).
const ARROW_RADIUS_M: f64 = 0.015;

/// Coloured shapes above the ground.
#[derive(Clone, Debug)]
pub struct Scene {
    surface: Surface,
    solids: Vec<(Solid, Colour)>,
    bound: Option<Ball>,
}

impl Scene {
    /// Returns a level scene without shapes.
    #[must_use]
    pub fn empty() -> Self {
        Self { surface: Surface::new(None), solids: Vec::new(), bound: None }
    }

    /// Returns the shapes of a body at their current poses.
    #[must_use]
    pub fn of(physics: &Physics) -> Self {
        let model = physics.model();
        let mut solids = Vec::new();
        for (index, (body, motion)) in model.bodies.iter().zip(physics.body_motions()).enumerate() {
            for (number, shape) in body.shapes.iter().enumerate() {
                let link = model.link_of_shape(index, number).map_or(&body.name, |link| &model.links[link].name);
                solids.push((Solid::new(&shape.geometry, &motion.pose), colour(link)));
            }
        }
        let bound = bound(&solids);
        Self { surface: Surface::new(model.ground.height_field.as_deref()), solids, bound }
    }

    /// Adds a horizontal arrow with a ball as its tip, from a point in the world.
    pub fn add_arrow(&mut self, from_m: [f64; 3], along_m: [f64; 2], colour: Colour) {
        let from_m = Point3::from(from_m);
        let to_m = from_m + Vector3::new(along_m[0], along_m[1], 0.0);
        let shaft = Geometry::Capsule { from_m, to_m, radius_m: ARROW_RADIUS_M };
        let tip = Geometry::Sphere { centre_m: to_m, radius_m: 2.0 * ARROW_RADIUS_M };
        self.solids.extend([shaft, tip].map(|part| (Solid::new(&part, &Isometry3::identity()), colour)));
        self.bound = bound(&self.solids);
    }

    pub(crate) fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Returns the first hit of a ray on a shape.
    pub(crate) fn hit(&self, ray: &Ray) -> Option<(Hit, Colour)> {
        if !self.is_near(ray) {
            return None;
        }
        let mut first: Option<(Hit, Colour)> = None;
        for (solid, colour) in &self.solids {
            let nearest_m = first.map_or(f64::INFINITY, |(hit, _)| hit.distance_m);
            if solid.bound.may_hit(ray, nearest_m)
                && let Some(hit) = solid.hit(ray)
                && hit.distance_m < nearest_m
            {
                first = Some((hit, *colour));
            }
        }
        first
    }

    /// Returns whether a ray hits any shape.
    pub(crate) fn is_hit(&self, ray: &Ray) -> bool {
        self.is_near(ray)
            && self.solids.iter().any(|(solid, _)| solid.bound.may_hit(ray, f64::INFINITY) && solid.hit(ray).is_some())
    }

    fn is_near(&self, ray: &Ray) -> bool {
        self.bound.is_some_and(|bound| bound.may_hit(ray, f64::INFINITY))
    }
}

fn bound(solids: &[(Solid, Colour)]) -> Option<Ball> {
    let sum: nalgebra::Vector3<f64> = solids.iter().map(|(solid, _)| solid.bound.centre.coords).sum();
    let centre = Point3::from(sum / solids.len().max(1) as f64);
    let reach = |(solid, _): &(Solid, Colour)| nalgebra::distance(&centre, &solid.bound.centre) + solid.bound.radius_m;
    let radius_m = solids.iter().map(reach).reduce(f64::max)?;
    Some(Ball { centre, radius_m })
}

/// Returns the colour of a link by the side in its name.
#[must_use]
pub fn colour(name: &str) -> Colour {
    match (name.contains("left"), name.contains("right")) {
        (true, false) => LEFT,
        (false, true) => RIGHT,
        _ => MIDDLE,
    }
}
