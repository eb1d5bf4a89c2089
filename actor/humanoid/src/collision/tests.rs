use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use proptest::prelude::*;

use rand::{RngExt, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::model::ShapeNode;
use super::queries::{gap_m, overlap_m};
use super::{ROUNDING_M, squared_distance};
use crate::lanes::{Scalar, Vec3};
use crate::model::Geometry;

fn numbers() -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-1.0f64..1.0).prop_map(Vector3::from)
}

fn poses(reach_m: f64) -> impl Strategy<Value = Isometry3<f64>> {
    (numbers(), numbers()).prop_map(move |(place, turn)| {
        Isometry3::from_parts(Translation3::from(place * reach_m), UnitQuaternion::from_scaled_axis(turn * 3.0))
    })
}

fn geometries() -> impl Strategy<Value = Geometry> {
    let sizes = || prop::array::uniform3(0.01f64..0.15).prop_map(Vector3::from);
    prop_oneof![
        (numbers(), 0.01f64..0.1)
            .prop_map(|(at, radius_m)| Geometry::Sphere { centre_m: Point3::from(at * 0.05), radius_m }),
        (numbers(), numbers(), 0.01f64..0.1).prop_map(|(from, to, radius_m)| Geometry::Capsule {
            from_m: Point3::from(from * 0.1),
            to_m: Point3::from(to * 0.1),
            radius_m
        }),
        (poses(0.05), sizes()).prop_map(|(pose, size)| Geometry::Cylinder {
            pose,
            radius_m: size.x,
            half_length_m: size.y
        }),
        (poses(0.05), sizes()).prop_map(|(pose, half_m)| Geometry::Box { pose, half_m }),
        (poses(0.05), sizes()).prop_map(|(pose, half_m)| Geometry::Ellipsoid { pose, half_m }),
        (prop::collection::vec(numbers(), 6..30), sizes()).prop_map(|(corners, size)| Geometry::Hull {
            vertices_m: corners.iter().map(|corner| Point3::from(corner.component_mul(&size))).collect()
        }),
    ]
}

type Segment = (Vector3<f64>, Vector3<f64>);

/// Distance of two line segments, each a centre and a half (m): that of their lines, if the closest points are on them, else
/// the least one of an end.
fn distance_m(segments: [Segment; 2]) -> f64 {
    let to_point = |(centre, half): Segment, point: Vector3<f64>| {
        let share = (point - centre).dot(&half) / half.norm_squared().max(1e-30);
        (centre + half * share.clamp(-1.0, 1.0) - point).norm()
    };
    let [(one, half), (other, other_half)] = segments;
    let ends = [1.0, -1.0]
        .map(|sign| to_point(segments[1], one + half * sign).min(to_point(segments[0], other + other_half * sign)));
    let across = half.cross(&other_half);
    let square = across.norm_squared();
    let shares = [other_half, half].map(|along| (other - one).cross(&along).dot(&across) / square);
    let lines = shares.iter().all(|share| share.abs() <= 1.0).then(|| (other - one).dot(&across).abs() / square.sqrt());
    ends.into_iter().chain(lines).fold(f64::INFINITY, f64::min)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn shapes_whose_capsules_are_apart_do_not_touch(one in geometries(), other in geometries(), place in poses(0.3)) {
        let [one, other] = [one, other].map(|geometry| ShapeNode::new(0, None, &geometry));
        let half = |shape: &ShapeNode| shape.half_m.unwrap_or_default();
        let moved = (place * Point3::from(other.centre_m)).coords;
        let apart_m = distance_m([(one.centre_m, half(&one)), (moved, place * half(&other))]);
        if apart_m > one.thickness_m + other.thickness_m + 1e-4 {
            prop_assert_eq!(overlap_m(&one, &other, &place), None, "{} m apart", apart_m - one.thickness_m - other.thickness_m);
        }
    }
}

proptest! {
    #[test]
    fn distances_of_axes_are_hardly_overestimated(
        one in numbers(), other in numbers(), offset in numbers(), sizes in prop::array::uniform3(-7i32..0), parallel in any::<bool>()
    ) {
        let [one, other, offset] = [(one, sizes[0]), (other, sizes[1]), (offset, 0)].map(|(vector, size)| vector * 2f64.powi(size));
        let other = if parallel { one * 0.7 + other * 1e-4 } else { other };
        let [lanes_offset, lanes_one, lanes_other] = [offset, one, other].map(|vector| Vec3::splat(Scalar, &vector));
        let found = squared_distance(&lanes_offset, &lanes_one, &lanes_other).lane(0).sqrt();
        let exact = distance_m([(offset, one), (Vector3::zeros(), other)]);
        prop_assert!(found < exact + ROUNDING_M, "{found} instead of {exact}");
    }

    #[test]
    fn shapes_with_a_common_centre_are_not_separated(one in geometries(), other in geometries(), turn in numbers()) {
        let centres = [&one, &other].map(|geometry| geometry.centre_m().coords);
        let [one, other] = [one, other].map(|geometry| ShapeNode::new(0, None, &geometry));
        let turn = UnitQuaternion::from_scaled_axis(turn * 3.0);
        let place = Isometry3::from_parts(Translation3::from(centres[0] - turn * centres[1]), turn);
        prop_assert_eq!(gap_m(&one, &other, &place), None);
    }
}

#[test]
fn hulls_that_are_apart_do_not_touch() {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(1);
    let mut vector = |size: f64| Vector3::from_fn(|_, _| random.random_range(-size..size));
    let mut near = 0;
    for case in 0..60_000 {
        let [one, other] = [(); 2].map(|()| {
            let size = vector(0.03).map(|part| 0.02 + part.abs());
            let vertices_m = (0..20).map(|_| Point3::from(vector(1.0).component_mul(&size))).collect();
            ShapeNode::new(0, None, &Geometry::Hull { vertices_m })
        });
        let place =
            Isometry3::from_parts(Translation3::from(vector(0.08)), UnitQuaternion::from_scaled_axis(vector(3.0)));
        let apart_m = gap_m(&one, &other, &place).unwrap_or(0.0);
        if (2e-4..5e-3).contains(&apart_m) {
            near += 1;
            assert_eq!(overlap_m(&one, &other, &place), None, "case {case}: {apart_m} m apart");
        }
    }
    assert!(near > 3000, "{near}");
}
