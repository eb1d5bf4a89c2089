//! The floor: the only static geom that may collide.

use std::sync::Arc;

use nalgebra::{Isometry3, Point3, Vector3};

use super::assets::Assets;
use super::element::Element;
use super::geoms;
use super::pairs::ContactRules;
use crate::error::ModelError;
use crate::model::{Geometry, Ground, HeightField, Shape};

/// Level plane or height field.
pub(super) struct Floor {
    pub(super) shape: Shape,
    pub(super) rules: ContactRules,
    height_field: Option<HeightField>,
    /// Index of its MJCF body; 0 is the world.
    pub(super) body: usize,
}

impl Floor {
    /// Reads a colliding geom of static MJCF body number `body`, whose label is `owner`; `pose` is that in the world.
    pub(super) fn read(
        body: usize,
        owner: &str,
        geom: &Element,
        pose: &Isometry3<f64>,
        assets: &Assets,
    ) -> Result<Self, ModelError> {
        let up = pose.rotation * Vector3::z();
        let height_field = match (geoms::kind(geom), geom.get("hfield")) {
            ("plane", _) if pose.translation.z.abs() <= 1e-9 && up.z >= 1.0 - 1e-9 => None,
            ("hfield", Some(field)) if pose.rotation.angle() <= 1e-9 => {
                Some(assets.height_field(field, Point3::from(pose.translation.vector))?)
            }
            _ => {
                return Err(geom.refused(format!(
                    "it belongs to {owner}, which is static, but only a level plane at z = 0, or a height field that is \
                     not turned, may collide there; a robot's root needs a free joint"
                )));
            }
        };
        Ok(Self { shape: geoms::collision_shape(geom, point())?, rules: ContactRules::read(geom)?, height_field, body })
    }

    /// Returns the floor of a text without one, with MuJoCo's defaults.
    pub(super) fn added() -> Self {
        let shape = Shape { name: "floor".to_owned(), geometry: point(), friction: 1.0, margin_m: 0.0 };
        Self { shape, rules: ContactRules::default(), height_field: None, body: 0 }
    }

    pub(super) fn into_ground(self) -> Ground {
        let Shape { name, friction, margin_m, .. } = self.shape;
        Ground { name, friction, margin_m, height_field: self.height_field.map(Arc::new) }
    }
}

/// Returns a stand-in: pairs with the floor use its plane or heights.
fn point() -> Geometry {
    Geometry::Sphere { centre_m: Point3::origin(), radius_m: 0.0 }
}
