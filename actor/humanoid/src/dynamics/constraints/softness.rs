//! Softness of constraints, as in MuJoCo ("Computation" chapter of its documentation, solver parameters).
//!
//! A constraint violated by r (negative: beyond the limit) that separates at rate v wants the acceleration −b v − k
//! d(r) r. It resists the share d(r) of the force against it.

use crate::lanes::{Lanes, Simd};
use crate::model::Softness;

/// Width (m or rad) of the impedance below which it is constant, as in MuJoCo.
const WIDTH_MIN: f64 = 1e-15;

/// Constraint row of a step, for the rate and the place of the step's middle.
#[derive(Clone, Copy, Debug)]
pub(super) struct SoftRow<S: Simd> {
    /// Target acceleration.
    pub(super) target: Lanes<S>,
    /// Acceleration by which the row yields per force.
    pub(super) softness: Lanes<S>,
}

/// Returns the impedance d(r): the share of the force against it that a constraint resists.
#[inline(always)]
pub(super) fn impedance<S: Simd>(softness: &Softness, violation: Lanes<S>) -> Lanes<S> {
    let [start, end, width, midpoint, power] = softness.impedance;
    let one = violation.constant(1.0);
    if start == end || width <= WIDTH_MIN {
        return one * f64::midpoint(start, end);
    }
    let place = (violation.abs() * (1.0 / width)).min(one);
    let shape = if power == 1.0 {
        place
    } else {
        let (below, above) = if power == 2.0 {
            (place * place * (1.0 / midpoint), (one - place) * (one - place) * (1.0 / (1.0 - midpoint)))
        } else {
            let scale = [midpoint, 1.0 - midpoint].map(|part: f64| part.powf(1.0 - power));
            (to_power(place, power) * scale[0], to_power(one - place, power) * scale[1])
        };
        place.less_than(one.constant(midpoint)).select(below, one - above)
    };
    shape * (end - start) + start
}

/// Returns the row of a constraint violated by `violation` in the middle of the step, whose rate at its start is `rate`;
/// `response` is the approximate acceleration per force.
///
/// The acceleration a adds a·step/2 to the rate and a·step²/4 to the place in the middle; both are implicit.
#[inline(always)]
pub(super) fn soft_row<S: Simd>(
    softness: &Softness,
    violation: Lanes<S>,
    rate: Lanes<S>,
    response: Lanes<S>,
    step_s: f64,
) -> SoftRow<S> {
    soft_row_of(softness, impedance(softness, violation), violation, rate, response, step_s)
}

/// Returns the same row for this impedance: where several rows belong to one violation, its length decides.
#[inline(always)]
pub(super) fn soft_row_of<S: Simd>(
    softness: &Softness,
    impedance: Lanes<S>,
    violation: Lanes<S>,
    rate: Lanes<S>,
    response: Lanes<S>,
    step_s: f64,
) -> SoftRow<S> {
    let one = rate.constant(1.0);
    let spring = impedance * softness.stiffness;
    let implicit = one / (spring * (step_s * step_s / 4.0) + (1.0 + softness.damping * step_s / 2.0));
    SoftRow {
        target: -(rate * softness.damping + spring * violation) * implicit,
        softness: (one - impedance) / impedance * response * implicit,
    }
}

#[cold]
fn to_power<S: Simd>(mut x: Lanes<S>, power: f64) -> Lanes<S> {
    for lane in 0..S::F32_LANES {
        x.set_lane(lane, x.lane(lane).powf(power));
    }
    x
}

#[cfg(test)]
mod tests {
    use crate::lanes::Scalar;

    use super::*;

    #[test]
    fn impedances_of_all_powers_are_mujocos() {
        for (power, midpoint) in [(1.0, 0.5), (1.0, 0.2), (2.0, 0.5), (2.0, 0.3), (3.0, 0.5), (3.0, 0.8), (1.5, 0.6)] {
            let (start, end, width) = (0.7, 0.95, 0.01);
            let softness = Softness { impedance: [start, end, width, midpoint, power], ..Softness::default() };
            for step in -24..=24 {
                let violation = f64::from(step) * 5e-4;
                // MuJoCo's documentation, "solimp": a spline of two powers that meet at the midpoint.
                let x = (violation.abs() / width).min(1.0);
                let y = if x <= midpoint {
                    x.powf(power) / midpoint.powf(power - 1.0)
                } else {
                    1.0 - (1.0 - x).powf(power) / (1.0 - midpoint).powf(power - 1.0)
                };
                let wanted = start + y * (end - start);
                let found = impedance(&softness, Lanes::splat(Scalar, violation)).lane(0);
                assert!((found - wanted).abs() < 4e-7, "power {power}, {violation}: {found} instead of {wanted}");
            }
        }
        let mixed = Softness { impedance: [0.775, 0.9125, 0.004, 0.45, 2.625], ..Softness::default() };
        // MuJoCo 4.0's `efc_KBIP` of a contact with these numbers.
        for (violation, wanted) in
            [(0.001, 0.788_225_889_382), (0.002, 0.853_614_334_297), (0.003, 0.902_954_342_439), (0.0045, 0.9125)]
        {
            let found = impedance(&mixed, Lanes::splat(Scalar, violation)).lane(0);
            assert!((found - wanted).abs() < 4e-7, "{violation}: {found}");
        }
        for impedance_without_width in [[0.8, 0.9, 0.0, 0.5, 2.0], [0.85, 0.85, 0.01, 0.5, 2.0]] {
            let softness = Softness { impedance: impedance_without_width, ..Softness::default() };
            let found = impedance(&softness, Lanes::splat(Scalar, -0.003)).lane(0);
            assert!((found - 0.85).abs() < 1e-7, "{found}");
        }
    }

    #[test]
    fn a_row_of_no_duration_is_mujocos() {
        let softness = Softness::default();
        let [violation, rate, response] = [-0.0005, -0.2, 3.0].map(|number| Lanes::splat(Scalar, number));
        let row = soft_row(&softness, violation, rate, response, 0.0);
        // −b v − k d r, and (1 − d) / d × response, with d = 0.925.
        let target = 0.2 * softness.damping + softness.stiffness * 0.925 * 0.0005;
        assert!((row.target.lane(0) / target - 1.0).abs() < 4e-7);
        assert!((row.softness.lane(0) - 0.075 / 0.925 * 3.0).abs() < 4e-7);
    }
}
