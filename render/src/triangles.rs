//! Triangles of shapes, for viewers that draw on a GPU.

use nalgebra::{Isometry3, Point3, UnitQuaternion, Vector3};
use treadmill_humanoid::model::{Geometry, HeightField};

/// Corners around the axis of a round shape, and rows of them from pole to pole.
const SIDES: usize = 24;
const ROWS: usize = 12;

/// Surface made of triangles, whose corners go counter-clockwise as seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    /// Corners (m).
    pub corners_m: Vec<[f32; 3]>,
    /// Indices of the corners of each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Whether there is an edge between two triangles; else they approximate a round surface.
    pub is_faceted: bool,
}

impl TriangleMesh {
    /// Returns the surface of a shape, in the frame of its body.
    #[must_use]
    pub fn of(geometry: &Geometry) -> Self {
        match geometry {
            Geometry::Sphere { centre_m, radius_m } => {
                ball(&(*centre_m).into(), &Vector3::from_element(*radius_m), 0.0)
            }
            Geometry::Ellipsoid { pose, half_m } => ball(pose, half_m, 0.0),
            Geometry::Capsule { from_m, to_m, radius_m } => {
                let axis = to_m - from_m;
                let turn = UnitQuaternion::rotation_between(&Vector3::z(), &axis)
                    .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI));
                let pose = Isometry3::from_parts(nalgebra::center(from_m, to_m).into(), turn);
                ball(&pose, &Vector3::from_element(*radius_m), axis.norm() / 2.0)
            }
            Geometry::Cylinder { pose, radius_m, half_length_m } => cylinder(pose, *radius_m, *half_length_m),
            Geometry::Box { pose, half_m } => {
                let sides =
                    [-1.0, 1.0].map(|z| [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| [x, y, z]));
                let corners = sides
                    .as_flattened()
                    .iter()
                    .map(|side| pose * Point3::from(half_m.component_mul(&Vector3::from(*side))));
                let quads = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
                let triangles = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
                Self { corners_m: corners.map(narrow).collect(), triangles, is_faceted: true }
            }
            Geometry::Hull { vertices_m } => Self {
                corners_m: vertices_m.iter().copied().map(narrow).collect(),
                triangles: geometry.hull_faces().into_iter().map(|face| face.map(|corner| corner as u32)).collect(),
                is_faceted: true,
            },
        }
    }

    /// Returns the surface of a height field, in the world.
    #[must_use]
    pub fn of_field(field: &HeightField) -> Self {
        let step_m =
            [2.0 * field.half_x_m / (field.columns - 1) as f64, 2.0 * field.half_y_m / (field.rows - 1) as f64];
        let corner = |row: usize, column: usize| {
            let x_m = field.centre_m.x - field.half_x_m + column as f64 * step_m[0];
            let y_m = field.centre_m.y - field.half_y_m + row as f64 * step_m[1];
            Point3::new(x_m, y_m, field.centre_m.z + field.heights_m[row * field.columns + column])
        };
        Self { is_faceted: true, ..grid([field.rows, field.columns], false, corner) }
    }
}

/// Returns rows of corners, with two triangles between four of them. A grid that wraps joins the ends of each row.
fn grid([rows, columns]: [usize; 2], wraps: bool, corner: impl Fn(usize, usize) -> Point3<f64>) -> TriangleMesh {
    let places = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
    let cells = if wraps { columns } else { columns - 1 };
    let index = |row: usize, column: usize| (row * columns + column % columns) as u32;
    let triangles = (0..rows - 1).flat_map(|row| {
        (0..cells).flat_map(move |column| {
            let [near, right] = [index(row, column), index(row, column + 1)];
            let [left, far] = [index(row + 1, column), index(row + 1, column + 1)];
            [[near, right, far], [near, far, left]]
        })
    });
    let corners_m = places.map(|(row, column)| narrow(corner(row, column))).collect();
    TriangleMesh { corners_m, triangles: triangles.collect(), is_faceted: false }
}

