//! Search file of a sweep: strategy, goal and ranges of keys.

use toml::{Table, Value};
use treadmill_runtime::{numbers::parse_count, seeds, words::nearest};

use super::{goal::Goal, plan::Plan, space::KeyRange};
use crate::launch::exit_code::Usage;

/// Most trials of a sweep.
pub(crate) const TRIALS_MAX: usize = 10_000;
/// Smallest population, of which one forks another.
const POPULATION_MIN: usize = 2;
/// Settings of a random search, and members of a population, by default.
const TRIALS: usize = 8;
const POPULATION: usize = 5;
/// Keys beside those of `[env]` that a fork cannot change.
const FORK_KEEPS: [&str; 7] = [
    "policy.hidden",
    "policy.init_log_std",
    "ppo.symmetry",
    "velocity.history",
    "velocity.height_scan",
    "motion.future_steps",
    "motion.state_estimation",
];
/// Entries of a search file.
const ENTRIES: [&str; 7] = ["strategy", "pruner", "trials", "seeds", "goal", "interval_steps", "keys"];
/// Samplers and pruners of Optuna.
const SAMPLERS: [&str; 3] = ["tpe", "cmaes", "random"];
const PRUNERS: [&str; 3] = ["none", "median", "hyperband"];

/// How the settings of trials are chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Strategy {
    /// The same settings with several seeds.
    Seeds,
    /// All combinations.
    Grid,
    /// Drawn from the ranges.
    Random,
    /// The worst fork the best every so many steps.
    Population { interval_steps: u64 },
    /// Proposed by Optuna, which ends hopeless ones.
    Optuna { sampler: &'static str, pruner: &'static str },
}

/// Value of each searched key, in TOML notation.
pub(crate) type Setting = Vec<(String, String)>;

/// What is searched.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SweepSearch {
    pub(crate) strategy: Strategy,
    /// Settings to try, or members of the population.
    pub(crate) settings: usize,
    /// Seeds of each setting.
    pub(crate) seeds: usize,
    pub(crate) goal: Option<Goal>,
    pub(crate) keys: Vec<(String, KeyRange)>,
}

impl SweepSearch {
    /// Returns the search without a file.
    ///
    /// # Errors
    /// If there are too many seeds.
    pub(crate) fn of_seeds(seeds: usize) -> Result<Self, Usage> {
        let search = Self { strategy: Strategy::Seeds, settings: 1, seeds, goal: None, keys: Vec::new() };
        search.check_size().map(|()| search).map_err(Usage)
    }

    /// Reads the text of a file, in which flags replace `trials` and `seeds`; `origin` names it in errors.
    ///
    /// # Errors
    /// All entries that are wrong.
    pub(crate) fn read(text: &str, origin: &str, trials: Option<usize>, seeds: Option<usize>) -> Result<Self, Usage> {
        let table: Table = text.parse().map_err(|why| Usage(format!("`{origin}` is not valid TOML: {why}")))?;
        let mut wrong = Vec::new();
        for name in table.keys().filter(|name| !ENTRIES.contains(&name.as_str())) {
            let near = nearest(name, ENTRIES).map(|near| format!("did you mean `{near}`? ")).unwrap_or_default();
            wrong.push(format!("unknown entry `{name}`; {near}allowed: {}", ENTRIES.join(", ")));
        }
        let in_file = ["trials", "seeds", "interval_steps"].map(|name| {
            let value = table.get(name)?;
            let whole = value.as_integer().and_then(|count| u64::try_from(count).ok());
            let count = whole.or_else(|| parse_count(value.as_str()?).ok()).filter(|count| *count > 0);
            if count.is_none() {
                wrong.push(format!("`{name}` is {value}; allowed: a whole number from 1 on"));
            }
            count
        });
        let size = |count: Option<u64>| count.map(|count| usize::try_from(count).unwrap_or(usize::MAX));
        let (trials, seeds, interval_steps) = (trials.or(size(in_file[0])), seeds.or(size(in_file[1])), in_file[2]);
        let mut keys = Vec::new();
        match table.get("keys") {
            Some(Value::Table(entries)) => collect("", entries, &mut keys, &mut wrong),
            Some(other) => wrong.push(format!("`keys` is {other}; allowed: a table of keys")),
            None => {}
        }
        let goal = table.get("goal").map(|goal| Goal::read(goal.as_str().unwrap_or(&goal.to_string())));
        let goal = goal.transpose().unwrap_or_else(|why| {
            wrong.push(why);
            None
        });
        let pruner = table.get("pruner").map_or(Some("none"), Value::as_str);
        let pruner = PRUNERS.into_iter().find(|name| pruner == Some(name)).unwrap_or_else(|| {
            wrong.push(format!("`pruner` is {}; allowed: \"none\", \"median\" or \"hyperband\"", table["pruner"]));
            "none"
        });
        let named = table.get("strategy").map_or(Some("random"), Value::as_str);
        let (strategy, settings) = match named {
            Some("seeds") => (Strategy::Seeds, 1),
            Some("grid") => {
                let product = keys.iter().try_fold(1usize, |all, (_, range)| all.checked_mul(range.points()));
                (Strategy::Grid, product.unwrap_or(usize::MAX))
            }
            Some("random") if pruner == "none" => (Strategy::Random, trials.unwrap_or(TRIALS)),
            Some("population") => {
                if interval_steps.is_none() {
                    wrong.push("`interval_steps` is missing; a population forks after each of them".to_string());
                }
                let interval_steps = interval_steps.unwrap_or(1);
                (Strategy::Population { interval_steps }, trials.unwrap_or(POPULATION))
            }
            _ => match SAMPLERS.into_iter().find(|name| named == Some(name)) {
                Some(sampler) => (Strategy::Optuna { sampler, pruner }, trials.unwrap_or(TRIALS)),
                None => {
                    let allowed = "\"seeds\", \"grid\", \"random\", \"population\", \"tpe\" or \"cmaes\"";
                    wrong.push(format!("`strategy` is {}; allowed: {allowed}", table["strategy"]));
                    (Strategy::Random, 1)
                }
            },
        };
        let search = Self { strategy, settings, seeds: seeds.unwrap_or(1), goal, keys };
        if wrong.is_empty() {
            let has_trials = table.contains_key("trials") || trials.is_some();
            wrong.extend(search.objections(has_trials, table.contains_key("interval_steps"), pruner != "none"));
        }
        match wrong.len() {
            0 => Ok(search),
            1 => Err(Usage(format!("`{origin}`: {}", wrong[0]))),
            many => Err(Usage(format!("`{origin}` has {many} wrong entries: {}", wrong.join("; ")))),
        }
    }

