//! Whether the clock is about right: certificates are valid by it, and metrics are dated by it.

use time::OffsetDateTime;

use super::finding::Finding;

const NAME: &str = "clock";

/// Before this year nothing of Treadmill was there, and no battery lasts until the other.
const YEAR_MIN: i32 = 2025;
const YEAR_MAX: i32 = 2100;

/// Of this machine, which says that it is so many seconds after 1970.
pub fn diagnose(now_unix_s: f64) -> Finding {
    let now = OffsetDateTime::from_unix_timestamp(now_unix_s as i64).unwrap_or(OffsetDateTime::UNIX_EPOCH);
    let seen = format!("{} UTC", date_text(now));
    match now.year() {
        YEAR_MIN..YEAR_MAX => Finding::ok(NAME, seen),
        _ => Finding::problem(
            NAME,
            seen,
            "set it (timedatectl set-ntp true); by a wrong clock certificates have expired or are not valid yet",
        ),
    }
}

/// `2026-05-01 13:05`.
pub fn date_text(at: OffsetDateTime) -> String {
    let month = u8::from(at.month());
    format!("{:04}-{month:02}-{:02} {:02}:{:02}", at.year(), at.day(), at.hour(), at.minute())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::check::finding::Severity;

    #[test]
    fn a_clock_that_began_anew_is_a_problem() {
        // 1_767_225_600 s is 2026-01-01 00:00 UTC: 56 years of 365 days and 14 leap days.
        assert_eq!(diagnose(f64::from((56 * 365 + 14) * 86_400) + 125.0), Finding::ok(NAME, "2026-01-01 00:02 UTC"));
        assert_eq!(diagnose(0.0).severity, Severity::Problem);
        assert_eq!(diagnose(1e12).severity, Severity::Problem);
    }
}
