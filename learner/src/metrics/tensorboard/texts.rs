//! What a run is, as Markdown for TensorBoard's TEXT tab.

use treadmill_config::Config;

/// The configuration as a table: every key with its value and its default; what was changed is set in bold.
pub fn configuration(config: &Config) -> String {
    let mut text = String::from("| key | value | default |\n|---|---|---|\n");
    for key in Config::keys() {
        let value = config.value_of(&key.key);
        // A section that says nothing is left out of configurations, too.
        if value.is_empty() {
            continue;
        }
        let bold = if value == key.default { "" } else { "**" };
        text += &format!("| {} | {bold}{}{bold} | {} |\n", key.key, cell(&value), cell(&key.default));
    }
    text
}

/// Names and values, as a table.
pub fn facts(facts: &[(String, String)]) -> String {
    let mut text = String::from("| what | which |\n|---|---|\n");
    for (name, value) in facts {
        text += &format!("| {} | {} |\n", cell(name), cell(value));
    }
    text
}

/// A command line, as it is.
pub fn command(line: &str) -> String {
    format!("```sh\n{line}\n```")
}

/// A table's cell has one line, and no bar.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace(['\n', '\r'], " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_changed_stands_out() {
        let mut config = Config::default();
        config.ppo.gamma = 0.97;
        let text = configuration(&config);
        assert!(text.contains("| ppo.gamma | **0.97** | 0.99 |\n"), "{text}");
        assert!(text.contains("| ppo.gae_lambda | 0.95 | 0.95 |\n"), "{text}");
        assert!(!text.contains("task.name"));
        assert_eq!(facts(&[("cpu".into(), "a|b\nc".into())]).lines().last(), Some("| cpu | a\\|b c |"));
    }
}
