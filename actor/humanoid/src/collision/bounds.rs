//! Capsules that contain shapes, for cheap tests of whether two may touch.

use nalgebra::{Matrix3, Vector3};

/// Capsule in a body's frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Capsule {
    pub(super) centre_m: Vector3<f64>,
    /// Half of its axis (m).
    pub(super) half_m: Vector3<f64>,
    pub(super) radius_m: f64,
}

impl Capsule {
    /// Returns a small capsule around points, whose axis is along one of `axes`, their principal axes or those of the frame.
    pub(super) fn around(points_m: &[Vector3<f64>], axes: &Matrix3<f64>) -> Self {
        let mean = points_m.iter().sum::<Vector3<f64>>() / points_m.len() as f64;
        let spread: Matrix3<f64> = points_m.iter().map(|point| (point - mean) * (point - mean).transpose()).sum();
        let all = [*axes, spread.symmetric_eigen().eigenvectors, Matrix3::identity()];
        // Each axis of a frame in turn is the first one.
        let frames = all
            .iter()
            .flat_map(|frame| (0..3).map(move |turn| [0, 1, 2].map(|axis| frame.column((axis + turn) % 3).into())));
        let capsules = frames.map(|frame| Self::along(points_m, frame));
        capsules.min_by(|a, b| a.volume_m3().total_cmp(&b.volume_m3())).expect("nine frames")
    }

    /// Returns the capsule along the first of three perpendicular directions.
    fn along(points_m: &[Vector3<f64>], [axis, left, up]: [Vector3<f64>; 3]) -> Self {
        let range = |values: &dyn Fn(&Vector3<f64>) -> f64| {
            points_m
                .iter()
                .map(values)
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
        };
        let [middle_left, middle_up] = [left, up].map(|way| range(&|point| point.dot(&way)).iter().sum::<f64>() / 2.0);
        let off_axis_m = |point: &Vector3<f64>| (point.dot(&left) - middle_left).hypot(point.dot(&up) - middle_up);
        let radius_m = points_m.iter().map(off_axis_m).fold(0.0, f64::max);
        // How far a ball of the radius may be from a point along the axis.
        let slack_m = |point: &Vector3<f64>| (radius_m.powi(2) - off_axis_m(point).powi(2)).max(0.0).sqrt();
        let end = range(&|point| point.dot(&axis) - slack_m(point))[1];
        let start = range(&|point| point.dot(&axis) + slack_m(point))[0];
        let (middle, half) = ((start + end) / 2.0, ((end - start) / 2.0).max(0.0));
        Self { centre_m: axis * middle + left * middle_left + up * middle_up, half_m: axis * half, radius_m }
    }

    fn volume_m3(&self) -> f64 {
        self.radius_m.powi(2) * (self.half_m.norm() + self.radius_m * 2.0 / 3.0)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::UnitQuaternion;
    use proptest::prelude::*;

    use super::*;

    fn distance_m(capsule: &Capsule, point: &Vector3<f64>) -> f64 {
        let offset = point - capsule.centre_m;
        let share = offset.dot(&capsule.half_m) / capsule.half_m.norm_squared().max(1e-30);
        (offset - capsule.half_m * share.clamp(-1.0, 1.0)).norm()
    }

    proptest! {
        #[test]
        fn it_contains_all_points(points in prop::collection::vec(prop::array::uniform3(-1.0f64..1.0), 1..40), flat in any::<bool>()) {
            let points: Vec<_> = points.into_iter().map(|[x, y, z]| Vector3::new(x, 0.3 * y, if flat { 0.0 } else { z })).collect();
            let capsule = Capsule::around(&points, &Matrix3::identity());
            for point in &points {
                prop_assert!(distance_m(&capsule, point) <= capsule.radius_m + 1e-9, "{capsule:?} {point}");
            }
        }
    }

    #[test]
    fn a_turned_plank_gets_a_thin_one() {
        let turn = UnitQuaternion::from_euler_angles(0.3, -0.7, 1.1);
        let corners: Vec<_> = (0..8)
            .map(|corner| {
                let sign = |bit: u32| if corner >> bit & 1 == 0 { 1.0 } else { -1.0 };
                turn * Vector3::new(0.5 * sign(0), 0.04 * sign(1), 0.03 * sign(2)) + Vector3::new(1.0, 2.0, 3.0)
            })
            .collect();
        let capsule = Capsule::around(&corners, &Matrix3::identity());
        assert!((capsule.radius_m - 0.05).abs() < 1e-5, "{capsule:?}");
        assert!(
            (capsule.half_m.norm() - 0.5).abs() < 1e-4
                && (capsule.centre_m - Vector3::new(1.0, 2.0, 3.0)).norm() < 1e-6
        );
    }
}
