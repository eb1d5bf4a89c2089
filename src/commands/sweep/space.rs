//! Values that a key may take in a sweep.

use rand::RngExt;
use serde_json::json;
use toml::{Table, Value};
use treadmill_config::{ConfigSource, given_value};
use treadmill_runtime::seeds::Stream;

/// Kinds of ranges in a search file.
const KINDS: &str = "`uniform`, `log_uniform`, `integers` or `choices`";
/// Points of a range of real numbers in a grid, unless `points` says otherwise, and most of them.
const POINTS: usize = 3;
const POINTS_MAX: usize = 1000;
/// Factors of a perturbation (Jaderberg et al. 2017), and the probability that a key is drawn anew instead.
const FACTORS: [f64; 2] = [0.8, 1.25];
const RESAMPLED: f64 = 0.25;

/// Values of one key.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum KeyRange {
    /// Real numbers from the first to the second; in a grid, this many points.
    Uniform([f64; 2], usize),
    /// The same with a uniform logarithm.
    LogUniform([f64; 2], usize),
    /// Whole numbers from the first to the second, both included.
    Integers([i64; 2]),
    /// Listed values.
    Choices(Vec<Value>),
}

impl KeyRange {
    /// Returns whether a table is a range and not a section of keys.
    pub(crate) fn is_range(table: &Table) -> bool {
        ["uniform", "log_uniform", "integers", "choices", "points"].iter().any(|kind| table.contains_key(*kind))
    }

    /// Reads the range of `key`, and checks its ends or choices against the declared key.
    ///
    /// # Errors
    /// Everything that is wrong.
    pub(crate) fn read(key: &str, table: &Table) -> Result<Self, Vec<String>> {
        let refuse = |why: String| Err(vec![format!("`{key}` {why}")]);
        if key.starts_with("run.") {
            return refuse("belongs to the sweep; use --seeds, --steps and other flags instead".to_string());
        }
        let kinds: Vec<&String> = table.keys().filter(|name| *name != "points").collect();
        let [kind] = kinds[..] else { return refuse(format!("has {} ranges; give one of {KINDS}", kinds.len())) };
        let given = &table[kind];
        let points = match table.get("points").map_or(Some(POINTS as i64), Value::as_integer) {
            Some(points) if (2..=POINTS_MAX as i64).contains(&points) => points as usize,
            _ => return refuse(format!("has `points = {}`; allowed: 2 to {POINTS_MAX}", table["points"])),
        };
        let ends = |of: fn(&Value) -> Option<f64>| {
            let [low, high] = &given.as_array()?[..] else { return None };
            let ends = [of(low)?, of(high)?];
            (ends.iter().all(|end| end.is_finite()) && ends[0] < ends[1]).then_some(ends)
        };
        let real = |value: &Value| value.as_float().or(value.as_integer().map(|whole| whole as f64));
        let pair = |what: &str| refuse(format!("has `{kind} = {given}`; allowed: [smallest, largest], {what}"));
        let range = match kind.as_str() {
            "uniform" => match ends(real) {
                Some(ends) => Self::Uniform(ends, points),
                None => return pair("two numbers"),
            },
            "log_uniform" => match ends(real).filter(|ends| ends[0] > 0.0) {
                Some(ends) => Self::LogUniform(ends, points),
                None => return pair("two numbers above 0"),
            },
            "integers" => match ends(|value| value.as_integer().map(|whole| whole as f64)) {
                Some(ends) => Self::Integers(ends.map(|end| end as i64)),
                None => return pair("two whole numbers"),
            },
            "choices" => match given.as_array() {
                Some(choices) if !choices.is_empty() => Self::Choices(choices.clone()),
                _ => return refuse(format!("has `choices = {given}`; allowed: a list of values")),
            },
            other => return refuse(format!("has the range `{other}`; allowed: {KINDS}")),
        };
        let mut why: Vec<String> = range.samples().iter().filter_map(|value| objection(key, value)).collect();
        if !matches!(range, Self::Choices(_)) {
            why.truncate(1);
        }
        if why.is_empty() { Ok(range) } else { Err(why) }
    }

    /// Returns values of which all are allowed if those between them are.
    fn samples(&self) -> Vec<Value> {
        match self {
            // The middle would be a whole number too often to show that a key has only those.
            Self::Uniform([low, high], _) | Self::LogUniform([low, high], _) => {
                [*high, *low, low + (high - low) * 0.382].map(Value::Float).to_vec()
            }
            Self::Integers(ends) => ends.map(Value::Integer).to_vec(),
            Self::Choices(choices) => choices.clone(),
        }
    }

