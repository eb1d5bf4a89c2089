use nalgebra::{Translation3, UnitQuaternion};
use proptest::prelude::*;

use super::*;

fn pose() -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::new(0.1, -0.2, 0.3), UnitQuaternion::from_euler_angles(0.4, -0.7, 1.1))
}

fn forms() -> [Geometry; 6] {
    let half_m = Vector3::new(0.2, 0.1, 0.3);
    [
        Geometry::Sphere { centre_m: Point3::new(0.1, 0.0, 0.2), radius_m: 0.25 },
        Geometry::Capsule { from_m: Point3::new(0.0, 0.1, -0.3), to_m: Point3::new(0.2, 0.0, 0.3), radius_m: 0.12 },
        Geometry::Cylinder { pose: pose(), radius_m: 0.2, half_length_m: 0.3 },
        Geometry::Box { pose: pose(), half_m },
        Geometry::Ellipsoid { pose: pose(), half_m },
        Geometry::Hull { vertices_m: OCTAHEDRON.map(Point3::from).to_vec() },
    ]
}

const OCTAHEDRON: [[f64; 3]; 6] =
    [[0.3, 0.0, 0.0], [-0.3, 0.0, 0.0], [0.0, 0.3, 0.0], [0.0, -0.3, 0.0], [0.0, 0.0, 0.3], [0.0, 0.0, -0.3]];

/// Returns a number below 0 inside a shape, 0 on its surface and above 0 outside, computed without rays.
fn level(geometry: &Geometry, at: Point3<f64>) -> f64 {
    match *geometry {
        Geometry::Sphere { centre_m, radius_m } => nalgebra::distance(&centre_m, &at) - radius_m,
        Geometry::Capsule { from_m, to_m, radius_m } => {
            let axis = to_m - from_m;
            let share = ((at - from_m).dot(&axis) / axis.norm_squared()).clamp(0.0, 1.0);
            nalgebra::distance(&(from_m + axis * share), &at) - radius_m
        }
        Geometry::Cylinder { pose, radius_m, half_length_m } => {
            let at = pose.inverse_transform_point(&at);
            (at.x.hypot(at.y) - radius_m).max(at.z.abs() - half_length_m)
        }
        Geometry::Box { pose, half_m } => (pose.inverse_transform_point(&at).coords.abs() - half_m).max(),
        Geometry::Ellipsoid { pose, half_m } => {
            pose.inverse_transform_point(&at).coords.component_div(&half_m).norm() - 1.0
        }
        // The octahedron above.
        Geometry::Hull { .. } => at.coords.lp_norm(1) - 0.3,
    }
}

proptest! {
    #[test]
    fn a_ray_hits_a_shape_where_it_first_enters_it(
        form in 0usize..6,
        origin in prop::array::uniform3(-2.0f64..2.0),
        target in prop::array::uniform3(-0.5f64..0.5),
    ) {
        let (geometry, body) = (forms()[form].clone(), pose());
        let solid = Solid::new(&geometry, &body);
        let (origin, target) = (Point3::from(origin), Point3::from(target));
        let level_at = |at: Point3<f64>| level(&geometry, body.inverse_transform_point(&at));
        prop_assume!(level_at(origin) > 0.01 && nalgebra::distance(&origin, &target) > 0.1);
        let ray = Ray { origin, direction: (target - origin).normalize() };
        // Small steps along the ray miss only grazing hits.
        let first = (0..4000).map(|step| f64::from(step) * 1e-3).find(|&distance| level_at(ray.at(distance)) < 0.0);
        match solid.hit(&ray) {
            Some(hit) => {
                prop_assert!(solid.bound.may_hit(&ray, f64::INFINITY));
                prop_assert!(solid.bound.may_hit(&ray, hit.distance_m + 1e-6));
                prop_assert!(level_at(ray.at(hit.distance_m)).abs() < 1e-9);
                prop_assert!((hit.normal.norm() - 1.0).abs() < 1e-9);
                prop_assert!(hit.normal.dot(&ray.direction) <= 1e-9, "the normal must face the ray");
                // The normal points out of the shape.
                prop_assert!(level_at(ray.at(hit.distance_m) + hit.normal * 1e-4) > 0.0);
                if let Some(first) = first {
                    prop_assert!(hit.distance_m <= first && hit.distance_m > first - 0.1, "{hit:?} {first}");
                }
            }
            None => prop_assert!(first.is_none(), "missed at {first:?}"),
        }
    }
}

#[test]
fn shapes_behind_the_ray_are_not_hit() {
    for geometry in forms() {
        let solid = Solid::new(&geometry, &Isometry3::identity());
        let ray = Ray { origin: Point3::new(3.0, 0.0, 0.0), direction: Vector3::x() };
        assert!(solid.hit(&ray).is_none() && !solid.bound.may_hit(&ray, f64::INFINITY), "{geometry:?}");
    }
}
