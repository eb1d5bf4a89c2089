//! Rate limit for log messages that remote senders cause, so that no sender can fill the log.

use std::{
    sync::Mutex,
    time::{Duration, Instant},
};

/// Messages of one kind that are logged per [`WINDOW`].
const MESSAGES_MAX: u32 = 20;
const WINDOW: Duration = Duration::from_secs(10);

/// Rate limit for one kind of log message.
#[derive(Debug, Default)]
pub struct RateLimitedLog {
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    window_start: Option<Instant>,
    logged: u32,
    suppressed: u64,
}

impl RateLimitedLog {
    /// Calls `log`, which logs one event, unless the limit of this window is reached. Reports suppressed events first.
    pub fn emit(&self, log: impl FnOnce()) {
        let Some(suppressed) = self.admit(Instant::now()) else { return };
        if suppressed > 0 {
            tracing::warn!(suppressed, "messages like the next one were not logged");
        }
        log();
    }

    /// Returns how many messages were suppressed since the last one, or `None` where this one is suppressed too.
    fn admit(&self, now: Instant) -> Option<u64> {
        let mut state = self.state.lock().expect("no holder of this lock panics");
        if state.window_start.is_none_or(|start| now.duration_since(start) >= WINDOW) {
            (state.window_start, state.logged) = (Some(now), 0);
        }
        if state.logged == MESSAGES_MAX {
            state.suppressed += 1;
            return None;
        }
        state.logged += 1;
        Some(std::mem::take(&mut state.suppressed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_million_messages_become_a_few_lines() {
        let (log, now) = (RateLimitedLog::default(), Instant::now());
        let logged = (0..1_000_000).filter(|_| log.admit(now).is_some()).count();
        assert_eq!(logged, MESSAGES_MAX as usize);
        assert_eq!(log.admit(now + WINDOW), Some(1_000_000 - u64::from(MESSAGES_MAX)));
        assert_eq!(log.admit(now + WINDOW), Some(0));
    }
}
