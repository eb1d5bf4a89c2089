//! Names that may stand in a key of the bus.

use crate::{Malformed, limits::IDENT_CHARS_MAX};

/// Accepts `[a-z0-9_-]{1,64}`: nothing that a key expression would read as structure or a wildcard.
pub fn check_ident(field: &'static str, name: &str) -> Result<(), Malformed> {
    let allowed = |c: u8| c.is_ascii_lowercase() || c.is_ascii_digit() || c == b'_' || c == b'-';
    if (1..=IDENT_CHARS_MAX).contains(&name.len()) && name.bytes().all(allowed) {
        return Ok(());
    }
    let shown: String = name.chars().take(IDENT_CHARS_MAX).collect();
    Err(Malformed::field(field, format!("`{shown}`"), "1 to 64 of the characters a-z, 0-9, _ and -"))
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
}
