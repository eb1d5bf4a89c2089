//! Diagonal Gaussian over actions, with one `log_std` per action that does not depend on the observation.
//!
//! The standard deviation is `exp(log_std)`. Every function clamps `log_std` to [[`LOG_STD_MIN`], [`LOG_STD_MAX`]].

/// Least `log_std`: a standard deviation of 0.0067 in units of the action range.
pub const LOG_STD_MIN: f32 = -5.0;
/// Greatest `log_std`: a standard deviation of 7.4, far beyond the range that actions are clipped to.
pub const LOG_STD_MAX: f32 = 2.0;

/// `½ ln 2π`, the constant part of a Gaussian's log-density.
pub const HALF_LN_TAU: f32 = 0.918_938_5;

/// Clamps each `log_std` to its range; NaN stays NaN, and the checks for finite numbers find it.
pub fn clamp_log_std(log_std: &mut [f32]) {
    log_std.iter_mut().for_each(|l| *l = l.clamp(LOG_STD_MIN, LOG_STD_MAX));
}

/// Writes a sample of one row, `mean + std · normal`; `normals` are independent standard normal numbers, `[action]`.
///
/// # Panics
/// If the lengths differ.
pub fn sample(mean: &[f32], log_std: &[f32], normals: &[f32], action: &mut [f32]) {
    assert!(mean.len() == action.len() && log_std.len() == action.len() && normals.len() == action.len());
    for i in 0..action.len() {
        action[i] = mean[i] + log_std[i].clamp(LOG_STD_MIN, LOG_STD_MAX).exp() * normals[i];
    }
}

/// Returns the log-density of one action row: `Σ −½ ((a − μ)/σ)² − ln σ − ½ ln 2π`
/// (Bishop, Pattern Recognition and Machine Learning, 2006, equation 1.46, summed over independent dimensions).
///
/// # Panics
/// If the lengths differ.
pub fn log_probability(action: &[f32], mean: &[f32], log_std: &[f32]) -> f32 {
    assert!(mean.len() == action.len() && log_std.len() == action.len());
    let mut sum = 0.0;
    for i in 0..action.len() {
        let log_std = log_std[i].clamp(LOG_STD_MIN, LOG_STD_MAX);
        let z = (action[i] - mean[i]) * (-log_std).exp();
        sum += -0.5 * z * z - log_std - HALF_LN_TAU;
    }
    sum
}

/// Returns [`log_probability`] of each row of `actions` and `means`, both `[rows, action]`.
///
/// # Panics
/// If the planes do not hold the same whole rows.
pub fn log_probabilities(actions: &[f32], means: &[f32], log_std: &[f32]) -> Vec<f32> {
    let width = log_std.len();
    assert!(means.len() == actions.len() && actions.len().is_multiple_of(width), "no equal rows of {width} actions");
    let log_std: Vec<f32> = log_std.iter().map(|l| l.clamp(LOG_STD_MIN, LOG_STD_MAX)).collect();
    let inverse_std: Vec<f32> = log_std.iter().map(|l| (-l).exp()).collect();
    let of_row = |(action, mean): (&[f32], &[f32])| {
        let mut sum = 0.0;
        for i in 0..width {
            let z = (action[i] - mean[i]) * inverse_std[i];
            sum += -0.5 * z * z - log_std[i] - HALF_LN_TAU;
        }
        sum
    };
    actions.chunks_exact(width).zip(means.chunks_exact(width)).map(of_row).collect()
}

/// Returns the Kullback–Leibler divergence KL(old ‖ new) in nats, mean over rows of `[rows, action]` means:
/// `Σ ln(σ'/σ) + (σ² + (μ − μ')²) / (2 σ'²) − ½` with μ' and σ' of the new policy (Bishop 2006, exercise 1.30, summed over
/// independent dimensions).
///
/// # Panics
/// If the planes do not hold the same whole rows.
pub fn kl_divergence(old_means: &[f32], old_log_std: &[f32], means: &[f32], log_std: &[f32]) -> f64 {
    let width = log_std.len();
    assert!(means.len() == old_means.len() && old_log_std.len() == width && means.len().is_multiple_of(width));
    let wide = |log_std: &[f32]| -> Vec<f64> {
        log_std.iter().map(|l| f64::from(l.clamp(LOG_STD_MIN, LOG_STD_MAX))).collect()
    };
    let (old_log_std, log_std) = (wide(old_log_std), wide(log_std));
    let spread = old_log_std.iter().zip(&log_std).map(|(old, new)| new - old + 0.5 * (2.0 * (old - new)).exp_m1());
    let half_precision: Vec<f64> = log_std.iter().map(|l| 0.5 * (-2.0 * l).exp()).collect();
    let mut shift = 0.0;
    for (old, new) in old_means.chunks_exact(width).zip(means.chunks_exact(width)) {
        for i in 0..width {
            let moved = f64::from(new[i]) - f64::from(old[i]);
            shift += moved * moved * half_precision[i];
        }
    }
    spread.sum::<f64>() + shift / (means.len() / width).max(1) as f64
}

