//! Study of Optuna: the next setting once its trials can begin, what the trials report, and which are hopeless.

use std::{collections::BTreeMap, ops::Range};

use anyhow::Context;
use serde_json::{Value, json};

use super::{
    followed_log::FollowedLog,
    goal::Goal,
    plan::{Plan, SweepFolder},
    proposer::Proposer,
    results::mean,
    search::{Setting, Strategy, SweepSearch},
    space::KeyRange,
};

/// Values that a trial reports.
const REPORTS: u64 = 50;

/// Settings of a study, which are its trials: each has the mean over its seeds.
pub(crate) struct Study<'a> {
    proposer: Proposer,
    folder: &'a SweepFolder,
    search: &'a SweepSearch,
    goal: &'a Goal,
    active: Vec<ActiveSetting>,
}

/// Setting with trials that go on.
struct ActiveSetting {
    /// Number in the study, from 0 on.
    number: usize,
    /// Environment steps of the last report.
    reported: u64,
    /// Logs of its trials.
    logs: Vec<FollowedLog>,
}

impl<'a> Study<'a> {
    /// Creates the study of a sweep, or opens it.
    ///
    /// # Errors
    /// If the database refuses, or does not fit the plan.
    pub(crate) fn open(
        proposer: Proposer,
        folder: &'a SweepFolder,
        plan: &Plan,
        is_new: bool,
        search: &'a SweepSearch,
        goal: &'a Goal,
    ) -> anyhow::Result<Self> {
        let Strategy::Optuna { sampler, pruner } = search.strategy else { anyhow::bail!("no strategy of Optuna") };
        let name = &plan.study;
        let own = || format!("sqlite:///{}", folder.root().join("study.db").display());
        let storage = plan.storage.clone().unwrap_or_else(own);
        let begun = plan.trials.len() / search.seeds;
        let keys = search.keys.iter().map(|(key, range)| {
            let (kind, values) = range.as_of_study();
            json!([key, kind, values])
        });
        let request = json!({
            "call": "open", "storage": storage, "name": name, "trials": (!is_new).then_some(begun),
            "direction": goal.direction(), "strategy": sampler, "pruner": pruner, "seed": plan.seed, "steps": plan.steps,
            "keys": keys.collect::<Vec<_>>(),
        });
        let mut study = Self { proposer, folder, search, goal, active: Vec::new() };
        let opened = study.proposer.call(&request);
        let opened = opened.with_context(|| format!("the study `{name}` cannot be opened at `{storage}`"))?;
        let open: Vec<(usize, u64)> = serde_json::from_value(opened["begun"].clone())?;
        let is_unfinished = |number: usize| plan.trials[number * search.seeds].exit.is_none();
        if let Some(lost) = (0..begun).find(|number| is_unfinished(*number) && !open.iter().any(|(it, _)| it == number))
        {
            anyhow::bail!("trial {lost} of the study `{name}` has ended by another program; begin a new sweep");
        }
        // One that is not in the plan is asked for again.
        for (number, reported) in open.into_iter().filter(|(number, _)| *number < begun) {
            study.add(number, reported);
            study.end(plan, number)?;
        }
        Ok(study)
    }

    /// Returns how many trials are still to be proposed.
    pub(crate) fn left(&self, plan: &Plan) -> usize {
        (self.search.settings * self.search.seeds).saturating_sub(plan.trials.len())
    }

    /// Returns whether the trials of one more setting fit beside `running` others.
    pub(crate) fn has_next(&self, plan: &Plan, running: usize) -> bool {
        self.left(plan) > 0 && (running == 0 || running + self.search.seeds <= plan.parallel)
    }

    /// Adds the trials of the next setting to the plan.
    ///
    /// # Errors
    /// If Optuna fails, or the folder cannot be written.
    pub(crate) fn ask(&mut self, plan: &mut Plan) -> anyhow::Result<Range<usize>> {
        let number = plan.trials.len() / self.search.seeds;
        let answer = request(&mut self.proposer, &json!({"call": "ask", "trial": number}))?;
        let value = |(index, (key, range)): (usize, &(String, KeyRange))| {
            Some((key.clone(), range.proposed(&answer["values"][index])?))
        };
        let setting: Option<Setting> = self.search.keys.iter().enumerate().map(value).collect();
        plan.add(number, &setting.with_context(|| format!("{answer} has no value for each key"))?, self.search);
        self.folder.save(plan)?;
        self.add(number, 0);
        Ok(self.trials(number))
    }

