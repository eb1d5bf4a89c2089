//! Senders that keep failing are not listened to for a while.

use std::{
    collections::BTreeMap,
    time::{Duration, Instant},
};

/// How long a sender is not listened to.
pub const QUARANTINE: Duration = Duration::from_secs(60);
/// Failing senders that are remembered; the one whose name sorts first gives way.
const SENDERS_MAX: usize = 4096;

/// Failures in a row, by sender.
#[derive(Debug)]
pub struct Quarantine {
    after: u32,
    failures: BTreeMap<String, (u32, Instant)>,
}

impl Quarantine {
    /// A sender is put in quarantine after so many refused fragments in a row.
    pub fn new(after: u32) -> Self {
        Self { after, failures: BTreeMap::new() }
    }

    /// Whether this sender is in quarantine at `now`.
    pub fn holds(&mut self, actor: &str, now: Instant) -> bool {
        match self.failures.get(actor) {
            Some((count, since)) if *count >= self.after => {
                if now.duration_since(*since) < QUARANTINE {
                    return true;
                }
                self.failures.remove(actor);
                false
            }
            _ => false,
        }
    }

    /// Notes a refused fragment; whether that put the sender in quarantine.
    pub fn failed(&mut self, actor: &str, now: Instant) -> bool {
        if self.failures.len() >= SENDERS_MAX && !self.failures.contains_key(actor) {
            self.failures.pop_first();
        }
        let entry = self.failures.entry(actor.to_string()).or_insert((0, now));
        *entry = (entry.0 + 1, now);
        entry.0 == self.after
    }

    /// Notes a sound fragment.
    pub fn succeeded(&mut self, actor: &str) {
        self.failures.remove(actor);
    }

    /// Who is in quarantine at `now`.
    pub fn held(&self, now: Instant) -> Vec<&str> {
        self.failures
            .iter()
            .filter(|(_, (count, since))| *count >= self.after && now.duration_since(*since) < QUARANTINE)
            .map(|(actor, _)| actor.as_str())
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn failures_in_a_row_lead_to_quarantine_and_time_leads_out() {
        let now = Instant::now();
        let mut quarantine = Quarantine::new(2);
        assert!(!quarantine.failed("a", now));
        quarantine.succeeded("a");
        assert!(!quarantine.failed("a", now));
        assert!(quarantine.failed("a", now));
        assert!(quarantine.holds("a", now));
        assert_eq!(quarantine.held(now), ["a"]);
        assert!(!quarantine.holds("b", now));
        assert!(!quarantine.holds("a", now + QUARANTINE));
    }
}
