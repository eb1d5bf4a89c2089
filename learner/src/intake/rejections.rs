//! Senders whose fragments were rejected, with the last reason of each.

use std::{
    collections::HashMap,
    time::{Duration, Instant},
};

/// Most senders that are kept; beyond this, the one whose rejection is oldest is removed.
const SENDERS_MAX: usize = 64;
/// Time for which a reason of a sender is not logged again.
const LOG_EVERY: Duration = Duration::from_secs(60);
/// Longest reason that is kept, in characters.
const REASON_CHARS_MAX: usize = 160;

/// Rejected fragments of one sender.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rejection {
    /// Number of fragments.
    pub fragments: u64,
    /// Reason for the last one.
    pub reason: String,
    at: Instant,
    /// Reason that was logged last, without numbers, and when.
    logged: (String, Instant),
}

/// Rejected fragments by sender.
#[derive(Debug, Default)]
pub struct Rejections {
    senders: HashMap<String, Rejection>,
}

impl Rejections {
    /// Records a rejected fragment. Returns whether to log it: each reason of a sender once in [`LOG_EVERY`].
    pub fn record(&mut self, sender: &str, reason: &str, now: Instant) -> bool {
        if self.senders.len() == SENDERS_MAX && !self.senders.contains_key(sender) {
            let oldest = self.senders.iter().min_by_key(|(_, rejection)| rejection.at).map(|(name, _)| name.clone());
            oldest.and_then(|name| self.senders.remove(&name));
        }
        let reason: String = reason.chars().take(REASON_CHARS_MAX).collect();
        // Indices and values differ from fragment to fragment.
        let cause = reason.chars().filter(|c| !c.is_ascii_digit()).collect();
        let known = self.senders.get(sender);
        let fragments = 1 + known.map_or(0, |rejection| rejection.fragments);
        let before =
            known.map(|known| &known.logged).filter(|(of, at)| *of == cause && now.duration_since(*at) < LOG_EVERY);
        let is_new = before.is_none();
        let logged = before.cloned().unwrap_or((cause, now));
        self.senders.insert(sender.to_string(), Rejection { fragments, reason, at: now, logged });
        is_new
    }

    /// Iterates over the senders with a rejection during the last `period`, the worst first.
    pub fn recent(&self, now: Instant, period: Duration) -> impl Iterator<Item = (&str, &Rejection)> {
        let mut recent: Vec<_> = self
            .senders
            .iter()
            .filter(|(_, rejection)| now.duration_since(rejection.at) < period)
            .map(|(name, rejection)| (name.as_str(), rejection))
            .collect();
        recent.sort_by_key(|(name, rejection)| (u64::MAX - rejection.fragments, *name));
        recent.into_iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_cause_is_logged_once_a_minute() {
        let (mut rejections, begun) = (Rejections::default(), Instant::now());
        let mut record =
            |sender, reason, after_s| rejections.record(sender, reason, begun + Duration::from_secs(after_s));
        assert!(record("a", "NaN at index 0", 0));
        assert!(!record("a", "NaN at index 17", 59));
        assert!(record("b", "NaN at index 17", 59));
        assert!(record("a", "too long", 59));
        assert!(record("a", "NaN at index 3", 59), "another cause came between");
        assert!(record("a", "NaN at index 3", 119));
    }

    #[test]
    fn the_worst_recent_senders_come_first_and_memory_is_bounded() {
        let (mut rejections, begun, minute) = (Rejections::default(), Instant::now(), Duration::from_secs(60));
        rejections.record("old", "x", begun);
        let now = begun + minute;
        for (sender, reason) in [("a", "first"), ("b", "first"), ("b", "second")] {
            rejections.record(sender, reason, now);
        }
        let recent: Vec<_> = rejections.recent(now, minute).map(|(n, r)| (n, r.fragments, r.reason.as_str())).collect();
        assert_eq!(recent, [("b", 2, "second"), ("a", 1, "first")]);
        for i in 0..2 * SENDERS_MAX {
            rejections.record(&format!("s{i}"), &"x".repeat(1000), now + minute);
        }
        assert_eq!(rejections.senders.len(), SENDERS_MAX);
        assert!(rejections.senders.values().all(|rejection| rejection.reason.len() <= REASON_CHARS_MAX));
    }
}
