//! Camera of a scene.

use nalgebra::{Point3, Vector3};

/// Upright pinhole camera.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    pub(crate) eye: Point3<f64>,
    /// Directions to the right, up and forward, each of length 1.
    pub(crate) axes: [Vector3<f64>; 3],
    /// Half of the image height at distance 1.
    pub(crate) half_height: f64,
    /// Distance of what it looks at (m).
    pub(crate) target_m: f64,
}

/// Default offset of the camera from the followed point (m): beside it, a little ahead and above.
pub const BESIDE_M: [f64; 3] = [1.3, -3.1, 0.5];
/// Vertical field of view (rad).
const FIELD_OF_VIEW_RAD: f64 = 0.72;
/// Vertical field of view of a camera that shows a whole robot (rad): small, so that near parts look no larger.
const LONG_LENS_RAD: f64 = 0.2;
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
        Self::new(Point3::new(x_m, y_m, TARGET_HEIGHT_M), offset_m.into(), FIELD_OF_VIEW_RAD)
    }

    /// Returns a camera in a direction from a point (m), from where `height_m` fills this share of the picture's height.
    ///
    /// # Panics
    /// If the direction is vertical.
    #[must_use]
    pub fn framing(middle_m: [f64; 3], direction: [f64; 3], height_m: f64, share: f64) -> Self {
        let distance_m = height_m / (2.0 * (FIELD_OF_VIEW_RAD / 2.0).tan() * share);
        Self::new(middle_m.into(), Vector3::from(direction).normalize() * distance_m, FIELD_OF_VIEW_RAD)
    }

    /// Returns a camera in a direction from a box, given by its least and greatest corner (m), from where the box fills at
    /// most `share` of the width and the height of a picture whose width is `aspect` heights.
    ///
    /// # Panics
    /// If the direction is vertical.
    #[must_use]
    pub fn around([low, high]: [Point3<f64>; 2], direction: [f64; 3], aspect: f64, share: f64) -> Self {
        let middle = nalgebra::center(&low, &high);
        let away = Vector3::from(direction).normalize();
        let found = Self::new(middle, away, LONG_LENS_RAD);
        let corners = (0..8).map(|corner| {
            let side = |axis: usize| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] };
            Point3::new(side(0), side(1), side(2)) - middle
        });
        let distance_m = |corner: Vector3<f64>| {
            let [x, y, z] = found.axes.map(|axis| corner.dot(&axis));
            (x.abs() / aspect).max(y.abs()) / (found.half_height * share) - z
        };
        Self::new(middle, away * corners.map(distance_m).fold(0.1, f64::max), LONG_LENS_RAD)
    }

    fn new(target: Point3<f64>, offset: Vector3<f64>, field_of_view_rad: f64) -> Self {
        let forward = -offset.normalize();
        let right =
            forward.cross(&Vector3::z()).try_normalize(1e-9).expect("the camera must not look straight up or down");
        let axes = [right, right.cross(&forward), forward];
        Self { eye: target + offset, axes, half_height: (field_of_view_rad / 2.0).tan(), target_m: offset.norm() }
    }

    /// Returns the direction, of length 1 along the camera's own, through a point of an image, in pixels from its upper left
    /// corner; `size` is width and height.
    #[must_use]
    pub fn direction(&self, column: f64, row: f64, size: (u32, u32)) -> Vector3<f64> {
        let (width, height) = (f64::from(size.0), f64::from(size.1));
        let scale = 2.0 * self.half_height / height;
        let [right, up, forward] = self.axes;
        forward + right * ((column - width / 2.0) * scale) + up * ((height / 2.0 - row) * scale)
    }

    /// Returns a point's position in an image, in pixels from its upper left corner; `None` for a point behind the camera.
    #[must_use]
    pub fn project(&self, point: &Point3<f64>, size: (u32, u32)) -> Option<(f64, f64)> {
        let [right, up, depth] = self.axes.map(|axis| (point - self.eye).dot(&axis));
        let scale = f64::from(size.1) / (2.0 * self.half_height * depth);
        (depth > 1e-6).then(|| (f64::from(size.0) / 2.0 + right * scale, f64::from(size.1) / 2.0 - up * scale))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_direction_to_a_projected_point_meets_the_point() {
        let (camera, size) = (Camera::beside(3.0, 1.0), (320, 240));
        for point in [Point3::new(3.0, 1.0, 0.95), Point3::new(3.5, 0.4, 1.4), Point3::new(2.0, 2.0, 0.0)] {
            let (column, row) = camera.project(&point, size).unwrap();
            let direction = camera.direction(column, row, size).normalize();
            let off = (point - camera.eye).cross(&direction).norm();
            assert!(off < 1e-9, "the ray misses {point} by {off} m");
        }
        let (column, row) = camera.project(&Point3::new(3.0, 1.0, 0.95), size).unwrap();
        assert!((column - 160.0).abs() < 1e-9 && (row - 120.0).abs() < 1e-9, "the target is in the middle");
        assert!(camera.project(&Point3::new(3.0 + 2.8, 1.0 - 6.8, 2.15), size).is_none(), "behind the camera");
    }

    #[test]
    fn a_framed_height_fills_its_share() {
        let (camera, size) = (Camera::framing([2.0, 1.0, 0.7], [0.0, -1.0, 0.0], 1.4, 0.5), (640, 480));
        let rows = [0.0, 1.4].map(|z| camera.project(&Point3::new(2.0, 1.0, z), size).unwrap().1);
        assert!((rows[0] - 360.0).abs() < 1e-9 && (rows[1] - 120.0).abs() < 1e-9, "{rows:?}");
    }

    #[test]
    fn a_box_fills_its_share_and_is_never_cut_off() {
        let corner = |x, y, z| Point3::new(x, y, z);
        for (high, aspect) in [(corner(0.3, 0.6, 1.4), 1.0), (corner(0.4, 3.0, 1.0), 0.5), (corner(5.0, 0.2, 0.1), 2.0)]
        {
            for direction in [[1.0, 0.0, 0.1], [0.1, -1.0, 0.3]] {
                let camera = Camera::around([corner(-0.2, -0.5, 0.0), high], direction, aspect, 0.8);
                let size = ((1000.0 * aspect) as u32, 1000);
                let mut reach: f64 = 0.0;
                for (x, y, z) in [-0.2, high.x]
                    .iter()
                    .flat_map(|x| [-0.5, high.y].into_iter().flat_map(move |y| [0.0, high.z].map(|z| (*x, y, z))))
                {
                    let (column, row) = camera.project(&corner(x, y, z), size).unwrap();
                    reach = reach.max((column / f64::from(size.0) - 0.5).abs()).max((row / 1000.0 - 0.5).abs());
                }
                assert!((reach - 0.4).abs() < 1e-9, "{high} {direction:?}: {reach}");
            }
        }
    }
}
