//! Finds fragments whose numbers are finite but cannot be what an actor observed, so that one bad actor harms no update.
//!
//! The bounds are far beyond what an honest actor sends. They find faults and attacks that would make an update
//! infinite, not data that is merely wrong.

use treadmill_policy::{
    gaussian::{HALF_LN_TAU, LOG_STD_MAX, LOG_STD_MIN},
    normaliser::RunningMoments,
};

/// Allowed difference between a log-probability of lag 0 and the one that the learner computes, in nats: half of the default
/// clip range, so that it changes no ratio noticeably.
///
/// The largest difference that a test measures between rows evaluated alone and together, Candle's operations, and sums in
/// another order is 1.1e-4 with the smallest standard deviation that a policy can have, and 4e-6 with those of training.
/// Observations of half precision add nothing: actors round them before the policy sees them.
pub const LOG_PROB_TOLERANCE: f32 = 0.1;
/// Allowed difference in addition, as a fraction of the log-probability: rounding grows with the number of actions.
pub const LOG_PROB_TOLERANCE_RELATIVE: f32 = 1e-4;
/// Largest squared distance of an action from its mean, in squared standard deviations, is this plus twice the number of
/// actions. For one action that is 20 standard deviations; for `A` actions the expected square is `A`, its deviation
/// `√(2A)`.
pub const SQUARED_DISTANCE_MAX: f32 = 400.0;
/// Largest scaled reward, return or advantage, in units of the returns' running scale (standard deviation plus absolute
/// mean), or of the batch's median fragment if that is larger.
pub const SCALES_MAX: f64 = 1e6;
/// Largest scaled reward, return or advantage in any case: squares and sums stay finite in single precision.
pub const MAGNITUDE_MAX: f64 = 1e15;

/// Why the learner does not learn from a fragment, and what to do at its sender.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Implausible {
    /// A log-probability is not that of the policy that the fragment names.
    #[error(
        "the log-probability of transition {row} is {claimed}, but the policy gives {computed}; the actor must evaluate the \
         policy of its version with that version's statistics, and send log-probabilities of unclipped actions"
    )]
    LogProbability {
        /// Transition.
        row: usize,
        /// Number in the fragment.
        claimed: f32,
        /// Number that the learner computes.
        computed: f32,
    },
    /// An action is no sample of the policy.
    #[error(
        "the action of transition {row} has a log-probability of {computed} under its policy, so it is no sample of it; the \
         actor must send the unclipped actions that it drew, in units of the action range"
    )]
    Action {
        /// Transition.
        row: usize,
        /// Log-probability that the learner computes.
        computed: f32,
    },
    /// A log-probability that no policy gives to its own sample.
    #[error(
        "the log-probability of transition {row} is {claimed}; samples of a policy have {least} to {most}; the actor \
         must send log-probabilities of the actions that it drew"
    )]
    OutOfRange {
        /// Transition.
        row: usize,
        /// Number in the fragment.
        claimed: f32,
        /// Least log-probability of a plausible sample.
        least: f32,
        /// Greatest log-probability of any action.
        most: f32,
    },
    /// A reward, return or advantage is absurdly large.
    #[error(
        "the {quantity} of transition {row} is {value:e}, beyond {limit:e}; check the rewards of the environment of this \
         actor"
    )]
    Magnitude {
        /// Scaled reward, return or advantage.
        quantity: &'static str,
        /// Transition.
        row: usize,
        /// Its value in units of scaled rewards.
        value: f32,
        /// Largest allowed value.
        limit: f64,
    },
    /// An update from this fragment alone has a number that is not finite, and updates from others do not.
    #[error("an update from it alone is not finite; check observations, actions and rewards of this actor")]
    NonFinite,
}

/// Numbers of one fragment that are checked, each `[rows]`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FragmentNumbers<'a> {
    /// Versions between its policy and the newest.
    pub(crate) lag: u64,
    /// Log-probabilities in the fragment.
    pub(crate) claimed: &'a [f32],
    /// Log-probabilities under the newest policy.
    pub(crate) log_probs: &'a [f32],
    /// Scaled rewards.
    pub(crate) rewards: &'a [f32],
    /// Value targets in units of scaled rewards.
    pub(crate) returns: &'a [f32],
    /// Advantages in those units.
    pub(crate) advantages: &'a [f32],
}

