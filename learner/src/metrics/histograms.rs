//! Histograms of the actions and lags of a batch, for TensorBoard.

use treadmill_ppo::AcceptedFragment;

use super::tensorboard::Histogram;

/// Number of updates per set of histograms: they take a hundred times the space of a scalar.
pub const EVERY_UPDATES: u64 = 10;

/// Most entries of an action with separate histograms; only `actions/all` has the others.
const NAMED_MAX: usize = 64;

/// Returns the set of histograms that an update belongs to, of which only the first update that is logged has them. The
/// first update of a run is number 1.
pub fn set_of(updates: u64) -> u64 {
    updates.saturating_add(EVERY_UPDATES - 1) / EVERY_UPDATES
}

/// Computes the histograms of a batch: of all action entries together, of each by its name, and of the policy lag of
/// all transitions. Actions are taken before clipping, in units of the action's range.
pub fn of(batch: &[AcceptedFragment], names: &[String]) -> Vec<(String, Histogram)> {
    let all = batch.iter().flat_map(|accepted| accepted.fragment.actions.iter().copied());
    let mut histograms = vec![("actions/all".to_string(), Histogram::of(all))];
    let size = batch.first().map_or(0, |accepted| accepted.fragment.action_size as usize);
    for index in 0..size.min(NAMED_MAX) {
        let entries =
            batch.iter().flat_map(move |accepted| accepted.fragment.actions.iter().skip(index).step_by(size).copied());
        let name = names.get(index).cloned().unwrap_or_else(|| index.to_string());
        histograms.push((format!("actions/{name}"), Histogram::of(entries)));
    }
    let lags = batch.iter().map(|accepted| (accepted.lag, accepted.fragment.transitions() as u64));
    histograms.push(("bus/policy_lag".to_string(), Histogram::of_whole(lags)));
    histograms
}
