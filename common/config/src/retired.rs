//! Keys of earlier versions that no longer exist. Saved configurations may hold them: the old default is ignored with a
//! notice, because the program still behaves that way; any other value is refused. Of a key that tuned something which is
//! gone, every value is ignored.

use std::sync::atomic::{AtomicBool, Ordering};

use toml::Value;

use super::{ConfigError, parse_value};

/// Key that no longer exists.
struct Retired {
    key: &'static str,
    /// Its old default in TOML notation, which is how the program behaves now; `None` if every value is ignored.
    default: Option<&'static str>,
    /// What the program does now.
    now: &'static str,
    is_noticed: AtomicBool,
}

impl Retired {
    const fn new(key: &'static str, default: &'static str, now: &'static str) -> Self {
        Self { key, default: Some(default), now, is_noticed: AtomicBool::new(false) }
    }

    const fn with_any_value(key: &'static str, now: &'static str) -> Self {
        Self { key, default: None, now, is_noticed: AtomicBool::new(false) }
    }
}

static RETIRED: [Retired; 4] = [
    Retired::new("rollout.noise_correlation", "0.0", "exploration noise is drawn anew at each control step"),
    Retired::new("rollout.stale_versions", "[0, 0]", "an actor always acts by the newest policy that it has"),
    Retired::new(
        "ppo.off_policy",
        "\"decoupled\"",
        "lagging experience is always corrected by the decoupled objective",
    ),
    Retired::with_any_value(
        "env.solver_iterations",
        "contacts are solved in joint coordinates, without iterations to set",
    ),
];

/// Returns whether `key` existed in an earlier version and no longer does.
pub fn is_retired(key: &str) -> bool {
    RETIRED.iter().any(|retired| retired.key == key)
}

/// Returns whether `key` is retired and `value` can be ignored: it is the old default, or the key takes any value. Logs that
/// once per process.
///
/// # Errors
/// [`ConfigError::Retired`] if the value is another one.
pub(super) fn ignores(key: &str, value: &Value) -> Result<bool, ConfigError> {
    let Some(retired) = RETIRED.iter().find(|retired| retired.key == key) else { return Ok(false) };
    if let Some(default) = retired.default
        && !is_same(value, &parse_value(default).expect("defaults are TOML"))
    {
        let (key, value) = (key.to_string(), value.to_string());
        return Err(ConfigError::Retired { key, value, default, now: retired.now });
    }
    if !retired.is_noticed.swap(true, Ordering::Relaxed) {
        tracing::warn!(key, %value, now = retired.now, "ignored a retired config key");
    }
    Ok(true)
}

/// Compares whole and fractional numbers by value, as earlier versions did.
fn is_same(found: &Value, wanted: &Value) -> bool {
    let number = |value: &Value| value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64));
    match (found, wanted) {
        (Value::Array(found), Value::Array(wanted)) => {
            found.len() == wanted.len() && found.iter().zip(wanted).all(|(found, wanted)| is_same(found, wanted))
        }
        _ => found == wanted || number(found).is_some() && number(found) == number(wanted),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Config, ConfigSource, source::tests::set};

    #[test]
    fn old_defaults_are_ignored() {
        let saved = "[rollout]\nstale_versions = [0, 0]\nnoise_correlation = 0.0\n[ppo]\noff_policy = \"decoupled\"\n";
        let mut source = ConfigSource::default();
        source.text(saved, "saved").unwrap();
        assert_eq!(source.build().unwrap(), Config::default());
        for pair in ["rollout.noise_correlation=0", "rollout.stale_versions=[0.0, 0]", "ppo.off_policy=decoupled"] {
            assert_eq!(set(pair).unwrap(), Config::default(), "{pair}");
        }
    }

    #[test]
    fn every_value_of_a_key_without_meaning_is_ignored() {
        for value in ["1", "8", "\"many\"", "[1, 2]"] {
            let mut source = ConfigSource::default();
            source.text(&format!("[env]\nsolver_iterations = {value}\nsubsteps = 3\n"), "saved").unwrap();
            let config = source.build().unwrap();
            assert_eq!(config.env.substeps, 3);
            assert_eq!(set(&format!("env.solver_iterations={value}")).unwrap(), Config::default());
        }
    }

    #[test]
    fn other_values_are_refused_with_key_value_and_remedy() {
        assert_eq!(
            set("rollout.noise_correlation=0.5").unwrap_err().to_string(),
            "config key `rollout.noise_correlation` is 0.5, but the key no longer exists: exploration noise is drawn anew \
             at each control step, as with the old default 0.0; remove the key, or continue a run that needs it with the \
             version that began it"
        );
        for (pair, value) in [
            ("rollout.stale_versions=[0, 1]", "[0, 1]"),
            ("rollout.stale_versions=[0]", "[0]"),
            ("rollout.stale_versions=0", "0"),
            ("ppo.off_policy=v-trace", "\"v-trace\""),
            ("ppo.off_policy=uncorrected", "\"uncorrected\""),
            ("ppo.off_policy=nonsense", "\"nonsense\""),
            ("rollout.noise_correlation=true", "true"),
        ] {
            let (key, message) = (pair.split('=').next().unwrap(), set(pair).unwrap_err().to_string());
            assert!(
                message.contains(&format!("`{key}` is {value}, ")) && message.contains("remove the key"),
                "{message}"
            );
        }
    }

    #[test]
    fn no_retired_key_exists() {
        for retired in &RETIRED {
            assert!(is_retired(retired.key) && Config::keys().iter().all(|known| known.key != retired.key));
        }
        assert!(!is_retired("ppo.epochs"));
    }
}
