//! Histograms of the actions and lags of a batch, for TensorBoard.

use treadmill_ppo::AcceptedFragment;

use super::tensorboard::Histogram;

/// Updates from one set of histograms to the next: they take a hundred times the room of a scalar.
pub const EVERY_UPDATES: u64 = 10;

/// Entries of an action with a histogram of their own; those beyond are in the one of all.
const NAMED_MAX: usize = 64;

/// Whether an update has histograms, the first of a run being number 1.
pub fn is_due(updates: u64) -> bool {
    updates % EVERY_UPDATES == 1
}

/// Histograms of a batch: of all entries of the actions, of each of them by its name, and of the policy lag. Actions are those that
/// the policy chose, before clipping, in units of the action's range; each transition counts with its fragment's lag.
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
