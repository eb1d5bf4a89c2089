//! Parts of messages: arguments quoted for a shell, the name that a misspelled one may mean, and text without Unicode.

use std::{borrow::Cow, fs, path::Path};

use crate::machine;

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

/// Returns the file or folder beside `path` that a misspelled path may mean.
#[must_use]
pub fn nearest_path(path: &Path) -> Option<String> {
    let folder = path.parent()?;
    let entries = fs::read_dir(if folder == Path::new("") { Path::new(".") } else { folder }).ok()?;
    let names: Vec<String> = entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    let given = path.file_name()?.to_str()?;
    let name = nearest(given, names.iter().map(String::as_str).filter(|name| *name != given))?;
    Some(folder.join(name).display().to_string())
}

/// Returns text that a terminal of this locale can show: itself, or with an ASCII character for each other one.
#[must_use]
pub fn shown(text: &str) -> Cow<'_, str> {
    if machine::is_utf8_locale() || text.is_ascii() {
        return text.into();
    }
    text.chars().map(ascii).collect()
}

/// Returns the ASCII character that looks most like `c`.
#[must_use]
pub fn ascii(c: char) -> char {
    match c {
        '\0'..='\u{7f}' => c,
        '▁' | '▂' => '_',
        '▃' | '▄' | '–' | '─' | '━' => '-',
        '▅' | '▆' => '=',
        '▇' | '█' | '▓' => '#',
        '░' | '▒' | '·' | '…' => '.',
        '│' | '┃' => '|',
        // Corners and crossings of boxes, then points of curves.
        '\u{2500}'..='\u{257f}' => '+',
        '\u{2800}'..='\u{28ff}' | '•' => '*',
        '×' => 'x',
        '±' => '~',
        '↑' => '^',
        '↓' => 'v',
        '→' => '>',
        _ => '?',
    }
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
    fn misspelled_paths_are_recognised() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("robot.xml"), "").unwrap();
        let near = nearest_path(&folder.path().join("robt.xml")).unwrap();
        assert!(near.ends_with("/robot.xml"), "{near}");
        assert_eq!(nearest_path(&folder.path().join("weather.toml")), None);
        assert_eq!(nearest_path(Path::new("/no/such/folder/robot.xml")), None);
    }

    #[test]
    fn every_character_gets_one_of_ascii() {
        let text: String = "4.2 ± 1 █▅▁ a–b ⣿ 日".chars().map(ascii).collect();
        assert_eq!(text, "4.2 ~ 1 #=_ a-b * ?");
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
