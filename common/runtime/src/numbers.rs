//! Large numbers as people write and read them.

/// Formats 1234567 as `1,234,567`.
#[must_use]
pub fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let groups: Vec<&str> =
        digits.as_bytes().rchunks(3).rev().map(|group| str::from_utf8(group).unwrap_or("")).collect();
    groups.join(",")
}

/// Reads a count such as `8000000`, `8,000,000`, `8_000_000`, `8M`, `1.5k` or `1e6`.
///
/// # Errors
/// If the text is no whole number that fits 64 bits.
pub fn parse_count(text: &str) -> Result<u64, String> {
    let refuse = || format!("`{text}` is not a whole number; examples: 8000000, 8M, 500k, 1e6");
    let plain = text.replace([',', '_'], "");
    if let Ok(count) = plain.parse() {
        return Ok(count);
    }
    let (number, scale) = match plain.char_indices().last() {
        Some((at, 'k' | 'K')) => (&plain[..at], 1e3),
        Some((at, 'm' | 'M')) => (&plain[..at], 1e6),
        Some((at, 'g' | 'G' | 'b' | 'B')) => (&plain[..at], 1e9),
        _ => (&plain[..], 1.0),
    };
    let count = number.parse::<f64>().map_err(|_| refuse())? * scale;
    // Whole numbers beyond 2^53 have no exact f64.
    let is_exact = count.fract() == 0.0 && (0.0..=9_007_199_254_740_992.0).contains(&count);
    if is_exact { Ok(count as u64) } else { Err(refuse()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_read_as_people_write_them() {
        for (text, count) in [
            ("0", 0),
            ("155,648", 155_648),
            ("8_000_000", 8_000_000),
            ("8M", 8_000_000),
            ("1.5k", 1500),
            ("2e7", 20_000_000),
            ("18446744073709551615", u64::MAX),
        ] {
            assert_eq!(parse_count(text), Ok(count), "{text}");
        }
        for text in ["", "M", "many", "-1", "1.5", "1e99", "nan", "8MM", "8 M"] {
            assert!(parse_count(text).unwrap_err().contains("8M"), "{text}");
        }
    }

    #[test]
    fn thousands_are_separated() {
        assert_eq!([0, 999, 1000, 1_234_567].map(thousands), ["0", "999", "1,000", "1,234,567"]);
    }
}
