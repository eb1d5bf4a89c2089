//! `treadmill config`: prints the configuration that flags give, or explains one key.

use std::path::PathBuf;

use clap::Args;
use serde_json::json;
use treadmill_config::{Config, ConfigSource, KeyDoc};
use treadmill_learner::training::is_changeable;

use crate::{launch::output::say, shared::existing_file::existing_file};

/// Flags of `config`.
#[derive(Args)]
pub struct ConfigArgs {
    /// Key or section to explain, as in ppo.gamma or ppo; by default the whole configuration is printed as TOML.
    key: Option<String>,
    /// Preset to start from, one of those of `train`.
    #[arg(long, value_name = "NAME", default_value = "walk")]
    preset: String,
    /// Configuration file (TOML), applied over the preset.
    #[arg(long, value_name = "FILE", value_parser = existing_file)]
    config: Option<PathBuf>,
    /// Set a configuration key; may be repeated.
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Print one JSON object for each key.
    #[arg(long)]
    json: bool,
}

/// Prints the configuration or the keys asked for.
pub fn run(args: &ConfigArgs) -> anyhow::Result<()> {
    let mut source = ConfigSource::default();
    source.preset(&args.preset)?;
    if let Some(file) = &args.config {
        source.file(file)?;
    }
    for pair in &args.set {
        source.set(pair)?;
    }
    let config = source.build()?;
    if args.key.is_none() && !args.json {
        say(config.to_toml().trim_end());
        return Ok(());
    }
    let keys = wanted(args.key.as_deref())?;
    for (number, key) in keys.iter().enumerate() {
        let value = Some(config.value_of(key.key)).filter(|value| !value.is_empty());
        let value = value.unwrap_or_else(|| "unset".to_string());
        if args.json {
            say(&as_json(key, &value));
        } else {
            let gap = if number > 0 { "\n" } else { "" };
            say(&format!("{gap}{}", explained(key, &value)));
        }
    }
    Ok(())
}

/// Returns the keys of a section, or one key; all if none is named.
fn wanted(name: Option<&str>) -> anyhow::Result<Vec<KeyDoc>> {
    let keys = Config::keys();
    let Some(name) = name else { return Ok(keys) };
    let is_wanted =
        |key: &KeyDoc| key.key == name || key.key.strip_prefix(name).is_some_and(|rest| rest.starts_with('.'));
    let found: Vec<KeyDoc> = keys.into_iter().filter(is_wanted).collect();
    if found.is_empty() {
        // Its error names the nearest key.
        ConfigSource::default().value(name, "")?;
    }
    Ok(found)
}

fn explained(key: &KeyDoc, value: &str) -> String {
    let live = if is_changeable(key.key) { "yes, by `treadmill control set`" } else { "no" };
    let KeyDoc { key, doc, default, allowed, .. } = key;
    format!("{key} = {value}\n  meaning  {doc}\n  default  {default}\n  allowed  {allowed}\n  live     {live}")
}

fn as_json(key: &KeyDoc, value: &str) -> String {
    json!({
        "key": key.key,
        "value": value,
        "default": key.default,
        "allowed": key.allowed,
        "meaning": key.doc,
        "live": is_changeable(key.key),
    })
    .to_string()
}
