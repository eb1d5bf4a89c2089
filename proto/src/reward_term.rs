//! Terms of the reward, as means over a fragment.

use crate::{
    Malformed,
    limits::{IDENT_CHARS_MAX, REWARD_TERMS_MAX},
};

pub use crate::wire::RewardTerm;

/// Checks count, names and numbers of a fragment's terms.
pub(crate) fn check(terms: &[RewardTerm]) -> Result<(), Malformed> {
    check_count(terms.len())?;
    for (index, RewardTerm { name, mean }) in terms.iter().enumerate() {
        let allowed = |c: u8| c.is_ascii_lowercase() || c.is_ascii_digit() || c == b'_';
        if !(1..=IDENT_CHARS_MAX).contains(&name.len()) || !name.bytes().all(allowed) {
            let shown: String = name.chars().take(IDENT_CHARS_MAX).collect();
            let expected = format!("1 to {IDENT_CHARS_MAX} of the characters a-z, 0-9 and _");
            return Err(Malformed::field("reward_terms.name", format!("`{}`", shown.escape_debug()), expected));
        }
        if !mean.is_finite() {
            return Err(Malformed::NotFinite { field: "reward_terms", index, value: mean.to_string() });
        }
    }
    Ok(())
}

/// Checks how many terms a fragment has, also before they are decoded.
pub(crate) fn check_count(count: usize) -> Result<(), Malformed> {
    match count {
        0..=REWARD_TERMS_MAX => Ok(()),
        _ => Err(Malformed::field("reward_terms", count, format!("at most {REWARD_TERMS_MAX}"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_names_the_bad_term() {
        let term = |name: &str, mean| RewardTerm { name: name.to_owned(), mean };
        assert_eq!(check(&[term("feet_slip", -0.5), term("alive", 1.0)]), Ok(()));
        assert_eq!(check(&vec![term("a", 0.0); REWARD_TERMS_MAX]), Ok(()));
        let long = "a".repeat(IDENT_CHARS_MAX + 1);
        for (terms, expected) in [
            (vec![term("alive", 1.0), term("feet/slip", 1.0)], "`reward_terms.name` is `feet/slip`"),
            (vec![term("", 1.0)], "`reward_terms.name` is ``"),
            (vec![term("\u{1b}[2J", 1.0)], r"is `\u{1b}[2J`; expected 1 to 64"),
            (vec![term(&long, 1.0)], "`reward_terms.name`"),
            (vec![term("alive", 1.0), term("alive", f64::NAN)], "`reward_terms` holds NaN at index 1"),
            (vec![term("alive", 1.0); REWARD_TERMS_MAX + 1], "`reward_terms` is 65; expected at most 64"),
        ] {
            let refused = check(&terms).unwrap_err().to_string();
            assert!(refused.contains(expected), "{refused}");
        }
    }
}