    /// Returns entries that contradict the strategy.
    fn objections(&self, has_trials: bool, has_interval: bool, has_pruner: bool) -> Vec<String> {
        let mut wrong = Vec::new();
        let mut refuse = |is_wrong: bool, why: &str| wrong.extend(is_wrong.then(|| why.to_string()));
        let is_population = self.interval_steps().is_some();
        match self.strategy {
            Strategy::Seeds => {
                refuse(!self.keys.is_empty(), "strategy \"seeds\" has no `keys`; use \"grid\" or \"random\"")
            }
            _ => refuse(self.keys.is_empty(), "`keys` is missing; name keys with ranges, or use strategy \"seeds\""),
        }
        let is_fixed = matches!(self.strategy, Strategy::Seeds | Strategy::Grid);
        refuse(is_fixed && has_trials, "the strategy sets the number of trials; leave `trials` out");
        refuse(!is_population && has_interval, "only strategy \"population\" has `interval_steps`; leave it out");
        let prunes = self.sampler().is_some();
        refuse(has_pruner && !prunes, "only \"tpe\", \"cmaes\" and \"random\" have a `pruner`; leave it out");
        refuse(is_population && self.seeds > 1, "each member of a population has a seed of its own; leave `seeds` out");
        let kept = |key: &str| key.starts_with("env.") || FORK_KEEPS.contains(&key);
        let keeps = self.keys.iter().map(|(key, _)| key.as_str()).find(|key| is_population && kept(key));
        if let Some(key) = keeps {
            refuse(
                true,
                &format!(
                    "`{key}` decides networks, observations or robot, which a fork keeps; search it by \"random\""
                ),
            );
        }
        refuse(is_population && self.settings < POPULATION_MIN, "a population has at least 2 `trials`");
        let compares = self.goal.as_ref().is_none_or(Goal::is_value);
        refuse(is_population && !compares, "a population compares values; its `goal` begins with highest or lowest");
        wrong.extend(self.check_size().err());
        wrong
    }

    /// Returns the environment steps between forks of a population.
    pub(crate) fn interval_steps(&self) -> Option<u64> {
        match self.strategy {
            Strategy::Population { interval_steps } => Some(interval_steps),
            _ => None,
        }
    }

    /// Returns Optuna's sampler, if it proposes the settings.
    pub(crate) fn sampler(&self) -> Option<&'static str> {
        match self.strategy {
            Strategy::Optuna { sampler, .. } => Some(sampler),
            _ => None,
        }
    }

    /// Returns how many trials a sweep has, or will have.
    pub(crate) fn count(&self, plan: &Plan) -> usize {
        plan.trials.len().max(self.settings.saturating_mul(self.seeds))
    }

    fn check_size(&self) -> Result<(), String> {
        match self.settings.saturating_mul(self.seeds) {
            0 => Err("the sweep has no trial; use at least 1 seed".to_string()),
            1..=TRIALS_MAX => Ok(()),
            _ => Err(format!(
                "the sweep has {} settings with {} seeds; allowed: {TRIALS_MAX} trials; use fewer points or \"random\"",
                self.settings, self.seeds
            )),
        }
    }

    /// Returns the settings to begin with. The same seed gives the same ones, and each key has its own stream.
    pub(crate) fn settings(&self, seed: u64) -> Vec<Setting> {
        let setting = |index: usize| -> Setting {
            let mut rest = index;
            let value = |(key, range): &(String, KeyRange)| {
                let value = match self.strategy {
                    Strategy::Grid => {
                        let point = rest % range.points();
                        rest /= range.points();
                        range.point(point)
                    }
                    _ => range.draw(&mut seeds::stream(seed, &format!("sweep {key}"), &[index as u64])),
                };
                (key.clone(), value)
            };
            self.keys.iter().map(value).collect()
        };
        (0..self.settings).map(setting).collect()
    }
}

