//! Measures of an update, and the adaptive learning rate.

use treadmill_config::PpoConfig;

/// Distance of the policy from the one that acted, summed over rows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PolicyShift {
    rows: usize,
    kl: f64,
    clipped: usize,
}

impl PolicyShift {
    /// Adds rows, given their `ln π_new(a|s) − ln π_old(a|s)`.
    pub(crate) fn add(&mut self, log_ratio: &[f32], clip_range: f64) {
        self.rows += log_ratio.len();
        for log_ratio in log_ratio.iter().map(|l| f64::from(*l)) {
            let ratio = log_ratio.exp();
            self.kl += (ratio - 1.0) - log_ratio;
            self.clipped += usize::from((ratio - 1.0).abs() > clip_range);
        }
    }

    /// Estimated Kullback–Leibler divergence from the old to the new policy, in nats: the mean of
    /// `(ratio − 1) − ln ratio`, unbiased and never negative (Schulman 2020, "Approximating KL divergence", `k3`).
    pub(crate) fn approx_kl(&self) -> f64 {
        self.kl / self.rows.max(1) as f64
    }

    /// Share of rows whose ratio is outside the clip range.
    pub(crate) fn clip_fraction(&self) -> f64 {
        self.clipped as f64 / self.rows.max(1) as f64
    }
}

/// Returns the share of the variance of `returns` that `values` explain: `1 − Var(returns − values) / Var(returns)`.
///
/// 1 is perfect, 0 is no better than a constant. It is also 0 if all returns are equal or there are none.
///
/// # Panics
/// If the lengths differ.
pub fn explained_variance(values: &[f32], returns: &[f32]) -> f64 {
    assert_eq!(values.len(), returns.len(), "one value per return");
    let total = variance(returns.iter().map(|r| f64::from(*r)));
    let rest = variance(returns.iter().zip(values).map(|(r, v)| f64::from(*r) - f64::from(*v)));
    if total > 0.0 { 1.0 - rest / total } else { 0.0 }
}

fn variance(numbers: impl Iterator<Item = f64> + Clone) -> f64 {
    let count = numbers.clone().count().max(1) as f64;
    let mean = numbers.clone().sum::<f64>() / count;
    numbers.map(|x| (x - mean).powi(2)).sum::<f64>() / count
}

/// Returns the learning rate after an epoch whose KL divergence was `approx_kl`. Above twice the target it is divided
/// by 1.5, below half the target multiplied by 1.5, always within its bounds. A target of 0 keeps it fixed.
///
/// Rule of rl_games and rsl_rl, after the adaptive penalty of Schulman et al. 2017, arXiv:1707.06347, section 4.
pub fn adapt_learning_rate(learning_rate: f64, approx_kl: f64, config: &PpoConfig) -> f64 {
    const FACTOR: f64 = 1.5;
    let adapted = match config.target_kl {
        0.0 => return learning_rate,
        target if approx_kl > 2.0 * target => learning_rate / FACTOR,
        target if approx_kl < 0.5 * target => learning_rate * FACTOR,
        _ => learning_rate,
    };
    adapted.clamp(config.learning_rate_min, config.learning_rate_max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f64, b: f64) {
        assert!((a - b).abs() < 1e-6, "{a} is not {b}");
    }

    #[test]
    fn kl_and_clip_fraction_are_those_computed_by_hand() {
        let mut shift = PolicyShift::default();
        shift.add(&[0.0, 2.0_f32.ln()], 0.2);
        shift.add(&[0.5_f32.ln(), 1.1_f32.ln()], 0.2);
        // k3: 0, 1 − ln 2, −½ + ln 2, 0.1 − ln 1.1.
        close(shift.approx_kl(), (0.5 + 0.1 - 1.1_f64.ln()) / 4.0);
        close(shift.clip_fraction(), 0.5);
    }

    #[test]
    fn the_kl_estimate_is_that_of_two_gaussians() {
        // Old N(0, 1), new N(½, 1): KL = ½ · ½². Rows stand at the quantile midpoints of a fine grid, weighted by hand.
        let (mut kl, mut weight) = (0.0, 0.0);
        for i in -800..=800 {
            let x = f64::from(i) * 0.01;
            let density = (-0.5 * x * x).exp();
            let mut shift = PolicyShift::default();
            shift.add(&[(0.5 * x - 0.125) as f32], 0.2);
            kl += density * shift.approx_kl();
            weight += density;
        }
        assert!((kl / weight - 0.125).abs() < 1e-4, "{}", kl / weight);
    }

    #[test]
    fn explained_variance_is_that_computed_by_hand() {
        close(explained_variance(&[1.0, 2.0, 3.0], &[1.0, 2.0, 3.0]), 1.0);
        close(explained_variance(&[5.0, 5.0, 5.0], &[1.0, 2.0, 3.0]), 0.0);
        // Residuals 0, 0, 1: variance 2/9 of 2/3.
        close(explained_variance(&[1.0, 2.0, 2.0], &[1.0, 2.0, 3.0]), 1.0 - 1.0 / 3.0);
        close(explained_variance(&[3.0, 2.0, 1.0], &[1.0, 2.0, 3.0]), -3.0);
        close(explained_variance(&[1.0, 2.0], &[4.0, 4.0]), 0.0);
        close(explained_variance(&[], &[]), 0.0);
    }

    #[test]
    fn the_learning_rate_follows_the_kl_within_its_bounds() {
        let config =
            PpoConfig { target_kl: 0.008, learning_rate_min: 1e-5, learning_rate_max: 1e-3, ..PpoConfig::default() };
        close(adapt_learning_rate(3e-4, 0.0161, &config), 2e-4);
        close(adapt_learning_rate(2e-4, 0.0039, &config), 3e-4);
        assert_eq!(adapt_learning_rate(3e-4, 0.016, &config), 3e-4);
        assert_eq!(adapt_learning_rate(3e-4, 0.004, &config), 3e-4);
        assert_eq!(adapt_learning_rate(1.2e-5, 1.0, &config), 1e-5);
        assert_eq!(adapt_learning_rate(9e-4, 0.0, &config), 1e-3);
        let fixed = PpoConfig { target_kl: 0.0, ..config };
        assert_eq!(adapt_learning_rate(0.5, 1.0, &fixed), 0.5);
        assert_eq!(adapt_learning_rate(0.5, 0.0, &fixed), 0.5);
    }
}
