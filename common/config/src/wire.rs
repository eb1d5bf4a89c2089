//! Keys that older actors do not know. They ignore unknown keys, so the learner must refuse them where a key has an effect.

use super::Config;

/// Sections whose keys change what an actor simulates or sends.
const SECTIONS: [&str; 6] = ["env", "velocity", "rewards", "ground", "randomisation", "rollout"];

/// Keys of [`SECTIONS`] that were added after wire version 1, with the wire version that added each. The default of such a
/// key means what older actors do.
const ADDED: &[(&str, u32)] = &[];

impl Config {
    /// Returns the smallest wire version of actors that know every key of [`SECTIONS`] which
    /// differs from its default; 0 if every actor knows them.
    pub fn wire_version_min(&self) -> u32 {
        self.wire_version_of(ADDED)
    }

    fn wire_version_of(&self, added: &[(&str, u32)]) -> u32 {
        let is_set = |key: &str| self.value_of(key) != Self::default().value_of(key);
        added.iter().filter(|(key, _)| is_set(key)).map(|(_, version)| *version).max().unwrap_or(0)
    }
}

/// Returns whether an unknown key belongs to a section whose keys change what an actor simulates or sends.
pub fn is_key_of_actors(key: &str) -> bool {
    key.split_once('.').is_some_and(|(section, _)| SECTIONS.contains(&section))
}

#[cfg(test)]
mod tests {
    use treadmill_proto::WIRE_VERSION;

    use super::*;
    use crate::source::tests::set;

    /// Keys of [`SECTIONS`] that actors of wire version 1 know, one a line.
    const KEYS_1: &str = include_str!("keys-1.txt");

    #[test]
    fn keys_added_later_raise_the_version_only_where_they_are_set() {
        let added = [("env.substeps", 2), ("rollout.envs", 3), ("randomisation.push_mps", 9)];
        let version = |config: &Config| config.wire_version_of(&added);
        assert_eq!(version(&Config::default()), 0);
        assert_eq!(version(&set("env.substeps=4").unwrap()), 0, "the default");
        assert_eq!(version(&set("env.substeps=3").unwrap()), 2);
        assert_eq!(version(&set("env.self_collision=false").unwrap()), 0, "known to all");
        assert_eq!(version(&Config { env: set("env.substeps=3").unwrap().env, ..set("rollout.envs=8").unwrap() }), 3);
    }

    #[test]
    fn every_key_of_actors_is_known_to_version_1_or_was_added_later() {
        let known: Vec<&str> = KEYS_1.lines().collect();
        let now: Vec<String> =
            Config::keys().into_iter().map(|doc| doc.key).filter(|key| is_key_of_actors(key)).collect();
        assert!(now.len() > 35, "{now:?}");
        let strange: Vec<&String> = now
            .iter()
            .filter(|key| known.contains(&key.as_str()) == ADDED.iter().any(|(added, _)| added == key))
            .collect();
        assert!(
            strange.is_empty(),
            "add each new key to ADDED with a raised WIRE_VERSION (before the first release: to keys-1.txt): {strange:?}"
        );
        for (key, version) in ADDED {
            assert!(
                now.iter().any(|known| known == key) && *version > 1 && *version <= WIRE_VERSION,
                "{key}: {version}"
            );
        }
    }

    #[test]
    fn only_keys_of_some_sections_concern_actors() {
        assert!(is_key_of_actors("env.terrain") && is_key_of_actors("rollout.new"));
        assert!(!is_key_of_actors("ppo.new") && !is_key_of_actors("env") && !is_key_of_actors("environment.x"));
    }
}
