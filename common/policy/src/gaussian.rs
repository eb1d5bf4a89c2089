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