    /// Returns kind and values as a study has them: of choices the TOML notation, because lists are no values there.
    pub(crate) fn as_of_study(&self) -> (&'static str, serde_json::Value) {
        match self {
            Self::Uniform(ends, _) => ("uniform", json!(ends)),
            Self::LogUniform(ends, _) => ("log_uniform", json!(ends)),
            Self::Integers(ends) => ("integers", json!(ends)),
            Self::Choices(choices) => ("choices", choices.iter().map(Value::to_string).collect()),
        }
    }

    /// Returns a value that a study proposes, in TOML notation; nothing if it has another kind.
    pub(crate) fn proposed(&self, value: &serde_json::Value) -> Option<String> {
        match self {
            Self::Uniform(ends, _) | Self::LogUniform(ends, _) => Some(number(value.as_f64()?, ends)),
            Self::Integers(_) => Some(value.as_i64()?.to_string()),
            Self::Choices(_) => value.as_str().map(str::to_string),
        }
    }

    /// Returns the number of points in a grid.
    pub(crate) fn points(&self) -> usize {
        match self {
            Self::Uniform(_, points) | Self::LogUniform(_, points) => *points,
            Self::Integers([low, high]) => usize::try_from(high.saturating_sub(*low)).map_or(usize::MAX, |gap| gap + 1),
            Self::Choices(choices) => choices.len(),
        }
    }

    /// Returns a point of the grid, in TOML notation.
    pub(crate) fn point(&self, index: usize) -> String {
        let share = |points: &usize| index as f64 / (points - 1) as f64;
        match self {
            Self::Uniform(ends, points) => number(ends[0] + (ends[1] - ends[0]) * share(points), ends),
            Self::LogUniform(ends, points) => number(ends[0] * (ends[1] / ends[0]).powf(share(points)), ends),
            Self::Integers([low, _]) => (low + index as i64).to_string(),
            Self::Choices(choices) => choices[index].to_string(),
        }
    }

    /// Draws a value, in TOML notation.
    pub(crate) fn draw(&self, random: &mut Stream) -> String {
        match self {
            Self::Uniform(ends, _) => number(random.random_range(ends[0]..ends[1]), ends),
            Self::LogUniform(ends, _) => number(random.random_range(ends[0].ln()..ends[1].ln()).exp(), ends),
            Self::Integers([low, high]) => random.random_range(*low..=*high).to_string(),
            Self::Choices(choices) => choices[random.random_range(0..choices.len())].to_string(),
        }
    }

    /// Returns a value near `value`: a number times 0.8 or 1.25 within the range, or now and then one drawn anew.
    pub(crate) fn perturbed(&self, value: &str, random: &mut Stream) -> String {
        let factor = FACTORS[usize::from(random.random_bool(0.5))];
        if random.random_bool(RESAMPLED) {
            return self.draw(random);
        }
        match self {
            Self::Uniform(ends, _) | Self::LogUniform(ends, _) => {
                value.parse::<f64>().map_or_else(|_| value.to_string(), |old| number(old * factor, ends))
            }
            Self::Integers([low, high]) => value.parse::<i64>().map_or_else(
                |_| value.to_string(),
                |old| {
                    let new = (old as f64 * factor).round() as i64;
                    // A small number would stay as it is.
                    let new = if new == old { old.saturating_add(if factor > 1.0 { 1 } else { -1 }) } else { new };
                    new.clamp(*low, *high).to_string()
                },
            ),
            Self::Choices(_) => value.to_string(),
        }
    }
}

/// Returns why a declared key does not take a value, if so.
fn objection(key: &str, value: &Value) -> Option<String> {
    ConfigSource::default().value(key, value.clone()).err().map(|why| why.to_string())
}

/// Formats a number within a range with six significant digits, which is what a person reads in a table.
fn number(value: f64, [low, high]: &[f64; 2]) -> String {
    let short = format!("{value:.5e}").parse::<f64>().unwrap_or(value);
    Value::Float(short.clamp(*low, *high)).to_string()
}

/// Returns whether a text is the value of a key in another notation, such as `1` of `1.0`.
pub(crate) fn is_same(one: &str, other: &str) -> bool {
    let numbers = |text: &str| text.parse::<f64>().ok();
    one == other
        || numbers(one).is_some_and(|one| numbers(other) == Some(one))
        || given_value(one) == given_value(other)
}

#[cfg(test)]
mod tests {
    use treadmill_runtime::seeds;

