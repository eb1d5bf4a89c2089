//! Surface of a scene: the plane z = 0, or a height field.

use nalgebra::{Isometry3, Point3, Vector3};
use treadmill_humanoid::model::HeightField;

use crate::solid::{Hit, Plane, Ray, box_planes, passage};

/// Surface of the ground.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Field, and the planes of the box around it; `None` is the plane.
    field: Option<(HeightField, Vec<Plane>)>,
}

impl Surface {
    /// Returns the ground of a model's height field, or the plane.
    #[must_use]
    pub fn new(field: Option<&HeightField>) -> Self {
        let field = field.map(|field| {
            let heights_m = field.heights_m.iter().map(|height_m| height_m + field.centre_m.z);
            let (low_m, high_m) =
                (heights_m.clone().fold(f64::INFINITY, f64::min), heights_m.fold(f64::NEG_INFINITY, f64::max));
            let middle = Isometry3::translation(field.centre_m.x, field.centre_m.y, (low_m + high_m) / 2.0);
            let half_m = Vector3::new(field.half_x_m, field.half_y_m, (high_m - low_m) / 2.0);
            (field.clone(), box_planes(&middle, &half_m))
        });
        Self { field }
    }

    /// Returns the first hit of a ray from above.
    #[must_use]
    pub fn hit(&self, ray: &Ray) -> Option<Hit> {
        match &self.field {
            None => {
                let distance_m = -ray.origin.z / ray.direction.z;
                (distance_m > 0.0 && distance_m.is_finite()).then_some(Hit { distance_m, normal: Vector3::z() })
            }
            Some((field, around)) => hit_field(field, around, ray),
        }
    }

    /// Returns whether a ray hits a height field; nothing is below the plane.
    #[must_use]
    pub fn shades(&self, ray: &Ray) -> bool {
        self.field.is_some() && self.hit(ray).is_some()
    }
}

/// Returns the first hit of a ray on a height field: visits the cells below the ray in their order along it.
fn hit_field(field: &HeightField, around: &[Plane], ray: &Ray) -> Option<Hit> {
    let (from, to, _) = passage(ray, around)?;
    // A level field is a box without height.
    let to = to + 1e-9;
    if from > to || to < 0.0 {
        return None;
    }
    let least = [field.centre_m.x - field.half_x_m, field.centre_m.y - field.half_y_m];
    let cells = [field.columns - 1, field.rows - 1];
    let size_m = [2.0 * field.half_x_m / cells[0] as f64, 2.0 * field.half_y_m / cells[1] as f64];
    let start = ray.at(from.max(0.0));
    let mut cell = [0, 1].map(|axis| (((start[axis] - least[axis]) / size_m[axis]) as usize).min(cells[axis] - 1));
    loop {
        if let Some(hit) = hit_cell(field, cell, size_m, least, ray) {
            return Some(hit);
        }
        // Distance to the next cell along each axis.
        let next = [0, 1].map(|axis| {
            let forward = ray.direction[axis] > 0.0;
            let edge_m = least[axis] + (cell[axis] + usize::from(forward)) as f64 * size_m[axis];
            let distance_m = (edge_m - ray.origin[axis]) / ray.direction[axis];
            if ray.direction[axis] == 0.0 { f64::INFINITY } else { distance_m }
        });
        let axis = usize::from(next[1] < next[0]);
        if next[axis] >= to {
            return None;
        }
        cell[axis] = match ray.direction[axis] > 0.0 {
            true => Some(cell[axis] + 1).filter(|index| *index < cells[axis])?,
            false => cell[axis].checked_sub(1)?,
        };
    }
}

/// Returns the first hit on the two triangles of a cell.
fn hit_cell(
    field: &HeightField,
    [column, row]: [usize; 2],
    size_m: [f64; 2],
    least: [f64; 2],
    ray: &Ray,
) -> Option<Hit> {
    let corner = |columns: usize, rows: usize| {
        let (column, row) = (column + columns, row + rows);
        let height_m = field.heights_m[row * field.columns + column] + field.centre_m.z;
        Point3::new(least[0] + column as f64 * size_m[0], least[1] + row as f64 * size_m[1], height_m)
    };
    let (near, far) = (corner(0, 0), corner(1, 1));
    let hits = [hit_triangle(&[near, corner(1, 0), far], ray), hit_triangle(&[near, far, corner(0, 1)], ray)];
    hits.into_iter().flatten().min_by(|one, other| one.distance_m.total_cmp(&other.distance_m))
}

