//! Ground: a level plane, or a height field.

use std::sync::Arc;

use nalgebra::{Point3, Vector3};

use super::quantity::length;
use crate::error::ModelError;

/// Most rows, and most columns, of a height field.
pub const HEIGHT_FIELD_SIDE_MAX: usize = 1024;

/// Ground below the robot: the plane z = 0, unless it has a height field.
#[derive(Clone, Debug, PartialEq)]
pub struct Ground {
    /// Name in the text.
    pub name: String,
    /// Friction coefficient of its own; contacts have that of their [`super::Pair`].
    pub friction: f64,
    /// Distance (m) below which the ground pushes; the margins of a pair add up.
    pub margin_m: f64,
    /// Surface; `None` is the plane z = 0.
    pub height_field: Option<Arc<HeightField>>,
}

/// Surface over a level rectangle; there is no ground beyond its edges.
///
/// Each cell of the grid is two triangles. They share the edge from its corner of least x and y to the opposite one, as in
/// MuJoCo.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightField {
    /// Number of rows, along y.
    pub rows: usize,
    /// Number of columns, along x.
    pub columns: usize,
    /// Half of its length along x (m).
    pub half_x_m: f64,
    /// Half of its length along y (m).
    pub half_y_m: f64,
    /// Centre of the rectangle, in the world.
    pub centre_m: Point3<f64>,
    /// Heights above `centre_m.z` (m), row by row from the least y, each row from the least x.
    pub heights_m: Vec<f64>,
}

impl HeightField {
    /// Samples a function of x and y, in the world (m), that returns the height above `centre_m.z` (m).
    ///
    /// # Errors
    /// [`ModelError`] if there are fewer than 2 or more than [`HEIGHT_FIELD_SIDE_MAX`] rows or columns, or if a length or
    /// height is not finite.
    pub fn from_fn(
        [rows, columns]: [usize; 2],
        [half_x_m, half_y_m]: [f64; 2],
        centre_m: Point3<f64>,
        mut height_m: impl FnMut(f64, f64) -> f64,
    ) -> Result<Self, ModelError> {
        check_sides(rows, columns)?;
        let place = |index: usize, count: usize, half_m: f64| half_m * (2.0 * index as f64 / (count - 1) as f64 - 1.0);
        let heights_m = (0..rows * columns)
            .map(|index| {
                let x_m = centre_m.x + place(index % columns, columns, half_x_m);
                let y_m = centre_m.y + place(index / columns, rows, half_y_m);
                height_m(x_m, y_m)
            })
            .collect();
        let field = Self { rows, columns, half_x_m, half_y_m, centre_m, heights_m };
        field.check()?;
        Ok(field)
    }

    /// Returns the height (m) of the surface in the world; `None` beyond the edges.
    #[must_use]
    pub fn height_at(&self, x_m: f64, y_m: f64) -> Option<f64> {
        Some(self.triangle_at(x_m, y_m)?.0)
    }

    /// Returns the height (m, world) and the upward unit normal of the triangle at a place; `None` beyond the edges.
    pub(crate) fn surface_at(&self, x_m: f64, y_m: f64) -> Option<(f64, Vector3<f64>)> {
        let (height_m, rises_m) = self.triangle_at(x_m, y_m)?;
        let cell_m = [2.0 * self.half_x_m / (self.columns - 1) as f64, 2.0 * self.half_y_m / (self.rows - 1) as f64];
        let normal = Vector3::new(-rises_m[0] / cell_m[0], -rises_m[1] / cell_m[1], 1.0).normalize();
        Some((height_m, normal))
    }

    /// Returns the height (m, world) at a place, and by how much the triangle there rises (m) along the cell's x and y.
    fn triangle_at(&self, x_m: f64, y_m: f64) -> Option<(f64, [f64; 2])> {
        let (column, across) = cell(x_m - self.centre_m.x, self.half_x_m, self.columns)?;
        let (row, along) = cell(y_m - self.centre_m.y, self.half_y_m, self.rows)?;
        let corner =
            |rows: usize, columns: usize| self.heights_m.get((row + rows) * self.columns + column + columns).copied();
        let (near, far) = (corner(0, 0)?, corner(1, 1)?);
        let (above_m, rises_m) = if across >= along {
            let side = corner(0, 1)?;
            (near + across * (side - near) + along * (far - side), [side - near, far - side])
        } else {
            let side = corner(1, 0)?;
            (near + along * (side - near) + across * (far - side), [far - side, side - near])
        };
        Some((self.centre_m.z + above_m, rises_m))
    }