/// Returns the differential entropy in nats: `Σ ½ + ½ ln 2π + ln σ` (Bishop 2006, equation 1.110).
pub fn entropy(log_std: &[f32]) -> f32 {
    log_std.iter().map(|l| 0.5 + HALF_LN_TAU + l.clamp(LOG_STD_MIN, LOG_STD_MAX)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f32, b: f32) {
        assert!((a - b).abs() < 1e-5, "{a} is not {b}");
    }

    #[test]
    fn log_probability_agrees_with_a_table() {
        // ln φ(0) = −0.9189385, ln φ(1) = −1.4189385; σ = 2 shifts by −ln 2.
        close(log_probability(&[0.0], &[0.0], &[0.0]), -0.918_938_5);
        close(
            log_probability(&[3.0, 0.5], &[1.0, 0.5], &[2.0_f32.ln(), 0.0]),
            -1.418_938_5 - 2.0_f32.ln() - 0.918_938_5,
        );
    }

    #[test]
    fn log_probabilities_are_those_of_each_row() {
        let (actions, means) = ([0.3, -1.0, 2.5, 0.7, 0.0, 9.0], [0.1, -0.5, 2.0, 1.0, 3.0, -4.0]);
        let log_std = [-0.5, 0.25];
        let expected: Vec<f32> =
            (0..3).map(|row| log_probability(&actions[row * 2..][..2], &means[row * 2..][..2], &log_std)).collect();
        assert_eq!(log_probabilities(&actions, &means, &log_std), expected);
        assert!(log_probabilities(&[], &[], &log_std).is_empty());
    }

    #[test]
    fn kl_divergence_equals_that_computed_by_hand() {
        let kl = |old: ([f32; 2], [f32; 2]), new: ([f32; 2], [f32; 2])| kl_divergence(&old.0, &old.1, &new.0, &new.1);
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-7, "{a} is not {b}");
        let unit = ([0.0, 0.0], [0.0, 0.0]);
        assert_eq!(kl(unit, unit), 0.0);
        // A mean that moves by ½ costs ½ · ½²; with σ' = 2 a quarter of that, and ln 2 + ⅛ − ½ for the spread.
        close(kl(unit, ([0.5, 0.0], [0.0, 0.0])), 0.125);
        let ln_2 = std::f64::consts::LN_2;
        close(kl(unit, ([0.5, 0.0], [2.0_f32.ln(), 0.0])), ln_2 + 0.125 - 0.5 + 0.031_25);
        // The other direction: −ln 2 + 4/2 − ½ and ½ · ½².
        close(kl(([0.5, 0.0], [2.0_f32.ln(), 0.0]), unit), -ln_2 + 1.5 + 0.125);
        // Two rows of one action: the mean of 0 and ½ · 1².
        close(kl_divergence(&[1.0, 1.0], &[0.0], &[1.0, 2.0], &[0.0]), 0.25);
    }

    #[test]
    fn kl_divergence_is_the_expected_difference_of_log_probabilities() {
        let (old, new) = (([0.2], [-0.3]), ([-0.1], [0.4]));
        let step = 0.001;
        let expected: f64 = (-10_000..10_000)
            .map(|i| [i as f32 * step])
            .map(|x| (log_probability(&x, &old.0, &old.1), log_probability(&x, &new.0, &new.1)))
            .map(|(p, q)| f64::from(p.exp() * (p - q) * step))
            .sum();
        let found = kl_divergence(&old.0, &old.1, &new.0, &new.1);
        assert!((found - expected).abs() < 1e-4, "{found} {expected}");
    }

    #[test]
    fn the_density_integrates_to_one() {
        let step = 0.01;
        let total: f32 = (-2000..2000).map(|i| log_probability(&[i as f32 * step], &[0.3], &[0.4]).exp() * step).sum();
        close(total, 1.0);
    }

    #[test]
    fn entropy_is_the_mean_of_minus_log_probability() {
        close(entropy(&[0.0]), 1.418_938_5);
        let step = 0.01;
        let mean: f32 = (-2000..2000)
            .map(|i| log_probability(&[i as f32 * step], &[0.0], &[0.4]))
            .map(|l| -l * l.exp() * step)
            .sum();
        close(entropy(&[0.4]), mean);
        close(entropy(&[0.0, 0.4]), entropy(&[0.0]) + mean);
    }

    #[test]
    fn a_sample_is_the_scaled_and_shifted_normal() {
        let mut action = [0.0; 2];
        sample(&[1.0, -1.0], &[2.0_f32.ln(), 0.0], &[0.5, -2.0], &mut action);
        close(action[0], 2.0);
        close(action[1], -3.0);
    }

    #[test]
    fn log_std_is_clamped_to_its_range() {
        let mut action = [0.0];
        sample(&[0.0], &[f32::INFINITY], &[1.0], &mut action);
        assert_eq!(action[0], LOG_STD_MAX.exp());
        assert_eq!(log_probability(&[0.1], &[0.0], &[-50.0]), log_probability(&[0.1], &[0.0], &[LOG_STD_MIN]));
        let mut log_std = [-9.0, 9.0, 0.3];
        clamp_log_std(&mut log_std);
        assert_eq!(log_std, [LOG_STD_MIN, LOG_STD_MAX, 0.3]);
    }
}
