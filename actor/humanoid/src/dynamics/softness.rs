//! Compliance of limits and contacts: MuJoCo's, with MJCF's defaults `solref` 0.02 1 and `solimp` 0.9 0.95.
//!
//! A constraint resists the share [`IMPEDANCE`] of the force against it, and restores its position like a critically damped
//! spring ("Computation" chapter of MuJoCo's documentation, solver parameters).

/// Share of a force against a constraint that the constraint resists.
pub(super) const IMPEDANCE: f64 = 0.95;
/// Time constant of the spring (s).
const TIME_S: f64 = 0.02;
/// Angular frequency of the spring (1/s): 1 / (impedance × time constant).
const FREQUENCY_PER_S: f64 = 1.0 / (IMPEDANCE * TIME_S);

/// Returns the rate after `time_s` of a constraint that is violated by `beyond` at `rate`.
///
/// It is the exact solution of r″ = −2 ω r′ − ω² r, so that a long step cannot overshoot.
pub(super) fn damped_rate(rate: f64, beyond: f64, time_s: f64) -> f64 {
    let phase = FREQUENCY_PER_S * time_s;
    (-phase).exp() * ((1.0 - phase) * rate - FREQUENCY_PER_S * phase * beyond)
}

/// Returns the rate of sliding that friction leaves after `time_s`.
pub(super) fn sliding_rate(rate: f64, time_s: f64) -> f64 {
    rate * (-2.0 * FREQUENCY_PER_S * time_s).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn damped_rate_solves_the_damped_spring() {
        // Reference: numerical integration in small steps.
        let (mut rate, mut beyond) = (1.3, 0.02);
        let (time_s, steps) = (0.03, 100_000);
        for _ in 0..steps {
            let step_s = time_s / f64::from(steps);
            rate -= step_s * (2.0 * FREQUENCY_PER_S * rate + FREQUENCY_PER_S * FREQUENCY_PER_S * beyond);
            beyond += step_s * rate;
        }
        assert!((damped_rate(1.3, 0.02, time_s) - rate).abs() < 1e-3, "{rate}");
        assert!((sliding_rate(2.0, 0.019 / 2.0) - 2.0 / std::f64::consts::E).abs() < 1e-12);
    }
}
