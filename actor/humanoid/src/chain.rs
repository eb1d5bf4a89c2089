//! Angles, rates and axes of a chain of up to three hinges with perpendicular neighbours.
//!
//! Everything here is expressed in the *chain frame*: the triad of [`crate::model::Body::hinge_frame`] carried
//! back to the parent's side. In it hinge 1 turns about x, hinge 2 about y as turned by hinge 1, hinge 3 about z as
//! turned by both. *Turns* are those three angles (rad); a chain with fewer hinges has zeros at the end.

use nalgebra::{UnitQuaternion, Vector3};

/// Below this cosine of the second turn, axes 1 and 3 are taken as no closer to parallel than this.
///
/// The true factor 1/cos would let torques grow without bound near the singular posture, which the hinge ranges exclude
/// and only a disturbed solver can reach.
const COSINE_MIN: f64 = 0.2;

/// Rotation about x (rad).
pub(crate) fn turn_x(angle_rad: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::x_axis(), angle_rad)
}

/// Rotation about y (rad).
pub(crate) fn turn_y(angle_rad: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::y_axis(), angle_rad)
}

/// Rotation about z (rad).
pub(crate) fn turn_z(angle_rad: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle_rad)
}

/// The rotation that the three turns make together.
pub(crate) fn compose(turns: &[f64; 3]) -> UnitQuaternion<f64> {
    turn_x(turns[0]) * turn_y(turns[1]) * turn_z(turns[2])
}

/// The turns of a chain of `hinges` hinges that come closest to a rotation, each in (−π, π].
///
/// The inverse of [`compose`] for every rotation the chain can make; the second of three turns lies in [−π/2, π/2].
/// What a solver leaves about an axis that the chain lacks is taken out *between* the real hinges, where it disturbs
/// neither of them and no posture is singular.
pub(crate) fn decompose(hinges: usize, rotation: &UnitQuaternion<f64>) -> [f64; 3] {
    let q = rotation.quaternion();
    let (w, x, y, z) = (q.w, q.i, q.j, q.k);
    match hinges {
        0 => [0.0; 3],
        1 => {
            // Opposite quaternions are one rotation; w ≥ 0 keeps the angle within (−π, π].
            let flip = if w < 0.0 { -1.0 } else { 1.0 };
            [2.0 * (flip * x).atan2(flip * w), 0.0, 0.0]
        }
        2 => {
            // x, then the residual about z, then y.
            let alpha = (2.0 * (y * z + w * x)).atan2(1.0 - 2.0 * (x * x + z * z));
            let beta = (2.0 * (x * z + w * y)).atan2(1.0 - 2.0 * (y * y + z * z));
            [alpha, beta, 0.0]
        }
        _ => {
            let alpha = (2.0 * (w * x - y * z)).atan2(1.0 - 2.0 * (x * x + y * y));
            let beta = (2.0 * (x * z + w * y)).clamp(-1.0, 1.0).asin();
            let gamma = (2.0 * (w * z - x * y)).atan2(1.0 - 2.0 * (y * y + z * z));
            [alpha, beta, gamma]
        }
    }
}

/// The three axes as they stand after the turns. The second is perpendicular to the first and the third.
pub(crate) fn axes(turns: &[f64; 3]) -> [Vector3<f64>; 3] {
    let (sin_a, cos_a) = turns[0].sin_cos();
    let (sin_b, cos_b) = turns[1].sin_cos();
    [Vector3::x(), Vector3::new(0.0, cos_a, sin_a), Vector3::new(sin_b, -sin_a * cos_b, cos_a * cos_b)]
}

/// Cosine by which axes 1 and 3 of a three-hinge chain miss being perpendicular; 1 for shorter chains.
pub(crate) fn slant(hinges: usize, turns: &[f64; 3]) -> f64 {
    if hinges == 3 { turns[1].cos().abs().max(COSINE_MIN) } else { 1.0 }
}

