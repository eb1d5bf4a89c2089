//! Page of all configuration keys, generated from their declarations.

use treadmill_config::{Config, KeyDoc};
use treadmill_learner::training::is_changeable;

use super::heading;

/// Returns the page.
pub fn page() -> String {
    let mut page = heading("Configuration keys", "their declarations");
    page += "\n[configuration.md](../guide/configuration.md) explains where values come from and what is checked. \
             Each key has its\n";
    page +=
        "default and the allowed values. *Live* keys can change during a run, by `treadmill control set KEY VALUE`.\n";
    for section in Config::sections() {
        page += &format!("\n## [{}]\n\n{}\n\n", section.name, section.about);
        for KeyDoc { key, doc, default, allowed, .. } in section.keys {
            let live = if is_changeable(key) { " *Live.*" } else { "" };
            page += &format!("- `{key} = {default}` ({allowed}): {doc}{live}\n");
        }
    }
    page
}
