//! Results of a sweep's trials, and of its settings.

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

use super::{
    goal::Goal,
    plan::{self, Plan, Trial},
};
use crate::commands::runs::record::Record;

/// Trial that has begun, with its results.
pub(crate) struct TrialResult {
    pub(crate) record: Record,
    /// What it reached; nothing if it failed or was pruned.
    pub(crate) reached: Option<f64>,
}

/// Setting with the results of its trials.
pub(crate) struct SettingResult {
    pub(crate) setting: usize,
    pub(crate) trials: Vec<usize>,
    /// What those of them reached that did.
    pub(crate) reached: Vec<f64>,
}

impl SettingResult {
    /// Returns the mean of what was reached.
    pub(crate) fn mean(&self) -> Option<f64> {
        (!self.reached.is_empty()).then(|| mean(&self.reached))
    }

    /// Returns the standard deviation of the sample.
    pub(crate) fn deviation(&self) -> Option<f64> {
        let mean = self.mean().filter(|_| self.reached.len() > 1)?;
        let squares: f64 = self.reached.iter().map(|value| (value - mean).powi(2)).sum();
        Some((squares / (self.reached.len() - 1) as f64).sqrt())
    }
}

/// Results of trials, each read once.
pub(crate) struct SweepResults {
    /// Folder of the sweep.
    pub(crate) root: PathBuf,
    pub(crate) goal: Goal,
    is_population: bool,
    trials: BTreeMap<usize, TrialResult>,
}

impl SweepResults {
    /// Reads the results of the trials that have ended.
    pub(crate) fn of_ended(root: &Path, plan: &Plan, goal: &Goal, is_population: bool) -> Self {
        let (root, goal) = (root.to_path_buf(), goal.clone());
        let mut results = Self { root, goal, is_population, trials: BTreeMap::new() };
        let ended = (0..plan.trials.len()).filter(|index| plan.trials[*index].exit.is_some());
        ended.for_each(|index| results.read(plan, index));
        results
    }

    /// Reads the results of a trial, if it has begun.
    pub(crate) fn read(&mut self, plan: &Plan, index: usize) {
        let run = plan::trial(&self.root, index);
        let Trial { exit, is_pruned, .. } = plan.trials[index];
        if let Ok(record) = Record::read(&run) {
            let reached = self.goal.reached(&run).filter(|_| !is_pruned && exit.is_none_or(|code| code == 0));
            self.trials.insert(index, TrialResult { record, reached });
        }
    }

    /// Returns the results of a trial.
    pub(crate) fn of(&self, index: usize) -> Option<&TrialResult> {
        self.trials.get(&index)
    }

    /// Returns the records of the trials that count, in their order. Those of a population that were replaced only led to
    /// others.
    pub(crate) fn counted(&self, plan: &Plan) -> Vec<(usize, &TrialResult)> {
        let living = if self.is_population { plan.living() } else { (0..plan.trials.len()).collect() };
        living.into_iter().filter_map(|index| Some((index, self.of(index)?))).collect()
    }

    /// Returns the settings, the best first: those that more trials reached, then by the mean.
    pub(crate) fn settings(&self, plan: &Plan) -> Vec<SettingResult> {
        let mut settings: BTreeMap<usize, SettingResult> = BTreeMap::new();
        for (index, TrialResult { reached, .. }) in self.counted(plan) {
            let setting = plan.trials[index].setting;
            let new = || SettingResult { setting, trials: Vec::new(), reached: Vec::new() };
            let found = settings.entry(setting).or_insert_with(new);
            found.trials.push(index);
            found.reached.extend(reached);
        }
        let mut settings: Vec<SettingResult> = settings.into_values().collect();
        settings.sort_by(|one, other| {
            let [one_missing, other_missing] = [one, other].map(|found| found.trials.len() - found.reached.len());
            let [one, other] = [one, other].map(|found| self.goal.order(found.mean()));
            one_missing.cmp(&other_missing).then(one.total_cmp(&other))
        });
        settings
    }

    /// Returns the best trial of the best setting.
    pub(crate) fn best(&self, plan: &Plan) -> Option<usize> {
        let order = |index: &usize| self.goal.order(self.of(*index).and_then(|found| found.reached));
        self.settings(plan).first()?.trials.iter().copied().min_by(|one, other| order(one).total_cmp(&order(other)))
    }
}

/// Returns the mean.
pub(crate) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_sorted_by_trials_that_reached_the_goal_and_their_mean() {
        let goal = Goal::read("highest rollout/ep_rew_mean").unwrap();
        let root = PathBuf::new();
        let mut results = SweepResults { root, goal, is_population: false, trials: BTreeMap::new() };
        let mut trials = Vec::new();
        for (index, (setting, reached)) in
            [(1, Some(9.0)), (1, None), (2, Some(1.0)), (2, Some(2.0)), (3, Some(3.0)), (3, Some(5.0))]
                .iter()
                .enumerate()
        {
            results.trials.insert(index, TrialResult { record: Record::default(), reached: *reached });
            trials.push(Trial { setting: *setting, exit: Some(0), ..Trial::default() });
        }
        let plan = Plan { trials, ..Plan::default() };
        let settings = results.settings(&plan);
        assert_eq!(settings.iter().map(|found| found.setting).collect::<Vec<_>>(), [3, 2, 1]);
        assert_eq!((settings[0].mean(), settings[0].deviation()), (Some(4.0), Some(2f64.sqrt())));
        assert_eq!((settings[2].deviation(), results.best(&plan)), (None, Some(5)));
    }
}