    pub(crate) fn check(&self) -> Result<(), ModelError> {
        check_sides(self.rows, self.columns)?;
        let wrong = |problem: &str| Err(ModelError::unsupported("height field", problem));
        if self.heights_m.len() != self.rows * self.columns {
            return wrong("there must be one height for each row and column");
        }
        if !self.heights_m.iter().chain(self.centre_m.iter()).all(|number| number.is_finite()) {
            return wrong("its heights and its centre must be finite");
        }
        length("height field", "half length along x (m)", self.half_x_m)?;
        length("height field", "half length along y (m)", self.half_y_m)?;
        Ok(())
    }
}

/// Returns the cell of a coordinate relative to the centre, and the share of the cell before it.
fn cell(offset_m: f64, half_m: f64, count: usize) -> Option<(usize, f64)> {
    let last = count.checked_sub(2)?;
    let place = (offset_m / half_m + 1.0) / 2.0 * (last + 1) as f64;
    (0.0..=(last + 1) as f64).contains(&place).then(|| {
        let index = (place as usize).min(last);
        (index, place - index as f64)
    })
}

fn check_sides(rows: usize, columns: usize) -> Result<(), ModelError> {
    let allowed = 2..=HEIGHT_FIELD_SIDE_MAX;
    if allowed.contains(&rows) && allowed.contains(&columns) {
        return Ok(());
    }
    let problem = format!("{rows} rows and {columns} columns; both must be 2 to {HEIGHT_FIELD_SIDE_MAX}");
    Err(ModelError::unsupported("height field", problem))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_split_along_mujocos_diagonal() {
        let heights_m = vec![0.0, 0.0, 1.0, 0.0];
        let field =
            HeightField { rows: 2, columns: 2, half_x_m: 1.0, half_y_m: 1.0, centre_m: Point3::origin(), heights_m };
        // MuJoCo 4.0's rays and spheres on elevation "1 0 0 0", whose first row is that of the greatest y.
        for ((x_m, y_m), height_m) in
            [((0.0, 0.0), 0.0), ((-0.5, 0.5), 0.5), ((0.5, -0.5), 0.0), ((0.3, 0.2), 0.0), ((0.2, 0.3), 0.05)]
        {
            let found = field.height_at(x_m, y_m).expect("inside");
            assert!((found - height_m).abs() < 1e-12, "{x_m} {y_m}: {found}");
        }
        assert_eq!(field.height_at(1.0, 1.0), Some(0.0));
        assert_eq!(field.height_at(1.01, 0.0), None);
        assert_eq!(field.height_at(f64::NAN, 0.0), None);
    }

    #[test]
    fn a_plane_is_reproduced_between_its_samples() {
        let plane = |x: f64, y: f64| 0.1 * x - 0.2 * y;
        let field = HeightField::from_fn([5, 9], [2.0, 1.0], Point3::new(3.0, -1.0, 0.5), plane).expect("valid");
        assert_eq!(field.heights_m.len(), 45);
        for (x, y) in [(1.0, -2.0), (5.0, 0.0), (2.71, -0.33), (4.999, -1.7)] {
            assert!((field.height_at(x, y).expect("inside") - plane(x, y) - 0.5).abs() < 1e-12);
        }
    }

    #[test]
    fn impossible_fields_are_refused() {
        let field = |sides, halves, height: f64| HeightField::from_fn(sides, halves, Point3::origin(), |_, _| height);
        for (sides, halves, height, part) in [
            ([1, 5], [1.0, 1.0], 0.0, "1 rows"),
            ([2, 1025], [1.0, 1.0], 0.0, "1025 columns"),
            ([2, 2], [0.0, 1.0], 0.0, "along x"),
            ([2, 2], [1.0, -1.0], 0.0, "along y"),
            ([2, 2], [1.0, 1.0], f64::NAN, "finite"),
        ] {
            let message = field(sides, halves, height).expect_err(part).to_string();
            assert!(message.contains(part), "{message}");
        }
    }
}