    use super::*;

    fn range(key: &str, text: &str) -> Result<KeyRange, Vec<String>> {
        KeyRange::read(key, &text.parse().unwrap())
    }

    #[test]
    fn ranges_are_checked_against_declared_keys() {
        assert_eq!(range("ppo.gamma", "uniform = [0.9, 1]").unwrap(), KeyRange::Uniform([0.9, 1.0], POINTS));
        for (key, text, part) in [
            ("ppo.gama", "uniform = [0.9, 1]", "did you mean `ppo.gamma`?"),
            ("ppo.gamma", "uniform = [0.9, 1.5]", "`ppo.gamma` is 1.5; allowed: 0 to 1"),
            ("ppo.gamma", "uniform = [1, 0.9]", "[smallest, largest]"),
            ("ppo.gamma", "log_uniform = [0, 1]", "above 0"),
            ("ppo.epochs", "uniform = [2, 4]", "not a whole number"),
            ("ppo.epochs", "integers = [0, 4]", "`ppo.epochs` is 0"),
            ("ppo.gamma", "choices = []", "a list of values"),
            ("ppo.gamma", "choices = ['much']", "not a number"),
            ("ppo.gamma", "normal = [0, 1]", "`log_uniform`"),
            ("ppo.gamma", "points = 1\nuniform = [0.9, 1]", "2 to 1000"),
            ("run.seed", "integers = [0, 4]", "--seeds"),
        ] {
            let why = range(key, text).unwrap_err().join("; ");
            assert!(why.contains(part), "{key} {text}: {why}");
        }
    }

    #[test]
    fn grids_have_their_ends_and_draws_stay_within() {
        let rate = range("ppo.learning_rate", "log_uniform = [1e-5, 1e-3]").unwrap();
        assert_eq!(
            [0, 1, 2].map(|index| rate.point(index)),
            ["1e-5", "0.0001", "0.001"].map(|text| { Value::Float(text.parse().unwrap()).to_string() })
        );
        let epochs = range("ppo.epochs", "integers = [2, 4]").unwrap();
        assert_eq!((epochs.points(), epochs.point(2)), (3, "4".to_string()));
        let mut random = seeds::stream(1, "test", &[]);
        let draws: Vec<f64> = (0..1000).map(|_| rate.draw(&mut random).parse().unwrap()).collect();
        assert!(draws.iter().all(|value| (1e-5..=1e-3).contains(value)));
        let low = draws.iter().filter(|value| **value < 1e-4).count();
        assert!((450..550).contains(&low), "half of them below the middle of the logarithm: {low}");
    }

    #[test]
    fn a_study_gets_ranges_and_proposes_values() {
        for (key, text, kind, values, proposed, text_of_it) in [
            ("ppo.gamma", "uniform = [0.9, 1]", "uniform", json!([0.9, 1.0]), json!(0.912_345_678), "0.912346"),
            ("ppo.learning_rate", "log_uniform = [0.1, 1]", "log_uniform", json!([0.1, 1.0]), json!(1), "1.0"),
            ("ppo.epochs", "integers = [2, 4]", "integers", json!([2, 4]), json!(3), "3"),
            (
                "policy.hidden",
                "choices = [[8], [8, 4]]",
                "choices",
                json!(["[8]", "[8, 4]"]),
                json!("[8, 4]"),
                "[8, 4]",
            ),
        ] {
            let range = range(key, text).unwrap();
            assert_eq!(range.as_of_study(), (kind, values), "{key}");
            assert_eq!(range.proposed(&proposed), Some(text_of_it.to_string()), "{key}");
            assert_eq!(range.proposed(&json!(null)), None, "{key}");
        }
    }

    #[test]
    fn perturbed_numbers_move_by_a_factor_or_are_drawn_anew() {
        let rate = range("ppo.learning_rate", "uniform = [1e-5, 1e-3]").unwrap();
        let epochs = range("ppo.epochs", "integers = [2, 4]").unwrap();
        let mut random = seeds::stream(1, "test", &[]);
        let moved = (0..1000).filter(|_| {
            let new = rate.perturbed("0.0004", &mut random);
            ["0.00032", "0.0005"].iter().any(|factor| is_same(factor, &new))
        });
        let moved = moved.count();
        assert!((700..800).contains(&moved), "{moved}");
        for _ in 0..100 {
            let new: i64 = epochs.perturbed("3", &mut random).parse().unwrap();
            assert!((2..=4).contains(&new), "{new}");
        }
    }
}
