//! First stage: merges the tables that the user gives and checks each name and type.

use std::path::Path;

use toml::{Table, Value};
use treadmill_runtime::numbers::parse_count;
use treadmill_settings::Value as _;

use super::{
    Config, ConfigError, KeyDoc, parse_value, preset,
    unknown_key::{section_of, unknown},
};

/// Collects configuration; later sources override earlier ones.
#[derive(Clone, Debug, Default)]
pub struct ConfigSource {
    table: Table,
}

impl ConfigSource {
    /// Adds a preset.
    pub fn preset(&mut self, name: &str) -> Result<(), ConfigError> {
        self.text(preset(name)?, &format!("preset {name}"))
    }

    /// Adds a TOML file.
    pub fn file(&mut self, path: &Path) -> Result<(), ConfigError> {
        let shown = path.display().to_string();
        let text = std::fs::read_to_string(path)
            .map_err(|error| ConfigError::File { path: shown.clone(), why: error.to_string() })?;
        self.text(&text, &format!("config file `{shown}`"))
    }

    /// Adds TOML text; `origin` names it in errors.
    ///
    /// # Errors
    /// All entries that are wrong, each with its key.
    pub fn text(&mut self, text: &str, origin: &str) -> Result<(), ConfigError> {
        let table = parse(text, origin)?;
        let keys = Config::keys();
        let mut errors = Vec::new();
        for (section, value) in table {
            match value {
                Value::Table(entries)
                    if !entries.is_empty() || keys.iter().any(|known| section_of(known) == section) =>
                {
                    let put = |(name, value)| self.put(&format!("{section}.{name}"), value, &keys).err();
                    errors.extend(entries.into_iter().filter_map(put));
                }
                _ => errors.push(unknown(&section, &keys)),
            }
        }
        match errors.len() {
            0 => Ok(()),
            1 => Err(errors.remove(0)),
            _ => Err(ConfigError::Several { origin: origin.to_string(), errors }),
        }
    }

    /// Adds those keys of a run's configuration for which `is_needed` returns true. Another version of this program may
    /// have written it: keys and sections that do not exist here are ignored. Returns the names of these keys.
    ///
    /// # Errors
    /// If the text is not TOML, or the value of a needed key is not allowed here.
    pub fn text_of_run(
        &mut self,
        text: &str,
        origin: &str,
        is_needed: impl Fn(&str) -> bool,
    ) -> Result<Vec<String>, ConfigError> {
        let keys = Config::keys();
        let mut unknown = Vec::new();
        for (section, value) in parse(text, origin)? {
            let entries = match value {
                Value::Table(entries) => entries,
                value if keys.iter().any(|known| section_of(known) == section) => {
                    let (value, allowed) = (value.to_string(), "keys of this section".to_string());
                    return Err(ConfigError::Type { key: section, value, notation: "a table", allowed });
                }
                _ => {
                    unknown.push(section);
                    continue;
                }
            };
            for (name, value) in entries {
                let key = format!("{section}.{name}");
                match keys.iter().any(|known| known.key == key) {
                    false => unknown.push(key),
                    true if is_needed(&key) => self.put(&key, value, &keys)?,
                    true => {}
                }
            }
        }
        Ok(unknown)
    }

    /// Adds one `key=value`; a value that is not TOML is a string.
    pub fn set(&mut self, pair: &str) -> Result<(), ConfigError> {
        let (key, text) = pair.split_once('=').ok_or_else(|| ConfigError::SetSyntax { given: pair.to_string() })?;
        self.put(key.trim(), given_value(text), &Config::keys())
    }

    /// Adds one typed value.
    pub fn value(&mut self, key: &str, value: impl Into<Value>) -> Result<(), ConfigError> {
        self.put(key, value.into(), &Config::keys())
    }

    /// Builds the configuration and checks every value.
    pub fn build(&self) -> Result<Config, ConfigError> {
        let config: Config = self.table.clone().try_into().map_err(|error: toml::de::Error| ConfigError::Syntax {
            origin: "the configuration".to_string(),
            why: error.to_string(),
        })?;
        config.check()?;
        Ok(config)
    }