    /// Reports what the trials have logged. Returns those that are hopeless, but not the one that has just `ended`.
    ///
    /// # Errors
    /// If a log cannot be read, Optuna fails, or the folder cannot be written.
    pub(crate) fn follow(&mut self, plan: &mut Plan, ended: Option<usize>) -> anyhow::Result<Vec<usize>> {
        let (interval, seeds, mut hopeless) = ((plan.steps / REPORTS).max(1), self.search.seeds, Vec::new());
        for setting in &mut self.active {
            let trials = setting.number * seeds..(setting.number + 1) * seeds;
            setting.logs.iter_mut().try_for_each(|log| log.read(self.goal)).context("a log cannot be read")?;
            let step = setting.logs.iter().map(|log| log.step).min().unwrap_or_default();
            let has_end = self.goal.is_value() || !setting.logs.iter().all(FollowedLog::has_reached);
            let is_pruned = |plan: &Plan| plan.trials[trials.clone()].iter().any(|trial| trial.is_pruned);
            while !is_pruned(plan) && setting.reported + interval < plan.steps.min(step) {
                setting.reported += interval;
                let values: Option<Vec<f64>> = setting.logs.iter().map(|log| log.at(setting.reported)).collect();
                let Some(values) = values else { continue };
                let report = json!({
                    "call": "report", "trial": setting.number, "step": setting.reported, "value": mean(&values),
                });
                let answer = request(&mut self.proposer, &report)?;
                if answer["prune"] != true || !has_end {
                    continue;
                }
                // One that has all its steps only reports, because others are compared with it.
                for (index, log) in trials.clone().zip(&setting.logs) {
                    let trial = &mut plan.trials[index];
                    trial.is_pruned = trial.exit.is_none() && ended != Some(index) && log.step < plan.steps;
                    hopeless.extend(trial.is_pruned.then_some(index));
                }
            }
        }
        if !hopeless.is_empty() {
            self.folder.save(plan)?;
        }
        Ok(hopeless)
    }

    /// Records the result of a setting once its last trial has ended.
    ///
    /// # Errors
    /// If Optuna fails.
    pub(crate) fn end(&mut self, plan: &Plan, number: usize) -> anyhow::Result<()> {
        let trials = &plan.trials[self.trials(number)];
        if trials.iter().any(|trial| trial.exit.is_none()) {
            return Ok(());
        }
        let reached: Option<Vec<f64>> =
            self.trials(number).map(|index| self.goal.reached(&self.folder.trial(index))).collect();
        let (state, value) = match reached {
            _ if trials.iter().any(|trial| trial.is_pruned) => ("PRUNED", None),
            _ if trials.iter().any(|trial| trial.exit != Some(0)) => ("FAIL", None),
            Some(reached) => ("COMPLETE", Some(mean(&reached))),
            // Samplers rank it by what it misses.
            None => ("PRUNED", None),
        };
        request(&mut self.proposer, &json!({"call": "end", "trial": number, "state": state, "value": value}))?;
        self.active.retain(|setting| setting.number != number);
        Ok(())
    }

    /// Returns the importance of each key by PED-ANOVA; of none before two settings are complete.
    ///
    /// # Errors
    /// If Optuna fails.
    pub(crate) fn importance(&mut self) -> anyhow::Result<BTreeMap<String, f64>> {
        let answer = request(&mut self.proposer, &json!({"call": "importance"}))?;
        Ok(serde_json::from_value(answer["importance"].clone())?)
    }

    /// Returns the trials of a setting.
    fn trials(&self, number: usize) -> Range<usize> {
        number * self.search.seeds..(number + 1) * self.search.seeds
    }

    /// Follows the trials of a setting.
    fn add(&mut self, number: usize, reported: u64) {
        let logs = self.trials(number).map(|index| FollowedLog::of(&self.folder.trial(index))).collect();
        self.active.push(ActiveSetting { number, reported, logs });
    }
}

fn request(proposer: &mut Proposer, request: &Value) -> anyhow::Result<Value> {
    proposer.call(request).context("the study failed; go on with `treadmill sweep --resume`")
}
