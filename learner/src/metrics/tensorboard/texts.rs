//! Description of a run, as Markdown for TensorBoard's TEXT tab.

use treadmill_config::{Config, RunConfig};

/// Returns the configuration as a table of keys, values and defaults; changed values are bold.
pub fn configuration(config: &Config) -> String {
    let mut text = String::from("| key | value | default |\n|---|---|---|\n");
    for key in Config::keys() {
        let value = config.value_of(key.key);
        // Configurations omit empty values, too.
        if value.is_empty() {
            continue;
        }
        let bold = if value == key.default { "" } else { "**" };
        text += &format!("| {} | {bold}{}{bold} | {} |\n", key.key, cell(&value), cell(&key.default));
    }
    text
}

/// Returns names and values as a table.
pub fn facts(facts: &[(String, String)]) -> String {
    let mut text = String::from("| what | which |\n|---|---|\n");
    for (name, value) in facts {
        text += &format!("| {} | {} |\n", cell(name), cell(value));
    }
    text
}

/// Returns the tags and the description of a run; empty if it has neither.
pub fn description(run: &RunConfig) -> String {
    let tags: Vec<String> = run.tags.iter().map(|tag| format!("`{tag}`")).collect();
    [tags.join(" "), run.description.clone()].join("\n\n").trim().to_string()
}

/// Returns a command line as a code block.
pub fn command(line: &str) -> String {
    format!("```sh\n{line}\n```")
}

/// Escapes text for a table's cell, which has one line and no bar.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace(['\n', '\r'], " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changed_values_are_bold() {
        let mut config = Config::default();
        config.ppo.gamma = 0.97;
        let text = configuration(&config);
        assert!(text.contains("| ppo.gamma | **0.97** | 0.99 |\n"), "{text}");
        assert!(text.contains("| ppo.gae_lambda | 0.95 | 0.95 |\n"), "{text}");
        assert!(!text.contains("task.name"));
        assert_eq!(facts(&[("cpu".into(), "a|b\nc".into())]).lines().last(), Some("| cpu | a\\|b c |"));
    }
}
