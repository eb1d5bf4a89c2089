//! Camera of a scene.

use nalgebra::{Point3, Vector3};

use crate::solid::Ray;

/// Upright pinhole camera.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    eye: Point3<f64>,
    right: Vector3<f64>,
    up: Vector3<f64>,
    forward: Vector3<f64>,
    /// Half of the image height at distance 1.
    half_height: f64,
}

/// Default offset of the camera from the followed point (m): beside it, a little ahead and above.
pub const BESIDE_M: [f64; 3] = [1.3, -3.1, 0.5];
/// Vertical field of view (rad).
const FIELD_OF_VIEW_RAD: f64 = 0.72;
/// Height of the camera's target (m); constant, so that a fall is visible.
const TARGET_HEIGHT_M: f64 = 0.95;

impl Camera {
    /// Returns a camera beside a body whose torso is above this point of the floor (m).
    #[must_use]
    pub fn beside(x_m: f64, y_m: f64) -> Self {
        Self::following(x_m, y_m, BESIDE_M)
    }

    /// Returns a camera at `offset_m` from a body whose torso is above this point of the floor (m).
    ///
    /// # Panics
    /// If the offset is vertical.
    #[must_use]
    pub fn following(x_m: f64, y_m: f64, offset_m: [f64; 3]) -> Self {
        let offset = Vector3::from(offset_m);
        let (eye, forward) = (Point3::new(x_m, y_m, TARGET_HEIGHT_M) + offset, -offset.normalize());
        let right =
            forward.cross(&Vector3::z()).try_normalize(1e-9).expect("the camera must not look straight up or down");
        Self { eye, right, up: right.cross(&forward), forward, half_height: (FIELD_OF_VIEW_RAD / 2.0).tan() }
    }

    /// Returns the ray through a point of an image, in pixels from its upper left corner; `size` is width and height.
    #[must_use]
    pub fn ray(&self, column: f64, row: f64, size: (u32, u32)) -> Ray {
        let (width, height) = (f64::from(size.0), f64::from(size.1));
        let scale = 2.0 * self.half_height / height;
        let (x, y) = ((column - width / 2.0) * scale, (height / 2.0 - row) * scale);
        Ray { origin: self.eye, direction: (self.forward + self.right * x + self.up * y).normalize() }
    }

    /// Returns a point's position in an image, in pixels from its upper left corner; `None` for a point behind the camera.
    #[must_use]
    pub fn project(&self, point: &Point3<f64>, size: (u32, u32)) -> Option<(f64, f64)> {
        let towards = point - self.eye;
        let depth = towards.dot(&self.forward);
        let scale = f64::from(size.1) / (2.0 * self.half_height * depth);
        (depth > 1e-6).then(|| {
            let column = f64::from(size.0) / 2.0 + towards.dot(&self.right) * scale;
            (column, f64::from(size.1) / 2.0 - towards.dot(&self.up) * scale)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ray_through_a_projected_point_meets_the_point() {
        let (camera, size) = (Camera::beside(3.0, 1.0), (320, 240));
        for point in [Point3::new(3.0, 1.0, 0.95), Point3::new(3.5, 0.4, 1.4), Point3::new(2.0, 2.0, 0.0)] {
            let (column, row) = camera.project(&point, size).unwrap();
            let ray = camera.ray(column, row, size);
            let off = (point - ray.origin).cross(&ray.direction).norm();
            assert!(off < 1e-9, "the ray misses {point} by {off} m");
        }
        let (column, row) = camera.project(&Point3::new(3.0, 1.0, 0.95), size).unwrap();
        assert!((column - 160.0).abs() < 1e-9 && (row - 120.0).abs() < 1e-9, "the target is in the middle");
        assert!(camera.project(&Point3::new(3.0 + 2.8, 1.0 - 6.8, 2.15), size).is_none(), "behind the camera");
    }
}
