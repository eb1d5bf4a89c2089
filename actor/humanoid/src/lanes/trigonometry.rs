//! Sine and cosine of every lane.

use std::f64::consts::FRAC_2_PI;

use pulp::Simd;

use super::Lanes;

/// Adding and subtracting this number rounds to the nearest whole one (for numbers up to 2^51).
const ROUNDING: f64 = 6_755_399_441_055_744.0;
/// π/2 in three parts, whose products with small whole numbers are exact.
const HALF_PI: [f64; 3] = [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];

impl<S: Simd> Lanes<S> {
    /// Returns sine and cosine of an angle (rad), within 2e-16 up to 1e5 rad.
    #[inline(always)]
    pub(crate) fn sin_cos(self) -> (Self, Self) {
        let turns = rounded(self * FRAC_2_PI);
        let [high, middle, low] = HALF_PI;
        let rest = turns.mul_sub_from(self.constant(high), self);
        let rest = turns.mul_sub_from(self.constant(middle), rest);
        let rest = turns.mul_sub_from(self.constant(low), rest);
        let square = rest * rest;
        // Taylor series: the first omitted terms are below 1e-17 for |rest| ≤ π/4.
        let sin = rest
            * series(square, &[1.0 / 6.0, 1.0 / 20.0, 1.0 / 42.0, 1.0 / 72.0, 1.0 / 110.0, 1.0 / 156.0, 1.0 / 210.0]);
        let cos = series(
            square,
            &[1.0 / 2.0, 1.0 / 12.0, 1.0 / 30.0, 1.0 / 56.0, 1.0 / 90.0, 1.0 / 132.0, 1.0 / 182.0, 1.0 / 240.0],
        );
        // The quarter turn, from −2 to 2.
        let quarter = turns - rounded(turns * 0.25) * 4.0;
        let one = self.constant(1.0);
        let odd = (quarter * quarter).equals(one);
        let half = quarter.abs().equals(self.constant(2.0));
        let (along, across) = (odd.select(cos, sin), odd.select(sin, cos));
        let negative_sin = half.or(quarter.equals(-one));
        let negative_cos = half.or(quarter.equals(one));
        (negative_sin.select(-along, along), negative_cos.select(-across, across))
    }

    /// Returns sin(√x)/√x and cos(√x) for x ≥ 0.
    #[inline(always)]
    pub(crate) fn sinc_cos_of_root(self) -> (Self, Self) {
        let angle = self.sqrt();
        let (sin, cos) = angle.sin_cos();
        // Below, the next term of the series is less than a rounding error.
        let small = self.less_than(self.constant(1e-8));
        (small.select(self.constant(1.0) - self * (1.0 / 6.0), sin / angle), cos)
    }
}

#[inline(always)]
fn rounded<S: Simd>(number: Lanes<S>) -> Lanes<S> {
    (number + ROUNDING) - ROUNDING
}

/// Returns 1 − x f₀ (1 − x f₁ (1 − …)).
#[inline(always)]
fn series<S: Simd>(x: Lanes<S>, factors: &[f64]) -> Lanes<S> {
    let one = x.constant(1.0);
    let mut sum = one;
    for factor in factors.iter().rev() {
        sum = (x * sum).mul_sub_from(x.constant(*factor), one);
    }
    sum
}

#[cfg(test)]
mod tests {
    use pulp::{Arch, Simd, WithSimd};

    use super::*;

    struct Table;

    impl WithSimd for Table {
        type Output = ();

        fn with_simd<S: Simd>(self, simd: S) {
            for index in -40_000..40_000 {
                let angle = f64::from(index) * 0.0137;
                let (sin, cos) = Lanes::splat(simd, angle).sin_cos();
                let (expected_sin, expected_cos) = angle.sin_cos();
                let last = S::F64_LANES - 1;
                assert!((sin.lane(last) - expected_sin).abs() < 3e-16, "sin {angle}: {}", sin.lane(last));
                assert!((cos.lane(last) - expected_cos).abs() < 3e-16, "cos {angle}: {}", cos.lane(last));
                let (sinc, cos) = Lanes::splat(simd, angle * angle).sinc_cos_of_root();
                let expected = if index == 0 { 1.0 } else { expected_sin / angle };
                assert!((sinc.lane(0) - expected).abs() < 1e-14 && (cos.lane(0) - expected_cos).abs() < 1e-13);
            }
            let (sinc, cos) = Lanes::splat(simd, 1e-10).sinc_cos_of_root();
            assert!((sinc.lane(0) - (1.0 - 1e-10 / 6.0)).abs() < 1e-16 && (cos.lane(0) - (1.0 - 5e-11)).abs() < 1e-16);
        }
    }

    #[test]
    fn sine_and_cosine_match_those_of_the_standard_library() {
        Arch::new().dispatch(Table);
        Table.with_simd(pulp::Scalar);
    }
}