/// Collects the ranges of a table, whose names continue `section`.
fn collect(section: &str, entries: &Table, keys: &mut Vec<(String, KeyRange)>, wrong: &mut Vec<String>) {
    for (name, value) in entries {
        let key = if section.is_empty() { name.clone() } else { format!("{section}.{name}") };
        match value {
            // Keys have a section.
            Value::Table(table) if key.contains('.') || KeyRange::is_range(table) => {
                match KeyRange::read(&key, table) {
                    Ok(range) => keys.push((key, range)),
                    Err(why) => wrong.extend(why),
                }
            }
            Value::Table(table) => collect(&key, table, keys, wrong),
            other => wrong.push(format!("`{key}` is {other}; allowed: a range, as in {{ uniform = [0.1, 0.5] }}")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<SweepSearch, String> {
        SweepSearch::read(text, "s.toml", None, None).map_err(|why| why.to_string())
    }

    #[test]
    fn a_grid_has_all_combinations_and_draws_repeat() {
        let keys = "keys.ppo.epochs = { integers = [2, 3] }\n\"keys\".\"ppo\".gamma = { choices = [0.9, 1] }\n";
        let grid = read(&format!("strategy = 'grid'\nseeds = 2\n{keys}")).unwrap();
        let settings = grid.settings(1);
        let shown: Vec<String> = settings.iter().map(|keys| format!("{} {}", keys[0].1, keys[1].1)).collect();
        assert_eq!((shown, grid.seeds), (["2 0.9", "3 0.9", "2 1", "3 1"].map(String::from).to_vec(), 2));
        let range = "keys.ppo.learning_rate = { log_uniform = [1e-5, 1e-3] }";
        let (few, many) =
            (read(&format!("trials = 2\n{range}")).unwrap(), read(&format!("trials = 9\n{range}")).unwrap());
        assert_eq!(many.settings(7)[..2], few.settings(7)[..], "more trials keep the first ones");
        assert_ne!(few.settings(7), few.settings(8));
    }

    #[test]
    fn all_wrong_entries_are_named_at_once() {
        let why = read(
            "stratgy = 'grid'\ntrials = 0\ngoal = 'far'\n[keys]\nppo.gama = { uniform = [0.9, 1] }\nppo.epochs = 3\n\
             ppo.gamma = { uniform = [0.9, 2] }",
        )
        .unwrap_err();
        for part in [
            "has 6 wrong entries",
            "did you mean `strategy`?",
            "`trials` is 0",
            "`goal` is \"far\"",
            "did you mean `ppo.gamma`?",
            "`ppo.epochs` is 3",
            "`ppo.gamma` is 2.0; allowed: 0 to 1",
        ] {
            assert!(why.contains(part), "{part} in {why}");
        }
    }

    #[test]
    fn entries_fit_the_strategy() {
        let key = "keys.ppo.gamma = { uniform = [0.9, 1] }";
        for (text, strategy) in [
            ("pruner = 'none'", Strategy::Random),
            ("pruner = 'median'", Strategy::Optuna { sampler: "random", pruner: "median" }),
            ("strategy = 'cmaes'", Strategy::Optuna { sampler: "cmaes", pruner: "none" }),
        ] {
            assert_eq!(read(&format!("{text}\n{key}")).unwrap().strategy, strategy, "{text}");
        }
        for (text, part) in [
            ("strategy = 'annealing'".to_string(), "\"population\""),
            (format!("strategy = 'tpe'\npruner = 'halving'\n{key}"), "`pruner` is \"halving\""),
            (format!("strategy = 'grid'\npruner = 'median'\n{key}"), "have a `pruner`; leave it out"),
            ("strategy = 'random'".to_string(), "`keys` is missing"),
            (format!("strategy = 'seeds'\n{key}"), "no `keys`"),
            (format!("strategy = 'grid'\ntrials = 4\n{key}"), "leave `trials` out"),
            (format!("strategy = 'random'\ninterval_steps = 4\n{key}"), "only strategy \"population\""),
            (format!("strategy = 'population'\n{key}"), "`interval_steps` is missing"),
            (format!("strategy = 'population'\ninterval_steps = '1M'\ntrials = 1\n{key}"), "at least 2"),
            (format!("trials = 20000\n{key}"), "10000 trials"),
            ("strategy".to_string(), "not valid TOML"),
        ] {
            let why = read(&text).unwrap_err();
            assert!(why.contains(part), "{text}: {why}");
        }
    }
}