    fn put(&mut self, key: &str, value: Value, keys: &[KeyDoc]) -> Result<(), ConfigError> {
        let known = keys.iter().find(|known| known.key == key).ok_or_else(|| unknown(key, keys))?;
        // As after `--steps`: 2M.
        let count = value.as_str().filter(|_| known.notation == u32::NOTATION).and_then(|text| parse_count(text).ok());
        let count = count.and_then(|count| i64::try_from(count).ok()).map(Value::Integer);
        let value = known.convert(&count.unwrap_or(value))?;
        let (section, name) = key.split_once('.').expect("every known key has a section");
        self.table
            .entry(section)
            .or_insert_with(|| Value::Table(Table::new()))
            .as_table_mut()
            .expect("sections are tables")
            .insert(name.to_string(), value);
        Ok(())
    }
}

/// Returns the value of `key=value`: a text that is not TOML is a string.
#[must_use]
pub fn given_value(text: &str) -> Value {
    parse_value(text).unwrap_or_else(|| Value::String(text.to_string()))
}

fn parse(text: &str, origin: &str) -> Result<Table, ConfigError> {
    text.parse()
        .map_err(|error: toml::de::Error| ConfigError::Syntax { origin: origin.to_string(), why: error.to_string() })
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use proptest::prelude::*;

    pub(crate) fn set(pair: &str) -> Result<Config, ConfigError> {
        let mut source = ConfigSource::default();
        source.set(pair)?;
        source.build()
    }

    #[test]
    fn defaults_pass_their_own_checks_and_survive_toml() {
        let config = ConfigSource::default().build().unwrap();
        let mut again = ConfigSource::default();
        again.text(&config.to_toml(), "saved").unwrap();
        assert_eq!(again.build().unwrap(), config);
    }

    #[test]
    fn every_preset_builds() {
        for (name, _) in crate::PRESETS {
            let mut source = ConfigSource::default();
            source.preset(name).unwrap();
            source.build().unwrap();
        }
    }

    #[test]
    fn later_sources_win() {
        let mut source = ConfigSource::default();
        source.preset("smoke").unwrap();
        source.text("[ppo]\nepochs = 7\n", "file").unwrap();
        source.set("ppo.epochs=9").unwrap();
        let config = source.build().unwrap();
        assert_eq!((config.ppo.epochs, config.rollout.envs), (9, 8));
    }

    #[test]
    fn keys_of_another_version_are_ignored_and_known_ones_are_checked() {
        let read = |text: &str| {
            let mut source = ConfigSource::default();
            let unknown = source.text_of_run(text, "the run", |key| !key.starts_with("ppo."))?;
            Ok::<_, ConfigError>((source.build()?, unknown))
        };
        let newer = "later = 1\n[env]\nsubsteps = 5\nterrain = \"rough\"\n[env.deep]\nx = 1\n[weather]\nwind_mps = 3.0\n\
                     [ppo]\nminibatch = -7\nalgorithm = \"ppo2\"\n";
        let (config, unknown) = read(newer).unwrap();
        assert_eq!(unknown, ["env.deep", "env.terrain", "later", "ppo.algorithm", "weather.wind_mps"]);
        let mut wanted = Config::default();
        wanted.env.substeps = 5;
        assert_eq!(config, wanted, "`ppo.minibatch` is not needed");
        let message = |text: &str| read(text).unwrap_err().to_string();
        assert!(message("[env]\ntask = \"humanoid-v6\"").contains("`env.task` is \"humanoid-v6\""));
        assert!(message("[env]\nsubsteps = \"many\"").contains("`env.substeps` is \"many\""));
        assert!(message("[rollout]\nenvs = 0").contains("`rollout.envs` is 0"));
        assert!(message("[env").contains("the run is not valid TOML"));
        assert!(message("env = 3").contains("`env` is 3"));
        // The program's own reading of files refuses the same keys.
        let mut own = ConfigSource::default();
        assert!(own.text("[weather]\nwind_mps = 3.0", "a file").unwrap_err().to_string().contains("weather.wind_mps"));
    }

    #[test]
    fn errors_name_key_value_and_allowed_values() {
        let message = |pair: &str| set(pair).unwrap_err().to_string();
        assert_eq!(message("rollout.envs=0"), "config key `rollout.envs` is 0; allowed: 1 to 65536");
        assert!(message("ppo.learning_rat=1").contains("did you mean `ppo.learning_rate`?"));
        let mut source = ConfigSource::default();
        source.text("[ppo]\nbatch = 8192\nminibatch = 9000", "a file").unwrap();
        assert!(source.build().unwrap_err().to_string().contains("0 to ppo.batch, which is 8192"));
        assert!(message("ppo.epochs=many").contains("`ppo.epochs` is \"many\""));
        assert!(message("ppo.epochs=-1").contains("is -1; allowed: 1 to 100"));
        assert!(
            message("nonsense.key=1")
                .contains("allowed: run, env, velocity, rewards, motion, ground, task, randomisation, rollout, policy, ppo, learner, eval, bus")
        );
        assert!(message("rollout.max_in_flight=2").contains("where learner.mode is \"sync\""));
        assert!(message("ppo.gamma=nan").contains("allowed: 0 to 1"));
        assert!(message("seed").contains("key=value"));
    }

    #[test]
    fn all_wrong_entries_of_a_file_are_named_at_once() {
        let mut source = ConfigSource::default();
        let text = "[ppo]\ngamma = 2\nepochs = 'many'\nbatch = 4096\n[rollot]\nenvs = 3\n[run]\nstep = 1";
        let message = source.text(text, "config file `a.toml`").unwrap_err().to_string();
        assert!(message.starts_with("config file `a.toml` has 4 wrong entries: "), "{message}");
        for part in
            ["`ppo.gamma` is 2.0; allowed: 0 to 1", "`ppo.epochs` is \"many\"", "`rollot", "did you mean `run.steps`"]
        {
            assert!(message.contains(part), "{part} in {message}");
        }
        assert_eq!(source.build().unwrap().ppo.batch, 4096, "sound entries are kept");
    }

    #[test]
    fn counts_are_written_as_people_do() {
        assert_eq!(set("run.steps=2M").unwrap().run.steps, 2_000_000);
        let mut source = ConfigSource::default();
        source.text("[run]\nsteps = \"2M\"\n[rollout]\nenvs = '1k'", "a file").unwrap();
        let config = source.build().unwrap();
        assert_eq!((config.run.steps, config.rollout.envs), (2_000_000, 1000));
        assert!(set("run.name=2M").is_err() && set("run.steps=2X").is_err());
    }

    #[test]
    fn control_steps_have_a_range_and_pushes_are_no_more_frequent() {
        let message = |pairs: &[&str]| {
            let mut source = ConfigSource::default();
            pairs.iter().try_for_each(|pair| source.set(pair)).and_then(|()| source.build()).unwrap_err().to_string()
        };
        for bad in ["0", "0.0009", "0.11", "-0.02", "nan", "inf"] {
            let message = message(&[&format!("env.control_step_s={bad}")]);
            assert!(
                message.contains("`env.control_step_s` is") && message.contains("allowed: 0.001 to 0.1"),
                "{message}"
            );
        }
        for (text, value) in [("0.001", 0.001), ("0.02", 0.02), ("0.1", 0.1)] {
            assert_eq!(set(&format!("env.control_step_s={text}")).unwrap().env.control_step_s, value);
        }
        assert_eq!(Config::default().env.control_step_s, 0.015);
        let pushes = message(&["env.control_step_s=0.05", "randomisation.push_interval_s=[0.02, 1]"]);
        assert!(pushes.contains("`randomisation.push_interval_s` is [0.02, 1.0]"), "{pushes}");
        assert!(pushes.contains("env.control_step_s is 0.05"), "{pushes}");
        assert!(set("randomisation.push_interval_s=[0.02, 1]").is_ok());
    }

    #[test]
    fn a_keyframe_is_a_name() {
        assert_eq!(set("env.keyframe=squat").unwrap().env.keyframe, "squat");
        assert!(Config::default().env.keyframe.is_empty());
        let message = set("env.keyframe=3").unwrap_err().to_string();
        assert!(message.contains("`env.keyframe` is 3, which is not a text in quotes; allowed: "), "{message}");
        assert!(set(&format!("env.keyframe={}", "x".repeat(129))).is_err());
    }

    #[test]
    fn ranges_are_pairs_with_possibly_infinite_bounds() {
        let range =
            |text: &str| set(&format!("env.contact_cost_range={text}")).map(|config| config.env.contact_cost_range);
        assert_eq!(range("[0, 5]").unwrap(), [0.0, 5.0]);
        assert_eq!(range("[-inf, inf]").unwrap(), [f64::NEG_INFINITY, f64::INFINITY]);
        let open = ConfigSource::default().build().unwrap();
        assert_eq!(open.env.contact_cost_range[0], f64::NEG_INFINITY, "the default");
        for bad in ["[5, 0]", "[nan, 1]", "[0, nan]", "[-inf, -inf]", "[inf, inf]", "[1]", "[1, 2, 3]", "7", "[a, b]"] {
            let message = range(bad).unwrap_err().to_string();
            assert!(message.contains("env.contact_cost_range") && message.contains("[lowest, highest]"), "{message}");
        }
        assert!(set("env.healthy_z_range=[2, 2]").unwrap_err().to_string().contains("the first below the second"));
        assert_eq!(set("env.healthy_z_range=[0.8, inf]").unwrap().env.healthy_z_range, [0.8, f64::INFINITY]);
    }

    #[test]
    fn choices_take_only_their_names() {
        use crate::{EnvObservation, EnvTask};
        assert_eq!(set("env.task=humanoid-v4").unwrap().env.task, EnvTask::HumanoidV4);
        assert_eq!(set("env.observation=\"gymnasium-v5\"").unwrap().env.observation, EnvObservation::GymnasiumV5);
        let message = set("env.task=humanoid-v6").unwrap_err().to_string();
        assert_eq!(
            message,
            "config key `env.task` is \"humanoid-v6\"; allowed: \"humanoid-v5\", \"humanoid-v4\", \"velocity\", \"motion\" or \
             \"external\""
        );
        assert!(set("env.observation=5").unwrap_err().to_string().contains("\"compact\""));
    }

    #[test]
    fn the_v4_observation_has_no_optional_blocks() {
        let mut source = ConfigSource::default();
        source.set("env.observation=gymnasium-v4").unwrap();
        source.build().unwrap();
        source.set("env.include_cvel_in_observation=false").unwrap();
        let message = source.build().unwrap_err().to_string();
        assert!(message.contains("env.include_cvel_in_observation") && message.contains("gymnasium-v5"), "{message}");
        source.set("env.observation=gymnasium-v5").unwrap();
        source.build().unwrap();
    }

    #[test]
    fn whole_floats_are_accepted_as_integers() {
        assert_eq!(set("run.steps=8e6").unwrap().run.steps, 8_000_000);
        assert_eq!(set("ppo.gamma=1").unwrap().ppo.gamma, 1.0);
    }

    #[test]
    fn ranges_are_two_numbers_in_order() {
        assert_eq!(set("randomisation.mass_scale=[0.9, 2]").unwrap().randomisation.mass_scale, [0.9, 2.0]);
        assert_eq!(set("randomisation.action_delay_steps=[0, 1]").unwrap().randomisation.action_delay_steps, [0, 1]);
        let message = |pair: &str| set(pair).unwrap_err().to_string();
        assert_eq!(
            message("randomisation.mass_scale=[1.5, 0.5]"),
            "config key `randomisation.mass_scale` is [1.5, 0.5]; allowed: [smallest, largest], 0.1 to 10"
        );
        for wrong in ["1", "[1]", "[1, 1, 1]", "[\"a\", 1]", "[nan, 1]", "[0, 1]"] {
            assert!(message(&format!("randomisation.mass_scale={wrong}")).contains("0.1 to 10"), "{wrong}");
        }
        for wrong in ["[0, 4]", "[0.5, 1]", "[-1, 1]", "[2, 1]"] {
            assert!(message(&format!("randomisation.action_delay_steps={wrong}")).contains("0 to 3"), "{wrong}");
        }
    }

    #[test]
    fn preset_sim2sim_changes_only_the_randomisation() {
        let mut source = ConfigSource::default();
        source.preset("sim2sim").unwrap();
        let config = source.build().unwrap();
        assert_ne!(config.randomisation, Config::default().randomisation);
        assert_eq!(Config { randomisation: Config::default().randomisation, ..config }, Config::default());
    }

    proptest! {
        #[test]
        fn no_pair_panics(pair in ".{0,40}") {
            let _ = set(&pair);
        }
    }
}