/// Returns places and reasons of implausible fragments, in ascending order. `value_moments` are those of earlier returns.
pub(crate) fn implausible(
    fragments: &[FragmentNumbers],
    log_std: &[f32],
    value_moments: &RunningMoments,
) -> Vec<(usize, Implausible)> {
    let limit = magnitude_limit(fragments, value_moments);
    let check = |fragment: &FragmentNumbers| {
        log_probability_fault(fragment, log_std).or_else(|| magnitude_fault(fragment, limit))
    };
    fragments.iter().enumerate().filter_map(|(place, fragment)| Some((place, check(fragment)?))).collect()
}

/// Returns the first fault of a fragment's log-probabilities.
fn log_probability_fault(fragment: &FragmentNumbers, log_std: &[f32]) -> Option<Implausible> {
    let actions = log_std.len() as f32;
    // Log-density at the mean, and the loss of an action that is as far away as allowed.
    let peak = |log_std: f32| -log_std - HALF_LN_TAU;
    let farthest = 0.5 * (SQUARED_DISTANCE_MAX + 2.0 * actions);
    let least_of_policy = log_std.iter().map(|l| peak(*l)).sum::<f32>() - farthest;
    let (least, most) = (actions * peak(LOG_STD_MAX) - farthest, actions * peak(LOG_STD_MIN));
    let tolerance = |computed: f32| LOG_PROB_TOLERANCE + LOG_PROB_TOLERANCE_RELATIVE * computed.abs();
    fragment.claimed.iter().zip(fragment.log_probs).enumerate().find_map(|(row, (&claimed, &computed))| {
        // Written so that NaN is a fault.
        let is_within = |low: f32, x: f32, high: f32| low <= x && x <= high;
        if fragment.lag == 0 {
            let is_same = (claimed - computed).abs() <= tolerance(computed);
            let is_sample = computed >= least_of_policy - tolerance(computed);
            return match (is_sample && computed.is_finite(), is_same) {
                (false, _) => Some(Implausible::Action { row, computed }),
                (true, false) => Some(Implausible::LogProbability { row, claimed, computed }),
                (true, true) => None,
            };
        }
        if !is_within(least - tolerance(least), claimed, most + tolerance(most)) {
            return Some(Implausible::OutOfRange { row, claimed, least, most });
        }
        // Any action may be far from the newest policy, which then gives it a weight of 0.
        (!computed.is_finite()).then_some(Implausible::Action { row, computed })
    })
}

/// Returns the largest plausible reward, return or advantage.
fn magnitude_limit(fragments: &[FragmentNumbers], value_moments: &RunningMoments) -> f64 {
    let known = match value_moments.count > 0.0 {
        true => value_moments.variance()[0].sqrt() + value_moments.mean[0].abs(),
        false => 0.0,
    };
    let mut magnitudes: Vec<f64> = fragments.iter().map(magnitude).collect();
    let scale = match magnitudes.len() {
        0 => known,
        count => known.max(*magnitudes.select_nth_unstable_by((count - 1) / 2, f64::total_cmp).1),
    };
    // Without any reward so far, nothing is known of their size.
    if scale > 0.0 { (SCALES_MAX * scale).min(MAGNITUDE_MAX) } else { MAGNITUDE_MAX }
}

/// Returns the largest absolute reward, return or advantage; infinite if one is not a number.
fn magnitude(fragment: &FragmentNumbers) -> f64 {
    let planes = [fragment.rewards, fragment.returns, fragment.advantages];
    let sizes = planes.into_iter().flatten().map(|x| if x.is_nan() { f64::INFINITY } else { f64::from(x.abs()) });
    sizes.fold(0.0, f64::max)
}

/// Returns the first reward, return or advantage beyond the limit.
fn magnitude_fault(fragment: &FragmentNumbers, limit: f64) -> Option<Implausible> {
    let planes =
        [("scaled reward", fragment.rewards), ("return", fragment.returns), ("advantage", fragment.advantages)];
    planes.into_iter().find_map(|(quantity, plane)| {
        let row = plane.iter().position(|x| x.is_nan() || f64::from(x.abs()) > limit)?;
        Some(Implausible::Magnitude { quantity, row, value: plane[row], limit })
    })
}

#[cfg(test)]
#[path = "plausibility_tests.rs"]
mod tests;
