//! From where a scene is seen.

use nalgebra::{Point3, Vector3};

use crate::solid::Ray;

/// A pinhole camera that looks at a point, upright.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    eye: Point3<f64>,
    right: Vector3<f64>,
    up: Vector3<f64>,
    forward: Vector3<f64>,
    /// Half of the picture's height at distance 1.
    half_height: f64,
}

/// From the point that is followed to the camera (m): beside it, a little ahead and above.
pub const BESIDE_M: [f64; 3] = [1.3, -3.1, 0.5];
/// Angle between the picture's upper and lower edge (rad).
const FIELD_RAD: f64 = 0.72;
/// Height of the point that is looked at (m): not the torso's own, so that a fall is seen as one.
const HEIGHT_M: f64 = 0.95;

impl Camera {
    /// Looks from `eye` at `target`.
    ///
    /// # Panics
    /// If one is straight above the other.
    #[must_use]
    pub fn looking_at(eye: Point3<f64>, target: Point3<f64>) -> Self {
        let forward = (target - eye).normalize();
        let right = forward.cross(&Vector3::z()).try_normalize(1e-9).expect("not straight up or down");
        Self { eye, right, up: right.cross(&forward), forward, half_height: (FIELD_RAD / 2.0).tan() }
    }

    /// Walks along beside a body whose torso is above this point of the floor.
    #[must_use]
    pub fn beside(x_m: f64, y_m: f64) -> Self {
        Self::following(x_m, y_m, BESIDE_M)
    }

    /// Walks along with a body whose torso is above this point of the floor, `away_m` from it.
    ///
    /// # Panics
    /// If that is straight above it.
    #[must_use]
    pub fn following(x_m: f64, y_m: f64, away_m: [f64; 3]) -> Self {
        let target = Point3::new(x_m, y_m, HEIGHT_M);
        Self::looking_at(target + Vector3::from(away_m), target)
    }

    /// The ray through a point of a picture of this size, in pixels from its upper left corner.
    #[must_use]
    pub fn ray(&self, column: f64, row: f64, size: (u32, u32)) -> Ray {
        let (width, height) = (f64::from(size.0), f64::from(size.1));
        let scale = 2.0 * self.half_height / height;
        let (x, y) = ((column - width / 2.0) * scale, (height / 2.0 - row) * scale);
        Ray { origin: self.eye, direction: (self.forward + self.right * x + self.up * y).normalize() }
    }

    /// Where a point of the world is seen in a picture of this size, in pixels from its upper left corner; `None` where it is
    /// behind the camera.
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
    fn a_ray_goes_through_what_is_seen_there() {
        let (camera, size) = (Camera::beside(3.0, 1.0), (320, 240));
        for point in [Point3::new(3.0, 1.0, 0.95), Point3::new(3.5, 0.4, 1.4), Point3::new(2.0, 2.0, 0.0)] {
            let (column, row) = camera.project(&point, size).unwrap();
            let ray = camera.ray(column, row, size);
            let off = (point - ray.origin).cross(&ray.direction).norm();
            assert!(off < 1e-9, "{point} is {off} m beside the ray");
        }
        let (column, row) = camera.project(&Point3::new(3.0, 1.0, 0.95), size).unwrap();
        assert!((column - 160.0).abs() < 1e-9 && (row - 120.0).abs() < 1e-9, "what is looked at is in the middle");
        assert!(camera.project(&Point3::new(3.0 + 2.8, 1.0 - 6.8, 2.15), size).is_none(), "behind the camera");
    }
}
