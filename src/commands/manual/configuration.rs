//! Every configuration key, as it is declared.

use std::fmt::Write as _;

use treadmill_config::{Config, KeyDoc};
use treadmill_learner::training::is_changeable;

use super::{cell, heading};

/// The page.
pub fn page() -> String {
    let mut page = heading("Configuration keys", "their declarations in `common/src/config/sections.rs`");
    page += "\n[configuration.md](../guide/configuration.md) says where values come from and what is checked. *Live*: whether `treadmill\n";
    page += "control set KEY VALUE` changes the key of a run that goes on.\n";
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

/// The type in words, with the unit that the name ends in.
fn kind(key: &KeyDoc) -> String {
    let kind = match key.kind {
        "bool" => "true or false",
        "u32" | "u64" => "whole number",
        "f64" => "number",
        "String" => "text",
        "Vec<u32>" => "whole numbers",
        "Vec<f64>" => "numbers",
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
