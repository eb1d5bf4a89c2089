//! Result of a diagnosis: its severity, what was seen, and what to do.

use std::fmt;

/// Severity of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// No action needed.
    Ok,
    /// Works, but could be better.
    Note,
    /// Will not work.
    Problem,
}

impl Severity {
    /// Returns the word that stands for it in the output.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::Note => "note",
            Self::Problem => "problem",
        }
    }
}

/// Result of one diagnosis.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Fixed name of the diagnosis.
    pub name: &'static str,
    pub severity: Severity,
    /// What was seen, in one line.
    pub seen: String,
    /// What to do about it.
    pub remedy: Option<String>,
}

impl Finding {
    /// Creates a finding that needs no action.
    pub fn ok(name: &'static str, seen: impl Into<String>) -> Self {
        Self { name, severity: Severity::Ok, seen: one_line(&seen.into()), remedy: None }
    }

    /// Creates a finding worth knowing.
    pub fn note(name: &'static str, seen: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { name, severity: Severity::Note, seen: one_line(&seen.into()), remedy: Some(one_line(&remedy.into())) }
    }

    /// Creates a finding to be fixed.
    pub fn problem(name: &'static str, seen: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { severity: Severity::Problem, ..Self::note(name, seen, remedy) }
    }
}

/// Replaces control characters: text from other machines must not move the cursor or start a line.
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
    fn findings_are_aligned_and_contain_no_control_characters() {
        let finding = Finding::problem("learner", "version \u{1b}[2J1\n", "update it");
        let text = finding.to_string();
        assert_eq!(text, "problem  learner        version  [2J1 \n                        do: update it");
        assert_eq!(Finding::ok("cpu", "fast").to_string(), "ok       cpu            fast");
    }
}
