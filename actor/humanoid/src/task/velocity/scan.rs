//! Heights of the ground around the base.

use crate::physics::Physics;

/// Number of points from the back to the front, and from the right to the left.
pub const SCAN_GRID: [usize; 2] = [11, 7];
/// Number of points.
pub(super) const SCAN_POINTS: usize = SCAN_GRID[0] * SCAN_GRID[1];
/// Distance between two points (m).
pub const SCAN_SPACING_M: f64 = 0.1;
/// Limit of an observed height, in both directions (m).
pub const SCAN_MAX_M: f64 = 1.0;

/// Returns the point on the other side of the heading.
pub(super) fn opposite_point(index: usize) -> usize {
    (SCAN_GRID[1] - 1 - index / SCAN_GRID[0]) * SCAN_GRID[0] + index % SCAN_GRID[0]
}

/// Returns the heights of the ground (m, world) around a place: rows from the right to the left of this heading, each
/// from the back to the front.
pub(super) fn ground_around(physics: &Physics, [x_m, y_m]: [f64; 2], heading_rad: f64) -> [f64; SCAN_POINTS] {
    let (sin, cos) = heading_rad.sin_cos();
    std::array::from_fn(|index| {
        let offset_m = |number: usize, count: usize| SCAN_SPACING_M * (number as f64 - (count - 1) as f64 / 2.0);
        let (forward, left) =
            (offset_m(index % SCAN_GRID[0], SCAN_GRID[0]), offset_m(index / SCAN_GRID[0], SCAN_GRID[1]));
        physics.ground_height_m(x_m + cos * forward - sin * left, y_m + sin * forward + cos * left)
    })
}
