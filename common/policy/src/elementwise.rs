//! Element-wise loops of the networks, written so that the compiler vectorises them.
//!
//! Each loop is compiled for AVX-512, AVX2 and the baseline target; the best version is chosen at run time. Versions with
//! fused multiply-add, as the matrix products have them, round `exp` once per step and give other bits than the baseline's.

use multiversion::{multiversion, target::target_cfg_f};

/// Compiles the body once per instruction set. `$portable` is the body itself; `FUSED` is whether the processor has an
/// instruction for [`product_sum`].
macro_rules! dispatched {
    ($(#[$doc:meta])* fn $name:ident / $portable:ident($($arg:ident: $kind:ty),*) $body:block) => {
        #[inline(always)]
        fn $portable<const FUSED: bool>($($arg: $kind),*) $body

        $(#[$doc])*
        #[multiversion(targets(
            "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+fma",
            "x86_64+avx2+fma",
        ))]
        pub(super) fn $name($($arg: $kind),*) {
            if target_cfg_f!(target_feature = "fma") || cfg!(target_arch = "aarch64") {
                $portable::<true>($($arg),*);
            } else {
                $portable::<false>($($arg),*);
            }
        }
    };
}

dispatched! {
    /// Adds `bias` to the first columns of every row of `rows`, `[n, width]`.
    fn add_bias / add_bias_portable(rows: &mut [f32], width: usize, bias: &[f32]) {
        for row in rows.chunks_exact_mut(width) {
            for (x, b) in row.iter_mut().zip(bias) {
                *x += *b;
            }
        }
    }
}

dispatched! {
    /// Adds `bias` to every row, then applies ELU with α = 1.
    fn add_bias_elu / add_bias_elu_portable(rows: &mut [f32], bias: &[f32]) {
        for row in rows.chunks_exact_mut(bias.len()) {
            for (x, b) in row.iter_mut().zip(bias) {
                *x = elu::<FUSED>(*x + *b);
            }
        }
    }
}

dispatched! {
    /// Converts the gradient of ELU's output to that of its input, and adds its column sums to `bias_gradient`.
    ///
    /// `gradient` and `activation` (ELU's output) are `[n, width]`, `bias_gradient` is `[width]`.
    fn elu_backward / elu_backward_portable(gradient: &mut [f32], activation: &[f32], bias_gradient: &mut [f32]) {
        let width = bias_gradient.len();
        for (row, activation) in gradient.chunks_exact_mut(width).zip(activation.chunks_exact(width)) {
            for ((g, h), sum) in row.iter_mut().zip(activation).zip(bias_gradient.iter_mut()) {
                *g *= elu_slope(*h);
                *sum += *g;
            }
        }
    }
}

dispatched! {
    /// Applies ELU to the two halves `a` and `b` of every row, given as `u` and `v` with `a = u + v + bias` and
    /// `b = u − v + bias`, and replaces them by their sums and differences. Rows are `[n, 2 · half]`, `bias` is `[half]`.
    fn add_bias_elu_to_halves / add_bias_elu_to_halves_portable(rows: &mut [f32], bias: &[f32]) {
        for row in rows.chunks_exact_mut(2 * bias.len()) {
            let (sums, differences) = row.split_at_mut(bias.len());
            for ((u, v), c) in sums.iter_mut().zip(differences).zip(bias) {
                let (a, b) = (elu::<FUSED>(*u + *c + *v), elu::<FUSED>(*u + *c - *v));
                (*u, *v) = (a + b, a - b);
            }
        }
    }
}

dispatched! {
    /// Converts the gradient of the output of [`add_bias_elu_to_halves`] to that of its input, and adds that of the bias.
    fn elu_backward_from_halves / elu_backward_from_halves_portable(
        gradient: &mut [f32], activation: &[f32], bias_gradient: &mut [f32]
    ) {
        let half = bias_gradient.len();
        for (row, activation) in gradient.chunks_exact_mut(2 * half).zip(activation.chunks_exact(2 * half)) {
            let (by_sums, by_differences) = row.split_at_mut(half);
            let (sums, differences) = activation.split_at(half);
            let columns = by_sums.iter_mut().zip(by_differences).zip(sums.iter().zip(differences));
            for (((u, v), (sum, difference)), bias) in columns.zip(bias_gradient.iter_mut()) {
                // A sum of halves that are both at least −1 is exact enough for the slope.
                let (a, b) = (0.5 * (sum + difference), 0.5 * (sum - difference));
                let by_a = (*u + *v) * elu_slope(a);
                let by_b = (*u - *v) * elu_slope(b);
                (*u, *v) = (by_a + by_b, by_a - by_b);
                *bias += *u;
            }
        }
    }
}

dispatched! {
    /// Adds the sums of the first columns of `rows`, `[n, width]`, to `sums`.
    fn add_column_sums / add_column_sums_portable(rows: &[f32], width: usize, sums: &mut [f32]) {
        for row in rows.chunks_exact(width) {
            for (sum, x) in sums.iter_mut().zip(row) {
                *sum += *x;
            }
        }
    }
}

/// Exponential linear unit with α = 1: Clevert, Unterthiner & Hochreiter 2016, arXiv:1511.07289.
#[inline(always)]
fn elu<const FUSED: bool>(x: f32) -> f32 {
    // Both sides are evaluated so that the choice compiles to a blend, not a branch.
    let below = exp_nonpositive::<FUSED>(x) - 1.0;
    if x > 0.0 { x } else { below }
}

