//! What a diagnosis says: a severity, what was seen, and what to do.

use std::fmt;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// As it should be.
    Ok,
    /// It works, and could be better, or should be known.
    Note,
    /// Something will not work.
    Problem,
}

impl Severity {
    /// In one word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::Note => "note",
            Self::Problem => "problem",
        }
    }
}

/// What one diagnosis says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Of what, in a word or two that never change.
    pub name: &'static str,
    /// How bad it is.
    pub severity: Severity,
    /// What was seen, in one line.
    pub seen: String,
    /// What to do about it.
    pub remedy: Option<String>,
}

impl Finding {
    /// All is well.
    pub fn ok(name: &'static str, seen: impl Into<String>) -> Self {
        Self { name, severity: Severity::Ok, seen: one_line(&seen.into()), remedy: None }
    }

    /// Worth knowing.
    pub fn note(name: &'static str, seen: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { name, severity: Severity::Note, seen: one_line(&seen.into()), remedy: Some(one_line(&remedy.into())) }
    }

    /// To be mended.
    pub fn problem(name: &'static str, seen: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { severity: Severity::Problem, ..Self::note(name, seen, remedy) }
    }
}

/// `1 actor`, `2 actors`.
pub fn actors(count: u64) -> String {
    if count == 1 { "1 actor".to_string() } else { format!("{count} actors") }
}

/// Some of what is seen was said by strangers: nothing of it moves the cursor or makes a line of its own.
fn one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

impl fmt::Display for Finding {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        write!(formatter, "{:<8} {:<14} {}", self.severity.name(), self.name, self.seen)?;
        match &self.remedy {
            Some(remedy) => write!(formatter, "\n{:24}do: {remedy}", ""),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_finding_stands_in_its_columns_and_strangers_make_no_lines() {
        let finding = Finding::problem("learner", "version \u{1b}[2J1\n", "update it");
        let text = finding.to_string();
        assert_eq!(text, "problem  learner        version  [2J1 \n                        do: update it");
        assert_eq!(Finding::ok("cpu", "fast").to_string(), "ok       cpu            fast");
    }
}
