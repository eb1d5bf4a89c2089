//! Errors for keys that do not exist: the nearest key, or the keys of the section.

use strsim::levenshtein;

use super::{ConfigError, KeyDoc};

/// Returns the section of a key.
pub(super) fn section_of(known: &KeyDoc) -> &str {
    known.key.split('.').next().unwrap_or_default()
}

/// Returns the error of a key that does not exist, with the nearest one or the allowed ones.
pub(super) fn unknown(key: &str, keys: &[KeyDoc]) -> ConfigError {
    let wanted = key.rsplit('.').next().unwrap_or(key);
    let nearest = keys
        .iter()
        .map(|known| (levenshtein(key, known.key).min(levenshtein(wanted, known.name())), known))
        .min_by_key(|(distance, _)| *distance);
    let hint = match nearest {
        // Up to a third of the letters wrong counts as a misspelling.
        Some((distance, known)) if distance <= wanted.len() / 3 => format!("did you mean `{}`?", known.key),
        _ => {
            let section = key.split('.').next().unwrap_or(key);
            let mut allowed: Vec<&str> =
                keys.iter().filter(|known| section_of(known) == section).map(|known| known.key).collect();
            if allowed.is_empty() {
                allowed = keys.iter().map(section_of).collect();
                allowed.dedup();
            }
            format!("allowed: {}", allowed.join(", "))
        }
    };
    ConfigError::UnknownKey { key: key.to_string(), hint }
}