/// The vectors that pick one hinge's rate out of an angular velocity, and along which its torque acts.
///
/// Dual to [`axes`]: `dual[i] · axis[j]` is 1 for i = j and 0 otherwise, so a torque along `dual[i]` does work
/// on hinge i alone.
pub(crate) fn dual_axes(hinges: usize, turns: &[f64; 3]) -> [Vector3<f64>; 3] {
    let [first, second, third] = axes(turns);
    if hinges < 3 {
        return [first, second, third];
    }
    let slant = slant(hinges, turns);
    [second.cross(&third) / slant, second, first.cross(&second) / slant]
}

/// The angle plus the whole turns that bring it within π of `near_rad`.
pub(crate) fn unwrap_near(angle_rad: f64, near_rad: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    let mut angle = angle_rad;
    while angle > near_rad + PI {
        angle -= TAU;
    }
    while angle < near_rad - PI {
        angle += TAU;
    }
    angle
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn a_quarter_turn_of_the_first_hinge_carries_the_second_axis_to_z() {
        let [first, second, third] = axes(&[FRAC_PI_2, 0.0, 0.0]);
        assert!((first - Vector3::x()).norm() < 1e-12);
        assert!((second - Vector3::z()).norm() < 1e-12);
        assert!((third + Vector3::y()).norm() < 1e-12);
    }

    #[test]
    fn unwrapping_reaches_ranges_beyond_half_a_turn() {
        assert!((unwrap_near(3.0, -2.0) - (3.0 - 2.0 * PI)).abs() < 1e-12);
        assert!((unwrap_near(-3.0, 2.0) - (2.0 * PI - 3.0)).abs() < 1e-12);
        assert!((unwrap_near(0.5, 0.0) - 0.5).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn decomposing_undoes_composing(
            a in -3.1..3.1f64, b in -1.5..1.5f64, wide_b in -3.1..3.1f64, c in -3.1..3.1f64,
        ) {
            for (hinges, turns) in [(1, [a, 0.0, 0.0]), (2, [a, wide_b, 0.0]), (3, [a, b, c])] {
                let found = decompose(hinges, &compose(&turns));
                for (found, turn) in found.iter().zip(turns) {
                    prop_assert!((found - turn).abs() < 1e-9, "{hinges} hinges: {found} instead of {turn}");
                }
            }
        }

        #[test]
        fn a_small_residual_moves_the_other_angles_by_no_more_than_itself(
            a in -3.0..3.0f64, b in -3.0..3.0f64, residual in -0.02..0.02f64,
        ) {
            let bent = turn_x(a) * turn_y(b) * turn_z(residual);
            let [found_a, found_b, _] = decompose(2, &bent);
            prop_assert!((found_a - a).abs() <= residual.abs() + 1e-9);
            prop_assert!((found_b - b).abs() <= residual.abs() + 1e-9);
        }

        #[test]
        fn axes_are_the_derivative_of_the_composition(
            a in -3.0..3.0f64, b in -1.3..1.3f64, c in -3.0..3.0f64,
        ) {
            let turns = [a, b, c];
            let step = 1e-6;
            for (hinge, axis) in axes(&turns).iter().enumerate() {
                let mut moved = turns;
                moved[hinge] += step;
                let velocity = (compose(&moved) * compose(&turns).inverse()).scaled_axis() / step;
                prop_assert!((velocity - axis).norm() < 1e-5);
            }
        }

        #[test]
        fn dual_axes_pick_out_one_hinge(a in -3.0..3.0f64, b in -1.3..1.3f64, c in -3.0..3.0f64) {
            let turns = [a, b, c];
            for (i, dual) in dual_axes(3, &turns).iter().enumerate() {
                for (j, axis) in axes(&turns).iter().enumerate() {
                    let expected = if i == j { 1.0 } else { 0.0 };
                    prop_assert!((dual.dot(axis) - expected).abs() < 1e-9);
                }
            }
        }
    }
}
