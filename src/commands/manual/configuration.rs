//! Page of all configuration keys, generated from their declarations.

use std::fmt::Write as _;

use treadmill_config::{Config, KeyDoc};
use treadmill_learner::training::is_changeable;

use super::{cell, heading};

/// Returns the page.
pub fn page() -> String {
    let mut page = heading("Configuration keys", "their declarations in `common/config/src/sections.rs`");
    page += "\n[configuration.md](../guide/configuration.md) explains where values come from and what is checked. *Live* keys can\n";
    page += "change during a run, by `treadmill control set KEY VALUE`.\n";
    for section in Config::sections() {
        // Writing into a string cannot fail.
        let _ = write!(
            page,
            "\n## [{}]\n\n{}\n\n| key | type | default | allowed | live | what it does |\n|---|---|---|---|---|---|\n",
            section.name, section.about
        );
        for key in section.keys {
            let live = if is_changeable(&key.key) { "yes" } else { "no" };
            let (kind, allowed, doc) = (kind(&key), cell(key.allowed), cell(key.doc));
            let _ = writeln!(page, "| `{}` | {kind} | `{}` | {allowed} | {live} | {doc} |", key.key, key.default);
        }
    }
    page
}

/// Names the type, with the unit from the end of the key.
fn kind(key: &KeyDoc) -> String {
    let kind = match key.kind {
        "bool" => "true or false",
        "u32" | "u64" => "whole number",
        "f64" => "number",
        "String" => "text",
        "Vec<u32>" => "whole numbers",
        "Vec<f64>" => "numbers",
        "Vec<String>" => "words",
        "[f64; 2]" => "two numbers",
        "[u32; 2]" => "two whole numbers",
        _ => "name",
    };
    let units = [("_ms", "ms"), ("_s", "s"), ("_mps", "m/s"), ("_m", "m"), ("_mb", "MB")];
    match units.iter().find(|(ending, _)| key.key.ends_with(ending)) {
        Some((_, unit)) => format!("{kind}, {unit}"),
        None => kind.to_string(),
    }
}
