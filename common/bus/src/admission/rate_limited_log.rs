//! RateLimitedLog about what strangers send: said a few times, then only counted, so that nobody can fill the log.

use std::{
    sync::Mutex,
    time::{Duration, Instant},
};

/// RateLimitedLog of one kind that are said in one [`WINDOW`].
const SAID_MAX: u32 = 20;
const WINDOW: Duration = Duration::from_secs(10);

/// One kind of complaint.
#[derive(Debug, Default)]
pub struct RateLimitedLog {
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    window_begun: Option<Instant>,
    said: u32,
    unsaid: u64,
}

impl RateLimitedLog {
    /// Warns, unless that was done too often lately.
    pub fn warn(&self, message: impl FnOnce() -> String) {
        match self.may_say(Instant::now()) {
            Some(0) => tracing::warn!("{}", message()),
            Some(unsaid) => tracing::warn!("{} (and {unsaid} such messages before it that were not shown)", message()),
            None => {}
        }
    }

    /// Whether it may be said now, and how many were not.
    fn may_say(&self, now: Instant) -> Option<u64> {
        let mut state = self.state.lock().expect("no holder of this lock panics");
        if state.window_begun.is_none_or(|begun| now.duration_since(begun) >= WINDOW) {
            (state.window_begun, state.said) = (Some(now), 0);
        }
        if state.said == SAID_MAX {
            state.unsaid += 1;
            return None;
        }
        state.said += 1;
        Some(std::mem::take(&mut state.unsaid))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_million_complaints_are_a_few_lines() {
        let (complaints, now) = (RateLimitedLog::default(), Instant::now());
        let said = (0..1_000_000).filter(|_| complaints.may_say(now).is_some()).count();
        assert_eq!(said, SAID_MAX as usize);
        assert_eq!(complaints.may_say(now + WINDOW), Some(1_000_000 - u64::from(SAID_MAX)));
        assert_eq!(complaints.may_say(now + WINDOW), Some(0));
    }
}
