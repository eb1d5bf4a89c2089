//! Numbers in few characters.

use treadmill_runtime::numbers::thousands;

pub use crate::commands::status::plain::plain;

/// Stands for a number that is unknown or not finite.
pub const UNKNOWN: &str = "–";

/// Formats a count: in full below ten million, else with a unit letter.
pub fn count(count: u64) -> String {
    if count < 10_000_000 { thousands(count) } else { scaled(count as f64) }
}

/// Formats a count in at most five characters.
pub fn short(count: u64) -> String {
    if count < 10_000 { count.to_string() } else { scaled(count as f64) }
}

/// Formats a number with about three digits.
pub fn number(value: f64) -> String {
    let size = value.abs();
    match size {
        _ if !value.is_finite() => UNKNOWN.to_string(),
        _ if size < 9.995 => format!("{value:.2}"),
        _ if size < 99.95 => format!("{value:.1}"),
        _ if size < 9999.5 => format!("{value:.0}"),
        _ => scaled(value),
    }
}

/// Formats a number that may be unknown.
pub fn known(value: Option<f64>) -> String {
    value.map_or_else(|| UNKNOWN.to_string(), number)
}

fn scaled(value: f64) -> String {
    for (unit, letter) in [(1e3, 'k'), (1e6, 'M'), (1e9, 'G'), (1e12, 'T'), (1e15, 'P'), (1e18, 'E')] {
        let part = value / unit;
        match part.abs() {
            size if size < 9.995 => return format!("{part:.2}{letter}"),
            size if size < 99.95 => return format!("{part:.1}{letter}"),
            size if size < 999.5 => return format!("{part:.0}{letter}"),
            _ => {}
        }
    }
    format!("{value:.0e}")
}

/// Formats seconds in a suitable unit.
pub fn duration(elapsed_s: f64) -> String {
    match elapsed_s {
        s if !s.is_finite() || s < 0.0 => UNKNOWN.to_string(),
        s if s < 9.95 => format!("{s:.1} s"),
        s if s < 99.5 => format!("{s:.0} s"),
        s if s < 6000.0 => format!("{:.0} min", s / 60.0),
        s if s < 48.0 * 3600.0 => format!("{:.1} h", s / 3600.0),
        s if s < 9999.0 * 86_400.0 => format!("{:.0} d", s / 86_400.0),
        _ => "years".to_string(),
    }
}

/// Formats a share as a percentage.
pub fn percent(share: f64) -> String {
    if share.is_finite() { format!("{:.0} %", 100.0 * share.clamp(0.0, 1.0)) } else { UNKNOWN.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_numbers_are_short() {
        assert_eq!([count(0), count(999), count(8192), count(4_194_304)], ["0", "999", "8,192", "4,194,304"]);
        assert_eq!([count(12_345_678), count(u64::MAX)], ["12.3M", "18.4E"]);
        assert_eq!([number(0.0), number(-1.234), number(99.96), number(5892.4)], ["0.00", "-1.23", "100", "5892"]);
        assert_eq!([number(22_908.0), number(f64::NAN), number(f64::MAX)], ["22.9k", "–", "2e308"]);
        assert_eq!([duration(0.04), duration(42.0), duration(180.0)], ["0.0 s", "42 s", "3 min"]);
        assert_eq!([duration(7200.0), duration(1e6), duration(1e300), duration(-1.0)], ["2.0 h", "12 d", "years", "–"]);
        for value in [1e-300, 9.999, 99.99, 999.9, 9999.9, 999_999.9, 1e18, 1e21, -1e21, f64::MIN] {
            assert!(number(value).chars().count() <= 7, "{}", number(value));
        }
    }
}
