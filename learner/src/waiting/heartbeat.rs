//! Heartbeat of the training thread, which other threads monitor.

use std::{
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::{Duration, Instant},
};

/// Last beat of the training thread, which beats while it waits for fragments, a disk or a store, and after each part of an
/// update.
#[derive(Clone, Debug)]
pub struct Heartbeat {
    begun: Instant,
    /// Milliseconds from `begun` to the last beat.
    last_beat_ms: Arc<AtomicU64>,
}

impl Default for Heartbeat {
    fn default() -> Self {
        Self { begun: Instant::now(), last_beat_ms: Arc::default() }
    }
}

impl Heartbeat {
    #[cfg(test)]
    pub(super) fn silent_for(silence: Duration) -> Self {
        Self { begun: Instant::now() - silence, last_beat_ms: Arc::default() }
    }

    /// Records a beat.
    pub fn beat(&self) {
        self.last_beat_ms.store(self.begun.elapsed().as_millis() as u64, Ordering::Relaxed);
    }

    /// Time since the last beat.
    pub fn silence(&self) -> Duration {
        self.begun.elapsed().saturating_sub(Duration::from_millis(self.last_beat_ms.load(Ordering::Relaxed)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn silence_lasts_until_the_next_beat() {
        let heartbeat = Heartbeat::silent_for(Duration::from_secs(1000));
        let watched = heartbeat.clone();
        assert!(watched.silence() >= Duration::from_secs(1000));
        heartbeat.beat();
        assert!(watched.silence() < Duration::from_secs(1000));
    }
}
