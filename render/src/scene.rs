//! Coloured surfaces in the world.

use std::sync::Arc;

use nalgebra::{Isometry3, Point3, Vector3};
use treadmill_humanoid::{
    Physics,
    model::{Geometry, HeightField},
};

use crate::{
    TriangleMesh,
    look::{Colour, Look},
    raster::Skin,
};

/// Radius of an arrow's shaft (m).
const ARROW_RADIUS_M: f64 = 0.015;

/// Surface in the world.
#[derive(Clone, Debug)]
pub(crate) struct PlacedSkin {
    pub skin: Arc<Skin>,
    pub pose: Isometry3<f32>,
    /// `None` is the ground, whose colour depends on the place.
    pub colour: Option<Colour>,
    /// Whether it throws a shadow.
    pub is_solid: bool,
}

/// Size of the smallest details of ground and arrows (m).
const DETAIL_M: f32 = 1e-4;

/// Coloured surfaces above the ground.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    pub(crate) placed: Vec<PlacedSkin>,
    /// How many of them are the robot; they are the first ones.
    robot: usize,
    field: Option<Arc<HeightField>>,
}

/// Returns the surface of ground that is not level, which takes longer than to draw it.
pub(crate) fn ground_skin(field: &HeightField) -> Arc<Skin> {
    Skin::of(&TriangleMesh::of_field(field), DETAIL_M)
}

impl Scene {
    /// Returns a level scene without surfaces.
    #[must_use]
    pub fn empty() -> Self {
        Self::default()
    }

    /// Returns the colliding shapes of a body at their current poses.
    #[must_use]
    pub fn of(physics: &Physics) -> Self {
        Self::with(&Look::of(physics.model(), &[]), physics)
    }

    /// Returns a body with this look at its current pose.
    #[must_use]
    pub fn with(look: &Look, physics: &Physics) -> Self {
        let poses: Vec<Isometry3<f32>> = physics.body_motions().map(|motion| motion.pose.cast()).collect();
        let place = |(body, skin, colour): &(usize, Arc<Skin>, Colour)| PlacedSkin {
            skin: skin.clone(),
            pose: poses[*body],
            colour: Some(*colour),
            is_solid: true,
        };
        let mut placed: Vec<PlacedSkin> = look.skins.iter().map(place).collect();
        let robot = placed.len();
        let field = physics.model().ground.height_field.clone();
        let known = |field: &Arc<HeightField>| look.ground.as_ref().filter(|(known, _)| Arc::ptr_eq(known, field));
        let skin = |field: &Arc<HeightField>| known(field).map_or_else(|| ground_skin(field), |(_, skin)| skin.clone());
        let ground = field.as_ref().map(skin);
        placed.extend(ground.map(|skin| PlacedSkin {
            skin,
            pose: Isometry3::identity(),
            colour: None,
            is_solid: false,
        }));
        Self { placed, robot, field }
    }

    /// Adds another robot with this look at its current pose, in one colour and without a shadow.
    pub fn add_ghost(&mut self, look: &Look, physics: &Physics, colour: Colour) {
        let poses: Vec<Isometry3<f32>> = physics.body_motions().map(|motion| motion.pose.cast()).collect();
        self.placed.extend(look.skins.iter().map(|(body, skin, _)| PlacedSkin {
            skin: skin.clone(),
            pose: poses[*body],
            colour: Some(colour),
            is_solid: false,
        }));
    }

    /// Adds a horizontal arrow with a ball as its tip, from a point in the world.
    pub fn add_arrow(&mut self, from_m: [f64; 3], along_m: [f64; 2], colour: Colour) {
        let from_m = Point3::from(from_m);
        let to_m = from_m + Vector3::new(along_m[0], along_m[1], 0.0);
        let shaft = Geometry::Capsule { from_m, to_m, radius_m: ARROW_RADIUS_M };
        let tip = Geometry::Sphere { centre_m: to_m, radius_m: 2.0 * ARROW_RADIUS_M };
        self.placed.extend([shaft, tip].map(|part| PlacedSkin {
            skin: Skin::of(&TriangleMesh::of(&part), DETAIL_M),
            pose: Isometry3::identity(),
            colour: Some(colour),
            is_solid: false,
        }));
    }

    /// Returns the least and the greatest corner of the box around the robot (m); `None` without one.
    #[must_use]
    pub fn robot_box_m(&self) -> Option<[Point3<f64>; 2]> {
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
        let corners = self.placed[..self.robot]
            .iter()
            .flat_map(|part| part.skin.seen(&part.pose, &axes, &Vector3::zeros()))
            .map(|corner| (corner, corner));
        let around = corners.reduce(|(low, high), (other, _)| (low.inf(&other), high.sup(&other)))?;
        Some([around.0, around.1].map(|corner| Point3::from(corner.cast())))
    }

    /// Returns the height of the ground at a place (m).
    #[must_use]
    pub fn ground_m(&self, x_m: f64, y_m: f64) -> f64 {
        self.field.as_ref().and_then(|field| field.height_at(x_m, y_m)).unwrap_or(0.0)
    }

    pub(crate) fn is_level(&self) -> bool {
        self.field.is_none()
    }
}
