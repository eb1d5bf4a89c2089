//! Parts of messages: arguments quoted for a shell, and the name that a misspelled one may mean.

/// Quotes an argument for a shell, if that is necessary.
#[must_use]
pub fn quoted(argument: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=:,+".contains(c);
    if !argument.is_empty() && argument.chars().all(plain) {
        return argument.to_string();
    }
    format!("'{}'", argument.replace('\'', r"'\''"))
}

/// Returns the known name that differs from `given` in at most a third of the letters, and in the fewest.
#[must_use]
pub fn nearest<'a>(given: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let given = given.to_lowercase();
    let distances = known.into_iter().map(|name| (strsim::damerau_levenshtein(&given, &name.to_lowercase()), name));
    let (distance, name) = distances.min()?;
    (distance * 3 <= given.chars().count()).then_some(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_are_quoted_for_a_shell() {
        assert_eq!(quoted("--set"), "--set");
        assert_eq!(quoted("policy.hidden=[8, 8]"), "'policy.hidden=[8, 8]'");
        assert_eq!(quoted("it's"), r"'it'\''s'");
    }

    #[test]
    fn misspelled_names_are_recognised() {
        let known = ["walk", "walk-1", "walk-12", "run"];
        assert_eq!(nearest("wlak", known), Some("walk"));
        assert_eq!(nearest("Walk-1", known), Some("walk-1"));
        assert_eq!(nearest("walk-3", known), Some("walk-1"));
        assert_eq!(nearest("jump", known), None);
        assert_eq!(nearest("", known), None);
    }
}