/// Slope of ELU where its output is `h`: 1 above zero, and exp(x) = ELU(x) + 1 below.
#[inline(always)]
fn elu_slope(h: f32) -> f32 {
    if h > 0.0 { 1.0 } else { h + 1.0 }
}

/// Returns `a · b + c`.
#[inline(always)]
fn product_sum<const FUSED: bool>(a: f32, b: f32, c: f32) -> f32 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}

/// Returns `exp(x)` for `x ≤ 0` within 2e-7; NaN stays NaN. For `x > 0` the result is meaningless.
///
/// `x = n ln 2 + r` with `|r| ≤ ½ ln 2`, then `exp(x) = 2ⁿ exp(r)` with a polynomial of degree 6 for `exp(r)`, whose first
/// two coefficients are 1 and whose largest error there is 4.2e-9. (The fit was made by weighted least squares.)
#[inline(always)]
fn exp_nonpositive<const FUSED: bool>(x: f32) -> f32 {
    /// Adding this rounds to an integer, in the lowest bits of the mantissa.
    const ROUND: f32 = 12_582_912.0;
    /// `ln 2` in two parts; the product of `n` and the first is exact.
    const LN_2_HIGH: f32 = 0.693_359_4;
    const LN_2_LOW: f32 = -2.121_944_4e-4;
    /// Below this `exp` is less than half of the last bit of −1, and 2ⁿ would leave the normal numbers.
    const LEAST: f32 = -87.0;
    /// Coefficients of r⁶ to r⁰.
    const COEFFICIENTS: [f32; 7] = [0.001_395_05, 0.008_368_88, 0.041_666_21, 0.166_665_2, 0.5, 1.0, 1.0];

    let x = if x < LEAST { LEAST } else { x };
    let shifted = product_sum::<FUSED>(x, std::f32::consts::LOG2_E, ROUND);
    let n = shifted - ROUND;
    let r = product_sum::<FUSED>(n, -LN_2_LOW, product_sum::<FUSED>(n, -LN_2_HIGH, x));
    let [highest, rest @ ..] = COEFFICIENTS;
    let polynomial = rest.into_iter().fold(highest, |sum, next| product_sum::<FUSED>(sum, r, next));
    // A product, because an addition to the exponent's bits could turn NaN into a number.
    polynomial * f32::from_bits((shifted.to_bits() << 23).wrapping_add(127 << 23))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn exp_is_within_its_stated_error_of_the_exact_value() {
        for i in 0..=870_000 {
            let x = -i as f32 * 1e-4;
            let exact = f64::from(x).exp();
            for found in [exp_nonpositive::<true>(x), exp_nonpositive::<false>(x)] {
                assert!((f64::from(found) - exact).abs() <= 2e-7 * exact.max(1e-3), "{x}");
            }
        }
    }

    #[test]
    fn elu_is_right_at_the_edges() {
        for elu in [elu::<true>, elu::<false>] {
            assert_eq!(elu(0.0), 0.0);
            assert_eq!(elu(2.5), 2.5);
            assert_eq!(elu(f32::NEG_INFINITY), -1.0);
            assert_eq!(elu(-1e30), -1.0);
            assert_eq!(elu(f32::INFINITY), f32::INFINITY);
            assert!(elu(f32::NAN).is_nan());
        }
    }

    #[test]
    fn bias_gradients_are_column_sums() {
        let mut gradient = [1.0, 2.0, 3.0, 4.0];
        let mut sums = [10.0, 20.0];
        elu_backward(&mut gradient, &[0.5, -0.5, 7.0, -0.75], &mut sums);
        assert_eq!(gradient, [1.0, 1.0, 3.0, 1.0]);
        assert_eq!(sums, [14.0, 22.0]);
        add_column_sums(&gradient, 2, &mut sums);
        assert_eq!(sums, [18.0, 24.0]);
    }

    /// Returns whether this processor's version uses fused multiply-add.
    fn is_fused() -> bool {
        #[cfg(target_arch = "x86_64")]
        return is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
        #[cfg(not(target_arch = "x86_64"))]
        return cfg!(target_arch = "aarch64");
    }

    proptest! {
        #[test]
        fn vectorised_and_portable_loops_give_the_same_bits(
            width in 1_usize..40,
            numbers in prop::collection::vec(-30.0_f32..5.0, 200),
        ) {
            let rows = 200 / width - 1;
            let (bias, rest) = numbers.split_at(width);
            let input = &rest[..rows * width];
            let (mut a, mut b) = (input.to_vec(), input.to_vec());
            add_bias_elu(&mut a, bias);
            match is_fused() {
                true => add_bias_elu_portable::<true>(&mut b, bias),
                false => add_bias_elu_portable::<false>(&mut b, bias),
            }
            prop_assert_eq!(&a, &b);

            let (mut ga, mut gb) = (input.to_vec(), input.to_vec());
            let (mut sa, mut sb) = (bias.to_vec(), bias.to_vec());
            elu_backward(&mut ga, &a, &mut sa);
            elu_backward_portable::<false>(&mut gb, &b, &mut sb);
            add_column_sums(&ga, width, &mut sa);
            add_column_sums_portable::<false>(&gb, width, &mut sb);
            add_bias(&mut ga, width, &sa);
            add_bias_portable::<false>(&mut gb, width, &sb);
            prop_assert_eq!(ga, gb);
            prop_assert_eq!(sa, sb);
        }
    }
}
