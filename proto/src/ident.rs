//! Names that are valid in a bus key.

use crate::{
    Malformed,
    limits::{IDENT_CHARS_MAX, TASK_NAME_CHARS_MAX},
};

/// Prefix of the names of built-in tasks.
pub const OWN_TASKS: &str = "treadmill/";

/// Accepts `[a-z0-9_-]{1,64}`, which contains no separator or wildcard of a key expression.
pub fn check_ident(field: &'static str, name: &str) -> Result<(), Malformed> {
    let allowed = |c: u8| c.is_ascii_lowercase() || c.is_ascii_digit() || c == b'_' || c == b'-';
    if (1..=IDENT_CHARS_MAX).contains(&name.len()) && name.bytes().all(allowed) {
        return Ok(());
    }
    let shown: String = name.chars().take(IDENT_CHARS_MAX).collect();
    Err(Malformed::field(field, format!("`{shown}`"), "1 to 64 of the characters a-z, 0-9, _ and -"))
}

/// Accepts the name of an external task, such as `gymnasium/Humanoid-v5`; [`OWN_TASKS`] is reserved for built-in tasks.
pub fn check_task_name(field: &'static str, name: &str) -> Result<(), Malformed> {
    let allowed = |c: u8| c.is_ascii_alphanumeric() || b"_-./:".contains(&c);
    let fits = (1..=TASK_NAME_CHARS_MAX).contains(&name.len()) && name.bytes().all(allowed);
    if fits && !name.starts_with(OWN_TASKS) {
        return Ok(());
    }
    let shown: String = name.chars().take(IDENT_CHARS_MAX).collect();
    let wanted = format!(
        "1 to {TASK_NAME_CHARS_MAX} of the characters a-z, A-Z, 0-9, _ - . : and /, not beginning with {OWN_TASKS}"
    );
    Err(Malformed::field(field, format!("`{}`", shown.escape_debug()), wanted))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wildcards_slashes_and_capitals_are_refused() {
        assert!(check_ident("run", "walk-2026_1").is_ok());
        for bad in ["", "a/b", "**", "Walk", "@x", "é", &"x".repeat(65)] {
            assert!(check_ident("run", bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn task_names_are_plain_and_without_the_reserved_prefix() {
        for good in ["gymnasium/Humanoid-v5", "gymnasium/my.module:Walk-v0", "x"] {
            assert!(check_task_name("name", good).is_ok(), "{good}");
        }
        for bad in ["", "a b", "treadmill/humanoid-v5", "a\n", "é", "*", &"x".repeat(129)] {
            let error = check_task_name("name", bad).unwrap_err().to_string();
            assert!(error.contains("`name`") && !error.contains('\n'), "{error}");
        }
    }
}