/// Returns the hit on a triangle, with the normal that points up (Möller & Trumbore 1997).
fn hit_triangle([a, b, c]: &[Point3<f64>; 3], ray: &Ray) -> Option<Hit> {
    /// Share of an edge by which neighbouring triangles overlap, so that no ray passes between them.
    const OVERLAP: f64 = 1e-9;
    let (one, other) = (b - a, c - a);
    let across = ray.direction.cross(&other);
    let determinant = one.dot(&across);
    let offset = ray.origin - a;
    let first = offset.dot(&across) / determinant;
    let turned = offset.cross(&one);
    let second = ray.direction.dot(&turned) / determinant;
    let distance_m = other.dot(&turned) / determinant;
    let is_inside = first >= -OVERLAP && second >= -OVERLAP && first + second <= 1.0 + OVERLAP;
    (is_inside && distance_m > 0.0).then(|| Hit { distance_m, normal: one.cross(&other).normalize() })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn hills() -> HeightField {
        let height_m = |x: f64, y: f64| 0.2 * (3.0 * x).sin() + 0.1 * (5.0 * y).cos();
        HeightField::from_fn([9, 13], [3.0, 2.0], Point3::new(0.5, -0.3, 0.1), height_m).expect("valid")
    }

    #[test]
    fn the_plane_is_hit_from_above_only() {
        let ground = Surface::new(None);
        let ray = |z: f64| Ray { origin: Point3::new(1.0, 2.0, 3.0), direction: Vector3::new(0.6, 0.0, z) };
        let hit = ground.hit(&ray(-0.8)).expect("below");
        assert!((hit.distance_m - 3.75).abs() < 1e-12 && hit.normal == Vector3::z());
        assert!(ground.hit(&ray(0.8)).is_none() && ground.hit(&ray(0.0)).is_none());
        assert!(!ground.shades(&ray(-0.8)));
    }

    #[test]
    fn there_is_no_ground_beyond_the_edges() {
        let ground = Surface::new(Some(&hills()));
        let down = |x: f64, y: f64| Ray { origin: Point3::new(x, y, 5.0), direction: -Vector3::z() };
        assert!(ground.hit(&down(3.49, 1.69)).is_some());
        for (x, y) in [(3.51, 0.0), (-2.51, 0.0), (0.0, 1.71), (0.0, -2.31)] {
            assert!(ground.hit(&down(x, y)).is_none(), "{x} {y}");
        }
    }

    proptest! {
        #[test]
        fn hits_lie_on_the_surface_and_nothing_is_before_them(
            from in prop::array::uniform3(-3.0f64..3.0), to in prop::array::uniform2(-2.0f64..2.0),
        ) {
            let field = hills();
            let origin = Point3::new(from[0], from[1], 2.0 + from[2].abs());
            let aim = Point3::new(to[0], to[1] * 0.8, 0.0);
            let ray = Ray { origin, direction: (aim - origin).normalize() };
            let above = |distance_m: f64| {
                let at = ray.at(distance_m);
                field.height_at(at.x, at.y).map(|height_m| at.z - height_m)
            };
            let is_above = |distance_m, error_m: f64| above(distance_m).is_none_or(|above_m| above_m > -error_m);
            let surface = Surface::new(Some(&field));
            let (_, around) = surface.field.as_ref().expect("a field");
            // A field has no sides: a ray may come in below its edge.
            if let Some((enters_m, ..)) = passage(&ray, around)
                && above(enters_m.max(0.0) + 1e-9).is_some_and(|above_m| above_m < 0.0)
            {
                return Ok(());
            }
            let Some(hit) = surface.hit(&ray) else {
                let end = (origin.z + 1.0) / -ray.direction.z;
                prop_assert!((0..1000).all(|part| is_above(end * f64::from(part) / 1000.0, 1e-9)));
                return Ok(());
            };
            prop_assert!(above(hit.distance_m).expect("inside").abs() < 1e-7);
            prop_assert!(hit.normal.z > 0.0 && (hit.normal.norm() - 1.0).abs() < 1e-12);
            prop_assert!((0..1000).all(|part| is_above(hit.distance_m * f64::from(part) / 1000.0, 1e-7)));
        }
    }
}
