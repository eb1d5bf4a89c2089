//! Errors for keys that do not exist: the successor of a replaced key, the nearest key, or the keys of the section.

use strsim::levenshtein;

use super::{ConfigError, KeyDoc};

/// Returns the section of a key.
pub(super) fn section_of(known: &KeyDoc) -> &str {
    known.key.split('.').next().unwrap_or_default()
}

/// Keys of earlier versions, with their successors.
const REPLACED: &[(&str, &str)] = &[
    ("env.contact_cost_max", "`env.contact_cost_range`, as in contact_cost_range = [-inf, 10.0]"),
    ("env.healthy_z_min_m", "`env.healthy_z_range`, as in healthy_z_range = [1.0, 2.0]"),
    ("env.healthy_z_max_m", "`env.healthy_z_range`, as in healthy_z_range = [1.0, 2.0]"),
];

/// Returns whether `key` existed in an earlier version and became part of another key.
pub(super) fn is_replaced(key: &str) -> bool {
    REPLACED.iter().any(|(old, _)| *old == key)
}

/// Returns the error of a key that does not exist, with the nearest one or the allowed ones.
pub(super) fn unknown(key: &str, keys: &[KeyDoc]) -> ConfigError {
    if let Some((_, successor)) = REPLACED.iter().find(|(old, _)| *old == key) {
        return ConfigError::UnknownKey { key: key.to_string(), hint: format!("it is now part of {successor}") };
    }
    let wanted = key.rsplit('.').next().unwrap_or(key);
    let nearest = keys
        .iter()
        .map(|known| {
            (levenshtein(key, &known.key).min(levenshtein(wanted, known.key.rsplit('.').next().unwrap_or(""))), known)
        })
        .min_by_key(|(distance, _)| *distance);
    let hint = match nearest {
        // Up to a third of the letters wrong counts as a misspelling.
        Some((distance, known)) if distance <= wanted.len() / 3 => format!("did you mean `{}`?", known.key),
        _ => {
            let section = key.split('.').next().unwrap_or(key);
            let mut allowed: Vec<&str> =
                keys.iter().filter(|known| section_of(known) == section).map(|known| known.key.as_str()).collect();
            if allowed.is_empty() {
                allowed = keys.iter().map(section_of).collect();
                allowed.dedup();
            }
            format!("allowed: {}", allowed.join(", "))
        }
    };
    ConfigError::UnknownKey { key: key.to_string(), hint }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::tests::set;

    #[test]
    fn replaced_keys_name_their_successor() {
        for (old, _) in REPLACED {
            let message = set(&format!("{old}=1.5")).unwrap_err().to_string();
            assert!(message.contains(old) && message.contains("_range = ["), "{message}");
        }
        assert!(set("env.healthy_z_min_m=1").unwrap_err().to_string().contains("`env.healthy_z_range`"));
        assert!(set("env.contact_cost_max=1").unwrap_err().to_string().contains("`env.contact_cost_range`"));
    }
}
