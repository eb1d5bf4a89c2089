//! Named starting points.

use super::ConfigError;

/// Names and TOML text of the presets.
pub const PRESETS: &[(&str, &str)] = &[
    // The defaults are the recipe that walks.
    ("walk", ""),
    // The same recipe under everything that Gymnasium's environments observe.
    ("walk-v5obs", "[env]\nobservation = \"gymnasium-v5\"\n"),
    ("walk-v4obs", "[env]\ntask = \"humanoid-v4\"\nobservation = \"gymnasium-v4\"\n"),
    // Small enough to end within seconds, on a laptop or in a test.
    (
        "smoke",
        "[run]\nsteps = 8192\n[rollout]\nenvs = 8\nactors = 2\nfragment_steps = 64\n\
         [policy]\nhidden = [32, 32]\n[ppo]\nbatch = 512\nminibatch = 256\nepochs = 2\n\
         [learner]\ntable_every_updates = 4\n[bus]\nstats_every_ms = 500\n",
    ),
];

/// The text of one preset.
pub fn preset(name: &str) -> Result<&'static str, ConfigError> {
    PRESETS.iter().find(|(known, _)| *known == name).map(|(_, text)| *text).ok_or_else(|| ConfigError::Preset {
        given: name.to_string(),
        allowed: PRESETS.iter().map(|(known, _)| *known).collect::<Vec<_>>().join(", "),
    })
}
