//! A brake on floods: whoever sends more than anybody honest would is read more slowly, by the bus itself.
//!
//! Callbacks run where a link is read. While one naps, nothing more is read from that link, its sender's buffers fill, and
//! the sender has to wait: what it does not send costs nobody anything. Naps are short, because the next messages of other
//! links may have to wait for the thread; where there is a brake, the bus reads with more threads than it would by itself (see
//! `threads`), and where one thread must do for all links there are no naps.

use std::{
    sync::Mutex,
    time::{Duration, Instant},
};

use super::threads;

/// One nap.
const NAP: Duration = Duration::from_millis(1);

/// Lets so many messages a second pass at full speed.
#[derive(Debug)]
pub(super) struct Brake {
    per_s: f64,
    /// Where one thread reads all links, and writes them, a nap would be everybody's.
    naps: bool,
    state: Mutex<Option<(f64, Instant)>>,
}

impl Brake {
    /// So many a second, and as many at once after a silence of a second.
    pub(super) fn new(per_s: f64) -> Self {
        Self { per_s, naps: threads::may_pause(), state: Mutex::default() }
    }

    /// One message more: naps where they are too many.
    pub(super) fn press(&self) {
        if self.naps && !self.spend(Instant::now()) {
            std::thread::sleep(NAP);
        }
    }

    fn spend(&self, now: Instant) -> bool {
        let mut state = self.state.lock().expect("no holder of this lock panics");
        let (left, since) = state.unwrap_or((self.per_s, now));
        let left = (left + now.saturating_duration_since(since).as_secs_f64() * self.per_s).min(self.per_s);
        let enough = left >= 1.0;
        *state = Some((if enough { left - 1.0 } else { left }, now));
        enough
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_beyond_the_rate_naps() {
        let (brake, now) = (Brake::new(100.0), Instant::now());
        let passed = |count, now| (0..count).filter(|_| brake.spend(now)).count();
        assert_eq!(passed(1000, now), 100);
        assert_eq!(passed(1000, now + Duration::from_millis(500)), 50);
        assert_eq!(passed(1000, now + Duration::from_secs(60)), 100, "a long silence is worth a second");
    }
}