/// Returns an ellipsoid whose halves are this far from its middle along z, with a wall between them.
fn ball(pose: &Isometry3<f64>, half_m: &Vector3<f64>, half_wall_m: f64) -> TriangleMesh {
    grid([2 * ROWS, SIDES], true, |row, column| {
        // The two rows at the equator are the ends of the wall.
        let (level, side) = if row < ROWS { (row, -1.0) } else { (row - 1, 1.0) };
        let (sin, cos) = (std::f64::consts::PI * level as f64 / (2 * ROWS - 2) as f64).sin_cos();
        let (across, along) = around(column);
        let point = Vector3::new(half_m.x * sin * across, half_m.y * sin * along, side * half_wall_m - half_m.z * cos);
        pose * Point3::from(point)
    })
}

fn cylinder(pose: &Isometry3<f64>, radius_m: f64, half_length_m: f64) -> TriangleMesh {
    // The edges have corners of their own for wall and ends, so that shading does not round them.
    let rows = [(0.0, -1.0), (1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (1.0, 1.0), (0.0, 1.0)];
    grid([rows.len(), SIDES], true, |row, column| {
        let ((share, side), (across, along)) = (rows[row], around(column));
        pose * Point3::new(share * radius_m * across, share * radius_m * along, side * half_length_m)
    })
}

/// Returns the cosine and sine of the angle of a corner around the axis.
fn around(column: usize) -> (f64, f64) {
    let (sin, cos) = (std::f64::consts::TAU * column as f64 / SIDES as f64).sin_cos();
    (cos, sin)
}

fn narrow(point: Point3<f64>) -> [f32; 3] {
    point.coords.map(|part| part as f32).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the volume inside a closed surface: the sum of the pyramids of its triangles over the origin (m³).
    fn volume_m3(mesh: &TriangleMesh) -> f64 {
        let corner = |index: u32| Vector3::from(mesh.corners_m[index as usize].map(f64::from));
        mesh.triangles.iter().map(|face| face.map(corner)).map(|[a, b, c]| a.dot(&b.cross(&c)) / 6.0).sum()
    }

    #[test]
    fn surfaces_are_closed_and_point_outwards() {
        let pi = std::f64::consts::PI;
        let pose = Isometry3::new(Vector3::new(0.3, -0.2, 0.5), Vector3::new(0.4, 1.1, -0.3));
        let [from_m, to_m] = [Point3::new(0.1, 0.2, 0.3), Point3::new(0.4, -0.2, 0.3)];
        let corner = |x, y, z| Point3::new(x, y, z);
        let vertices_m =
            vec![corner(0.0, 0.0, 0.0), corner(1.0, 0.0, 0.0), corner(0.0, 1.0, 0.0), corner(0.0, 0.0, 1.0)];
        for (geometry, wanted_m3) in [
            (Geometry::Sphere { centre_m: from_m, radius_m: 0.2 }, 4.0 / 3.0 * pi * 0.008),
            (Geometry::Ellipsoid { pose, half_m: Vector3::new(0.1, 0.2, 0.3) }, 4.0 / 3.0 * pi * 0.006),
            (Geometry::Capsule { from_m, to_m, radius_m: 0.1 }, pi * 0.01 * 0.5 + 4.0 / 3.0 * pi * 0.001),
            (Geometry::Cylinder { pose, radius_m: 0.1, half_length_m: 0.2 }, pi * 0.01 * 0.4),
            (Geometry::Box { pose, half_m: Vector3::new(0.1, 0.2, 0.3) }, 8.0 * 0.006),
            (Geometry::Hull { vertices_m }, 1.0 / 6.0),
        ] {
            let found_m3 = volume_m3(&TriangleMesh::of(&geometry));
            // A polygon with 24 sides has 1.1 % less area than its circle.
            assert!((0.97..1.0 + 1e-6).contains(&(found_m3 / wanted_m3)), "{geometry:?}: {found_m3}, not {wanted_m3}");
        }
    }

    #[test]
    fn a_height_field_has_two_triangles_for_each_cell() {
        let slope = |x: f64, y: f64| Some(0.5 * x + 0.25 * y);
        let field = HeightField::from_fn([3, 5], [2.0, 1.0], Point3::new(1.0, 0.0, 0.1), |x, y| slope(x, y).unwrap());
        let mesh = TriangleMesh::of_field(&field.expect("valid"));
        assert_eq!((mesh.corners_m.len(), mesh.triangles.len()), (15, 16));
        for [x, y, z] in mesh.corners_m {
            assert!((z - (0.5 * x + 0.25 * y + 0.1)).abs() < 1e-6, "{x} {y} {z}");
        }
    }
}
