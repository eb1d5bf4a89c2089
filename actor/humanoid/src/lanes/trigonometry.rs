//! Sine and cosine of every lane.

use std::f64::consts::FRAC_2_PI;

use super::{Lanes, Simd};

/// Adding and subtracting this number rounds to the nearest whole one (for numbers up to 2^22).
const ROUNDING: f64 = 12_582_912.0;
/// π/2 in three parts; the products of the first two with whole numbers up to 2^12 are exact (Cody and Waite).
const HALF_PI: [f64; 3] = [1.570_312_5, 4.837_512_969_970_703e-4, 7.549_789_954_891_882e-8];

impl<S: Simd> Lanes<S> {
    /// Returns sine and cosine of an angle (rad), within 1e-7 up to 6e3 rad.
    #[inline(always)]
    pub(crate) fn sin_cos(self) -> (Self, Self) {
        let turns = rounded(self * FRAC_2_PI);
        let [high, middle, low] = HALF_PI;
        let rest = turns.mul_sub_from(self.constant(high), self);
        let rest = turns.mul_sub_from(self.constant(middle), rest);
        let rest = turns.mul_sub_from(self.constant(low), rest);
        let square = rest * rest;
        // Taylor series: the first omitted terms are below 2e-9 for |rest| ≤ π/4.
        let sin = rest * series(square, &[1.0 / 6.0, 1.0 / 20.0, 1.0 / 42.0, 1.0 / 72.0]);
        let cos = series(square, &[1.0 / 2.0, 1.0 / 12.0, 1.0 / 30.0, 1.0 / 56.0, 1.0 / 90.0]);
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
        let small = self.less_than(self.constant(1e-3));
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
    use super::super::{Scalar, WithRegisters, with_registers};
    use super::*;

    struct Table;

    impl WithRegisters for Table {
        type Output = ();

        fn run<S: Simd>(&self, simd: S) {
            for index in -40_000..40_000 {
                let angle = f64::from((f64::from(index) * 0.1507) as f32);
                let (sin, cos) = Lanes::splat(simd, angle).sin_cos();
                let (expected_sin, expected_cos) = angle.sin_cos();
                let last = S::F32_LANES - 1;
                assert!((sin.lane(last) - expected_sin).abs() < 1e-7, "sin {angle}: {}", sin.lane(last));
                assert!((cos.lane(last) - expected_cos).abs() < 1e-7, "cos {angle}: {}", cos.lane(last));
                let (sinc, cos) = Lanes::splat(simd, angle * angle).sinc_cos_of_root();
                let expected = if index == 0 { 1.0 } else { expected_sin / angle };
                assert!((sinc.lane(0) - expected).abs() < 1e-7 && (cos.lane(0) - expected_cos).abs() < 1e-7);
            }
            let (sinc, cos) = Lanes::splat(simd, 1e-10).sinc_cos_of_root();
            assert!(sinc.lane(0) == 1.0 && cos.lane(0) == 1.0);
        }
    }

    #[test]
    fn sine_and_cosine_match_those_of_the_standard_library() {
        with_registers(&Table);
        Table.run(Scalar);
    }
}
