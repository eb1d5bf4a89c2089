//! Population: after each interval the worst trials fork the best ones with perturbed keys (Jaderberg et al. 2017).

use std::{fs, io};

use anyhow::Context;
use rand::RngExt;
use treadmill_runtime::{run_folder::RunFolder, seeds};

use super::{
    goal::Goal,
    plan::{Plan, SweepFolder, Trial},
    search::{SweepSearch, TRIALS_MAX},
    trials::{forked, reached},
};

/// Share of the population that is replaced, as a divisor: a fifth, and at least one.
const REPLACED: usize = 5;

/// Returns the environment steps after the interval with this number, which counts from 1.
pub(crate) fn boundary(interval: u64, interval_steps: u64, steps: u64) -> u64 {
    interval.saturating_mul(interval_steps).min(steps)
}

/// Lets the worst members fork the best ones: adds trials to the plan, with the states that they begin from. Returns the
/// trials that have ended by that. The same results give the same forks.
///
/// # Errors
/// If a state cannot be kept.
pub(crate) fn evolve(
    folder: &SweepFolder,
    plan: &mut Plan,
    search: &SweepSearch,
    goal: &Goal,
    next_boundary: u64,
) -> anyhow::Result<Vec<usize>> {
    let mut ranked = plan.living();
    let order = |index: &usize| {
        let has_failed = plan.trials[*index].exit.is_some_and(|code| code != 0);
        (has_failed, goal.order(goal.reached(&folder.trial(*index))))
    };
    // The sort is stable, so that equal results keep the order of the members.
    ranked.sort_by(|one, other| {
        let ((one_failed, one), (other_failed, other)) = (order(one), order(other));
        one_failed.cmp(&other_failed).then(one.total_cmp(&other))
    });
    let count = (ranked.len() / REPLACED).max(1).min(ranked.len() / 2);
    let can_fork = |index: &&usize| {
        let steps = reached(&folder.trial(**index));
        plan.trials[**index].exit.is_none_or(|code| code == 0) && (1..next_boundary).contains(&steps)
    };
    let best: Vec<usize> = ranked[..count].iter().filter(can_fork).copied().collect();
    let mut replaced = Vec::new();
    for worst in ranked[ranked.len() - count..].iter().copied() {
        if best.is_empty() || plan.trials.len() >= TRIALS_MAX {
            break;
        }
        let mut random = seeds::stream(plan.seed, "sweep fork", &[plan.intervals, worst as u64]);
        let parent = best[random.random_range(0..best.len())];
        let perturbed = |(key, value): &(String, String)| {
            let range = search.keys.iter().find(|(name, _)| name == key).map(|(_, range)| range);
            (key.clone(), range.map_or_else(|| value.clone(), |range| range.perturbed(value, &mut random)))
        };
        let keys = plan.trials[parent].keys.iter().map(perturbed).collect();
        let index = plan.trials.len();
        keep_state(folder, parent, index)?;
        let steps = reached(&folder.trial(parent));
        let (seed, setting) = (plan.seed.saturating_add(index as u64), plan.trials[worst].setting);
        if plan.trials[worst].exit.is_none() {
            plan.trials[worst].exit = Some(0);
            replaced.push(worst);
        }
        plan.trials.push(Trial { seed, setting, keys, parent: Some((parent, steps)), ..Trial::default() });
    }
    Ok(replaced)
}

/// Keeps the latest checkpoint of a trial for the one that forks it, because the first one goes on meanwhile.
fn keep_state(folder: &SweepFolder, parent: usize, index: usize) -> anyhow::Result<()> {
    let from = RunFolder::open(&folder.trial(parent).display().to_string())?.checkpoints().join("latest.bundle");
    let to = forked(folder, index).join("checkpoints");
    let keep = || -> io::Result<()> {
        fs::create_dir_all(&to)?;
        let to = to.join("latest.bundle");
        match fs::remove_file(&to) {
            Err(why) if why.kind() != io::ErrorKind::NotFound => return Err(why),
            _ => {}
        }
        // Checkpoints are replaced, never changed, so that a second name keeps this one.
        fs::hard_link(&from, &to).or_else(|_| fs::copy(&from, &to).map(drop))
    };
    keep().with_context(|| format!("the checkpoint `{}` cannot be kept for a fork", from.display()))
}

/// Removes the state that a trial began from, once it has checkpoints of its own.
pub(crate) fn forget_state(folder: &SweepFolder, index: usize) {
    if RunFolder::has_checkpoint(&folder.trial(index)) {
        // What cannot be removed is only left over.
        let _ = fs::remove_dir_all(forked(folder, index));
    }
}
